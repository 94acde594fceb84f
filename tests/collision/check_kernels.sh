#!/usr/bin/env bash
# Fails if code that is compiled for one instruction set holds a function that the linker may take for others
# (engine/collision/simd/isa.h): on a processor without it the program would end there. Arguments: the objects of the
# collision library.
set -euo pipefail
checked=0
for object; do
    case $object in
        *kernels_avx2*) isa=avx2 ;;
        *kernels_avx512*) isa=avx512 ;;
        *) continue ;;
    esac
    checked=$((checked + 1))
    if shared=$(nm --demangle --defined-only "$object" | grep -E '^[0-9a-f]+ [VWu] ' | grep -v "$isa::"); then
        echo "$object may lend to others:"
        echo "$shared"
        exit 1
    fi
done
[ $checked = 2 ] || { echo "$checked files of kernels; expected 2"; exit 1; }
