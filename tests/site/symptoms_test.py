#!/usr/bin/env python3
"""docs/symptoms.md names only what there is: settings and parameters with values in their range, menu entries and labels, demos and
pictures, and headlines that the program can print. Each of its sections has its parts. scripts/check_links.py follows its links.

usage: symptoms_test.py [SOURCE]

What there is comes from the tables (docs/settings.md and docs/commands.md, which tests hold against the program), the list of demos
in engine/scenes and the strings of the program."""
import pathlib, re, sys

source = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__ + "/../../..").resolve()
page = (source / "docs/symptoms.md").read_text()
failures = []


def rows(name):
    """The cells of each row of a page's tables, by column."""
    head = None
    for line in (source / name).read_text().splitlines():
        cells = [cell.strip().strip("`") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if not cells:
            head = None
        elif head is None:
            head = cells
        elif not set(cells[0]) <= set("-: "):
            yield dict(zip(head, cells))


settings, labels = {}, set()  # names -> range; what stands in italics
for row in rows("docs/settings.md"):
    if "Range" not in row:
        continue  # a table of something else, such as buttons
    settings.setdefault(row["Name"], []).append(row["Range"])
    labels.add(row.get("Setting") or row["Parameter"])
menu = ""
for line in (source / "docs/commands.md").read_text().splitlines():
    if line.startswith("## "):
        menu = line[3:].replace(", ", " > ")
    elif line.startswith("| ") and not line.startswith(("| Command", "| ---")):
        label = line.split("|")[1].strip().rstrip("…")
        labels |= {label, f"{menu} > {label}"}
strings = "\n".join(path.read_text() for folder in ("engine/sim", "engine/movement", "engine/doctor", "editor")
                    for path in (source / folder).rglob("*") if path.suffix in (".cpp", ".inc", ".h"))
strings = re.sub(r'"\s*\n\s*"', "", strings)
demos = set(re.findall(r'^    \{"([\w-]+)",\s+"\w+",', "".join(p.read_text() for p in (source / "engine/scenes").glob("demos_*.cpp")), re.M))
enums = {"step_form", "push_out", "leave_mode"}


def check(section, holds, text):
    if not holds:
        failures.append(f"{section}: {text}")


def check_value(section, name, value):
    ranges = settings[name]
    if value in ("on", "off"):
        return check(section, name == "push_out" or any(r in ("", "on, off") for r in ranges), f"`{name}` is no switch")
    if name in enums:
        return check(section, value in strings, f"`{name}` has no {value}")
    limits = [re.fullmatch(r"(\S+) to (\S+)", r) for r in ranges]
    check(section, any(m and float(m[1]) <= float(value) <= float(m[2]) for m in limits), f"`{name}={value}` is out of {ranges}")


def check_words(section, text):
    for code in re.findall(r"`([^`]+)`", text):
        if code.startswith("slipface "):
            verb = code.split()[1]
            check(section, (source / "docs/command-line.md").read_text().find(f"## slipface {verb}\n") > 0, f"there is no verb {verb}")
            continue
        name, _, value = code.partition("=")
        if re.fullmatch(r"[a-z_]+", name) and name in settings:
            if value:
                check_value(section, name, value)
        elif value or re.fullmatch(r"[a-z]+_[a-z_]+", code):
            check(section, code + "(" in strings or name in strings and not value, f"there is no `{code}`")
    for label in re.findall(r"(?<!\*)\*([^*]+)\*(?!\*)", text):
        label = " ".join(label.split())
        check(section, label in labels or f'"{label}"' in strings, f"there is no *{label}*")
    for quoted in re.findall(r'"([^"]+)"', text):
        for piece in re.split(r"…|[0-9.°%]+|\b(?:mm|m/s|m)\b|[():;,]", quoted):
            check(section, len(piece.strip()) < 6 or piece.strip() in strings, f'the program does not print "{piece.strip()}"')


intro, *sections = re.split(r"^### ", page, flags=re.M)
check_words("the beginning", intro)
for section in sections:
    title, body = section.split("\n", 1)
    body = re.split(r"^## ", body, flags=re.M)[0]
    picture = re.match(r"\n!\[[^\]]+\]\(\.\./(screenshots/[^)]+)\)\n\nAlso asked: ([^\n]+(?:\n[^\n]+)*\.)\n\n- \*\*Cause\*\*: ", body)
    check(title, picture is not None, "expected a picture, then \"Also asked\", then the cause")
    if picture:
        check(title, (source / picture[1]).exists(), f"there is no {picture[1]}")
    parts = dict(re.findall(r"^- \*\*(\w+)\*\*: (.*?)(?=^- |\Z)", body, re.S | re.M))
    check(title, list(parts) == ["Cause", "See", "Cure", "Demo"], f"its parts are {', '.join(parts)}")
    sentences = re.findall(r"[.!?](?=\s|$)", parts.get("Cause", ""))
    check(title, len(sentences) == 2, f"the cause has {len(sentences)} sentences, expected 2")
    check(title, len(re.findall(r"(?<!\*)\*[^*]+\*(?!\*)", parts.get("See", ""))) <= 4, "more than three clicks and what they show")
    demo = re.match(r"\[([\w-]+)\]\(([^)]+)\)", parts.get("Demo", ""))
    check(title, demo and demo[1] in demos, f"there is no demo {demo[1] if demo else parts.get('Demo')}")
    check_words(title, body.replace(picture[0], "") if picture else body)

# What Why and the doctor lead to.
titles = {section.split("\n", 1)[0] for section in sections}
headlines = (source / "engine/sim/stop_headline.cpp").read_text()
linked = re.findall(r'^    \{"[\w ]+", "([^"]+)"\}', headlines, re.M) + [
    title for line in re.findall(r"stop\.symptom = (.*?);", headlines) for title in re.findall(r'"([^"]+)"', line)] + re.findall(
    r'"([^"]+)"\},\n', (source / "engine/doctor/doctor.cpp").read_text().split("};\nstatic_assert")[0])
check("the program", len(linked) >= 17 + 12 + 11, f"{len(linked)} causes and problems lead here")
for title in linked:
    check("the program", title in titles, f'"{title}" is no section of the page')

check("the page", len(sections) >= 60, f"{len(sections)} sections, expected 60")
check("the tables", len(settings) > 40 and len(labels) > 200 and len(demos) > 20, "too few settings, commands or demos were found")
for failure in failures:
    print(failure)
print(f"{len(sections)} symptoms, {len(failures)} failures")
sys.exit(1 if failures else 0)
