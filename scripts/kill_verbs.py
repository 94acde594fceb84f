#!/usr/bin/env python3
"""Kills export, bake-light and name-materials (SIGKILL) at random moments: their files must be all old or all new.

    scripts/kill_verbs.py [--runs 100] [--seed 1] [--program build/release/editor/slipface]

Half of the moments lie anywhere in the run, the others in its last fifth, where files are written. Counts, for each verb, in how many
runs the files were all old, all new or a mixture directly after the kill, and after the next program had read the level or written the
files again; and the temporary files left after the next write. Ends with 1 if any mixture or temporary file is left.
"""
import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time


def floor(folder, side, height):
    """A level of side x side quads with four painted ones, a material library and a level file."""
    lines = ["mtllib floor.mtl", "usemtl stone"]
    lines += [f"v {i} {height if (i * j) % 7 == 0 else 0} {j}" for i in range(side + 1) for j in range(side + 1)]
    for i in range(side):
        for j in range(side):
            a = i * (side + 1) + j + 1
            lines.append(f"f {a} {a + 1} {a + side + 2} {a + side + 1}")
    (folder / "floor.obj").write_text("\n".join(lines) + "\n")
    (folder / "floor.mtl").write_text(f"newmtl stone\nKd {height} 0.5 0.5\n")


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file() and not is_temporary(p)}


def is_temporary(path):
    return path.name.startswith(".")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--side", type=int, default=60)
    parser.add_argument("--program", default="build/release/editor/slipface")
    given = parser.parse_args()
    program, draw, bad = str(pathlib.Path(given.program).resolve()), random.Random(given.seed), 0

    def run(*words, **options):
        return subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)

    print("| verb | runs | old | new | mixed at the kill | mixed after the next | left over |\n|---|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        for verb in ("export --obj", "export --gltf", "export, all three", "bake-light", "name-materials"):
            level, script = scratch / "level", scratch / "paint.script"
            states = {}
            for age, height in ("old", 0.25), ("new", 0.75):
                shutil.rmtree(level, ignore_errors=True)
                (level / "out").mkdir(parents=True)
                floor(level, given.side, height if verb.startswith("export") else 0.25)
                script.write_text('select faces 1-900\nreplace default ice\ncommand file.save\n')
                run("edit", level / "floor.obj", "--script", script)
                words = {"export --obj": ["export", level / "floor.obj", "--obj", level / "out/out.obj"],
                         "export --gltf": ["export", level / "floor.obj", "--gltf", level / "out/out.gltf"],
                         "export, all three": ["export", level / "floor.obj", "--flat", level / "out/out.flat", "--obj", level / "out/out.obj", "--gltf",
                                               level / "out/out.gltf"],
                         "bake-light": ["bake-light", level / "floor.obj", "--rays", "4", "--texel", "0.5"],
                         "name-materials": ["name-materials", level / "floor.obj"]}[verb]
                if age == "old" and verb == "bake-light":
                    run("bake-light", level / "floor.obj", "--rays", "1", "--texel", "0.7")
                if verb.startswith("export") or age == "new":
                    run(*words)
                states[age] = contents(level)
            if verb.startswith("export"):  # the level is the new one, its export the old
                states["old"] = {name: states["old" if name.startswith("out") else "new"][name] for name in states["new"]}
            assert states["old"] != states["new"], verb
            restore(level, states["old"])
            begin = time.monotonic()
            run(*words)
            whole = time.monotonic() - begin
            count = dict(old=0, new=0, mixed=0, after=0, left=0)
            for number in range(given.runs):
                restore(level, states["old"])
                process = subprocess.Popen([program, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(draw.uniform(0 if number % 2 else 0.8 * whole, 1.05 * whole))
                process.kill()
                process.wait()
                found = contents(level)
                state = next((age for age in states if found == states[age]), "mixed")
                count[state] += 1
                if state == "mixed":
                    run("info", level / "floor.obj")  # reads the level's folder
                    if verb.startswith("export"):
                        run("info", words[-1])
                    count["after"] += contents(level) not in states.values()
                run(*words)
                left = [p for p in level.rglob("*") if p.is_file() and is_temporary(p)]
                count["left"] += bool(left)
            bad += count["after"] + count["left"]
            print(f"| {verb} | {given.runs} | {count['old']} | {count['new']} | {count['mixed']} | {count['after']} | {count['left']} |", flush=True)
    return 1 if bad else 0


def restore(folder, files):
    shutil.rmtree(folder)
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


if __name__ == "__main__":
    sys.exit(main())
