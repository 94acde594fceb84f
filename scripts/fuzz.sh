#!/usr/bin/env bash
# Builds the fuzzers of tests/fuzz with clang, AddressSanitizer and UndefinedBehaviorSanitizer, and runs them from
# their corpora: scripts/fuzz.sh [RUNS] [NAME...]
# Without names it runs all of them: sweep, obj, mtl, level and png, one after the other. The default is 2000 runs each,
# which takes a few minutes. A million runs of sweep take hours. Inputs that reach new code stay in
# build/fuzz/found/NAME and start the next run; one that breaks something is build/fuzz/found/NAME-crash-HASH.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
runs=${1:-2000}
if [[ ! $runs =~ ^[0-9]+$ ]]; then
    echo "usage: scripts/fuzz.sh [RUNS] [NAME...]" >&2
    exit 64
fi
[ $# -le 1 ] && set -- "$runs" sweep obj mtl level png
shift
for name in "$@"; do
    [ -f "tests/fuzz/fuzz_$name.cpp" ] || { echo "no tests/fuzz/fuzz_$name.cpp" >&2; exit 64; }
done
install_packages "${packages[@]}" clang libclang-rt-dev
[ -f build/fuzz/build.ninja ] || step "Configuring (fuzz)" cmake -B build/fuzz -G Ninja --log-level=WARNING \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release -DSLIPFACE_FUZZ=ON \
    -DSLIPFACE_SANITIZE=fuzzer-no-link,address,undefined -DSLIPFACE_EDITOR=OFF -DSLIPFACE_TESTS=OFF -DSLIPFACE_UNITY=ON
step "Building (fuzz)" cmake --build build/fuzz --target "${@/#/fuzz_}"
for name in "$@"; do
    mkdir -p "build/fuzz/found/$name"
    # Only the first folder is written to.
    step "Fuzzing ($name)" "build/fuzz/tests/fuzz/fuzz_$name" -runs="$runs" -verbosity=0 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/found/$name-" "build/fuzz/found/$name" "tests/fuzz/corpus/$name"
done
