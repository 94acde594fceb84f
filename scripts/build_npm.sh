#!/usr/bin/env bash
# build_npm.sh [--test]: npm/mover.wasm, the mover as WebAssembly, and npm/slipface-VERSION.tgz, ready for `npm publish`. Needs Debian's
# emscripten. With --test also its tests in node, and the tutorial that installs it.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${web_packages[@]}"
export NODE_PATH=/usr/share/nodejs # where Debian's emscripten finds acorn, whichever node runs it
[ -f build/npm/build.ninja ] || step "Configuring (npm)" cmake --preset npm --log-level=WARNING -Wno-dev
build npm slipface_npm
cp build/npm/npm/mover.wasm LICENSE NOTICES npm/
size=$(cat npm/mover.wasm npm/index.js | gzip -9 | wc -c)
echo "mover.wasm and index.js: $size bytes with gzip"
[ "$size" -lt 225000 ] || { echo "expected less than 225000 bytes" >&2; exit 1; }
[ "${1:-}" != --test ] || (cd npm && npm test --silent)
(cd npm && npm pack --silent)
[ "${1:-}" != --test ] || tests/site/tutorials_test.py npm/slipface-*.tgz . build/npm/tutorial
