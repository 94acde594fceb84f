#!/usr/bin/env bash
# check_web.sh: builds the editor as a page and uses it in a headless Chromium: opens, paints, undoes, saves, reloads, recovers, plays,
# probes, follows links; a full store, a closed tab, a second tab and lost graphics. Pictures are left in out/web-check.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
scripts/build_web.sh out/web
install_packages "${web_check_packages[@]}"
modules=build/web-check
[ -d "$modules/node_modules/playwright-core" ] || step "Installing playwright-core" npm install --silent --prefix "$modules" playwright-core
# Files that did not come with the page: those of a demo, written by the program of this machine.
strange=()
if [ -x build/release/editor/slipface ]; then
    rm -rf out/web-strange
    build/release/editor/slipface demo keep-energy --out out/web-strange > /dev/null
    strange=(out/web-strange)
fi
node web/check/check.mjs out/web out/web-check "$modules" "${strange[@]}"
