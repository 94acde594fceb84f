#!/usr/bin/env bash
# check_packages.sh [SUITE]: builds the Debian packages of the current commit in a Debian (bookworm) that has nothing, asks lintian, installs
# them in another one, and tries there what they are for: the program draws a sample level off-screen, docs/engine.md's game
# builds against libslipface-dev with CMake and with pkg-config, the example in C runs, and so do the tests of the Python
# module. The packages are left in out/packages. Needs what scripts/check_bare.sh needs.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
. scripts/bare_system.sh

enter_own_mounts "$@"
suite=${1:-bookworm}
packages_folder=$PWD/out/packages
rm -rf "$packages_folder"
mkdir -p "$packages_folder"

apt="DEBIAN_FRONTEND=noninteractive apt-get -q -y"
(
    make_bare_system "$suite"
    clone_into_bare /build/slipface
    say "Building the packages"
    watch_bare "The package build" root /build/slipface "echo '==> Installing what building needs' &&
        apt-get update -q && $apt install build-essential lintian && $apt build-dep ./ &&
        echo '==> dpkg-buildpackage' && dpkg-buildpackage -us -uc -b"
    watch_bare lintian root /build "lintian --allow-root --fail-on error --tag-display-limit 0 *.changes"
    grep -E '^[EWI]: ' "$scratch/log" || echo "lintian has nothing to say"
    cp "$bare"/build/*.deb "$packages_folder"
)
(
    make_bare_system "$suite"
    mkdir -p "$bare/debs" "$bare/game"
    cp "$packages_folder"/*.deb "$bare/debs"
    cp tests/consumer/game.cpp tests/consumer/flat.cpp tests/consumer/CMakeLists.txt examples/c/walk.c tests/python/test_slipface.py "$bare/game"
    in_bare root / "useradd --create-home stranger && chown stranger /game"

    say "Trying the program"
    watch_bare "Installing slipface" root /debs "apt-get update -q && $apt install ./slipface_*.deb"
    watch_bare "The program" stranger /tmp 'slipface --version && level=$(slipface samples | head -n 1) &&
        test "${level#/usr/share/slipface/levels/}" != "$level" && slipface info "$level" &&
        slipface edit "$level" --headless --screenshot /tmp/editor.png && ls -l /tmp/editor.png &&
        test $(stat -c %s /tmp/editor.png) -gt 100000 && test -s /usr/share/man/man1/slipface-sweep.1.gz &&
        bash -c ". /usr/share/bash-completion/completions/slipface; COMP_WORDS=(slipface sim); COMP_CWORD=1; _slipface
            test \"\${COMPREPLY[*]}\" = simulate"'

    say "Building docs/engine.md's game"
    watch_bare "Installing libslipface-dev" root /debs \
        "$apt install ./libslipface-dev_*.deb ./libslipface1_*.deb ./libslipface-mover1_*.deb g++ cmake make pkg-config"
    watch_bare "The game" stranger /game 'level=/usr/share/slipface/levels/easy.obj &&
        cmake -S . -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build && build/game $level cmake.png &&
        c++ -std=c++20 -O1 game.cpp $(pkg-config --cflags --libs slipface-cpp) -o game && ./game $level pkgconfig.png &&
        cmp cmake.png pkgconfig.png && test $(stat -c %s cmake.png) -gt 30000 &&
        slipface export $level --flat level.flat && build/flat level.flat &&
        (cd /usr/include && find slipface -name "*.h" ! -path "*/glad/*" | sed "s/.*/#include <&>/") >all.cpp &&
        c++ -std=c++20 -fsyntax-only all.cpp $(pkg-config --cflags slipface-cpp) &&
        cc -std=c99 -pedantic -Wall -Werror walk.c $(pkg-config --cflags --libs slipface) -lm -o walk && ./walk &&
        cc -std=c99 walk.c -static $(pkg-config --cflags --static --libs slipface-mover) -o walk && ./walk'
    watch_bare "Installing python3-slipface" root /debs "$apt install ./python3-slipface_*.deb"
    watch_bare "The Python module" stranger /game 'python3 test_slipface.py /usr/bin/slipface /usr/share/slipface/levels'
)
say "The packages are good: $packages_folder"
