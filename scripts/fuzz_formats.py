#!/usr/bin/env python3
"""Damages files of other programs' formats and opens each with the program: it must answer or refuse, never crash or hang.

    scripts/fuzz_formats.py [--program build/release/editor/slipface] [--files 2000] [--seed 1] [FOLDER]

The originals are the models of Debian's package assimp-testmodels, or those below FOLDER. Each damaged file differs from its original
by one to eight changes: bytes flipped, removed, repeated, moved, or replaced by extreme numbers. Prints the answers and how often each
was given; ends with 1 at a crash of the program, an answer that is no sentence, or more than 10 s beside the reader's own limit.
"""
import argparse
import collections
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

ENDINGS = ".fbx .dae .glb .gltf .3ds .stl .ply .x .ac .off .lwo .obj".split()
EXTREMES = [b"-1", b"0", b"4294967295", b"1e38", b"nan", b"[" * 5000, b"{" * 5000, b"\xff\xff\xff\xff", b"\x00\x00\x00\x80"]


def damaged(data, draw):
    data = bytearray(data)
    for _ in range(draw.randint(1, 8)):
        at, length = draw.randrange(len(data) + 1), min(draw.choice([1, 2, 4, 16, 300]), len(data))
        kind = draw.randrange(5)
        if kind == 0:
            for i in range(at, min(at + length, len(data))):
                data[i] ^= 1 << draw.randrange(8)
        elif kind == 1:
            del data[at:at + length]
        elif kind == 2:
            data[at:at] = data[at:at + length] * draw.choice([1, 2, 50])
        elif kind == 3:
            other = draw.randrange(len(data) + 1)
            data[other:other + length] = data[at:at + length]
        else:
            data[at:at + draw.choice([0, 1, 4])] = draw.choice(EXTREMES)
    return bytes(data)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/editor/slipface")
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("folder", nargs="?", default="/usr/share/assimp/models")
    given = parser.parse_args()
    models = sorted(p for p in pathlib.Path(given.folder).rglob("*")
                    if p.suffix.lower() in ENDINGS and p.is_file() and 0 < p.stat().st_size < 2_000_000)
    if not models:
        print(f"skipped: no models below {given.folder} (Debian: assimp-testmodels)")
        return 0
    draw, answers, bad, slowest = random.Random(given.seed), collections.Counter(), 0, 0.0
    with tempfile.TemporaryDirectory() as scratch:
        for number in range(given.files):
            model = draw.choice(models)
            file = pathlib.Path(scratch) / ("damaged" + model.suffix.lower())
            file.write_bytes(damaged(model.read_bytes(), draw))
            begin = time.monotonic()
            run = subprocess.run([given.program, "info", file], capture_output=True, timeout=300)
            slowest = max(slowest, time.monotonic() - begin)
            errors = run.stderr.decode(errors="replace").strip().splitlines()
            answer = re.sub(r"[\d.]+", "N", errors[-1].split(": ", 2)[-1])[:60] if run.returncode else "read"
            answers[answer] += 1
            if run.returncode not in (0, 2) or (run.returncode == 2 and not errors[-1].startswith("slipface: ")):
                bad += 1
                print(f"file {number} of {model}: exit code {run.returncode}: {errors[-1:]}")
    for answer, count in answers.most_common(40):
        print(f"{count:7d}  {answer}")
    print(f"{given.files} files of {len(models)} models, seed {given.seed}: {bad} bad; slowest {slowest:.1f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
