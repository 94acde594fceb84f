"""What MkDocs does not do by itself: the pages' navigation, anchors for settings and commands, and links to them and to the
headers wherever a page names one as `code` or by its label in *italics*."""
import html, json, os, pathlib, posixpath, re
from mkdocs.utils import get_relative_url

TABLES = {"docs/settings.md": ("Name", "Setting", "Parameter"), "docs/commands.md": ("Id", "Command")}
names = {}   # text of code -> URL from the site's top
labels = {}  # text in italics -> the same


def rows(text):
    """(heading of the second level, heading of the third, cells by column's name) of each row of a page's tables."""
    part = section = head = None
    for line in text.splitlines():
        if line.startswith("#"):
            level, title = line.split(" ", 1)
            part, section = (title, title) if len(level) < 3 else (part, title)
            head = None
        elif line.startswith("|"):
            cells = [c.strip().strip("`") for c in re.split(r"(?<!\\)\|", line)[1:-1]]
            if head is None:
                head = cells
            elif not set(cells[0]) <= set("-: "):
                yield part, section, dict(zip(head, cells))


def anchor_of(page, part, row):
    name = row.get("Name") or row.get("Id")
    return f"type-{name}" if page == "docs/settings.md" and part == "Surface types" else name


def on_config(config):
    pages = pathlib.Path(config["docs_dir"])
    for page in TABLES:
        url = page.replace(".md", ".html")
        for part, section, row in rows((pages / page).read_text()):
            target = f"{url}#{anchor_of(page, part, row)}"
            name = row.get("Name") or row.get("Id")
            label = row.get("Setting") or row.get("Parameter") or row.get("Command")
            names.setdefault(name, target)
            labels.setdefault(label.rstrip("…"), target)
            if "Id" in row:
                labels.setdefault(" > ".join(section.split(", ") + [label.rstrip("…")]), target)
    for name, (page, anchor) in json.loads((pages / "names.json").read_text()).items():
        names.setdefault(name, f"{page}#{anchor}")

    shown = set(re.findall(r"[\w/.-]+\.md", str(config["nav"])))
    more = [f"docs/{p.name}" for p in sorted((pages / "docs").glob("*.md")) if f"docs/{p.name}" not in shown]
    if more:
        config["nav"].append({"More": more})
    modules = {}
    for path in sorted((pages / "slipface").glob("*/*.md")):
        names[f"slipface/{path.parent.name}/{path.stem}.h"] = f"slipface/{path.parent.name}/{path.stem}.html"
        modules.setdefault(path.parent.name, []).append({path.stem + ".h": f"slipface/{path.parent.name}/{path.name}"})
    config["nav"].append({"Headers": [{"All headers": "slipface/index.md"}] + [{m: f} for m, f in modules.items()]})
    config["nav"].append({"Licence": ["LICENSE.md", "NOTICES.md"]})


def on_files(files, config):
    """Of the images only those that a page shows."""
    pages = pathlib.Path(config["docs_dir"])
    wanted = {"docs/site/slipface.svg", "docs/site/style.css", "docs/site/offline_search.js"}
    wanted |= {f.src_path for f in files if f.src_path.startswith("docs/site/fonts/")}
    for file in files.documentation_pages():
        folder = posixpath.dirname(file.src_path)
        for image in re.findall(r"!\[[^\]]*\]\(([^)\s]+)", (pages / file.src_path).read_text()):
            wanted.add(posixpath.normpath(posixpath.join(folder, image)))
    for file in list(files):
        if not file.is_documentation_page() and file.src_path in wanted or \
                file.is_documentation_page() or file.src_path.startswith("assets/"):
            continue
        files.remove(file)
    return files


def on_page_markdown(text, page, config, files):
    """Links to files of the repository that are pages under another name here; lists inside lists, which Python's Markdown
    wants indented by four."""
    if page.file.src_path.startswith("slipface/"):
        return text  # written as it has to be
    parts = re.split(r"(^```.*?^```$)", text, flags=re.S | re.M)
    text = "".join(p if p.startswith("```") else re.sub(r"^ {2,3}(?=\S)", "    ", p, flags=re.M) for p in parts)
    text = re.sub(r"\]\(((?:\.\./)*)(LICENSE|NOTICES)\)", r"](\1\2.md)", text)
    return re.sub(r"\]\(((?:\.\./)*)engine/\w+/include/(slipface/\w+/\w+)\.h\)", r"](\1\2.md)", text)


def on_page_content(content, page, config, files):
    here = page.file.url
    if here == "index.html":
        page.meta["hide"] = ["navigation"]  # it has no neighbours
    source = page.file.src_path

    def to(url):
        return f"#{url.split('#')[1]}" if url.split("#")[0] == here else get_relative_url(url, here)

    if source in TABLES:
        content = give_anchors(content, source, config)

    def link(match):
        whole, tag, code, label, image = match.groups()
        if tag:
            return whole
        if image:
            return f'<a class="picture" href="{re.search("src=.([^ ]+).[ >/]", image)[1]}">{image}</a>'
        text = html.unescape(code or label)
        if code:
            call = re.fullmatch(r"(\w+)\(.*\)", text)
            url = names.get(text.split("=")[0]) or "_" in text and names.get(text + "()") or call and names.get(call[1] + "()")
            url = url or (text.startswith("docs/") and text.replace(".md", ".html")
                          if (pathlib.Path(config["docs_dir"]) / text).is_file() else None)
        else:
            url = labels.get(text.rstrip("…").replace("\n", " "))
        return f'<a class="to" href="{to(url)}">{whole}</a>' if url else whole

    pattern = r"(<(a|h[1-6]|pre)\b.*?</\2>|<code>([^<]+)</code>|<em>([^<]+)</em>|(<img [^>]*>))"
    content = re.sub(pattern, link, content, flags=re.S)
    # Several numbers in a cell stand in columns of their own.
    content = re.sub(r'<td style="text-align: right;">(?=[^<]*\S  )', '<td class="columns" style="text-align: right;">', content)
    # A page named in running text: docs/sweep.md.
    return re.sub(r"(?<![\w/\"`>])docs/([\w-]+)\.md(?![\w\"])",
                  lambda m: f'<a href="{to(f"docs/{m[1]}.html")}">{m[0]}</a>', content)


def give_anchors(content, source, config):
    """An id for each row, and for each cell its column's name, which narrow screens show beside it."""
    known = rows((pathlib.Path(config["docs_dir"]) / source).read_text())

    def row(match):
        part, _, cells = next(known)
        name, columns = anchor_of(source, part, cells), iter(cells)

        def cell(match):
            column, text = next(columns), match[1]
            if column in ("Name", "Id"):
                text = f'<a href="#{name}">{text}</a>'
            return f'<td data-column="{column}">{text}</td>'
        return f'<tr id="{name}">' + re.sub("<td>(.*?)</td>", cell, match[1], flags=re.S) + "</tr>"

    def body(match):
        return re.sub("<tr>(.*?)</tr>", row, match[0], flags=re.S)
    return re.sub("<tbody>.*?</tbody>", body, content, flags=re.S)


def on_post_build(config):
    """Each setting and command is found by itself, not only as part of its table."""
    index = pathlib.Path(config["site_dir"]) / "search" / "search_index.json"
    data = json.loads(index.read_text())
    pages = pathlib.Path(config["docs_dir"])
    for page in TABLES:
        for part, section, row in rows((pages / page).read_text()):
            label = row.get("Setting") or row.get("Parameter") or row.get("Command")
            name = row.get("Name") or row.get("Id")
            meaning = row.get("Meaning") or row.get("What it does")
            key = row.get("Shortcut")
            data["docs"].append({"location": page.replace(".md", ".html") + "#" + anchor_of(page, part, row),
                                 "title": f"{label} ({name})", "text": html.escape(meaning + (f" Key: {key}." if key else ""))})
    index.write_text(json.dumps(data))
    # The same for pages that are opened as files, where a page may load a script but not fetch JSON.
    index.with_name("search_index.js").write_text(f"take_search_index({json.dumps(data)})")
