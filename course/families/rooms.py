"""Corners, wedges, ceilings, tunnels and doors, and rooms full of junk."""
import math

from geometry import Mesh, circle
from situation import situation

E = (1.0, 0.0)
W = (-1.0, 0.0)
SHAKE = "A camera that shakes in a corner is what reviewers film."


def corner_run(run, degrees, deep):
    """Two walls whose angle is `degrees`, the corner at x = 6, `deep` m long; the player walks in, waits, walks out."""
    half = math.radians(degrees / 2)
    run.still.floor(-8, 9, -9, 9, nx=10, nz=8)
    d = (math.cos(half), math.sin(half))
    run.still.wall([(6 - deep * d[0], deep * d[1]), (6, 0), (6 - deep * d[0], -deep * d[1])], -0.5, 4)
    # Between the walls' normals, so that the corner is where the way ends, and far enough from them to get there soon.
    angle = math.radians(run.vary(0.12, -0.4, 0.4) * (90 - degrees / 2))
    run.feet = (run.vary(0, -0.5, 0.5), 0.02, run.vary(0.05, -0.2, 0.2))
    run.go(0.5)
    first = run.go(3.5, (math.cos(angle), math.sin(angle)))
    end = run.go(1.5, (math.cos(angle), math.sin(angle))) - 1
    run.go(1.5, W)
    return first, end


@situation("corners/square", SHAKE, "https://github.com/godotengine/godot/issues/32182", degrees=90)
@situation("corners/60 degrees", SHAKE, "https://github.com/momentum-mod/game/issues/1581", degrees=60)
@situation("wedges/25 degrees", SHAKE, "https://github.com/momentum-mod/game/issues/1581", degrees=25)
@situation("corners/wide, 120 degrees", SHAKE, "https://github.com/nicholas-maltbie/OpenKCC/issues/42", degrees=120)
@situation("corners/wide, 160 degrees", SHAKE, "https://github.com/nicholas-maltbie/OpenKCC/issues/42", degrees=160)
def corner(run, degrees):
    first, end = corner_run(run, degrees, 7)
    run.check("rest", creep=0.01, first=first, last=end)
    run.check("stay", low=[1.5, -0.1, -2.5], high=[6.0, 0.3, 2.5], first=first, last=end)
    run.check("speed", way=W, least=4.0, most=6.4, first=end + 20)
    run.check("outside")


@situation("corners/round room", "Pushing against a round wall of many sides must end in rest.", "https://github.com/nicholas-maltbie/OpenKCC/issues/42")
def round_room(run):
    run.still.floor(-5, 5, -5, 5, nx=5, nz=5)
    sides = round(run.vary(24, 9, 40))
    outline = circle(sides, 3, turn=run.vary(0.05, 0, 1))
    run.still.wall(outline + outline[:1], -0.5, 4)
    run.go(0.5)
    first = run.go(3.0, E)
    run.go(2.0, E)
    run.check("still", most=0.02, first=first)  # along a side it may still slide, slowly
    run.check("forward", ticks=0, first=first)
    run.check("reach", axis=[1, 0, 0], least=2.2)


@situation("wedges/under a stair", "Where the ceiling comes down to the floor the player stops, and comes out again.", "https://github.com/SmartlyDressedGames/U3-SDK/issues/2676", degrees=30)
@situation("wedges/under a flat roof", "The flatter the roof, the harder it presses a player into the floor.", "https://github.com/SmartlyDressedGames/U3-SDK/issues/2676", degrees=12)
def wedge(run, degrees):
    degrees *= run.vary(1, 0.85, 1.15)
    run.still.floor(-8, 30, -6, 6, nx=10, nz=4)
    length = 5 / math.tan(math.radians(degrees))
    end = 2 + 0.4 * length + 3
    run.still.polygon((end - length, 5, -6), (end, 0, -6), (end, 0, 6), (end - length, 5, 6))
    run.go(0.5)
    first = run.go((end + 2) / 6 + 0.5, E)
    hold = run.go(1.5, E) - 1
    run.go(1.0, W)
    run.check("rest", creep=0.05, first=first, last=hold)
    run.check("stay", low=[None, -0.12, -1], high=[end, 0.4, 1])
    run.check("speed", way=W, least=3.5, most=6.4, first=hold + 20)
    run.check("outside")


@situation("wedges/between two steep slopes", "A player who falls between two steep slopes must be able to walk out along them.", "https://github.com/jrouwe/JoltPhysics/issues/1876")
def crevice(run):
    slope = math.tan(math.radians(run.vary(62, 57, 68)))
    run.still.polygon((-4, 5 * slope, -5), (-4, 0, 0), (30, 0, 0), (30, 5 * slope, -5))
    run.still.polygon((-4, 0, 0), (-4, 5 * slope, 5), (30, 5 * slope, 5), (30, 0, 0))
    run.feet = (0.0, 1.5, run.vary(0.1, -0.3, 0.3))
    first = run.go(2.0)
    run.check("still", most=0.01, first=first, last=run.go(2.0) - 1)
    run.go(2.0, E)
    run.check("reach", axis=[1, 0, 0], least=4.0)
    run.check("outside")


@situation("ceilings/jump below one", "The head hits, the player falls back at once; it does not hang there.", "https://github.com/jrouwe/JoltPhysics/issues/1988", needs=("jump",))
def low_ceiling(run):
    run.still.floor(-6, 6, -6, 6, nx=6, nz=6)
    gap = run.vary(0.5, 0.3, 0.8)
    run.still.box((-6, 1.8 + gap, -6), (6, 4, 6))
    rest = run.go(0.5) - 1
    first = run.go(0.05, jump=True)
    run.go(0.55, jump=True)
    run.check("rise", rest=rest, least=gap - 0.15, most=gap + 0.02)
    run.check("stay", low=[-0.2, -0.05, -0.2], high=[0.2, 0.15, 0.2], first=first + 28)


@situation("ceilings/jump below a slanted one", "A slanted ceiling deflects the jump; nobody gets into it.", "https://github.com/SmartlyDressedGames/U3-SDK/issues/2676", needs=("jump",))
def slanted(run):
    run.still.floor(-6, 20, -6, 6, nx=13, nz=6)
    slope = math.tan(math.radians(run.vary(35, 20, 50)))
    run.still.polygon((-6, 2.2 + 6 * slope, -6), (2, 2.2 - 2 * slope + 0.4, -6), (2, 2.2 - 2 * slope + 0.4, 6), (-6, 2.2 + 6 * slope, 6))
    run.feet = (-2.5, 0.02, 0.0)
    run.go(0.5)
    run.go(2.0, E, jump=20)
    run.check("stay", low=[None, -0.1, None], high=[None, 3.0, None])
    run.check("outside")
    first = run.go(1.0)
    run.go(0.5)
    run.check("rest", creep=0.01, first=first)


@situation("tunnels/low", "A passage ten centimetres higher than the player is a passage.", "https://github.com/NVIDIAGameWorks/PhysX/issues/400", high=1.9, wide=3.0)
@situation("tunnels/narrow", "A passage ten centimetres wider than the player is a passage.", "https://github.com/NVIDIAGameWorks/PhysX/issues/400", high=3.0, wide=0.92)
@situation("tunnels/tight", "A passage six centimetres larger than the player on all sides lets it through.", "https://github.com/NVIDIAGameWorks/PhysX/issues/400", high=1.92, wide=0.92)
@situation("doors/0.9 m", "Doors are 0.9 m wide.", "https://github.com/NVIDIAGameWorks/PhysX/issues/400", high=2.0, wide=0.94, long=0.3, keep="the one thing that every level has")
def tunnel(run, high, wide, long=8.0):
    run.still.floor(-6, 24, -5, 5, nx=15, nz=5)
    half = wide / 2
    for z0, z1 in ((-5, -half), (half, 5)):
        run.still.box((3, -0.5, z0), (3 + long, 5, z1))
    run.still.box((3, high, -half), (3 + long, 5, half))
    run.feet = (0.0, 0.02, run.vary(0.0, -0.02, 0.02))
    run.go(0.5)
    run.go(0.6 + (3 + long) / 6 * 1.3, E)
    run.check("reach", axis=[1, 0, 0], least=3 + long + 0.3)


@situation("tunnels/at a door's jamb", "A player who hits the jamb with a shoulder slips through the door.", "https://github.com/jrouwe/JoltPhysics/issues/363")
def jamb(run):
    run.still.floor(-6, 24, -5, 5, nx=15, nz=5)
    for z0, z1 in ((-5, -0.6), (0.6, 5)):
        run.still.box((3, -0.5, z0), (3.4, 3, z1))
    run.still.box((3, 2.2, -5), (3.4, 3, 5))
    run.feet = (0.0, 0.02, run.vary(0.35, 0.26, 0.4))
    run.go(0.5)
    run.go(2.5, E)
    run.check("reach", axis=[1, 0, 0], least=4.5)
    run.check("forward", ticks=0)


@situation("tunnels/round pipe", "A pipe of many narrow strips is a passage.", "https://github.com/jrouwe/JoltPhysics/issues/363")
def pipe(run):
    run.still.floor(-6, 2, -5, 5, nx=4, nz=5)
    sides, radius = 40, run.vary(1.15, 1.08, 1.4)
    for i in range(sides):
        a, b = [2 * math.pi * t / sides for t in (i, i + 1)]
        p, q = [(radius + radius * math.sin(t), -radius * math.cos(t)) for t in (a, b)]
        run.still.polygon((2, p[0], p[1]), (14, p[0], p[1]), (14, q[0], q[1]), (2, q[0], q[1]))
    run.still.floor(14, 24, -5, 5, nx=4, nz=5)
    run.go(0.5)
    run.go(3.0, E)
    run.check("reach", axis=[1, 0, 0], least=15)


@situation("rooms/junk", "A room full of furniture at all angles is what players run through in panic.", "https://github.com/jrouwe/JoltPhysics/issues/1887")
@situation("rooms/junk, crowded", "The same with twice the furniture.", "https://github.com/jrouwe/JoltPhysics/issues/1887", pieces=120)
def junk(run, pieces=60):
    run.still.floor(-8, 8, -8, 8, nx=8, nz=8)
    run.still.wall(circle(4, 11, turn=math.pi / 4) + circle(4, 11, turn=math.pi / 4)[:1], -1, 6)
    for _ in range(pieces):
        x, z = run.random.uniform(-7, 7), run.random.uniform(-7, 7)
        if math.hypot(x, z) < 1.5:
            continue
        size = [run.random.uniform(0.1, 1.1) for _ in range(3)]
        turn, tilt = run.random.uniform(0, math.pi), run.random.uniform(-0.7, 0.7)
        c, s, ct, st = math.cos(turn), math.sin(turn), math.cos(tilt), math.sin(tilt)

        def place(p):
            px, py = ct * p[0] - st * p[1], st * p[0] + ct * p[1]
            return (x + c * px + s * p[2], py + size[1] * 0.5, z + c * p[2] - s * px)
        piece = Mesh().box([-a for a in size], size).moved(place)
        base = len(run.still.positions)
        run.still.positions += piece.positions
        run.still.triangles += [tuple(i + base for i in t) for t in piece.triangles]
    run.go(0.5)
    first = run.ticks
    for _ in range(20):
        angle = run.random.uniform(0, 2 * math.pi)
        run.go(0.75, (math.cos(angle), math.sin(angle)))
    run.check("outside")
    run.check("forward", ticks=45, first=first)  # of 900; a tick after each turn of the stick is natural
    run.check("travel", least=12, first=first)  # many a corner holds for a while; none for good
    run.check("stay", low=[-8.1, -0.2, -8.1], high=[8.1, 5, 8.1])
