#!/usr/bin/env bash
# Runs the same tapes through the gcc and the clang build and compares every hash.
set -euo pipefail
cd "$(dirname "$0")/.."
for tape in assets/tapes/*.tape; do
    level="assets/levels/$(basename "$tape" .tape | sed 's/-.*//').obj"
    gcc=$(build/release/editor/slipface simulate "$level" --tape "$tape" --json)
    clang=$(build/clang/editor/slipface simulate "$level" --tape "$tape" --json)
    if [ "$gcc" != "$clang" ]; then
        echo "$tape: gcc and clang differ" >&2
        diff <(echo "$gcc") <(echo "$clang") >&2
        exit 1
    fi
    echo "$tape: the same bits"
done
