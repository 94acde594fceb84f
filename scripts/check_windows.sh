#!/usr/bin/env bash
# check_windows.sh: builds the engine, the library for C, the command line and their tests for Windows with Debian's mingw-w64, runs
# the tests of what games stand on under wine, compares hashes, output and written files with this system's, and packs
# out/slipface-windows.zip. Takes about an hour on two processors the first time. Exit code: 0 fine, 1 a test failed or a byte
# differs.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${test_packages[@]}" "${windows_packages[@]}"
export WINEPREFIX=$PWD/build/wine WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml=;winemenubuilder.exe=d'

configure windows
build windows
configure release
build release slipface slipface_bits
mkdir -p "$WINEPREFIX"
step "Starting wine" wine wineboot --init
for name in tests_base tests_mesh tests_collision tests_movement slipface_example_c; do
    step "Running $name under wine" wine "build/windows/bin/$name.exe" --gtest_brief=1
done
step "Comparing the bits of walkers" scripts/compare_bits.sh release windows
step "Comparing them between the instruction sets" scripts/compare_bits.sh windows
step "Comparing the command line's output" scripts/compare_windows.sh

# The game of tests/consumer/movement: built against the installed engine, it prints its hash.
game() { ctest --test-dir "build/$1" -R '^install.movement_alone$' -V | grep -o 'at .* hash [0-9a-f]*'; }
compare_games() {
    local there here
    there=$(game windows)
    here=$(game release)
    echo "Windows: $there"$'\n'"Linux:   $here"
    [ "$there" = "$here" ]
}
step "Building a game with the mover" compare_games
step "Packing out/slipface-windows.zip" cmake --build build/windows --target package
say "All is as on Linux"
