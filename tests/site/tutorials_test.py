#!/usr/bin/env python3
"""Runs the tutorials word for word: what a page of docs/tutorials says to save is saved, what it says to run is run, and what it says
that comes out has to come out.

usage: tutorials_test.py PROGRAM SOURCE SCRATCH [BUILD]
       tutorials_test.py PACKAGE.tgz SOURCE SCRATCH       the pages that install the npm package, and these alone

In a page, a block after a sentence with "Save this as `NAME`" (or "Save it as") is a file; a block of `sh` is run in the page's folder, as
one script, and has to end with 0; a block of `text` right after it lists lines of its output, in this order, where … stands for anything.
Blocks of `cpp` that are no file are parts of tests/adding/hack.txt, and blocks without a language are formulas of docs/settings.md. With
BUILD, a finished build, the pages that need an installed engine run as well: it is installed into SCRATCH."""
import os, pathlib, re, shutil, subprocess, sys

program, source, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
build = pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
package = program if program.suffix == ".tgz" else None
failures = []


def blocks_of(page):
    """(language, text, the paragraph before) of each block."""
    before = ""
    for part in re.split(r"^(```.*?^```)$", page.read_text(), flags=re.S | re.M):
        if block := re.fullmatch(r"```(\w*)\n(.*?)```", part, re.S):
            yield block[1], block[2], before
            before = ""
        else:
            before = part.strip().split("\n\n")[-1]


def run(script, folder, environment):
    done = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def missing_line(wanted, output):
    """The first line that does not come out after the ones before it."""
    lines = iter(output.splitlines())
    for line in wanted.splitlines():
        pattern = ".*".join(map(re.escape, line.rstrip().split("…")))
        if line.strip() and not any(re.fullmatch(pattern, each.rstrip()) for each in lines):
            return line


def check(page, environment):
    folder = scratch / page.stem
    folder.mkdir()
    output, scripts = "", 0
    for language, text, before in blocks_of(page):
        name = re.search(r"[Ss]ave (?:this|it) as `([\w.-]+)`", before)
        if name:
            (folder / name[1]).write_text(text)
        elif language == "sh":
            code, output = run(text, folder, environment)
            scripts += 1
            if code != 0:
                failures.append(f"{page.name}: exit code {code} of\n{text}{output}")
        elif language == "text":
            if line := missing_line(text, output):
                failures.append(f"{page.name}: the line\n{line}\ndoes not come out, or not in its place, of\n{output}")
        elif not language:
            if f"`{text.strip()}`" not in formulas:
                failures.append(f"{page.name}: docs/settings.md has not the formula\n{text}")
        elif language == "cpp":
            hack = (source / "tests/adding/hack.txt").read_text()
            if text not in hack:
                failures.append(f"{page.name}: tests/adding/hack.txt has not\n{text}")
        else:
            failures.append(f"{page.name}: a block is neither a file nor a script nor its output:\n{text}")
    return scripts


formulas = (source / "docs/settings.md").read_text()
shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
(scratch / "bin").mkdir()
(scratch / "bin/python3").symlink_to(sys.executable)
environment = dict(os.environ, PATH=f"{scratch / 'bin'}:{program.parent}:{os.environ['PATH']}", XDG_STATE_HOME=str(scratch / "state"),
                   XDG_CONFIG_HOME=str(scratch / "config"))
if package:
    environment["SLIPFACE_NPM"] = str(package)
if build:
    prefix = scratch / "prefix"
    subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
    libraries = next(prefix.glob("**/pkgconfig")).parent
    modules = [str(path.parent) for path in build.glob("**/slipface*.so") if "python" in str(path)]
    environment |= {"PKG_CONFIG_PATH": str(libraries / "pkgconfig"), "LD_LIBRARY_PATH": str(libraries),
                    "PYTHONPATH": ":".join(modules)}
total = 0
for page in sorted((source / "docs/tutorials").glob("*.md")):
    needs = "npm package" if "npm install" in page.read_text() else "installed engine" if "pkg-config" in page.read_text() else ""
    if needs == "npm package" and not package or needs == "installed engine" and not build or package and needs != "npm package":
        if needs:
            print(f"{page.name} is left out: it needs the {needs}")
        continue
    scripts = check(page, environment)
    total += scripts
    print(f"{page.name}: {scripts} scripts")
for failure in failures:
    print(f"\nFAILED {failure}")
if total < (3 if package else 10):
    sys.exit(f"found {total} scripts in docs/tutorials, expected more")
sys.exit(1 if failures else 0)
