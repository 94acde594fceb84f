#!/usr/bin/env python3
"""judge_test.py SLIPFACE: the judge of the course with sabotaged runs. Slipface runs the course; then its positions are damaged in ways
in which a controller can be wrong, and every check of every situation must see at least one of them, and no check the run itself."""
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "course"))
import protocol  # noqa: E402
from engines import Engine  # noqa: E402
from judge import CHECKS, Positions, judge  # noqa: E402
from situation import make_course  # noqa: E402


def straight(run, feet):
    """Through everything: the stick moves the player as if there were no level."""
    at, made = list(run["load"]["feet"]), []
    for step in run["steps"]:
        for _ in range(step.get("repeat", 1)):
            for axis, wish in ((0, 0), (2, 1)):
                at[axis] += step["wish"][wish] * run["load"]["settings"]["walk_speed"] * step["dt"]
            made.append(list(at))
    return made


def changed(change):
    def sabotage(run, feet):
        start = run["load"]["feet"]
        return [change(tick, len(feet), feet, start) for tick in range(len(feet))]
    return sabotage


def add(x=0.0, y=0.0, z=0.0):
    return lambda t, n, feet, start: [feet[t][0] + x * (-1) ** t, feet[t][1] + y * (-1) ** t, feet[t][2] + z * (-1) ** t]


SABOTAGES = {
    "stands still": changed(lambda t, n, feet, start: feet[0]),
    "freezes half-way": changed(lambda t, n, feet, start: feet[min(t, n // 2)]),
    "goes through everything": straight,
    "falls through the floor": changed(lambda t, n, feet, start: [feet[t][0], feet[t][1] - max(0, t - 10) ** 2 * 0.01, feet[t][2]]),
    "flies": changed(lambda t, n, feet, start: [feet[t][0], feet[t][1] + max(0, t - 10) * 0.2, feet[t][2]]),
    "hovers": changed(lambda t, n, feet, start: [feet[t][0], feet[t][1] + 0.3, feet[t][2]]),
    "shakes sideways": changed(add(x=0.15, z=0.15)),
    "shakes the other way": changed(add(x=0.15, z=-0.15)),
    "shakes up and down": changed(add(y=0.1)),
    "is slow": changed(lambda t, n, feet, start: feet[t // 2]),
    "is fast": changed(lambda t, n, feet, start: [s + 3 * (f - s) for s, f in zip(start, feet[t])]),
    "creeps": changed(lambda t, n, feet, start: [feet[t][0] + 0.004 * t, feet[t][1], feet[t][2] + 0.004 * t]),
    "hops": changed(lambda t, n, feet, start: [feet[t][0], feet[t][1] + (0.7 if t % 37 in (9, 10) else 0.0), feet[t][2]]),
    "stumbles": changed(lambda t, n, feet, start: feet[t - t % 8]),
}


def expect_each_check_sees_something(course, engine):
    problems, seen = [], {}
    for run in course["runs"]:
        name = run["run"]
        answer = engine.run(run)
        if not judge(run, answer)["passed"]:
            continue  # of which the table says so
        damaged = {what: Positions(run, sabotage(run, answer["feet"])) for what, sabotage in SABOTAGES.items()}
        for check in run["about"]["checks"]:
            finds = [what for what, positions in damaged.items() if (check["kind"] != "outside" or what in ("goes through everything", "falls through the floor", "is fast"))
                     and not CHECKS[check["kind"]](positions, check)[0]]
            if not finds:
                problems.append(f"{name}: the check {check} sees none of {len(SABOTAGES)} sabotages")
            for what in finds:
                seen.setdefault(what, set()).add(run["about"]["situation"].split("/")[0])
        if judge(run, {"feet": [list(p) for p in damaged["falls through the floor"].world]})["passed"]:
            problems.append(f"{name}: a player that falls through the floor passes")
    families = {run["about"]["situation"].split("/")[0] for run in course["runs"]}
    for what in SABOTAGES:
        if what not in seen:
            problems.append(f"no check sees a player that {what}")
    judged_families = set().union(*seen.values())
    problems += [f"no check of the family {family} fails for any sabotage" for family in sorted(families - judged_families)]
    return problems


def expect_refusals(course):
    run = course["runs"][0]
    problems = []
    for what, answer in (("no answer", {"error": {"place": "/", "found": "x", "expected": "y"}}), ("too few ticks", {"feet": [[0, 0, 0]]}),
                         ("a position that is none", {"feet": [[math.nan, 0, 0]] * sum(s.get("repeat", 1) for s in run["steps"])})):
        if judge(run, answer)["passed"]:
            problems.append(f"{what} passes")
    broken = json.loads(json.dumps(course))
    broken["runs"][0]["load"]["meshes"][0]["triangles"][0][0] = 10**6
    broken["runs"][0]["steps"][0]["whish"] = [0, 1]
    found = protocol.course_problems(broken)
    if len(found) != 2 or "/runs/0/load/meshes/0/triangles/0/0" not in found[0] or "whish" not in found[1]:
        problems.append(f"the validator says {found}")
    if found := protocol.course_problems(course):
        problems.append(f"the validator refuses the course: {found[:3]}")
    return problems


def main(slipface, everything):
    seeds = [0, 1] if everything else [2]
    course = make_course(seeds)
    if make_course(seeds) != course:
        return ["the same seeds make another course"]
    if not everything:  # the shortest situations of each family
        chosen = {}
        for run in sorted(course["runs"], key=lambda r: sum(s.get("repeat", 1) for s in r["steps"]) * (1 + sum(len(m["triangles"]) for m in r["load"]["meshes"]))):
            chosen.setdefault(run["about"]["situation"].split("/")[0], []).append(run)
        course["runs"] = [run for runs in chosen.values() for run in runs[:2]]
    engine = Engine([slipface, "serve"])
    problems = expect_each_check_sees_something(course, engine) + expect_refusals(course)
    if code := engine.close():
        problems.append(f"serve ended with {code}")
    print(f"{len(course['runs'])} runs, {len(SABOTAGES)} sabotages")
    return problems + protocol.engine_problems([slipface, "serve"])


if __name__ == "__main__":
    found = main(sys.argv[1], "--all" in sys.argv)
    print("\n".join(found))
    sys.exit(1 if found else 0)
