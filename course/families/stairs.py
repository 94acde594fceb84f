"""Stairs up, down, aslant, fast, at several rates, along walls; and what is too high to be a stair."""
import math

from geometry import Mesh
from situation import situation

E = (1.0, 0.0)


def flight(run, count, rise, run_m, first_x=2.0, wide=4.0, down=False, landing=12.0):
    """Boxes; the ground line of the flight, and its top."""
    points = [(-6, 0), (first_x, 0)]
    run.still.box((-6, -8 if down else -1, -wide), (first_x, 0, wide))
    sign = -1 if down else 1
    for i in range(count):
        y = sign * rise * (i + 1)
        x0 = first_x + i * run_m
        x1 = x0 + run_m + (landing if i == count - 1 else 0)
        run.still.box((x0, -8 if down else -1, -wide), (x1, y, wide))
        points += [(x0, y), (x1, y)]
    return points, sign * rise * count


UP = dict(needs=("steps",))


@situation("stairs up/house", "Every house has them: 17 by 29 cm.", "https://github.com/godotengine/godot-proposals/issues/2751", **UP, rise=0.17, tread=0.29)
@situation("stairs up/steep", "As steep as a stair in a tower: 30 by 30 cm.", "https://github.com/jrouwe/JoltPhysics/blob/master/UnitTests/Physics/CharacterVirtualTests.cpp", **UP, rise=0.3, tread=0.3)
@situation("stairs up/narrow treads", "Ornamental steps of 10 by 15 cm: the body touches several at once.", "https://github.com/godotengine/godot/pull/114447", **UP, rise=0.1, tread=0.15)
@situation("stairs up/high and deep", "Temple steps just below the step height.", "https://github.com/dimforge/rapier.js/issues/291", **UP, rise=0.31, tread=0.7)
@situation("stairs up/fast", "A sprinting player must climb the stairs that a walking one climbs.", "https://github.com/godotengine/godot/pull/114447", **UP, rise=0.17, tread=0.29, speed=12.0)
@situation("stairs up/slow", "A gamepad's stick pushed a little must climb, too.", "https://github.com/godotengine/godot/pull/114447", **UP, rise=0.17, tread=0.29, stick=0.2)
@situation("stairs up/at 30 Hz", "The same stairs on a slow machine.", "https://github.com/jrouwe/JoltPhysics/issues/211", **UP, rise=0.2, tread=0.3, rate=30)
@situation("stairs up/at 144 Hz", "The same stairs on a fast screen.", "https://github.com/jrouwe/JoltPhysics/issues/211", **UP, rise=0.2, tread=0.3, rate=144)
@situation("stairs up/at 360 Hz", "Stairs that stop working at high rates are found by the players with the best machines.", "https://github.com/jrouwe/JoltPhysics/issues/211", **UP, rise=0.2, tread=0.3, rate=360)
@situation("stairs up/aslant at 30 degrees", "Nobody walks up stairs exactly straight.", "https://github.com/jrouwe/JoltPhysics/issues/2036", **UP, rise=0.2, tread=0.3, angle=30)
@situation("stairs up/aslant at 65 degrees", "Nearly along the steps: each must still be climbed.", "https://github.com/jrouwe/JoltPhysics/issues/2036", **UP, rise=0.2, tread=0.3, angle=65)
def up(run, rise, tread, speed=6.0, stick=1.0, rate=60, angle=0):
    rise, tread = rise * run.vary(1, 0.95, 1.05), tread * run.vary(1, 0.95, 1.08)
    run.dt, run.settings["walk_speed"] = 1 / rate, speed
    heading = math.radians(angle)
    count = 12
    wide = 4 + 2 * count * tread * math.tan(heading)
    points, top = flight(run, count, rise, tread, wide=wide)
    run.feet = (0.0, 0.02, wide / 2 if angle else 0.0)
    wish = (stick * math.cos(heading), -stick * math.sin(heading))
    rest = run.go(0.5) - 1
    way = (2 + count * tread + 1.5) / math.cos(heading)
    last = run.go(1.7 * way / (stick * speed) + 0.3, wish) - 1
    run.check("reach", axis=[1, 0, 0], least=2 + count * tread + 0.6)
    run.check("profile", points=points, rest=rest, below=0.08, above=0.06, first=rest, last=last)
    run.check("forward", ticks=3)


@situation("stairs up/along a wall", "At a banister's wall the stairs are climbed as in the middle.", "https://github.com/jrouwe/JoltPhysics/issues/2036", **UP)
def along_wall(run):
    points, top = flight(run, 12, 0.2, 0.3)
    run.still.wall([(12, -0.45), (-6, -0.45)], -1, 8, columns=9, rows=3)
    angle = math.radians(run.vary(15, 5, 30))
    run.go(0.5)
    run.go(2.6, (math.cos(angle), -math.sin(angle)))
    run.check("reach", axis=[1, 0, 0], least=6.5)
    run.check("forward", ticks=3)


@situation("stairs up/a ledge too high", "What is higher than the step height stops the player: else fences are none.", "https://github.com/jrouwe/JoltPhysics/issues/1876", ledge=0.45)
@situation("stairs up/a wall of 0.6 m", "A low wall stops the player.", "https://github.com/jrouwe/JoltPhysics/issues/1876", ledge=0.6,
           keep="the other side of the step height: a controller that climbs everything must not pass")
def too_high(run, ledge):
    run.still.floor(-6, 2, -4, 4, nx=8, nz=8)
    run.still.box((2, -1, -4), (8, ledge * run.vary(1, 1, 1.1), 4))
    angle = math.radians(run.vary(10, -30, 30))
    run.go(0.5)
    run.go(2.0, (math.cos(angle), math.sin(angle)))
    run.check("stay", low=[-1, -0.1, None], high=[1.85, 0.2, None])
    run.check("reach", axis=[1, 0, 0], least=1.4)


DOWN = dict(needs=("snap",))


@situation("stairs down/house", "A player who runs down stairs must run, not fly from edge to edge.", "https://github.com/jrouwe/JoltPhysics/issues/211", **DOWN, rise=0.17, tread=0.29)
@situation("stairs down/steep", "The stair of a tower, downwards.", "https://github.com/jrouwe/JoltPhysics/issues/1988", **DOWN, rise=0.3, tread=0.3)
@situation("stairs down/at 10 m/s", "A sprint down the stairs is where feet leave the ground first.", "https://github.com/jrouwe/JoltPhysics/issues/211", **DOWN, rise=0.17, tread=0.29, speed=10.0)
@situation("stairs down/at 30 Hz", "The same stairs on a slow machine.", "https://github.com/jrouwe/JoltPhysics/issues/211", **DOWN, rise=0.17, tread=0.29, rate=30)
@situation("stairs down/at 144 Hz", "The same stairs on a fast screen.", "https://github.com/jrouwe/JoltPhysics/issues/211", **DOWN, rise=0.17, tread=0.29, rate=144)
def down(run, rise, tread, speed=6.0, rate=60):
    rise, tread = rise * run.vary(1, 0.95, 1.05), tread * run.vary(1, 0.95, 1.08)
    run.dt, run.settings["walk_speed"] = 1 / rate, speed
    points, _ = flight(run, 14, rise, tread, down=True, landing=20)
    rest = run.go(0.5) - 1
    last = run.go((2 + 14 * tread + 3) / speed, E) - 1
    run.check("profile", points=points, rest=rest, below=0.08, above=0.1, first=rest, last=last)
    run.check("speed", way=E, least=0.8 * speed, most=1.1 * speed, first=rest + round(0.2 * rate), last=last)


@situation("stairs down/a drop is no stair", "Who walks off a ledge of a metre falls; he is not pulled down at once.", "https://github.com/jrouwe/JoltPhysics/issues/1988",
           keep="the other side of the snap: one that snaps everything must not pass")
def drop(run):
    height = run.vary(1.0, 0.7, 1.5)
    run.still.box((-6, -1, -4), (2, 0, 4))
    run.still.floor(2, 16, -4, 4, y=-height, nx=7, nz=4)
    run.go(0.5)
    first = run.go(0.4, E)
    last = run.go(1.2, E) - 1
    run.check("still", most=0.5, first=first, last=last)
    run.check("reach", axis=[0, -1, 0], least=height - 0.13)
    run.check("speed", way=E, least=5.0, most=6.4, first=first, last=last)
