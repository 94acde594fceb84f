#!/usr/bin/env bash
# Paints a level, sends its OBJ through a real, headless Blender, and says what came of the paint.
# blender_round_trip.sh [PROGRAM]; needs Blender (apt-get install blender). Not part of ./test.sh.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/editor/slipface}
command -v blender >/dev/null || { echo "Blender is not installed: apt-get install blender" >&2; exit 2; }
[ -x "$program" ] || { echo "no $program: cmake --build --preset release --target slipface" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# trip NAME EDIT pure|edited: what Blender does between reading and writing the file; pure: nothing may be lost.
trip() {
    local folder=$scratch/$1
    mkdir -p "$folder"
    cp assets/levels/easy.obj assets/levels/easy.mtl assets/levels/easy.slipface.json "$folder"
    "$program" edit "$folder/easy.obj" --headless --script "$scratch/paint.script" >/dev/null
    cat >"$folder/trip.py" <<PYTHON
import bpy, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
path = sys.argv[sys.argv.index("--") + 1]
new = bpy.app.version >= (3, 3, 0)
def read():
    bpy.ops.wm.obj_import(filepath=path) if new else bpy.ops.import_scene.obj(filepath=path)
def write():
    bpy.ops.wm.obj_export(filepath=path) if new else bpy.ops.export_scene.obj(filepath=path)
read()
objects = [o for o in bpy.context.scene.objects if o.type == "MESH"]
bpy.context.view_layer.objects.active = objects[0]
$2
write()
PYTHON
    blender --background --factory-startup --python-exit-code 1 --python "$folder/trip.py" -- "$folder/easy.obj" \
        >"$folder/blender.log" 2>&1 || { tail -20 "$folder/blender.log" >&2; exit 1; }
    local result
    result=$("$program" info "$folder/easy.obj" 2>/dev/null | sed -n 's/^painted faces *//p')
    printf '%-44s %s\n' "$1" "$result"
    if [ "$3" = pure ] && ! grep -q ' 0 orphaned' <<<"$result"; then
        echo "a pure round trip lost faces" >&2
        exit 1
    fi
}

# Every face painted.
cat >"$scratch/paint.script" <<'SCRIPT'
command select.all
command brush.2
command edit.fill_selection
command file.save
SCRIPT

blender --version | head -1
trip "round trip" "" pure
trip "twice" "
write()
bpy.ops.wm.read_factory_settings(use_empty=True)
read()" pure
trip "triangulated" "
for o in objects:
    m = o.modifiers.new('t', 'TRIANGULATE')" edited
trip "sorted, one face extruded" "
import bmesh
o = objects[0]
b = bmesh.new(); b.from_mesh(o.data); b.faces.ensure_lookup_table()
f = max((f for f in b.faces if f.normal.z > 0.9), key=lambda f: f.calc_area())
r = bmesh.ops.extrude_discrete_faces(b, faces=[f])
bmesh.ops.translate(b, verts=list(r['faces'][0].verts), vec=(0, 0, 0.3))
b.faces.sort(key=lambda f: f.material_index); b.to_mesh(o.data)" edited
trip "every object subdivided once" "
for o in objects:
    m = o.modifiers.new('s', 'SUBSURF'); m.subdivision_type = 'SIMPLE'; m.levels = m.render_levels = 1" edited
