#!/usr/bin/env bash
# The real window by hand, all of it: every tooltip and every item of every menu at four sizes (tests/window), in
# real time, about a quarter of an hour. Writes pictures of it and a contact sheet.
#   scripts/by_hand_test.sh [OUT] [BUILD]
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
out=$(realpath -m "${1:-out/by-hand}")
test=$(realpath "${2:-build/release}/tests/tests_window")
install_packages xvfb xdotool imagemagick
rm -rf "$out"
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp assets/levels/easy.* "$work/"
cp -r assets/levels/textures "$work/"
result=0
SLIPFACE_WINDOW_WHOLE=1 SLIPFACE_WINDOW_PICTURES=$out SLIPFACE_WINDOW_LEVEL=$work/easy.obj "$test" || result=$?
montage "$out"/*.png -tile 5x -geometry 480x270+3+3 -background '#202226' "$out/contact-sheet.png"
echo "Pictures in $out"
exit $result
