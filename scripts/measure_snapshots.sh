#!/usr/bin/env bash
# What checking costs beyond rasterising: 200 pictures of 1280x720 around a level, in as many processes as given.
#     scripts/measure_snapshots.sh [PROGRAM] [LEVEL] [PICTURES] [JOBS]
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/editor/slipface}") level=$(realpath "${2:-assets/levels/easy.obj}")
pictures=${3:-200} jobs=${4:-2}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/screenshots"
cat > "$scratch/screenshots/scenes.json" <<JSON
{ "version": 1, "defaults": { "size": [1280, 720], "style": "textured overlay" },
  "scenes": [ { "name": "scale/turn", "level": "$level", "cameras": ["auto:turntable:$pictures"] } ] }
JSON
cd "$scratch"
env -u CI -u GITHUB_ACTIONS "$program" snapshot approve --jobs "$jobs" --quick | tail -1
for run in 1 2; do
    "$program" snapshot check --jobs "$jobs" --quiet --timing | grep rasteris
done
