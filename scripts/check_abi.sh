#!/usr/bin/env bash
# check_abi.sh [--approve]: compares the binary interfaces of libslipface-mover.so and libslipface.so (functions, sizes and offsets of structs)
# with the approved ones of the same SLIPFACE_INTERFACE, engine/{mover,c}/abi/NUMBER.abi, by abidiff. An incompatible change needs a new
# number and SONAME, whose interfaces --approve writes; so does it after functions were added.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${check_packages[@]}"
configure program
build program slipface_mover_shared slipface_c_shared
number=$(sed -n 's/^#define SLIPFACE_INTERFACE \([0-9]*\)$/\1/p' engine/mover/include/slipface.h)
headers=(--drop-private-types)
for option in "$@"; do [ "$option" = --approve ] || { echo "unknown option $option" >&2; exit 2; }; done
for name in mover/libslipface-mover c/libslipface; do
    library=build/release/engine/$name.so folder=engine/${name%/*}
    soname=$(objdump -p "$library" | awk '/SONAME/ {print $2}')
    [ "$soname" = "${name#*/}.so.$number" ] ||
        { echo "engine/mover/CMakeLists.txt: found the SONAME $soname, expected ${name#*/}.so.$number as SLIPFACE_INTERFACE says" >&2; exit 1; }
    approved=$folder/abi/$number.abi
    if [ "${1:-}" = --approve ]; then
        mkdir -p "${approved%/*}"
        abidw --headers-dir engine/mover/include "${headers[@]}" --no-corpus-path --no-comp-dir-path --no-show-locs --out-file "$approved" "$library"
        echo "Wrote $approved"
        continue
    fi
    [ -f "$approved" ] || { echo "there is no $approved: look at the change, then scripts/check_abi.sh --approve" >&2; exit 1; }
    if ! abidiff --headers-dir2 engine/mover/include "${headers[@]}" --no-show-locs "$approved" "$library"; then
        echo "$library differs from $approved. If programs built before still run, approve it (scripts/check_abi.sh --approve);" >&2
        echo "else raise SLIPFACE_INTERFACE and SOVERSION first." >&2
        exit 1
    fi
    echo "$library has the interface of $approved"
done
