"""A situation: a small level, inputs, and what must be true of the positions. Each is made for the seed 0, as written, and for
other seeds with drawn sizes, turned about the vertical and shifted, so that no controller passes by the luck of the axes."""
import math
import random
from dataclasses import dataclass, field

from geometry import Mesh, rotate_y

RADIUS, HEIGHT = 0.4, 1.8
SETTINGS = {"gravity": 20.0, "walk_speed": 6.0, "jump_speed": 8.0, "step_height": 0.35, "snap_distance": 0.35, "max_slope_deg": 50.0}

SITUATIONS = {}


@dataclass
class Situation:
    name: str  # "family/what"
    says: str  # why a player notices
    source: str
    make: object  # make(run)
    needs: tuple = ()  # features that a controller must have for it
    game_code: bool = False  # decided by what a game writes around its controller
    keep: str = ""  # why it stays although all pass or none does

    @property
    def family(self):
        return self.name.split("/")[0]


def situation(name, says, source, needs=(), game_code=False, keep="", **sizes):
    """Registers make(run, **sizes) under `name`."""
    def add(make):
        assert name not in SITUATIONS, name
        SITUATIONS[name] = Situation(name, says, source, lambda run: make(run, **sizes), tuple(needs), game_code, keep)
        return make
    return add


class Run:
    """One run of a situation while it is made: in the situation's own coordinates, in which the player mostly walks along +X."""

    def __init__(self, seed, name):
        self.random = random.Random(f"{name} {seed}")
        self.plain = seed == 0
        self.yaw = 0.0 if self.plain else self.random.uniform(0, 2 * math.pi)
        self.offset = (0.0, 0.0, 0.0) if self.plain else tuple(self.random.uniform(-20, 20) for _ in range(3))
        self.dt = 1 / 60
        self.settings = dict(SETTINGS)
        self.still = Mesh()
        self.bodies = []  # (Mesh, motion)
        self.feet = (0.0, 0.02, 0.0)
        self.steps, self.checks = [], []
        self.time = 0.0

    def vary(self, usual, low, high):
        """`usual` for the seed 0, a drawn number for the others."""
        return usual if self.plain else self.random.uniform(low, high)

    def moving(self, mesh, motion):
        """A body whose pose at t seconds is motion(t) = (position, turn about the vertical in radians)."""
        self.bodies.append((mesh, motion))
        return len(self.bodies)  # its number: the still mesh is 0

    @property
    def ticks(self):
        return len(self.steps)

    def go(self, seconds, wish=(0.0, 0.0), jump=False, dt=None):
        """Steps with one input; `jump`: True holds the button, a number presses it every so many ticks."""
        dt = dt or self.dt
        for i in range(max(1, round(seconds / dt))):
            self.time += dt
            pressed = jump is True or (jump is not False and i % jump == 0)
            self.steps.append({"dt": dt, "wish": wish, "buttons": ["jump"] if pressed else [], "time": self.time})
        return self.ticks

    def check(self, kind, **numbers):
        self.checks.append({"kind": kind, **numbers})

    def world(self, point):
        turned = rotate_y(self.yaw, point)
        return [round(turned[i] + self.offset[i], 6) for i in range(3)]

    def mesh_json(self, mesh, whole):
        place = self.world if whole else lambda p: [round(c, 6) for c in p]
        return {"positions": [place(p) for p in mesh.positions], "triangles": [list(t) for t in mesh.triangles]}

    def pose_json(self, motion, time):
        position, turn = motion(time)
        angle = turn + self.yaw
        return {"position": self.world(position), "rotation": [0.0, round(math.sin(angle / 2), 9), 0.0, round(math.cos(angle / 2), 9)]}

    def to_json(self, situation, seed):
        meshes = [self.mesh_json(self.still, True)]
        meshes += [{"moves": True, **self.mesh_json(mesh, False), **self.pose_json(motion, 0.0)} for mesh, motion in self.bodies]
        steps = []
        for step in self.steps:
            x, _, z = rotate_y(self.yaw, (step["wish"][0], 0.0, step["wish"][1]))
            made = {"dt": step["dt"], "wish": [round(x, 9), round(z, 9)]}
            if step["buttons"]:
                made["buttons"] = step["buttons"]
            if self.bodies:
                made["poses"] = [{"mesh": i + 1, **self.pose_json(motion, step["time"])} for i, (_, motion) in enumerate(self.bodies)]
            if steps and not self.bodies and {k: v for k, v in steps[-1].items() if k != "repeat"} == made:
                steps[-1]["repeat"] = steps[-1].get("repeat", 1) + 1
            else:
                steps.append(made)
        about = {"situation": situation.name, "seed": seed, "says": situation.says, "source": situation.source, "needs": list(situation.needs),
                 "game_code": situation.game_code, "frame": {"yaw": self.yaw, "offset": list(self.offset)}, "checks": self.checks}
        return {"run": f"{situation.name}#{seed}", "about": about,
                "load": {"body": {"radius": RADIUS, "height": HEIGHT}, "feet": self.world(self.feet), "settings": self.settings, "meshes": meshes},
                "steps": steps}


def make_run(situation, seed):
    run = Run(seed, situation.name)
    situation.make(run)
    if not any(check["kind"] == "outside" for check in run.checks):
        run.check("outside")
    return run.to_json(situation, seed)


def make_course(seeds, names=None):
    import families  # noqa: F401  registers all
    chosen = [s for s in SITUATIONS.values() if not names or any(s.name.startswith(n) for n in names)]
    return {"slipface_course": 1, "about": {"seeds": list(seeds)}, "runs": [make_run(s, seed) for s in chosen for seed in seeds]}
