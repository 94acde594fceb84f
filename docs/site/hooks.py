"""What MkDocs does not do by itself: the pages' navigation, anchors for settings and commands, and links to them and to the
headers wherever a page names one as `code` or by its label in *italics*."""
import collections, html, json, pathlib, posixpath, re
from mkdocs.exceptions import PluginError
from mkdocs.utils import get_relative_url

# A row of the tables of settings and commands; menu: the heading above it; cells: by column.
Row = collections.namedtuple("Row", "name label menu anchor cells")
tables = {"docs/settings.md": [], "docs/commands.md": []}
names = {}   # what stands as code -> URL from the site's top
labels = {}  # what stands in italics -> the same
# How much a section counts in a search, by the beginning of its address: pages for users before overviews, records and headers.
weights = [("docs/symptoms.html", 1.15), ("index.html", 0.85), ("CHANGELOG", 0.4), ("docs/checks", 0.4), ("docs/performance-", 0.5),
           ("docs/course-table", 0.5), ("docs/measurements", 0.5), ("docs/settings.html#", 0.7), ("docs/commands.html#", 0.9), ("docs/decisions", 0.7),
           ("docs/design", 0.75), ("docs/scripting", 0.8), ("docs/movement.html#", 0.95), ("NOTICES", 0.4), ("slipface/", 0.25), ("", 1.0)]


def read_rows(path):
    part = menu = head = None
    for line in path.read_text().splitlines():
        if line.startswith("#"):
            level, menu = line.split(" ", 1)
            part = menu if len(level) == 2 else part
            head = None
        elif line.startswith("|"):
            cells = [c.strip().strip("`") for c in re.split(r"(?<!\\)\|", line)[1:-1]]
            if head is None:
                head = cells
            elif not set(cells[0]) <= set("-: "):
                cells = dict(zip(head, cells))
                name, label = cells.get("Name") or cells["Id"], cells[head[0]].rstrip("…")
                anchor = f"type-{name}" if part == "Surface types" else name  # both have a max_slope
                yield Row(name, label, menu.replace(", ", " > "), anchor, cells)


def on_config(config):
    pages = pathlib.Path(config["docs_dir"])
    for page in tables:
        tables[page] = list(read_rows(pages / page))
        if not tables[page]:
            raise PluginError(f"{page} has no table of names")
        for row in tables[page]:
            target = page.replace(".md", ".html#") + row.anchor
            names.setdefault(row.name, target)
            labels.setdefault(row.label, target)
            labels.setdefault(f"{row.menu} > {row.label}", target)
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
    """Of the images and other files only those that a page shows or links to."""
    pages = pathlib.Path(config["docs_dir"])
    wanted = {f.src_path for f in files if f.src_path.startswith("docs/site/")}
    for file in files.documentation_pages():
        folder = posixpath.dirname(file.src_path)
        for image in re.findall(r"\]\(([^)\s#]+)", (pages / file.src_path).read_text()):
            wanted.add(posixpath.normpath(posixpath.join(folder, image)))
    wanted |= {path.replace(".webm", ".jpg") for path in wanted if path.endswith(".webm")}  # shown until the film begins
    for file in list(files):
        if not (file.is_documentation_page() or file.src_path in wanted or file.src_path.startswith("assets/")):
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

    table_urls = {page.replace(".md", ".html#") + row.anchor for page, rows in tables.items() for row in rows}

    def to(url):
        return f"#{url.split('#')[1]}" if url.split("#")[0] == here else get_relative_url(url, here)

    if page.file.src_path in tables:
        content = give_anchors(content, tables[page.file.src_path])

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
            if re.fullmatch(r"docs/[\w-]+\.md", text):
                url = text.replace(".md", ".html")
        else:
            url = labels.get(text.rstrip("…").replace("\n", " "))
        if here.startswith("slipface/") and url in table_urls:
            url = None  # a header's `velocity` is a member
        return f'<a class="to" href="{to(url)}">{whole}</a>' if url else whole

    pattern = r"(<(a|h[1-6]|pre)\b.*?</\2>|<code>([^<]+)</code>|<em>([^<]+)</em>|(<img [^>]*>))"
    content = re.sub(pattern, link, content, flags=re.S)
    # Python's Markdown leaves the backslash that keeps a | inside a cell.
    content = re.sub(r"<code>[^<]*</code>", lambda m: m[0].replace("\\|", "|"), content)
    # Several numbers in a cell stand in columns of their own.
    content = re.sub(r'<td style="text-align: right;">(?=[^<]*\S  )', '<td class="columns" style="text-align: right;">', content)
    # A link to a film has the film above it.
    content = re.sub(r'(<p>(?:(?!</p>).)*?<a href="([^"]+)\.webm">)',
                     r'<video class="film" controls muted loop preload="none" poster="\2.jpg" src="\2.webm"></video>\n\1', content, flags=re.S)
    if page.file.src_path == "docs/symptoms.md":
        content = f'<div class="symptoms">{content}</div>'
    # A page named in running text: docs/sweep.md.
    return re.sub(r"(?<![\w/\"`>])docs/([\w-]+)\.md(?![\w\"])",
                  lambda m: f'<a href="{to(f"docs/{m[1]}.html")}">{m[0]}</a>', content)


def give_anchors(content, rows):
    """An id for each row, and for each cell its column's name, which narrow screens show beside it."""
    rows = iter(rows)

    def row(match):
        known = next(rows)
        columns = iter(known.cells)

        def cell(match):
            column, text = next(columns), match[1]
            if column in ("Name", "Id"):
                text = f'<a href="#{known.anchor}">{text}</a>'
            return f'<td data-column="{column}">{text}</td>'
        text = re.sub("<td>(.*?)</td>", cell, match[1], flags=re.S)
        # A switch has no limits: its meaning takes their columns.
        text = re.sub(r'<td data-column="Meaning">(.*?)</td>\s*(<td data-column="Too \w+"></td>\s*){2}',
                      r'<td data-column="Meaning" colspan="3">\1</td>', text, flags=re.S)
        return f'<tr id="{known.anchor}">{text}</tr>'

    def body(match):
        return re.sub("<tr>(.*?)</tr>", row, match[0], flags=re.S)
    return re.sub("<tbody>.*?</tbody>", body, content, flags=re.S)


def plain(text):
    """The text of a piece of HTML."""
    return html.unescape(re.sub(r"<[^>]*>", " ", text))


def weight_of(location):
    return next(weight for start, weight in weights if location.startswith(start))


def read_asked(config):
    """[address, wordings] of each line of asked.txt."""
    for line in (pathlib.Path(config["config_file_path"]).parent / "asked.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            place, wordings = line.split(": ", 1)
            page, hash_sign, anchor = place.partition("#")
            yield (page if page == "index" or page.isupper() else f"docs/{page}") + ".html" + hash_sign + anchor, wordings


def on_post_build(config):
    """The index of docs/site/search.js: each section, setting and command once, as plain text."""
    index = pathlib.Path(config["site_dir"]) / "search" / "search_index.json"
    data = json.loads(index.read_text())
    as_html = type(config["plugins"]["search"]).__module__.startswith("material")  # 9 and later keep the marks of the text
    clean = plain if as_html else html.unescape
    pages, sections = {}, []
    for entry in data["docs"]:
        page, _, anchor = entry["location"].partition("#")
        title, text = (" ".join(clean(entry[part]).replace("¶", " ").split()) for part in ("title", "text"))
        text = re.sub(r" (?=[,.:;!?])", "", text)
        if not anchor:
            pages[page] = {"location": page, "title": title, "text": text, "first": True}
            sections.append(pages[page])
        elif pages[page].pop("first", False):  # the text below the page's own heading, instead of all of the page's
            pages[page] |= {"title": title, "text": text, "page": pages[page]["title"]}
        else:
            sections.append({"location": entry["location"], "title": title, "page": pages[page].get("page", pages[page]["title"]), "text": text})
    for section in sections:
        section.pop("first", None)
        section["weight"] = weight_of(section["location"])
        if asked := re.search(r"Also asked: (.*?\.)(?: |$)", section["text"]):
            section["asked"], section["text"] = asked[1], section["text"].replace(asked[0], "")
    # A table of settings or commands is found by its rows alone.
    of_tables = {page.replace(".md", ".html") for page in tables}
    sections = [section for section in sections if section["location"].split("#")[0] not in of_tables or section["location"] in of_tables]
    settings = {row.name for row in tables["docs/settings.md"]}
    for page, rows in tables.items():
        for row in rows:
            if row.name.removeprefix("movement.") in settings and page == "docs/commands.md":
                continue  # the setting says the same
            text = plain(row.cells.get("Meaning") or row.cells["What it does"]).replace("\\", "")
            if page == "docs/commands.md":
                text = f"{row.menu}: {text}"
            if row.cells.get("Shortcut"):
                text += f" Key: {row.cells['Shortcut']}."
            location = page.replace(".md", ".html#") + row.anchor
            sections.append({"location": location, "title": f"{row.label} ({row.name})", "names": [row.name.lower(), row.label.lower()],
                             "page": pages[page.replace(".md", ".html")]["title"], "text": text, "weight": weight_of(location)})
    for place, wordings in read_asked(config):
        section = next((section for section in sections if section["location"] == place), None)
        if section is None:
            raise PluginError(f"docs/site/asked.txt: there is no {place}")
        section["asked"] = "; ".join(filter(None, [section.get("asked"), wordings]))
    data["docs"] = sections
    index.write_text(json.dumps(data, ensure_ascii=False))
    # The same for pages that are opened as files, where a page may load a script but not fetch JSON.
    index.with_name("search_index.js").write_text(f"take_search_index({json.dumps(data)})\n")
    search = (pathlib.Path(config["config_file_path"]).parent / "search.js").read_text()
    for worker in (pathlib.Path(config["site_dir"]) / "assets" / "javascripts" / "workers").glob("search.*.js"):
        worker.write_text(search)
