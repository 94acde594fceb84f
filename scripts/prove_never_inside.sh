#!/usr/bin/env bash
# Random walkers through every shipped level and a generated hostile one, 10^8 steps in all, at 6 m/s and 60 Hz, at
# 20 m/s and 30 Hz, and sprinting at 60 m/s. Nobody may leave a closed level, pass a triangle or end inside one.
# Everything but the speed is as each level's own file sets it; the files of the hostile ones name no
# setting, which means basic_settings().
# docs/never-inside.md, "Evidence", sums it up. Usage: scripts/prove_never_inside.sh [STEPS] [SEED]
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
steps=${1:-100000000}
seed=${2:-1}
configure release
build release slipface slipface_generate_hostile >&2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
levels=(assets/levels/*.obj)
for number in 1 2 3; do
    build/release/assets/slipface_generate_hostile "$scratch/hostile-$number.obj" "$((seed + number))"
    printf '{"slipface": 1, "spawn": {"position": [0, 0, 0]}}\n' >"$scratch/hostile-$number.slipface.json"
    levels+=("$scratch/hostile-$number.obj")
done
seconds=60
failed=0
: >"$scratch/runs"
for regime in "6 1/60" "20 1/30" "60 1/60"; do
    read -r speed dt <<<"$regime"
    rate=${dt#1/}
    walkers=$((steps / 3 / ${#levels[@]} / (seconds * rate) + 1))
    for level in "${levels[@]}"; do
        name=$(basename "$level" .obj)
        echo "$name at $speed m/s, $rate Hz" >&2
        code=0
        report=$(build/release/editor/slipface audit "$level" --walkers "$walkers" --seconds "$seconds" --seed "$seed" \
            --speeds "$speed" --dt "$dt" --json 2>/dev/null) || code=$?
        # 1 is also what stuck walkers give, who break no promise; the report says which. Anything else is a failure.
        [ "$code" -le 1 ] || failed=1
        printf '%s' "$report" | python3 -c '
import json, sys
r = json.load(sys.stdin)
print(*sys.argv[1:], r["steps"], r["count_passed_through"] + r["count_left_level"], r["count_overlap"], r["count_stuck"], sep="\t")
sys.exit(1 if r["count_passed_through"] + r["count_left_level"] + r["count_overlap"] > 0 else 0)
' "$name" "$speed m/s, $rate Hz" >>"$scratch/runs" || failed=1
    done
done
# A row for each level; a regime whose audit broke off is a question mark.
python3 - "$scratch/runs" <<'PYTHON'
import sys
regimes = ["6 m/s, 60 Hz", "20 m/s, 30 Hz", "60 m/s, 60 Hz"]
levels, everything = {}, [0, 0, 0]
for line in open(sys.argv[1]):
    level, regime, *counts, stuck = line.rstrip("\n").split("\t")
    sums, by_regime = levels.setdefault(level, ([0, 0, 0], {}))
    for k, count in enumerate(map(int, counts)):
        sums[k] += count
        everything[k] += count
    by_regime[regime] = stuck
def print_row(name, sums, stuck):
    print(f"| {name} |", *(f"{count:,} |".replace(",", " ") for count in sums), *(f"{s} |".lstrip() for s in stuck))
print("| level | steps | escapes | overlaps | stuck at " + " | ".join(regimes) + " |")
print("|---|" + "---:|" * 6)
for name, (sums, stuck) in levels.items():
    print_row(name, sums, [stuck.get(regime, "?") for regime in regimes])
print_row("all", everything, ["", "", ""])
PYTHON
exit "$failed"
