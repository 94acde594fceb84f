#!/usr/bin/env bash
# check_web.sh: builds the editor as a page and the documents with it, and uses both in a headless Chromium: opens, paints, undoes, saves,
# reloads, recovers, plays, probes, audits, follows links, takes dropped files and gives downloads; a full store, a closed tab, a second
# tab, lost graphics and a fine screen; pictures beside those of the program on this machine. Pictures are left in out/web-check.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
scripts/build_web.sh out/web
configure program
build program slipface
scripts/build_docs.sh out/web-site
install_packages "${web_check_packages[@]}"
modules=build/web-check
[ -d "$modules/node_modules/playwright-core" ] || step "Installing playwright-core" npm install --silent --prefix "$modules" playwright-core
failed=0
node web/check/check.mjs out/web out/web-check "$modules" build/release/editor/slipface || failed=1
node web/check/check_site.mjs out/web-site out/web-check "$modules" || failed=1
exit $failed
