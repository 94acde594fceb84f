#!/usr/bin/env python3
"""Mutation testing of the floors movement and level: are there changes of the code that no test notices?

Draws changes of one operator, number or statement by a seed, compiles each changed file beside the real one (nothing under
engine/ is touched), links it into the tests and runs them, own floor first, until one fails. A change that does not compile, or
that gives the same object file, is not counted. The survivors go into a table.

    scripts/mutate.py                          # 50 mutants, into build/mutants/survivors.md
    scripts/mutate.py --seed 7 --count 25 --out other.md
    scripts/mutate.py --survivors              # those that survived the last run of this seed, again
    scripts/mutate.py --tests movement,level   # quicker: 20 minutes
"""
import argparse, collections, concurrent.futures, json, pathlib, random, re, resource, shlex, signal, subprocess, sys, threading

TOP = pathlib.Path(__file__).resolve().parent.parent
SOURCES = {"movement": "engine/movement/**/*.cpp", "level": "engine/level/*.cpp"}
TESTS = {"movement": ["movement", "world", "level", "sim", "scenes", "repair", "doctor", "reach", "levels"],
         "level": ["level", "world", "sim", "doctor", "exchange", "levels", "scenes", "repair", "reach"]}
QUICK_MS = 50  # tests shorter than this run first
SWAPS = [(r" (<=) ", ["<", ">"]), (r" (>=) ", [">", "<"]), (r" (==) ", ["!="]), (r" (!=) ", ["=="]),
         (r"(?<!template) (<)\s", ["<=", ">="]), (r" (>) ", [">=", "<="]),
         (r" (\+)\s", ["-"]), (r" (-)\s", ["+"]), (r" (\*)\s", ["/"]), (r" (/)\s", ["*"]),
         (r" (\+)= ", ["-"]), (r" (-)= ", ["+"]), (r" (\*)= ", ["/"]), (r" (/)= ", ["*"]),
         (r" (&&)\s", ["||"]), (r" (\|\|)\s", ["&&"]), (r"(!)[\w(]", [""]), (r"[(,=?:{] ?(-)[\w(]|return (-)[\w(]", [""]),
         (r"\b(true)\b", ["false"]), (r"\b(false)\b", ["true"]),
         (r"std::(min)\b", ["max"]), (r"std::(max)\b", ["min"]), (r"std::(floor)\b", ["ceil"]), (r"std::(ceil)\b", ["floor"])]
NUMBER = re.compile(r"(?<![\w.])(\d[\d']*\.\d+(?:e[-+]?\d+)?|\d+e[-+]?\d+|0x[\da-fA-F']+|\d[\d']*)([uUlLfz]*)(?![\w.])")
# A whole statement on one line, or a whole `if` with its statement.
STATEMENT = re.compile(r"^( +)((?:if \(.*\) )?(?!return [^;]|using |const |static )(?:[\w:<>*&.\[\]()+-].*));$")


def code_only(text):
    """The text with comments, strings, characters, preprocessor lines and assertions blanked, of the same length."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    parts = r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\''
    text = re.sub(parts, blank, text, flags=re.S)
    return re.sub(r"^ *(#|static_assert|assert).*$", blank, text, flags=re.M)


def changes_of(path):
    """All (offset, old, new) of a file."""
    code, found = code_only(path.read_text()), []
    for pattern, replacements in SWAPS:
        for match in re.finditer(pattern, code):
            group = next(i for i in range(1, len(match.groups()) + 1) if match.group(i))
            found += [(match.start(group), match.group(group), new) for new in replacements]
    for match in NUMBER.finditer(code):
        digits, suffix = match.group(1), match.group(2)
        decimal = "." in digits or ("e" in digits and "x" not in digits)
        zero = not re.search(r"[1-9a-fA-F]", digits.split("e")[0] if decimal else digits)
        one, none = ("1.0", "0.0") if decimal else ("1", "0")
        new = [one + suffix] if zero else [none + suffix, f"({match.group()} + {one}{suffix})"]
        found += [(match.start(), match.group(), text) for text in new]
    before = "{"
    for match in re.finditer(r"^.*$", code, flags=re.M):
        line = match.group().rstrip()
        statement = STATEMENT.match(line)
        if statement and before[-1] in "{};:" and line.count("(") == line.count(")") and line.count("{") == line.count("}"):
            found.append((match.start() + len(statement.group(1)), statement.group(2), ""))
        before = line.strip() or before
    return sorted(set(found))


def shell(command, cwd):
    return subprocess.run(command, shell=isinstance(command, str), cwd=cwd, capture_output=True, text=True)


class Bench:
    """Compiles, links and runs mutants, each worker in a folder of its own."""

    def __init__(self, build, names):
        self.build, self.names, self.durations, self.lock = build, names, {}, threading.Lock()
        rows = json.loads((build / "compile_commands.json").read_text())
        self.command = {row["file"]: row["command"] for row in rows}
        self.worker = threading.local()

    @property
    def work(self):
        if not hasattr(self.worker, "folder"):
            self.worker.folder = self.build / "mutants" / str(threading.get_ident())
            self.worker.folder.mkdir(parents=True, exist_ok=True)
        return self.worker.folder

    def object_file(self, path):
        return self.work / (path.name + ".o")

    def compile(self, path, text):
        """Why it does not count, or None; then its object file is there."""
        source = self.work / path.name
        source.write_text(text)
        words = shlex.split(self.command[str(path)])
        built = self.build / words[words.index("-o") + 1]
        words[words.index("-o") + 1], words[words.index("-c") + 1] = str(self.object_file(path)), str(source)
        if shell([*words, "-w", "-iquote", str(path.parent)], self.build).returncode != 0:
            return "does not compile"
        return "same object" if self.object_file(path).read_bytes() == built.read_bytes() else None

    def link(self, tests, path):
        """Own objects come before libraries, so the library's copy of the changed file is never looked for."""
        last = shell(["ninja", "-t", "commands", f"tests_{tests}"], self.build).stdout.strip().splitlines()[-1]
        command = re.sub(rf" -o tests/tests_{tests} ", f" {self.object_file(path)} -o {self.work / 'tests'} ", last)
        return shell(command, self.build).returncode == 0

    def run(self, program, chosen, seconds):
        """None, or which test failed. The limits are of processor time, because other work may slow the machine down."""
        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
            resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
            resource.setrlimit(resource.RLIMIT_FSIZE, (200 << 20, 200 << 20))
        log, why = self.work / "log", ""
        with open(log, "wb") as out:
            try:
                code = subprocess.run([program, "--gtest_fail_fast", "--gtest_filter=" + ":".join(chosen)], cwd=self.work,
                                      stdout=out, stderr=out, timeout=6 * seconds, preexec_fn=limit).returncode
            except subprocess.TimeoutExpired:
                code = -signal.SIGXCPU
        if code == 0:
            return None
        if code < 0:
            why = " (hang)" if code == -signal.SIGXCPU else " (crash)"
        output = log.read_text(errors="replace")
        failed = re.search(r"\[  FAILED  \] ([^\s,]+)", output)
        begun = re.findall(r"\[ RUN      \] (\S+)", output)
        return (failed.group(1) if failed else begun[-1] if begun else "the program's start") + why

    def kill(self, floor, path):
        for tests in [name for name in TESTS[floor] if name in self.names]:
            program = self.build / "tests" / f"tests_{tests}"
            with self.lock:
                if tests not in self.durations:
                    self.run_unchanged(tests, program)
            if not self.link(tests, path):
                return "does not link"
            times = self.durations[tests]
            quick = [name for name, ms in times.items() if ms < QUICK_MS]
            slow = sorted((name for name in times if name not in quick), key=times.get)
            for chosen in (quick, slow):
                failed = chosen and self.run(self.work / "tests", chosen, int(10 + 4e-3 * sum(times[n] for n in chosen)))
                if failed:
                    return f"{tests}: {failed}"
        return None

    def run_unchanged(self, tests, program):
        """How long each test takes; those that fail without any change are left out."""
        report = self.work / f"{tests}.json"
        shell([program, f"--gtest_output=json:{report}"], self.work)
        rows = [(f"{suite['name']}.{test['name']}", test) for suite in json.loads(report.read_text())["testsuites"]
                for test in suite["testsuite"]]
        for name, test in rows:
            if "failures" in test:
                print(f"left out, fails unchanged: {name}", file=sys.stderr)
        self.durations[tests] = {name: 1e3 * float(test["time"].rstrip("s")) for name, test in rows if "failures" not in test}


def draw(seed):
    """Every change of both floors in the seed's order."""
    drawn = [(floor, path.relative_to(TOP).as_posix(), *change) for floor, glob in SOURCES.items()
             for path in sorted(TOP.glob(glob)) for change in changes_of(path)]
    random.Random(seed).shuffle(drawn)
    return drawn


def row_of(number, mutant):
    file, line, old, new = mutant["file"], mutant["line"], mutant["before"], mutant["after"]
    cell = lambda text: "`" + text.replace("|", "\\|") + "`"
    return f"| {number} | {file}:{line} | {cell(old)} | {cell(new) if new else 'removed'} | {mutant['killed'] or '**survived**'} |"


def table(mutants, seed, candidates):
    killed = sum(bool(m["killed"]) for m in mutants)
    rows = [row_of(i + 1, m) for i, m in enumerate(mutants) if not m["killed"]]
    return (f"Seed {seed}: {killed} of {len(mutants)} killed, drawn from {candidates} changes. The others:\n\n"
            "| | where | line | becomes | killed by |\n|---|---|---|---|---|\n" + "\n".join(rows) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=20261123)
    parser.add_argument("--build", type=pathlib.Path, default=TOP / "build/mutants")
    parser.add_argument("--out", type=pathlib.Path, help="for the table; BUILD/survivors.md if it is not given")
    parser.add_argument("--survivors", action="store_true", help="what was killed in the last run is not run again")
    parser.add_argument("--resume", action="store_true", help="what the last run came to is not run again")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--tests", default=",".join(sorted(set(sum(TESTS.values(), [])))), help="test programs, of %(default)s")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    if not (build / "build.ninja").exists():
        subprocess.run(["cmake", "-S", TOP, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DSLIPFACE_PCH=ON", "-DSLIPFACE_EDITOR=OFF"], check=True)
    names = arguments.tests.split(",")
    subprocess.run(["cmake", "--build", build, "-j", str(arguments.jobs), "--target", *[f"tests_{name}" for name in names]],
                   check=True, stdout=subprocess.DEVNULL)
    bench, results = Bench(build, names), build / f"mutants-{arguments.seed}.json"
    drawn, mutants = draw(arguments.seed), []
    earlier = json.loads(results.read_text()) if arguments.survivors or arguments.resume else []

    def judge(floor, file, offset, old, new):
        path = TOP / file
        text = path.read_text()
        changed = text[:offset] + new + text[offset + len(old):]
        line = text.count("\n", 0, offset)
        before, after = text.splitlines()[line].strip(), changed.splitlines()[line].strip()
        mutant = {"file": file, "line": line + 1, "before": before, "after": "" if after == ";" else after}
        known = [m for m in earlier if all(m[key] == mutant[key] for key in mutant)]
        if known and (arguments.resume or known[0]["killed"]):
            return known[0]
        if why := bench.compile(path, changed):
            return mutant | {"why": why}
        return mutant | {"killed": bench.kill(floor, path)}

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        drawn_next, waiting = iter(drawn), collections.deque()
        while len(mutants) < arguments.count:
            while len(waiting) <= arguments.jobs and (change := next(drawn_next, None)):
                waiting.append(pool.submit(judge, *change))
            if not waiting:
                break
            mutant = waiting.popleft().result()
            if "why" not in mutant:
                mutants.append(mutant)
                results.write_text(json.dumps(mutants, indent=1))
                print(row_of(len(mutants), mutant), flush=True)
            else:
                print(f"not counted ({mutant['why']}): {mutant['file']}:{mutant['line']}: {mutant['after'] or 'removed'}", flush=True)
        for late in waiting:
            late.cancel()
    report = table(mutants, arguments.seed, len(drawn))
    (arguments.out or build / "survivors.md").write_text(report)
    print(report.splitlines()[0])


if __name__ == "__main__":
    main()
