#!/usr/bin/env bash
# compare_windows.sh: runs the verbs of build/release and, under wine, those of build/windows on the shipped levels, on copies with
# the line ends of Windows, and in a folder whose name has letters of several alphabets. Compares every byte that they print and
# write. In messages a `\` between folders counts as `/`.
set -euo pipefail
cd "$(dirname "$0")/.."
export WINEPREFIX=${WINEPREFIX:-$PWD/build/wine} WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml=;winemenubuilder.exe=d'
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
linux() { "$linux" "$@"; }
windows() { wine "$windows" "$@"; }
linux=$PWD/build/release/editor/slipface windows=$PWD/build/windows/bin/slipface.exe
bad=0 count=0

# same NAME VERB ARGUMENT...: what both print, on both outputs, and their exit codes. An argument win:/x/y is Z:\x\y on Windows.
same() {
    local name=$1 system code backslashes=()
    shift
    for argument in "$@"; do
        case $argument in
            win:*) argument=${argument#win:} argument="Z:${argument//\//\\}" ;;
        esac
        backslashes+=("$argument")
    done
    for system in linux windows; do
        code=0
        case $system in
            linux) linux "${@#win:}" > "$scratch/$system" 2> "$scratch/$system.err" || code=$? ;;
            windows) windows "${backslashes[@]}" > "$scratch/$system" 2> "$scratch/$system.err" || code=$? ;;
        esac
        sed -i 's|Z:\\|/|g; s|\\|/|g' "$scratch/$system.err"
        echo "exit code $code" >> "$scratch/$system.err"
    done
    count=$((count + 1))
    if ! cmp -s "$scratch/linux" "$scratch/windows" || ! cmp -s "$scratch/linux.err" "$scratch/windows.err"; then
        echo "$name differs: slipface $*" >&2
        diff "$scratch/linux" "$scratch/windows" | head -5 >&2 || true
        diff "$scratch/linux.err" "$scratch/windows.err" | head -5 >&2 || true
        bad=1
    fi
}

cp -r assets "$scratch/plain"
cp -r assets "$scratch/crlf"
cp -r assets "$scratch/Höhle 洞窟 пещера"
find "$scratch/crlf" \( -name '*.obj' -o -name '*.mtl' -o -name '*.json' -o -name '*.tape' \) -exec sed -i 's/$/\r/' {} +
printf 'ox,oy,oz,dx,dy,dz\n' > "$scratch/queries.csv"
for i in $(seq -9 9); do printf '%s,9,%s.25,%s.5,-20,1\n' "$i" "$((-i))" "$i"; done >> "$scratch/queries.csv"
for folder in "$scratch/plain" "$scratch/crlf" "$scratch/Höhle 洞窟 пещера" "win:$scratch/plain"; do
    for name in easy hard island playground; do
        level=$folder/levels/$name.obj tape=$folder/tapes/$name-tour.tape
        same "simulate" simulate "$level" --tape "$tape" --csv
        same "simulate, the level file" simulate "$folder/levels/$name.slipface.json" --tape "$tape"
        same "sweep" sweep "$level" --radii 0.4,0.9,0.4 --queries "$scratch/queries.csv" --csv
        same "doctor" doctor "$level"
    done
    same "why" why "$folder/levels/easy.obj" --tape "$folder/tapes/easy-tour.tape" --json
done
cd "$scratch"
level="Höhle 洞窟 пещера/levels/easy.obj"
same "audit" audit "$level" --walkers 4 --seconds 20 --json
same "reach" reach "$level" --rounds 40 --json
same "a file that is missing" simulate "$level" --tape "Höhle/fehlt.tape"
same "an option that is none" simulate "$level" --nonsense
same "a verb without arguments" simulate
same "presets" preset
same "demos" demo

# Files that are written: the same bytes under the same names.
for system in linux windows; do
    mkdir -p "written/$system"
    cp -r "${level%%/*}" "written/$system/named"
    for arguments in "demo all --out OUT" "preset quake --out OUT/quake.json" "name-materials OUT/named/levels/easy.obj" \
        "export OUT/named/levels/easy.obj --obj OUT/Höhle.obj --gltf OUT/Höhle.glb --flat OUT/flat"; do
        code=0
        # shellcheck disable=SC2086 # the words of a command line
        $system ${arguments//OUT/written/$system} >> "written/$system/printed" 2>&1 || code=$?
        echo "exit code $code" >> "written/$system/printed"
    done
    sed -i 's|\\|/|g; s|written/[a-z]*|OUT|g' "written/$system/printed"
done
diff -r written/linux written/windows || bad=1
[ $bad -eq 0 ] || exit 1
echo "$count calls and $(find written/linux -type f | wc -l) written files: the same bytes on both systems"
