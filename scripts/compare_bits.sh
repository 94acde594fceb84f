#!/usr/bin/env bash
# compare_bits.sh [BUILD...]: runs every demo and its walkers in each build under build/, on one thread and on four and with
# each of the processor's kernels, compares every hash, and prints a digest of them. Without arguments: all that are built of
# release (gcc -O2), clang (-O0), debug (gcc -O0), o3, clang-o3, asan, scalar and clang-scalar (Eigen without vector instructions, the latter
# at -O3), arm64 (under qemu, see compare_arm64.sh), web and web-plain (WebAssembly with and without vector instructions, in node, see
# compare_web.sh), windows (under wine, see check_windows.sh).
set -euo pipefail
cd "$(dirname "$0")/.."
builds=("$@")
if [ ${#builds[@]} -eq 0 ]; then
    for build in release clang debug o3 clang-o3 asan scalar clang-scalar arm64 web web-plain windows; do
        for ending in "" .js .exe; do
            [ ! -e "build/$build/tests/slipface_bits$ending" ] || builds+=("$build")
        done
    done
fi
if [ ${#builds[@]} -eq 0 ]; then
    echo "no build has slipface_bits: cmake --build --preset release --target slipface_bits" >&2
    exit 2
fi
first=""
compare() { # compare BUILD THREADS [KERNELS]: kernels that the processor lacks are its best ones again
    local runner=() program=build/$1/tests/slipface_bits
    case $1 in
        arm64) runner=(qemu-aarch64 -L build/arm64-root) ;;
        web*) runner=(node) program+=.js ;;
        windows) runner=(wine) program+=.exe ;;
    esac
    local name="$1, $2 threads${3:+, $3}" hashes
    hashes=$(SLIPFACE_SIMD=${3:-} "${runner[@]}" "$program" "$2")
    if [ -z "$first" ]; then
        first=$hashes
        first_name=$name
    elif [ "$hashes" != "$first" ]; then
        echo "$name differs from $first_name" >&2
        diff <(echo "$first") <(echo "$hashes") >&2
        exit 1
    fi
    echo "$name: $(echo "$hashes" | wc -l) demos, the same bits, $(echo "$hashes" | sha256sum | cut -c 1-16)"
}
for build in "${builds[@]}"; do
    compare "$build" 1
    [[ $build == web* ]] || compare "$build" 4
done
for kernels in baseline avx2 avx512; do compare "${builds[0]}" 4 "$kernels"; done
