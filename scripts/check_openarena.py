#!/usr/bin/env python3
"""Reads OpenArena's maps with Slipface and with the small reader below, and compares.

Needs Debian's openarena-data packages (the pk3 files hold the maps) and python3-numpy; says so and ends well without them. One row per
map, as docs/levels.md has it:

  area      of our drawn faces, sky apart, as a fraction of that of the map's triangles, counted through their indices (patches apart)
  late      rays from the spawns that hit a solid or playerclip brush, but nothing of ours before it or within 2 units (6 cm) behind it
  escaped   those of them that hit nothing of ours at all
  open      rays that hit no brush either: the map itself is open there
  stand     spawns from which a player who walks to and fro for a second stands on ground afterwards, of those tried

    scripts/check_openarena.py [--program build/release/editor/slipface] [--rays 400] [--spawns 4] [MAP... | FILE.bsp...]
"""
import argparse, glob, json, os, pathlib, re, struct, subprocess, sys, tempfile, zipfile

UNIT = 1 / 32


def skip(why):
    print(f"skipped: {why}")
    sys.exit(0)


class Map:
    """What the oracle knows of a map: the triangles that are drawn, and the brushes that stop a player."""

    def __init__(self, data, np):
        lump = lambda i: data[(at := struct.unpack_from("<II", data, 8 + 8 * i))[0] : at[0] + at[1]]
        array = lambda i, kind, width: np.frombuffer(lump(i), kind).reshape(-1, width)
        textures = [struct.unpack_from("<II", lump(1), i + 64) for i in range(0, len(lump(1)), 72)]
        self.contents = np.array([contents for _, contents in textures], dtype=np.uint32)
        names = [lump(1)[i : i + 64].split(b"\0")[0].decode("latin1") for i in range(0, len(lump(1)), 72)]
        unseen = [flags & 0x4 != 0 for flags, _ in textures]  # sky
        self.unseen = {name for name, is_unseen in zip(names, unseen) if is_unseen}
        planes = array(2, "<f4", 4).astype(float)
        models = array(7, "<i4", 10)
        brushes, sides = array(8, "<i4", 3), array(9, "<i4", 2)
        vertices = array(10, "<f4", 11)[:, :3].astype(float)
        indices, faces = array(11, "<i4", 1)[:, 0], array(13, "<i4", 26)
        self.entities = [dict(re.findall(r'"([^"]*)"\s*"([^"]*)"', block))
                         for block in re.findall(r"\{(.*?)\}", lump(0).decode("latin1"), re.S)]

        origins = {0: np.zeros(3)}
        for entity in self.entities:
            name = entity.get("model", "")
            if name.startswith("*") and not entity["classname"].startswith("trigger_"):
                origins.setdefault(int(name[1:]), np.array([float(v) for v in entity.get("origin", "0 0 0").split()]))
        self.area = 0.0
        self.faces = len(faces)
        for face in faces:
            if face[2] not in (1, 3) or unseen[face[0]]:
                continue
            corner = vertices[face[3] + indices[face[5] : face[5] + face[6] // 3 * 3]].reshape(-1, 3, 3)
            cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
            self.area += 0.5 * np.sqrt((cross**2).sum(1)).sum()
        normals, distances, first = [], [], []
        for number, origin in origins.items():
            for brush in brushes[models[number][8] : models[number][8] + models[number][9]]:
                if not self.contents[brush[2]] & 0x10001:
                    continue
                first.append(len(normals))
                for side in sides[brush[0] : brush[0] + brush[1]]:
                    normals.append(planes[side[0]][:3])
                    distances.append(planes[side[0]][3] + planes[side[0]][:3] @ origin)
        self.normals, self.distances, self.first = np.array(normals), np.array(distances), np.array(first)
        self.np = np

    def brush_hit(self, origin, direction):
        """Distance at which the ray enters the first brush; infinite for none, None where it begins in one."""
        np = self.np
        height = self.normals @ origin - self.distances
        slope = self.normals @ direction
        with np.errstate(divide="ignore", invalid="ignore"):
            at = -height / slope
        enter = np.where(slope < 0, at, np.where((slope == 0) & (height > 0), np.inf, -np.inf))
        leave = np.where(slope > 0, at, np.inf)
        enter, leave = np.maximum.reduceat(enter, self.first), np.minimum.reduceat(leave, self.first)
        hit = (enter < leave) & (leave > 0)
        if np.any(hit & (enter <= 0)):
            return None
        return enter[hit].min() if hit.any() else np.inf


class Ours:
    """The level as `slipface export` writes it, in the map's coordinates."""

    def __init__(self, program, bsp, folder, unseen, np):
        self.np = np
        run = lambda *words: subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout
        self.info = json.loads(run("info", bsp, "--json"))
        run("export", bsp, "--flat", f"{folder}/level.flat", "--obj", f"{folder}/level.obj")
        self.read_flat(open(f"{folder}/level.flat", "rb"))
        self.drawn_area = self.read_areas(open(f"{folder}/level.obj"), unseen)

    def read_flat(self, file):
        np = self.np
        file.read(8)
        _, types, fields, vertices, triangles = struct.unpack("<5I", file.read(20))
        file.read(32 * fields)
        names = []
        for _ in range(types):
            names.append(file.read(32).split(b"\0")[0].decode())
            file.read(4 * fields)
        points = np.frombuffer(file.read(12 * vertices), "<f4").reshape(-1, 3).astype(float) / UNIT
        points = np.stack([points[:, 0], -points[:, 2], points[:, 1]], 1)
        corners = np.frombuffer(file.read(12 * triangles), "<u4").reshape(-1, 3)
        kind = np.frombuffer(file.read(triangles), "u1")
        solid = np.array([name != "nonsolid" for name in names])[kind]
        a, b, c = (points[corners[solid][:, i]] for i in range(3))
        self.a, self.u, self.v = a, b - a, c - a

    def read_areas(self, file, unseen):
        """Area by Newell's sums of the faces whose texture can be seen and that are no walls, which come last."""
        np = self.np
        points, seen, is_unseen, others = [], [], False, 0
        for line in file:
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                points.append([float(w) for w in words[1:4]])
            elif words[0] == "usemtl":
                is_unseen = line.split(None, 1)[1].strip().rsplit("__", 1)[0] in unseen
            elif words[0] == "f" and is_unseen:
                others += 1
            elif words[0] == "f":
                seen.append([int(w.split("/")[0]) - 1 for w in words[1:]])
        points = np.array(points) / UNIT
        drawn = seen[: len(seen) - (self.info["undrawn_faces"] - others)]
        total = 0.0
        for face in drawn:
            p = points[face]
            total += 0.5 * np.linalg.norm(np.cross(p[1:-1] - p[0], p[2:] - p[0]).sum(0))
        return total

    def hit(self, origin, direction):
        """Distance of the first triangle; infinite for none."""
        np = self.np
        to = origin - self.a
        p, q = np.cross(direction, self.v), np.cross(to, self.u)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1 / (self.u * p).sum(1)
            u, v, at = (to * p).sum(1) * scale, q @ direction * scale, (self.v * q).sum(1) * scale
        ok = np.isfinite(scale) & (at > 0) & (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6)
        return at[ok].min() if ok.any() else np.inf


def patch_area(data, np):
    """Of the quads that a patch is cut into, four along each side of 3 x 3 control points."""
    lump = lambda i: data[(at := struct.unpack_from("<II", data, 8 + 8 * i))[0] : at[0] + at[1]]
    vertices = np.frombuffer(lump(10), "<f4").reshape(-1, 11)[:, :3].astype(float)
    faces = np.frombuffer(lump(13), "<i4").reshape(-1, 26)
    t = np.arange(5) / 4
    weight = np.stack([(1 - t) ** 2, 2 * t * (1 - t), t**2], 1)
    total = 0.0
    for face in faces[faces[:, 2] == 2]:
        if struct.unpack_from("<I", lump(1), 72 * face[0] + 64)[0] & 0x4:  # sky
            continue
        width, height = face[24], face[25]
        control = vertices[face[3] : face[3] + width * height].reshape(height, width, 3)
        for y in range(0, height - 2, 2):
            for x in range(0, width - 2, 2):
                p = np.einsum("ai,bj,ijk->abk", weight, weight, control[y : y + 3, x : x + 3])
                cross = np.cross(p[1:, 1:] - p[:-1, :-1], p[1:, :-1] - p[:-1, 1:])
                total += 0.5 * np.sqrt((cross**2).sum(2)).sum()
    return total


def stands(program, bsp, spawn, folder):
    tape = f"{folder}/stand.tape"
    feet = spawn["feet"]
    with open(tape, "w") as file:
        file.write(f"slipface-tape 1\nlevel {os.path.basename(bsp)}\ndt 1/60\n"
                   f"start {feet[0]},{feet[1] + 0.9 + 0.05},{feet[2]}\n"
                   "30 wish 0,0\n30 wish 1,0\n30 wish -1,0\n90 wish 0,0\n")
    run = subprocess.run([program, "simulate", bsp, "--tape", tape, "--json"], capture_output=True, text=True)
    try:
        return bool(json.loads(run.stdout)["final_state"]["grounded"])
    except (json.JSONDecodeError, KeyError):
        return False


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", default="build/release/editor/slipface")
    arguments.add_argument("--rays", type=int, default=400)
    arguments.add_argument("--spawns", type=int, default=4)
    arguments.add_argument("maps", nargs="*")
    options = arguments.parse_args()
    try:
        import numpy as np
    except ImportError:
        skip("no numpy (apt-get install python3-numpy)")
    packs = sorted(glob.glob("/usr/share/games/openarena/*/pak*.pk3"))
    files = [name for name in options.maps if name.endswith(".bsp")]
    if not packs and not files:
        skip("no OpenArena (apt-get install openarena-081-maps openarena-085-data)")
    found = {}
    for name in files:
        found[pathlib.Path(name).stem] = pathlib.Path(name).read_bytes()
    for pack in packs if not files else []:
        with zipfile.ZipFile(pack) as file:
            for name in file.namelist():
                if name.startswith("maps/") and name.endswith(".bsp"):
                    found[pathlib.Path(name).stem] = file.read(name)
    print("| map | faces | undrawn | area | rays at brushes | late | escaped | open | stand |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    bad = 0
    for name in sorted(found):
        if options.maps and not files and name not in options.maps:
            continue
        with tempfile.TemporaryDirectory() as folder:
            bsp = f"{folder}/{name}.bsp"
            pathlib.Path(bsp).write_bytes(found[name])
            try:
                theirs = Map(found[name], np)
                ours = Ours(options.program, bsp, folder, theirs.unseen, np)
            except subprocess.CalledProcessError as error:
                print(f"| {name} | {error.stderr.strip()} |")
                bad += 1
                continue
            ratio = ours.drawn_area / (theirs.area + patch_area(found[name], np))
            spawns = ours.info["spawns_in_file"]
            random = np.random.default_rng(1)
            rays = late = escaped = outside = 0
            for _ in range(options.rays if spawns else 0):
                feet = spawns[random.integers(len(spawns))]["feet"]
                eye = np.array([feet[0], -feet[2], feet[1]]) / UNIT + [0.1, 0.2, 40.3]
                direction = random.normal(size=3)
                direction /= np.linalg.norm(direction)
                brush = theirs.brush_hit(eye, direction)
                if brush is None:
                    continue
                mine = ours.hit(eye, direction)
                if brush == np.inf:
                    outside += mine == np.inf
                    continue
                rays += 1
                escaped += mine == np.inf
                late += mine > brush + 2
            tried = spawns[: options.spawns]
            standing = sum(stands(options.program, bsp, spawn, folder) for spawn in tried)
            bad += late > 0 or abs(ratio - 1) > 1e-3 or standing < len(tried)
            print(f"| {name} | {ours.info['faces']} | {ours.info['undrawn_faces']} | {ratio:.5f} | {rays} | {late} | {escaped} | "
                  f"{outside} | {standing} of {len(tried)} |", flush=True)
    print(f"\n{bad} maps with a difference")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
