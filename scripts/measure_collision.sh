#!/usr/bin/env bash
# Prints what docs/sweep.md sums up (accuracy against a 113-bit oracle) and the tables of docs/performance-tables.md (speed beside Bullet 3,
# Embree 3, ODE and FCL). Usage: scripts/measure_collision.sh [QUERIES_A_FAMILY]; 84000 a family are a million queries, a few minutes.
# scripts/measure_collision.sh bench [--benchmark_filter=REGEX...] runs the Google Benchmark programs instead.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${test_packages[@]}" libbullet-dev libembree-dev libode-dev libfcl-dev
[ -f build/bench/build.ninja ] || step "Configuring (bench)" cmake -B build/bench -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" -DSLIPFACE_BENCH=ON -DSLIPFACE_TESTS=OFF -DSLIPFACE_EDITOR=OFF
if [ "${1:-}" = bench ]; then
    shift
    step "Building (bench)" cmake --build build/bench --target slipface_bench
    exec build/bench/bench/slipface_bench "$@"
fi
step "Building (bench)" cmake --build build/bench --target slipface_sweep_accuracy slipface_ratios
build/bench/bench/slipface_sweep_accuracy "${1:-84000}"
build/bench/bench/slipface_ratios
