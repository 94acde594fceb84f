"""Bodies that a game moves: lifts, ferries, turntables, pistons, doors."""
import math

from geometry import Mesh, circle
from situation import situation

E = (1.0, 0.0)
M = dict(needs=("moving",))


def ground(run, y=0.0, x0=-30, x1=30):
    run.still.floor(x0, x1, -20, 20, y=y, nx=6, nz=4)


def slab(half=2.0, thick=0.5):
    return Mesh().box((-half, -thick, -half), (half, 0, half))


def ramped(speed, start, end, ease=0.25):
    """The way of a body that starts and stops within `ease` seconds."""
    def way(t):
        t = min(max(t - start, 0.0), end - start)
        long = end - start
        def area(u):  # of a speed that rises to 1 within `ease`
            return u * u / (2 * ease) if u < ease else u - ease / 2
        back = max(0.0, t - (long - ease))
        return speed * (area(t) - back * back / (2 * ease))
    return way


@situation("platforms/lift up", "A lift carries the player up, without sinking in and without hopping at its top.", "https://github.com/jrouwe/JoltPhysics/issues/530", **M, speed=2.0)
@situation("platforms/fast lift up", "So does a fast one.", "https://github.com/jrouwe/JoltPhysics/issues/530", **M, speed=8.0)
@situation("platforms/lift down", "A lift going down takes the player with it; it does not leave it to fall.", "https://github.com/jrouwe/JoltPhysics/issues/1514", **M, speed=-2.0)
@situation("platforms/fast lift down", "So does a fast one, as long as it is slower than a fall.", "https://github.com/jrouwe/JoltPhysics/issues/1514", **M, speed=-4.0)
def lift(run, speed):
    ground(run, -30)
    way = ramped(speed * run.vary(1, 0.8, 1.2), 1.0, 3.0, 0.5)
    body = run.moving(slab(), lambda t: ((0.0, way(t), 0.0), 0.0))
    run.feet = (run.vary(0.3, -1, 1), 0.02, 0.2)
    first = run.go(0.9)
    run.go(3.0)
    run.check("ride", mesh=body, most=0.12, first=first)


@situation("platforms/ferry", "A player who stands on a ferry arrives with it.", "https://github.com/godotengine/godot/issues/52957", **M, speed=4.0)
@situation("platforms/fast ferry", "So does one on a train.", "https://github.com/godotengine/godot/issues/52957", **M, speed=15.0)
def ferry(run, speed):
    ground(run, -30)
    way = ramped(speed, 1.0, 4.0, 1.0)
    body = run.moving(slab(), lambda t: ((way(t), 0.0, 0.0), 0.0))
    run.feet = (run.vary(0.3, -1, 1), 0.02, 0.2)
    first = run.go(0.9)
    run.go(4.0)
    run.check("ride", mesh=body, most=0.25, first=first)


@situation("platforms/ferry aslant", "A lift that goes up and across carries, too.", "https://github.com/jrouwe/JoltPhysics/issues/1514", **M)
def aslant(run):
    ground(run, -30)
    across, up = ramped(3.0, 1.0, 3.5, 0.6), ramped(run.vary(1.5, -1.5, 2), 1.0, 3.5, 0.6)
    body = run.moving(slab(), lambda t: ((across(t), up(t), 0.5 * across(t)), 0.0))
    first = run.go(0.9)
    run.go(3.5)
    run.check("ride", mesh=body, most=0.2, first=first)


@situation("platforms/turntable", "A turntable carries the player round.", "https://github.com/godotengine/godot/issues/52957", **M, rate=1.0, out=2.0)
@situation("platforms/fast turntable", "A fast turntable carries the player round and does not throw it off.", "https://github.com/godotengine/godot/issues/52957", **M, rate=3.0, out=3.0)
def turntable(run, rate, out):
    ground(run, -30)
    angle = ramped(rate, 1.0, 5.0, 1.0)
    body = run.moving(Mesh().column(circle(32, 5), -0.5, 0), lambda t: ((0.0, 0.0, 0.0), angle(t)))
    run.feet = (run.vary(out, 0.5 * out, out), 0.02, 0.0)
    first = run.go(0.9)
    run.go(5.0)
    run.check("ride", mesh=body, most=0.35, first=first)
    run.check("even", most=0.05, first=first)


@situation("platforms/walking on a turntable", "On a slow turntable the player can walk about.", "https://github.com/jrouwe/JoltPhysics/issues/1514", **M, keep="walking must not unhook a player")
def walk_turntable(run):
    ground(run, -30)
    body = run.moving(Mesh().column(circle(32, 8), -0.5, 0), lambda t: ((0.0, 0.0, 0.0), 0.3 * t))
    run.feet = (2.0, 0.02, 0.0)
    run.go(0.8)
    run.go(0.8, (0.3, 0.0))
    run.go(0.8, (-0.3, 0.0))
    run.check("even", most=0.05, first=40)
    run.check("stay", low=[-8, -0.2, -8], high=[8, 0.2, 8])


@situation("platforms/walking off a ferry", "From a ferry that stands at the quay the player walks on.", "https://github.com/jrouwe/JoltPhysics/issues/530", **M)
def walk_off(run):
    run.still.box((2, -2, -4), (20, 0, 4))
    ground(run, -30)
    way = ramped(2.0, 0.5, 2.0, 0.4)
    travel = way(99)
    body = run.moving(slab(), lambda t: ((way(t) - travel, 0.0, 0.0), 0.0))
    run.feet = (-travel, 0.02, run.vary(0, -1, 1))
    run.go(2.2)
    first = run.go(0.2, E)
    run.go(1.2, E)
    run.check("reach", axis=[1, 0, 0], least=5.0)
    run.check("even", most=0.06, first=first)
    run.check("smooth", way=E, fraction=0.5, ticks=1, first=first)


@situation("leaving/jump from a ferry", "Seen from the ferry, a jump on it lands where it began.", "https://github.com/godotengine/godot-proposals/issues/2315", needs=("moving", "jump"), game_code=True)
def jump_ferry(run):
    ground(run, -30, -30, 60)
    way = ramped(4.0, 0.7, 9.0, 0.7)
    body = run.moving(Mesh().box((-6, -0.5, -3), (6, 0, 3)), lambda t: ((way(t), 0.0, 0.0), 0.0))
    run.go(2.2)
    first = run.go(0.05, jump=True)
    run.go(1.0)
    run.check("ride", mesh=body, most=2.2, first=first)
    run.check("stay", low=[None, -0.2, -1], high=[None, 2.2, 1])
    run.check("rise", rest=first - 3, least=1.0, most=1.9)


@situation("leaving/jump from a lift", "From a lift going up a jump is as high as from the floor, seen from the lift.", "https://github.com/godotengine/godot-proposals/issues/2315", needs=("moving", "jump"), game_code=True)
def jump_lift(run):
    ground(run, -30)
    way = ramped(3.0, 0.5, 9.0, 0.5)
    body = run.moving(slab(), lambda t: ((0.0, way(t), 0.0), 0.0))
    rest = run.go(1.5) - 1
    run.go(0.4, jump=True)
    run.check("rise", rest=rest, least=1.9, most=3.4)
    run.check("outside")


@situation("pressing/a piston", "A wall that moves pushes the player along; it does not pass through it.", "https://github.com/dimforge/rapier/issues/485", **M, speed=2.0)
@situation("pressing/a fast piston", "So does a fast one.", "https://github.com/dimforge/rapier/issues/485", **M, speed=8.0)
def piston(run, speed):
    ground(run)
    way = ramped(speed, 0.7, 0.7 + 8 / speed, 0.1)
    z = run.vary(0.1, -0.3, 0.3)
    body = run.moving(Mesh().box((-1, 0.02, -3), (0, 3, 3)), lambda t: ((way(t) - 1.5, 0.0, z), 0.0))
    run.go(0.7 + 8 / speed + 0.3)
    run.check("reach", axis=[1, 0, 0], least=way(99) - 1.5 + 0.2)
    run.check("outside")


@situation("pressing/a sweeping arm", "An arm that turns sweeps the player off; it does not pass through.", "https://github.com/dimforge/rapier/issues/485", **M)
def arm(run):
    ground(run)
    rate = run.vary(1.0, 0.7, 1.4)
    body = run.moving(Mesh().box((-4, 0.05, -0.15), (4, 1.5, 0.15)), lambda t: ((0.0, 0.0, 0.0), 0.35 + rate * max(0.0, t - 0.7)))
    run.feet = (2.5, 0.02, -2.2)
    run.go(3.2)
    run.check("travel", least=0.6)
    run.check("outside")
    run.check("stay", low=[None, -0.2, None], high=[None, 2.2, None])


@situation("pressing/pushed while idle on a ferry's wall", "A player leaning at a ferry's rail goes where the ferry goes.", "https://github.com/dimforge/rapier/issues/485", **M)
def rail(run):
    ground(run, -30)
    mesh = Mesh().box((-3, -0.5, -2), (3, 0, 2)).box((-3, 0, -2), (-2.8, 1.2, 2))
    way = ramped(5.0, 0.8, 3.0, 0.6)
    body = run.moving(mesh, lambda t: ((way(t), 0.0, 0.0), 0.0))
    run.feet = (-2.3, 0.02, run.vary(0, -1, 1))
    first = run.go(0.7)
    run.go(3.0)
    run.check("ride", mesh=body, most=0.3, first=first)
    run.check("outside")


@situation("pressing/a lift under the feet", "A lift that comes up under a standing player takes it along.", "https://github.com/jrouwe/JoltPhysics/issues/530", **M)
def under(run):
    ground(run)
    way = ramped(run.vary(1.5, 1, 3), 0.8, 2.8, 0.3)
    body = run.moving(slab(), lambda t: ((0.0, way(t) - 0.05, 0.0), 0.0))
    run.feet = (0.4, 0.02, 0.3)
    run.go(3.2)
    run.check("reach", axis=[0, 1, 0], least=way(99) - 0.15)
    run.check("outside")


@situation("hitch frames/on a ferry", "A long frame must not leave the player behind its ferry.", "https://github.com/godotengine/godot-proposals/issues/9663", **M)
def hitch_ferry(run):
    ground(run, -30)
    way = ramped(4.0, 1.0, 6.0, 1.0)
    body = run.moving(slab(3.0), lambda t: ((way(t), 0.0, 0.0), 0.0))
    first = run.go(2.5)
    run.go(0.2, dt=0.2)
    run.go(0.4)
    run.go(0.25, dt=0.25)
    run.go(0.5)
    run.check("ride", mesh=body, most=0.4, first=first - 1)


@situation("hitch frames/on a lift", "A long frame must not let the player through its lift.", "https://github.com/godotengine/godot-proposals/issues/9663", **M)
def hitch_lift(run):
    ground(run, -30)
    way = ramped(run.vary(3.0, 2, 4), 1.0, 6.0, 1.0)
    body = run.moving(slab(3.0), lambda t: ((0.0, way(t), 0.0), 0.0))
    first = run.go(2.5)
    for _ in range(3):
        run.go(0.2, dt=0.2)
        run.go(0.3)
    run.check("ride", mesh=body, most=0.3, first=first - 1)
    run.check("outside")
