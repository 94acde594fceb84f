#!/usr/bin/env python3
"""import slipface against the program's own answers: the same bits, and exceptions with a text for bad input.

    PYTHONPATH=build/release/engine/python tests/python/test_slipface.py PROGRAM LEVELS
"""
import contextlib
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy
import slipface

PROGRAM, LEVELS = sys.argv[1], pathlib.Path(sys.argv[2])
SQUARE = [[-5, 0, -5], [5, 0, -5], [5, 0, 5], [-5, 0, 5]], [[0, 2, 1], [0, 3, 2]]


def program(*words):
    return json.loads(subprocess.run([PROGRAM, *map(str, words), "--json"], capture_output=True, text=True).stdout)


def random_world(rng, count=300):
    at = rng.uniform(-4, 4, (count, 1, 3))
    positions = (at + rng.uniform(-1, 1, (count, 3, 3))).reshape(-1, 3)
    return slipface.World(positions, numpy.arange(3 * count).reshape(-1, 3), rng.integers(0, 8, count),
                          1 << rng.integers(0, 3, count))


class Crowds(unittest.TestCase):
    def test_one_stands_on_another_and_is_carried(self):
        world, settings = slipface.World(*SQUARE), [slipface.Settings("platformer")] * 2
        players = [world.player((0, 0.902, 0)), world.player((0, 3, 0))]
        for tick in range(120):
            players = world.step_crowd(players, settings, [(0, 0.5 if tick >= 60 else 0), (0, 0)])
        self.assertTrue(players[1].grounded)
        self.assertGreater(players[0].position[2], 1)
        self.assertAlmostEqual(players[1].position[2], players[0].position[2], 6)
        self.assertEqual(world.step_crowd(players[::-1], settings, [(0, 0)] * 2)[0].position,
                         world.step_crowd(players, settings, [(0, 0)] * 2)[1].position)

    def test_those_that_do_not_meet_step_alone(self):
        world, settings = slipface.World(*SQUARE), [slipface.Settings("platformer")] * 3
        players, wishes = [world.player((0.1 * i, 0.902, 0)) for i in range(3)], [(0, 1), (1, 0), (0, 0)]
        self.assertEqual([player.position for player in world.step_many(players, settings, wishes)],
                         [world.step(player, settings[0], wish).position for player, wish in zip(players, wishes)])

    def test_a_player_is_put_where_there_is_room(self):
        world, settings = slipface.World(*SQUARE), slipface.Settings("platformer")
        self.assertEqual(world.put_player(world.player((0, 3, 0)), settings, 1.0).position, (0, 3, 0))
        self.assertGreaterEqual(world.put_player(world.player((0, 0.5, 0)), settings, 1.0).position[1], 0.9)
        self.assertIsNone(world.put_player(world.player((0, 0.5, 0)), settings, 0.1))

    def test_lists_of_different_lengths_are_refused(self):
        world, settings = slipface.World(*SQUARE), slipface.Settings("platformer")
        with self.assertRaisesRegex(ValueError, "found 1 for 2 players"):
            world.step_crowd([world.player((0, 1, 0))] * 2, [settings], [(0, 0)] * 2)
        self.assertEqual(world.step_crowd([], [], []), [])


class Queries(unittest.TestCase):
    def test_many_sweeps_are_those_one_by_one(self):
        rng = numpy.random.default_rng(1)
        hit = 0
        for _ in range(5):
            world = random_world(rng)
            radii, starts = rng.uniform(0.1, 1, (200, 3)), rng.uniform(-4, 4, (200, 3))
            moves = rng.uniform(-4, 4, (200, 3))
            many = world.sweeps(radii, starts, moves)
            for i in range(200):
                one = world.sweep(radii[i], starts[i], moves[i])
                self.assertEqual(many["face"][i], -1 if one is None else one["face"])
                if one is None:
                    continue
                hit += 1
                self.assertEqual(many["t"][i], one["t"])
                self.assertEqual(tuple(many["normal"][i]), one["normal"])
                self.assertEqual(world.hits(radii[i], starts[i], moves[i])[0]["triangle"], one["triangle"])
        self.assertGreater(hit, 300)

    def test_sweeps_are_those_of_the_program(self):
        level = slipface.Level(str(LEVELS / "easy.obj"))
        rng = numpy.random.default_rng(2)
        starts, moves = rng.uniform(-15, 15, (100, 3)), rng.uniform(-9, 9, (100, 3))
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write("ox,oy,oz,dx,dy,dz\n")
            for row in numpy.hstack([starts, moves]):
                file.write(",".join(repr(float(x)) for x in row) + "\n")
            file.flush()
            answers = json.loads(subprocess.run([PROGRAM, "sweep", str(LEVELS / "easy.obj"), "--radii", "0.4,0.9,0.4", "--queries",
                                                 file.name, "--json"], capture_output=True, text=True).stdout)
        found = level.sweeps([0.4, 0.9, 0.4], starts, moves)
        rows = answers["sweeps"] if isinstance(answers, dict) else answers
        self.assertEqual(len(rows), 100)
        for i, row in enumerate(rows):
            self.assertEqual(bool(row["hit"]), found["face"][i] >= 0)
            if row["hit"]:
                self.assertEqual(row["t"], found["t"][i])

    def test_one_row_serves_for_all(self):
        world = slipface.World(*SQUARE)
        found = world.sweeps([0.5, 0.5, 0.5], [[0, 2, 0], [9, 2, 0]], [0, -4, 0])
        self.assertEqual(found["t"].tolist(), [0.375, 2.0])
        rays = world.rays([[0, 2, 0], [1, 3, 1]], [0, -1, 0])
        self.assertEqual(rays["t"].tolist(), [2.0, 3.0])

    def test_filters(self):
        world = slipface.World(*SQUARE, types=[1, 1], groups=[1, 2])
        down = dict(radii=(0.5, 0.5, 0.5), start=(0, 2, 0), move=(0, -4, 0))
        self.assertEqual(world.sweep(**down)["type"], "ice")
        self.assertIsNone(world.sweep(**down, ignore=["ice"]))
        self.assertIsNone(world.sweep(**down, groups=4))
        world.set_parameter("ice", "solid", False)
        self.assertIsNone(world.sweep(**down))


class Movement(unittest.TestCase):
    def test_a_tape_gives_the_hash_of_the_program(self):
        tape = LEVELS.parent / "tapes" / "easy.tape"
        tape = tape if tape.exists() else next(LEVELS.parent.glob("tapes/*.tape"))
        level_name = next(line.split()[1] for line in tape.read_text().splitlines() if line.startswith("level "))
        path = next(LEVELS.glob(level_name), LEVELS / "easy.obj")
        run = slipface.Level(str(path)).run(str(tape))
        report = program("simulate", path, "--tape", tape)
        self.assertEqual(f"{run.hash:016x}", report["hash"] if "hash" in report else report["end_hash"])
        self.assertEqual(run.ticks, report["ticks"])
        self.assertEqual(len(run.columns()["speed_mps" if "speed_mps" in run.columns() else "time_s"]), run.ticks)
        self.assertTrue(run.trace(0))
        try:
            import pandas  # noqa: F401
        except ImportError:
            return
        self.assertEqual(len(run.frame()), run.ticks)

    def test_a_player_walks_falls_and_jumps(self):
        world, settings = slipface.World(*SQUARE), slipface.Settings("platformer", walk_speed=4)
        player, trace = world.player((0, 0.902, 0)), []
        for _ in range(60):
            player = world.step(player, settings, wish=(1, 0), trace=trace)
        self.assertTrue(player.grounded)
        self.assertAlmostEqual(player.motion[0], 4.0, places=6)
        self.assertTrue({"sweep", "decision"} <= {record["kind"] for record in trace})
        player = world.step(player, settings, jump=True)
        self.assertGreater(player.velocity[1], 5)

    def test_buttons_reach_the_abilities(self):
        square = slipface.World(*SQUARE)
        settings = slipface.Settings("platformer", dash=True, crouch=True, dash_speed=12, dash_time=0.25)
        begin = square.step(square.player((0, 0.902, 0)), settings)
        self.assertTrue(begin.grounded)
        self.assertFalse(begin.crouched or begin.hanging or begin.wants_to_stand)
        low = square.step(begin, settings, buttons=["crouch"])
        self.assertTrue(low.crouched)
        self.assertAlmostEqual(low.position[1], 0.502, places=3)
        self.assertFalse(square.step(low, settings).crouched)
        fast = square.step(begin, settings, wish=(1, 0), buttons=["dash"])
        self.assertAlmostEqual(fast.motion[0], 12.0, places=6)
        self.assertAlmostEqual(fast.move_s, 0.25 - 1 / 60)
        jumped = square.step(square.step(begin, settings), settings, buttons=["jump"])
        self.assertGreater(jumped.velocity[1], 5)
        with self.assertRaises(ValueError):
            square.step(begin, settings, buttons=["dive"])

    def test_settings_by_name(self):
        settings = slipface.Settings("lecture", gravity=12)
        self.assertEqual(settings.gravity, 12.0)
        settings.max_slope = "50deg"
        self.assertAlmostEqual(settings["max_slope"], math.radians(50))
        settings.push_out = "analytic"
        self.assertEqual(settings.push_out, "analytic")
        self.assertEqual(set(settings.keys()), set(slipface.settings))
        self.assertEqual(eval("slipface." + repr(settings)), settings)

    def test_audit_and_reach_are_those_of_the_program(self):
        path = LEVELS / "easy.obj"
        mine = slipface.Level(str(path)).audit(walkers=3, seconds=5, seed=4)
        self.assertEqual(mine["hash"], program("audit", path, "--walkers", 3, "--seconds", 5, "--seed", 4)["hash"])
        mine = slipface.Level(str(path)).reach(rounds=2)
        self.assertEqual(mine["hash"], program("reach", path, "--rounds", 2)["hash"])


class BadInput(unittest.TestCase):
    def test_raises_with_what_was_found(self):
        world, settings = slipface.World(*SQUARE), slipface.Settings()
        player = world.player((0, 0.902, 0))
        nan = float("nan")
        for wrong, kind, text in [
            (lambda: slipface.World([[0, 0]], [[0, 0, 0]]), ValueError, r"\(1, 2\)"),
            (lambda: slipface.World(SQUARE[0], [[0, 1, 9]]), ValueError, "9"),
            (lambda: slipface.World([[0, 0, nan]] * 3, [[0, 1, 2]]), ValueError, "finite"),
            (lambda: slipface.World(*SQUARE, types=[0]), ValueError, "length"),
            (lambda: slipface.World(*SQUARE, types=[0, 99]), ValueError, "99"),
            (lambda: slipface.Level("/no/such.obj"), ValueError, "no such"),
            (lambda: slipface.Settings("no-such-preset"), ValueError, "no-such-preset"),
            (lambda: slipface.Settings(gravty=3), AttributeError, "gravty"),
            (lambda: slipface.Settings(gravity=nan), ValueError, "gravity"),
            (lambda: slipface.Settings(gravity="much"), ValueError, "much"),
            (lambda: world.sweeps(numpy.ones((2, 3)), numpy.ones((3, 3)), [0, 1, 0]), ValueError, "lengths"),
            (lambda: world.sweeps([1, 1], [0, 0, 0], [0, 0, 1]), ValueError, r"\(2\)|\(2,\)"),
            (lambda: world.sweeps("a", "b", "c"), Exception, ""),
            (lambda: world.set_face_type(2, "ice"), IndexError, "below 2"),
            (lambda: world.set_face_type(0, "lava"), ValueError, "lava"),
            (lambda: world.set_parameter("ice", "friction", nan), ValueError, "friction"),
            (lambda: world.set_parameter("ice", "slipperiness", 1), ValueError, "slipperiness"),
            (lambda: world.step(player, settings, dt=0), ValueError, "dt"),
            (lambda: world.step(player, settings, wish=(nan, 0)), ValueError, "wish"),
            (lambda: world.player((0, nan, 0)), ValueError, "finite"),
            (lambda: world.step(None, settings), TypeError, ""),
            (lambda: world.sweep((nan, 1, 1), (0, 2, 0), (0, -4, 0)), ValueError, "radii"),
            (lambda: world.sweep((1, 0, 1), (0, 2, 0), (0, -4, 0)), ValueError, "radii.*above 0"),
            (lambda: world.hits((1, 1, 1), (0, 2, 0), (0, nan, 0)), ValueError, "move"),
            (lambda: world.sweeps([[1, 1, 1], [1, -1, 1]], [0, 2, 0], [0, -4, 0]), ValueError, "radii"),
            (lambda: world.rays([0, 2, 0], [0, 0, 0]), ValueError, "direction"),
            (lambda: world.rays([0, 2, 0], [0, 1, 0], max_t=nan), ValueError, "max_t"),
            (lambda: world.closest((0, nan, 0)), ValueError, "point"),
            (lambda: world.closest((0, 1, 0), -1), ValueError, "max_distance"),
            (lambda: world.overlaps((0, 1, 1), (0, 0, 0)), ValueError, "radii"),
        ]:
            with self.assertRaisesRegex(kind, text):
                wrong()

    def test_threads(self):
        rng = numpy.random.default_rng(3)
        world = random_world(rng, 2000)
        starts, moves = rng.uniform(-4, 4, (20000, 3)), rng.uniform(-4, 4, (20000, 3))
        wanted, answers, refused = world.sweeps([0.3] * 3, starts, moves)["t"], [], []

        def ask():
            answers.append(world.sweeps([0.3] * 3, starts, moves)["t"])

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            try:
                world.set_face_type(0, world.types[0])
            except RuntimeError as error:
                refused.append(str(error))
        for thread in threads:
            thread.join()
        self.assertTrue(all((answer == wanted).all() for answer in answers))
        self.assertEqual(len(answers), 4)
        self.assertLessEqual(set(refused), {"the world is in use by another thread"})


class Documents(unittest.TestCase):
    def test_examples_run(self):
        page = LEVELS.parent.parent / "docs" / "c-and-python.md"
        if not page.exists():
            self.skipTest("no source tree")
        names, printed = {}, io.StringIO()
        with contextlib.chdir(page.parent.parent), contextlib.redirect_stdout(printed):
            for text in re.findall(r"```python\n(.*?)```", page.read_text(), re.S):
                exec(compile(text, str(page), "exec"), names)
        self.assertEqual(len(printed.getvalue().splitlines()), 7, printed.getvalue())
        self.assertGreater(names["height"](), names["height"](variable_jump=True) + 0.1)
        self.assertGreater(names["floor"].mean(), 0.2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
