"""Slopes to climb, to rest on and to slide from; ramps, crests and hills."""
import math

from situation import situation

E = (1.0, 0.0)


def incline(run, degrees, length=8.0, first_x=2.0, wide=4.0, columns=8):
    rise = length * math.tan(math.radians(degrees))
    run.still.floor(-6, first_x, -wide, wide, nx=8, nz=4)
    run.still.floor(first_x, first_x + length, -wide, wide, nx=columns, nz=4, height=lambda x, z: (x - first_x) / length * rise)
    return [(-6, 0), (first_x, 0), (first_x + length, rise)]


@situation("slopes/climb 30 degrees", "A hill is walked up.", "https://github.com/dimforge/rapier.js/issues/274", degrees=30, keep="a controller without slopes must fail")
@situation("slopes/climb 48 degrees", "What the slope limit allows is climbed.", "https://github.com/dimforge/rapier.js/issues/274", degrees=48)
def climb(run, degrees):
    degrees -= run.vary(0, 0, 2)
    points = incline(run, degrees)
    rest = run.go(0.5) - 1
    last = run.go(2.4 if degrees > 40 else 1.8, E) - 1
    run.check("reach", axis=[1, 0, 0], least=6.0)
    run.check("forward", ticks=0)
    run.check("smooth", way=E, fraction=0.4, ticks=2, first=rest + 45, last=rest + 70)


@situation("slopes/52 degrees is too steep", "The slope limit is how a designer ends the world.", "https://github.com/NVIDIAGameWorks/PhysX/issues/450", needs=("slope_limit",), degrees=52.5)
@situation("slopes/60 degrees is too steep", "A steep face is a wall.", "https://github.com/NVIDIAGameWorks/PhysX/issues/450", needs=("slope_limit",), degrees=60)
@situation("slopes/75 degrees is too steep", "A nearly upright face is a wall.", "https://github.com/NVIDIAGameWorks/PhysX/issues/450", degrees=75, keep="for controllers without a slope limit")
def too_steep(run, degrees):
    degrees += run.vary(0, 0, 3)
    incline(run, degrees, wide=16)
    angle = math.radians(run.vary(10, -35, 35))
    run.go(0.5)
    run.go(3.0, (math.cos(angle), math.sin(angle)))
    run.check("stay", low=[-1, -0.2, None], high=[3.0, 0.7, None])
    run.check("reach", axis=[1, 0, 0], least=1.2)


@situation("slopes/up a 60 degree wall by jumping", "Players find every wall that can be climbed by pressing jump.", "https://github.com/NVIDIAGameWorks/PhysX/issues/450", needs=("slope_limit", "jump"))
def jump_up(run):
    incline(run, run.vary(60, 57, 63))
    run.go(0.5)
    run.go(5.0, E, jump=12)
    run.check("stay", low=[-1, -0.2, -1], high=[None, 3.2, 1])
    run.check("reach", axis=[1, 0, 0], least=1.2)


REST = "https://github.com/godotengine/godot/issues/74971"


@situation("rest/20 degrees", "A player who lets go of the stick on a hill stands.", REST, degrees=20)
@situation("rest/40 degrees", "A player who lets go of the stick on a steep hill stands.", REST, degrees=40)
@situation("rest/47 degrees", "Up to the slope limit the player stands.", REST, degrees=47)
def rest_on(run, degrees):
    incline(run, degrees - run.vary(0, 0, 3), wide=3)
    run.feet = (4.0, 2 * math.tan(math.radians(degrees)) + 0.1, 0.0)
    first = run.go(1.0)
    run.go(10.0)
    run.check("rest", creep=0.01, first=first)
    run.check("stay", low=[3.0, -0.2, -0.5], high=[5.0, 3.0, 0.5])


@situation("rest/after a walk uphill", "Letting go of the stick on a slope stops the player, and does not let it slide back.", REST)
def stop_uphill(run):
    incline(run, run.vary(35, 25, 42))
    run.go(0.5)
    run.go(1.0, E)
    first = run.go(0.6)
    run.go(3.0)
    run.check("rest", creep=0.01, first=first)
    run.check("reach", axis=[1, 0, 0], least=3.5)


@situation("slopes/slide from 65 degrees", "On a slope that is too steep the player slides down; hanging there is a trap.", "https://github.com/godotengine/godot/issues/83673", needs=("slope_limit",))
def slide(run):
    degrees = run.vary(65, 60, 70)
    incline(run, degrees, length=6)
    run.feet = (5.0, 3 * math.tan(math.radians(degrees)) + 0.9, 0.0)
    run.go(3.0)
    run.check("reach", axis=[0, -1, 0], least=-0.3)
    run.check("outside")


@situation("slopes/along the hillside", "Walking along a hillside keeps the height.", "https://github.com/NVIDIA-Omniverse/PhysX/issues/491")
def traverse(run):
    degrees = run.vary(35, 25, 40)
    slope = math.tan(math.radians(degrees))
    run.still.floor(-4, 24, -6, 6, nx=14, nz=6, height=lambda x, z: -z * slope)
    run.feet = (0.0, 0.12, 0.0)
    run.go(0.7)
    first = run.go(0.3, E)
    run.go(2.5, E)
    run.check("even", most=0.5, first=first)
    run.check("speed", way=E, least=5.0, most=6.4, first=first)


SNAP = dict(needs=("snap",))


@situation("ramps/down 25 degrees", "Running down a ramp must not become a row of little falls.", "https://github.com/jrouwe/JoltPhysics/blob/master/UnitTests/Physics/CharacterVirtualTests.cpp", **SNAP, down=25)
@situation("ramps/down 42 degrees", "Running down a steep ramp keeps the feet on it.", "https://github.com/jrouwe/JoltPhysics/blob/master/UnitTests/Physics/CharacterVirtualTests.cpp", **SNAP, down=42)
@situation("ramps/crest of 20 degrees", "Over a crest the player walks; it is no ski jump.", "https://github.com/jrouwe/JoltPhysics/issues/1988", **SNAP, up=20, down=20)
@situation("ramps/sharp ridge of 40 degrees", "A roof's ridge is walked over.", "https://github.com/jrouwe/JoltPhysics/issues/1988", **SNAP, up=40, down=40)
@situation("ramps/onto a landing", "At the upper end of a ramp the player walks on.", "https://github.com/godot-jolt/godot-jolt/issues/524", **SNAP, up=30, down=0)
def ramp(run, up=0, down=0):
    up, down = up * run.vary(1, 0.85, 1.05), down * run.vary(1, 0.85, 1.05)
    crest = 2 + 4 * (up > 0)
    top = 4 * math.tan(math.radians(up))
    foot = top - 6 * math.tan(math.radians(down))
    points = [(-6, 0), (2, 0)] + ([(crest, top)] if up else []) + [(crest + 6, foot), (40, foot)]
    run.still.path(points, -4, 4)
    rest = run.go(0.5) - 1
    last = run.go(3.0, E) - 1
    run.check("profile", points=points, rest=rest, below=0.25, above=0.08, first=rest, last=last)
    run.check("reach", axis=[1, 0, 0], least=crest + 4)
    run.check("forward", ticks=0)


@situation("ramps/foot of a ramp", "Where a floor meets a ramp the player must not stop.", "https://github.com/godot-jolt/godot-jolt/issues/524")
def foot(run):
    points = incline(run, run.vary(35, 20, 45))
    run.go(0.5)
    first = run.go(0.1, E)
    last = run.go(0.7, E) - 1
    run.check("smooth", way=E, fraction=0.3, ticks=0, first=first + 6, last=last)
    run.check("reach", axis=[1, 0, 0], least=2.6)


@situation("ramps/valley", "At the bottom of a valley the player walks on up.", "https://github.com/jrouwe/JoltPhysics/issues/696")
def valley(run):
    degrees = run.vary(35, 25, 40)
    drop = 4 * math.tan(math.radians(degrees))
    run.still.path([(-6, 0), (2, 0), (6, -drop), (10, 0), (30, 0)], -4, 4)
    run.go(0.5)
    run.go(4.0, E)
    run.check("reach", axis=[1, 0, 0], least=9.0)
    run.check("forward", ticks=0)


@situation("ramps/half pipe", "A gutter of many narrow strips is walked along as if it were smooth.", "https://github.com/jrouwe/JoltPhysics/blob/master/UnitTests/Physics/CharacterVirtualTests.cpp")
def half_pipe(run):
    strips = 192
    radius = run.vary(1.5, 1.0, 2.5)
    for i in range(strips):
        a, b = [math.pi * (1 + t / strips) for t in (i, i + 1)]
        p, q = (radius * math.sin(a) + radius, -radius * math.cos(a)), (radius * math.sin(b) + radius, -radius * math.cos(b))
        run.still.polygon((-3, p[0], p[1]), (24, p[0], p[1]), (24, q[0], q[1]), (-3, q[0], q[1]))
    run.feet = (0.0, 0.05, 0.0)
    run.go(0.7)
    first = run.go(0.3, E)
    run.go(2.5, E)
    run.check("speed", way=E, least=5.5, most=6.3, first=first)
    run.check("even", most=0.08, first=first)
    run.check("smooth", way=E, fraction=0.7, ticks=0, first=first)


def hill(run):
    waves = [(run.random.uniform(0.2, 0.45), run.random.uniform(0, 6), run.random.uniform(0, 2 * math.pi), run.random.uniform(0.3, 0.7)) for _ in range(4)]

    def height(x, z):
        return sum(a * math.sin(f * (x * math.cos(d) + z * math.sin(d)) + s) for a, s, d, f in waves)
    return height


@situation("hills/walk", "Terrain is what most games walk on: no stop, no hop.", "https://github.com/Facepunch/sbox-issues/issues/6368")
def hills(run):
    height = hill(run)
    run.still.floor(-6, 40, -10, 10, nx=92, nz=40, height=height)
    run.feet = (0.0, height(0, 0) + 0.2, 0.0)
    run.go(0.8)
    first = run.go(0.3, E)
    run.go(5.0, E)
    run.check("speed", way=E, least=4.8, most=6.4, first=first)
    run.check("smooth", way=E, fraction=0.4, ticks=0, first=first)


@situation("hills/rest", "A player who stops on terrain stands still.", "https://github.com/godotengine/godot/issues/85971")
def hills_rest(run):
    height = hill(run)
    run.still.floor(-6, 6, -6, 6, nx=24, nz=24, height=height)
    run.feet = (0.0, height(0, 0) + 0.2, 0.0)
    run.go(0.5)
    run.go(0.5, (0.6, 0.8))
    first = run.go(1.0)
    run.go(5.0)
    run.check("rest", creep=0.01, first=first)
