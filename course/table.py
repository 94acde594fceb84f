"""What the answers of several engines come to, by situation, and the page of it."""
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial

from judge import judge


@dataclass
class Result:
    state: str  # "passed", "failed", "missing": it has no such feature
    figure: float | None
    why: str
    runs: int
    passed: int
    game_code: bool


def situations_of(course, answer):
    """{situation: Result}: passed if all runs of it pass; the figure is that of the first run that failed, or of the first."""
    found = {}
    for run in course["runs"]:
        about = run["about"]
        one = answer["runs"].get(run["run"], {"error": {"place": run["run"], "found": "nothing", "expected": "an answer"}})
        found.setdefault(about["situation"], []).append((about, None if "missing" in one else judge(run, one), one))
    results = {}
    for name, runs in found.items():
        game_code = runs[0][0]["game_code"]
        if any(verdict is None for _, verdict, _ in runs):
            missing = next(one["missing"] for _, verdict, one in runs if verdict is None)
            results[name] = Result("missing", None, "has no " + ", ".join(missing), len(runs), 0, game_code)
            continue
        failed = [(about, verdict) for about, verdict, _ in runs if not verdict["passed"]]
        about, shown = failed[0] if failed else (runs[0][0], runs[0][1])
        results[name] = Result("failed" if failed else "passed", shown["figure"], (f"seed {about['seed']}: " if failed else "") + shown["why"],
                               len(runs), len(runs) - len(failed), game_code)
    return results


def totals(results):
    own = [r for r in results.values() if not r.game_code]
    passed, missing = sum(r.state == "passed" for r in own), sum(r.state == "missing" for r in own)
    code = [r for r in results.values() if r.game_code]
    return (f"{passed} of {len(own)} passed, {sum(r.state == 'failed' for r in own)} failed, {missing} without the feature; "
            f"game code: {sum(r.state == 'passed' for r in code)} of {len(code)}")


def figure_text(value):
    if value is None:
        return ""
    return "" if abs(value) > 1e6 else f"{value:.0f}" if abs(value) >= 100 or value == int(value) else f"{value:.2g}" if abs(value) < 1 else f"{value:.3g}"


def page(course, answers, day):
    """The page of the table: situations by engines."""
    from situation import SITUATIONS  # the sentences
    with ProcessPoolExecutor(len(answers)) as workers:
        results = list(workers.map(partial(situations_of, course), answers))
    names = [answer["engine"] for answer in answers]
    words = {"passed": "pass", "failed": "**fail**", "missing": "–"}

    def row(*cells):
        return "| " + " | ".join(str(cell) for cell in cells) + " |\n"

    def count(rows, state, game_code):
        return sum(r.state == state and r.game_code == game_code for r in rows.values())
    total = len([name for name, r in results[0].items() if not r.game_code])
    text = (f"# The course: who passes\n\nMade by `scripts/course.sh` on {day}: {total} situations in {len(course['runs'])} runs, seeds "
            f"{', '.join(map(str, course['about']['seeds']))}. [The course](course.md) says what they are, how each controller is set up, and how to object.\n\n")
    text += row("", *names) + row("---", *["---"] * len(names))
    text += row("version", *[answer["version"] for answer in answers])
    text += row("passed", *[count(r, "passed", False) for r in results])
    text += row("failed", *[count(r, "failed", False) for r in results])
    text += row("has no such feature", *[count(r, "missing", False) for r in results])
    text += row("game code passed", *[count(r, "passed", True) for r in results])
    text += ("\nA cell has the figure of the situation's first check: metres, metres per second, millimetres or ticks, as its sentence in "
             "`course.py judge COURSE ANSWER --all` says. It is that of the first run that fails, else of the first run.\n")
    family = None
    for name in results[0]:
        if name.split("/")[0] != family:
            family = name.split("/")[0]
            text += f"\n## {family[0].upper() + family[1:]}\n\n" + row("", *names, "Why a player notices") + row("---", *["---"] * (len(names) + 1))
        cells = [(words[r[name].state] + " " + figure_text(r[name].figure)).strip() for r in results]
        text += row(name.split("/", 1)[1], *cells, SITUATIONS[name].says if name in SITUATIONS else "")
    for answer, one in zip(answers, results):
        if answer["engine"] == "slipface" and (failed := {n: r for n, r in one.items() if r.state == "failed"}):
            text += "\n## Where Slipface fails\n\n" + "".join(f"- {name}: {r.why}\n" for name, r in failed.items())
    kept = [(name, SITUATIONS[name].keep) for name in results[0] if name in SITUATIONS and len({r[name].state for r in results} - {"missing"}) == 1]
    text += "\n## What separates nobody today\n\nAll controllers that have the feature pass these, or none does; they stay for what is yet to come.\n\n"
    text += "".join(f"- {name}{': ' + why if why else ''}\n" for name, why in kept)
    return text
