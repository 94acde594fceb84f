#!/usr/bin/env python3
"""headers.py XML PAGES: a page per public header, from doxygen's XML.

The headers are written to be read from top to bottom, so a page is the header itself: comments become text, declarations
stay code in which every name leads to its declaration. Writes PAGES/slipface/MODULE/HEADER.md and PAGES/names.json: where
each name stands, for the other pages to link to.
"""
import html, json, os, pathlib, re, sys
import xml.etree.ElementTree as ET

CLASSES = {"comment": "c1", "keyword": "k", "keywordtype": "kt", "keywordflow": "k", "preprocessor": "cp",
           "stringliteral": "s", "charliteral": "s"}


def read_names(folder):
    """refid -> (qualified name without `slipface::`, kind), of everything that doxygen found."""
    names = {}
    for compound in ET.parse(folder / "index.xml").getroot():
        kind, scope = compound.get("kind"), compound.findtext("name")
        scope = "" if kind in ("namespace", "file", "dir") and "trace_colors" not in scope else scope
        scope = scope.removeprefix("slipface::")
        if kind in ("struct", "class", "union", "concept"):
            names[compound.get("refid")] = (scope, "type")
        for member in compound.findall("member"):
            member_kind = {"function": "function", "enum": "type", "typedef": "type"}.get(member.get("kind"), "value")
            name = member.findtext("name")
            names.setdefault(member.get("refid"), (f"{scope}::{name}" if scope else name, member_kind))
    return names


class Line:
    def __init__(self, element):
        self.refid = element.get("refid")
        self.parts = []  # (class of highlight, text, refid or None)
        for highlight in element:
            kind = highlight.get("class")
            self.add(kind, highlight.text, None)
            for child in highlight:
                self.add(kind, " " if child.tag == "sp" else "".join(child.itertext()), child.get("refid"))
                self.add(kind, child.tail, None)
        self.text = "".join(text for _, text, _ in self.parts)
        self.bare = self.text.strip()
        self.is_comment = self.bare.startswith("//")

    def add(self, kind, text, refid):
        if not text:
            return
        if self.parts and not refid and self.parts[-1][0] == kind and not self.parts[-1][2]:
            text = self.parts.pop()[1] + text
        self.parts.append((kind, text, refid))

    def column_of_comment(self):
        column = 0
        for kind, text, _ in self.parts:
            if kind == "comment":
                return column
            column += len(text)
        return -1

    def depth(self):
        code = "".join(text for kind, text, _ in self.parts if kind not in ("comment", "stringliteral", "charliteral"))
        return sum(code.count(c) for c in "{(") - sum(code.count(c) for c in "})")


class Header:
    def __init__(self, path, element, refid):
        self.path, self.refid = path, refid  # "slipface/movement/step.h"
        self.page = path.removesuffix(".h") + ".html"
        self.module, self.name = path.split("/")[-2:]
        lines = [Line(e) for e in element.find("programlisting")]
        pragma = next((i for i, line in enumerate(lines) if line.bare == "#pragma once"), -1)
        self.about = [line.bare for line in lines[:max(pragma, 0)] if line.is_comment]
        self.includes = [refid for line in lines if line.bare.startswith("#include") for _, _, refid in line.parts if refid]
        body = [line for line in lines[pragma + 1:]
                if not re.match(r'#include|namespace slipface \{|\}\s*// namespace slipface$', line.bare)]
        # The further lines of a comment at the right margin belong to the code there.
        for before, line in zip(body, body[1:]):
            if line.is_comment and not before.is_comment and before.column_of_comment() == line.column_of_comment() > 0:
                line.is_comment = False
        self.blocks = [b for b in split(without_private(body)) if not all(re.match(r"(struct|class) \w+;", x.bare) for x in b)]


def without_private(lines):
    """Drops the private part at the end of each class, and the empty line before it."""
    out, depth, private = [], 0, 0  # the depth of the part that is left out
    for line in lines:
        if not private and line.bare == "private:":
            private = depth
            while out and not out[-1].bare:
                out.pop()
        depth += line.depth()
        if depth < private:
            private = 0
        if not private:
            out.append(line)
    return out


def split(lines):
    """The blocks of a header: a comment and what it is about, up to an empty line or the next comment."""
    block, depth = [], 0
    for line in lines:
        if depth == 0 and (not line.bare or line.is_comment and block and not block[-1].is_comment):
            if block:
                yield block
            block = []
        if line.bare or block:
            block.append(line)
        depth += line.depth()
    if block:
        yield block


class Site:
    def __init__(self, folder):
        self.names = read_names(folder)
        self.headers, self.file_of = [], {}
        for path in sorted(folder.glob("*_8h.xml")):
            compound = ET.parse(path).getroot().find("compounddef")
            location = compound.find("location").get("file")
            public = "slipface/" + location.split("/slipface/", 1)[1]
            header = Header(public, compound, compound.get("id"))
            self.headers.append(header)
            self.file_of[header.refid] = header
        self.headers.sort(key=lambda h: (h.module, h.name))
        self.place = {}  # refid -> (page, anchor)
        self.named = {}  # name -> [page, anchor]
        self.place_names()

    def place_names(self):
        for header in self.headers:
            taken = set()
            for line in (line for block in header.blocks for line in block if line.refid in self.names):
                name, kind = self.names[line.refid]
                if line.refid in self.place:
                    continue
                anchor = name.replace("::", ".").replace(" ", "")
                number = 1
                while anchor in taken:
                    number += 1
                    anchor = name.replace("::", ".").replace(" ", "") + f"-{number}"
                taken.add(anchor)
                self.place[line.refid] = (header.page, anchor)
                self.named.setdefault(name + "()" if kind == "function" else name, [header.page, anchor])

    def href(self, page, refid):
        if refid in self.file_of:
            return os.path.relpath(self.file_of[refid].page, os.path.dirname(page))
        if refid not in self.place:
            return None
        target, anchor = self.place[refid]
        return ("" if target == page else os.path.relpath(target, os.path.dirname(page))) + "#" + anchor

    # Comments: paragraphs, lists and indented samples.
    def prose(self, page, comments):
        lines = [re.sub(r"^// ?", "", c) for c in comments]
        out, i = [], 0
        while i < len(lines):
            if not lines[i].strip():
                i += 1
            elif lines[i].startswith("  "):
                start = i
                while i < len(lines) and (lines[i].startswith("  ") or not lines[i].strip() and
                                          i + 1 < len(lines) and lines[i + 1].startswith("  ")):
                    i += 1
                sample = [line[2:] for line in lines[start:i]]
                indent = min(len(s) - len(s.lstrip()) for s in sample if s.strip())
                out.append('<div class="highlight"><pre><code>' + html.escape("\n".join(s[indent:] for s in sample)) +
                           "</code></pre></div>")
            else:
                item = lines[i].startswith("- ")
                text = [lines[i].removeprefix("- ")]
                i += 1
                while i < len(lines) and lines[i].strip() and not lines[i].startswith("- ") and \
                        (item or not lines[i].startswith("  ")):
                    text.append(lines[i].strip())
                    i += 1
                body = self.inline(page, " ".join(text))
                out.append(f"<ul><li>{body}</li></ul>" if item else f"<p>{body}</p>")
        return "\n".join(out).replace("</ul>\n<ul>", "\n")

    def inline(self, page, text):
        """Escaped, with `code`; names of the headers lead to them."""
        def one(match):
            code, word = match.groups()
            if code is not None:
                return f"<code>{html.escape(code)}</code>"
            if word.startswith("slipface/"):
                target = word.removesuffix(".h") + ".html"
                return f'<a href="{os.path.relpath(target, os.path.dirname(page))}">{word}</a>' \
                    if any(h.path == word for h in self.headers) else word
            return self.link(page, word, word)
        pieces, end = [], 0
        pattern = r"`([^`]+)`|(\bslipface/\w+/\w+\.h\b|\b[A-Za-z_]\w*(?:::\w+)+(?:\(\))?|\b[a-z_]\w*\(\)|\b[A-Z][a-z0-9]+[A-Z]\w+)"
        for match in re.finditer(pattern, text):
            pieces += [html.escape(text[end:match.start()], quote=False), one(match)]
            end = match.end()
        return "".join(pieces) + html.escape(text[end:], quote=False)

    def link(self, page, name, shown):
        found = self.named.get(name) or self.named.get(name + "()")
        if not found:
            return shown
        target = "" if found[0] == page else os.path.relpath(found[0], os.path.dirname(page))
        return f'<a href="{target}#{found[1]}">{shown}</a>'

    def code_line(self, page, line, written):
        out = []
        for kind, text, refid in line.parts:
            shown = html.escape(text, quote=False)
            if refid and refid == line.refid and refid in self.place:
                anchor = self.place[refid][1]
                shown = f'<a class="declared" href="#{anchor}">{shown}</a>'
                if refid not in written:
                    written.add(refid)
                    shown = f'<span id="{anchor}">{shown}</span>'
            else:  # doxygen links no arguments of templates, or Result<Mesh> as one
                head = re.match(r"[\w:~]+", text)[0] if refid and self.href(page, refid) else ""
                rest = html.escape(text[len(head):], quote=False)
                if kind == "normal":
                    rest = re.sub(r"\b[A-Z]\w+\b(?!::)", lambda m: self.link(page, m[0], m[0]), rest)
                shown = (f'<a href="{self.href(page, refid)}">{head}</a>' if head else "") + rest
            if kind in CLASSES:
                shown = f'<span class="{CLASSES[kind]}">{shown}</span>'
            out.append(shown)
        # A declaration whose name doxygen did not link still has its anchor.
        if line.refid in self.place and line.refid not in written and self.place[line.refid][0] == page:
            written.add(line.refid)
            out.insert(0, f'<span id="{self.place[line.refid][1]}"></span>')
        return "".join(out).rstrip()

    def listing(self, page, lines, written):
        """Code, with its comments of whole lines as text between it."""
        out, code, i = [], [], 0

        def flush():
            while code and not code[0]:
                code.pop(0)
            while code and not code[-1]:
                code.pop()
            if code:
                out.append("<pre><code>" + "\n".join(code) + "\n</code></pre>")
            code.clear()
        while i < len(lines):
            if not lines[i].is_comment:
                code.append(self.code_line(page, lines[i], written))
                i += 1
                continue
            flush()
            start = i
            while i < len(lines) and lines[i].is_comment:
                i += 1
            indent = lines[start].column_of_comment()
            out.append(f'<div class="note" style="--indent:{indent}">' +
                       self.prose(page, [line.bare for line in lines[start:i]]) + "</div>")
        flush()
        return '<div class="highlight header">' + "\n".join(out) + "</div>"

    def heading(self, block, written):
        """The names that a block declares, as its heading, which is then where links to them lead."""
        names, anchors, depth = [], [], 0
        for line in block:
            if depth == 0 and line.refid in self.place and line.refid not in written:
                written.add(line.refid)
                name, kind = self.names[line.refid]
                shown = f"`{name.split('::')[-1]}{'()' if kind == 'function' else ''}`"
                names += [shown] if shown not in names else []
                anchors.append(self.place[line.refid][1])
            depth += line.depth()
        if not names:
            return []
        further = "".join(f'<span id="{a}"></span>' for a in anchors[1:])
        return ([f'<div class="anchors">{further}</div>'] if further else []) + \
            [f"## {', '.join(names[:3])}{', …' if len(names) > 3 else ''} {{#{anchors[0]}}}"]

    def page(self, header):
        written = set()
        out = [f"# {header.name}", f'<p class="include"><code>#include &lt;{header.path}&gt;</code></p>',
               self.prose(header.page, header.about)]
        uses = [f'<a href="{self.href(header.page, refid)}">{self.file_of[refid].name}</a>'
                for refid in header.includes if refid in self.file_of]
        if uses:
            out.append(f'<p class="uses">Includes {", ".join(uses)}</p>')
        for block in header.blocks:
            out += self.heading(block, written)
            comments = 0
            while comments < len(block) and block[comments].is_comment:
                comments += 1
            if comments:
                out.append(self.prose(header.page, [line.bare for line in block[:comments]]))
            if block[comments:]:
                out.append(self.listing(header.page, block[comments:], written))
        return "\n\n".join(out) + "\n"

    def index(self):
        out = ["# Headers\n", "The public headers of the engine, by module. [Design](../docs/design.md#modules) says what each "
               "module owns, and which may include which."]
        module = None
        for header in self.headers:
            if header.module != module:
                module = header.module
                out.append(f"\n## {module}\n\n| header | what it has |\n|---|---|")
            about = " ".join(re.sub(r"^// ?", "", c) for c in header.about)
            about = re.split(r"(?<=[.:])\s", about, maxsplit=1)[0].rstrip(".:").replace("|", "\\|")
            out.append(f"| [{header.name}]({header.path.removeprefix('slipface/').removesuffix('.h')}.md) | {about} |")
        return "\n".join(out) + "\n"


def main():
    site = Site(pathlib.Path(sys.argv[1]))
    pages = pathlib.Path(sys.argv[2])
    for header in site.headers:
        path = pages / header.page.replace(".html", ".md")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(site.page(header))
    (pages / "slipface" / "index.md").write_text(site.index())
    (pages / "names.json").write_text(json.dumps(site.named))


main()
