#!/usr/bin/env python3
"""Measures what the gate must forgive and what it must notice, on the scenes of a suite; docs/snapshots.md, "The gate", sums it up.

Noise: the same scenes with other processor features, threads, optimisation and the other GL library. Changes: each perspective
camera one millimetre to the side, and the self-test's mutations of every picture.

    scripts/measure_gate.py [--program build/release/editor/slipface] [--goldens screenshots] [--jobs 2] [--keep DIR]
"""
import argparse, collections, json, os, pathlib, shutil, subprocess, sys, tempfile

NOISE = [
    ("again", {}, []),
    ("no threads of the rasteriser's own", {"LP_NUM_THREADS": "0"}, []),
    ("8 threads", {"LP_NUM_THREADS": "8"}, []),
    ("shaders not optimised", {"GALLIVM_PERF": "nopt", "MESA_SHADER_CACHE_DISABLE": "1"}, []),
    ("EGL surfaceless", {}, ["--gl", "egl"]),
    ("processor without AVX-512 (`avx`)", {"GALLIUM_OVERRIDE_CPU_CAPS": "avx"}, []),
    ("processor without AVX and FMA (`sse4.1`)", {"GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1"}, []),
]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default="build/release/editor/slipface")
    parser.add_argument("--goldens", default="screenshots")
    parser.add_argument("--only", default="*")
    parser.add_argument("--jobs", default="2")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    work = pathlib.Path(arguments.keep or tempfile.mkdtemp(prefix="slipface-gate-"))
    suite = pathlib.Path(arguments.goldens) / "scenes.json"

    def slipface(*words, env=None):
        return subprocess.run([arguments.program, *words], capture_output=True, text=True, env={**os.environ, **(env or {})})

    def render(folder, suite_file=suite, env=None, options=()):
        if (work / folder).exists():
            return work / folder
        answer = slipface("snapshot", "render", "--suite", str(suite_file), "--only", arguments.only, "--out", str(work / folder),
                          "--jobs", arguments.jobs, "--quiet", *options, env=env)
        if answer.returncode != 0:
            sys.exit(f"{folder}: {answer.stdout}{answer.stderr}")
        return work / folder

    def diff(a, b):
        return json.loads(slipface("snapshot", "diff", str(a), str(b), "--json").stdout)

    base = render("base")
    names = sorted(str(path.relative_to(base))[:-5] for path in base.rglob("*.json"))
    print(f"{len(names)} scenes\n\n| rendered with | identical | same | largest difference | largest fraction of the allowed pixels | densest window (6 fail) |")
    print("|---|---|---|---|---|---|")
    for index, (what, env, options) in enumerate(NOISE):
        folder = render(f"noise-{index}", env=env, options=options)
        rows = [(name, diff(base / (name + ".png"), folder / (name + ".png"))) for name in names]
        fraction = max((row["differing"] / max(row["allowed"], 1), name) for name, row in rows)
        dense = max((row["densest"], name) for name, row in rows)
        print(f"| {what} | {sum(row['largest'] == 0 for _, row in rows)} | {sum(row['same'] for _, row in rows)} "
              f"| {max(row['largest'] for _, row in rows)} | {100 * fraction[0]:.0f} % ({fraction[1]}) | {dense[0]} ({dense[1]}) |")
        for name, row in rows:
            if not row["same"]:
                print(f"fails: {name}: {row['verdict']}", file=sys.stderr)

    def shifted(metres):
        scenes = {scene["name"]: scene for scene in json.loads(suite.read_text())["scenes"]}
        defaults = json.loads(suite.read_text()).get("defaults", {})
        moved = []
        for name in names:
            numbers = json.loads((base / (name + ".json")).read_text())
            camera, scene = numbers["camera"], dict(scenes.get(name) or scenes.get(name.split("@")[0]))
            if "fov_y" not in camera:
                continue
            for key in ("level", "tape"):
                if key in scene and not scene[key].startswith("demo:"):
                    scene[key] = str((suite.parent / scene[key]).resolve())
            scene.pop("cameras", None)
            side = [camera["target"][2] - camera["eye"][2], 0, camera["eye"][0] - camera["target"][0]]
            length = (side[0] ** 2 + side[2] ** 2) ** 0.5
            if length < 1e-9:  # a camera that looks straight down
                side, length = [1, 0, 0], 1
            move = lambda point: [p + metres * s / length for p, s in zip(point, side)]
            scene.update(name=name, camera={"eye": move(camera["eye"]), "target": move(camera["target"]),
                                            "fov_deg": camera["fov_y"] * 180 / 3.141592653589793})
            moved.append(scene)
        path = work / f"moved-{metres}.json"
        path.write_text(json.dumps({"version": 1, "defaults": defaults, "scenes": moved}))
        return path, [scene["name"] for scene in moved]

    print("\n| camera moved to the side by | scenes | noticed | fewest pixels beyond 2 levels | least of the densest windows |\n|---|---|---|---|---|")
    still, still_names = shifted(0)
    reference = render("moved-0", still)
    for metres in (0.001, 0.0001):
        path, moved_names = shifted(metres)
        folder = render(f"moved-{metres}", path)
        rows = [diff(reference / (name + ".png"), folder / (name + ".png")) for name in moved_names]
        print(f"| {1000 * metres:g} mm | {len(rows)} | {sum(not row['same'] for row in rows)} | {min(row['differing'] for row in rows)} "
              f"| {min(row['densest'] for row in rows)} |")

    answer = slipface("snapshot", "opengl", *[str(base / (name + ".png")) for name in names])
    wrong = collections.Counter(line.split(":")[0].strip() for line in answer.stdout.splitlines() if "WRONG" in line)
    print(f"\nSelf-test on every picture: {'all cases as expected' if not wrong else dict(wrong)}")
    if not arguments.keep:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
