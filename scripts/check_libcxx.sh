#!/usr/bin/env bash
# check_libcxx.sh: builds the engine and its tests with clang and libc++, which is what macOS has, runs them, and compares the bits
# with those of this system's compiler. In a bare Debian testing, because older releases of libc++ cannot read numbers
# (std::from_chars). Needs what scripts/check_bare.sh needs.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
. scripts/bare_system.sh

enter_own_mounts "$@"
make_bare_system testing
clone_into_bare /root/slipface
watch_bare "The engine with libc++" root /root/slipface "echo '==> Installing clang and libc++' &&
    apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get -q -y install clang libc++-dev libc++abi-dev cmake ninja-build \
        libeigen3-dev nlohmann-json3-dev libcli11-dev libfmt-dev libstb-dev libassimp-dev python3-glad googletest &&
    echo '==> Building' && cmake --preset libcxx && cmake --build --preset libcxx &&
    echo '==> Testing' && ctest --preset libcxx -j $(nproc) &&
    build/libcxx/tests/slipface_bits 1 >/tmp/bits"
configure release
build release slipface_bits
step "Comparing the bits of walkers" diff <(build/release/tests/slipface_bits 1) "$bare/tmp/bits"
say "libc++ passes the tests, with the same bits"
