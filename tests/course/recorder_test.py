#!/usr/bin/env python3
"""recorder_test.py SLIPFACE: the recorder for three.js with Rapier, as docs/recorded-runs.md shows it, records a walk of Rapier's own
character controller into a step where course/adapters has its packages, else of a body that only moves; `slipface why --run` reads it."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).parents[2]
recorder = re.search(r"```js\n(.*?)```", (root / "docs/recorded-runs.md").read_text(encoding="utf-8"), re.S)[1]
packages = root / "course/adapters/node_modules/@dimforge/rapier3d-compat"
walk_rapier = """
import RAPIER from '%s/dist/rapier.mjs';
await RAPIER.init();
const world = new RAPIER.World({ x: 0, y: -20, z: 0 });
world.createCollider(RAPIER.ColliderDesc.cuboid(20, 0.5, 20).setTranslation(0, -0.5, 0));
world.createCollider(RAPIER.ColliderDesc.cuboid(1, 0.5, 20).setTranslation(6, 0.5, 0));
const player = world.createRigidBody(RAPIER.RigidBodyDesc.kinematicPositionBased().setTranslation(0, 0.92, 0));
const collider = world.createCollider(RAPIER.ColliderDesc.capsule(0.5, 0.4), player);
const controller = world.createCharacterController(0.01);
world.step();
for (let i = 0; i < 120; ++i) {
    controller.computeColliderMovement(collider, { x: 0.1, y: -0.05, z: 0 });
    const by = controller.computedMovement(), at = player.translation();
    player.setNextKinematicTranslation({ x: at.x + by.x, y: at.y + by.y, z: at.z + by.z });
    world.step();
    record(player, { x: 1, z: 0 }, false, 1 / 60);
}
process.stdout.write(text(0.4, 1.8));
""" % packages
walk_body = """
for (let i = 0; i < 120; ++i) record({ translation: () => ({ x: Math.min(4.59, 0.1 * i), y: 0.9, z: 0 }) }, { x: 1, z: 0 }, false, 1 / 60);
process.stdout.write(text(0.4, 1.8));
"""
level = """g floor
v -20 0 -20
v -20 0 20
v 20 0 20
v 20 0 -20
f 1 2 3 4
g kerb
v 5 0 20
v 5 1 20
v 5 1 -20
v 5 0 -20
f 5 6 7 8
"""

with tempfile.TemporaryDirectory() as folder:
    folder = Path(folder)
    (folder / "level.obj").write_text(level)
    real = (packages / "dist/rapier.mjs").exists()
    (folder / "walk.mjs").write_text(recorder + (walk_rapier if real else walk_body))
    (folder / "run.csv").write_text(subprocess.run(["node", folder / "walk.mjs"], check=True, capture_output=True, text=True).stdout)
    run = subprocess.run([sys.argv[1], "why", folder / "level.obj", "--run", folder / "run.csv"], capture_output=True, text=True)
    print("Rapier:" if real else "a body:", run.stdout, run.stderr)
    if run.returncode != 0 or "stop): your controller loses 6.0 of 6.0 m/s" not in run.stdout or "`kerb`" not in run.stdout:
        sys.exit("expected a stop at the kerb")
