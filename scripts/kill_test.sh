#!/usr/bin/env bash
# Kills the editor (SIGKILL) at random moments and looks whether anything that it had said to be safe is lost:
# what was saved must be in the level file, what was autosaved must be offered for recovery. The moment is
# chosen by what the program says, plus a random moment after that, so that writes are hit too.
#   scripts/kill_test.sh [RUNS] [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-200}
slipface=${2:-build/release/editor/slipface}
[ -x "$slipface" ] || { echo "$slipface is not there. Build it: cmake --build --preset release --target slipface"; exit 64; }
slipface=$(realpath "$slipface")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

side=40 steps=60 # a floor of side x side quads; each step paints one of them
python3 - "$work" "$side" <<'PY'
import sys
folder, n = sys.argv[1], int(sys.argv[2])
with open(f"{folder}/floor.obj", "w") as obj:
    for i in range(n + 1):
        for j in range(n + 1):
            obj.write(f"v {i} 0 {j}\n")
    for i in range(n):
        for j in range(n):
            a = i * (n + 1) + j + 1
            obj.write(f"f {a} {a + 1} {a + n + 2} {a + n + 1}\n")
PY

# Paints step after step; says after each what is safe now. `how`: file.save or autosave.
make_script() {
    local how=$1
    for ((i = 1; i <= steps; i++)); do
        echo "select faces $i"
        echo "command edit.fill_selection"
        [ "$how" = save ] && echo "command file.save" || echo "autosave"
        echo "say \"safe $i\""
    done
    echo "wait 36000" # an orderly end would tidy up
}
make_script save >"$work/save.script"
make_script autosave >"$work/autosave.script"

painted() { "$slipface" info "$1" --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["painted_faces"])'; }

lost=0
for ((run = 1; run <= runs; run++)); do
    how=$([ $((run % 2)) = 0 ] && echo save || echo autosave)
    rm -rf "$work/run"
    mkdir -p "$work/run/state"
    cp "$work/floor.obj" "$work/run/"
    stop_at=$((1 + RANDOM % (steps - 1)))
    coproc "$slipface" edit "$work/run/floor.obj" --headless --script "$work/$how.script" --state "$work/run/state" 2>/dev/null
    pid=$COPROC_PID
    exec {said}<&"${COPROC[0]}" # bash closes its own copy when the program ends
    safe=0
    while [ "$safe" -lt "$stop_at" ] && read -r word number <&"$said"; do
        [ "$word" = safe ] && safe=$number
    done
    sleep "0.0$((RANDOM % 4))$((RANDOM % 10))"
    kill -KILL "$pid" 2>/dev/null || true
    # What it said before it died counts as well.
    while read -r word number <&"$said"; do [ "$word" = safe ] && safe=$number; done || true
    exec {said}<&-
    wait "$pid" 2>/dev/null || true
    if [ "$how" = autosave ]; then
        cat >"$work/recover.script" <<'S'
command file.recover
click "Recover/floor.obj/Recover"
expect no_widget "Recover/floor.obj/Recover"
expect dirty yes
command file.save
S
        "$slipface" edit --headless --script "$work/recover.script" --state "$work/run/state" >"$work/log" 2>&1 ||
            { echo "run $run: recovery failed: $(cat "$work/log")"; lost=$((lost + 1)); continue; }
    fi
    found=$(painted "$work/run/floor.obj") || found=0
    if [ "$found" -lt "$safe" ] || [ "$found" -gt $((safe + 1)) ]; then
        echo "run $run ($how): said that $safe edits are safe, found $found"
        lost=$((lost + 1))
    fi
    [ $((run % 20)) = 0 ] && echo "$run of $runs"
done
echo "$runs kills, $lost with a loss"
[ "$lost" = 0 ]
