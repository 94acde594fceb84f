#!/usr/bin/env python3
"""Compares a level with its glTF export, both as the program reads them: triangles, size, and triangles of each type.

    scripts/same_level.py PROGRAM LEVEL EXPORT
"""
import json
import pathlib
import subprocess
import sys


def info(level):
    return json.loads(subprocess.run([program, "info", level, "--json"], check=True, capture_output=True).stdout)


program, level, export = sys.argv[1:]
before, after = info(level), info(export)
differs = []
if before["triangles"] != after["triangles"]:
    differs.append(f"{before['triangles']} triangles became {after['triangles']}")
for side in "min", "max":
    largest = max(1.0, *(abs(x) for x in before["bounds"][side]))
    if any(abs(a - b) > 2e-5 * largest for a, b in zip(before["bounds"][side], after["bounds"][side])):
        differs.append(f"bounds {side} {before['bounds'][side]} became {after['bounds'][side]}")
own = [name for name in before["triangles_per_type"] if name not in after["triangles_per_type"]]  # of the level alone
for name in before["triangles_per_type"]:
    counts = [report["triangles_per_type"].get(name, 0) for report in (before, after)]
    if name == "default":  # what a reader gives to types that it does not have
        counts[0] += sum(before["triangles_per_type"][other] for other in own)
    if counts[0] != counts[1] and name not in own:
        differs.append(f"{counts[0]} triangles of {name} became {counts[1]}")
names = [sorted(before["objects"]), sorted(after["objects"])]
unnamed = pathlib.Path(before["level"]).stem  # the name of an object that has none
names[0] = sorted(name or unnamed for name in names[0])
if names[0] != names[1]:
    lost = [name for name in names[0] if name not in names[1]][:5]
    differs.append(f"{len(names[0])} objects became {len(names[1])}; lost {lost}")
print("; ".join(differs) or "read back the same")
sys.exit(1 if differs else 0)
