#!/usr/bin/env bash
# clang-tidy over every source file, with the compile commands of the clang build.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files -z 'engine/*.cpp' 'editor/*.cpp' 'assets/*.cpp' |
    xargs -0 -P "$(nproc)" -n 4 clang-tidy-14 -p build/clang --quiet 2> >(grep -v 'warnings\? generated' >&2 || true)
