#!/usr/bin/env bash
# Fails if any source file is not as clang-format would write it. `scripts/check_format.sh --fix` writes it so.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
git ls-files -z '*.cpp' '*.h' | xargs -0 clang-format-14 "${mode[@]}"
