#!/usr/bin/env bash
# compare_arm64.sh: builds slipface_bits for ARM64, runs it under qemu, and compares its hashes with those of this machine's
# processor. Takes a few minutes and installs a cross-compiler, qemu and mmdebstrap. The ARM64 libraries are unpacked into
# build/arm64-root, not installed.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${test_packages[@]}" g++-aarch64-linux-gnu qemu-user mmdebstrap

root=$PWD/build/arm64-root
if [ ! -e "$root/unpacked" ]; then
    rm -rf "$root"
    mkdir -p build
    options=()
    for file in /etc/apt/apt.conf.d/*; do options+=("--aptopt=$file"); done
    sources=$(find /etc/apt -maxdepth 2 -name '*.sources' -o -maxdepth 2 -name 'sources.list' -size +0 | head -1)
    # Only what the engine and the test link: no interpreter and no driver runs here.
    libraries=libc6-dev,libstdc++-12-dev,libfmt-dev,libassimp-dev,libdraco-dev,libeigen3-dev,nlohmann-json3-dev
    libraries+=,libtbb-dev,libdeflate-dev,libwebp-dev,libstb-dev,libgtest-dev,libgmock-dev,librapidcheck-dev
    step "Unpacking libraries for ARM64" mmdebstrap --architectures=arm64 --variant=extract --include="$libraries" \
        "${options[@]}" "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$root" "$sources"
    # Debian's CMake packages name their files by absolute paths, which here begin further down.
    grep -rlE '"/usr/(lib|include)' "$root/usr/lib/aarch64-linux-gnu/cmake" | xargs sed -i "s|\"/usr/|\"$root/usr/|g"
    touch "$root/unpacked"
fi
configure arm64
build arm64 slipface_bits
configure release
build release slipface_bits
scripts/compare_bits.sh release arm64
