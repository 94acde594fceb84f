#!/usr/bin/env python3
"""The course: a public test of character controllers (docs/course.md).

    course.py make [--seeds 0,1] [--only FAMILY,...] --out COURSE.json
    course.py run COURSE.json --out ANSWER.json [--] COMMAND...     an engine that speaks the stepping protocol
    course.py judge COURSE.json ANSWER.json [--all]                 exit code 1 if a situation fails
    course.py validate FILE.json | -- COMMAND...                    a course or answer file, or how an engine speaks
    course.py table COURSE.json ANSWER.json... --out PAGE.md
"""
import argparse
import datetime
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import protocol  # noqa: E402
import table  # noqa: E402
from engines import Engine, run_course  # noqa: E402
from situation import make_course  # noqa: E402


def load(path):
    try:
        return json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise SystemExit(f"course.py: {path}: {error}")


def checked(path, check):
    document = load(path)
    if problems := check(document):
        raise SystemExit("\n".join(f"course.py: {path}:{problem}" for problem in problems[:20]))
    return document


def main(arguments):
    command = []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, command = arguments[:at], arguments[at + 1:]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    verb = verbs.add_parser("make")
    verb.add_argument("--seeds", default="0,1")
    verb.add_argument("--only", default="")
    verb.add_argument("--out", required=True)
    verb = verbs.add_parser("run")
    verb.add_argument("course")
    verb.add_argument("--out", required=True)
    verb = verbs.add_parser("judge")
    verb.add_argument("course")
    verb.add_argument("answer")
    verb.add_argument("--all", action="store_true")
    verb = verbs.add_parser("validate")
    verb.add_argument("file", nargs="?")
    verb = verbs.add_parser("table")
    verb.add_argument("course")
    verb.add_argument("answers", nargs="+")
    verb.add_argument("--out", required=True)
    options = parser.parse_args(arguments)

    if options.verb == "make":
        seeds = [int(seed) for seed in options.seeds.split(",")]
        course = make_course(seeds, [name for name in options.only.split(",") if name])
        Path(options.out).write_text(json.dumps(course, separators=(",", ":")), encoding="utf-8")
        situations = {run["about"]["situation"] for run in course["runs"]}
        print(f"{len(course['runs'])} runs of {len(situations)} situations in {len({s.split('/')[0] for s in situations})} families")
        return 0
    if options.verb == "run":
        if not command:
            parser.error("expected -- COMMAND")
        course = checked(options.course, protocol.course_problems)
        answer = run_course(course, lambda: Engine(command))
        Path(options.out).write_text(json.dumps(answer, separators=(",", ":")), encoding="utf-8")
        return 0
    if options.verb == "validate":
        if command:
            problems = protocol.engine_problems(command)
        elif options.file:
            document = load(options.file)
            answers = isinstance(document, dict) and "slipface_course_answer" in document
            problems = (protocol.answer_problems if answers else protocol.course_problems)(document)
        else:
            parser.error("expected FILE or -- COMMAND")
        print("\n".join(problems) or "speaks the protocol" if command else "\n".join(problems) or "valid")
        return 1 if problems else 0
    course = checked(options.course, protocol.course_problems)
    if options.verb == "table":
        answers = [checked(path, protocol.answer_problems) for path in options.answers]
        import families  # noqa: F401  the sentences of all situations
        day = datetime.date.today().isoformat()
        Path(options.out).write_text(table.page(course, answers, day), encoding="utf-8")
        return 0
    results = table.situations_of(course, checked(options.answer, protocol.answer_problems))
    for name, result in results.items():
        if options.all or result.state == "failed":
            print(f"{result.state:10} {name:42} {'' if result.figure is None else f'{result.figure:10.3f}'}  {result.why}")
    print(table.totals(results))
    return 1 if any(result.state == "failed" for result in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
