#!/usr/bin/env bash
# clang-tidy with the compile commands of the clang build: scripts/check_tidy.sh [FOLDER...]
# Without folders over every source file, which takes most of an hour on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- engine editor assets
git ls-files -z "${@/%//*.cpp}" ":!engine/base/platform/windows_*" |
    xargs -0 -P "$(nproc)" -n 1 clang-tidy-14 -p build/clang --quiet 2> >(grep -v 'warnings\? generated' >&2 || true)
