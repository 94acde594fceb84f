#!/usr/bin/env bash
# Runs the tests of collision and movement under valgrind's memcheck, and fails if memory is read that was never
# written or is not theirs: scripts/check_valgrind.sh [OPTION OF VALGRIND...], for example --track-origins=yes.
# A few minutes. The machine that valgrind shows to programs has no AVX-512, so the baseline and AVX2 are looked at.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${test_packages[@]}" valgrind
configure release
build release tests_collision tests_movement
# Left out, of collision: the 113-bit oracles (their arithmetic takes minutes, and is not the engine's), the two largest
# trees, and properties (RapidCheck reads what it never wrote when it shows an assertion's bool). Of movement: counts of
# allocations, for valgrind replaces `new` itself, and the longest runs, each as long as all the others together.
declare -A left_out=(
    [collision]='Families*:SweepAccuracy*:Construction.TheWholeRangeOfFloats:Construction.AllInOnePlace:SweepProperty.*'
    [movement]='Trace.WithoutASink*:PushOutCone.*DrivesInto*:PushOutCone.MorePlanes*:HalfPipe.Of768*:SeamFilter.NoBumpsIn*'
)
for floor in collision movement; do
    step "Testing $floor under valgrind" valgrind --quiet --error-exitcode=1 "$@" \
        "build/release/tests/tests_$floor" --gtest_brief=1 --gtest_filter="-${left_out[$floor]}"
done
