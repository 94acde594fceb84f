#!/usr/bin/env python3
"""Writes assets/climb/climb.obj, .mtl and .slipface.json: a course of seven stages, each of which needs another ability.

    assets/generate/climb.py assets/climb

One outline in X and Y is drawn across Z between two sides that lean by 35 degrees: walls that can neither be walked up nor jumped off.
Metres, +Y up. Between two goals lies one stage; what it asks for is 0.2 to 2 m beyond what the other abilities reach together.
"""
import json, sys, pathlib

ACROSS = 16
FLOOR = [  # x, y, and the material of the edge to the next corner
    (-4, 0, "smooth"), (10, 0, "smooth"), (10, -4, "smooth"), (20.5, -4, "smooth"), (20.5, -4.15, "lava"), (24.4, -4.15, "smooth"),
    (24.4, -4, "smooth"), (38.9, -4, "smooth"), (36, -1.1, "smooth"), (44, -1.1, "smooth"), (44, 5.4, "smooth"), (54.5, 5.4, "lip"),
    (50, 9.9, "lip"), (56, 9.9, "smooth"), (56, 2, "lava"), (81.9, 2, "smooth"), (78, 5.9, "smooth"), (86, 5.9, "smooth"), (86, 15, None),
]
CEILING = [
    (-4, 0, "smooth"), (-4, 4, "smooth"), (6, 4, "smooth"), (6, 1.2, "smooth"), (8, 1.2, "smooth"), (8, 4, "smooth"), (14, 4, "smooth"),
    (14, -1, "smooth"), (18, -1, "smooth"), (18, -2.8, "smooth"), (27, -2.8, "smooth"), (33, 6, "smooth"), (39, 6, "smooth"),
    (39, 1.4, "smooth"), (41, 1.4, "smooth"), (41, 8, "smooth"), (44, 8, "smooth"), (49, 15, "smooth"), (86, 15, None),
]
GRATE = [(10, 0, "grate"), (14, 0, None)]
GOALS = [("crouch", 9.2, 0), ("drop", 16, -4), ("dash", 28.5, -4), ("air jump", 38, -1.1), ("wall jump", 47, 5.4), ("ledge", 54, 9.9),
         ("glide", 82, 5.9)]
COLORS = {"smooth": (0.45, 0.47, 0.5), "lava": (0.8, 0.25, 0.05), "lip": (0.85, 0.7, 0.4), "grate": (0.35, 0.55, 0.45)}
TYPES = [
    {"name": "default"},
    {"name": "smooth", "color": [0.45, 0.47, 0.5], "grabbable": False},
    {"name": "grate", "color": [0.35, 0.55, 0.45], "hatch": "checker", "one_sided": True, "grabbable": False},
    {"name": "lava", "color": [0.84, 0.37, 0.0], "hatch": "cross", "hazardous": True},
    {"name": "lip", "color": [0.9, 0.75, 0.45], "hatch": "horizontal"},
]
MOVEMENT = {
    "air_jump": True, "air_jump_reset": "ground", "wall_jump": True, "wall_jump_walls": "another", "dash": True, "crouch": True,
    "crouch_in_air": "no", "ledge_grab": True, "ledge_wall": 0.3490658503988659, "drop_through": True, "glide": True, "step_up": True,
    "snap_down": True, "coyote": False, "jump_buffer": True,
}


def main(folder):
    corners, faces = [], []

    def quad(material, points):
        faces.append((material, [len(corners) + i + 1 for i in range(4)]))
        corners.extend(points)

    for line, upwards in ((FLOOR, True), (CEILING, False), (GRATE, True)):
        for (ax, ay, material), (bx, by, _) in zip(line, line[1:]):
            a, b = ((ax, ay), (bx, by)) if upwards else ((bx, by), (ax, ay))
            quad(material, [(*a, -ACROSS), (*a, ACROSS), (*b, ACROSS), (*b, -ACROSS)])
    for side in (-1, 1):
        low, high = 2 + 0.7 * (-5 + 4.15), 2 + 0.7 * (16 + 4.15)
        points = [(-5, -5, side * low), (87, -5, side * low), (87, 16, side * high), (-5, 16, side * high)]
        quad("smooth", points if side < 0 else points[::-1])
    text = ["# Slipface level: climb. Metres, +Y up. Made by assets/generate/climb.py.", "mtllib climb.mtl"]
    text += ["v %g %g %g" % corner for corner in corners]
    used = None
    for material, numbers in faces:
        if material != used:
            text.append("usemtl " + material)
            used = material
        text.append("f " + " ".join(map(str, numbers)))
    folder = pathlib.Path(folder)
    (folder / "climb.obj").write_text("\n".join(text) + "\n")
    (folder / "climb.mtl").write_text("".join("newmtl %s\nKd %g %g %g\n" % (name, *color) for name, color in COLORS.items()))
    level = {
        "slipface": 1, "mesh": "climb.obj", "spawn": {"position": [0, 0.902, 0], "yaw": -1.5707963267948966}, "surfaces": TYPES,
        "rules": [{"pattern": name, "type": name} for name in COLORS], "movement": MOVEMENT,
        "goals": [{"name": name, "position": [x, y + 0.902, 0], "radius": 1, **({"from": GOALS[i - 1][0]} if i else {})}
                  for i, (name, x, y) in enumerate(GOALS)],
    }
    (folder / "climb.slipface.json").write_text(json.dumps(level, indent=2) + "\n")


main(sys.argv[1])
