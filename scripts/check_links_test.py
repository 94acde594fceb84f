#!/usr/bin/env python3
"""Tests scripts/check_links.py: each fault that it is for, planted in a small repository and a small site."""
import pathlib, subprocess, sys, tempfile, unittest

program = pathlib.Path(__file__).with_name("check_links.py")
sound = {
    "README.md": "# Top\n[page](docs/page.md#two-words) ![image](image.png) [file](docs) [elsewhere](https://example.org)\n"
                 "`[code](missing)`\n```\n[block](missing)\n```\n",
    "docs/page.md": "# Page\n## Two words\n## Two words\n[self](#two-words-1) [up](../README.md#top)\n",
    "image.png": "",
    "site/index.html": "<link rel=stylesheet href=style.css><h1 id=top>Top</h1><a href=sub/page.html#part>page</a><a href=#top>top</a>"
                       "<img src=image.png><a href=https://example.org>elsewhere</a>",
    "site/sub/page.html": "<h2 id=part></h2><a href=..>up</a><script src=../script.js></script>",
    "site/style.css": "body { background: url(image.png) url(data:image/png;base64,AA) }",
    "site/image.png": "", "site/script.js": "", "site/404.html": "<a href=/anywhere>",
}


class CheckLinks(unittest.TestCase):
    def check(self, changes=(), says="all lead somewhere", code=1):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in sound.items():
                for file, old, new in changes:
                    if file == name:
                        self.assertIn(old, text)
                        text = text.replace(old, new)
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            run = subprocess.run([sys.executable, program, "--root", root, root / "site"], capture_output=True, text=True)
            self.assertIn(says, run.stdout)
            self.assertEqual(run.returncode, code, run.stdout + run.stderr)

    def test_passes_what_is_sound(self):
        self.check(code=0)

    def test_finds_faults_in_documents(self):
        self.check([("README.md", "docs/page.md#", "docs/pages.md#")], "README.md:2: docs/pages.md#two-words: there is no docs/pages.md")
        self.check([("README.md", "#two-words", "#two-word")], "README.md:2: docs/page.md#two-word: docs/page.md has no #two-word")
        self.check([("README.md", "image.png", "images.png")], "README.md:2: images.png: there is no images.png")
        self.check([("docs/page.md", "#two-words-1", "#two-words-2")], "docs/page.md:4: #two-words-2: docs/page.md has no")
        self.check([("docs/page.md", "../README.md", "../../README.md")], "docs/page.md:4: ../../README.md#top leads out of")

    def test_finds_faults_in_pages(self):
        self.check([("site/index.html", "sub/page.html#part", "sub/page.html#parts")], "index.html:1: sub/page.html#parts: sub/page.html has no")
        self.check([("site/index.html", "sub/page.html#part", "page.html")], "index.html:1: page.html: there is no page.html")
        self.check([("site/index.html", "src=image.png", "src=images.png")], "index.html:1: images.png is missing")
        self.check([("site/sub/page.html", "../script.js", "script.js")], "sub/page.html:1: script.js is missing")
        self.check([("site/style.css", "url(image.png)", "url(images.png)")], "style.css:1: images.png is missing")

    def test_lets_nothing_be_loaded_from_elsewhere(self):
        for address in ("https://example.org/x", "//example.org/x"):
            self.check([("site/sub/page.html", "../script.js", address)], f"{address} would be loaded from another machine")
            self.check([("site/index.html", "style.css", address)], f"{address} would be loaded from another machine")
            self.check([("site/style.css", "url(image.png)", f"url({address})")], f"{address} would be loaded from another machine")


unittest.main()
