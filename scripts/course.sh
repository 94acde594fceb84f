#!/usr/bin/env bash
# course.sh [NAME...]: runs the course (docs/course.md) with all controllers, or with those named (slipface jolt physx bullet babylon rapier
# three_octree three_mesh_bvh), and writes docs/course-table.md if all ran. Needs python3; node and npm for all but slipface and bullet,
# libbullet-dev and nlohmann-json3-dev for bullet. Answers and verdicts of each lie in out/course. SEEDS=7,8 chooses other runs.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
all=(slipface jolt physx bullet babylon rapier three_octree three_mesh_bvh)
names=("${@:-${all[@]}}")
slipface=${SLIPFACE:-build/release/editor/slipface}
out=out/course
mkdir -p "$out"

course/course.py make --seeds "${SEEDS:-0,1,2,3}" --out "$out/course.json"
for name in "${names[@]}"; do
    case $name in
        slipface) command=("$slipface" serve) ;;
        bullet)
            c++ -std=c++20 -O2 course/adapters/bullet.cpp $(pkg-config --cflags --libs bullet) -o "$out/bullet"
            command=("$out/bullet")
            ;;
        *)
            [ -d course/adapters/node_modules ] || npm ci --prefix course/adapters --no-audit --no-fund
            command=(node "course/adapters/$name.mjs")
            ;;
    esac
    course/course.py validate -- "${command[@]}" >"$out/$name.protocol" || { cat "$out/$name.protocol" >&2; exit 1; }
    course/examples.py "$name" -- "${command[@]}"
    course/course.py run "$out/course.json" --out "$out/$name.json" -- "${command[@]}"
    # A situation that fails is a result; a judge that says no result is an error.
    course/course.py judge "$out/course.json" "$out/$name.json" --all >"$out/$name.txt" ||
        tail -n 1 "$out/$name.txt" | grep -q ' passed, '
    printf '%-16s %s\n' "$name" "$(tail -n 1 "$out/$name.txt")"
done
if [ ${#names[@]} -eq ${#all[@]} ]; then
    course/course.py table "$out/course.json" $(printf "$out/%s.json " "${all[@]}") --out docs/course-table.md
fi
