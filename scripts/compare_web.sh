#!/usr/bin/env bash
# compare_web.sh: builds slipface_bits as WebAssembly, with and without vector instructions, runs it in node, and compares its
# hashes with those of this machine's processor.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${test_packages[@]}" "${web_packages[@]}"
export NODE_PATH=/usr/share/nodejs
for preset in web-plain web; do
    # The page alone needs Dear ImGui's sources, which scripts/build_web.sh unpacks.
    editor=OFF
    if ls -d "build/$preset"/imgui-*/ > /dev/null 2>&1; then editor=ON; fi
    step "Configuring ($preset)" cmake --preset "$preset" -DSLIPFACE_EDITOR=$editor --log-level=WARNING -Wno-dev
    build "$preset" slipface_bits
done
configure release
build release slipface_bits
scripts/compare_bits.sh release web-plain web
