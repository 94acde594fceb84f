#!/usr/bin/env bash
# Builds with ThreadSanitizer and runs the tests of base and collision: batches and the tree's construction.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

configure tsan
build tsan tests_base tests_collision
step "Testing with ThreadSanitizer" ctest --preset tsan -j "$(nproc)" -R '^(base|collision)\.'
