#!/usr/bin/env bash
# compare_bits.sh [BUILD...]: runs every demo and its walkers in each build under build/, on one thread and on four, and
# compares every hash. Without arguments: release (gcc -O2), clang, debug (-O0), o3 and clang-o3, as far as
# they are built.
set -euo pipefail
cd "$(dirname "$0")/.."
builds=("$@")
if [ ${#builds[@]} -eq 0 ]; then
    for build in release clang debug o3 clang-o3 asan; do
        if [ -x "build/$build/tests/slipface_bits" ]; then builds+=("$build"); fi
    done
fi
if [ ${#builds[@]} -eq 0 ]; then
    echo "no build has slipface_bits: cmake --build --preset release --target slipface_bits" >&2
    exit 2
fi
first=""
for build in "${builds[@]}"; do
    for threads in 1 4; do
        hashes=$("build/$build/tests/slipface_bits" "$threads")
        if [ -z "$first" ]; then
            first=$hashes
            name="$build, $threads"
        elif [ "$hashes" != "$first" ]; then
            echo "$build on $threads threads differs from $name" >&2
            diff <(echo "$first") <(echo "$hashes") >&2
            exit 1
        fi
        echo "$build, $threads threads: $(echo "$hashes" | wc -l) demos, the same bits"
    done
done
