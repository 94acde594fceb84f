#!/usr/bin/env bash
# Builds with AddressSanitizer and UndefinedBehaviorSanitizer and runs the tests: scripts/check_sanitizers.sh [FLOOR...]
# Without floors every test there is, the program's and the editor's included, which takes half an hour on two cores;
# .ci/run names those that move a player.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

configure asan
build asan "${@/#/tests_}"
if [ $# -gt 0 ]; then set -- -R "^($(IFS='|'; echo "$*"))\."; fi
step "Testing with AddressSanitizer and UndefinedBehaviorSanitizer" ctest --preset asan -j "$(nproc)" "$@"
