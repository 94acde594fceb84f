#!/usr/bin/env bash
# 100 000 random commands of the table, and as many random changes of a document: undo and redo must lead through
# the same states again.
#   scripts/undo_test.sh [COUNT]
set -euo pipefail
cd "$(dirname "$0")/.."
tests=build/release/tests/tests_editor
[ -x "$tests" ] || { echo "$tests is not there. Build it: cmake --build --preset release --target tests_editor"; exit 64; }
SLIPFACE_FUZZ_COMMANDS=${1:-100000} "$tests" --gtest_filter='CommandFuzz.*'
