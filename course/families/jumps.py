"""Jumps: what a game writes around its controller, and what players do with the button."""
import math

from situation import situation

E = (1.0, 0.0)


@situation("game code/jump height at 30 Hz", "A jump of 8 m/s under 20 m/s2 rises 1.6 m; the integrator decides how near it comes.", "https://gafferongames.com/post/integration_basics/", needs=("jump",), game_code=True, rate=30)
@situation("game code/jump height at 60 Hz", "A jump of 8 m/s under 20 m/s2 rises 1.6 m.", "https://gafferongames.com/post/integration_basics/", needs=("jump",), game_code=True, rate=60)
@situation("game code/jump height at 240 Hz", "A jump of 8 m/s under 20 m/s2 rises 1.6 m.", "https://gafferongames.com/post/integration_basics/", needs=("jump",), game_code=True, rate=240)
def jump_height(run, rate):
    run.dt = 1 / rate
    run.still.floor(-6, 6, -6, 6, nx=6, nz=6)
    rest = run.go(0.5) - 1
    run.go(0.9, jump=True)
    run.check("rise", rest=rest, least=1.52, most=1.68)


@situation("game code/steering in the air", "A player can steer a little in the air.", "https://www.gdcvault.com/play/1023559/Math-for-Game-Programmers-Building", needs=("jump",), game_code=True)
def air_control(run):
    run.still.floor(-6, 20, -6, 6, nx=6, nz=6)
    run.go(0.5)
    run.go(0.1, jump=True)
    run.go(0.6, E, jump=True)
    run.check("reach", axis=[1, 0, 0], least=0.4)


@situation("jumps/off the edge of a run", "A running jump covers the gap that its speed and height allow.", "https://github.com/jrouwe/JoltPhysics/issues/1988", needs=("jump",))
def gap(run):
    wide = run.vary(3.0, 2.5, 3.3)
    run.still.box((-8, -1, -3), (0, 0, 3))
    run.still.box((wide, -1, -3), (20, 0, 3))
    run.feet = (-6.0, 0.02, 0.0)
    run.go(0.5)
    run.go(0.95, E)
    run.go(1.2, E, jump=True)
    run.check("reach", axis=[1, 0, 0], least=wide + 1)
    run.check("stay", low=[None, -0.2, -0.2], high=[None, 2.0, 0.2])


@situation("jumps/mashing the button", "A player who presses jump all the time must not fly.", "https://github.com/jrouwe/JoltPhysics/issues/1988", needs=("jump",), keep="a controller that counts a jump in the air must fail")
def mash(run):
    run.still.floor(-6, 40, -6, 6, nx=9, nz=4)
    rest = run.go(0.5) - 1
    run.go(4.0, E, jump=3)
    run.check("rise", rest=rest, least=1.0, most=1.9)


@situation("jumps/up a wall by mashing", "A wall must not be climbed by running against it and pressing jump.", "https://github.com/NVIDIAGameWorks/PhysX/issues/450", needs=("jump",))
def mash_wall(run):
    run.still.floor(-6, 9, -20, 20, nx=5, nz=12)
    run.still.wall([(2, 20), (2, -20)], -0.5, 9, columns=30, rows=12)
    rest = run.go(0.5) - 1
    angle = math.radians(run.vary(10, -30, 30))
    run.go(4.0, (math.cos(angle), math.sin(angle)), jump=4)
    run.check("rise", rest=rest, least=0.5, most=1.9)
    run.check("stay", low=[None, -0.1, None], high=[1.8, 2.0, None])


@situation("jumps/in a corner by mashing", "The inner corner of two walls is no ladder.", "https://github.com/momentum-mod/game/issues/1581", needs=("jump",))
def mash_corner(run):
    run.still.floor(-6, 9, -6, 6, nx=5, nz=4)
    half = math.radians(run.vary(45, 30, 60))
    run.still.wall([(2 - 5 * math.cos(half), 5 * math.sin(half)), (2, 0), (2 - 5 * math.cos(half), -5 * math.sin(half))], -0.5, 9, columns=5, rows=9)
    run.feet = (-1.5, 0.02, 0)
    rest = run.go(0.5) - 1
    run.go(4.0, E, jump=4)
    run.check("rise", rest=rest, least=0.5, most=1.9)
    run.check("outside")


@situation("jumps/on stairs", "A jump on stairs starts from every step.", "https://github.com/jrouwe/JoltPhysics/issues/1988", needs=("jump", "steps"))
def on_stairs(run):
    from families.stairs import flight
    flight(run, 14, 0.17, 0.3)
    run.go(0.5)
    run.go(0.5, E)
    rest = run.ticks - 1
    run.go(0.4, E, jump=True)
    run.check("rise", rest=rest, least=1.2, most=3.2)


@situation("jumps/onto a ledge", "A ledge a little lower than the jump is reached.", "https://github.com/jrouwe/JoltPhysics/issues/1988", needs=("jump",))
def onto_ledge(run):
    high = run.vary(1.2, 0.9, 1.25)
    run.still.floor(-8, 2, -4, 4, nx=5, nz=4)
    run.still.box((2, -1, -4), (14, high, 4))
    run.go(0.5)
    run.go(0.2, E)
    run.go(0.6, E, jump=True)
    run.go(0.6, E)
    run.check("reach", axis=[1, 0, 0], least=3.0)
    first = run.ticks
    run.go(0.5)
    run.check("stay", low=[2, high - 0.1, -0.2], high=[None, high + 0.2, 0.2], first=first + 20)
