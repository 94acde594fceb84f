#!/usr/bin/env python3
"""Writes glTF files in every form that gltfpack and gltf-transform know, and checks that each is read as its source, or refused by name.

    gltf_forms.py PROGRAM WORK_FOLDER GLTF_TRANSFORM FILE...     FILE: a .gltf or .glb

Compared are bounds, number of triangles, their area, and where they are; names of materials where the tool keeps them; and clips.
Prints a row for each form and ends with 1 if one is read as something else in silence."""
import base64, json, math, pathlib, struct, subprocess, sys

import numpy

PACK = {  # form: options of gltfpack
    "pack plain": ["-noq"], "pack quantized": [], "pack 16 bits": ["-vp", "16", "-vt", "16"], "pack normalised": ["-vpn"],
    "pack meshopt": ["-c"], "pack meshopt high": ["-cc"], "pack meshopt fallback": ["-cf"], "pack named": ["-kn", "-km", "-ke"],
    "pack merged": ["-mm"],
}
INSTANCES = {  # gltfpack 0.18 writes other places for what is scaled unevenly and turned, so only for what is scaled evenly
    "pack instances": ["-mi", "-noq"], "pack instances quantized": ["-mi"], "pack instances meshopt": ["-mi", "-cc"],
}
TRANSFORM = {  # form: command of gltf-transform and its options
    "copy": ["copy"], "separate": ["copy", "--vertex-layout", "separate"], "dedup": ["dedup"], "prune": ["prune"], "instance": ["instance", "--min", "2"],
    "flatten": ["flatten"], "join": ["join"], "draco": ["draco"], "draco sequential": ["draco", "--method", "sequential"], "meshopt": ["meshopt"],
    "meshopt high": ["meshopt", "--level", "high"], "quantize": ["quantize"], "quantize 16": ["quantize", "--quantize-position", "16"],
    "quantize scene": ["quantize", "--quantization-volume", "scene"], "weld": ["weld"], "unweld": ["unweld"], "tangents": ["tangents"],
    "reorder": ["reorder"], "unlit": ["unlit"], "palette": ["palette", "--min", "1"], "resample": ["resample"], "sparse": ["sparse"],
    "webp": ["webp"], "png": ["png"], "jpeg": ["jpeg"], "avif": ["avif"], "metalrough": ["metalrough"], "partition": ["partition"],
    "optimize draco": ["optimize", "--compress", "draco", "--texture-compress", "webp", "--simplify", "false"],
    "optimize meshopt": ["optimize", "--compress", "meshopt", "--texture-compress", "false", "--simplify", "false"],
}


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=300)


def said(program, path, work):
    """Geometry and clips as the program reads them, or its message."""
    obj = work / "read.obj"
    for old in work.glob("read*"):
        old.unlink()
    export = run(program, "export", str(path), "--obj", str(obj))
    if export.returncode != 0:
        return export.stderr.strip().splitlines()[-1]
    points, triangles = [], []
    for line in obj.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            corner = [int(w.split("/")[0]) - 1 for w in words[1:]]
            triangles += [(corner[0], corner[i], corner[i + 1]) for i in range(1, len(corner) - 1)]
    at = numpy.array(points)[numpy.array(triangles)]
    info = run(program, "info", str(path), "--json")
    clips = sorted((clip["name"], round(clip["seconds"], 2)) for clip in json.loads(info.stdout)["clips"])
    return at, clips, export.stderr + info.stderr


def moments(at):
    normals = numpy.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]) / 2
    area = numpy.linalg.norm(normals, axis=1)
    centre = at.mean(axis=1)
    return area.sum(), (area[:, None] * centre).sum(axis=0) / max(area.sum(), 1e-9), numpy.abs(normals).sum(axis=0), (normals * centre).sum()


def difference(source, read):
    """Nothing, or what differs."""
    a, b = source[0], read[0]
    size = numpy.ptp(a.reshape(-1, 3), axis=0).max()
    off = max(numpy.abs(a.min(axis=(0, 1)) - b.min(axis=(0, 1))).max(), numpy.abs(a.max(axis=(0, 1)) - b.max(axis=(0, 1))).max())
    if off > 2e-3 * size:
        return f"bounds {off:.3g} m off"
    old, new = moments(a), moments(b)
    if abs(old[0] - new[0]) > 5e-3 * old[0]:
        return f"area {new[0]:.5g} instead of {old[0]:.5g}"
    if numpy.abs(old[1] - new[1]).max() > 2e-3 * size:
        return "triangles elsewhere"
    if abs(old[3] - new[3]) > 1e-2 * max(abs(old[3]), size * old[0] * 0.01):
        return "triangles turned over"
    if abs(len(a) - len(b)) > 0.02 * len(a) + 2:
        return f"{len(b)} triangles instead of {len(a)}"
    if len(source[1]) != len(read[1]):
        return f"clips {read[1]} instead of {source[1]}"
    return ""


def evenly_scaled(path):
    """Six instances of a lopsided mesh, each turned and scaled by one factor."""
    points = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0, 0, 1), (3, 2, 1), (1, 0, 4)]
    corners = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 4, 1, 4, 5, 3, 5, 4]
    data = struct.pack("<18f", *(x for point in points for x in point)) + struct.pack("<18H", *corners)
    nodes = []
    for i in range(6):
        half = (0.7 * i + 0.2) / 2
        turn = [part / 1.001 * math.sin(half) for part in (0.3, 0.8, 0.52)]
        nodes.append({"mesh": 0, "translation": [7 * i - 10, 3 * i, 5 - 4 * i], "rotation": [*turn, math.cos(half)], "scale": [1 + 0.3 * i] * 3})
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(6))}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, 0], "max": [3, 2, 4]},
                      {"bufferView": 1, "componentType": 5123, "count": 18, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 36}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))
    return str(path)


def main(program, work, transform, *files):
    work = pathlib.Path(work)
    silent = 0
    for file in (*files, evenly_scaled(work / "even.gltf")):
        source = said(program, file, work)
        if isinstance(source, str):
            sys.exit(f"{file}: {source}")
        packs = {**PACK, **INSTANCES} if file.endswith("even.gltf") else PACK
        for form, options in {**packs, **TRANSFORM}.items():
            for ending in ("glb", "gltf"):
                folder = work / "form"
                run("rm", "-rf", str(folder))
                folder.mkdir()
                out = folder / f"out.{ending}"
                if form in packs:
                    made = run("gltfpack", "-i", file, "-o", str(out), *options)
                else:
                    made = run(transform, options[0], file, str(out), *options[1:])
                if made.returncode != 0 or not out.exists():
                    print(f"{pathlib.Path(file).name:16} {form:24} {ending:5} not made: {(made.stdout + made.stderr).strip().splitlines()[-1:]}")
                    continue
                read = said(program, out, work)
                if isinstance(read, str):
                    result = "refused: " + read.split(": ", 2)[-1][:110]
                else:
                    result = difference(source, read)
                    if result:
                        silent += 1
                    result = f"WRONG: {result}" if result else "same" + (", with warnings" if read[2].strip() else "")
                print(f"{pathlib.Path(file).name:16} {form:24} {ending:5} {result}", flush=True)
    print(f"{silent} read as something else in silence")
    return silent > 0


sys.exit(main(*sys.argv[1:]))
