#!/usr/bin/env python3
"""Includes only downward: compares docs/design.md, the CMake files and the includes of engine/ and editor/.

An engine module's floor in docs/design.md is above those of the modules that it depends on in CMake. The editor's parts stand in
the table in the order of their floors. A file includes only its own module and those that CMake links to it; the parts that say so
link neither ImGui nor OpenGL. And no two files define a type of the same name: the linker keeps one of both types' inline
functions, and what used the other one goes wrong without a warning. Nothing asks which operating system it is compiled for, and what
is built for Windows includes a system's own headers in engine/base/platform alone. Of std::ranges' algorithms only those of web/stand_ins are
used, because the page's C++ library lacks them and its build takes too long for every change.
"""
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

root = Path(__file__).resolve().parent.parent
bad = []
design = (root / "docs/design.md").read_text().split("## Modules")[1].split("\n## ")[0]
floors = {name: int(floor) for floor, name in re.findall(r"^\| (\d+) \| `(\w+)` \|", design, re.M)}
parts = re.findall(r"^\| `(\w+)` \| (.*) \|$", design, re.M)

depends = {}  # "engine/level" or "editor/tools" -> what CMake links, in the same form
for file in sorted(root.glob("engine/*/CMakeLists.txt")):
    # The interfaces for other languages are libraries of their own kind; of theirs counts what they link.
    call = re.search(r"slipface_module\((\w+)(.*)\)", file.read_text()) or re.search(
        r"target_link_libraries\(slipface_(\w+) PRIVATE(.*)\)", file.read_text())
    depends["engine/" + call[1]] = {"engine/" + name for name in re.findall(r"Slipface::(\w+)", call[2])}
cmake = (root / "editor/CMakeLists.txt").read_text() + (root / "editor/cli/CMakeLists.txt").read_text()
for name, _ in parts:
    own = f"slipface_(?:editor_)?{name}"
    calls = re.findall(rf"(?:slipface_editor_part\({name}\b|target_link_libraries\({own}\b)([^)]*)\)", cmake)
    words = " ".join(calls)
    depends["editor/" + name] = {"engine/" + other for other in re.findall(r"Slipface::(\w+)", words)} | {
        "editor/" + other for other in re.findall(r"slipface_editor_(\w+)", words)} | {
        library for library in ("IMGUI_LIBRARY",) if library in words}

for module in (name for name in depends if name.startswith("engine/")):
    name = module.split("/")[1]
    if name not in floors:
        bad.append(f"docs/design.md: no row for the module {name}")
        continue
    for other in sorted(depends[module]):
        below = floors.get(other.split("/")[1])  # None: a library from elsewhere
        if below is not None and below >= floors[name]:
            bad.append(f"{module}/CMakeLists.txt: floor {floors[name]} depends on {other}, floor {below}")
order = ["editor/" + name for name, _ in parts]
for index, part in enumerate(order):
    for other in sorted(depends[part] & set(order[index + 1:])):
        bad.append(f"editor/CMakeLists.txt: {part} depends on {other}, which docs/design.md lists above it")


def closure(name, seen):
    for other in depends.get(name, ()):
        if other not in seen:
            seen.add(other)
            closure(other, seen)
    return seen


def types_of(text):
    """The types that a formatted file defines, as namespace::name, without those of anonymous namespaces."""
    spaces = []
    for line in text.splitlines():
        if opened := re.match(r"(?:inline )?namespace ([\w:]*) ?{$", line):
            spaces.append(opened[1])
        elif re.match(r"}  // namespace", line) and spaces:
            spaces.pop()
        elif "" not in spaces and (named := re.match(r"(?:struct|class|union) (\w+)(?: final)?(?: :.*)? {", line)):
            yield "::".join([*spaces, named[1]])


below = {name: closure(name, {name}) for name in depends}
for name, text in parts:
    promised = {"IMGUI_LIBRARY", "engine/render"} if "ImGui nor OpenGL" in text else \
        {"engine/render"} if "No OpenGL" in text else set()
    for library in sorted(promised & below["editor/" + name]):
        bad.append(f"editor/CMakeLists.txt: {name} links {library}, which docs/design.md excludes")
sources = subprocess.check_output(["git", "ls-files", "engine/*.h", "engine/*.cpp", "editor/*.h", "editor/*.cpp"],
                                  cwd=root, text=True).split()
stand_ins = set(re.findall(r"^(?:auto|void) (\w+)\(", (root / "web/stand_ins/algorithm").read_text(), re.M))
of_one_system = r"^#include <(?:sys/\w+|unistd|fcntl|io|windows|shellapi|signal|spawn|poll|dlfcn|pwd|dirent|process|direct)\.h>"
only_on_linux = ("engine/render/", "engine/python/", "engine/mesh/assimp/", "editor/")  # but for the command line
defined = defaultdict(set)  # type -> the files that define it
for source in sources:
    module = "/".join(source.split("/")[:2])
    if not (root / source).exists():
        continue
    text = (root / source).read_text()
    for name in types_of(text):
        defined[name].add(source)
    for name in sorted(set(re.findall(r"std::ranges::(\w+)\(", text)) - stand_ins):
        bad.append(f"{source}: std::ranges::{name} is not in web/stand_ins/algorithm")
    if re.search(r"^#.*\b(_WIN32|__linux__|__APPLE__|__unix__|__MINGW\w*|_MSC_VER|__EMSCRIPTEN__)\b", text, re.M):
        bad.append(f"{source}: asks which system it is compiled for; what differs is in engine/base/platform, in a file for each")
    if re.search(of_one_system, text, re.M) and not source.startswith("engine/base/platform/") and (
            source.startswith("editor/cli/") or not source.startswith(only_on_linux)):
        bad.append(f"{source}: includes a header of one operating system; engine/base/platform has the place for it")
    if module not in depends:
        continue  # editor/main.cpp links everything
    for include in re.findall(r'^#include "([^"]+)"', text, re.M):
        first, second = (include.split("/") + ["", ""])[:2]
        other = "engine/" + second if first == "slipface" else "editor/" + first
        if other in depends and other not in below[module]:
            bad.append(f"{source}: includes {include}, but {module} does not link {other}")
bad += [f"{' and '.join(sorted(files))}: both define {name}" for name, files in sorted(defined.items()) if len(files) > 1]
print("\n".join(bad))
sys.exit(1 if bad else 0)
