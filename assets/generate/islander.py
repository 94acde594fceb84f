#!/usr/bin/env python3
"""Writes assets/props/islander.gltf: a figure of rigid parts with the clips "walk" and "idle".

    assets/generate/islander.py assets/props/islander.gltf

Metres, +Y up, looks along -Z; the feet stand at the origin.
"""
import base64, json, math, struct, sys

SIDES = 8
MATERIALS = {"skin": (0.55, 0.27, 0.15), "shirt": (0.02, 0.25, 0.30), "trousers": (0.22, 0.11, 0.05), "straw": (0.72, 0.45, 0.13)}

# name, parent, where it hangs in its parent, material, rings of (height, half width, half depth) from the bottom up
PARTS = [
    ("hips", None, (0, 0.86, 0), "trousers", [(-0.10, 0.15, 0.10), (0.04, 0.18, 0.12), (0.10, 0.17, 0.11)]),
    ("chest", "hips", (0, 0.10, 0), "shirt", [(0.0, 0.17, 0.11), (0.28, 0.22, 0.13), (0.42, 0.19, 0.11), (0.47, 0.07, 0.06)]),
    ("head", "chest", (0, 0.47, 0), "skin", [(0.0, 0.06, 0.06), (0.06, 0.10, 0.11), (0.17, 0.12, 0.13), (0.25, 0.09, 0.10)]),
    ("hat", "head", (0, 0.20, 0), "straw", [(-0.01, 0.26, 0.26), (0.02, 0.25, 0.25), (0.03, 0.14, 0.15), (0.14, 0.10, 0.10)]),
]
for side, x in (("left", -1), ("right", 1)):
    PARTS += [
        (f"{side} upper arm", "chest", (0.24 * x, 0.40, 0), "shirt", [(-0.27, 0.045, 0.05), (0.0, 0.06, 0.065), (0.04, 0.04, 0.045)]),
        (f"{side} lower arm", f"{side} upper arm", (0, -0.27, 0), "skin", [(-0.30, 0.035, 0.05), (-0.22, 0.03, 0.035), (0.02, 0.045, 0.05)]),
        (f"{side} upper leg", "hips", (0.09 * x, -0.04, 0), "trousers", [(-0.42, 0.06, 0.07), (0.0, 0.085, 0.095), (0.05, 0.06, 0.07)]),
        (f"{side} lower leg", f"{side} upper leg", (0, -0.41, 0), "trousers", [(-0.34, 0.05, 0.055), (0.02, 0.062, 0.07)]),
        (f"{side} foot", f"{side} lower leg", (0, -0.34, -0.04), "skin", [(-0.07, 0.055, 0.12), (0.0, 0.04, 0.07)]),
    ]


def triangles(rings):
    """A lathed hull with closed ends."""
    circle = [(math.cos(2 * math.pi * (i + 0.5) / SIDES), math.sin(2 * math.pi * (i + 0.5) / SIDES)) for i in range(SIDES)]
    points = [[(c * w, y, s * d) for c, s in circle] for y, w, d in rings]
    for low, high in zip(points, points[1:]):
        for i in range(SIDES):
            k = (i + 1) % SIDES
            yield low[i], high[i], high[k]
            yield low[i], high[k], low[k]
    for i in range(1, SIDES - 1):
        yield points[0][0], points[0][i], points[0][i + 1]
        yield points[-1][0], points[-1][i + 1], points[-1][i]


def about_x(degrees):
    half = math.radians(degrees) / 2
    return (math.sin(half), 0.0, 0.0, math.cos(half))


def walk(t):
    """Angles about x at the part `t` of a cycle, and how far the hips rise."""
    angles = {}
    for side, phase in (("left", 0.0), ("right", 0.5)):
        swing = math.sin(2 * math.pi * (t + phase))
        lift = max(0.0, math.cos(2 * math.pi * (t + phase)))
        angles[f"{side} upper leg"] = 32 * swing + 8 * lift
        angles[f"{side} lower leg"] = -8 - 50 * lift
        angles[f"{side} foot"] = 10 * lift - 6 * swing
        angles[f"{side} upper arm"] = -28 * swing
        angles[f"{side} lower arm"] = 28 - 10 * swing
    angles["chest"] = -4
    return angles, -0.03 + 0.025 * math.cos(4 * math.pi * t)


def idle(t):
    breath = math.sin(2 * math.pi * t)
    angles = {"chest": 1.5 * breath, "head": -1.5 * breath}
    for side in ("left", "right"):
        angles[f"{side} upper arm"] = 2 * breath
        angles[f"{side} lower arm"] = 10 + 2 * breath
    return angles, 0.004 * breath


class File:
    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def numbers(self, rows, kind):
        data = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        columns = [[struct.unpack("<f", struct.pack("<f", v))[0] for v in column] for column in zip(*rows)]
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": 5126, "count": len(rows), "type": kind,
                               "min": [min(c) for c in columns], "max": [max(c) for c in columns]})
        return len(self.accessors) - 1


def main(path):
    file, nodes, meshes, index = File(), [], [], {}
    for name, parent, at, material, rings in PARTS:
        corners = [corner for triangle in triangles(rings) for corner in triangle]
        meshes.append({"name": name, "primitives": [{"attributes": {"POSITION": file.numbers(corners, "VEC3")},
                                                     "material": list(MATERIALS).index(material)}]})
        index[name] = len(nodes)
        nodes.append({"name": name, "mesh": len(meshes) - 1, "translation": list(at)})
        if parent:
            nodes[index[parent]].setdefault("children", []).append(index[name])
    animations = []
    for clip, motion, seconds, keys in (("walk", walk, 0.9, 16), ("idle", idle, 3.0, 12)):
        times = file.numbers([(seconds * i / keys,) for i in range(keys + 1)], "SCALAR")
        poses = [motion(i / keys % 1.0) for i in range(keys + 1)]
        samplers, channels = [], []

        def track(node, path, rows, kind):
            samplers.append({"input": times, "output": file.numbers(rows, kind)})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": index[node], "path": path}})

        for name in poses[0][0]:
            track(name, "rotation", [about_x(angles[name]) for angles, _ in poses], "VEC4")
        track("hips", "translation", [(0, PARTS[0][2][1] + rise, 0) for _, rise in poses], "VEC3")
        animations.append({"name": clip, "samplers": samplers, "channels": channels})
    root = {
        "asset": {"version": "2.0", "generator": "assets/generate/islander.py"}, "scene": 0,
        "scenes": [{"nodes": [0]}], "nodes": nodes, "meshes": meshes, "animations": animations,
        "materials": [{"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1]}} for name, color in MATERIALS.items()],
        "accessors": file.accessors, "bufferViews": file.views,
        "buffers": [{"byteLength": len(file.bytes), "uri": "data:application/octet-stream;base64," + base64.b64encode(file.bytes).decode()}]}
    with open(path, "w") as out:
        json.dump(root, out, separators=(",", ":"))
        out.write("\n")


main(sys.argv[1])
