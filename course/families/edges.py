"""Edges to stand on, falls, and frames that took too long."""
import math

from situation import situation

E = (1.0, 0.0)


@situation("edges/rest at a ledge", "A player who stops at a ledge stands there; it does not creep over.", "https://github.com/godot-jolt/godot-jolt/issues/643")
def ledge(run):
    run.still.box((-6, -4, -6), (0, 0, 6))
    run.still.floor(0, 8, -6, 6, y=-4)
    run.feet = (-run.vary(0.05, 0.03, 0.2), 0.03, 0.0)
    first = run.go(1.0)
    run.go(4.0)
    run.check("rest", creep=0.01, first=first)
    run.check("stay", low=[-0.4, -0.1, -0.2], high=[0.05, 0.2, 0.2])


@situation("edges/along a beam", "A beam of 20 cm carries a player who walks along it.", "https://github.com/godotengine/godot/issues/75399")
def beam(run):
    half = run.vary(0.1, 0.08, 0.2)
    run.still.box((-3, -0.3, -half), (26, 0, half))
    run.go(0.5)
    first = run.go(0.4, E)
    run.go(2.5, E)
    run.check("speed", way=E, least=5.6, most=6.3, first=first)
    run.check("stay", low=[None, -0.2, -0.15], high=[None, 0.2, 0.15])


@situation("edges/walk off", "Over a ledge the player goes on and falls; it does not hang at the edge.", "https://github.com/godot-jolt/godot-jolt/issues/643")
def walk_off(run):
    run.still.box((-6, -6, -6), (2, 0, 6))
    run.still.floor(2, 30, -6, 6, y=-6, nx=7, nz=3)
    slow = run.vary(0.25, 0.15, 0.4)
    run.go(0.5)
    run.go(3.4 / (6 * slow) + 1.2, (slow, 0.0))
    run.check("reach", axis=[0, -1, 0], least=5.8)
    run.check("forward", ticks=0)
    run.check("outside")


@situation("falls/100 m", "The player must land on the floor, however fast it falls.", "https://github.com/dimforge/rapier/issues/748", drop=100.0, rate=60)
@situation("falls/100 m at 20 Hz", "The same on a slow machine.", "https://github.com/dimforge/rapier/issues/748", drop=100.0, rate=20)
def fall(run, drop, rate):
    run.dt = 1 / rate
    run.still.floor(-6, 6, -6, 6, nx=7, nz=7)
    run.feet = (0.1, drop, 0.1)
    run.go(6.0)
    first = run.go(0.5)
    run.go(0.5)
    run.check("stay", low=[-0.3, -0.05, -0.3], high=[0.5, 0.13, 0.5], first=first)
    run.check("rest", creep=0.005, first=first)


@situation("falls/onto an edge", "Who lands with one foot on a ledge lands on it or beside it; not in it.", "https://github.com/IronWarrior/SuperCharacterController/issues/42")
def onto_edge(run):
    run.still.floor(-8, 8, -8, 8, nx=8, nz=8)
    run.still.box((0, -0.5, -3), (5, 2, 3))
    run.feet = (-run.vary(0.2, 0.05, 0.35), 12.0, run.vary(0, -1, 1))
    run.go(3.5)
    first = run.go(0.5)
    run.go(1.0)
    run.check("rest", creep=0.01, first=first)
    run.check("outside")


@situation("falls/into a shaft", "A shaft a little wider than the player must not hold it half-way.", "https://github.com/NVIDIAGameWorks/PhysX/issues/400")
def shaft(run):
    half = run.vary(0.5, 0.46, 0.6)
    run.still.floor(-2, 2, -2, 2)
    for x0, x1, z0, z1 in ((-3, -half, -3, 3), (half, 3, -3, 3), (-half, half, -3, -half), (-half, half, half, 3)):
        run.still.box((x0, -0.5, z0), (x1, 10, z1))
    run.feet = (run.vary(0.02, -0.04, 0.04), 12.0, run.vary(-0.02, -0.04, 0.04))
    run.go(3.0)
    run.check("stay", low=[-0.3, -0.05, -0.3], high=[0.3, 0.13, 0.3], first=120)
    run.check("outside")


@situation("falls/onto a slope", "A fall onto a slope ends on the slope.", "https://github.com/IronWarrior/SuperCharacterController/issues/42")
def onto_slope(run):
    slope = math.tan(math.radians(run.vary(40, 20, 44)))
    run.still.floor(-20, 20, -8, 8, nx=10, nz=4, height=lambda x, z: x * slope)
    run.feet = (0.0, 25.0, 0.0)
    run.go(3.0)
    first = run.go(0.5)
    run.go(2.0)
    run.check("rest", creep=0.01, first=first)
    run.check("outside")


HITCH = "A frame of a quarter of a second happens on every machine when it loads something."


@situation("hitch frames/at a thin wall", HITCH, "https://github.com/dimforge/bevy_rapier/issues/520")
def hitch_wall(run):
    run.still.floor(-8, 20, -8, 8, nx=7, nz=4)
    x = run.vary(3.0, 2.5, 3.5)
    run.still.wall([(x, 8), (x, -8)], -1, 5)
    run.go(0.5)
    run.go(0.2, E)
    run.go(0.75, E, dt=0.25)
    run.go(0.5, E)
    run.check("stay", low=[None, -0.1, -0.3], high=[x, 0.3, 0.3])
    run.check("reach", axis=[1, 0, 0], least=x - 0.7)


@situation("hitch frames/on stairs", HITCH, "https://github.com/jrouwe/JoltPhysics/issues/211", needs=("steps",))
def hitch_stairs(run):
    from families.stairs import flight
    flight(run, 16, 0.17, 0.3)
    run.go(0.5)
    run.go(0.4, E)
    run.go(0.1, E, dt=0.1)
    run.go(0.3, E)
    run.go(0.1, E, dt=0.1)
    run.go(1.2, E)
    run.check("reach", axis=[1, 0, 0], least=6.5)


@situation("hitch frames/at rest on a slope", HITCH, "https://github.com/godotengine/godot/issues/74971")
def hitch_rest(run):
    from families.slopes import incline
    degrees = run.vary(30, 20, 40)
    incline(run, degrees)
    run.feet = (5.0, 3 * math.tan(math.radians(degrees)) + 0.1, 0.0)
    first = run.go(1.0)
    for _ in range(6):
        run.go(0.25, dt=0.25)
        run.go(0.2)
    run.check("rest", creep=0.02, first=first)


@situation("rates/walk at 15 to 240 Hz", "The player is equally fast on every machine.", "https://github.com/dimforge/rapier/issues/485")
def rates(run):
    run.still.floor(-3, 60, -3, 3, nx=60, nz=6)
    run.go(0.5)
    run.go(0.3, E)
    for rate in (15, 30, 60, 144, 240):
        first = run.ticks
        run.go(0.8, E, dt=1 / rate)
        run.check("speed", way=E, least=5.8, most=6.2, first=first, last=run.ticks - 1)


@situation("rates/variable", "Rates change from frame to frame; the ground does not.", "https://github.com/jrouwe/JoltPhysics/issues/211")
def variable(run):
    run.still.floor(-3, 60, -3, 3, nx=60, nz=6)
    run.go(0.5)
    first = run.go(0.4, E)
    while run.time < 4:
        dt = run.random.uniform(0.004, 0.05)
        run.go(dt, E, dt=dt)
    run.check("speed", way=E, least=5.8, most=6.2, first=first)
    run.check("even", most=0.01, first=first)


@situation("rates/rest at 240 Hz", "At high rates a player at rest must not twitch.", "https://github.com/godotengine/godot/issues/32182")
def rest_240(run):
    run.dt = 1 / 240
    run.still.floor(-3, 3, -3, 3, nx=6, nz=6, height=lambda x, z: 0.3 * x)
    run.feet = (0, 0.2, 0)
    first = run.go(1.0)
    run.go(2.0)
    run.check("rest", creep=0.005, first=first)
