#!/usr/bin/env python3
"""Changes levels by program and asks the snapshot check what changed: is each change red, and is its true cause named first?

Takes levels that this project did not make (any format that opens), gives each a spawn on a floor drawn by the seed, a rule that
makes a material ice, a tape of random inputs and a probe, approves goldens, and then makes one change at a time: drawn are its
place and size. A change counts as red if any image differs, and as right if every image that differs names the change first.
Prints the table of docs/snapshots.md.

    scripts/prove_causes.py LEVEL...  [--seed 1] [--each 1] [--program build/release/editor/slipface] [--keep FOLDER]
"""
import argparse, json, pathlib, random, re, shutil, subprocess, sys, tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent


class Obj:
    """An OBJ as lines, with its vertices, texture coordinates and faces."""

    def __init__(self, path):
        self.lines = path.read_text().splitlines()
        self.of = {kind: [i for i, line in enumerate(self.lines) if line.startswith(kind + " ")] for kind in ("v", "vt", "f")}

    def numbers(self, kind, k):
        return [float(x) for x in self.lines[self.of[kind][k]].split()[1:4]]

    def set(self, kind, k, values):
        self.lines[self.of[kind][k]] = kind + " " + " ".join(f"{x:.9g}" for x in values)

    def corners(self, face):
        return [[int(x) if x else 0 for x in corner.split("/")] for corner in self.lines[self.of["f"][face]].split()[1:]]

    def points(self, face):
        return [self.numbers("v", corner[0] - 1) for corner in self.corners(face)]

    def normal_and_area(self, face):
        p, n = self.points(face), [0.0, 0.0, 0.0]
        for i in range(2, len(p)):
            a = [p[i - 1][k] - p[0][k] for k in range(3)]
            b = [p[i][k] - p[0][k] for k in range(3)]
            for k in range(3):
                n[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]
        length = sum(x * x for x in n) ** 0.5
        return [x / length for x in n] if length else n, 0.5 * length

    def material(self, face):
        for i in range(self.of["f"][face], -1, -1):
            if self.lines[i].startswith("usemtl "):
                return self.lines[i][7:].strip()

    def write(self, path):
        path.write_text("\n".join(self.lines) + "\n")


class Case:
    """A level of somebody else in a folder, with goldens."""

    def __init__(self, program, source, folder, rng, light):
        self.program, self.folder, self.rng = program, folder, rng
        folder.mkdir(parents=True)
        self.run("export", str(source), "--obj", str(folder / "level.obj"))
        obj = self.obj = Obj(folder / "level.obj")
        floors = [(obj.normal_and_area(f), f) for f in range(len(obj.of["f"]))]
        floors = sorted((area, f) for (normal, area), f in floors if normal[1] > 0.9)
        if not floors:
            raise SystemExit(f"{source}: no floor to stand on")
        self.floor = rng.choice(floors[-max(1, len(floors) // 4):])[1]
        points = obj.points(self.floor)
        centre = [sum(p[k] for p in points) / len(points) for k in range(3)]
        base = json.loads((TOP / "assets/levels/easy.slipface.json").read_text())
        self.level = {"slipface": 1, "mesh": "level.obj", "spawn": {"position": [centre[0], centre[1] + 0.95, centre[2]], "yaw": 0},
                      "surfaces": base["surfaces"], "rules": [{"pattern": obj.material(self.floor), "type": "ice"}],
                      "movement": base["movement"],
                      "platforms": [], "cameras": []}
        self.tape = ["slipface-tape 1", "dt 1/60", "10 wish 0,0"]
        for _ in range(8):
            self.tape.append(f"{rng.randint(10, 40)} wish {rng.uniform(-0.7, 0.7):.3f},{rng.uniform(-0.7, 0.7):.3f}" + rng.choice(["", " jump"]))
        eye = [centre[0] + 4, centre[1] + 3.5, centre[2] + 5]
        self.suite = {"version": 1, "defaults": {"size": [480, 270]}, "scenes": [
            {"name": "run", "level": "level.slipface.json", "tape": "run.tape", "style": "plain overlay", "camera": {"eye": eye, "target": centre}},
            {"name": "probe", "level": "level.slipface.json", "style": "textured", "camera": {"eye": eye, "target": centre},
             "probe": {"from": "spawn", "move": [rng.uniform(2, 4), -0.8, rng.uniform(-3, 3)]}},
            {"name": "follow", "level": "level.slipface.json", "tape": "run.tape", "camera": "tape:2/3"}]}
        self.mtl = (folder / "level.mtl").read_text().splitlines()
        self.write()
        if light:
            self.run("bake-light", str(folder / "level.slipface.json"), "--texel", "2")
            self.level = json.loads((folder / "level.slipface.json").read_text())
        self.run("snapshot", "approve", "--goldens", str(folder), "--suite", str(folder / "suite.json"), "--quick", "--in-ci")
        self.saved = folder.with_name(folder.name + "-saved")
        shutil.copytree(folder, self.saved)

    def run(self, *words, codes=(0,)):
        done = subprocess.run([self.program, *words], capture_output=True, text=True)
        if done.returncode not in codes:
            raise SystemExit(f"slipface {' '.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}")

    def write(self):
        self.obj.write(self.folder / "level.obj")
        (self.folder / "level.mtl").write_text("\n".join(self.mtl) + "\n")
        (self.folder / "level.slipface.json").write_text(json.dumps(self.level))
        (self.folder / "run.tape").write_text("\n".join(self.tape) + "\n")
        (self.folder / "suite.json").write_text(json.dumps(self.suite))

    def check(self, environment=None):
        """[(image, its first cause)] of those that differ."""
        out = self.folder.with_name(self.folder.name + "-out")
        self.run("snapshot", "check", "--goldens", str(self.folder), "--suite", str(self.folder / "suite.json"), "--out", str(out),
                 "--jobs", "2", codes=(0, 1))
        entries = json.loads((out / "report.json").read_text())["entries"]
        return [(e["name"], [f["text"] for f in e.get("findings", [])] or [e.get("message", "")]) for e in entries if e["state"] != "same"]

    def restore(self):
        shutil.rmtree(self.folder)
        shutil.copytree(self.saved, self.folder)
        self.obj = Obj(self.folder / "level.obj")
        self.mtl = (self.folder / "level.mtl").read_text().splitlines()
        self.level = json.loads((self.folder / "level.slipface.json").read_text())
        self.tape = (self.folder / "run.tape").read_text().splitlines()
        self.suite = json.loads((self.folder / "suite.json").read_text())


# A kind of change: what is done to a case, and what must be named first. Each returns its size and place in words.
def any_vertex(case):
    return case.rng.choice(case.obj.corners(case.rng.choice(case.faces)))[0] - 1


def move_vertex(metres):
    def change(case):
        k, axis = any_vertex(case), case.rng.randrange(3)
        values = case.obj.numbers("v", k)
        values[axis] += metres
        case.obj.set("v", k, values)
        return f"vertex {k + 1}, {metres:g} m"
    return change


def flip(case):
    face = case.rng.choice(case.faces)
    i = case.obj.of["f"][face]
    words = case.obj.lines[i].split()
    case.obj.lines[i] = " ".join(words[:1] + words[:0:-1])
    return f"face {face}"


def remove(case):
    face = case.rng.choice(case.faces)
    del case.obj.lines[case.obj.of["f"][face]]
    return f"face {face}"


def add(case):
    face = case.rng.choice(case.faces)
    p = case.obj.points(face)
    first = len(case.obj.of["v"])
    middle = [sum(q[k] for q in p) / len(p) for k in range(3)]
    at = max(case.obj.of["v"]) + 1
    case.obj.lines[at:at] = ["v " + " ".join(f"{middle[k] + (0.4 if k == axis else 0):.6g}" for k in range(3)) for axis in range(3)]
    case.obj.lines.append("f " + " ".join(str(first + k) for k in (1, 2, 3)))
    return f"at face {face}"


def move_uv(case):
    if not case.obj.of["vt"]:
        return None
    corners = [c for c in case.obj.corners(case.rng.choice(case.faces)) if len(c) > 1 and c[1]]
    if not corners:
        return None
    k = case.rng.choice(corners)[1] - 1
    case.obj.set("vt", k, [x + 0.25 for x in case.obj.numbers("vt", k)][:2])
    return f"vt {k + 1}"


def colour(case):
    rows = [i for i, line in enumerate(case.mtl) if line.split()[:1] == ["Kd"]]
    i = case.rng.choice(rows)
    values = [float(x) for x in case.mtl[i].split()[1:4]]
    values[case.rng.randrange(3)] *= 0.8 if max(values) > 0.1 else 0.0
    case.mtl[i] = "Kd " + " ".join(f"{x + 0.02:.6g}" for x in values)
    return f"line {i + 1}"


def rename(case):
    used = sorted({case.obj.material(f) for f in case.faces})
    old = case.rng.choice(used)
    new = old + "_new"
    for lines, word in ((case.obj.lines, "usemtl"), (case.mtl, "newmtl")):
        for i, line in enumerate(lines):
            if line.split(None, 1) == [word, old]:
                lines[i] = f"{word} {new}"
    for rule in case.level["rules"]:
        if rule["pattern"] == old:
            rule["pattern"] = new
    return old


def rule(case):
    kind = case.rng.choice(["sticky", "ladder", "bouncy"])
    case.level["rules"][0]["type"] = kind
    return f"ice to {kind}"


def parameter(name):
    def change(case):
        which = case.rng.choice(["ice", "default", "ladder", "bouncy"])
        kind = next(s for s in case.level["surfaces"] if s["name"] == which)
        old = kind[name]
        if isinstance(old, bool):
            kind[name] = not old
        elif isinstance(old, list):
            kind[name] = [old[0] + 0.1] + old[1:]
        else:
            kind[name] = old + 0.13
        return f"{kind['name']}, {old} to {kind[name]}"
    return change


def setting(case):
    name = case.rng.choice(["gravity", "walk_speed", "jump_speed", "ground_acceleration", "air_acceleration", "radius_y"])
    old = case.level["movement"][name]
    case.level["movement"][name] = round(old * 1.07 + 0.01, 4)
    return f"{name}, {old} to {case.level['movement'][name]}"


def spawn(metres):
    def change(case):
        axis = case.rng.choice([0, 2])
        case.level["spawn"]["position"][axis] += metres
        return f"{metres:g} m"
    return change


def longer(case):
    words = case.tape[-1].split()
    case.tape[-1] = " ".join([str(int(words[0]) + 1)] + words[1:])
    return "1 tick"


def turned(case):
    i = case.rng.randrange(3, len(case.tape))
    words = case.tape[i].split()
    x, y = (float(v) for v in words[2].split(","))
    words[2] = f"{x * 0.9999 - y * 0.01:.5f},{y * 0.9999 + x * 0.01:.5f}"
    case.tape[i] = " ".join(words)
    return f"line {i + 1}, 0.6 degrees"


def jumps(case):
    i = case.rng.randrange(3, len(case.tape))
    case.tape[i] = case.tape[i][:-5] if case.tape[i].endswith(" jump") else case.tape[i] + " jump"
    return f"line {i + 1}"


def camera(metres):
    def change(case):
        for scene in case.suite["scenes"]:
            if isinstance(scene["camera"], dict):
                scene["camera"]["eye"][0] += metres
        return f"{metres:g} m"
    return change


def probe(case):
    case.suite["scenes"][1]["probe"]["move"][0] += 0.01
    return "1 cm"


def style(case):
    case.suite["scenes"][0]["style"] = "plain overlay wireframe"
    return "wireframe"


def sun(case):
    if "light" not in case.level:
        return None
    case.level["light"]["sun_color"][0] *= 1.1
    return "red 10 %"


def nothing(case):
    return "-"


GEOMETRY = r"^(level: )?(the level|\d+ faces|face \d+|.*\b(moved|flipped|removed|added|vertex)\b)"
KINDS = [
    ("nothing", nothing, None),
    ("vertex moved", move_vertex(0.001), r"vertex moved|moved"), ("vertex moved", move_vertex(0.02), r"vertex moved|moved"),
    ("vertex moved", move_vertex(1.0), r"moved|vertex"),
    ("face flipped", flip, r"flip"), ("face removed", remove, r"removed|gone"), ("face added", add, r"added|new"),
    ("texture coordinate", move_uv, r"texture coordinate"), ("colour of a material", colour, r"colou?r"),
    ("material renamed", rename, r"renamed|material"), ("type by a rule", rule, r"changed ice to|became|of type"),
    ("type's `climbable`", parameter("climbable"), r"climbable"), ("type's `solid`", parameter("solid"), r"solid"),
    ("type's `friction`", parameter("friction"), r"friction"), ("type's `restitution`", parameter("restitution"), r"restitution"),
    ("type's `velocity`", parameter("velocity"), r"velocity"), ("type's `hazardous`", parameter("hazardous"), r"hazardous"),
    ("type's colour", parameter("color"), r"colou?r"),
    ("setting", setting, None), ("spawn moved", spawn(0.001), r"spawn"), ("spawn moved", spawn(0.3), r"spawn"),
    ("tape longer", longer, r"tape has changed"), ("stick turned", turned, r"tape has changed"), ("jump pressed", jumps, r"tape has changed"),
    ("camera moved", camera(0.001), r"view|eye"), ("camera moved", camera(0.5), r"view|eye"),
    ("probe longer", probe, r"probe: move"), ("style", style, r"style"), ("sun", sun, r"sun_color"),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("levels", nargs="+", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--each", type=int, default=1, help="changes of each kind in each level")
    parser.add_argument("--program", default=str(TOP / "build/release/editor/slipface"))
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the levels and reports")
    options = parser.parse_args()
    folder = options.keep or pathlib.Path(tempfile.mkdtemp())
    rows = {}
    false_alarms = total = red = right = 0
    for number, source in enumerate(options.levels):
        rng = random.Random(f"{options.seed} {source.name}")
        light = (number + options.seed) % 2 == 0
        case = Case(options.program, source.resolve(), folder / f"{number}-{source.stem}", rng, light)
        # Near the player, so that the changes are in the images or in the player's way; half of them anywhere.
        centre = case.level["spawn"]["position"]
        away = lambda f: min(sum((p[k] - centre[k]) ** 2 for k in range(3)) for p in case.obj.points(f))
        faces = [f for f in range(len(case.obj.of["f"])) if case.obj.normal_and_area(f)[1] > 1e-3]
        near = sorted(faces, key=away)[:max(20, len(faces) // 50)]
        for kind, change, wanted in KINDS * options.each:
            case.faces = near if rng.random() < 0.5 else faces
            what = change(case)
            if what is None:
                continue
            case.write()
            differing = case.check()
            case.restore()
            if kind == "nothing":
                false_alarms += len(differing)
                continue
            pattern = wanted or re.escape(what.split(",")[0])
            wrong = [(name, causes) for name, causes in differing if not re.search(pattern, causes[0])]
            total += 1
            red += bool(differing)
            right += bool(differing) and not wrong
            row = rows.setdefault(kind, [0, 0, 0])
            row[0] += 1
            row[1] += bool(differing)
            row[2] += bool(differing) and not wrong
            if not differing or wrong:
                print(f"{source.name}{', light' if light else ''}: {kind} ({what}): "
                      + ("GREEN" if not differing else f"{wrong[0][0]}: {wrong[0][1][:3]}"), file=sys.stderr, flush=True)
    print("| change | made | red | true cause first |\n|---|---:|---:|---:|")
    for kind, (made, is_red, is_right) in rows.items():
        print(f"| {kind} | {made} | {is_red} | {is_right} |")
    print(f"| **all** | {total} | {red} | {right} |")
    print(f"\n{false_alarms} false alarms in {len(options.levels) * options.each} checks without a change")
    if not options.keep:
        shutil.rmtree(folder)
    return 0 if red == total and right >= 0.95 * total and not false_alarms else 1


if __name__ == "__main__":
    sys.exit(main())
