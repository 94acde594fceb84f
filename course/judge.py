"""Judges a run of the course by the positions of the feet alone.

A check is a dictionary with a `kind`, which is the name of a function below, and its numbers. Ticks count from 0; `first` and `last`
are ticks, both included, and are those of the whole run if they are not given. Everything is in the situation's own coordinates, in
which the player mostly walks along +X. A check answers (passed, a number to show, a sentence).
"""
import math
from functools import lru_cache

from geometry import rotate_y
from situation import HEIGHT, RADIUS

CHECKS = {}


def check(function):
    CHECKS[function.__name__] = function
    return function


class Positions:
    """The feet of a run in the situation's own coordinates, with what it was asked to do."""

    def __init__(self, run, feet):
        frame = run["about"]["frame"]
        self.run, self.frame = run, frame
        self.dts, self.wishes, self.poses = [], [], []
        for step in run["steps"]:
            wish = rotate_y(-frame["yaw"], (step["wish"][0], 0.0, step["wish"][1]))
            for _ in range(step.get("repeat", 1)):
                self.dts.append(step["dt"])
                self.wishes.append((wish[0], wish[2]))
                self.poses.append(step.get("poses", []))
        self.world = [tuple(p) for p in feet]
        self.feet = [self.own(p) for p in self.world]
        self.start = self.own(run["load"]["feet"])

    def own(self, point):
        moved = [point[i] - self.frame["offset"][i] for i in range(3)]
        return rotate_y(-self.frame["yaw"], moved)

    def move(self, tick):
        a, b = self.feet[tick - 1] if tick else self.start, self.feet[tick]
        return tuple(b[i] - a[i] for i in range(3))

    def span(self, check):
        first, last = check.get("first", 0), check.get("last", len(self.feet) - 1)
        return range(first, last + 1)


def along(direction, vector):
    return direction[0] * vector[0] + direction[1] * vector[2]


@check
def reach(run, c):
    """Some tick is at least `least` metres along `axis` (x, y, z)."""
    got = max(sum(c["axis"][i] * run.feet[t][i] for i in range(3)) for t in run.span(c))
    return got >= c["least"], got, f"came {got:.2f} m far, expected {c['least']:.2f}"


@check
def stay(run, c):
    """Every tick is between `low` and `high` (x, y, z; null: no limit)."""
    worst, where = 0.0, ""
    for t in run.span(c):
        for i in range(3):
            low, high = c["low"][i], c["high"][i]
            out = max(low - run.feet[t][i] if low is not None else 0.0, run.feet[t][i] - high if high is not None else 0.0)
            if out > worst:
                worst, where = out, f"at tick {t} {'xyz'[i]} is {run.feet[t][i]:.3f}"
    return worst == 0.0, worst, where + f", {worst:.3f} m outside" if worst else "stays inside"


@check
def profile(run, c):
    """The feet follow the ground line `points` (x, y): at most `below` under the lowest and `above` over the highest point of it
    that the body covers, besides the distance that it keeps from still ground (at tick `rest`, at most 0.12 m)."""
    def around(x):
        ys = [y for px, y in c["points"] if abs(px - x) <= RADIUS]
        for (xa, ya), (xb, yb) in zip(c["points"], c["points"][1:]):
            for edge in (x - RADIUS, x, x + RADIUS):
                if xa <= edge <= xb and xb > xa:
                    ys.append(ya + (yb - ya) * (edge - xa) / (xb - xa))
        return (min(ys), max(ys)) if ys else (None, None)
    hover = run.feet[c["rest"]][1] - around(run.feet[c["rest"]][0])[1]
    if abs(hover) > 0.12:
        return False, hover, f"rests {hover:.3f} m above still ground"
    most, worst, where = 0.0, 0.0, "follows the ground"
    for t in run.span(c):
        low, high = around(run.feet[t][0])
        if low is None:
            return False, math.inf, f"leaves the path at tick {t}"
        y = run.feet[t][1] - hover
        away = max(low - y, y - high)
        most = max(most, away)
        out = max(low - c["below"] - y, y - high - c["above"])
        if out > worst:
            worst, where = out, f"at tick {t} {away * 1000:.0f} mm {'above' if y > high else 'below'} the ground"
    return worst == 0.0, most * 1000, where


@check
def even(run, c):
    """The height varies by at most `most` m."""
    ys = [run.feet[t][1] for t in run.span(c)]
    got = max(ys) - min(ys)
    return got <= c["most"], got * 1000, f"the height varies by {got * 1000:.1f} mm, expected at most {c['most'] * 1000:.0f}"


@check
def speed(run, c):
    """Metres per second along `way` (x, z) are from `least` to `most`."""
    ticks = run.span(c)
    got = sum(along(c["way"], run.move(t)) for t in ticks) / sum(run.dts[t] for t in ticks)
    return c["least"] <= got <= c["most"], got, f"{got:.2f} m/s, expected {c['least']:.2f} to {c['most']:.2f}"


@check
def smooth(run, c):
    """In at most `ticks` ticks the player makes less than `fraction` of its mean speed along `way` (x, z)."""
    ticks = run.span(c)
    speeds = {t: along(c["way"], run.move(t)) / run.dts[t] for t in ticks}
    mean = sum(speeds.values()) / len(speeds)
    slow = [t for t in ticks if speeds[t] < c["fraction"] * mean] if mean > 0.1 else list(ticks)
    return len(slow) <= c["ticks"], len(slow), f"{len(slow)} ticks lose speed" + (f", the first at {slow[0]}" if slow else "")


@check
def rest(run, c):
    """The player moves at most `creep` m from where it is at the first tick."""
    ticks = run.span(c)
    got = max(math.dist(run.feet[ticks[0]], run.feet[t]) for t in ticks)
    return got <= c["creep"], got * 1000, f"moves {got * 1000:.1f} mm at rest, expected at most {c['creep'] * 1000:.0f}"


@check
def still(run, c):
    """No tick moves the player by more than `most` m."""
    got, tick = max((math.dist((0, 0, 0), run.move(t)), t) for t in run.span(c))
    return got <= c["most"], got * 1000, f"{got * 1000:.1f} mm in tick {tick}, expected at most {c['most'] * 1000:.0f}"


@check
def forward(run, c):
    """In at most `ticks` ticks the player moves against the stick, by more than a millimetre."""
    back = [t for t in run.span(c) if along(run.wishes[t], run.move(t)) < -0.001]
    return len(back) <= c["ticks"], len(back), f"{len(back)} ticks go against the stick" + (f", the first is {back[0]}" if back else "")


@check
def travel(run, c):
    """The way is at least `least` m long: of all ticks, seen from above."""
    got = sum(math.hypot(run.move(t)[0], run.move(t)[2]) for t in run.span(c))
    return got >= c["least"], got, f"walked {got:.1f} m, expected at least {c['least']:.1f}"


@check
def rise(run, c):
    """The highest of the ticks is from `least` to `most` m above tick `rest`."""
    got = max(run.feet[t][1] for t in run.span(c)) - run.feet[c["rest"]][1]
    return c["least"] <= got <= c["most"], got, f"rises {got:.3f} m, expected {c['least']:.2f} to {c['most']:.2f}"


def turned(quaternion, vector):
    """By the quaternion's conjugate: from the level into the body."""
    x, y, z, w = -quaternion[0], -quaternion[1], -quaternion[2], quaternion[3]
    vx, vy, vz = vector
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx)


def in_body(run, tick, mesh, point):
    pose = next(p for p in run.poses[tick] if p["mesh"] == mesh)
    return turned(pose["rotation"], [point[i] - pose["position"][i] for i in range(3)])


@check
def ride(run, c):
    """Seen from the moving mesh number `mesh`, the player moves at most `most` m from where it is at the first tick."""
    ticks = run.span(c)
    seen = [in_body(run, t, c["mesh"], run.world[t]) for t in ticks]
    got = max(math.dist(seen[0], p) for p in seen)
    return got <= c["most"], got, f"slips {got:.3f} m on what carries it, expected at most {c['most']:.2f}"


# The part of the body that is inside a capsule and an ellipsoid of the course's size, by a wide margin.
CORE = (0.7 * RADIUS, 0.35 * HEIGHT, 0.7 * RADIUS)


def nearest_on_triangle(a, b, c):
    """The point of the triangle nearest to the origin."""
    def sub(p, q): return (p[0] - q[0], p[1] - q[1], p[2] - q[2])
    def dot(p, q): return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    def mix(p, q, t): return (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2]))
    def on_segment(p, q):
        d = sub(q, p)
        square = dot(d, d)
        return mix(p, q, min(1.0, max(0.0, -dot(p, d) / square)) if square > 0 else 0.0)
    u, v = sub(b, a), sub(c, a)
    uu, uv, vv, ua, va = dot(u, u), dot(u, v), dot(v, v), -dot(u, a), -dot(v, a)
    area = uu * vv - uv * uv
    if area > 1e-18:
        s, t = (vv * ua - uv * va) / area, (uu * va - uv * ua) / area
        if s >= 0 and t >= 0 and s + t <= 1:
            return tuple(a[i] + s * u[i] + t * v[i] for i in range(3))
    return min((on_segment(a, b), on_segment(b, c), on_segment(c, a)), key=lambda p: dot(p, p))


class Triangles:
    """A mesh in cells of a grid, for the few triangles near a body."""
    size = 1.0

    def __init__(self, mesh):
        self.corners = [[mesh["positions"][i] for i in t] for t in mesh["triangles"]]
        self.boxes = [tuple(f(p[i] for p in corners) for f in (min, max) for i in range(3)) for corners in self.corners]
        self.cells = {}
        for n, corners in enumerate(self.corners):
            low = [math.floor((min(p[i] for p in corners) - 0.01) / self.size) for i in range(3)]
            high = [math.floor((max(p[i] for p in corners) + 0.01) / self.size) for i in range(3)]
            if (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1) > 4000:
                self.cells.setdefault(None, []).append(n)
                continue
            for x in range(low[0], high[0] + 1):
                for y in range(low[1], high[1] + 1):
                    for z in range(low[2], high[2] + 1):
                        self.cells.setdefault((x, y, z), []).append(n)

    def near(self, low, high):
        found = set(self.cells.get(None, ()))
        l, h = [[math.floor(p[i] / self.size) for i in range(3)] for p in (low, high)]
        for x in range(l[0], h[0] + 1):
            for y in range(l[1], h[1] + 1):
                for z in range(l[2], h[2] + 1):
                    found.update(self.cells.get((x, y, z), ()))
        (x0, y0, z0), (x1, y1, z1) = low, high
        boxes = self.boxes
        return [self.corners[n] for n in sorted(found) if boxes[n][0] <= x1 and boxes[n][3] >= x0 and boxes[n][1] <= y1 and boxes[n][4] >= y0
                and boxes[n][2] <= z1 and boxes[n][5] >= z0]


def crosses(a, b, corners):
    """The segment from a to b passes through the triangle."""
    def sub(p, q): return [p[i] - q[i] for i in range(3)]
    def cross(p, q): return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    def dot(p, q): return sum(p[i] * q[i] for i in range(3))
    e, f, d = sub(corners[1], corners[0]), sub(corners[2], corners[0]), sub(b, a)
    p = cross(d, f)
    volume = dot(e, p)
    if abs(volume) < 1e-12:
        return False
    s = sub(a, corners[0])
    q = cross(s, e)
    u, v, t = dot(s, p) / volume, dot(d, q) / volume, dot(f, q) / volume
    return u >= 0 and v >= 0 and u + v <= 1 and 0 <= t <= 1


@check
def outside(run, c):
    """(Of every run.) The middle of the body passes through no triangle, and its core overlaps none. `moving`: false leaves out the moving meshes."""
    middle = lambda feet: (feet[0], feet[1] + HEIGHT / 2, feet[2])
    for number, mesh in enumerate(run.run["load"]["meshes"]):
        moves = mesh.get("moves", False)
        if moves and not c.get("moving", True):
            continue
        triangles, before = Triangles(mesh), None
        for t in run.span(c):
            now = middle(run.world[t])
            if not all(map(math.isfinite, now)) or max(map(abs, now)) > 1e7:
                return False, t, f"is nowhere at tick {t}"
            if moves:
                now = in_body(run, t, number, now)
            if before is not None and math.dist(before, now) < 1e-7:
                continue
            if before is not None and math.dist(before, now) > 50:
                return False, t, f"jumps {math.dist(before, now):.0f} m in tick {t}"
            if before is not None:
                for corners in triangles.near([min(p) for p in zip(before, now)], [max(p) for p in zip(before, now)]):
                    if crosses(before, now, corners):
                        return False, t, f"passes through a face at tick {t}"
            for corners in triangles.near([now[i] - CORE[i] for i in range(3)], [now[i] + CORE[i] for i in range(3)]):
                near = nearest_on_triangle(*[tuple((p[i] - now[i]) / CORE[i] for i in range(3)) for p in corners])
                if near[0] ** 2 + near[1] ** 2 + near[2] ** 2 < 1.0:
                    return False, t, f"is inside the geometry at tick {t}"
            before = now
    return True, 0, "stays outside"


def judge(run, answer):
    """{"passed", "figure", "why"} of a run of the course and an engine's answer to it."""
    if "error" in answer:
        error = answer["error"]
        return {"passed": False, "figure": None, "why": f"error at {error.get('place')}: found {error.get('found')}, expected {error.get('expected')}"}
    expected = sum(step.get("repeat", 1) for step in run["steps"])
    feet = answer["feet"]
    if len(feet) != expected:
        return {"passed": False, "figure": None, "why": f"answered {len(feet)} ticks of {expected}"}
    if not all(isinstance(c, (int, float)) and math.isfinite(c) for p in feet for c in p):
        return {"passed": False, "figure": None, "why": "answered with what is no number"}
    positions = Positions(run, feet)
    results = [CHECKS[c["kind"]](positions, c) for c in run["about"]["checks"]]
    failed = [text for passed, _, text in results if not passed]
    figure, text = results[0][1], results[0][2]
    return {"passed": not failed, "figure": figure, "why": "; ".join(failed) or text}
