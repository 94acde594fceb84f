#!/usr/bin/env bash
# Installs what is missing, builds, and opens the editor: ./run.sh [LEVEL]
# Without a display it runs the same editor off-screen and writes pictures to out/.
set -euo pipefail
level=${1:+$(realpath -m -- "$1")}
cd "$(dirname "$0")"
. scripts/common.sh

install_packages "${packages[@]}"
configure program
build program slipface
say "Starting the editor"
exec build/release/editor/slipface "${level:-assets/levels/easy.obj}"
