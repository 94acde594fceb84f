"""Flat ground in many triangulations, lips, gaps, damaged meshes, and places far from the origin."""
import math

from geometry import Mesh
from situation import situation

E = (1.0, 0.0)
SNAG = "The player stumbles, or the camera jerks, on a floor that looks flat."


def walk_flat(run, seconds=3.0, even=0.015, least=5.8):
    """Walks along +X over ground that should be as good as flat."""
    run.go(0.5)
    first = run.go(0.5, E)
    last = run.go(seconds, E) - 1
    run.check("speed", way=E, least=least, most=6.2, first=first, last=last)
    run.check("smooth", way=E, fraction=0.8, ticks=0, first=first, last=last)
    run.check("even", most=even, first=first, last=last)
    run.check("stay", low=[None, -0.1, -0.1], high=[None, 0.2, 0.1], first=first, last=last)


@situation("flat/tiles", SNAG, "https://github.com/jrouwe/JoltPhysics/issues/1085")
def tiles(run):
    size = run.vary(0.25, 0.15, 0.6)
    run.still.floor(-2, -2 + 130 * size if size > 0.2 else 28, -3, 3, nx=130, nz=24)
    walk_flat(run)


@situation("flat/dense tiles", SNAG, "https://github.com/godotengine/godot/issues/102544")
def dense_tiles(run):
    run.still.floor(-1, 6, -0.8, 0.8, nx=140, nz=32)
    walk_flat(run, 0.4)


@situation("flat/T-junctions", SNAG, "https://github.com/avianphysics/avian/issues/612")
def t_junctions(run):
    x = -2.0
    while x < 26:
        wide = run.random.uniform(0.4, 1.1)
        run.still.floor(x, x + wide, -3, 3, nx=1, nz=run.random.randint(1, 14))
        x += wide
    walk_flat(run)


@situation("flat/unwelded tiles", "Level kits are seldom welded to the last digit, and the player must not feel it.", "https://github.com/godotengine/godot/issues/102544")
def unwelded(run):
    for i in range(-2, 26):
        for k in range(-2, 2):
            noise = [run.random.uniform(-1e-4, 1e-4) for _ in range(5)]
            run.still.floor(i + noise[0], i + 1 + noise[1], k + noise[2], k + 1 + noise[3], y=noise[4])
    walk_flat(run)


@situation("flat/two floors in one", "A floor that was pasted twice flickers in the picture; the player must not.", "https://github.com/jrouwe/JoltPhysics/issues/1085")
def doubled(run):
    run.still.floor(-2, 26, -3, 3, nx=40, nz=7)
    run.still.floor(-2.3, 26.2, -3.1, 3.2, nx=31, nz=5)
    walk_flat(run)


@situation("flat/boxes side by side", "Floors put together from boxes have walls inside, at which the player must not stop.", "https://github.com/jrouwe/JoltPhysics/issues/1085")
def boxes(run):
    wide = run.vary(1.0, 0.5, 1.6)
    for i in range(-2, math.ceil(26 / wide)):
        for k in (-1, 0):
            run.still.box((i * wide, -1, 2 * k), ((i + 1) * wide, 0, 2 * k + 2))
    walk_flat(run)


@situation("flat/overlapping boxes", "Floors of boxes that stand into each other are the usual way to build quickly.", "https://github.com/jrouwe/JoltPhysics/issues/1085")
def overlapping_boxes(run):
    x = -2.0
    while x < 26:
        wide = run.random.uniform(0.8, 2)
        run.still.box((x, run.random.uniform(-2, -1), -3), (x + wide, 0, 3))
        x += wide - run.random.uniform(0.1, 0.3)
    walk_flat(run)


@situation("slivers/long slivers", "Triangles of 2 cm by 30 m come from every boolean operation.", "https://github.com/dimforge/rapier/issues/748")
def long_slivers(run):
    run.still.floor(-2, 28, -2, 2, nx=1, nz=200)
    walk_flat(run)


@situation("slivers/across", "Triangles of 1 cm by 6 m across the way: each is a chance to stumble.", "https://github.com/dimforge/rapier/issues/748")
def across(run):
    run.still.floor(-2, 8, -3, 3, nx=1000, nz=1)
    run.still.floor(8, 26, -3, 3, nx=9, nz=3)
    walk_flat(run, 1.2)


@situation("slivers/thinner than a hair", "Slivers of 0.1 mm remain where two parts were cut to fit.", "https://github.com/dimforge/rapier/issues/748")
def hair(run):
    for i in range(-2, 26):
        run.still.floor(i, i + 0.9999, -3, 3, nz=5)
        run.still.floor(i + 0.9999, i + 1, -3, 3, nz=2)
    walk_flat(run)


@situation("dirty meshes/faces without area", "Exporters write triangles of two equal corners; the player must not die of a division by zero.", "https://github.com/bearlikelion/godot-box3d/issues/21")
def no_area(run):
    run.still.floor(-2, 26, -3, 3, nx=28, nz=6)
    for _ in range(60):
        a = (run.random.randint(-2, 26), 0.0, run.random.randint(-3, 3))
        b = (a[0] + 1, 0.0, a[2])
        run.still.polygon(a, b, a)
        run.still.polygon(a, a, a)
        run.still.polygon(a, b, (a[0] + 0.5, 0.0, a[2]))
    walk_flat(run)


@situation("dirty meshes/each face twice", "A mesh that was exported twice must play like one.", "https://github.com/jrouwe/JoltPhysics/issues/1085")
def twice(run):
    for _ in range(2):
        run.still.floor(-2, 26, -3, 3, nx=28, nz=6)
        run.still.box((3, 0, 0.7), (20, 3, 2))
    walk_flat(run)


@situation("dirty meshes/a face inside the floor", "A forgotten face that ends just below the floor must not trip the player.", "https://github.com/jrouwe/JoltPhysics/issues/1085")
def inside_floor(run):
    run.still.floor(-2, 26, -3, 3, nx=14, nz=3)
    for i in range(1, 20):
        x = i + run.vary(0.3, 0, 0.9)
        run.still.polygon((x, -0.001, -2), (x, -0.001, 2), (x, -1, 2), (x, -1, -2))
    walk_flat(run)


@situation("far/tiles", "Ten kilometres out the floor must be as smooth as at home.", "https://github.com/godotengine/godot/issues/75537", metres=10_000)
@situation("far/tiles at 1 km", "Open worlds are a kilometre wide before anybody thinks of the origin.", "https://github.com/godotengine/godot/issues/75537", metres=1_000)
def far_tiles(run, metres):
    run.offset = (metres, 0.0, metres * 0.7)
    run.still.floor(-2, 26, -3, 3, nx=56, nz=12)
    walk_flat(run, least=5.5)


@situation("far/rest", "A player who stands still far out must stand still.", "https://github.com/godotengine/godot/issues/75537")
def far_rest(run):
    run.offset = (run.vary(8_000, 4_000, 10_000), 0.0, -5_000)
    run.still.floor(-4, 4, -4, 4, nx=8, nz=8)
    first = run.go(1.0)
    run.go(4.0)
    run.check("rest", creep=0.005, first=first)


@situation("lips/1 mm", "Plates that differ by a millimetre are one floor to everybody who walks on them.", "https://github.com/momentum-mod/game/issues/2247", lip=0.001, above=0.008)
@situation("lips/5 mm", "A carpet's edge must not throw the player.", "https://github.com/momentum-mod/game/issues/2247", lip=0.005, above=0.008)
@situation("lips/20 mm", "A door sill must not stop or throw the player.", "https://github.com/momentum-mod/game/issues/2247", lip=0.02, above=0.015)
@situation("lips/100 mm", "A kerb is walked over, not jumped at.", "https://github.com/dimforge/rapier.js/issues/291", needs=("steps",), lip=0.1, above=0.04)
def lips(run, lip, above):
    gap = run.vary(1.1, 0.9, 1.6)
    points = [(-3, 0)]
    for i in range(1, 10):
        y = lip if i % 2 else 0.0
        points += [(i * 2 * gap, points[-1][1]), (i * 2 * gap, y)]
    points.append((60, points[-1][1]))
    for (xa, y), (xb, _) in zip(points[::2], points[1::2]):
        run.still.box((xa, -1, -3), (xb, y, 3))
    rest = run.go(0.5) - 1
    first = run.go(0.4, E)
    last = run.go(2.5, E) - 1
    run.check("profile", points=points, rest=rest, below=0.03, above=above, first=first, last=last)
    run.check("speed", way=E, least=5.5, most=6.3, first=first, last=last)
    run.check("smooth", way=E, fraction=0.5, ticks=2, first=first, last=last)


@situation("gaps/plank bridge", "The player must walk over the gaps between planks, not hop over them or drop into them.", "https://github.com/jrouwe/JoltPhysics/issues/1085", plank=0.3, gap=0.1)
@situation("gaps/wide gaps", "A gap that the body does not fit through is no hole.", "https://github.com/jrouwe/JoltPhysics/issues/1085", plank=1.2, gap=0.25)
@situation("gaps/grating", "A grating carries.", "https://github.com/godotengine/godot/issues/75399", plank=0.05, gap=0.05)
def bridge(run, plank, gap):
    gap *= run.vary(1.0, 0.7, 1.1)
    run.still.box((-3, -0.3, -2), (1, 0, 2))
    x = 1 + gap
    while x < 16:
        run.still.box((x, -0.1, -2), (x + plank, 0, 2))
        x += plank + gap
    run.still.box((x, -0.3, -2), (26, 0, 2))
    rest = run.go(0.5) - 1
    first = run.go(0.4, E)
    last = run.go(2.0, E) - 1
    run.check("speed", way=E, least=5.4, most=6.3, first=first, last=last)
    run.check("profile", points=[(-3, 0), (26, 0)], rest=rest, below=0.06, above=0.03, first=first, last=last)


@situation("gaps/rest across", "A player who stops on a grating stays there.", "https://github.com/godotengine/godot/issues/75399")
def rest_on_gap(run):
    half = run.vary(0.1, 0.05, 0.14)
    run.still.box((-5, -0.3, -3), (-half, 0, 3))
    run.still.box((half, -0.3, -3), (5, 0, 3))
    run.feet = (run.vary(0.03, -0.05, 0.05), 0.05, 0.0)
    first = run.go(1.0)
    run.go(3.0)
    run.check("rest", creep=0.01, first=first)
    run.check("stay", low=[-0.3, -0.15, -0.1], high=[0.3, 0.15, 0.1])


@situation("rubble/field", "Rubble slows no hero down to nothing, and it must not trap.", "https://github.com/dimforge/bevy_rapier/issues/520", needs=("steps",))
def rubble(run):
    run.still.floor(-3, 40, -6, 6, nx=20, nz=6)
    for _ in range(700):
        x, z, angle = run.random.uniform(1, 24), run.random.uniform(-5, 5), run.random.uniform(0, math.pi)
        w, d, h = run.random.uniform(0.1, 0.5), run.random.uniform(0.1, 0.5), run.random.uniform(0.02, 0.16)
        c, s = math.cos(angle), math.sin(angle)
        tilt = run.random.uniform(-0.2, 0.2)
        stone = Mesh().box((-w, -0.2, -d), (w, h, d)).moved(lambda p: (x + c * p[0] + s * p[2], p[1] + tilt * p[0], z + c * p[2] - s * p[0]))
        run.still.positions, run.still.triangles = run.still.positions + stone.positions, run.still.triangles + [
            tuple(i + len(run.still.positions) for i in t) for t in stone.triangles]
    run.go(0.5)
    run.go(6.5, E)
    run.check("reach", axis=[1, 0, 0], least=25)
    run.check("forward", ticks=8)
    run.check("stay", low=[None, -0.2, -6.5], high=[None, 1.2, 6.5])
    run.check("outside")


@situation("rubble/rest", "A player who stops on rubble must not twitch or creep.", "https://github.com/godotengine/godot/issues/32182", keep="")
def rubble_rest(run):
    height = {}
    for i in range(-8, 9):
        for k in range(-8, 9):
            height[i, k] = run.random.uniform(0, 0.1)
    run.still.floor(-2.4, 2.4, -2.4, 2.4, nx=16, nz=16, height=lambda x, z: height[round(x / 0.3), round(z / 0.3)])
    run.feet = (0.1, 0.3, 0.05)
    first = run.go(1.5)
    run.go(3.0)
    run.check("rest", creep=0.01, first=first)
    run.check("stay", low=[-0.6, -0.1, -0.6], high=[0.6, 0.35, 0.6])
