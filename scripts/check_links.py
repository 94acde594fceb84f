#!/usr/bin/env python3
"""Fails on dead links, dead anchors and missing images, each with its file and line.

    scripts/check_links.py [--root FOLDER] [SITE]

Checks the *.md files at the top and in docs/ as they lie in the repository, with the anchors that GitHub makes, and with SITE the pages that
scripts/build_docs.sh wrote there. Those may also load nothing from another machine. Links to other sites are not followed.
scripts/check_links_test.py tests it.
"""
import argparse, html.parser, pathlib, re, sys, urllib.parse


class Page:
    """The links and anchors of a file."""

    def __init__(self, path):
        self.path, self.anchors, self.links, self.loads = path, set(), [], []  # links and loads: (line, address)


class HtmlPage(Page, html.parser.HTMLParser):
    def __init__(self, path):
        Page.__init__(self, path)
        html.parser.HTMLParser.__init__(self)
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        line = self.getpos()[0]
        for name, value in attributes:
            if value and (name == "id" or name == "name" and tag == "a"):
                self.anchors.add(value)
            elif name == "href" and tag == "a":
                self.links.append((line, value or ""))
            elif name in ("src", "data", "poster") or name == "href" and tag == "link":
                self.loads.append((line, value or ""))
            elif name == "srcset":
                self.loads += [(line, part.split()[0]) for part in value.split(",")]

    def handle_data(self, data):
        if self.lasttag == "style":
            self.loads += addresses_of_css(data, self.getpos()[0])


class MarkdownPage(Page):
    def __init__(self, path):
        super().__init__(path)
        text = blank(r"^(```+|~~~+).*?^\1", path.read_text(), re.S | re.M)
        seen = {}
        for heading in re.findall(r"^#{1,6} +(.+?)[ #]*$", text, re.M):
            slug = re.sub(r"[^\w\- ]", "", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
            self.anchors.add(slug + (f"-{seen[slug]}" if slug in seen else ""))
            seen[slug] = seen.get(slug, 0) + 1
        self.anchors |= set(re.findall(r"""<\w+[^>]* (?:id|name)=["']([^"']+)""", text))
        text = blank(r"`[^`\n]+`", text)
        for match in re.finditer(r"""\]\(<?([^)\s>]+)|^\[[^\]]+\]:\s+(\S+)|<\w+[^>]* (?:href|src)=["']([^"']+)""", text, re.M):
            self.links.append((text.count("\n", 0, match.start()) + 1, match[1] or match[2] or match[3]))


def blank(pattern, text, flags=0):
    """Without what the pattern matches, but with as many lines."""
    return re.sub(pattern, lambda m: "\n" * m[0].count("\n"), text, flags=flags)


def addresses_of_css(text, line=1):
    found = re.finditer(r"""url\(\s*["']?([^"')]+)|@import\s+["']([^"']+)""", text)
    return [(line + text.count("\n", 0, m.start()), m[1] or m[2]) for m in found]


class Checker:
    def __init__(self, root):
        self.root, self.pages, self.links, self.errors = root, {}, 0, []

    def page(self, path):
        if path not in self.pages:
            kind = {".html": HtmlPage, ".md": MarkdownPage}.get(path.suffix)
            self.pages[path] = kind(path) if kind else None
        return self.pages[path]

    def error(self, path, line, text):
        self.errors.append(f"{path.relative_to(self.root)}:{line}: {text}")

    def check(self, path):
        page = self.page(path)
        for line, address in page.links:
            self.follow(page, line, address)
        for line, address in page.loads:
            self.load(path, line, address)

    def follow(self, page, line, address):
        self.links += 1
        parts = urllib.parse.urlsplit(address)
        if parts.scheme or parts.netloc:
            return
        if not address:
            return self.error(page.path, line, "a link to nothing")
        target = page.path
        if parts.path:
            target = page.path.parent / urllib.parse.unquote(parts.path)
            target = pathlib.Path(re.sub(r"/(\./)?$", "", str(target))).resolve()
            if target.is_dir() and page.path.suffix == ".html":
                target = target / "index.html"
        if not target.is_relative_to(self.root):
            return self.error(page.path, line, f"{address} leads out of {self.root.name}")
        if not target.exists():
            return self.error(page.path, line, f"{address}: there is no {target.relative_to(self.root)}")
        if parts.fragment and target.suffix in (".html", ".md"):
            if urllib.parse.unquote(parts.fragment) not in self.page(target).anchors:
                self.error(page.path, line, f"{address}: {target.relative_to(self.root)} has no #{parts.fragment}")

    def load(self, path, line, address):
        self.links += 1
        parts = urllib.parse.urlsplit(address)
        if parts.netloc:
            self.error(path, line, f"{address} would be loaded from another machine")
        elif parts.scheme != "data" and parts.path and not (path.parent / urllib.parse.unquote(parts.path)).exists():
            self.error(path, line, f"{address} is missing")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).parent.parent)
    parser.add_argument("site", nargs="?", type=pathlib.Path)
    options = parser.parse_args()

    sources = Checker(options.root.resolve())
    documents = [*sorted(sources.root.glob("*.md")), *sorted((sources.root / "docs").glob("**/*.md"))]
    for path in documents:
        sources.check(path)
    checked, errors = f"{len(documents)} documents with {sources.links} links", sources.errors
    if options.site:
        site = Checker(options.site.resolve())
        # The page for addresses that do not exist may be shown in any folder, so its links count from the server's top.
        pages = [path for path in sorted(site.root.glob("**/*.html")) if path.name != "404.html"]
        if not pages:
            sys.exit(f"check_links.py: found no page in {options.site}, expected a site of scripts/build_docs.sh")
        for path in pages:
            site.check(path)
        for path in sorted(site.root.glob("**/*.css")):
            for line, address in addresses_of_css(path.read_text()):
                site.load(path, line, address)
        checked += f", {len(pages)} pages with {site.links}"
        errors = errors + site.errors
    for error in errors:
        print(error)
    print(f"{checked}: {len(errors)} dead" if errors else f"{checked}: all lead somewhere")
    sys.exit(1 if errors else 0)


main()
