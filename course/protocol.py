"""Validates what is written in the stepping protocol (docs/course.md): course files, answer files, and how an engine speaks. Each
problem is "place: found X, expected Y"."""
import json
import math

from engines import PROTOCOL, Engine, Refusal

FEATURES = ("slope_limit", "steps", "snap", "moving", "jump")
SETTINGS = ("gravity", "walk_speed", "jump_speed", "step_height", "snap_distance", "max_slope_deg", "own")


class Checker:
    def __init__(self):
        self.problems = []

    def say(self, place, found, expected):
        shown = found if isinstance(found, str) and found == "nothing" else json.dumps(found, default=str)
        self.problems.append(f"{place or '/'}: found {shown if len(shown) < 80 else shown[:77] + '...'}, expected {expected}")

    def member(self, value, place, key, check, needed=True):
        if not isinstance(value, dict):
            return
        if key in value:
            check(value[key], f"{place}/{key}")
        elif needed:
            self.say(place, "nothing", f'a member "{key}"')

    def object_of(self, value, place, keys):
        if not isinstance(value, dict):
            self.say(place, value, "an object")
            return False
        for key in value:
            if key not in keys:
                self.say(place, f"the member {key}", "only " + ", ".join(keys))
        return True

    def number(self, low, high):
        def check(value, place):
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value) or not low <= value <= high:
                self.say(place, value, f"a number from {low} to {high}")
        return check

    def whole(self, low, high):
        def check(value, place):
            if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
                self.say(place, value, f"a whole number from {low} to {high}")
        return check

    def numbers(self, count):
        one = self.number(-1e6, 1e6)

        def check(value, place):
            if not isinstance(value, list) or len(value) != count:
                self.say(place, value, f"{count} numbers")
                return
            for i, item in enumerate(value):
                one(item, f"{place}/{i}")
        return check

    def text(self, value, place):
        if not isinstance(value, str) or len(value.encode()) > 1000:
            self.say(place, value, "a string of at most 1000 bytes")

    def each(self, check):
        def check_all(value, place):
            if not isinstance(value, list):
                self.say(place, value, "an array")
                return
            for i, item in enumerate(value):
                check(item, f"{place}/{i}")
        return check_all

    def pose(self, value, place):
        self.member(value, place, "position", self.numbers(3))
        self.member(value, place, "rotation", self.numbers(4), needed=False)

    def load(self, value, place):
        if not self.object_of(value, place, ("body", "feet", "settings", "meshes")):
            return

        def body(one, at):
            if self.object_of(one, at, ("radius", "height")):
                self.member(one, at, "radius", self.number(0.01, 100))
                self.member(one, at, "height", self.number(0.02, 1000))

        def settings(one, at):
            if self.object_of(one, at, SETTINGS):
                for key in SETTINGS[:-1]:
                    self.member(one, at, key, self.number(0, 1e4), needed=False)

        def mesh(one, at):
            if not self.object_of(one, at, ("positions", "triangles", "moves", "position", "rotation")):
                return
            self.member(one, at, "positions", self.each(self.numbers(3)))
            count = len(one["positions"]) if isinstance(one.get("positions"), list) else 0

            def triangle(three, there):
                if not isinstance(three, list) or len(three) != 3:
                    self.say(there, three, "three indices of positions")
                    return
                for i, index in enumerate(three):
                    self.whole(0, count - 1)(index, f"{there}/{i}")
            self.member(one, at, "triangles", self.each(triangle))
            if "moves" in one and not isinstance(one["moves"], bool):
                self.say(at + "/moves", one["moves"], "true or false")
            if one.get("moves") and "position" in one:
                self.pose(one, at)
        self.member(value, place, "body", body)
        self.member(value, place, "feet", self.numbers(3))
        self.member(value, place, "settings", settings, needed=False)
        self.member(value, place, "meshes", self.each(mesh))

    def step(self, value, place, meshes):
        if not self.object_of(value, place, ("repeat", "dt", "wish", "buttons", "poses")):
            return

        def pose(one, at):
            if self.object_of(one, at, ("mesh", "position", "rotation")):
                self.member(one, at, "mesh", self.whole(0, len(meshes) - 1))
                self.pose(one, at)
                number = one.get("mesh")
                if isinstance(number, int) and 0 <= number < len(meshes) and isinstance(meshes[number], dict) and not meshes[number].get("moves"):
                    self.say(at + "/mesh", number, "the number of a mesh that moves")
        self.member(value, place, "repeat", self.whole(1, 1_000_000), needed=False)
        self.member(value, place, "dt", self.number(1e-4, 60))
        self.member(value, place, "wish", self.numbers(2), needed=False)
        self.member(value, place, "buttons", self.each(self.text), needed=False)
        self.member(value, place, "poses", self.each(pose), needed=False)


def course_problems(document):
    c = Checker()
    if not c.object_of(document, "", ("slipface_course", "about", "runs")):
        return c.problems
    c.member(document, "", "slipface_course", c.whole(PROTOCOL, PROTOCOL))
    names = set()

    def run(one, at):
        if not c.object_of(one, at, ("run", "about", "load", "steps")):
            return
        c.member(one, at, "run", c.text)
        if isinstance(one.get("run"), str):
            if one["run"] in names:
                c.say(at + "/run", one["run"], "a name that no other run has")
            names.add(one["run"])
        c.member(one, at, "load", c.load)
        loaded = one.get("load") if isinstance(one.get("load"), dict) else {}
        meshes = loaded["meshes"] if isinstance(loaded.get("meshes"), list) else []
        c.member(one, at, "steps", c.each(lambda step, there: c.step(step, there, meshes)))
    c.member(document, "", "runs", c.each(run))
    return c.problems


def answer_problems(document):
    c = Checker()
    if not c.object_of(document, "", ("slipface_course_answer", "engine", "version", "body", "features", "note", "runs")):
        return c.problems
    c.member(document, "", "slipface_course_answer", c.whole(PROTOCOL, PROTOCOL))
    c.member(document, "", "engine", c.text)
    c.member(document, "", "version", c.text)
    c.member(document, "", "features", c.each(c.text))
    if not isinstance(document.get("runs"), dict):
        c.say("/runs", document.get("runs", "nothing"), "an object")
        return c.problems
    for name, run in document["runs"].items():
        at = "/runs/" + name
        if not c.object_of(run, at, ("feet", "grounded", "error", "missing")):
            continue
        if "feet" in run:
            # Positions that are no numbers are the judge's to refuse.
            c.each(lambda feet, there: None if isinstance(feet, list) and len(feet) == 3 else c.say(there, feet, "three numbers"))(run["feet"], at + "/feet")
        elif "error" not in run and "missing" not in run:
            c.say(at, "nothing", 'a member "feet", "error" or "missing"')
    return c.problems


FLOOR = {"positions": [[-9, 0, -9], [-9, 0, 9], [9, 0, 9], [9, 0, -9]], "triangles": [[0, 1, 2], [0, 2, 3]]}
LOAD = {"do": "load", "run": "a", "body": {"radius": 0.4, "height": 1.8}, "feet": [0, 0.02, 0], "settings": {"walk_speed": 6}, "meshes": [FLOOR]}


def engine_problems(command):
    """What an engine says wrong: a conversation with right and wrong requests, in which the process must not end."""
    problems = []

    def expect(what, answer, fine):
        if not fine:
            problems.append(f"{what}: found {json.dumps(answer)[:200]}")
    try:
        engine = Engine(command, timeout_s=60)
        hello = engine.hello
        expect("hello names engine and version", hello, isinstance(hello.get("engine"), str) and isinstance(hello.get("version"), str))
        expect(f"hello's features are of {', '.join(FEATURES)}", hello, isinstance(hello.get("features"), list) and set(hello["features"]) <= set(FEATURES))

        def refused(what, request):
            answer = engine.ask([request])[0]
            error = answer.get("error")
            expect(what + " is refused with place, found and expected", answer,
                   isinstance(error, dict) and all(isinstance(error.get(k), str) for k in ("place", "found", "expected")))
        expect("load is answered with ok", a := engine.ask([LOAD])[0], a.get("ok") == "load" and a.get("run") == "a")
        walk = {"do": "step", "run": "a", "dt": 1 / 60, "wish": [1, 0]}
        first = engine.ask([walk] * 30)
        for answer in first:
            feet = answer.get("feet")
            if not (isinstance(feet, list) and len(feet) == 3 and all(isinstance(x, (int, float)) and math.isfinite(x) for x in feet)):
                expect("step is answered with three numbers of feet", answer, False)
                break
        else:
            expect("half a second of walking along +X gets about 3 m far", first[-1], 1.5 < first[-1]["feet"][0] < 3.3)
        for what, request in (
                ("a step of a run that is not loaded", {**walk, "run": "never"}), ("a dt of -1", {**walk, "dt": -1}),
                ("a wish of three numbers", {**walk, "wish": [1, 0, 0]}), ("a request without a verb", {"run": "a"}),
                ("an index beyond the positions", {**LOAD, "run": "b", "meshes": [{**FLOOR, "triangles": [[0, 1, 9]]}]}),
                ("a pose of a mesh that does not move", {**walk, "poses": [{"mesh": 0, "position": [0, 0, 0]}]}),
                ("a position that is no number", {**LOAD, "run": "b", "feet": [0, "high", 0]})):
            refused(what, request)
        engine.process.stdin.write("no JSON\n")
        engine.process.stdin.flush()
        answer = json.loads(engine.process.stdout.readline())
        expect("a line that is no JSON is refused", answer, "error" in answer)
        after = engine.ask([{**walk, "wish": [0, 0]}])[0]
        expect("refused requests leave the run as it was", after, isinstance(after.get("feet"), list))
        second = engine.ask([{**LOAD, "run": "b"}] + [{**walk, "run": "b"}] * 30)[1:]
        expect("a second run in the process gives the same positions as the first", second[-1], [a["feet"] for a in second] == [a["feet"] for a in first])
        fast = engine.ask([{**LOAD, "run": "c"}] + [{**walk, "run": "c", "dt": dt} for dt in [1 / 120] * 60])[-1]
        expect("dt may change: 60 steps of 1/120 s get about as far as 30 of 1/60 s", fast, abs(fast["feet"][0] - first[-1]["feet"][0]) < 0.3)
        expect("free is answered with ok", a := engine.ask([{"do": "free", "run": "b"}])[0], a.get("ok") == "free")
        refused("a run that was freed", {**walk, "run": "b"})
        code = engine.close()
        expect("the process ends with 0 at the end of its input", code, code == 0)
    except (Refusal, OSError, ValueError) as error:
        problems.append(str(error))
    return problems
