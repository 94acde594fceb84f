#!/usr/bin/env python3
"""The checks that take too long for every change: what each runs, what it looks at, and when it last passed.

    heavy_checks.py                    lists them
    heavy_checks.py run [NAME...]      runs them all, or those named, and writes each result into docs/checks.md
    heavy_checks.py due MINUTES        runs those whose inputs changed since they last passed, the most urgent first, as
                                       far as the minutes suffice; writes nothing. .ci/run ends with it. One that never
                                       passed yet is for .ci/nightly

A check is urgent if its own inputs changed; every other change to the program makes it due as well, the longest unchecked first.
"""
import dataclasses, datetime, pathlib, re, subprocess, sys, time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/checks.md"
PROGRAM = ("engine", "editor", "cmake", "CMakeLists.txt", "CMakePresets.json")  # what every check builds


@dataclasses.dataclass(frozen=True)
class Check:
    name: str
    command: str
    minutes: int  # on two processors, until docs/checks.md knows better
    inputs: tuple[str, ...]  # what this check alone looks at, beside its script
    says: str


@dataclasses.dataclass(frozen=True)
class Result:
    passed: bool
    date: str
    commit: str
    minutes: int


BARE = ("run.sh", "test.sh", "scripts/common.sh", "scripts/bare_system.sh")
CHECKS = (
    Check("debian-13", "scripts/check_bare.sh trixie", 30, BARE, "both commands of the README on a bare Debian 13"),
    Check("debian-testing", "scripts/check_bare.sh testing", 30, BARE, "the same on Debian testing"),
    Check("debian-12-user", "scripts/check_bare.sh bookworm --user", 30, BARE, "the same on Debian 12, as a user with sudo"),
    Check("page", "scripts/check_web.sh", 25, ("web", "stand_ins", "scripts/build_web.sh", "docs/site"), "the editor as a page, used in Chromium"),
    Check("npm", "scripts/build_npm.sh --test", 8, ("npm", "web", "docs/tutorials/mover-in-a-browser.md"),
          "the npm package: its tests in node, its size, its tutorial word for word"),
    Check("packages", "scripts/check_packages.sh", 20, ("debian", "scripts/bare_system.sh", "examples", "tests/consumer"),
          "the Debian packages: built in one bare system, used in another"),
    Check("windows", "scripts/check_windows.sh", 60, ("cmake/windows.cmake", "stand_ins", "scripts/compare_windows.sh"),
          "the engine and the command line built by mingw; tests, bits and output under wine"),
    Check("libcxx", "scripts/check_libcxx.sh", 30, ("stand_ins", "scripts/bare_system.sh"),
          "the engine built with clang and libc++ on Debian testing: its tests and its bits"),
    Check("cluster", "scripts/cluster_test.sh", 12, ("editor/mpi", "scripts/slurm.sh"), "audits, searches and snapshots under Slurm and MPI"),
    Check("sanitizers", "scripts/check_sanitizers.sh", 35, ("tests",), "every test under AddressSanitizer and UndefinedBehaviorSanitizer"),
    Check("tidy", "scripts/check_tidy.sh", 50, (".clang-tidy",), "clang-tidy over every source file"),
    Check("threads", "scripts/check_threads.sh", 8, (), "tests of batches and of the tree's construction under ThreadSanitizer"),
    Check("valgrind", "scripts/check_valgrind.sh", 4, (), "tests of collision and movement under memcheck"),
    Check("arm64", "scripts/compare_arm64.sh", 15, ("cmake/arm64.cmake",), "the bits of ARM64 under qemu"),
    Check("web-bits", "scripts/compare_web.sh", 15, ("web", "stand_ins"), "the bits of WebAssembly in node"),
    Check("fuzzers", "scripts/fuzz.sh", 8, ("tests/fuzz",), "2000 runs of every fuzzer from its corpus"),
    Check("gltf", "scripts/check_gltf.sh", 3, (), "exports read by a validator and read back"),
    Check("by-hand", "scripts/by_hand_test.sh", 20, ("tests/window",), "the real window by a mouse and a keyboard, in real time"),
    Check("kills", "scripts/kill_test.sh", 5, ("scripts/kill_verbs.py",), "verbs that are killed while they write"),
)
by_name = {check.name: check for check in CHECKS}


def git(*arguments):
    return subprocess.run(("git", *arguments), cwd=ROOT, capture_output=True, text=True)


def results():
    """Of docs/checks.md, by name."""
    rows = re.findall(r"^\| `([\w-]+)` \|.*\| (passed|FAILED) \| (\S+) \| `(\w+)` \| (\d+) \|$", PAGE.read_text(), re.M) if PAGE.exists() else []
    return {name: Result(word == "passed", date, commit, int(minutes)) for name, word, date, commit, minutes in rows}


def write(known):
    lines = [
        "# Heavy checks", "",
        "Checks that take too long for every change, and how each ended when it was last run. `.ci/nightly` runs them all and writes this page;",
        "`scripts/heavy_checks.py run NAME` runs one. `.ci/run` runs those whose inputs changed, as far as its hour suffices. Minutes are those of",
        "two processors.", "",
        "| check | what it proves | command | result | date | commit | minutes |", "|---|---|---|---|---|---|---:|"]
    for check in CHECKS:
        row = f"| `{check.name}` | {check.says} | `{check.command}` | "
        last = known.get(check.name)
        lines.append(row + (f"{'passed' if last.passed else 'FAILED'} | {last.date} | `{last.commit}` | {last.minutes} |" if last else "not yet | | | |"))
    PAGE.write_text("\n".join(lines) + "\n")


def run(check):
    print(f"\n==> {check.name}: {check.says}\n    {check.command}", flush=True)
    start = time.monotonic()
    passed = subprocess.run(check.command, shell=True, cwd=ROOT).returncode == 0
    minutes = max(1, round((time.monotonic() - start) / 60))
    print(f"{check.name}: {'passed' if passed else 'FAILED'} after {minutes} min", flush=True)
    commit = git("rev-parse", "--short=10", "HEAD").stdout.strip()
    return Result(passed, datetime.date.today().isoformat(), commit, minutes)


def changed(last, inputs):
    """Whether any of the inputs changed since that result; also if its commit is unknown here."""
    if last is None or not last.passed:
        return True
    return git("diff", "--quiet", last.commit, "HEAD", "--", *inputs).returncode != 0


def due(known):
    """Those to run, the most urgent first."""
    def age(check):
        last = known.get(check.name)
        return last.date if last else ""
    passed = [check for check in CHECKS if check.name in known and known[check.name].passed]
    urgent = [check for check in passed if changed(known.get(check.name), (check.command.split()[0], *check.inputs))]
    others = [check for check in passed if check not in urgent and changed(known.get(check.name), PROGRAM)]
    return sorted(urgent, key=age) + sorted(others, key=age)


def main(arguments):
    known = results()
    match arguments:
        case []:
            for check in CHECKS:
                last = known.get(check.name)
                ended = f"{'passed' if last.passed else 'FAILED'} {last.date} {last.commit}" if last else "not yet"
                print(f"{check.name:16} {last.minutes if last else check.minutes:3} min  {ended:28} {check.command}")
        case ["run", *names]:
            if wrong := [name for name in names if name not in by_name]:
                sys.exit(f"heavy_checks.py: found {wrong[0]}, expected one of {', '.join(by_name)}")
            failed = []
            for check in [by_name[name] for name in names] or CHECKS:
                result = run(check)
                write({**results(), check.name: result})  # another run may have written meanwhile
                failed += [] if result.passed else [check.name]
            sys.exit(f"failed: {', '.join(failed)}" if failed else 0)
        case ["due", minutes]:
            end, left = time.monotonic() + 60 * float(minutes), []
            for check in due(known):
                needs = known[check.name].minutes if check.name in known else check.minutes
                if time.monotonic() + 60 * needs > end:
                    left.append(f"{check.name} ({needs} min)")
                elif not run(check).passed:
                    sys.exit(f"failed: {check.name}")
            if left:
                print(f"\nNot run for lack of time, though what they look at changed: {', '.join(left)}. Run them by .ci/nightly.")
        case _:
            sys.exit(__doc__)


main(sys.argv[1:])
