#!/usr/bin/env python3
"""Writes random levels for checks: objects of quads and triangles, several materials, textures, types by name and by rule.

    scripts/random_levels.py FOLDER COUNT [SEED]
"""
import json
import pathlib
import random
import struct
import sys
import zlib


def png(path, color):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    row = b"\0" + bytes(color) * 4
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(row * 4)) + chunk(b"IEND", b""))


def main():
    folder, count = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    draw = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    suffixes = ["", "", "__ice", "__ladder", "__sticky", "__hazard", "__no-such-type"]
    names = ["floor", "wall 2", "Tür", "роща", "a\"b", "x%20y", "äöü.001", "stone"]
    for number in range(count):
        stem = draw.choice(["level", "with space ", "ünï-"]) + str(number)
        materials = [draw.choice(names) + str(i) + draw.choice(suffixes) for i in range(draw.randint(1, 6))]
        (folder / "pictures").mkdir(exist_ok=True)
        with open(folder / f"{stem}.mtl", "w") as mtl:
            for material in materials:
                mtl.write(f"newmtl {material}\nKd {draw.random():.3f} {draw.random():.3f} {draw.random():.3f}\n")
                if draw.random() < 0.5:
                    picture = draw.choice(["a.png", "b c.png", "gone.png"])
                    if picture != "gone.png":
                        png(folder / "pictures" / picture, [draw.randrange(256) for _ in range(3)])
                    mtl.write(f"map_Kd pictures/{picture}\n")
        corners = 0
        with open(folder / f"{stem}.obj", "w") as obj:
            obj.write(f"mtllib {stem}.mtl\n")
            for part in range(draw.randint(1, 8)):
                if draw.random() < 0.9:
                    obj.write(f"o {draw.choice(names)}{part}\n")
                for _ in range(draw.randint(1, 30)):
                    if draw.random() < 0.4:
                        obj.write(f"usemtl {draw.choice(materials)}\n")
                    n, at = draw.choice([3, 4, 4, 5]), [draw.uniform(-50, 50) for _ in range(3)]
                    for i in range(n):
                        obj.write("v %f %f %f\nvt %f %f\n" % (*(x + draw.uniform(-3, 3) for x in at), draw.random(), draw.random()))
                    obj.write("f " + " ".join(f"{corners + i + 1}/{corners + i + 1}" for i in range(n)) + "\n")
                    corners += n
        if draw.random() < 0.5:
            rules = [{"pattern": "stone*", "type": draw.choice(["ice", "bouncy", "conveyor"])}]
            (folder / f"{stem}.slipface.json").write_text(json.dumps({"slipface": 1, "mesh": f"{stem}.obj", "rules": rules}))


if __name__ == "__main__":
    main()
