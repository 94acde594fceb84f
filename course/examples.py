#!/usr/bin/env python3
"""examples.py ENGINE -- COMMAND...: whether an adapter behaves as the documentation's own examples of its engine say. Only then do its
results count. Each example names its source; exit code 1 if one does not hold."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from engines import Engine  # noqa: E402
from geometry import Mesh, circle  # noqa: E402
from situation import Run  # noqa: E402


class Example(Run):
    def __init__(self, radius=0.4, height=1.8, **settings):
        super().__init__(0, "example")
        self.body = {"radius": radius, "height": height}
        self.settings.update(settings)

    def feet_of(self, engine):
        made = self.to_json(type("", (), {"name": "example", "says": "", "source": "", "needs": (), "game_code": False}), 0)
        made["load"]["body"] = self.body
        answer = engine.run(made)
        assert "feet" in answer, answer
        return answer["feet"]


def jolt_run(**settings):  # the body of CharacterVirtualTests
    return Example(0.3, 1.95, gravity=9.81, step_height=0.4, snap_distance=0.5, **settings)


def fall_from_2_m(run):
    run.still.floor(-5, 5, -5, 5)
    run.feet = (0, 2, 0)
    run.go(1.5)
    return lambda feet: abs(feet[-1][1]) < 0.12 and feet[5][1] > 1.8


def jolt_stairs(run):
    run.still.floor(-5, 0, -2, 2)
    for i in range(10):
        run.still.box((0.3 * i, -1, -2), (0.3 * i + (0.3 if i < 9 else 3), 0.3 * (i + 1), 2))
    run.feet = (-0.6, 0.02, 0)
    run.settings["walk_speed"] = 4.0
    run.go(0.2)
    run.go(1.5 * 3.6 / 4, (1, 0))
    return lambda feet: max(f[1] for f in feet) > 2.99


def jolt_turntable(run):
    run.still.floor(-30, 30, -30, 30, y=-10)
    rate = 2 * math.pi
    run.moving(Mesh().column(circle(64, 10), -1, 0), lambda t: ((0, 0, 0), rate * t))
    run.feet = (9, 0.0, 0)
    run.go(1.0)
    return lambda feet: all(abs(math.hypot(f[0], f[2]) - 9) < 0.3 and abs(f[1]) < 0.4 for f in feet)


def jolt_lift(run):
    run.still.floor(-30, 30, -30, 30, y=-10)
    run.moving(Mesh().box((-5, -1, -5), (5, 0, 5)), lambda t: ((0, 0.5 * min(t, 1.0), 0), 0))
    run.go(1.5)
    return lambda feet: abs(feet[-1][1] - 0.5) < 0.05


def slope(degrees, climbs, seconds=2.0):
    def make(run):
        rise = math.tan(math.radians(degrees))
        run.still.floor(-6, 1, -4, 4)
        run.still.floor(1, 9, -4, 4, height=lambda x, z: (x - 1) * rise)
        run.go(0.5)
        run.go(seconds, (1, 0))
        return (lambda feet: max(f[1] for f in feet) > 2 * rise) if climbs else (lambda feet: feet[-1][1] < 0.9)
    return make


def step(height, climbs):
    def make(run):
        run.still.floor(-6, 2, -4, 4)
        run.still.box((2, -1, -4), (9, height, 4))
        run.go(0.5)
        run.go(1.0, (1, 0))
        return (lambda feet: abs(feet[-1][1] - height) < 0.12) if climbs else (lambda feet: feet[-1][1] < 0.2)
    return make


def wall(run):
    run.still.floor(-6, 9, -4, 4)
    run.still.box((3, -1, -4), (4, 5, 4))
    run.go(0.5)
    run.go(1.5, (1, 0))
    return lambda feet: 2.4 < feet[-1][0] < 2.65 and abs(feet[-1][1]) < 0.12


def jump(run):
    run.still.floor(-6, 9, -4, 4)
    run.go(0.5)
    run.go(1.2, jump=True)
    return lambda feet: 1.2 < max(f[1] for f in feet) < 1.8 and abs(feet[-1][1]) < 0.12


def ride(run):
    run.still.floor(-30, 30, -30, 30, y=-10)
    run.moving(Mesh().box((-2, -1, -2), (2, 0, 2)), lambda t: ((max(0.0, t - 0.5), 0, 0), 0))
    run.go(2.0)
    return lambda feet: abs(feet[-1][0] - 1.5) < 0.2


EXAMPLES = {
    "slipface": [("docs/movement.md: walks up to a wall and stops", Example, wall), ("docs/movement.md: jumps 1.6 m", Example, jump),
                 ("docs/movement.md: is carried by a platform", Example, ride), ("docs/movement.md: climbs below max_slope", Example, slope(45, True))],
    "jolt": [("CharacterVirtualTests, FallingAndJumping: lands from 2 m at 0", jolt_run, fall_from_2_m),
             ("CharacterVirtualTests, WalkStairs: 10 steps of 0.3 m in 1.5 times the ideal time", jolt_run, jolt_stairs),
             ("CharacterVirtualTests, MovingOnSlope: 45 degrees of 50 are climbed", jolt_run, slope(45, True)),
             ("CharacterVirtualTests, MovingOnSlope: 55 degrees of 50 are not", jolt_run, slope(55, False)),
             ("CharacterVirtualTests, RotatingPlatform: a turn a second at 9 m keeps the circle", jolt_run, jolt_turntable),
             ("CharacterVirtualTests, MovingPlatformUp: 0.5 m/s", jolt_run, jolt_lift)],
    "physx": [("guide, Character Controllers: walls stop", Example, wall), ("guide, Step Offset: 0.3 m of 0.35 are climbed", Example, step(0.3, True)),
              ("guide, Step Offset: 0.8 m of 0.35 are not", Example, step(0.8, False)), ("guide, Slope Limit: 40 degrees of 50 are climbed", Example, slope(40, True)),
              ("guide, Slope Limit: 60 degrees of 50 are not", Example, slope(60, False)), ("guide, Behavior Callback: rides with eCCT_CAN_RIDE_ON_OBJECT", Example, ride)],
    "bullet": [("CharacterDemo: lands", Example, fall_from_2_m), ("CharacterDemo: walls stop", Example, wall), ("CharacterDemo: jumps", Example, jump),
               ("btKinematicCharacterController.h, step height: 0.3 m of 0.35 are climbed", Example, step(0.3, True))],
    "babylon": [("Character controller page: lands", Example, fall_from_2_m), ("Character controller page: jumps", Example, jump), ("Character controller page: walls stop", Example, wall),
                ("PhysicsCharacterController.maxSlopeCosine: 40 degrees of 50 are climbed", Example, slope(40, True)), ("averageSurfaceVelocity: is carried", Example, ride)],
    "rapier": [("control/character_controller.rs, test climb: 0.2 rad is climbed", Example, slope(11.5, True)),
               ("setMaxSlopeClimbAngle: 60 degrees of 50 are not climbed", Example, slope(60, False)),
               ("enableAutostep: 0.2 m of 0.35 are climbed", Example, step(0.2, True)), ("character controller page: walls stop", Example, wall)],
    "three_octree": [("games_fps: lands", Example, fall_from_2_m), ("games_fps: walls stop", Example, wall), ("games_fps: jumps", Example, jump)],
    "three_mesh_bvh": [("characterMovement: lands", Example, fall_from_2_m), ("characterMovement: walls stop", Example, wall), ("characterMovement: jumps", Example, jump)],
}


def main(name, command):
    engine = Engine(command)
    failed = []
    for says, make_run, make in EXAMPLES[name]:
        run = make_run()
        holds = make(run)
        feet = run.feet_of(engine)
        if not holds(feet):
            failed.append(f"{name}: {says}: ends at {[round(c, 3) for c in feet[-1]]}, rises to {max(f[1] for f in feet):.3f}")
    engine.close()
    print("\n".join(failed) or f"{name}: {len(EXAMPLES[name])} examples of its documentation hold")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in EXAMPLES or sys.argv[2] != "--":
        raise SystemExit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[3:]))
