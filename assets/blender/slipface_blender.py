"""Surface types of Slipface in Blender: assigned to faces, shown as colours, kept through export.

The pages docs/blender.md and docs/levels.md of Slipface describe how to work with it, and the level file.
"""
import base64
import hashlib
import json
import math
import os
import re
import struct

import bmesh
import bpy
import numpy as np
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatVectorProperty, IntProperty, PointerProperty,
                       StringProperty)
from bpy_extras.io_utils import ExportHelper, ImportHelper
from mathutils import Matrix
from mathutils.kdtree import KDTree

bl_info = {
    "name": "Slipface",
    "description": "Surface types of faces for levels of Slipface",
    "author": "Slipface",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Slipface; File > Import and Export",
    "doc_url": "",
    "category": "Import-Export",
}

TYPE_ATTRIBUTE = "slipface_type"  # INT per face: the key of its type; 0: unset
COLOR_ATTRIBUTE = "slipface_color"  # BYTE_COLOR per corner, made from the types
EXTRAS = "slipface_type"  # custom property of a material: its type's name
MAX_TYPES = 255  # of a level
MAX_LEVEL_FILE = 256 << 20  # bytes
MAX_DATA_NAME = 63  # bytes of the name of a datablock
NOT_FOUND_RGB = (1.0, 0.0, 1.0)

# What Slipface gives to a level without a level file. Parameters that are missing have their plain values.
PRESET_TYPES = [
    {"name": "default", "color": [0.62, 0.64, 0.67], "hotkey": 1},
    {"name": "ice", "color": [0.34, 0.71, 0.91], "hatch": "diagonal", "hotkey": 2, "keeps_energy": True},
    {"name": "ladder", "color": [0.9, 0.62, 0.0], "hatch": "horizontal", "hotkey": 3, "climbable": True},
    {"name": "sticky", "color": [0.8, 0.47, 0.65], "hatch": "dots", "hotkey": 4, "sticky": True},
    {"name": "bouncy", "color": [0.0, 0.62, 0.45], "hatch": "rings", "hotkey": 5, "restitution": 0.8},
    {"name": "conveyor", "color": [0.94, 0.89, 0.26], "hatch": "vertical", "hotkey": 6, "velocity": [0, 0, -2]},
    {"name": "turntable", "color": [0.0, 0.45, 0.7], "hatch": "checker", "hotkey": 7, "angular_velocity": 1},
    {"name": "hazard", "color": [0.84, 0.37, 0.0], "hatch": "cross", "hotkey": 8, "hazardous": True},
]

# Blender has +Z up, a level +Y: a level's (x, y, z) is Blender's (x, -z, y).
BLENDER_FROM_LEVEL = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
# The rotation that makes an axis of a file +Y.
UPRIGHT = {
    "y": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "z": ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
    "x": ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
    "-y": ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
    "-z": ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "-x": ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
}


class LevelError(Exception):
    """Something is wrong with a file or with the request; its text is for the user."""


# ---------------------------------------------------------------------------------------------------------------
# Names: the rules by which Slipface finds a type in a material's name

ASCII_LOWER = {c: c + 32 for c in range(ord("A"), ord("Z") + 1)}


def lower_without_spaces(name):
    return name.translate(ASCII_LOWER).replace(" ", "_")


def normal_name(name):
    """Case, spaces and an ending such as .001 make no difference."""
    return re.sub(r"(?<=.)\.[0-9]{3}$", "", lower_without_spaces(name))


def suffix_type(material, types):
    """The name of the type in `material`, or None: "stone__ice" has "ice"."""
    base, mark, wanted = normal_name(material).rpartition("__")
    return next((t for t in types if lower_without_spaces(t) == wanted), None) if mark else None


def base_material(material, types):
    text = normal_name(material)
    return text.rpartition("__")[0] if suffix_type(material, types) is not None else text


def rule_matches(pattern, material):
    pattern = lower_without_spaces(pattern) if re.search(r"[*?]", pattern) else normal_name(pattern)
    text = "".join(".*" if c == "*" else "." if c == "?" else re.escape(c) for c in re.sub(r"\*+", "*", pattern))
    return re.fullmatch(text, normal_name(material), re.DOTALL) is not None


def typed_material_name(material, kind, types):
    """`material` with the suffix of the type `kind`, at most as long as Blender's names."""
    base = material
    if suffix_type(material, types) is not None:
        base = material.rpartition("__")[0]
    suffix = "__" + kind.replace(" ", "_")
    if len((base + suffix).encode()) > MAX_DATA_NAME:
        mark = "~" + hashlib.sha1(base.encode()).hexdigest()[:6]
        room = MAX_DATA_NAME - len((mark + suffix).encode())
        base = base.encode()[: max(0, room)].decode(errors="ignore") + mark
    name = base + suffix
    bad = any(ord(c) <= 32 or c in "#\\" for c in suffix)
    if bad or len(name.encode()) > MAX_DATA_NAME or suffix_type(name, types) != kind:
        raise LevelError('the type "%s" cannot be part of a material\'s name: expected a shorter one without "__", '
                         '"#", "\\" and an ending such as ".001"' % kind)
    return name


# ---------------------------------------------------------------------------------------------------------------
# The level file


def no_repeated_keys(pairs):
    members = dict(pairs)
    if len(members) != len(pairs):
        keys = [k for k, _ in pairs]
        raise ValueError('the key "%s" occurs twice' % next(k for k in keys if keys.count(k) > 1))
    return members


def no_constant(text):
    raise ValueError("%s is not a number" % text)


def finite(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def check(good, path, place, expected):
    if not good:
        raise LevelError("%s:%s: expected %s" % (path, place, expected))


def read_level_file(path):
    """The level file as dictionaries, with the members that this add-on uses checked; None if there is no file."""
    if not os.path.exists(path):
        return None
    try:
        if os.path.getsize(path) > MAX_LEVEL_FILE:
            raise LevelError("%s: is larger than %d MiB" % (path, MAX_LEVEL_FILE >> 20))
        with open(path, encoding="utf-8") as file:
            level = json.load(file, object_pairs_hook=no_repeated_keys, parse_constant=no_constant)
    except (OSError, ValueError, RecursionError) as error:
        raise LevelError("%s: %s" % (path, error)) from error
    check(isinstance(level, dict) and level.get("slipface") in (1, 2), path, "/slipface", "a level file of version 1 or 2")
    check(isinstance(level.get("mesh", ""), str), path, "/mesh", "a file's name")
    check(level.get("up", "y") in UPRIGHT, path, "/up", "an axis")
    check(finite(level.get("scale", 1)) and 1e-6 <= level.get("scale", 1) <= 1e6, path, "/scale", "1e-6 to 1e6")
    surfaces = level.get("surfaces", [{"name": "default"}])
    check(isinstance(surfaces, list) and 0 < len(surfaces) <= MAX_TYPES, path, "/surfaces", "1 to %d types" % MAX_TYPES)
    names = set()
    check(isinstance(surfaces[0], dict) and surfaces[0].get("name") == "default", path, "/surfaces/0", 'the type "default"')
    for i, surface in enumerate(surfaces):
        place = "/surfaces/%d" % i
        check(isinstance(surface, dict) and isinstance(surface.get("name"), str) and surface["name"], path, place, "a type")
        check(surface["name"] not in names, path, place, "each name once")
        names.add(surface["name"])
        color = surface.get("color", [0, 0, 0])
        check(isinstance(color, list) and len(color) == 3 and all(finite(c) and 0 <= c <= 1 for c in color), path,
              place + "/color", "three numbers from 0 to 1")
    rules = level.get("rules", [])
    check(isinstance(rules, list), path, "/rules", "a list")
    for i, rule in enumerate(rules):
        check(isinstance(rule, dict) and isinstance(rule.get("pattern"), str) and isinstance(rule.get("type"), str), path,
              "/rules/%d" % i, "a pattern and a type")
    for key in ("overrides", "orphans"):
        groups = level.get(key, [])
        check(isinstance(groups, list), path, "/" + key, "a list")
        for i, group in enumerate(groups):
            place = "/%s/%d" % (key, i)
            check(isinstance(group, dict) and isinstance(group.get("type"), str), path, place, "a group of faces")
            check(isinstance(group.get("material", ""), str), path, place + "/material", "a material's name")
            for rows in ("faces", "packed"):
                texts = group.get(rows, [])
                check(isinstance(texts, list) and all(isinstance(t, str) for t in texts), path, place + "/" + rows,
                      "a list of texts")
    return level


def write_level_file(path, level):
    text = json.dumps(level, ensure_ascii=False, indent=2) + "\n"
    scratch = path + ".new"
    try:
        with open(scratch, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        os.replace(scratch, path)
    except OSError as error:
        raise LevelError("%s: %s" % (path, error)) from error


def unpack_row(text, location):
    """The faces of a packed row: [(centroid, normal, area)] and the 23 bytes of each."""
    try:
        data = base64.b64decode(text + "=" * (-len(text) % 4), validate=True)
    except ValueError as error:
        raise LevelError("%s: expected base64" % location) from error
    if not data or len(data) % 23 != 0:
        raise LevelError("%s: expected 23 bytes per face" % location)
    for i in range(0, len(data), 23):
        at = struct.unpack_from("<3f", data, i + 6)
        code = int.from_bytes(data[i + 18 : i + 21], "little")
        u, v = ((code & 0xFFF) - 2047) / 2047, ((code >> 12) - 2047) / 2047
        z = 1 - abs(u) - abs(v)
        if z < 0:
            u, v = math.copysign(1 - abs(v), u), math.copysign(1 - abs(u), v)
        length = math.sqrt(u * u + v * v + z * z)
        normal = (0.0, 0.0, 0.0) if code == 0xFFFFFF else (u / length, v / length, z / length)
        area_code = int.from_bytes(data[i + 21 : i + 23], "little")
        area = math.ldexp(1 + (area_code & 0x1FF) / 512, (area_code >> 9) - 64) if area_code else 0.0
        yield (at, normal, area), data[i : i + 23]


def unpack_text(text, location):
    try:
        _, at, normal, area = text.split()
        key = (tuple(map(float, at.split(","))), tuple(map(float, normal.split(","))), float(area))
        if len(key[0]) != 3 or len(key[1]) != 3 or not all(map(math.isfinite, (*key[0], *key[1], key[2]))):
            raise ValueError
    except ValueError as error:
        raise LevelError('%s: expected "HASH X,Y,Z NX,NY,NZ AREA"' % location) from error
    return key


def painted_rows(level, path):
    """Each painted face of the level file: (group number, material, type, (centroid, normal, area), row)."""
    for number, group in enumerate(level.get("overrides", [])):
        place = "%s:/overrides/%d" % (path, number)
        material, kind = group.get("material", ""), group["type"]
        for text in group.get("faces", []):
            yield number, material, kind, unpack_text(text, place), text
        for text in group.get("packed", []):
            for key, data in unpack_row(text, place):
                yield number, material, kind, key, data


def groups_of(level, rows):
    """The level's groups of painted faces with `rows` alone."""
    kept = {}
    for number, _, _, _, row in rows:
        kept.setdefault(number, []).append(row)
    groups = []
    for number, group in enumerate(level.get("overrides", [])):
        others = {k: v for k, v in group.items() if k not in ("faces", "packed")}
        texts = [r for r in kept.get(number, []) if isinstance(r, str)]
        packed = [r for r in kept.get(number, []) if not isinstance(r, str)]
        if not texts and not packed and set(others) <= {"type", "material"}:
            continue
        others["faces"] = texts
        if packed:
            others["packed"] = [base64.b64encode(b"".join(packed)).decode().rstrip("=")]
        groups.append(others)
    return groups


def stamp_of(level):
    """Changes when another program paints."""
    return hashlib.sha256(json.dumps(level.get("overrides", [])).encode()).hexdigest()


# ---------------------------------------------------------------------------------------------------------------
# Types of the scene


def type_names(scene):
    return [t.name for t in scene.slipface.types]


def key_of_name(scene, name):
    """A new key. It follows from the name, so that types have the same keys in other files, too."""
    used = {t.key for t in scene.slipface.types}
    key = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "little") & 0x7FFFFFFF
    while key == 0 or key in used:
        key = key % 0x7FFFFFFF + 1
    return key


def add_type(scene, surface, origin=""):
    row = scene.slipface.types.add()
    with Quiet():
        row.key = key_of_name(scene, surface["name"])
        row.name = surface["name"]
        row.color = surface.get("color", [0.5, 0.5, 0.5])
        row.origin = origin
        row.data = json.dumps(surface)
    return row


def need_types(scene):
    if not scene.slipface.types:
        for surface in PRESET_TYPES:
            add_type(scene, surface)


def free_name(scene, wanted, row=None):
    """Two types with one name would be one type in the level file."""
    others = {t.name for t in scene.slipface.types if t != row}
    wanted = wanted.strip() or "type"
    name, n = wanted, 2
    while name in others:
        name, n = "%s %d" % (wanted, n), n + 1
    return name


class Quiet:
    """Changes of types in its scope are the add-on's own, not the user's."""

    depth = 0

    def __enter__(self):
        Quiet.depth += 1

    def __exit__(self, *error):
        Quiet.depth -= 1


def type_renamed(row, context):
    if Quiet.depth == 0:
        with Quiet():
            scene = row.id_data
            row.name = "default" if scene.slipface.types[0] == row else free_name(scene, row.name, row)


def type_recolored(row, context):
    if Quiet.depth == 0:
        show_colors(row.id_data)


class SlipfaceType(bpy.types.PropertyGroup):
    name: StringProperty(name="Name", description="Name of the type, as in the level file", update=type_renamed)
    color: FloatVectorProperty(name="Colour", description="Shows faces of this type", subtype="COLOR_GAMMA", size=3, min=0,
                               max=1, update=type_recolored)
    key: IntProperty()  # in the attribute of faces; stays when the type is renamed
    origin: StringProperty()  # name in the level file that it was read from
    data: StringProperty()  # JSON of the type in the level file, with all parameters
    faces: IntProperty(name="Faces", description="Faces with this type when the colours were last made")


class SlipfaceScene(bpy.types.PropertyGroup):
    types: CollectionProperty(type=SlipfaceType)
    active: IntProperty(name="Type", description="The type that Assign gives to faces")
    level_file: StringProperty(name="Level file", subtype="FILE_PATH",
                               description="NAME.slipface.json, which has the types and the paint of Slipface")
    rules: StringProperty()  # JSON of the level file's rules for material names
    removed: StringProperty()  # JSON of the names of types that were read and then removed
    kept: StringProperty()  # JSON of painted faces that were not found here; export writes them back
    stamp: StringProperty()  # of the paint when it was read; empty: it was not read


def active_type(scene):
    need_types(scene)
    state = scene.slipface
    return state.types[min(max(state.active, 0), len(state.types) - 1)]


def type_of_property(material, names):
    kind = material.get(EXTRAS) if material else None
    return kind if isinstance(kind, str) and kind in names else None


def type_of_material(material, names, rules):
    """The type that a face of the material has without an assigned one, or None."""
    name = material.name if material else ""
    found = type_of_property(material, names) or suffix_type(name, names)
    if found is None:
        found = next((r["type"] for r in reversed(rules) if r["type"] in names and rule_matches(r["pattern"], name)), None)
    return found


# ---------------------------------------------------------------------------------------------------------------
# Faces


def meshes_of(scene):
    """Each mesh once, with an object that has it. Linked meshes of other files cannot be changed."""
    found = {}
    for thing in scene.objects:
        if thing.type == "MESH" and thing.data.library is None:
            found.setdefault(thing.data, thing)
    return found


def face_types(mesh):
    """The keys of the mesh's faces, as an array."""
    keys = np.zeros(len(mesh.polygons), np.int32)
    layer = mesh.attributes.get(TYPE_ATTRIBUTE)
    if layer and layer.domain == "FACE" and layer.data_type == "INT" and len(layer.data) == len(keys):
        layer.data.foreach_get("value", keys)
    return keys


def attribute(mesh, name, kind, domain):
    """The attribute, made or made anew if one of that name is of another kind."""
    layer = mesh.attributes.get(name)
    if layer and (layer.domain != domain or layer.data_type != kind):
        mesh.attributes.remove(layer)
        layer = None
    return layer or mesh.attributes.new(name, kind, domain)


def set_face_types(mesh, keys):
    attribute(mesh, TYPE_ATTRIBUTE, "INT", "FACE").data.foreach_set("value", keys.astype(np.int32))
    mesh.update()


def materials_of_faces(mesh):
    numbers = np.zeros(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("material_index", numbers)
    return np.clip(numbers, 0, max(0, len(mesh.materials) - 1))


def resolved_keys(scene, thing, keys, numbers):
    """The keys with those that materials and rules give to unset faces; default otherwise."""
    names = type_names(scene)
    rules = json.loads(scene.slipface.rules or "[]")
    by_name = {t.name: t.key for t in scene.slipface.types}
    first = scene.slipface.types[0].key
    slots = [s.material for s in thing.material_slots] or [None]
    by_slot = np.array([by_name.get(type_of_material(m, names, rules), first) for m in slots], np.int32)
    return np.where(keys != 0, keys, by_slot[np.clip(numbers, 0, len(by_slot) - 1)])


def rgba_of(scene):
    return {t.key: (*t.color, 1.0) for t in scene.slipface.types}


def show_colors(scene):
    """Makes the colours of all meshes from their types, and counts the faces of each type."""
    need_types(scene)
    rgba, counts = rgba_of(scene), {}
    for mesh, thing in meshes_of(scene).items():
        if mesh.is_editmode:
            edit_colors(scene, thing, rgba, counts)
        else:
            mesh_colors(scene, thing, rgba, counts)
    for row in scene.slipface.types:
        row.faces = counts.get(row.key, 0)


def count_keys(keys, counts):
    for key, count in zip(*np.unique(keys, return_counts=True)):
        counts[int(key)] = counts.get(int(key), 0) + int(count)


def mesh_colors(scene, thing, rgba, counts):
    mesh = thing.data
    if not mesh.polygons:
        return
    keys = resolved_keys(scene, thing, face_types(mesh), materials_of_faces(mesh))
    count_keys(keys, counts)
    known, number = np.unique(keys, return_inverse=True)
    table = np.array([rgba.get(int(k), (*NOT_FOUND_RGB, 1.0)) for k in known], np.float32)
    corners = np.zeros(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_total", corners)
    layer = attribute(mesh, COLOR_ATTRIBUTE, "BYTE_COLOR", "CORNER")
    layer.data.foreach_set("color_srgb", np.repeat(table[number], corners, axis=0).ravel())
    mesh.attributes.active_color = mesh.attributes[COLOR_ATTRIBUTE]
    mesh.update()


def edit_colors(scene, thing, rgba, counts):
    """The same in edit mode, where a mesh's attributes cannot be written."""
    b = bmesh.from_edit_mesh(thing.data)
    types = b.faces.layers.int.get(TYPE_ATTRIBUTE)
    colors = b.loops.layers.color.get(COLOR_ATTRIBUTE) or b.loops.layers.color.new(COLOR_ATTRIBUTE)
    types = b.faces.layers.int.get(TYPE_ATTRIBUTE)  # a new layer moves the others
    keys = np.array([f[types] if types else 0 for f in b.faces], np.int32)
    numbers = np.array([f.material_index for f in b.faces], np.int32)
    if not len(keys):
        return
    keys = resolved_keys(scene, thing, keys, numbers)
    count_keys(keys, counts)
    for face, key in zip(b.faces, keys.tolist()):
        color = rgba.get(key, (*NOT_FOUND_RGB, 1.0))
        for corner in face.loops:
            corner[colors] = color
    bmesh.update_edit_mesh(thing.data, loop_triangles=False, destructive=False)


def assign(context, key):
    """Gives the selected faces in edit mode, else all faces of the selected objects, the type. Returns their number."""
    count = 0
    if context.mode == "EDIT_MESH":
        for thing in context.objects_in_mode_unique_data:
            b = bmesh.from_edit_mesh(thing.data)
            layer = b.faces.layers.int.get(TYPE_ATTRIBUTE) or b.faces.layers.int.new(TYPE_ATTRIBUTE)
            for face in b.faces:
                if face.select:
                    face[layer] = key
                    count += 1
            bmesh.update_edit_mesh(thing.data, loop_triangles=False, destructive=False)
    else:
        for mesh in {o.data for o in context.selected_objects if o.type == "MESH" and o.data.library is None}:
            set_face_types(mesh, np.full(len(mesh.polygons), key, np.int32))
            count += len(mesh.polygons)
    if count:
        show_colors(context.scene)
    return count


def face_keys(mesh, matrix):
    """Centroids, unit normals and areas of the mesh's faces in the level's axes, as arrays."""
    faces = len(mesh.polygons)
    points = np.zeros(3 * len(mesh.vertices), np.float64)
    mesh.vertices.foreach_get("co", points)
    vertex = np.zeros(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", vertex)
    first, total = np.zeros(faces, np.int32), np.zeros(faces, np.int32)
    mesh.polygons.foreach_get("loop_start", first)
    mesh.polygons.foreach_get("loop_total", total)
    into = np.array(BLENDER_FROM_LEVEL.inverted() @ matrix)
    corners = (points.reshape(-1, 3) @ into[:3, :3].T + into[:3, 3])[vertex]
    if faces == 0:
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
    centroid = np.add.reduceat(corners, first, axis=0) / total[:, None]
    following = np.arange(1, len(vertex) + 1)
    following[first + total - 1] = first
    about = np.repeat(centroid, total, axis=0)
    vector = 0.5 * np.add.reduceat(np.cross(corners - about, corners[following] - about), first, axis=0)
    if matrix.determinant() < 0:
        vector = -vector  # a mirrored object shows the same side of its faces
    area = np.linalg.norm(vector, axis=1)
    return centroid, vector / np.maximum(area, 1e-30)[:, None], area


def take_paint(scene, level, path):
    """Gives faces of the scene the types that the level file paints. Returns the number found, and keeps the others."""
    names = type_names(scene)
    by_name = {t.name: t.key for t in scene.slipface.types}
    things = [o for o in scene.objects if o.type == "MESH" and o.data.library is None and o.data.polygons]
    centroids, normals, areas, bases, owner = [], [], [], [], []
    for number, thing in enumerate(things):
        centroid, normal, area = face_keys(thing.data, thing.matrix_world)
        slots = [base_material(s.material.name if s.material else "", names) for s in thing.material_slots] or [""]
        centroids.append(centroid)
        normals.append(normal)
        areas.append(area)
        bases += [slots[min(i, len(slots) - 1)] for i in materials_of_faces(thing.data).tolist()]
        owner.append(np.full(len(area), number))
    rows = list(painted_rows(level, path))
    first = np.cumsum([0] + [len(a) for a in areas])
    found = np.zeros(int(first[-1]), np.int64)
    kept = rows
    if len(found):
        centroid, normal, area = np.concatenate(centroids), np.concatenate(normals).tolist(), np.concatenate(areas).tolist()
        tree = KDTree(len(found))
        for i, at in enumerate(centroid.tolist()):
            tree.insert(at, i)
        tree.balance()
        kept = []
        for row in rows:
            _, material, kind, (at, side, size), _ = row
            base, best = base_material(material, names), None
            reach = 1e-4 + 4e-6 * max(map(abs, at))
            for _, i, distance in tree.find_range(at, reach) if kind in by_name else []:
                same_side = sum(a * b for a, b in zip(normal[i], side)) > 0.99 or not any(side)
                if found[i] or not same_side or abs(area[i] - size) > 0.02 * max(area[i], size):
                    continue
                rank = (bases[i] != base, distance)
                if best is None or rank < best[0]:
                    best = (rank, i)
            if best is None:
                kept.append(row)
            else:
                found[best[1]] = by_name[kind]
    split = 0
    seen = {}
    for number, thing in enumerate(things):
        keys = found[first[number] : first[number + 1]].astype(np.int32)
        if thing.data in seen and not np.array_equal(seen[thing.data], keys):
            thing.data = thing.data.copy()  # its faces have other types than those of the object that shares its mesh
            split += 1
        seen[thing.data] = keys
        set_face_types(thing.data, keys)
    state = scene.slipface
    state.kept = json.dumps(groups_of(level, kept))
    state.stamp = stamp_of(level)
    return len(rows) - len(kept), len(kept), split


def take_types(scene, level):
    """The types of the level file. Types that faces here have and the file does not stay at the end."""
    state = scene.slipface
    old = {t.name: (t.key, json.loads(t.data or "{}") | {"name": t.name, "color": list(t.color)}) for t in state.types}
    used = set()
    for mesh in meshes_of(scene):
        used.update(np.unique(face_types(mesh)).tolist())
    state.types.clear()
    state.removed = ""
    for surface in level.get("surfaces", PRESET_TYPES):
        row = add_type(scene, surface, surface["name"])
        if surface["name"] in old:
            row.key = old.pop(surface["name"])[0]
    for key, surface in old.values():
        if key in used:
            add_type(scene, surface).key = key
    state.active = min(state.active, len(state.types) - 1)
    state.rules = json.dumps(level.get("rules", []))


def read_level(scene, path):
    """Takes types and paint of the level file `path` over. Returns a sentence."""
    level = read_level_file(path)
    if level is None:
        raise LevelError("%s: there is no such file" % path)
    list(painted_rows(level, path))  # errors before anything changes
    take_types(scene, level)
    found, kept, split = take_paint(scene, level, path)
    scene.slipface.level_file = path
    show_colors(scene)
    text = "%d types, %d painted faces found" % (len(scene.slipface.types), found)
    if kept:
        text += ", %d not found: they stay in the level file" % kept
    if split:
        text += "; %d objects got a mesh of their own" % split
    return text


# ---------------------------------------------------------------------------------------------------------------
# Import


def words_of(error):
    """What Blender's importer or exporter says of its failure: the last line, where it shows the whole call stack."""
    lines = [line for line in str(error).strip().splitlines() if not line.startswith("Location:")]
    return lines[-1].removeprefix("Error: ") if lines else "Blender does not say why"


def level_file_for(path):
    return os.path.splitext(path)[0] + ".slipface.json"


def import_level(context, path):
    """Imports a level's geometry, in metres, with its types. Returns a sentence."""
    file = path if path.lower().endswith(".slipface.json") else level_file_for(path)
    level = read_level_file(file)
    if path == file:
        check(level is not None and level.get("mesh"), file, "/mesh", "the file of the geometry")
        path = os.path.join(os.path.dirname(file), level["mesh"])
    if not os.path.isfile(path):
        raise LevelError("%s: there is no such file" % path)
    ending = os.path.splitext(path)[1].lower()
    before = set(context.scene.objects)
    try:
        if ending == ".obj":
            bpy.ops.wm.obj_import(filepath=path)
        elif ending in (".gltf", ".glb"):
            bpy.ops.import_scene.gltf(filepath=path, merge_vertices=False)
        else:
            raise LevelError("%s: expected an OBJ or glTF file; import others with Blender, then read the level file" % path)
    except RuntimeError as error:
        raise LevelError("%s: %s" % (path, words_of(error))) from error
    new = set(context.scene.objects) - before
    if not any(thing.type == "MESH" and thing.data.polygons for thing in new):
        raise LevelError("%s: it has no faces" % path)
    level = level or {}
    upright = Matrix(UPRIGHT[level.get("up", "y")]).to_4x4()
    change = BLENDER_FROM_LEVEL @ Matrix.Scale(level.get("scale", 1), 4) @ upright @ BLENDER_FROM_LEVEL.inverted()
    if change != Matrix():
        for thing in new:
            if thing.parent is None:
                thing.matrix_world = change @ thing.matrix_world
    context.view_layer.update()
    need_types(context.scene)
    if level:
        return read_level(context.scene, file)
    show_colors(context.scene)
    return "the level has no level file: every face is unset"


# ---------------------------------------------------------------------------------------------------------------
# Export


class Piece:
    """One object, or instance, as it is exported."""

    def __init__(self, name, source, mesh, matrix):
        self.name, self.source, self.mesh, self.matrix = name, source, mesh, matrix


def evaluated_pieces(context, only_selected, made):
    """Every visible object and instance, with its modifiers applied. New meshes are added to `made`."""
    graph = context.evaluated_depsgraph_get()
    pieces, meshes = [], {}
    for instance in graph.object_instances:
        thing = instance.object
        source = thing.original or thing
        chosen = instance.parent.original if instance.is_instance and instance.parent else source
        if thing.type not in {"MESH", "CURVE", "SURFACE", "FONT", "META"} or not instance.show_self:
            continue
        if only_selected and not chosen.select_get():
            continue
        plain = thing.type == "MESH" and not source.modifiers and source.data and source.data.shape_keys is None and all(
            s.link == "DATA" for s in source.material_slots)
        share = source.data if plain else thing.as_pointer()
        if share not in meshes:
            mesh = bpy.data.meshes.new_from_object(thing, preserve_all_data_layers=True, depsgraph=graph)
            if mesh is not None:
                made.append(mesh)
            meshes[share] = mesh
        mesh = meshes[share]
        if mesh is not None and mesh.polygons:
            pieces.append(Piece(source.name, source, mesh, instance.matrix_world.copy()))
    if not pieces:
        raise LevelError("nothing to export: no %s object has faces" % ("selected" if only_selected else "visible"))
    return pieces


def keys_to_export(scene, mesh):
    """The keys of the faces, with those of their materials' properties, which an OBJ file does not have."""
    by_name = {t.name: t.key for t in scene.slipface.types}
    slots = [by_name.get(type_of_property(m, by_name), 0) for m in mesh.materials] or [0]
    keys = face_types(mesh)
    return np.where(keys != 0, keys, np.array(slots, np.int32)[materials_of_faces(mesh)])


class Typing:
    """Materials that carry the types of faces, made for an export and removed after it."""

    def __init__(self, scene, made):
        self.scene, self.names = scene, type_names(scene)
        self.by_key = {t.key: t.name for t in scene.slipface.types}
        self.made, self.known = made, {}
        self.unknown = 0

    def material(self, base, kind):
        if (base, kind) in self.known:
            return self.known[base, kind]
        name = typed_material_name(base.name if base else "", kind, self.names)
        typed = next((m for m in bpy.data.materials if m.name == name and m.library is None), None)
        if typed is None:
            typed = base.copy() if base else bpy.data.materials.new(name)
            self.made.append(typed)
            typed.name = name
            if typed.name != name:
                raise LevelError('Blender has no room for a material "%s"' % name)
            typed[EXTRAS] = kind
        self.known[base, kind] = typed
        return typed

    def apply(self, mesh):
        """Splits the mesh's materials by the types of faces."""
        keys = keys_to_export(self.scene, mesh)
        self.unknown += int(np.sum((keys != 0) & ~np.isin(keys, list(self.by_key))))
        if not np.any(keys):
            return
        numbers = materials_of_faces(mesh)
        if not mesh.materials:
            mesh.materials.append(None)
        pairs = numbers.astype(np.int64) << 32 | keys
        for pair in np.unique(pairs).tolist():
            number, key = pair >> 32, pair & 0xFFFFFFFF
            if key not in self.by_key:
                continue
            mesh.materials.append(self.material(mesh.materials[number], self.by_key[key]))
            numbers[pairs == pair] = len(mesh.materials) - 1
        mesh.polygons.foreach_set("material_index", numbers)
        mesh.update()


def paint_groups(scene, pieces):
    """The types of faces as groups of painted faces of a level file."""
    by_key = {t.key: t.name for t in scene.slipface.types}
    groups = {}
    for piece in pieces:
        keys = keys_to_export(scene, piece.mesh)
        centroid, normal, area = face_keys(piece.mesh, piece.matrix)
        materials = [m.name if m else "" for m in piece.mesh.materials] or [""]
        for i in np.flatnonzero(keys).tolist():
            kind = by_key.get(int(keys[i]))
            if kind is None:
                continue
            material = materials[min(piece.mesh.polygons[i].material_index, len(materials) - 1)].replace(" ", "_")
            row = "%016x %.9g,%.9g,%.9g %.4f,%.4f,%.4f %.9g" % (0, *centroid[i], *normal[i], area[i])
            groups.setdefault((kind, material), []).append(row)
    return [{"type": kind, "material": material, "faces": rows} for (kind, material), rows in sorted(groups.items())]


def merged_surfaces(scene, level):
    """The level file's types with what was renamed, recoloured, added and removed here, and their new names."""
    now = {s["name"]: s for s in level.get("surfaces", [])}
    renamed, surfaces = {}, []
    for row in scene.slipface.types:
        before = json.loads(row.data or "{}")
        # The file's parameters count: they may have changed in Slipface since.
        surface = now.pop(row.origin, None) or now.pop(row.name, None) or before
        if row.origin and row.origin != row.name:
            renamed[row.origin] = row.name
        color = [round(c, 4) for c in row.color]
        recolored = any(abs(a - b) > 1e-3 for a, b in zip(color, before.get("color", [9, 9, 9])))
        surfaces.append(surface | {"name": row.name} | ({"color": color} if recolored or "color" not in surface else {}))
    named = {g["type"] for key in ("overrides", "orphans", "rules") for g in level.get(key, [])}
    removed = set(json.loads(scene.slipface.removed or "[]")) - named
    taken = {s["name"] for s in surfaces}
    surfaces += [s for name, s in now.items() if name not in removed | taken]
    return surfaces, renamed


def same_file(a, b):
    return os.path.normcase(os.path.abspath(a)) == os.path.normcase(os.path.abspath(b))


def merged_level_file(scene, mesh_path):
    """The level file for the geometry `mesh_path` with the paint that was not found here: (path, level, was it read here)."""
    state, path = scene.slipface, level_file_for(mesh_path)
    source = bpy.path.abspath(state.level_file) if state.level_file else path
    base = path if os.path.exists(path) else source  # else the same level under another name
    level = read_level_file(base)
    read = level is not None and bool(state.stamp) and same_file(base, source)
    if read and stamp_of(level) != state.stamp:
        raise LevelError("%s: was painted by another program since it was read here; read types and paint again first" % base)
    surfaces, renamed = merged_surfaces(scene, level or {})
    # Without movement settings a level file has none of Slipface's help for players.
    level = dict(level or {"slipface": 2, "movement": "platformer"})
    level["mesh"] = os.path.basename(mesh_path)
    for key in ("scale", "up", "parts"):  # the exported geometry is in metres with +Y up; parts describe the old paint
        level.pop(key, None)
    level["surfaces"] = surfaces
    kept = json.loads(state.kept or "[]") if read else level.get("overrides", [])
    level["overrides"] = kept
    for key in ("overrides", "orphans", "rules"):
        level[key] = [g | {"type": renamed.get(g["type"], g["type"])} for g in level.get(key, [])]
    return path, level, read


def finish_level_file(scene, path, level, groups, read):
    """Writes the level file, if Slipface needs one. True if it does."""
    state = scene.slipface
    level["overrides"] = groups + level["overrides"]
    plain = not level["overrides"] and not level["rules"] and not level["orphans"] and level["surfaces"] == PRESET_TYPES
    if plain and level.get("movement") == "platformer" and not os.path.exists(path):
        return False  # what Slipface has for a level without a file
    write_level_file(path, level)
    if read or not state.level_file:
        state.level_file = path
    if read:
        state.stamp = stamp_of(level)
    for row, surface in zip(state.types, level["surfaces"]):
        row.data, row.origin = json.dumps(surface), row.name
    state.removed = ""
    return True


def export_level(context, path, identity="MATERIAL", only_selected=False):
    """Exports OBJ or glTF by the ending of `path`, and the level file. Returns a sentence."""
    scene = context.scene
    need_types(scene)
    ending = os.path.splitext(path)[1].lower()
    if ending not in (".obj", ".gltf", ".glb"):
        raise LevelError("%s: expected a name ending with .obj, .gltf or .glb" % path)
    file, level, read = merged_level_file(scene, path)
    mode = context.mode
    if mode == "EDIT_MESH":
        bpy.ops.object.mode_set(mode="OBJECT")
    layer = context.view_layer
    selected, active = list(context.selected_objects), layer.objects.active
    meshes, materials, things, names = [], [], [], []
    try:
        pieces = evaluated_pieces(context, only_selected, meshes)
        groups = paint_groups(scene, pieces) if identity == "FILE" else []
        typing = Typing(scene, materials)
        if identity == "MATERIAL":
            for mesh in meshes:
                typing.apply(mesh)
        else:
            for mesh in meshes:
                typing.unknown += int(np.sum(~np.isin(face_types(mesh), [0, *typing.by_key])))
        # A copy gets its object's name, because Slipface's platforms name the objects that they move.
        for source in {p.source for p in pieces}:
            if source.library is None:
                names.append((source, source.name))
                source.name = "slipface export"
        for thing in selected:
            thing.select_set(False)
        for piece in pieces:
            thing = bpy.data.objects.new(piece.name, piece.mesh)
            things.append(thing)
            scene.collection.objects.link(thing)
            thing.matrix_world = piece.matrix
            thing.select_set(True)
        layer.objects.active = things[0]
        for mesh in meshes:
            if mesh.attributes.get(COLOR_ATTRIBUTE):
                mesh.attributes.remove(mesh.attributes[COLOR_ATTRIBUTE])  # for the viewport alone
        try:
            if ending == ".obj":
                bpy.ops.wm.obj_export(filepath=path, export_selected_objects=True, apply_modifiers=False)
            else:
                bpy.ops.export_scene.gltf(filepath=path, use_selection=True, export_extras=True, export_animations=False,
                                          export_format="GLB" if ending == ".glb" else "GLTF_SEPARATE")
        except RuntimeError as error:
            raise LevelError("%s: %s" % (path, words_of(error))) from error
    finally:
        for thing in things:
            bpy.data.objects.remove(thing)
        for mesh in meshes:
            bpy.data.meshes.remove(mesh)
        for material in materials:
            bpy.data.materials.remove(material)
        for source, name in names:
            source.name = name
        for thing in selected:
            thing.select_set(True)
        layer.objects.active = active
        if mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="EDIT")
    text = "exported %s" % os.path.basename(path)
    if finish_level_file(scene, file, level, groups, read):
        text += " and %s" % os.path.basename(file)
    if typing.unknown:
        text += "; %d faces have a type that is not in the list and are unset" % typing.unknown
    return text


# ---------------------------------------------------------------------------------------------------------------
# Operators


class Step:
    """An operator whose errors become reports."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            need_types(context.scene)
            text = self.run(context)
        except LevelError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if text:
            self.report({"INFO"}, text[0].upper() + text[1:])
        return {"FINISHED"}


class SLIPFACE_OT_assign(Step, bpy.types.Operator):
    """Give the type to the selected faces, or in object mode to all faces of the selected objects"""

    bl_idname = "slipface.assign"
    bl_label = "Assign"
    kind: StringProperty(name="Type", description="Name of the type; empty: the active one")

    def run(self, context):
        row = active_type(context.scene)
        if self.kind:
            row = next((t for t in context.scene.slipface.types if t.name == self.kind), None)
            if row is None:
                raise LevelError('there is no type "%s"' % self.kind)
        count = assign(context, row.key)
        if count == 0:
            raise LevelError("no face is selected")
        return "%d faces are %s" % (count, row.name)


class SLIPFACE_OT_unset(Step, bpy.types.Operator):
    """Take the type from the selected faces: their material decides it, as for new faces"""

    bl_idname = "slipface.unset"
    bl_label = "Unset"

    def run(self, context):
        return "%d faces are unset" % assign(context, 0)


class SLIPFACE_OT_select(Step, bpy.types.Operator):
    """Select the faces of the type, in edit mode"""

    bl_idname = "slipface.select"
    bl_label = "Select"

    @classmethod
    def poll(cls, context):
        return context.mode == "EDIT_MESH"

    def run(self, context):
        scene, count = context.scene, 0
        wanted = active_type(scene).key
        for thing in context.objects_in_mode_unique_data:
            b = bmesh.from_edit_mesh(thing.data)
            layer = b.faces.layers.int.get(TYPE_ATTRIBUTE)
            keys = np.array([f[layer] if layer else 0 for f in b.faces], np.int32)
            numbers = np.array([f.material_index for f in b.faces], np.int32)
            keys = resolved_keys(scene, thing, keys, numbers) if len(keys) else keys
            for face, key in zip(b.faces, keys.tolist()):
                if not face.hide:
                    face.select_set(key == wanted)
                    count += key == wanted
            b.select_flush_mode()
            bmesh.update_edit_mesh(thing.data, loop_triangles=False, destructive=False)
        return "%d faces" % count


class SLIPFACE_OT_add_type(Step, bpy.types.Operator):
    """Add a type; its parameters are set in Slipface"""

    bl_idname = "slipface.add_type"
    bl_label = "Add type"
    kind: StringProperty(name="Name", default="type")

    def run(self, context):
        state = context.scene.slipface
        if len(state.types) >= MAX_TYPES:
            raise LevelError("a level has at most %d types" % MAX_TYPES)
        hue = len(state.types) * 0.618 % 1.0
        color = [round(0.5 + 0.4 * math.cos(2 * math.pi * (hue + k / 3)), 2) for k in range(3)]
        add_type(context.scene, {"name": free_name(context.scene, self.kind), "color": color})
        state.active = len(state.types) - 1


class SLIPFACE_OT_remove_type(Step, bpy.types.Operator):
    """Remove the type; its faces become unset"""

    bl_idname = "slipface.remove_type"
    bl_label = "Remove type"

    @classmethod
    def poll(cls, context):
        return context.mode != "EDIT_MESH" and context.scene.slipface.active > 0

    def run(self, context):
        state = context.scene.slipface
        row = active_type(context.scene)
        key, index = row.key, list(state.types).index(row)
        for mesh in meshes_of(context.scene):
            keys = face_types(mesh)
            if np.any(keys == key):
                set_face_types(mesh, np.where(keys == key, 0, keys))
        if row.origin:
            state.removed = json.dumps(json.loads(state.removed or "[]") + [row.origin])
        state.types.remove(index)
        state.active = index - 1
        show_colors(context.scene)


class SLIPFACE_OT_show(Step, bpy.types.Operator):
    """Make the colours again and show them in this view (Solid shading, Colour: Attribute)"""

    bl_idname = "slipface.show"
    bl_label = "Show types"

    def run(self, context):
        show_colors(context.scene)
        context.scene.display.shading.color_type = "VERTEX"
        if context.space_data and context.space_data.type == "VIEW_3D":
            context.space_data.shading.type = "SOLID"
            context.space_data.shading.color_type = "VERTEX"


class SLIPFACE_OT_read(Step, bpy.types.Operator):
    """Read types and paint of the level file, and find the painted faces in the scene"""

    bl_idname = "slipface.read"
    bl_label = "Read types and paint"

    def run(self, context):
        if not context.scene.slipface.level_file:
            raise LevelError("choose a level file first")
        if context.mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        return read_level(context.scene, bpy.path.abspath(context.scene.slipface.level_file))


class SLIPFACE_OT_import(Step, bpy.types.Operator, ImportHelper):
    """Import a level of Slipface: its OBJ or glTF file, and the types and paint of its level file"""

    bl_idname = "slipface.import_level"
    bl_label = "Import level"
    filter_glob: StringProperty(default="*.obj;*.gltf;*.glb;*.slipface.json", options={"HIDDEN"})

    def run(self, context):
        return import_level(context, self.filepath)


class SLIPFACE_OT_export(Step, bpy.types.Operator, ExportHelper):
    """Export a level for Slipface, OBJ or glTF by the file's ending, with the types of its faces"""

    bl_idname = "slipface.export_level"
    bl_label = "Export level"
    bl_options = {"REGISTER"}
    filename_ext = ".obj"
    check_extension = None
    filter_glob: StringProperty(default="*.obj;*.gltf;*.glb", options={"HIDDEN"})
    identity: EnumProperty(
        name="Types", description="Where the types of faces are stored",
        items=[("MATERIAL", "In material names", "stone__ice: nothing has to be found again, and new faces inherit it"),
               ("FILE", "In the level file", "As painted faces; material names stay")])
    only_selected: BoolProperty(name="Only selected objects", default=False)

    def run(self, context):
        return export_level(context, self.filepath, self.identity, self.only_selected)


# ---------------------------------------------------------------------------------------------------------------
# Panel


class SLIPFACE_UL_types(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flt_flag=0):
        line = layout.row(align=True)
        swatch = line.row()
        swatch.ui_units_x = 1.4
        swatch.prop(item, "color", text="")
        line.prop(item, "name", text="", emboss=False)
        count = line.row()
        count.alignment = "RIGHT"
        count.label(text=str(item.faces) if item.faces else "")


class SLIPFACE_PT_types(bpy.types.Panel):
    bl_idname = "SLIPFACE_PT_types"
    bl_label = "Surface types"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Slipface"

    def draw(self, context):
        state, layout = context.scene.slipface, self.layout
        if not state.types:
            layout.operator("slipface.show", text="Begin", icon="COLOR")
            layout.operator("slipface.import_level", icon="IMPORT")
            return
        line = layout.row()
        line.template_list("SLIPFACE_UL_types", "", state, "types", state, "active", rows=9)
        side = line.column(align=True)
        side.operator("slipface.add_type", text="", icon="ADD")
        side.operator("slipface.remove_type", text="", icon="REMOVE")
        line = layout.row(align=True)
        line.operator("slipface.assign")
        line.operator("slipface.unset")
        line.operator("slipface.select")
        layout.operator("slipface.show", icon="COLOR")
        box = layout.column()
        box.prop(state, "level_file", text="")
        box.operator("slipface.read", icon="FILE_REFRESH")
        line = layout.row(align=True)
        line.operator("slipface.import_level", text="Import", icon="IMPORT")
        line.operator("slipface.export_level", text="Export", icon="EXPORT")


def import_entry(menu, context):
    menu.layout.operator("slipface.import_level", text="Slipface level (.obj, .gltf, .glb)")


def export_entry(menu, context):
    menu.layout.operator("slipface.export_level", text="Slipface level (.obj, .gltf, .glb)")


CLASSES = (SlipfaceType, SlipfaceScene, SLIPFACE_OT_assign, SLIPFACE_OT_unset, SLIPFACE_OT_select, SLIPFACE_OT_add_type,
           SLIPFACE_OT_remove_type, SLIPFACE_OT_show, SLIPFACE_OT_read, SLIPFACE_OT_import, SLIPFACE_OT_export,
           SLIPFACE_UL_types, SLIPFACE_PT_types)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.slipface = PointerProperty(type=SlipfaceScene)
    bpy.types.TOPBAR_MT_file_import.append(import_entry)
    bpy.types.TOPBAR_MT_file_export.append(export_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(import_entry)
    del bpy.types.Scene.slipface
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)


if __name__ == "__main__":
    register()
