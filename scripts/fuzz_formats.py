#!/usr/bin/env python3
"""Damages files of other programs' formats and opens each with the program: it must read or refuse it, never crash or hang.

    scripts/fuzz_formats.py [--program build/release/editor/slipface] [--files 2000] [--seed 1] [--table FILE] [FOLDER...]

The originals are the models of Debian's package assimp-testmodels, or those below the folders. Each damaged file differs from its
original by one to eight changes: bytes flipped, removed, repeated, moved, or replaced by extreme text, numbers by others. Prints per format how the
files were answered, the most processor time and the most memory that one took, and the answers. Ends with 1 at a crash of the program,
an answer that is no sentence, 10 s of processor time beside the reader's own limit, or memory above the reader's limit. `--table` adds
the counts to those of earlier runs in FILE, so that many short runs make a long one.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading

ENDINGS = ".fbx .dae .glb .gltf .3ds .stl .ply .x .ac .off .lwo .obj .bsp".split()
EXTREMES = [b"-1", b"0", b"4294967295", b"1e38", b"nan", b"[" * 5000, b"{" * 5000, b"\xff\xff\xff\xff", b"\x00\x00\x00\x80"]
NUMBERS = [b"0", b"1", b"-1", b"2", b"3", b"65535", b"16777217", b"2147483647", b"4294967296", b"1e30", b"0.0001"]
NUMBER = re.compile(rb"(?<![\w.])-?\d+(\.\d+)?(?![\w.])")
LARGEST = 2_000_000  # bytes of an original


def damaged(data, draw):
    data = bytearray(data)
    for _ in range(draw.choice([1, 1, 1, 2, 4, 8])):
        at, length = draw.randrange(len(data) + 1), min(draw.choice([1, 2, 4, 16, 300]), len(data))
        kind = draw.randrange(7)
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
        elif kind == 4:
            data[at:at + draw.choice([0, 1, 4])] = draw.choice(EXTREMES)
        else:  # another number in the place of one: what is damaged so still parses
            number = NUMBER.search(data, at)
            if number:
                data[number.start():number.end()] = draw.choice(NUMBERS)
    return bytes(data)


def copy_neighbours(model, scratch, copied):
    """The small files beside a model, which it may refer to; each folder once."""
    folder = copied.setdefault(model.parent, scratch / str(len(copied)))
    if not folder.exists():
        folder.mkdir()
        for file in model.parent.iterdir():
            if file.suffix.lower() in (".bin", ".mtl") and file.stat().st_size < LARGEST:
                shutil.copy(file, folder)
    return folder


def run_program(command, limit_s):
    """Exit code (negative: the signal), the last line of stderr, processor seconds and peak of memory in MB, children included."""
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors, stdin=subprocess.DEVNULL)
        timer = threading.Timer(limit_s, process.kill)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        lines = errors.read().decode(errors="replace").strip().splitlines()
    return process.returncode, lines[-1] if lines else "", usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def kind_of(code, answer):
    if code == 0:
        return "read"
    for kind, part in [("memory", "of memory"), ("stack", "nested too deeply"), ("time", "of processor time"), ("crash", "crashes assimp")]:
        if part in answer:
            return kind
    return "refused"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/editor/slipface")
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--table")
    parser.add_argument("folders", nargs="*", default=["/usr/share/assimp/models"])
    given = parser.parse_args()
    models = sorted(p for folder in given.folders for p in pathlib.Path(folder).rglob("*")
                    if p.suffix.lower() in ENDINGS and p.is_file() and 0 < p.stat().st_size < LARGEST)
    if not models:
        print(f"skipped: no models below {given.folders} (Debian: assimp-testmodels)")
        return 0
    # Each format as often as the others, however many models it has.
    by_ending = collections.defaultdict(list)
    for model in models:
        by_ending[model.suffix.lower()].append(model)
    endings = sorted(by_ending)
    draw, answers, bad, copied = random.Random(given.seed), collections.Counter(), 0, {}
    table = {ending: collections.Counter() for ending in endings}
    with tempfile.TemporaryDirectory() as scratch:
        for number in range(given.files):
            ending = draw.choice(endings)
            model = draw.choice(by_ending[ending])
            file = copy_neighbours(model, pathlib.Path(scratch), copied) / ("damaged" + ending)
            data = damaged(model.read_bytes(), draw)
            file.write_bytes(data)
            code, answer, seconds, megabytes = run_program([given.program, "info", file], 600)
            megabytes_allowed = 2048 + 64 * len(data) / 2**20
            row = table[ending]
            row["files"] += 1
            row[kind_of(code, answer)] += 1
            row["cpu_s"], row["mb"] = max(row["cpu_s"], round(seconds, 1)), max(row["mb"], round(megabytes))
            answers[re.sub(r"[\d.]+", "N", answer.split(": ", 2)[-1])[:60] if code else "read"] += 1
            if code not in (0, 2) or (code == 2 and not answer.startswith("slipface: ")) or \
                    seconds > 20 + len(data) / 2**20 or megabytes > megabytes_allowed:
                bad += 1
                row["bad"] += 1
                kept = pathlib.Path(tempfile.gettempdir()) / f"fuzz-{given.seed}-{number}{ending}"
                kept.write_bytes(data)
                print(f"file {number} of {model}: exit code {code}, {seconds:.1f} s, {megabytes:.0f} MB: {answer}; kept as {kept}")
    if given.table:
        file = pathlib.Path(given.table)
        before = json.loads(file.read_text()) if file.exists() else {}
        for ending, row in before.items():
            mine = table.setdefault(ending, collections.Counter())
            for key, value in row.items():
                mine[key] = max(mine[key], value) if key in ("cpu_s", "mb") else mine[key] + value
        file.write_text(json.dumps(table, indent=1, sort_keys=True))
    columns = "files read refused memory stack time crash bad cpu_s mb".split()
    print("| format | " + " | ".join(columns) + " |\n|---|" + "---:|" * len(columns))
    for ending in sorted(table):
        print(f"| {ending[1:]} | " + " | ".join(str(table[ending][column]) for column in columns) + " |")
    for answer, count in answers.most_common(40):
        print(f"{count:7d}  {answer}")
    print(f"{given.files} files of {len(models)} models, seed {given.seed}: {bad} bad")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
