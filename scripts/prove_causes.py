#!/usr/bin/env python3
"""Changes a project by program and asks the snapshot check what changed: is each change red, and is its act named first?

The project is a folder with levels/, screenshots/scenes.json and screenshots/editor/; without one, a small project with props, a
platform, terrain, baked light, tapes, a probe, masks and screens is made from the shipped levels. It is approved, and then one
change at a time is made to a copy; its place and size are drawn from the seed. A change of data counts as red if any entry differs,
and as right if every entry that differs names the change first. An edit that means nothing must leave everything green.
Prints a row per seed; docs/snapshots.md, "Inputs first", sums it up.

    scripts/prove_causes.py [--seed 1] [--each 1] [--program build/release/editor/slipface] [--only REGEX] [--keep FOLDER]
"""
import argparse, json, math, pathlib, random, re, shutil, struct, subprocess, sys, tempfile, zlib

TOP = pathlib.Path(__file__).resolve().parent.parent


def png(width, height, pixel, depth=8, channels=3, level=9):
    """A PNG whose pixels pixel(x, y) gives; `level` is deflate's."""
    kind = {1: 0, 3: 2}[channels]
    rows = b"".join(b"\0" + b"".join(struct.pack(">H", v) if depth == 16 else bytes([v]) for x in range(width) for v in pixel(x, y))
                    for y in range(height))
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, level)) + chunk(b"IEND", b""))


def box(lines, name, material, low, high, count):
    """Appends a box as six quads with texture coordinates; `count` is the number of vertices before it."""
    x0, y0, z0 = low
    x1, y1, z1 = high
    lines.append(f"o {name}")
    for z in (z0, z1):
        for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)):
            lines.append(f"v {x:g} {y:g} {z:g}")
    first = count - 1
    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)) * 2:
        lines.append(f"vt {u * (x1 - x0) / 4:g} {v * (y1 - y0) / 4:g}")
    lines.append(f"usemtl {material}")
    for face in ((4, 3, 2, 1), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)):
        lines.append("f " + " ".join(f"{first + k}/{first + k}" for k in face))
    return count + 8


class Project:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def path(self, name):
        return self.folder / name

    def lines(self, name):
        return self.path(name).read_text().splitlines()

    def put(self, name, lines):
        self.path(name).parent.mkdir(parents=True, exist_ok=True)
        self.path(name).write_text("\n".join(lines) + "\n")

    def json(self, name):
        return json.loads(self.path(name).read_text())

    def dump(self, name, value):
        self.path(name).write_text(json.dumps(value, indent=1))

    def run(self, *words, codes=(0,)):
        done = subprocess.run([self.program, *words], capture_output=True, text=True, cwd=self.folder)
        if done.returncode not in codes:
            raise SystemExit(f"slipface {' '.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}")

    def make(self):
        """A hall with a ramp, ice, a lift, crates, terrain, light; its tapes, scenes and screens."""
        for name in ("levels/props", "levels/tex", "screenshots/editor"):
            self.path(name).mkdir(parents=True)
        rng = random.Random(7)
        noise = [[rng.randrange(60, 200) for _ in range(16)] for _ in range(16)]
        self.path("levels/tex/stone.png").write_bytes(png(16, 16, lambda x, y: (noise[y][x], noise[y][x] // 2 + 40, 90)))
        self.path("levels/tex/hills.png").write_bytes(
            png(9, 9, lambda x, y: (int(20000 + 18000 * math.sin(x * 0.9) * math.cos(y * 0.7)),), depth=16, channels=1))
        hall, count = [], 1
        hall.append("mtllib hall.mtl")
        for name, material, low, high in (("floor", "stone", (-10, -1, -10), (10, 0, 10)), ("pool", "ice_pool", (2, -0.9, 2), (8, 0.02, 8)),
                                          ("wall", "stone", (-10, 0, -10), (10, 3, -9)), ("step", "wood", (-4, 0, -6), (-1, 0.3, -3)),
                                          ("lift", "metal", (4, 0, -5), (6, 0.3, -3))):
            count = box(hall, name, material, low, high, count)
        self.put("levels/hall.obj", hall)
        self.put("levels/hall.mtl", ["newmtl stone", "Kd 1 1 1", "map_Kd tex/stone.png", "newmtl ice_pool", "Kd 0.7 0.85 0.95",
                                     "newmtl wood", "Kd 0.6 0.4 0.2", "newmtl metal", "Kd 0.5 0.5 0.55"])
        crate = ["mtllib crate.mtl"]
        box(crate, "crate", "planks", (-0.5, 0, -0.5), (0.5, 1, 0.5), 1)
        self.put("levels/props/crate.obj", crate)
        self.put("levels/props/crate.mtl", ["newmtl planks", "Kd 0.8 0.6 0.3"])
        base = json.loads((TOP / "assets/levels/easy.slipface.json").read_text())
        level = {"slipface": 2, "mesh": "hall.obj", "spawn": {"position": [0, 0.95, 6], "yaw": 0},
                 "spawns": [{"name": "back", "position": [-8, 0.95, 8], "yaw": 1}], "surfaces": base["surfaces"],
                 "rules": [{"pattern": "ice*", "type": "ice"}, {"pattern": "wood", "type": "sticky"}], "movement": base["movement"],
                 "fall_limit": -20.0,
                 "cameras": [{"name": "gate", "eye": [9, 6, 11], "target": [0, 0.5, -1], "fov_y": 1.1},
                             {"name": "tower", "eye": [9, 5, -1], "target": [2, 0.5, -5], "fov_y": 1}],
                 "goals": [{"name": "landing", "kind": "reach", "position": [5, 1.2, -4], "radius": 1, "within_s": 20}],
                 "platforms": [{"name": "lift", "group": "lift", "repeat": "ping-pong", "phase": 0,
                                "path": [{"offset": [0, 0, 0], "speed": 1.5, "pause": 0.5}, {"offset": [0, 1.6, 0], "speed": 1.5, "pause": 0.5}]}],
                 "props": [{"name": "crate", "mesh": "props/crate.obj", "position": [7, 0, 6], "rotation": [0, 0.4, 0], "scale": [1, 1.2, 1]},
                           {"name": "crate2", "mesh": "props/crate.obj", "position": [-5, 0, 7], "type": "ice"},
                           {"name": "barrel", "mesh": "props/crate.obj", "position": [-7, 0, 2]}]}
        self.dump("levels/hall.slipface.json", level)
        meadow = []
        box(meadow, "slab", "stone", (-6, 0, -6), (6, 0.5, 6), 1)
        self.put("levels/meadow.obj", meadow)
        self.dump("levels/meadow.slipface.json", {
            "slipface": 2, "mesh": "meadow.obj", "spawn": {"position": [0, 1.5, 4], "yaw": 0}, "surfaces": base["surfaces"],
            "movement": base["movement"],
            "heightfield": {"file": "tex/hills.png", "origin": [-20, -1, -20], "size": [40, 40], "low": 0, "high": 3}})
        # Not in the hall: baked light fits one order of faces, and would make every other order visible.
        self.run("bake-light", "levels/meadow.slipface.json", "--texel", "1")
        self.put("levels/run.tape", ["slipface-tape 1", "dt 1/60", "10 wish 0,0", "50 wish 0.3,-0.7", "1 wish 0.3,-0.7 jump",
                                     "30 wish 0.8,-0.2", "40 wish -0.4,0.6"])
        self.put("levels/ride.tape", ["slipface-tape 1", "dt 1/60", "start 5,1.25,-4", "200 wish 0,0"])
        scenes = [{"name": "gate", "level": "../levels/hall.slipface.json", "camera": "gate", "masks": [[0, 0, 40, 12]]},
                  {"name": "corners", "level": "../levels/hall.slipface.json", "cameras": ["auto:iso4", "auto:map"]},
                  {"name": "run", "level": "../levels/hall.slipface.json", "tape": "../levels/run.tape", "cameras": ["tape:3"], "style": "plain overlay"},
                  {"name": "ride", "level": "../levels/hall.slipface.json", "tape": "../levels/ride.tape", "camera": "tower"},
                  {"name": "probe", "level": "../levels/hall.slipface.json", "camera": "gate", "style": "plain",
                   "probe": {"from": "spawn", "move": [3, -0.8, -4]}},
                  {"name": "meadow", "level": "../levels/meadow.slipface.json", "cameras": ["auto:iso", "auto:top"]}]
        self.dump("screenshots/scenes.json", {"version": 1, "defaults": {"size": [240, 135]}, "scenes": scenes})
        head = ["# level: levels/hall.slipface.json", "# size: 640x420"]
        self.put("screenshots/editor/view.script", head + ["only view", "park_mouse"])
        self.put("screenshots/editor/movement.script", head + ["only movement", "park_mouse"])
        self.put("screenshots/editor/play.script", head + ["only view", "command playtest.start", "wait 20", "hold W 30", "park_mouse"])
        self.put("screenshots/editor/whole.script", head + ["park_mouse"])
        self.run("snapshot", "approve", "--quick", "--in-ci")

    def check(self):
        """[(entry, its causes)] of those that differ."""
        self.run("snapshot", "check", "--jobs", "2", "--quiet", codes=(0, 1))
        entries = json.loads(self.path("out/snapshots/report.json").read_text())["entries"]
        return [(e["name"], [f["text"] for f in e.get("findings", [])] or [e.get("message", "")]) for e in entries
                if e["state"] != "same"], entries


HALL, MEADOW, OBJ, MTL = "levels/hall.slipface.json", "levels/meadow.slipface.json", "levels/hall.obj", "levels/hall.mtl"
SUITE = "screenshots/scenes.json"


def edit(name, change):
    """A change of one JSON file: change(data, rng) edits in place and returns the pattern that its act must fit."""
    def done(p, rng):
        data = p.json(name)
        wanted = change(data, rng)
        p.dump(name, data)
        return wanted
    return done


def text(name, change):
    def done(p, rng):
        lines = p.lines(name)
        wanted = change(lines, rng)
        p.put(name, lines)
        return wanted
    return done


def numbered(lines, word, first=0):
    return [i for i, line in enumerate(lines) if i >= first and line.split(" ")[0] == word]


def part_of(lines, name):
    start = lines.index(f"o {name}")
    ends = [i for i in numbered(lines, "o") if i > start]
    return start, ends[0] if ends else len(lines)


# Each returns a regular expression that the first cause of every entry that differs must fit.
def prop_moved(d, r):
    prop = r.choice(d["props"]); axis = r.randrange(3); prop["position"][axis] += r.choice([0.02, 0.3, 1.0])
    return rf"`{prop['name']}`.*(moved|position)"
def prop_turned(d, r):
    prop = r.choice(d["props"]); prop["rotation"] = [0, r.uniform(0.5, 1.5), 0]
    return rf"`{prop['name']}`.*(turn|rotat)"
def prop_scaled(d, r):
    prop = r.choice(d["props"]); prop["scale"] = [1, 1, r.uniform(1.3, 2)]
    return rf"`{prop['name']}`.*(scale|size)"
def prop_typed(d, r):
    prop = r.choice(d["props"]); prop["type"] = r.choice(["bouncy", "ladder"])
    return rf"`{prop['name']}`.*type"
def prop_removed(d, r):
    prop = d["props"].pop(r.randrange(3)); return rf"`{prop['name']}`.*(removed|gone)"
def prop_added(d, r):
    d["props"].append({"name": "new_one", "mesh": "props/crate.obj", "position": [r.uniform(-3, 3), 0, 2]}); return r"`new_one`.*(added|new)"
def prop_renamed(d, r):
    prop = r.choice(d["props"]); old = prop["name"]; prop["name"] = old + "_b"; return rf"`{old}`"
def platform_speed(d, r):
    for stop in d["platforms"][0]["path"]: stop["speed"] = 1.2
    return r"`lift`.*(slower|speed).*1\.5.*1\.2"
def platform_path(d, r):
    d["platforms"][0]["path"][1]["offset"][1] += r.uniform(0.2, 0.6); return r"`lift`"
def platform_phase(d, r):
    d["platforms"][0]["phase"] = 0.4; return r"`lift`.*phase"
def platform_group(d, r):
    d["platforms"][0]["group"] = "step"; return r"`lift`.*(group|moves)"
def spawn(d, r):
    d["spawn"]["position"][r.choice([0, 2])] += r.choice([0.001, 0.3]); return r"spawn.*moved"
def spawn_turned(d, r):
    d["spawn"]["yaw"] = 0.7; return r"spawn.*(turn|yaw)"
def other_spawn(d, r):
    d["spawns"][0]["position"][0] += 1; return r"spawn `back`.*moved"
def goal(d, r):
    d["goals"][0]["position"][0] += 0.5; return r"goal `landing`.*moved"
def goal_time(d, r):
    d["goals"][0]["within_s"] = 12; return r"goal `landing`"
def fall(d, r):
    d["fall_limit"] = -30.0; return r"fall"
def camera(d, r):
    d["cameras"][0]["eye"][0] += r.choice([0.01, 0.5]); return r"(camera|bookmark) `gate`.*(moved|eye)"
def setting(d, r):
    name = r.choice(["gravity", "walk_speed", "jump_speed", "ground_acceleration", "radius_y"])
    d["movement"][name] = round(d["movement"][name] * 1.07 + 0.01, 4); return name
def switch(d, r):
    name = r.choice(["coyote", "jump_buffer", "variable_jump", "snap_down", "step_up"])
    d["movement"][name] = not d["movement"][name]; return name
def rule(d, r):
    d["rules"][0]["type"] = "bouncy"; return r"(rule `ice\*`|ice to bouncy)"
def rule_removed(d, r):
    del d["rules"][0]; return r"(rule `ice\*`|ice to default)"
def parameter(d, r):
    kind = next(s for s in d["surfaces"] if s["name"] == r.choice(["ice", "sticky", "bouncy"])); name = r.choice(["friction", "restitution", "climbable"])
    kind[name] = not kind[name] if isinstance(kind[name], bool) else kind[name] + 0.13; return rf"`{kind['name']}`.*{name}"
def colour_of_type(d, r):
    kind = next(s for s in d["surfaces"] if s["name"] == "ice"); kind["color"][0] = 0.9; return r"`ice`.*colou?r"
def sun(d, r):
    d["light"]["sun_color"][0] *= 1.1; return r"sun_color|sun's colou?r"
def sky(d, r):
    key = next((k for k in d["light"] if "sky" in k), None)
    if key is None: return None
    v = d["light"][key]; d["light"][key] = [x * 0.5 for x in v] if isinstance(v, list) else v * 0.5; return r"sky"
def terrain_frame(d, r):
    d["heightfield"]["high"] = 3.2; return r"terrain|heightfield"
def one_height(p, r):
    x0, y0 = r.randrange(9), r.randrange(9)
    p.path("levels/tex/hills.png").write_bytes(png(9, 9, lambda x, y: (int(20000 + 18000 * math.sin(x * 0.9) * math.cos(y * 0.7))
                                                   + (9000 if (x, y) == (x0, y0) else 0),), depth=16, channels=1))
    return r"height"
def vertex(metres):
    def change(l, r):
        name = r.choice(["floor", "pool", "wall", "step", "lift"]); a, b = part_of(l, name)
        i = r.choice([i for i in numbered(l, "v") if a < i < b]); w = l[i].split(); k = r.randrange(1, 4)
        w[k] = f"{float(w[k]) + metres:.9g}"; l[i] = " ".join(w); return rf"`{name}`.*(moved|vertex)|vertex.*`{name}`"
    return change
def flip(l, r):
    name = r.choice(["floor", "wall", "step"]); a, b = part_of(l, name); i = r.choice([i for i in numbered(l, "f") if a < i < b])
    w = l[i].split(); l[i] = " ".join(w[:1] + w[:0:-1]); return rf"`{name}`.*flip|flip.*`{name}`"
def remove(l, r):
    name = r.choice(["floor", "wall", "step"]); a, b = part_of(l, name); del l[r.choice([i for i in numbered(l, "f") if a < i < b])]
    return rf"`{name}`.*(removed|gone)|removed.*`{name}`"
def remove_object(l, r):
    a, b = part_of(l, "step"); l[:] = [x for i, x in enumerate(l) if not (a <= i < b and x[0] in "of")]; return r"`step`.*(removed|gone)"
def rename_object(l, r):
    name = r.choice(["lift", "step"]); l[l.index(f"o {name}")] = f"o {name}_b"; return rf"`{name}`.*renamed"
def move_uv(l, r):
    i = r.choice(numbered(l, "vt")); w = l[i].split(); l[i] = f"vt {float(w[1]) + 0.25:g} {w[2]}"; return r"texture coordinate"
def other_material(l, r):
    a, b = part_of(l, "step"); i = [i for i in numbered(l, "usemtl") if a < i < b][0]; l[i] = "usemtl metal"; return r"`step`.*material|material.*`wood`"
def scale_level(l, r):
    for i in numbered(l, "v"): l[i] = "v " + " ".join(f"{float(x) * 1.001:.9g}" for x in l[i].split()[1:])
    return r"scaled"
def move_object(l, r):
    a, b = part_of(l, "step")
    for i in numbered(l, "v"):
        if a < i < b: w = l[i].split(); l[i] = f"v {float(w[1]) + 0.5:g} {w[2]} {w[3]}"
    return r"`step`.*moved"
def colour(l, r):
    i = next(i for i, x in enumerate(l) if x.startswith("Kd 0.6")); l[i] = "Kd 0.5 0.45 0.2"; return r"`wood`.*colou?r"
def texture(p, r):
    rng = random.Random(8); noise = [[rng.randrange(60, 200) for _ in range(16)] for _ in range(16)]
    p.path("levels/tex/stone.png").write_bytes(png(16, 16, lambda x, y: (noise[y][x], noise[y][x] // 2 + 40, 90))); return r"texture.*stone\.png|stone\.png"
def light_image(p, r):
    files = list(p.path("levels").glob("*light*.png"))
    if not files: return None
    files[0].write_bytes(png(16, 16, lambda x, y: (200, 100, 50))); return r"light"
def prop_mesh(l, r):
    i = r.choice(numbered(l, "v")); w = l[i].split(); l[i] = f"v {float(w[1]) + 0.2:g} {w[2]} {w[3]}"; return r"crate\.obj|`crate`.*(moved|vertex)|prop"
def tape_longer(l, r):
    l[-1] = "41" + l[-1][2:]; return r"tape"
def tape_turned(l, r):
    l[3] = "50 wish 0.31,-0.69"; return r"tape"
def tape_jump(l, r):
    l[4] = l[4].replace(" jump", ""); return r"tape.*jump|jump.*tape|tape"
def tape_setting(l, r):
    l.insert(2, "set walk_speed=5"); return r"tape.*walk_speed|walk_speed"
def mask(d, r):
    d["scenes"][0]["masks"][0][2] = 90; return r"mask"
def mask_gone(d, r):
    del d["scenes"][0]["masks"]; return r"mask"
def style(d, r):
    d["scenes"][0]["style"] = "plain overlay wireframe"; return r"style|wireframe"
def probe(d, r):
    next(s for s in d["scenes"] if "probe" in s)["probe"]["move"][0] += 0.01; return r"probe"
def suite_setting(d, r):
    d["scenes"][2]["settings"] = ["gravity=15"]; return r"gravity"
def size(d, r):
    d["scenes"][0]["size"] = [250, 135]; return r"size|width|pixels"
def tolerance(d, r):
    d["scenes"][0]["profile"] = "ui"; return r"profile"
def script_line(l, r):
    l.insert(-1, "command view.overlay"); return r"script"
def script_wait(l, r):
    i = next(i for i, x in enumerate(l) if x.startswith("hold")); l[i] = "hold W 40"; return r"script"
def script_mask(l, r):
    l.insert(2, "# mask: 0,0,30,30"); return r"mask"

DATA = {
    "prop moved": edit(HALL, prop_moved), "prop turned": edit(HALL, prop_turned), "prop scaled": edit(HALL, prop_scaled),
    "prop's type": edit(HALL, prop_typed), "prop removed": edit(HALL, prop_removed), "prop added": edit(HALL, prop_added),
    "prop renamed": edit(HALL, prop_renamed), "platform's speed": edit(HALL, platform_speed), "platform's path": edit(HALL, platform_path),
    "platform's phase": edit(HALL, platform_phase), "platform's group": edit(HALL, platform_group), "spawn moved": edit(HALL, spawn),
    "spawn turned": edit(HALL, spawn_turned), "other spawn": edit(HALL, other_spawn), "goal moved": edit(HALL, goal), "goal's time": edit(HALL, goal_time),
    "fall limit": edit(HALL, fall), "bookmark": edit(HALL, camera), "setting": edit(HALL, setting), "switch": edit(HALL, switch),
    "rule": edit(HALL, rule), "rule removed": edit(HALL, rule_removed), "type's parameter": edit(HALL, parameter), "type's colour": edit(HALL, colour_of_type),
    "sun": edit(MEADOW, sun), "sky": edit(MEADOW, sky), "terrain's heights": edit(MEADOW, terrain_frame), "one height": one_height,
    "vertex 1 mm": text(OBJ, vertex(0.001)), "vertex 10 cm": text(OBJ, vertex(0.1)), "vertex 1 m": text(OBJ, vertex(1.0)), "face flipped": text(OBJ, flip),
    "face removed": text(OBJ, remove), "object removed": text(OBJ, remove_object), "object renamed": text(OBJ, rename_object), "object moved": text(OBJ, move_object),
    "texture coordinate": text(OBJ, move_uv), "other material": text(OBJ, other_material), "level scaled": text(OBJ, scale_level), "colour": text(MTL, colour),
    "texture": texture, "light image": light_image, "prop's mesh": text("levels/props/crate.obj", prop_mesh), "tape longer": text("levels/run.tape", tape_longer),
    "stick turned": text("levels/run.tape", tape_turned), "jump": text("levels/run.tape", tape_jump), "tape's setting": text("levels/run.tape", tape_setting),
    "mask grew": edit(SUITE, mask), "mask gone": edit(SUITE, mask_gone), "style": edit(SUITE, style), "probe": edit(SUITE, probe),
    "suite's setting": edit(SUITE, suite_setting), "size": edit(SUITE, size), "profile": edit(SUITE, tolerance),
    "script's command": text("screenshots/editor/view.script", script_line), "script's key": text("screenshots/editor/play.script", script_wait),
    "script's mask": text("screenshots/editor/view.script", script_mask),
}


# Edits that mean nothing: nothing may be red.
def nothing(p, r): pass
def objects_shuffled(l, r):
    # Faces name vertices by number, so only the faces of an object move.
    a, parts = numbered(l, "o"), []
    keep = [x for x in l if x.split(" ")[0] in ("v", "vt", "mtllib")]
    for i, start in enumerate(a):
        end = a[i + 1] if i + 1 < len(a) else len(l)
        parts.append([x for x in l[start:end] if x.split(" ")[0] in ("o", "usemtl", "f")])
    r.shuffle(parts); l[:] = keep + [x for part in parts for x in part]
def corners_rotated(l, r):
    for i in numbered(l, "f"):
        w = l[i].split(); k = r.randrange(len(w) - 1); l[i] = " ".join(w[:1] + w[1 + k:] + w[1:1 + k])
def faces_shuffled(l, r):
    for a in numbered(l, "usemtl"):
        faces = [i for i in numbered(l, "f") if i > a and all(l[k].startswith("f ") for k in range(a + 1, i))]
        rows = [l[i] for i in faces]; r.shuffle(rows)
        for i, row in zip(faces, rows): l[i] = row
def vertices_renumbered(l, r):
    v = numbered(l, "v"); order = list(range(len(v))); r.shuffle(order); rows = [l[i] for i in v]; new = {old: k for k, old in enumerate(order)}
    for k, i in enumerate(v): l[i] = rows[order[k]]
    for i in numbered(l, "f"):
        l[i] = "f " + " ".join("/".join([str(new[int(c.split("/")[0]) - 1] + 1)] + c.split("/")[1:]) for c in l[i].split()[1:])
def spelled(l, r):
    for i in numbered(l, "v") + numbered(l, "vt"): l[i] = l[i].split()[0] + " " + " ".join(f"{float(x):.6f}" for x in l[i].split()[1:])
def comments(l, r): l.insert(1, "# exported again"); l.insert(5, "")
def shuffled(key):
    return lambda d, r: r.shuffle(d[key])
def keys(d, r):
    items = list(d.items()); r.shuffle(items); d.clear(); d.update(items)
def floats(d, r):
    for prop in d["props"]: prop["position"] = [float(x) for x in prop["position"]]
def defaults_written(d, r):
    for prop in d["props"]: prop.setdefault("rotation", [0, 0, 0]); prop.setdefault("scale", [1, 1, 1])
def texture_packed(p, r):
    rng = random.Random(7); noise = [[rng.randrange(60, 200) for _ in range(16)] for _ in range(16)]
    p.path("levels/tex/stone.png").write_bytes(png(16, 16, lambda x, y: (noise[y][x], noise[y][x] // 2 + 40, 90), level=r.randrange(1, 5)))
def terrain_packed(p, r):
    p.path("levels/tex/hills.png").write_bytes(png(9, 9, lambda x, y: (int(20000 + 18000 * math.sin(x * 0.9) * math.cos(y * 0.7)),), depth=16, channels=1, level=1))
def tape_split(l, r): l[3:4] = ["20 wish 0.3,-0.7", "30 wish 0.3,-0.7"]
def tape_comment(l, r): l.insert(2, "# by hand")
def materials_shuffled(l, r):
    parts = "\n".join(l).split("newmtl "); r.shuffle(tail := parts[1:]); l[:] = "\n".join(["newmtl " + x.strip() for x in tail]).splitlines()
def unused_material(l, r): l.extend(["newmtl nobody", "Kd 1 0 0"])
def scenes_shuffled(d, r): r.shuffle(d["scenes"])
def script_comment(l, r): l.insert(3, "# what is seen here")
def saved_again(p, r): p.dump(HALL, p.json(HALL)); (p.path(HALL)).write_text(json.dumps(p.json(HALL)))
def unused_file(p, r): p.path("levels/notes.mtl").write_text("newmtl x\n")

NOISE = {
    "nothing": nothing, "objects in another order": text(OBJ, objects_shuffled), "faces' corners": text(OBJ, corners_rotated), "faces in another order": text(OBJ, faces_shuffled),
    "vertices renumbered": text(OBJ, vertices_renumbered), "numbers spelled otherwise": text(OBJ, spelled), "comments in the OBJ": text(OBJ, comments),
    "props in another order": edit(HALL, shuffled("props")),
    "keys in another order": edit(HALL, keys), "numbers as floats": edit(HALL, floats), "defaults written": edit(HALL, defaults_written), "texture packed again": texture_packed,
    "terrain packed again": terrain_packed, "tape line split": text("levels/run.tape", tape_split), "tape comment": text("levels/run.tape", tape_comment),
    "materials in another order": text(MTL, materials_shuffled), "unused material": text(MTL, unused_material), "scenes in another order": edit(SUITE, scenes_shuffled),
    "script comment": text("screenshots/editor/view.script", script_comment), "level file written again": saved_again, "unused file": unused_file,
    "prop's faces in another order": text("levels/props/crate.obj", faces_shuffled),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--each", type=int, default=1, help="changes of each kind")
    parser.add_argument("--program", default=str(TOP / "build/release/editor/slipface"))
    parser.add_argument("--only", default="", help="kinds that match")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the project and reports")
    options = parser.parse_args()
    folder = options.keep or pathlib.Path(tempfile.mkdtemp())
    shutil.rmtree(folder / "saved", ignore_errors=True)
    (folder / "saved").mkdir(parents=True)
    saved = Project(options.program, folder / "saved")
    saved.make()
    counts = {"made": 0, "red": 0, "right": 0, "by code": 0, "entries": 0, "entries right": 0, "screens": 0, "screens right": 0}
    alarms, edits = [], 0
    for number in range(options.each):
        for kind, change in {**DATA, **NOISE}.items():
            if not re.search(options.only, kind):
                continue
            rng = random.Random(f"{options.seed} {number} {kind}")
            shutil.rmtree(folder / "now", ignore_errors=True)
            shutil.copytree(folder / "saved", folder / "now")
            now = Project(options.program, folder / "now")
            wanted = change(now, rng)
            if kind in DATA and wanted is None:
                continue
            differing, entries = now.check()
            if kind in NOISE:
                edits += 1
                if differing:
                    alarms.append(kind)
                    print(f"{kind}: FALSE ALARM {len(differing)}: {differing[0][0]}: {differing[0][1][:2]}", flush=True)
                continue
            wrong = [(name, causes) for name, causes in differing if not re.search(wanted, causes[0])]
            counts["made"] += 1
            counts["red"] += bool(differing)
            counts["right"] += bool(differing) and not wrong
            counts["by code"] += any(re.search(r"code has changed|so the program did", causes[0]) for _, causes in wrong)
            counts["entries"] += len(differing)
            counts["entries right"] += len(differing) - len(wrong)
            screens = [name for name, _ in differing if name.startswith("editor/")]
            counts["screens"] += len(screens)
            counts["screens right"] += len(screens) - sum(name.startswith("editor/") for name, _ in wrong)
            if not differing or wrong:
                print(f"{kind} ({wanted}): " + ("GREEN" if not differing else f"{len(wrong)} of {len(differing)} wrong; {wrong[0][0]}: {wrong[0][1][:2]}"), flush=True)
    print("\n| seed | changes | red | true act first | blamed on the program | entries right | screens right | edits that mean nothing | false alarms |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    print(f"| {options.seed} | {counts['made']} | {counts['red']} | {counts['right']} | {counts['by code']} | {counts['entries right']} of {counts['entries']} | "
          f"{counts['screens right']} of {counts['screens']} | {edits} | {len(alarms)} |")
    if not options.keep:
        shutil.rmtree(folder)
    return 0 if counts["red"] >= 0.98 * counts["made"] and counts["right"] >= 0.95 * counts["made"] and not alarms else 1


if __name__ == "__main__":
    sys.exit(main())
