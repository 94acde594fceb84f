#!/usr/bin/env python3
"""Tests the add-on for Blender: check.py PROGRAM [only], where `only` is part of a case's name, or "quick".

Runs itself inside a headless Blender, where each case makes a scene, assigns types and exports it. The faces that
Blender has, with their types, are written down there without the add-on; then Slipface must read the same types.
"""
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
CASES = []


def case(function):
    CASES.append(function)
    return function


# ---------------------------------------------------------------------------------------------------------------
# Inside Blender


def inside_blender(folder, only):
    import bpy

    sys.path.insert(0, os.path.join(ROOT, "assets", "blender"))
    import slipface_blender

    slipface_blender.register()
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    for function in CASES:
        if only in function.__name__ or (only == "quick" and "thousand" not in function.__name__):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            place = os.path.join(folder, function.__name__)
            os.makedirs(place, exist_ok=True)
            function(place)
            print("CASE", function.__name__)


def expect(good, what):
    if not good:
        raise AssertionError(what)


def new_object(name, corners, faces, materials=(), numbers=None):
    import bpy

    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    for material in materials:
        mesh.materials.append(material)
    if numbers:
        mesh.polygons.foreach_set("material_index", numbers)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def grid(name, columns, rows, at=(0, 0, 0), size=1.0, materials=(), numbers=None):
    corners = [(at[0] + size * i, at[1] + size * k, at[2]) for k in range(rows + 1) for i in range(columns + 1)]
    wide = columns + 1
    faces = [(k * wide + i, k * wide + i + 1, (k + 1) * wide + i + 1, (k + 1) * wide + i) for k in range(rows)
             for i in range(columns)]
    return new_object(name, corners, faces, materials, numbers)


def box(name, at, side=1.0, materials=()):
    x, y, z = at
    corners = [(x + a * side, y + b * side, z + c * side) for c in (0, 1) for b in (0, 1) for a in (0, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return new_object(name, corners, faces, materials)


def material(name):
    import bpy

    made = bpy.data.materials.new(name)
    expect(made.name == name, "name of a material")
    return made


def begin_types():
    import bpy

    bpy.ops.slipface.show()
    return bpy.context.scene.slipface.types


def add_type(name):
    import bpy

    expect(bpy.ops.slipface.add_type(kind=name) == {"FINISHED"}, "adds a type")
    expect(bpy.context.scene.slipface.types[-1].name == name, "name of the type")


def assign(thing, faces, kind):
    """As a user does: in edit mode, with the operator."""
    import bpy

    for other in bpy.context.scene.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing
    chosen = set(faces)
    for vertex in thing.data.vertices:
        vertex.select = False
    for edge in thing.data.edges:
        edge.select = False
    for polygon in thing.data.polygons:
        polygon.select = polygon.index in chosen
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    if kind:
        expect(bpy.ops.slipface.assign(kind=kind) == {"FINISHED"}, "assigns")
    else:
        bpy.ops.slipface.unset()
    bpy.ops.object.mode_set(mode="OBJECT")


def write_truth(path, of_unset=lambda name: "default"):
    """All faces that Blender shows: their corners in the level's axes, and their types."""
    import bpy

    names = {t.key: t.name for t in bpy.context.scene.slipface.types}
    rows = []
    graph = bpy.context.evaluated_depsgraph_get()
    for instance in graph.object_instances:
        if instance.object.type != "MESH" or not instance.show_self:
            continue
        mesh, matrix = instance.object.data, instance.matrix_world.copy()
        layer = mesh.attributes.get("slipface_type")
        slots = [s.material.name if s.material else "" for s in instance.object.material_slots] or [""]
        for polygon in mesh.polygons:
            corners = [matrix @ mesh.vertices[v].co for v in polygon.vertices]
            if matrix.determinant() < 0:
                corners.reverse()
            key = layer.data[polygon.index].value if layer else 0
            kind = names[key] if key else of_unset(slots[min(polygon.material_index, len(slots) - 1)])
            rows.append(([(c.x, c.z, -c.y) for c in corners], kind))
    json.dump(rows, open(path + ".truth", "w"))


def export(path, **options):
    import bpy

    before = [(len(kind), sorted(x.name for x in kind)) for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.materials)]
    expect(bpy.ops.slipface.export_level(filepath=path, **options) == {"FINISHED"}, "exports")
    after = [(len(kind), sorted(x.name for x in kind)) for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.materials)]
    expect(before == after, "the export leaves no data behind")


def export_all(place, of_unset=lambda name: "default"):
    for name in ("m.obj", "m.glb", "m.gltf"):
        os.makedirs(os.path.join(place, name[2:]), exist_ok=True)
        path = os.path.join(place, name[2:], name)
        export(path)
        write_truth(path, of_unset)
    os.makedirs(os.path.join(place, "file"), exist_ok=True)
    path = os.path.join(place, "file", "m.obj")
    export(path, identity="FILE")
    write_truth(path, of_unset)


@case
def assigned_saved_and_reopened(place):
    import bpy

    begin_types()
    add_type("Glatteis ❄ dünn")
    floor = grid("Boden ä", 4, 3, materials=[material("Stein é")])
    block = box("block", (6, 0, 0), materials=[material("wood"), material("moss__sticky")])
    assign(floor, range(0, 5), "Glatteis ❄ dünn")
    assign(floor, range(5, 9), "hazard")
    assign(block, [0, 1], "ice")
    block.data.polygons[5].material_index = 1
    counts = {t.name: t.faces for t in bpy.context.scene.slipface.types}
    expect(counts["Glatteis ❄ dünn"] == 5 and counts["hazard"] == 4 and counts["ice"] == 2, "counts %s" % counts)
    bpy.ops.slipface.show()
    expect({t.name: t.faces for t in bpy.context.scene.slipface.types}["sticky"] == 1, "a suffix counts")
    colors = [tuple(round(x, 2) for x in c.color_srgb) for c in floor.data.color_attributes["slipface_color"].data]
    hazard = (0.84, 0.37, 0.0, 1.0)
    expect(len(colors) == 48 and all(math.dist(c, hazard) < 0.02 for c in colors[20:36]), "colours of the faces")
    bpy.context.scene.slipface.types[8].color = (1, 0, 0)
    first = floor.data.color_attributes["slipface_color"].data[0].color_srgb
    expect(math.dist(first, (1, 0, 0, 1)) < 0.02, "a new colour shows at once")
    file = os.path.join(place, "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=file)
    expect([t.name for t in bpy.context.scene.slipface.types][8] == "Glatteis ❄ dünn", "types are in the .blend")
    export_all(place, lambda name: "sticky" if name.endswith("sticky") else "default")


@case
def instances_and_modifiers(place):
    import bpy
    from mathutils import Matrix

    begin_types()
    scene = bpy.context.scene
    stone = material("stone")
    one = box("one", (0, 0, 0), materials=[stone])
    assign(one, [0, 1, 2], "ladder")
    assign(one, [5], "bouncy")
    twin = bpy.data.objects.new("twin", one.data)
    twin.matrix_world = Matrix.Translation((0, 4, 0)) @ Matrix.Rotation(0.4, 4, "Z")
    mirrored = bpy.data.objects.new("mirrored", one.data)
    mirrored.matrix_world = Matrix.Translation((0, 8, 0)) @ Matrix.Diagonal((-1, 2, 1, 1))
    row = box("row", (10, 0, 0), materials=[stone])
    assign(row, [1], "conveyor")
    row.modifiers.new("array", "ARRAY").count = 3
    half = grid("half", 3, 2, at=(0.5, 20, 0), materials=[stone])
    assign(half, [0, 3], "ice")
    half.modifiers.new("mirror", "MIRROR").use_axis = (True, False, False)
    thick = grid("thick", 2, 2, at=(30, 0, 0))
    assign(thick, [0, 1], "sticky")
    thick.modifiers.new("solidify", "SOLIDIFY").thickness = 0.3
    group = bpy.data.collections.new("group")
    inner = grid("inner", 2, 1, at=(0, 0, 5), materials=[stone])
    scene.collection.objects.unlink(inner)
    group.objects.link(inner)
    keys = {t.name: t.key for t in scene.slipface.types}
    inner.data.attributes.new("slipface_type", "INT", "FACE").data.foreach_set("value", [keys["hazard"], 0])
    for i in range(3):
        empty = bpy.data.objects.new("empty", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", group
        empty.matrix_world = Matrix.Translation((40, 5 * i, 0)) @ Matrix.Rotation(i, 4, "X")
        scene.collection.objects.link(empty)
    for thing in (twin, mirrored):
        scene.collection.objects.link(thing)
    bpy.context.view_layer.update()
    export_all(place)
    text = open(os.path.join(place, "obj", "m.obj")).read()
    names = re.findall("^o (.*)$", text, re.MULTILINE)
    expect({"one", "twin", "mirrored", "row", "half", "thick", "inner"} <= set(names), "names of objects: %s" % names)


@case
def materials_of_all_kinds(place):
    begin_types()
    own = material("signed")
    own["slipface_type"] = "turntable"
    long_a, long_b = material("ж" * 30 + "a"), material("ж" * 30 + "b")
    bare = grid("bare", 3, 1)
    assign(bare, [1], "ice")
    mixed = grid("mixed", 5, 2, at=(0, 4, 0), materials=[None, own, long_a, long_b, material("with space__sticky")],
                 numbers=[0, 1, 2, 3, 4, 0, 1, 2, 3, 4])
    assign(mixed, [5, 6, 7, 8, 9], "hazard")
    assign(mixed, [9], "ice")
    export_all(place, lambda name: "turntable" if name == "signed" else "sticky" if name.endswith("sticky") else "default")


@case
def levels_painted_in_the_editor(place):
    import bpy

    for name in ("easy", "playground", "hard"):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        folder = os.path.join(place, name)
        os.makedirs(folder, exist_ok=True)
        for file in os.listdir(os.path.join(ROOT, "assets", "levels")):
            if file.startswith(name):
                shutil.copy(os.path.join(ROOT, "assets", "levels", file), folder)
        expect(bpy.ops.slipface.import_level(filepath=os.path.join(folder, name + ".obj")) == {"FINISHED"}, "imports")
        os.makedirs(os.path.join(folder, "out"), exist_ok=True)
        export(os.path.join(folder, "out", name + ".obj"))


@case
def settings_and_unknown_members_stay(place):
    import bpy

    path = os.path.join(place, "m.obj")
    with open(path, "w") as file:
        file.write("mtllib m.mtl\nv 0 0 0\nv 100 0 0\nv 100 200 0\nv 0 200 0\nv 300 0 0\nv 300 200 0\n"
                   "usemtl a\nf 1 2 3 4\nf 2 5 6 3\n")
    level = {
        "slipface": 2, "mesh": "m.obj", "scale": 0.01, "up": "z", "spawn": {"position": [0.5, 3.25, -1e-05], "yaw": 1},
        "surfaces": [{"name": "default", "friction": 1}, {"name": "slick", "color": [0.1, 0.2, 0.3], "friction": 0.25, "mine": 7}],
        "rules": [{"pattern": "a", "type": "slick", "note": "x"}],
        "overrides": [{"type": "slick", "material": "a", "faces": ["0000000000000000 0.5,0,-1 0,1,0 2",
                                                                   "0000000000000000 9,9,9 0,1,0 2"]}],
        "orphans": [], "future": {"deep": [1, {"é": None}]}, "movement": {"gravity": 12.5, "unknown": True}}
    file = os.path.join(place, "m.slipface.json")
    json.dump(level, open(file, "w"))
    expect(bpy.ops.slipface.import_level(filepath=file) == {"FINISHED"}, "imports")
    size = max(v for o in bpy.context.scene.objects for c in o.bound_box for v in o.matrix_world @ __import__("mathutils").Vector(c))
    expect(abs(size - 3) < 1e-5, "the file's scale and axis count: %s" % size)
    types = bpy.context.scene.slipface.types
    expect(types[1].faces == 2 and types[1].name == "slick", "paint and rule")
    types[1].name = "glass"
    export(path)
    now = json.load(open(file))
    same = {k: v for k, v in level.items() if k not in ("scale", "up", "surfaces", "rules", "overrides")}
    expect({k: now[k] for k in same} == same, "what the add-on does not know stays")
    expect("scale" not in now and "up" not in now, "the geometry is in metres now")
    expect(now["surfaces"][1] == {**level["surfaces"][1], "name": "glass"}, "a type keeps its parameters")
    expect(now["rules"] == [{"pattern": "a", "type": "glass", "note": "x"}], "rules follow a new name")
    expect(now["overrides"] == [{"type": "glass", "material": "a", "faces": ["0000000000000000 9,9,9 0,1,0 2"]}],
           "paint that was not found stays: %s" % now["overrides"])
    expect("usemtl a__glass" in open(path).read(), "the name of the type is in the OBJ")
    # Paint of another program is not overwritten.
    now["overrides"] = []
    json.dump(now, open(file, "w"))
    before = open(path).read()
    try:
        bpy.ops.slipface.export_level(filepath=path)
        raise AssertionError("overwrites newer paint")
    except RuntimeError as error:
        expect("painted by another program" in str(error), str(error))
    expect(open(path).read() == before, "a refused export writes nothing")
    expect(bpy.ops.slipface.read() == {"FINISHED"}, "reads again")
    export(path)


@case
def hostile_level_files(place):
    import bpy

    begin_types()
    grid("floor", 2, 2)
    good = {"slipface": 2, "surfaces": [{"name": "default"}]}
    group = {"type": "default", "material": ""}
    bad = [b"", b"[]", b"{", b"\xff\xfe", b'{"slipface": 2, "slipface": 2}', b'{"slipface": 3}', b"[" * 100000,
           b'{"slipface": 2, "scale": NaN}', b'{"slipface": 2, "scale": 1e999}']
    bad += [json.dumps({**good, **more}).encode() for more in (
        {"surfaces": []}, {"surfaces": [{"name": "ice"}]}, {"surfaces": "x"}, {"surfaces": [{"name": "default"}] * 2},
        {"surfaces": [{"name": "default"}] + [{"name": str(i)} for i in range(300)]},
        {"surfaces": [{"name": "default", "color": [1, 2, 3]}]}, {"up": "w"}, {"scale": -1}, {"scale": "1"}, {"mesh": 3},
        {"overrides": 1}, {"overrides": [1]}, {"overrides": [{"faces": []}]}, {"overrides": [{**group, "faces": [1]}]},
        {"overrides": [{**group, "faces": ["0 1,2 3,4,5 6"]}]}, {"overrides": [{**group, "faces": ["0 1,2,inf 3,4,5 6"]}]},
        {"overrides": [{**group, "faces": [], "packed": ["????"]}]}, {"overrides": [{**group, "faces": [], "packed": ["AAAA"]}]},
        {"rules": {}}, {"rules": [{"pattern": 1, "type": "default"}]})]
    state = bpy.context.scene.slipface
    before = [(t.name, t.key, t.faces) for t in state.types]
    for i, data in enumerate(bad):
        path = os.path.join(place, "bad %d.slipface.json" % i)
        open(path, "wb").write(data)
        state.level_file = path
        try:
            bpy.ops.slipface.read()
            raise AssertionError("takes %r" % data[:80])
        except RuntimeError as error:
            expect(os.path.basename(path) in str(error) and len(str(error)) < 2000, str(error)[:500])
        expect(before == [(t.name, t.key, t.faces) for t in state.types], "a refused file changes nothing")


@case
def hostile_geometry(place):
    import bpy

    wrong = [("bad.gltf", b"{", "json"), ("old.gltf", b'{"asset": {"version": "1.0"}}', "2.0"),
             ("lone.gltf", b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "gone.bin", "byteLength": 4}], '
                           b'"bufferViews": [{"buffer": 0, "byteLength": 4}], "accessors": [{"bufferView": 0, '
                           b'"componentType": 5126, "count": 1, "type": "SCALAR"}], "nodes": [{"mesh": 0}], "meshes": '
                           b'[{"primitives": [{"attributes": {"POSITION": 0}}]}], "scenes": [{"nodes": [0]}], "scene": 0}',
              "gone.bin"),
             ("short.glb", b"glTF\1\0\0\0\x14\0\0\0\0\0\0\0JSON", "version"), ("empty.obj", b"", "no faces"),
             ("points.obj", b"v 0 0 0\nv 1 0 0\np 1 2\n", "no faces"), ("level.fbx", b"", "OBJ or glTF")]
    for name, data, why in wrong:
        path = os.path.join(place, name)
        open(path, "wb").write(data)
        try:
            bpy.ops.slipface.import_level(filepath=path)
            raise AssertionError("takes %s" % name)
        except RuntimeError as error:
            expect(name in str(error) and why in str(error) and "Traceback" not in str(error), str(error)[:500])


@case
def a_hundred_thousand_faces(place):
    import bpy
    import numpy as np

    keys = [t.key for t in begin_types()]
    floor = grid("floor", 400, 250, materials=[material("stone")])
    r = random.Random(5)
    chosen = np.array([r.choice(keys + [0]) for _ in range(100000)], np.int32)
    floor.data.attributes.new("slipface_type", "INT", "FACE").data.foreach_set("value", chosen)
    times = {}

    def timed(name, run):
        start = time.process_time()
        run()
        times[name] = round(time.process_time() - start, 2)

    timed("colours", bpy.ops.slipface.show)
    for thing in bpy.context.scene.objects:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = floor
    path = os.path.join(place, "m.obj")
    timed("export", lambda: export(path))
    write_truth(path)
    os.makedirs(os.path.join(place, "file"), exist_ok=True)
    path = os.path.join(place, "file", "m.obj")
    timed("export as paint", lambda: export(path, identity="FILE"))
    write_truth(path)
    floor.data.attributes["slipface_type"].data.foreach_set("value", np.zeros(100000, np.int32))
    bpy.context.scene.slipface.level_file = os.path.join(place, "file", "m.slipface.json")
    timed("read paint", bpy.ops.slipface.read)
    got = np.zeros(100000, np.int32)
    floor.data.attributes["slipface_type"].data.foreach_get("value", got)
    expect(np.array_equal(got, chosen), "paint is found again")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    timed("assign in edit mode", lambda: bpy.ops.slipface.assign(kind="ice"))
    print("TIMES", times)
    expect(max(times.values()) < 20, "in time: %s" % times)


# ---------------------------------------------------------------------------------------------------------------
# Outside: what Slipface reads


def faces_of_obj(path):
    vertices, faces, name = [], [], ""
    for line in open(path, encoding="utf-8"):
        word, _, rest = line.rstrip("\n").partition(" ")
        if word == "v":
            vertices.append(tuple(map(float, rest.split())))
        elif word == "usemtl":
            name = rest
        elif word == "f":
            faces.append(([vertices[int(w.split("/")[0]) - 1] for w in rest.split()], name))
    return faces


def resolved_faces(program, path, scratch):
    """[(corners, type)] as Slipface reads the level: its own export has every type in the material's name."""
    out = os.path.join(scratch, "resolved.obj")
    run = subprocess.run([program, "export", path, "--obj", out], capture_output=True, text=True)
    if run.returncode:
        raise SystemExit(run.stdout + run.stderr)
    return [(corners, name.rpartition("__")[2] if "__" in name else "default") for corners, name in faces_of_obj(out)]


def centroid(corners):
    return tuple(sum(c[k] for c in corners) / len(corners) for k in range(3))


def normal(corners):
    m, n = centroid(corners), [0.0, 0.0, 0.0]
    for i, p in enumerate(corners):
        a = [p[k] - m[k] for k in range(3)]
        b = [corners[(i + 1) % len(corners)][k] - m[k] for k in range(3)]
        for k in range(3):
            n[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]
    length = math.sqrt(sum(x * x for x in n)) or 1.0
    return [x / length for x in n]


def is_inside(point, corners, n):
    """Whether the point is on the convex face."""
    if abs(sum((point[k] - corners[0][k]) * n[k] for k in range(3))) > 1e-3:
        return False
    for i, p in enumerate(corners):
        e = [corners[(i + 1) % len(corners)][k] - p[k] for k in range(3)]
        w = [point[k] - p[k] for k in range(3)]
        cross = [e[(k + 1) % 3] * w[(k + 2) % 3] - e[(k + 2) % 3] * w[(k + 1) % 3] for k in range(3)]
        if sum(cross[k] * n[k] for k in range(3)) < -1e-6:
            return False
    return True


def compare(program, path, truth, scratch):
    """Every face, or triangle of one, that Slipface reads is one of Blender's, with its type; and all are there."""
    got = resolved_faces(program, path, scratch)
    cells = {}
    for number, (corners, kind) in enumerate(truth):
        c = centroid(corners)
        cells.setdefault(tuple(round(x) for x in c), []).append((corners, normal(corners), kind, number))
    found = set()
    for corners, kind in got:
        c, n = centroid(corners), normal(corners)
        near = [f for dx in range(-3, 4) for dy in range(-3, 4) for dz in range(-3, 4)
                for f in cells.get((round(c[0]) + dx, round(c[1]) + dy, round(c[2]) + dz), [])
                ] if len(truth) < 5000 else cells.get(tuple(round(x) for x in c), [])
        match = [f for f in near if sum(a * b for a, b in zip(f[1], n)) > 0.99 and is_inside(c, f[0], f[1])]
        if not match:
            raise SystemExit("%s: a face at %s that Blender does not have" % (path, c))
        if all(f[2].replace(" ", "_") != kind for f in match):
            raise SystemExit("%s: the face at %s is %s, expected %s" % (path, c, kind, match[0][2]))
        found.update(f[3] for f in match)
    if len(found) != len(truth):
        raise SystemExit("%s: %d faces of %d" % (path, len(found), len(truth)))
    return len(got)


def compare_levels(program, before, after, scratch):
    """The same types per face in two OBJ levels."""
    a, b = resolved_faces(program, before, scratch), resolved_faces(program, after, scratch)
    cells = {}
    for corners, kind in b:
        c = centroid(corners)
        cells.setdefault(tuple(round(x * 100) for x in c), []).append([c, normal(corners), kind])
    for corners, kind in a:
        c, n = centroid(corners), normal(corners)
        k = tuple(round(x * 100) for x in c)
        near = [f for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                for f in cells.get((k[0] + dx, k[1] + dy, k[2] + dz), [])
                if math.dist(f[0], c) < 1e-3 and sum(x * y for x, y in zip(f[1], n)) > 0.9]
        if kind not in [f[2] for f in near]:
            raise SystemExit("%s: the face at %s is %s, expected %s" % (after, c, [f[2] for f in near], kind))
    if len(a) != len(b):
        raise SystemExit("%s: %d faces, expected %d" % (after, len(b), len(a)))
    return len(a)


def main():
    program, only = os.path.abspath(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else ""
    folder = tempfile.mkdtemp(prefix="slipface blender ")
    try:
        # Blender's Python looks for its modules beside the first python3 of the path.
        blender = shutil.which("blender")
        path = os.path.dirname(blender) + os.pathsep + os.environ["PATH"]
        run = subprocess.run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                              os.path.abspath(__file__), "--", folder, only], capture_output=True, text=True,
                             env=dict(os.environ, PATH=path))
        if run.returncode:
            raise SystemExit(run.stdout[-4000:] + run.stderr[-4000:])
        for line in run.stdout.splitlines():
            if line.startswith(("CASE", "TIMES")):
                print(line)
        for place, _, files in sorted(os.walk(folder)):
            for file in sorted(files):
                path = os.path.join(place, file)
                if file.endswith(".truth"):
                    print("%s: %d faces" % (os.path.relpath(path[:-6], folder),
                                            compare(program, path[:-6], json.load(open(path)), folder)))
                if os.path.basename(place) == "out" and file.endswith(".obj"):
                    before = os.path.join(os.path.dirname(place), file)
                    print("%s: %d faces" % (os.path.relpath(path, folder), compare_levels(program, before, path, folder)))
    finally:
        shutil.rmtree(folder)


if "--" in sys.argv and "blender" in os.path.basename(sys.argv[0]):
    inside_blender(*sys.argv[sys.argv.index("--") + 1 :][:2])
else:
    main()
