#!/usr/bin/env bash
# check.sh SOURCE BUILD SCRATCH mover|all CC: installs libslipface-mover alone, or everything, and builds examples/c/walk.c by what
# pkg-config and CMake say and nothing else, with the shared and with the static library.
set -euo pipefail
source=$1 build=$2 scratch=$3 what=$4 cc=$5
rm -rf "$scratch"
mkdir -p "$scratch"
if [ "$what" = mover ]; then
    for part in base mover; do cmake --install "$build" --prefix "$scratch/prefix" --component $part > "$scratch/log"; done
    names=slipface-mover
else
    cmake --install "$build" --prefix "$scratch/prefix" > "$scratch/log"
    names="slipface-mover slipface"
fi
libraries=$(dirname "$(find "$scratch/prefix" -name libslipface-mover.so)")
export PKG_CONFIG_PATH=$libraries/pkgconfig

# The runtime of C and C++, and nothing else.
strange=$(readelf -d "$libraries/libslipface-mover.so" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
    awk '!/^(libstdc\+\+|libgcc_s|libm|libc|ld-linux[a-z0-9-]*)\.so\.[0-9]+$/')
[ -z "$strange" ] || { echo "libslipface-mover.so needs $strange" >&2; exit 1; }
strange=$(nm -D --defined-only "$libraries/libslipface-mover.so" | awk '$3 !~ /^slipface_/ {print $3}')
[ -z "$strange" ] || { echo "libslipface-mover.so exports $strange" >&2; exit 1; }

walk() { # walk PROGRAM: runs it and compares what it prints with the others
    LD_LIBRARY_PATH=$libraries "$1" > "$scratch/printed"
    if [ -f "$scratch/first" ]; then cmp "$scratch/first" "$scratch/printed"; else cp "$scratch/printed" "$scratch/first"; fi
}
for name in $names; do
    # shellcheck disable=SC2046
    $cc -std=c99 "$source/examples/c/walk.c" $(pkg-config --cflags --libs "$name") -lm -o "$scratch/shared"
    readelf -d "$scratch/shared" | grep -q "NEEDED.*lib$name\.so"
    walk "$scratch/shared"
done
mkdir "$scratch/cmake"
cat > "$scratch/cmake/CMakeLists.txt" << END
cmake_minimum_required(VERSION 3.25)
project(Walk C CXX)
find_package(Slipface REQUIRED COMPONENTS mover)
foreach(kind mover mover_static)
    add_executable(\${kind} "$source/examples/c/walk.c")
    target_link_libraries(\${kind} PRIVATE Slipface::\${kind} m)
endforeach()
END
cmake -S "$scratch/cmake" -B "$scratch/cmake/build" "-DCMAKE_PREFIX_PATH=$scratch/prefix" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON > "$scratch/log"
cmake --build "$scratch/cmake/build" > "$scratch/log"
walk "$scratch/cmake/build/mover"
walk "$scratch/cmake/build/mover_static"
# Where only the static libraries are.
rm "$libraries"/libslipface*.so*
for name in $names; do
    # shellcheck disable=SC2046
    $cc -std=c99 "$source/examples/c/walk.c" $(pkg-config --static --cflags --libs "$name") -o "$scratch/static"
    walk "$scratch/static"
done
# shellcheck disable=SC2046
$cc -static -std=c99 "$source/examples/c/walk.c" $(pkg-config --static --cflags --libs slipface-mover) -o "$scratch/alone"
walk "$scratch/alone"
echo "walked: $(head -1 "$scratch/first")"
