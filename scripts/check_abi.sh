#!/usr/bin/env bash
# check_abi.sh [--approve]: compares the binary interface of libslipface.so (functions, sizes and offsets of structs) with the approved one of the
# same SLIPFACE_INTERFACE, engine/c/abi/NUMBER.abi, by abidiff. An incompatible change needs a new number and SONAME, whose interface
# --approve writes; so does it after functions were added.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${check_packages[@]}"
configure program
build program slipface_c
number=$(sed -n 's/^#define SLIPFACE_INTERFACE \([0-9]*\)$/\1/p' engine/c/include/slipface.h)
soname=$(objdump -p build/release/engine/c/libslipface.so | awk '/SONAME/ {print $2}')
[ "$soname" = "libslipface.so.$number" ] ||
    { echo "engine/c/CMakeLists.txt: found the SONAME $soname, expected libslipface.so.$number as SLIPFACE_INTERFACE says" >&2; exit 1; }
approved=engine/c/abi/$number.abi
if [ "${1:-}" = --approve ]; then
    mkdir -p "${approved%/*}"
    abidw --headers-dir engine/c/include --drop-private-types --no-corpus-path --no-comp-dir-path --no-show-locs \
        --out-file "$approved" build/release/engine/c/libslipface.so
    echo "Wrote $approved"
    exit 0
fi
[ -f "$approved" ] || { echo "there is no $approved: look at the change, then scripts/check_abi.sh --approve" >&2; exit 1; }
if ! abidiff --headers-dir2 engine/c/include --drop-private-types --no-show-locs "$approved" build/release/engine/c/libslipface.so; then
    echo "libslipface.so differs from $approved. If programs built before still run, approve it (scripts/check_abi.sh --approve);" >&2
    echo "else raise SLIPFACE_INTERFACE and SOVERSION first." >&2
    exit 1
fi
echo "libslipface.so has the interface of $approved"
