"""Walls: thin, leaning, fast, at a glancing angle, in a wall's seams, round pillars."""
import math

from geometry import Mesh, circle
from situation import situation

E = (1.0, 0.0)
THROUGH = "A player who leaves the level through a wall has to start again, and everybody finds the place."


def arena(run, x1=40):
    run.still.floor(-8, x1, -20, 20, nx=12, nz=10)


@situation("walls/thin at 6 m/s", THROUGH, "https://github.com/dimforge/rapier/issues/748", keep="what everything else begins with", speed=6.0, rate=60)
@situation("walls/thin at 40 m/s", THROUGH, "https://github.com/dimforge/bevy_rapier/issues/520", speed=40.0, rate=60)
@situation("walls/thin at 40 m/s and 20 Hz", THROUGH, "https://github.com/dimforge/bevy_rapier/issues/520", speed=40.0, rate=20)
def thin(run, speed, rate):
    run.dt, run.settings["walk_speed"] = 1 / rate, speed
    arena(run)
    angle = math.radians(run.vary(8, -60, 60))
    run.still.wall([(6, 19), (6, -19)], -1, 6, columns=5, rows=3)
    run.go(0.5)
    run.go(12 / speed + 0.4, (math.cos(angle), math.sin(angle)))
    run.check("stay", low=[None, -0.2, None], high=[5.75, 0.3, None])
    run.check("reach", axis=[1, 0, 0], least=3.5)


@situation("walls/leaning in", "A wall that leans over the player pushes it into the floor of careless controllers.", "https://github.com/SmartlyDressedGames/U3-SDK/issues/2676", lean=70)
@situation("walls/leaning far in", "Under a steep roof the player stops where its head touches.", "https://github.com/SmartlyDressedGames/U3-SDK/issues/2676", lean=40)
@situation("walls/leaning out", "A wall that leans away by ten degrees is a wall.", "https://github.com/jrouwe/JoltPhysics/issues/696", lean=100, keep="with a slope limit all should pass; without one some climb")
def leaning(run, lean):
    arena(run)
    foot, top = 6.0, 6.0 - 5 / math.tan(math.radians(lean + run.vary(0, -4, 4)))
    run.still.polygon((foot, 0, 19), (top, 5, 19), (top, 5, -19), (foot, 0, -19))
    angle = math.radians(run.vary(15, -40, 40))
    run.go(0.5)
    run.go(2.5, (math.cos(angle), math.sin(angle)))
    first = run.go(0.5)
    run.check("stay", low=[None, -0.1, None], high=[5.9, 0.6, None])
    run.check("outside")
    last = run.go(1.0, (-1.0, 0.0))
    run.check("speed", way=(-1.0, 0.0), least=3.5, most=6.4, first=first + 12, last=last - 1)


@situation("walls/along a wall", "The player slides along a wall at a steady speed.", "https://github.com/godotengine/godot/issues/85971", angle=30)
@situation("walls/nearly straight into a wall", "Even if the stick points nearly straight at the wall, the slide is steady.", "https://github.com/godotengine/godot/issues/85971", angle=80)
def along(run, angle):
    angle = math.radians(angle + run.vary(0, -5, 5))
    run.still.floor(-8, 50, -6, 6, nx=58, nz=12)
    run.still.wall([(50, -1), (-8, -1)], -0.5, 4, columns=83, rows=3)
    run.go(0.5)
    way = (math.cos(angle), -math.sin(angle))
    first = run.go(0.6, way)
    run.go(3.0, way)
    run.check("smooth", way=E, fraction=0.7, ticks=0, first=first)
    run.check("speed", way=E, least=0.75 * 6 * math.cos(angle), most=6.1, first=first)
    run.check("stay", low=[None, -0.1, -0.75], high=[None, 0.2, 0.3], first=first)


@situation("walls/bricks", "Bricks that stand out by two centimetres brake, but do not stop.", "https://github.com/jrouwe/JoltPhysics/issues/363")
def bricks(run):
    run.still.floor(-8, 40, -6, 6, nx=24, nz=6)
    x, out = -8.0, 0
    while x < 40:
        wide = run.random.uniform(0.3, 0.8)
        run.still.box((x, -0.5, -3), (x + wide, 4, -1 + 0.02 * out))
        x, out = x + wide, 1 - out
    angle = math.radians(run.vary(20, 10, 30))
    run.go(0.5)
    run.go(4.0, (math.cos(angle), -math.sin(angle)))
    run.check("reach", axis=[1, 0, 0], least=9)


@situation("walls/round a pillar", "A player who walks into a pillar's side slips round it.", "https://github.com/godotengine/godot/issues/32182", sides=24)
@situation("walls/round a square pillar", "A corner in the way deflects; it does not stop.", "https://github.com/jrouwe/JoltPhysics/issues/363", sides=4)
def pillar(run, sides):
    arena(run)
    radius = run.vary(1.0, 0.6, 1.4)
    run.still.column(circle(sides, radius, 5, 0, turn=0 if sides == 4 else 0.1), -0.5, 4)
    run.feet = (0.0, 0.02, run.vary(0.35, 0.25, 0.5))
    run.go(0.5)
    run.go(4.0, E)
    run.check("reach", axis=[1, 0, 0], least=5 + radius)
    run.check("forward", ticks=0)


@situation("needles/upright", "A needle is thinner than any test ray; the player must neither stop in it nor stand astride.", "https://github.com/dimforge/rapier/issues/748")
def needle(run):
    arena(run)
    z = run.vary(0.1, -0.2, 0.2)
    run.still.polygon((4, -0.1, z - 0.001), (4, 3, z), (4, -0.1, z + 0.001))
    run.go(0.5)
    run.go(3.0, E)
    run.check("stay", low=[None, -0.1, -3], high=[None, 0.5, 3])
    run.check("outside")


@situation("needles/wire across", "A wire at knee height stops; one overhead does not.", "https://github.com/dimforge/rapier/issues/748")
def wire(run):
    arena(run)
    height = run.vary(0.8, 0.6, 1.2)
    for y in (height, 2.1):
        run.still.polygon((4, y, -10), (4, y + 0.002, 10), (4, y + 0.002, -10))
        run.still.polygon((4, y, 10), (4, y + 0.002, 10), (4, y, -10))
    run.go(0.5)
    run.go(2.0, E)
    run.check("stay", low=[None, -0.1, -1], high=[4.0, 0.4, 1])
    run.check("reach", axis=[1, 0, 0], least=3.4)


@situation("needles/field of spikes", "Among spikes the player walks, is held, walks on; it never gets stuck for good.", "https://github.com/dimforge/bevy_rapier/issues/520")
def spikes(run):
    run.still.floor(-8, 40, -8, 8, nx=12, nz=4)
    places = []  # so far apart that the body fits through everywhere
    while len(places) < 45:
        x, z = run.random.uniform(2, 16), run.random.uniform(-6, 6)
        if all(math.hypot(x - a, z - b) > 1.1 for a, b in places):
            places.append((x, z))
            run.still.column(circle(3, 0.03, x, z, run.random.uniform(0, 6)), -0.2, run.random.uniform(0.5, 2))
    run.go(0.5)
    for i in range(6):
        run.go(1.0, (0.8, 0.6 if i % 2 else -0.6))
    run.check("reach", axis=[1, 0, 0], least=8)
    run.check("outside")


@situation("far/wall", "Ten kilometres out the wall must hold, and the player must not shake at it.", "https://github.com/godotengine/godot/issues/75537")
def far_wall(run):
    run.offset = (10_000.0, 0.0, -7_000.0)
    arena(run, 12)
    run.still.wall([(6, 19), (6, -19)], -1, 4, columns=5)
    run.go(0.5)
    first = run.go(2.0, E)
    run.go(2.0, E)
    run.check("rest", creep=0.02, first=first)
    run.check("stay", low=[5.3, -0.2, -0.2], high=[5.8, 0.2, 0.2], first=first)
