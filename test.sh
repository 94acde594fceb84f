#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test. Exits non-zero if any fails.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/common.sh

build_kib=1700000 # with the tests
install_packages "${packages[@]}" "${test_packages[@]}"
configure release
build release
step "Testing" ctest --preset release -j "$(nproc)"
