#!/usr/bin/env python3
"""Holds CONTRIBUTING's lists of places, "Adding things", against the code: adds a hack, a parameter of surface types and a value of
an enum setting to a copy of the source, at the places that the lists name and at no others, builds what depends on them, runs the
tests that follow from the tables, and removes them.

hack.txt, parameter.txt and choice.txt have one edit for each place: "@@" and a file, what stands there (nothing for a new file),
"====", and what replaces it.

usage: check.py SOURCE BUILD SCRATCH COMPILER"""

import pathlib
import re
import shutil
import subprocess
import sys

LISTS = (("A hack", "hack.txt", 8), ("A parameter of surface types", "parameter.txt", 3), ("A value of an enum setting", "choice.txt", 2))
BATCH = 8  # files that are compiled at a time, as in the build

source, build, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
compiler = sys.argv[4]


def places_of(title):
    """Of each numbered line below the title the first name in backquotes."""
    section = re.search(rf"^- \*\*{title}\*\*.*?(?=^- )", (source / "CONTRIBUTING.md").read_text(), re.S | re.M)
    return re.findall(r"^  \d\. `([^`]+)`", section[0] if section else "", re.M)


def edits_of(name):
    """(file, what stands there, what replaces it)"""
    for part in re.split(r"^@@ ", (source / "tests/adding" / name).read_text(), flags=re.M)[1:]:
        file, text = part.split("\n", 1)
        before, after = re.split(r"^====\n", text, flags=re.M)
        yield file, before, after


def edits_at_places(title, name, most):
    places = places_of(title)
    if not 0 < len(places) <= most:
        sys.exit(f'CONTRIBUTING.md, "{title}": found {len(places)} places, expected 1 to {most}')
    left, edits = list(edits_of(name)), []
    for place in places:
        here = [edit for edit in left if pathlib.PurePath(edit[0]).match(place.replace("NAME", "*"))]
        if len(here) > 1:
            sys.exit(f"{name} has several edits for one place: " + ", ".join(file for file, *_ in here))
        left = [edit for edit in left if edit not in here]
        edits += here
    return edits


def add(name, before, after):
    path = copy / name
    text = path.read_text() if before else ""
    if before and text.count(before) != 1:
        sys.exit(f"{name} has this {text.count(before)} times, expected once:\n{before}")
    path.write_text(text.replace(before, after) if before else after)


def remove(name, before, after):
    if not before:
        return (copy / name).unlink()
    (copy / name).write_text((copy / name).read_text().replace(after, before))


def compile_batch(files, name):
    unit = scratch / f"{name}.cpp"
    unit.write_text("".join(f'#include "{file}"\n' for file in files))
    command = [compiler, "-std=c++20", "-O0", "-w", f'-DSLIPFACE_SOURCE_DIR="{copy}"', "-isystem", "/usr/include/eigen3",
               *(f"-I{folder}" for folder in includes), "-c", str(unit), "-o", str(unit.with_suffix(".o"))]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0 and len(files) > 1:  # two files have a name of their own in common
        return [one for i, file in enumerate(files) for one in compile_batch([file], f"{name}_{i}")]
    if done.returncode != 0:
        sys.exit(f"The lists miss a place. With the edits at those that they name, {files[0]} does not compile:\n{done.stderr}")
    return [str(unit.with_suffix(".o"))]


def same_files(a, b):
    list_of = lambda top: sorted(path.relative_to(top) for folder in copied for path in (top / folder).rglob("*") if path.is_file())
    return list_of(a) == list_of(b) and all((a / name).read_bytes() == (b / name).read_bytes() for name in list_of(a))


done = [edit for row in LISTS for edit in edits_at_places(*row)]

shutil.rmtree(scratch, ignore_errors=True)
copy = scratch / "copy"
copied = ["engine/movement", "engine/scenes", "docs"]
for folder in copied:
    shutil.copytree(source / folder, copy / folder)
for edit in done:
    add(*edit)

includes = [copy / f"engine/{name}/include" for name in ("movement", "scenes")]
includes += [copy / f"engine/{name}" for name in ("movement", "scenes")]
includes += [source / f"engine/{name}/include" for name in ("base", "mesh", "image", "view", "collision", "level", "sim")]
includes += [source / name for name in ("engine/level", "engine/sim", "editor", "tests")]

# What holds settings or states by value; of the upper floors only what a demo's run, its story and presets need.
old = sorted((source / "engine/movement").rglob("*.cpp"))
files = [[copy / path.relative_to(source) for path in old[i:i + BATCH]] for i in range(0, len(old), BATCH)]
files += [[path] for path in (copy / "engine/movement").rglob("*.cpp") if not (source / path.relative_to(copy)).exists()]
files += [sorted((copy / "engine/scenes").glob("demo*.cpp")) + [copy / "engine/scenes/shapes.cpp"]]
files += [[source / f"engine/level/{name}.cpp" for name in
           ("level", "level_scene", "material_name", "platform", "preset", "props", "shown_mesh", "terrain", "json_movement", "json_parts",
            "json_reader", "json_text")]]
files += [[source / f"engine/sim/{name}.cpp" for name in ("simulate", "run", "tape", "story", "story_words", "lecture_mover")]]
files += [[source / "editor/tools/commands/settings_docs.cpp"]]
files += [[source / "tests/movement/tst_settings.cpp"],
          [source / "tests/scenes/tst_demo_traces.cpp", source / "tests/adding/check.cpp"]]
objects = [one for i, batch in enumerate(files) for one in compile_batch(batch, f"unit_{i}")]
libraries = [str(build / f"engine/{name}/libslipface_{name}.a") for name in ("collision", "image", "mesh", "view", "base")]
program = scratch / "adding"
link = subprocess.run([compiler, *objects, "-o", str(program), "-Wl,--start-group", *libraries, "-Wl,--end-group", "-lgtest",
                       "-lgtest_main", "-lgmock", "-lfmt", "-lassimp", "-ltbb", "-ldeflate", "-lstb",
                       "-lwebp", "-ldraco", "-lmeshoptimizer"], capture_output=True, text=True)
if link.returncode != 0:
    sys.exit(f"The lists miss a place. With the edits at those that they name, the program does not link:\n{link.stderr}")
if subprocess.run([str(program), "--gtest_brief=1", "--gtest_filter=SettingsTable.*:Added*:*second_jump"], cwd=scratch).returncode != 0:
    sys.exit("The lists miss a place: see the test above.")

for edit in done:
    remove(*edit)
if not same_files(copy, source):
    sys.exit("The edits were removed, but the copy of the source is not as before.")
print("; ".join(f"{title}: {len(places_of(title))} places" for title, *_ in LISTS))
