#!/usr/bin/env bash
# build_web.sh [FOLDER]: the editor as a page: a folder of static files (default: out/web) for any file server, and slipface_bits
# for node. Needs Debian's emscripten, and downloads Dear ImGui's Debian source package, whose library is for the desktop alone.
# Takes a quarter of an hour on two processors the first time.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
install_packages "${packages[@]}" "${web_packages[@]}"
export NODE_PATH=/usr/share/nodejs # where Debian's emscripten finds acorn, whichever node runs it

# unpack_source PACKAGE FOLDER: a source package from where this machine's apt gets its packages. The list of sources is a private one, so
# that the system's needs no deb-src line.
unpack_source() {
    local apt=$PWD/build/apt package=$1 folder=$2 list
    mkdir -p "$apt"/{lists,cache/archives,parts} "$folder"
    for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
        case $list in
            *.sources) sed 's/^Types:.*/Types: deb-src/' "$list" > "$apt/parts/$(basename "$list")" ;;
            *.list) [ ! -f "$list" ] || sed -n 's/^deb[[:space:]]/deb-src /p' "$list" > "$apt/parts/$(basename "$list")" ;;
        esac
    done
    local options=(-q -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$apt/parts" -o "Dir::State::Lists=$apt/lists"
        -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=root)
    apt-get "${options[@]}" update
    (cd "$folder" && apt-get "${options[@]}" source --download-only "$package" && tar xf "$package"_*.orig.tar.*)
}

if ! ls -d build/web/imgui-*/ > /dev/null 2>&1; then
    step "Unpacking the sources of Dear ImGui" unpack_source imgui build/web
    cp build/web/imgui-*/misc/cpp/imgui_stdlib.* build/web/imgui-*/ # as Debian's package has it
fi
[ -f build/web/build.ninja ] || step "Configuring (web)" cmake --preset web --log-level=WARNING -Wno-dev
build web slipface_page slipface_bits
folder=${1:-out/web}
step "Writing the page to $folder" cmake --install build/web --prefix "$folder" --component page
for file in "$folder"/*; do
    printf '%-14s %9d bytes, %9d with gzip, %9d with brotli\n' "$(basename "$file")" "$(stat -c %s "$file")" \
        "$(gzip -9 < "$file" | wc -c)" "$(brotli -q 11 -c < "$file" | wc -c)"
done
echo "To try it: python3 -m http.server --directory $folder"
