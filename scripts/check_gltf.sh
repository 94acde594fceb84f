#!/usr/bin/env bash
# Exports levels as .gltf and .glb, validates them with Khronos' gltf-validator, and reads them back: same names of objects and
# materials, same number of faces of each type.
#   scripts/check_gltf.sh [PROGRAM] [LEVEL...]     # without levels: the shipped ones, and random ones
# gltf-validator comes from npm and is needed for this check only; NODE_PATH names its folder if it is already installed.
set -euo pipefail
cd "$(dirname "$0")/.."
slipface=$(realpath "${1:-build/release/editor/slipface}")
shift || true
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ -z "${NODE_PATH:-}" ]; then
    npm install --silent --no-save --prefix "$work/npm" gltf-validator
    export NODE_PATH=$work/npm/node_modules
fi
levels=("$@")
if [ ${#levels[@]} = 0 ]; then
    mkdir "$work/levels"
    python3 scripts/random_levels.py "$work/levels" 20
    levels=(assets/levels/*.obj assets/props/yard.obj "$work"/levels/*.obj)
fi
cat >"$work/validate.js" <<'JS'
const fs = require("fs"), path = require("path"), validator = require("gltf-validator");
const file = process.argv[2];
validator
    .validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file), maxIssues: 0,
        externalResourceFunction: uri => Promise.resolve(new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))),
    })
    .then(report => {
        const codes = {};
        for (const m of report.issues.messages) codes[m.code] = (codes[m.code] || 0) + 1;
        const { numErrors, numWarnings, numInfos } = report.issues;
        console.log(JSON.stringify({ numErrors, numWarnings, numInfos, codes }));
        process.exit(numErrors > 0 ? 1 : 0);
    });
JS
bad=0
for level in "${levels[@]}"; do
    for ending in gltf glb; do
        rm -rf "$work/out"
        mkdir "$work/out"
        if ! "$slipface" export "$level" --gltf "$work/out/out.$ending" >/dev/null 2>"$work/errors"; then
            echo "$level: $(tail -1 "$work/errors")"
            continue # what cannot be read cannot be exported
        fi
        report=$(node "$work/validate.js" "$work/out/out.$ending") || bad=$((bad + 1))
        same=$(python3 scripts/same_level.py "$slipface" "$level" "$work/out/out.$ending") || bad=$((bad + 1))
        echo "$(basename "$level") $ending: $report; $same"
    done
done
echo "${#levels[@]} levels: $bad bad"
[ "$bad" = 0 ]
