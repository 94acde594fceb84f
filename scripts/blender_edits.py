#!/usr/bin/env python3
"""What becomes of painted faces when a real Blender edits a level.

    scripts/blender_edits.py [--program slipface] [--levels 3] [--seed 1] [--shipped easy] [--map pk3:maps/a.bsp] [--only turn]

Needs Blender (apt-get install blender). Blender itself carries the number of each original face through the edit,
as a face attribute; what Slipface finds is compared with that. So the matching is not measured by itself.
right: of the painted faces that still exist, the ones with their type. wrong: faces with another type than theirs.
unsaid: of the wrong ones, those that are not in the list of guesses.

Where faces are merged, the number that Blender keeps is that of an arbitrary one of them, so there Blender's nearest
points on the original say which faces each new one covers: the type of more than half of its area is its type.
A face that is as it was has its own type, though others may lie nearer to it: it may be narrower than rounding.
A bevel, an inset or a moved vertex can turn a face over or push it off its place, if it is smaller than that. Such a
face no longer exists, and its number's type or that of the faces of its object in whose place it is now is right. A
face that a bevel makes may have the type of each face beside it.
"""
import argparse
import json
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Edits of these kinds must never give a wrong type.
RIGID = "rigid"
OTHER = "other"
# New faces that cover several old ones.
MERGED = "merged"
# Faces that an edit narrower than they are leaves in their place.
RESHAPED = "reshaped"

# ---------------------------------------------------------------------------------------------------------------
# Inside Blender


def inside_blender(job_path):
    import bmesh
    import bpy
    from mathutils import Matrix, Vector
    from mathutils.bvhtree import BVHTree

    job = json.load(open(job_path))

    def read(path):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.obj_import(filepath=path)
        return sorted((o for o in bpy.context.scene.objects if o.type == "MESH"), key=lambda o: o.name)

    def tag(objects):
        """Gives each face its number in the OBJ: by its corners in their order, which Blender keeps. Of faces that
        are the same the first is the first."""
        def different(corners):
            """Without those that are there twice, the least one first."""
            corners = [struct.pack("3f", *(x + 0.0 for x in c)) for i, c in enumerate(corners) if c not in corners[:i]]
            first = corners.index(min(corners))
            return tuple(corners[first:] + corners[:first])

        numbers = {}
        for number, corners in enumerate(job["outlines"]):
            numbers.setdefault((different(corners), job["materials"][number]), []).append(number)
        numbers = {key: found[::-1] for key, found in numbers.items()}
        used, places, loops, owners, ids = set(), [], [], [], {}
        # Faces that Blender repaired when it read them: it cuts some into several, which have no number (-1).
        rest = []

        def world(o, polygon):
            c = sum((o.data.vertices[v].co for v in polygon.vertices), Vector()) / len(polygon.vertices)
            c, n = o.matrix_world @ c, o.matrix_world.to_3x3() @ polygon.normal
            return (c.x, c.z, -c.y), (n.x, n.z, -n.y)

        def material(o, polygon):
            slots = o.material_slots
            return slots[polygon.material_index].material.name if slots and slots[0].material else None

        for o in objects:
            ids[o] = [-1] * len(o.data.polygons)
            for polygon in o.data.polygons:  # Blender turns the axes of the object, not its vertices'
                corners = [tuple(o.data.vertices[v].co) for v in polygon.vertices]
                found = numbers.get((different(corners), material(o, polygon)))
                if not found:
                    rest.append((o, polygon))
                    continue
                used.add(found[-1])
                ids[o][polygon.index] = found.pop() + 1
        cut = []
        for o, polygon in rest:  # the nearest face of its material with the same vector of area
            key, normal = world(o, polygon)
            vector = [polygon.area * x for x in normal]
            fits = [(math.dist(job["centroids"][m], key), m) for m in range(len(job["centroids"]))
                    if m not in used and material(o, polygon) in (None, job["materials"][m]) and
                    math.dist(job["vectors"][m], vector) < 2e-3 * polygon.area + 1e-5 and
                    math.dist(job["centroids"][m], key) ** 2 < 4 * polygon.area + 1e-4]
            if fits:
                found = min(fits)[1]
                used.add(found)
                ids[o][polygon.index] = found + 1
            else:
                cut.append((o, polygon))
        missing = len(cut) - pieces(cut, used, ids, world, material)
        original = {}
        for o in objects:
            o.data.attributes.new("face_id", "INT", "FACE").data.foreach_set("value", ids[o])
            o["before"] = [x for row in o.matrix_world for x in row]
            first = len(places)
            places.extend(o.matrix_world @ v.co for v in o.data.vertices)
            own = [tuple(p.vertices) for p in o.data.polygons]
            loops.extend([first + v for v in p] for p in own)
            owners.extend((number, material(o, p)) for number, p in zip(ids[o], o.data.polygons))
            original[o.name] = BVHTree.FromPolygons(places[first:], own), owners[-len(own):]
        original[None] = BVHTree.FromPolygons(places, loops), owners
        return missing, original

    def pieces(cut, used, ids, world, material):
        """Numbers the polygons that together are one face: of its material, in its plane and with its area."""
        of, numbered = {}, 0
        for o, polygon in cut:
            key, normal = world(o, polygon)
            for m, at in enumerate(job["centroids"]):
                whole = math.hypot(*job["vectors"][m])
                if m not in used and whole > polygon.area and material(o, polygon) in (None, job["materials"][m]) and \
                        sum(a * b for a, b in zip(job["vectors"][m], normal)) > 0.999 * whole and \
                        abs(sum((a - b) * n for a, b, n in zip(at, key, normal))) < 2e-3 and \
                        math.dist(at, key) ** 2 < 4 * whole:
                    of.setdefault(m, []).append((o, polygon))
        for m, found in of.items():
            whole = math.hypot(*job["vectors"][m])
            if abs(sum(polygon.area for _, polygon in found) - whole) > 0.01 * whole:
                continue  # some are of another face
            for o, polygon in found:
                if ids[o][polygon.index] < 0:
                    ids[o][polygon.index] = m + 1
                    numbered += 1
        return numbered

    def spread(a, b, c, n):
        """n * n points of a triangle, each for an equal part of its area."""
        for i in range(n):
            for k in range(n - i):
                for third in (1 / 3, 2 / 3) if i + k < n - 1 else (1 / 3,):
                    yield a + (i + third) / n * (b - a) + (k + third) / n * (c - a)

    def unchanged(mesh, polygon, number, back):
        """Whether the polygon is the original face with its number. Its nearest points can be those of a neighbour:
        of faces narrower than a millimetre."""
        corners = [back @ mesh.vertices[v].co for v in polygon.vertices]
        c, n = sum(corners, Vector()) / len(corners), Vector()
        for i, corner in enumerate(corners):
            n += (corner - c).cross(corners[(i + 1) % len(corners)] - c) / 2
        return number > 0 and len(corners) == job["corners"][number - 1] and \
            math.dist((c.x, c.z, -c.y), job["centroids"][number - 1]) < 1e-3 and \
            math.dist((n.x, n.z, -n.y), job["vectors"][number - 1]) < 1e-3 * n.length + 1e-5

    def nearest(original, point, normal, allowed=lambda i: True):
        """[(distance, face, how far the point is beside it)] of the original faces that look the same way and are
        nearest to the point, at most 0.6 m away: the nearest one, and all that are as near up to 0.1 mm."""
        def beside(location, n):
            return (point - location - (point - location).dot(n) * n).length

        for reach in (0.01, 0.05, 0.2, 0.6):  # a large one finds very many faces
            at = [(d, i, beside(location, n)) for location, n, i, d in original[0].find_nearest_range(point, reach)
                  if n.dot(normal) > 0.5 and allowed(i)]
            least = min(at)[0] + 1e-4 if at else 0.0
            if at and (least <= reach or reach == 0.6):
                return [one for one in at if one[0] <= least]
        return []

    def covered(mesh, polygon, triangles, back, original):
        """{number of an original face: area of it that the polygon covers}, by its nearest points: of all faces,
        and of those of its material where there are any."""
        owners = original[1]
        own = mesh.materials[polygon.material_index].name if mesh.materials else None
        normal = (back.to_3x3().inverted().transposed() @ polygon.normal).normalized()
        by_place, by_material = {}, {}
        for corners in triangles:
            a, b, c = (back @ mesh.vertices[v].co for v in corners)
            size = (b - a).cross(c - a).length
            for point in spread(a, b, c, 12 if len(triangles) < 9 else 6):
                at = nearest(original, point, normal)
                same = nearest(original, point, normal, lambda i: owners[i][1] == own)
                for area, faces in ((by_place, at), (by_material, same or at)):
                    number = owners[min(faces)[1]][0] if faces else 0
                    area[number] = area.get(number, 0.0) + size
        whole = sum(by_place.values()) or 1.0
        return [{number: size / whole for number, size in area.items()} for area in (by_place, by_material)]

    def lies_on(mesh, polygon, triangles, back, original, own):
        """{number of an original face of the object: area of it that has the polygon's nearest points}. Original
        faces that lie on each other have all of them. The face `own`, whose number the polygon has, is not where the
        polygon lies beside it."""
        owners = original[1]
        normal = (back.to_3x3().inverted().transposed() @ polygon.normal).normalized()
        on, whole = {}, 0.0
        for corners in triangles:
            a, b, c = (back @ mesh.vertices[v].co for v in corners)
            size = (b - a).cross(c - a).length
            for point in spread(a, b, c, 6):
                whole += size
                for number in {owners[i][0] for d, i, beside in nearest(original, point, normal)
                               if owners[i][0] != own or beside < 0.3 * d + 1e-3}:
                    on[number] = on.get(number, 0.0) + size
        return {number: area / (whole or 1.0) for number, area in on.items()}

    def write(path, original, kind):
        """Writes the level and its faces in the order of the file."""
        bpy.ops.wm.obj_export(filepath=path)
        place = {line[2:-1]: k for k, line in enumerate(l for l in open(path) if l.startswith("o "))}
        rows = []
        graph = bpy.context.evaluated_depsgraph_get()
        meshes = [o for o in bpy.context.scene.objects if o.type == "MESH"]
        for o in sorted(meshes, key=lambda o: place.get(o.name.replace(" ", "_"), -1)):
            shown = o.evaluated_get(graph)
            mesh = shown.to_mesh()
            ids = [0] * len(mesh.polygons)
            layer = mesh.attributes.get("face_id")
            if layer is not None and layer.domain == "FACE" and len(layer.data) == len(ids):
                layer.data.foreach_get("value", ids)
            between = json.loads(o.get("between", "{}"))
            side = -1.0 if o.matrix_world.determinant() < 0.0 else 1.0
            if original:
                mesh.calc_loop_triangles()
                triangles = [[] for _ in ids]
                for t in mesh.loop_triangles:
                    triangles[t.polygon_index].append(tuple(t.vertices))
                before = list(o["before"])
                back = Matrix([before[i:i + 4] for i in (0, 4, 8, 12)])
            for polygon, number in sorted(zip(mesh.polygons, ids), key=lambda p: p[0].material_index):
                corners = [o.matrix_world @ mesh.vertices[v].co for v in polygon.vertices]
                c = sum(corners, Vector()) / len(corners)
                n = Vector()
                for i, corner in enumerate(corners):
                    n += (corner - c).cross(corners[(i + 1) % len(corners)] - c)
                n = side * n.normalized()
                rows.append((number, c.x, c.z, -c.y, n.x, n.z, -n.y))
                if not original:
                    continue
                face = (mesh, polygon, triangles[polygon.index], back)
                if unchanged(mesh, polygon, number, back):
                    rows[-1] += ({number: 1.0},) * (2 if kind == MERGED else 1)
                elif kind == MERGED:
                    rows[-1] += tuple(covered(*face, original[None]))
                else:
                    on = lies_on(*face, original[o.name], number)
                    on.update((n, 1.0) for n in between.get(str(polygon.index), ()))
                    rows[-1] += (on,)
            shown.to_mesh_clear()
        json.dump(rows, open(path + ".truth", "w"))

    def bm_edit(o, change):
        b = bmesh.new()
        b.from_mesh(o.data)
        b.faces.ensure_lookup_table()
        b.verts.ensure_lookup_table()
        b.edges.ensure_lookup_table()
        change(b)
        b.to_mesh(o.data)
        b.free()

    def modifier(o, kind, **values):
        m = o.modifiers.new(kind, kind)
        for name, value in values.items():
            setattr(m, name, value)

    def center(o):
        return o.matrix_world @ (sum((Vector(c) for c in o.bound_box), Vector()) / 8)

    def apply(o, matrix, about=None):
        if about is not None:
            matrix = Matrix.Translation(about) @ matrix @ Matrix.Translation(-about)
        o.matrix_world = matrix @ o.matrix_world

    def to_all(objects, matrix):
        for o in objects:
            apply(o, matrix)

    def joined(objects):
        for o in objects:
            o.select_set(True)
        bpy.context.view_layer.objects.active = objects[0]
        bpy.ops.object.join()
        return objects[0]

    def bake(o):
        o.data.transform(o.matrix_world)
        o.matrix_world = Matrix()

    def turn(angle, axis="Z"):
        return Matrix.Rotation(angle, 4, axis)

    def scale(x, y, z):
        return Matrix.Diagonal((x, y, z, 1.0))

    def big(objects, r):
        return r.choice(sorted(objects, key=lambda o: -len(o.data.polygons))[:3])

    def some(objects, r, share=0.5):
        return [o for o in objects if r.random() < share] or [r.choice(objects)]

    def pick(r, sequence, share):
        return [f for f in sequence if r.random() < share]

    def tile(o):
        """The most frequent length of an edge along x."""
        lengths = {}
        for e in o.data.edges:
            d = o.data.vertices[e.vertices[0]].co - o.data.vertices[e.vertices[1]].co
            if abs(d.x) > 0.99 * d.length:
                lengths[round(d.length, 4)] = lengths.get(round(d.length, 4), 0) + 1
        return max(lengths, key=lengths.get) if lengths else 1.0

    def flip(o):
        bm_edit(o, lambda b: bmesh.ops.reverse_faces(b, faces=b.faces))

    def triangulate(o):
        bm_edit(o, lambda b: bmesh.ops.triangulate(b, faces=b.faces))

    def delete_some(o, r, share):
        bm_edit(o, lambda b: bmesh.ops.delete(b, geom=pick(r, b.faces, share), context="FACES"))

    def subdivide(o):
        bm_edit(o, lambda b: bmesh.ops.subdivide_edges(b, edges=b.edges, cuts=1, use_grid_fill=True))

    def inset(o, r, share):
        bm_edit(o, lambda b: bmesh.ops.inset_individual(b, faces=pick(r, b.faces, share), thickness=0.1 * tile(o)))

    def poke(o, r, share):
        bm_edit(o, lambda b: bmesh.ops.poke(b, faces=pick(r, b.faces, share)))

    def extrude(o, r, share):
        def change(b):
            made = bmesh.ops.extrude_discrete_faces(b, faces=pick(r, b.faces, share))
            for f in made["faces"]:
                bmesh.ops.translate(b, verts=list(f.verts), vec=f.normal * r.uniform(0.1, 0.5))
        bm_edit(o, change)

    def bevel(o, r):
        def change(b):
            edges = [e for e in b.edges if len(e.link_faces) == 2 and e.calc_face_angle(0.0) > 0.5]
            made = bmesh.ops.bevel(b, geom=edges, offset=r.uniform(0.02, 0.08), segments=r.choice([1, 2]), affect="EDGES")
            number = b.faces.layers.int["face_id"]
            for face in made["faces"]:  # they are between faces; Blender gives them the number of one of these
                face[number] = 0
            # Of a strip the faces at its sides, of a corner those of its strips; a strip may be two side by side.
            numbers = {face: {face[number]} - {0} for face in b.faces}
            for _ in range(2):
                beside = {face: set().union(*(numbers[f] for e in face.edges for f in e.link_faces))
                          for face in made["faces"]}
                numbers.update(beside)
            b.faces.index_update()
            o["between"] = json.dumps({face.index: sorted(numbers[face]) for face in made["faces"]})
        bm_edit(o, change)

    def dissolve(o):
        bm_edit(o, lambda b: bmesh.ops.dissolve_limit(b, angle_limit=0.01, verts=b.verts, edges=b.edges,
                                                      delimit={"MATERIAL"}))

    def knife(o, r):
        c = center(o)
        n = Vector((r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-0.3, 0.3))).normalized()
        local = o.matrix_world.inverted()
        bm_edit(o, lambda b: bmesh.ops.bisect_plane(b, geom=b.verts[:] + b.edges[:] + b.faces[:],
                                                    plane_co=local @ c, plane_no=n))

    def jitter(o, r, share):
        def change(b):
            for v in pick(r, b.verts, share):
                v.co += Vector((r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1))) * 0.1 * tile(o)
        bm_edit(o, change)

    def separate(objects):
        for o in objects:
            o.select_set(True)
        bpy.context.view_layer.objects.active = objects[0]
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.separate(type="LOOSE")
        bpy.ops.object.mode_set(mode="OBJECT")

    def move_island(o, r):
        def change(b):
            seen, islands = set(), []
            for start in b.verts:
                if start.index in seen:
                    continue
                todo, island = [start], []
                seen.add(start.index)
                while todo:
                    v = todo.pop()
                    island.append(v)
                    for e in v.link_edges:
                        w = e.other_vert(v)
                        if w.index not in seen:
                            seen.add(w.index)
                            todo.append(w)
                islands.append(island)
            bmesh.ops.translate(b, verts=r.choice(islands), vec=(tile(o), 0, 0))
        bm_edit(o, change)

    def rename(objects):
        for i, o in enumerate(objects):
            o.name = "thing_%d" % i
        for m in bpy.data.materials:
            m.name += ".004"

    def shuffle(objects, r):
        for o in objects:
            def change(b):
                order = list(range(len(b.faces)))
                r.shuffle(order)
                for f, k in zip(b.faces, order):
                    f.index = k
                b.faces.sort()
            bm_edit(o, change)

    def copy_beside(objects, r):
        o = big(objects, r)
        copy = o.copy()
        copy.data = o.data.copy()
        copy.matrix_world = Matrix.Translation((tile(o) * r.randint(1, 30), 0, 0)) @ o.matrix_world
        bpy.context.scene.collection.objects.link(copy)

    def each(objects, change, *rest):
        for o in objects:
            change(o, *rest)

    def delete_objects(objects):
        for o in objects:
            bpy.data.objects.remove(o)

    def remesh(o):
        modifier(o, "REMESH", mode="VOXEL", voxel_size=max(0.05, 0.4 * tile(o)))

    def by(r, low, high):
        return r.choice([-1, 1]) * r.uniform(low, high)

    edits = [
        ("nothing", RIGID, lambda o, r: None),
        ("all joined", RIGID, lambda o, r: joined(o)),
        ("separated into loose parts", RIGID, lambda o, r: separate(o)),
        ("objects and materials renamed", RIGID, lambda o, r: rename(o)),
        ("faces in another order", RIGID, lambda o, r: shuffle(o, r)),
        ("one object moved by one tile", RIGID,
         lambda o, r: (lambda x: apply(x, Matrix.Translation((tile(x), 0, 0))))(big(o, r))),
        ("one object moved", RIGID,
         lambda o, r: apply(big(o, r), Matrix.Translation((by(r, 0.1, 9), by(r, 0.1, 9), by(r, 0, 3))))),
        ("everything moved", RIGID, lambda o, r: to_all(o, Matrix.Translation((10, by(r, 0, 9), by(r, 0, 9))))),
        ("half of the objects moved, each its own way", RIGID,
         lambda o, r: [apply(x, Matrix.Translation((by(r, 0.1, 9), by(r, 0.1, 9), 0))) for x in some(o, r)]),
        ("one object turned by 1 degree", RIGID,
         lambda o, r: (lambda x: apply(x, turn(math.radians(1)), center(x)))(big(o, r))),
        ("one object turned", RIGID,
         lambda o, r: (lambda x: apply(x, turn(r.uniform(0.1, 3)), center(x)))(big(o, r))),
        ("one object turned by 90 degrees", RIGID,
         lambda o, r: (lambda x: apply(x, turn(math.pi / 2), center(x)))(big(o, r))),
        ("everything turned about the upward axis", RIGID, lambda o, r: to_all(o, turn(r.uniform(0.1, 3)))),
        ("everything turned about another axis", RIGID,
         lambda o, r: to_all(o, turn(r.uniform(0.1, 3), r.choice("XY")))),
        ("everything scaled evenly", RIGID, lambda o, r: to_all(o, Matrix.Scale(r.uniform(0.3, 3), 4))),
        ("metres to centimetres", RIGID, lambda o, r: to_all(o, Matrix.Scale(100, 4))),
        ("centimetres to metres", RIGID, lambda o, r: to_all(o, Matrix.Scale(0.01, 4))),
        ("one object scaled evenly", RIGID,
         lambda o, r: (lambda x: apply(x, Matrix.Scale(r.uniform(0.5, 2), 4), center(x)))(big(o, r))),
        ("everything scaled unevenly", RIGID,
         lambda o, r: to_all(o, scale(r.uniform(0.5, 2), r.uniform(0.5, 2), r.uniform(0.5, 2)))),
        ("one object scaled unevenly", RIGID,
         lambda o, r: (lambda x: apply(x, scale(r.uniform(0.5, 2), r.uniform(0.5, 2), 1), center(x)))(big(o, r))),
        ("everything mirrored", RIGID, lambda o, r: to_all(o, scale(-1, 1, 1))),
        ("one object mirrored", RIGID,
         lambda o, r: (lambda x: apply(x, scale(1, -1, 1), center(x)))(big(o, r))),
        ("mirrored in edit mode, normals left", RIGID,
         lambda o, r: each(o, lambda x: (bake(x), bm_edit(x, lambda b: bmesh.ops.scale(b, verts=b.verts, vec=(-1, 1, 1)))))),
        ("all normals flipped", RIGID, lambda o, r: each(o, flip)),
        ("one object's normals flipped", RIGID, lambda o, r: flip(big(o, r))),
        ("moved, then turned", RIGID,
         lambda o, r: (to_all(o, Matrix.Translation((by(r, 1, 9), 0, 0))),
                       (lambda x: apply(x, turn(r.uniform(0.1, 3)), center(x)))(big(o, r)))),
        ("turned, then scaled unevenly", RIGID,
         lambda o, r: to_all(o, scale(r.uniform(0.5, 2), r.uniform(0.5, 2), 1) @ turn(r.uniform(0.1, 3)))),
        ("joined, then moved", RIGID, lambda o, r: apply(joined(o), Matrix.Translation((10, by(r, 0, 9), 0)))),
        ("joined, one island moved by a tile", RIGID, lambda o, r: move_island(joined(o), r)),
        ("a copy beside it", RIGID, lambda o, r: copy_beside(o, r)),
        ("an array of three", RIGID, lambda o, r: modifier(big(o, r), "ARRAY", count=3)),
        ("one object deleted", RIGID, lambda o, r: delete_objects([big(o, r)])),
        ("faces deleted", OTHER, lambda o, r: each(o, delete_some, r, r.uniform(0.05, 0.4))),
        ("triangulated", OTHER, lambda o, r: each(o, triangulate)),
        ("faces deleted, then triangulated", OTHER,
         lambda o, r: (each(o, delete_some, r, r.uniform(0.05, 0.3)), each(o, triangulate))),
        ("triangulated, then moved", OTHER,
         lambda o, r: (each(o, triangulate), to_all(o, Matrix.Translation((by(r, 1, 9), by(r, 1, 9), 0))))),
        ("moved by one tile, faces deleted", OTHER,
         lambda o, r: (lambda x: (apply(x, Matrix.Translation((tile(x), 0, 0))), delete_some(x, r, 0.1)))(big(o, r))),
        ("subdivided", OTHER, lambda o, r: each(o, subdivide)),
        ("one object subdivided, then moved", OTHER,
         lambda o, r: (lambda x: (subdivide(x), apply(x, Matrix.Translation((by(r, 1, 9), 0, 0)))))(big(o, r))),
        ("faces inset", RESHAPED, lambda o, r: each(o, inset, r, r.uniform(0.1, 0.5))),
        ("faces poked", OTHER, lambda o, r: each(o, poke, r, r.uniform(0.1, 0.5))),
        ("faces extruded", OTHER, lambda o, r: each(o, extrude, r, r.uniform(0.02, 0.2))),
        ("extruded, then turned", OTHER,
         lambda o, r: (each(o, extrude, r, 0.05), to_all(o, turn(r.uniform(0.1, 3))))),
        ("edges bevelled", RESHAPED, lambda o, r: each(o, bevel, r)),
        ("flat areas dissolved", MERGED, lambda o, r: each(o, dissolve)),
        ("flat areas dissolved, then moved", MERGED,
         lambda o, r: (each(o, dissolve), to_all(o, Matrix.Translation((by(r, 1, 9), by(r, 1, 9), 0))))),
        ("decimated", MERGED, lambda o, r: modifier(big(o, r), "DECIMATE", ratio=r.uniform(0.4, 0.9))),
        ("decimated, then turned", MERGED,
         lambda o, r: (lambda x: (modifier(x, "DECIMATE", ratio=r.uniform(0.4, 0.9)),
                                  apply(x, turn(r.uniform(0.1, 3)), center(x))))(big(o, r))),
        ("remeshed", MERGED, lambda o, r: remesh(big(o, r))),
        ("cut with the knife", OTHER, lambda o, r: each(o, knife, r)),
        ("vertices moved", RESHAPED, lambda o, r: each(o, jitter, r, r.uniform(0.02, 0.2))),
        ("thickened (solidify)", OTHER, lambda o, r: modifier(big(o, r), "SOLIDIFY", thickness=0.2)),
        ("a mirrored half added (modifier)", OTHER, lambda o, r: modifier(big(o, r), "MIRROR")),
        ("edges split", OTHER, lambda o, r: each(o, lambda x: modifier(x, "EDGE_SPLIT"))),
    ]
    progress = json.load(open(job_path + ".progress"))
    for i, (name, kind, change) in enumerate(edits):
        if job["only"] not in name or kind not in job["kinds"] or i < progress["next"]:
            continue
        progress["next"] = i + 1
        json.dump(dict(progress, trying=name), open(job_path + ".progress", "w"))
        objects = read(job["obj"])
        missing, original = tag(objects)
        if missing:
            print("UNTAGGED", missing, file=sys.stderr)
        change(objects, random.Random(job["seed"] * 1000 + i))
        folder = os.path.join(job["folder"], "%02d" % i)
        os.makedirs(folder, exist_ok=True)
        write(os.path.join(folder, "level.obj"), original if kind in (MERGED, RESHAPED) else None, kind)
        progress["done"].append((name, kind, folder))
        json.dump(progress, open(job_path + ".progress", "w"))
    json.dump(progress["done"], open(job_path + ".done", "w"))


# ---------------------------------------------------------------------------------------------------------------
# Levels


class Obj:
    def __init__(self):
        self.vertices, self.index, self.objects = [], {}, []

    def begin(self, name):
        self.objects.append((name, []))
        self.index = {}

    def vertex(self, p):
        key = tuple(round(x, 5) for x in p)
        if key not in self.index:
            self.vertices.append(key)
            self.index[key] = len(self.vertices)
        return self.index[key]

    def face(self, material, *corners):
        self.objects[-1][1].append((material, [self.vertex(c) for c in corners]))

    def grid(self, material_of, origin, right, up, columns, rows):
        at = lambda i, k: [o + i * a + k * b for o, a, b in zip(origin, right, up)]
        for i in range(columns):
            for k in range(rows):
                self.face(material_of(i, k), at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1))

    def box(self, material, low, high, cells=1):
        (x, y, z), (X, Y, Z) = low, high
        dx, dy, dz = (X - x) / cells, (Y - y) / cells, (Z - z) / cells
        m = lambda i, k: material
        self.grid(m, (x, Y, Z), (dx, 0, 0), (0, 0, -dz), cells, cells)
        self.grid(m, (x, y, z), (dx, 0, 0), (0, 0, dz), cells, cells)
        self.grid(m, (x, y, Z), (dx, 0, 0), (0, dy, 0), cells, cells)
        self.grid(m, (X, y, z), (-dx, 0, 0), (0, dy, 0), cells, cells)
        self.grid(m, (X, y, Z), (0, 0, -dz), (0, dy, 0), cells, cells)
        self.grid(m, (x, y, z), (0, 0, dz), (0, dy, 0), cells, cells)

    def write(self, path):
        with open(path, "w") as f:
            f.write("mtllib level.mtl\n")
            for v in self.vertices:
                f.write("v %g %g %g\n" % v)
            for name, faces in self.objects:
                f.write("o %s\n" % name)
                last = None
                for material, corners in faces:
                    if material != last:
                        f.write("usemtl %s\n" % material)
                        last = material
                    f.write("f " + " ".join(map(str, corners)) + "\n")
        names = sorted({m for _, faces in self.objects for m, _ in faces})
        with open(os.path.join(os.path.dirname(path), "level.mtl"), "w") as f:
            for name in names:
                f.write("newmtl %s\nKd 0.5 0.5 0.5\n" % name)


def random_level(path, seed):
    """A plaza, a hall, stairs, a hill and crates. Tiles repeat, as in levels they do."""
    r = random.Random(seed)
    obj = Obj()
    t = r.choice([1.0, 1.5, 2.0, 2.5])
    columns, rows = r.randint(10, 16), r.randint(6, 12)
    obj.begin("plaza")
    obj.grid(lambda i, k: "stone" if (i // 3 + k // 3) % 2 else "tile", (-3 * t, 0, 2 * t), (t, 0, 0), (0, 0, -t),
             columns, rows)
    obj.begin("hall")
    w, d, h = r.randint(4, 7), r.randint(5, 9), r.randint(2, 3)
    x, z = -3 * t - (w + 2) * t, 0.0
    obj.grid(lambda i, k: "wood", (x, 0.1, z), (t, 0, 0), (0, 0, -t), w, d)
    for side in range(2):
        obj.grid(lambda i, k: "plaster", (x + side * w * t, 0.1, z), (0, 0, -t), (0, t, 0), d, h)
        obj.grid(lambda i, k: "plaster", (x, 0.1, z - side * d * t), (t, 0, 0), (0, t, 0), w, h)
    obj.begin("stairs")
    for i in range(r.randint(6, 12)):
        obj.box("stone", (20, 0, 10 - 0.4 * i), (22, 0.2 * (i + 1), 10.4 - 0.4 * i - 0.02))
    obj.begin("hill")
    n, m = r.randint(8, 14), r.randint(8, 14)
    height = [[r.uniform(0, 0.6) for _ in range(m + 1)] for _ in range(n + 1)]
    for i in range(n):
        for k in range(m):
            at = lambda a, b: (30 + 1.2 * a, height[a][b], -1.1 * b)
            obj.face("grass", at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1))
    obj.begin("crates")
    for i in range(r.randint(5, 12)):
        cx, cz, s = 5 * i - 20 + r.uniform(0, 2), 15 + r.uniform(0, 9), r.choice([0.5, 1, 1, 1.7])
        obj.box("wood", (cx, 0, cz), (cx + s, s, cz + s), r.choice([1, 1, 2]))
    obj.begin("tower")
    obj.box("stone", (10, 0, -40), (10 + r.uniform(4, 9), r.uniform(5, 12), -33), r.randint(3, 5))
    obj.write(path)


def fetch_map(program, name, obj):
    """Writes a stranger's geometry as OBJ."""
    archive, inside = name.split(":") if ":" in name else (None, name)
    source = os.path.join(os.path.dirname(obj), os.path.basename(inside))
    if archive:
        open(source, "wb").write(zipfile.ZipFile(archive).read(inside))
    else:
        shutil.copy(inside, source)
    subprocess.run([program, "export", source, "--obj", obj], check=True, stdout=subprocess.DEVNULL)


def polygons(path):
    """The corners of each face and its material."""
    vertices, material = [], ""
    for line in open(path):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append(tuple(map(float, words[1:4])))
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "f":
            yield [vertices[int(w.split("/")[0]) - 1] for w in words[1:]], material


def read_obj(path):
    """The faces: centroid, area vector, material, number of corners."""
    faces = []
    for c, material in polygons(path):
        mid = tuple(sum(p[i] for p in c) / len(c) for i in range(3))
        n = [0.0, 0.0, 0.0]
        for i, p in enumerate(c):
            a = [p[k] - mid[k] for k in range(3)]
            b = [c[(i + 1) % len(c)][k] - mid[k] for k in range(3)]
            n[0] += a[1] * b[2] - a[2] * b[1]
            n[1] += a[2] * b[0] - a[0] * b[2]
            n[2] += a[0] * b[1] - a[1] * b[0]
        faces.append((mid, tuple(0.5 * x for x in n), material, len(c)))
    return faces


# ---------------------------------------------------------------------------------------------------------------
# Paint

TYPES = ["ice", "sticky", "bouncy", "ladder", "hazard"]


def paint(faces, seed):
    """[face] a type or None: patches, and single faces among them. Faces at one place have one type: the rows that
    this script writes are without their corners and do not tell them apart."""
    r = random.Random(seed + 77)
    patch, there = {}, {}
    types = []
    for mid, vector, material, _ in faces:
        key = (material, round(mid[0] / 4), round(mid[1] / 4), round(mid[2] / 4))
        if key not in patch:
            patch[key] = r.choice(TYPES + [None, None])
        kind = r.choice(TYPES + [None]) if r.random() < 0.25 else patch[key]
        types.append(there.setdefault((material, tuple(round(x, 5) for x in mid + vector)), kind))
    return types


def row(mid, vector):
    area = math.sqrt(sum(x * x for x in vector))
    normal = [x / area if area > 0 else 0.0 for x in vector]
    return "0" * 16 + " %.9g,%.9g,%.9g %.4f,%.4f,%.4f %.9g" % (*mid, *normal, area)


def save(program, obj, folder):
    """Opens and saves the level, with the guessed faces as a selection if there are any."""
    script = os.path.join(folder, "save.script")
    for lines in ("command select.guessed\nselect save guessed\n", ""):
        open(script, "w").write(lines + "command file.save\n")
        done = subprocess.run([program, "edit", obj, "--headless", "--script", script], capture_output=True, text=True)
        if done.returncode == 0:
            return
    raise SystemExit(done.stdout + done.stderr)


def unpacked(text):
    import base64
    data = base64.b64decode(text + "=" * (-len(text) % 4))
    for i in range(0, len(data), 23):
        code = int.from_bytes(data[i + 18:i + 21], "little")
        u, v = ((code & 0xFFF) - 2047) / 2047, ((code >> 12) - 2047) / 2047
        z = 1 - abs(u) - abs(v)
        sign = lambda x: -1 if x < 0 else 1
        if z < 0:
            u, v = (1 - abs(v)) * sign(u), (1 - abs(u)) * sign(v)
        yield struct.unpack("<3f", data[i + 6:i + 18]), (u, v, z)


def keys_of(group):
    for text in group["faces"]:
        words = text.split()
        yield tuple(map(float, words[1].split(","))), tuple(map(float, words[2].split(",")))
    for text in group.get("packed", []):
        yield from unpacked(text)


def found_paint(level_file):
    """[(centroid, normal, type)] of the painted faces, and [(centroid, normal)] of the guesses."""
    level = json.load(open(level_file))
    rows = [(at, normal, group["type"]) for group in level["overrides"] for at, normal in keys_of(group)]
    guessed = [key for saved in level.get("selections", []) for group in saved["faces"] for key in keys_of(group)]
    return rows, guessed


class Places:
    """The faces of an edit by their place."""

    def __init__(self, places):
        """`places`: of each face its centroid and its normal."""
        self.places = places
        size = max((abs(x) for at, _ in places for x in at), default=1.0)
        self.step = 2e-6 + 1e-6 * size  # what the rounding of Blender's file and of floats allows
        self.cells = {}
        for k, (at, _) in enumerate(places):
            self.cells.setdefault(tuple(math.floor(x / self.step) for x in at), []).append(k)

    def take(self, at, normal, taken, wanted=lambda face: False):
        """The face there that is not taken; of several at the very same place one that is wanted."""
        c = [math.floor(x / self.step) for x in at]
        near = [k for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                for k in self.cells.get((c[0] + dx, c[1] + dy, c[2] + dz), []) if k not in taken]
        if not near:
            return None
        best = min(near, key=lambda k: round(math.dist(self.places[k][0], at) / self.step -
                   sum(a * b for a, b in zip(self.places[k][1], normal)), 1) - 0.1 * wanted(k))
        taken.add(best)
        return best


class Score:
    def __init__(self):
        self.right = self.wrong = self.unsaid = self.listed = self.faces = self.unclear = self.unplaced = 0

    def add(self, other):
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)

    def row(self):
        return " %.1f %% | %d | %d | %d |" % (100.0 * self.right / max(1, self.faces), self.wrong, self.unsaid, self.listed)


def expected(types, *readings):
    """The types that a merged face may have. By its place or by its material, one is clear from 55 % of its area,
    none below 45 %, and a question between; so is one of which place and material say different things."""
    may = set()
    for covered in readings:
        area = {}
        for number, share in covered.items():
            kind = types[int(number) - 1] if int(number) > 0 else None
            area[kind] = area.get(kind, 0.0) + share
        best = max(area, key=area.get)
        may |= {best} if area[best] > 0.55 else {None} | {kind for kind in area if area[kind] > 0.45}
    return may if len(may) == 1 else may | {None}


def unchanged(truth, edited, original, slack):
    """The faces of `truth` that are, in the edited file, what and where their number's face was."""
    same = set()
    for k, (mid, vector, _, corners) in enumerate(edited):
        if truth[k][0] <= 0:
            continue
        old_mid, old_vector, _, old_corners = original[int(truth[k][0]) - 1]
        if corners == old_corners and math.dist(mid, old_mid) < slack and \
                math.dist(vector, old_vector) < 1e-4 + 1e-3 * math.hypot(*vector):
            same.add(k)
    return same


def types_there(types, first, shares, least):
    """The types of the original faces that have more than this share of a face's nearest points, faces of one type
    together. `first`: of faces at one place, which have the same points and one type, the one that counts."""
    of = {}
    for number, share in shares.items():
        if int(number) > 0:
            face = first[int(number) - 1]
            of[face] = max(share, of.get(face, 0.0))
    sums = {}
    for face, share in of.items():
        sums[types[face]] = sums.get(types[face], 0.0) + share
    return {kind for kind, share in sums.items() if share > least}


def unit(vector):
    length = math.hypot(*vector)
    return [x / length for x in vector] if length > 0.0 else vector


def score(types, truth, rows, guessed, original, edited):
    result = Score()
    places = Places([(mid, unit(vector)) for mid, vector, _, _ in edited])
    if len(truth) != len(edited) or any(math.dist(t[1:4], e[0]) > places.step for t, e in zip(truth, edited)):
        raise SystemExit("Blender wrote the faces in another order than its file says")
    twins = {}  # original faces at one place
    for number, (mid, vector, _, _) in enumerate(original):
        twins.setdefault(tuple(round(x, 3) for x in mid + vector), []).append(number)
    got, taken = {}, set()
    for at, normal, kind in rows:
        face = places.take(at, normal, taken, lambda k: truth[k][0] > 0 and types[int(truth[k][0]) - 1] == kind)
        if face is None:
            result.unplaced += 1
        else:
            got[face] = kind
    taken = set()
    guesses = {places.take(at, normal, taken, lambda k: k in got) for at, normal in guessed}
    if truth and len(truth[0]) > 8:
        # Of several original faces at one place Blender's nearest point is on any: the type of each is right.
        other = list(types)
        for numbers in twins.values():
            for number, twin in zip(numbers, numbers[1:] + numbers[:1]):
                other[number] = types[twin]
        same = unchanged(truth, edited, original, places.step)
        for k, t in enumerate(truth):
            readings = [{int(t[0]): 1.0}] if k in same else t[7:]
            may, kind = expected(types, *readings) | expected(other, *readings), got.get(k)
            may |= {None} if len(may) > 1 else set()
            result.unclear += len(may) > 1
            result.faces += None not in may
            result.right += None not in may and kind in may
            result.listed += None not in may and kind is None
            result.wrong += kind is not None and kind not in may
            result.unsaid += kind is not None and kind not in may and k not in guesses
        return result
    right, wrong, unsaid = set(), set(), set()
    # [reshaped face] the types of the original faces in whose place it may be: one or two, or up to four that it
    # lies between.
    first = {number: numbers[0] for numbers in twins.values() for number in numbers}
    lies_on = [types_there(types, first, t[7], 0.45 if t[0] > 0 else 0.2) if len(t) > 7 else set() for t in truth]
    existing = {int(t[0]) for t in truth if t[0] > 0 and types[int(t[0]) - 1] and
                (len(t) < 8 or t[7].get(str(int(t[0])), 0.0) > 0.55)}
    # Of several at one place that Blender merged, the one that is left may have the type of each.
    left = {int(t[0]) for t in truth}
    merged = {}
    for numbers in twins.values():
        gone = {types[number] for number in numbers if number + 1 not in left}
        merged.update((number + 1, gone) for number in numbers if gone)
    for k, t in enumerate(truth):
        number, kind = int(t[0]), got.get(k)
        if kind is None or number < 0:
            continue
        if number == 0:  # Blender made it: the original face nearest to its place
            near = min(range(len(original)), key=lambda i: math.dist(original[i][0], t[1:4]))
            number, true = -1 - k, types[near]
        else:
            true = types[number - 1]
        if true == kind or kind in merged.get(number, ()) or kind in lies_on[k]:
            right.add(number)
        else:
            wrong.add(number)
            if k not in guesses:
                unsaid.add(number)
    result.right, result.wrong, result.unsaid = len(existing & right - wrong), len(wrong), len(unsaid)
    result.listed, result.faces = len(existing - right - wrong), len(existing)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", action="append", help="one or two programs to compare")
    parser.add_argument("--levels", type=int, default=3, help="random levels")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--shipped", nargs="*", default=[], help="names of levels in assets/levels")
    parser.add_argument("--map", nargs="*", default=[], help="geometry of strangers: a file, or ARCHIVE.pk3:NAME in it")
    parser.add_argument("--only", default="", help="edits whose name contains this")
    kinds = [RIGID, OTHER, MERGED, RESHAPED]
    parser.add_argument("--kinds", nargs="*", default=kinds, choices=kinds, help="edits of these kinds")
    parser.add_argument("--keep", help="folder for the files; its edits are used again")
    args = parser.parse_args()
    programs = args.program or [os.path.join(ROOT, "build/release/editor/slipface")]
    if shutil.which("blender") is None:
        raise SystemExit("Blender is not installed: apt-get install blender")
    scratch = args.keep or tempfile.mkdtemp()
    template = json.load(open(os.path.join(ROOT, "assets/levels/easy.slipface.json")))
    for key in ("light", "platforms", "cameras", "goals"):
        template.pop(key, None)
    total = {}
    levels = [("random %d" % s, s) for s in range(args.seed, args.seed + args.levels)]
    levels += [(name, args.seed) for name in args.shipped + args.map]
    for name, seed in levels:
        folder = os.path.join(scratch, re.sub("[ /:.]", "_", name))
        os.makedirs(folder, exist_ok=True)
        obj = os.path.join(folder, "level.obj")
        if name.startswith("random"):
            random_level(obj, seed)
        elif name in args.map:
            fetch_map(programs[0], name, obj)
        else:
            shutil.copy(os.path.join(ROOT, "assets/levels", name + ".obj"), obj)
            shutil.copy(os.path.join(ROOT, "assets/levels", name + ".mtl"), os.path.join(folder, name + ".mtl"))
        faces = read_obj(obj)
        types = paint(faces, seed)
        groups = {}
        for (mid, vector, material, _), kind in zip(faces, types):
            if kind:
                groups.setdefault((kind, material), []).append(row(mid, vector))
        level = dict(template, mesh="level.obj", rules=[], orphans=[],
                     overrides=[{"type": t, "material": m, "faces": rows} for (t, m), rows in groups.items()])
        job = os.path.join(folder, "job.json")
        done = job + ".done"
        if not os.path.exists(done):
            json.dump({"obj": obj, "folder": folder, "seed": seed, "only": args.only, "kinds": args.kinds,
                       "centroids": [f[0] for f in faces], "vectors": [f[1] for f in faces],
                       "materials": [f[2] for f in faces], "corners": [f[3] for f in faces],
                       "outlines": [c for c, _ in polygons(obj)]}, open(job, "w"))
            json.dump({"next": 0, "done": []}, open(job + ".progress", "w"))
            while not os.path.exists(done):
                run = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1",
                                      "--python", os.path.abspath(__file__), "--", job], capture_output=True, text=True)
                if "UNTAGGED" in run.stderr:
                    sys.stderr.write(run.stderr[-3000:])
                if run.returncode == 1:
                    raise SystemExit("Blender failed\n" + run.stdout[-3000:] + run.stderr[-3000:])
                if run.returncode != 0:  # it crashed: without that edit
                    print("  %s, %s: Blender crashed" % (name, json.load(open(job + ".progress"))["trying"]), file=sys.stderr)
        for p, program in enumerate(programs):
            level_file = os.path.join(folder, "level.slipface.json")
            json.dump(level, open(level_file, "w"))
            save(program, obj, folder)
            for edit, kind, place in json.load(open(done)):
                if args.only not in edit:
                    continue
                edited = os.path.join(place, "level.obj")
                truth = json.load(open(edited + ".truth"))
                if not truth:
                    continue
                here = os.path.join(place, "level.slipface.json")
                shutil.copy(level_file, here)
                save(program, edited, folder)
                one = score(types, truth, *found_paint(here), faces, read_obj(edited))
                total.setdefault((p, edit, kind), Score()).add(one)
                if one.wrong or one.unplaced:
                    print("  %s, %s: %s" % (name, edit, vars(one)), file=sys.stderr)
    print("| edit | kind | faces |" + " right | wrong | unsaid | listed |" * len(programs))
    print("|---|---|---:|" + "---:|---:|---:|---:|" * len(programs))
    for (p, edit, kind), one in total.items():
        if p == 0:
            cells = "".join(total[(q, edit, kind)].row() for q in range(len(programs)))
            print("| %s | %s | %d |%s" % (edit, kind, one.faces, cells))


if "--" in sys.argv and "blender" in os.path.basename(sys.argv[0]):
    inside_blender(sys.argv[sys.argv.index("--") + 1])
else:
    main()
