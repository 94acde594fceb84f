#!/usr/bin/env bash
# build_docs.sh [OUT]: builds README.md, docs/ and the public headers as a site of static pages in OUT, out/site if none is
# given, and checks its links. No page loads anything from elsewhere: open OUT/index.html, or put OUT on any web server.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

out=$(realpath -m -- "${1:-out/site}")
if [ -e "$out" ] && [ -n "$(ls -A "$out")" ] && [ ! -f "$out/search/search_index.json" ]; then
    echo "build_docs.sh: $out is neither empty nor a site, and building a site empties it" >&2
    exit 64
fi
install_packages "${docs_packages[@]}"
pages=$(mktemp -d)
trap 'rm -rf "$pages"' EXIT

# The pages lie as in the repository, so that one link serves both.
mkdir -p "$pages/docs/site/fonts"
ln -s "$PWD"/*.md "$PWD"/screenshots "$pages"
find "$PWD/docs" -mindepth 1 -maxdepth 1 ! -name site -exec ln -s -t "$pages/docs" {} +
ln -s "$PWD"/docs/site/{style.css,offline_search.js,try.js} "$PWD/editor/desktop/slipface.svg" "$pages/docs/site"
ln -s /usr/share/fonts/opentype/inter/Inter-{Regular,Italic,SemiBold}.otf "$pages/docs/site/fonts"
{ printf '# Licence\n\n'; cat LICENSE; } >"$pages/LICENSE.md"
ln -s "$PWD/NOTICES" "$pages/NOTICES.md"

{ cat docs/site/Doxyfile; echo "INPUT =" engine/*/include/slipface; echo "OUTPUT_DIRECTORY = $pages/doxygen"; } |
    (mkdir "$pages/doxygen" && doxygen -)
python3 docs/site/headers.py "$pages/doxygen/xml" "$pages"
rm -r "$pages/doxygen"
SLIPFACE_PAGES=$pages mkdocs build --quiet --clean --config-file docs/site/mkdocs.yml --site-dir "$out"
# With Slipface as a page (scripts/build_web.sh) the demos run beside their pictures.
[ ! -f out/web/index.html ] || cp -r out/web "$out/web"
scripts/check_links.py "$out"
