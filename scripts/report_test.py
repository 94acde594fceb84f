#!/usr/bin/env python3
"""Drives a check's report.html in a real headless Chromium: layout, every mode, the keyboard, the command.

Needs Debian's chromium and chromium-driver (only Python's standard library besides). Makes a small suite with every kind of
outcome, or takes the report given.

    scripts/report_test.py [--program build/release/editor/slipface] [--report out/snapshots/report.html] [--pictures DIR]
"""
import argparse, base64, json, os, pathlib, shutil, subprocess, sys, tempfile, time, urllib.request


class Browser:
    """WebDriver, as far as it is needed (W3C recommendation)."""

    def __init__(self, width=1500, height=950):
        self.process = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self.process.stdout:
            if "on port " in line:
                self.port = int(line.split("on port ")[1].split(".")[0].split()[0])
                if "successfully" in line:
                    break
        options = {"args": ["--headless=new", "--no-sandbox", "--disable-gpu", f"--window-size={width},{height}",
                            "--host-resolver-rules=MAP * ~NOTFOUND"]}
        answer = self.call("POST", "/session", {"capabilities": {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options,
                                                                                 "goog:loggingPrefs": {"browser": "ALL"}}}})
        self.session = "/session/" + answer["sessionId"]

    def call(self, method, path, body=None):
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", method=method,
                                         data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)["value"]

    def open(self, path):
        self.call("POST", self.session + "/url", {"url": pathlib.Path(path).resolve().as_uri()})

    def run(self, script):
        return self.call("POST", self.session + "/execute/sync", {"script": script, "args": []})

    def key(self, text):
        actions = [{"type": "keyDown", "value": text}, {"type": "keyUp", "value": text}]
        self.call("POST", self.session + "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def errors(self):
        log = self.call("POST", self.session + "/se/log", {"type": "browser"})
        return [entry["message"] for entry in log if entry["level"] == "SEVERE"]

    def picture(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.call("GET", self.session + "/screenshot")))

    def close(self):
        try:
            self.call("DELETE", self.session)
        finally:
            self.process.terminate()
            self.process.wait()


def make_report(program, folder):
    """Two different scenes, one missing, one the same."""
    folder = pathlib.Path(folder)
    level = "v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\nv -3 {0} -3\nv 3 {0} -3\no floor\nusemtl floor__{1}\nf 1 2 3 4\no wall\nusemtl wall\nf 4 3 6 5\n"
    goldens = folder / "screenshots"
    goldens.mkdir(parents=True)
    scenes = [{"name": name, "level": "../room.obj", "size": [480, 270], "style": "plain overlay", "camera": camera}
              for name, camera in [("scenes/iso", "auto:iso"), ("scenes/map", "auto:map"), ("scenes/back", "auto:bottom")]]
    (goldens / "scenes.json").write_text(json.dumps({"version": 1, "scenes": scenes}))
    (folder / "room.obj").write_text(level.format(2, "ice"))
    environment = {k: v for k, v in os.environ.items() if k not in ("CI", "GITHUB_ACTIONS")}
    run = lambda *words: subprocess.run([program, "snapshot", *words], cwd=folder, env=environment, capture_output=True, text=True)
    assert run("approve").returncode == 0
    (goldens / "scenes/back.png").unlink()
    (folder / "room.obj").write_text(level.format(2.3, "default"))
    answer = run("check")
    assert answer.returncode == 1, answer.stdout + answer.stderr
    return folder / "out/snapshots/report.html"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default="build/release/editor/slipface")
    parser.add_argument("--report")
    parser.add_argument("--pictures", help="folder for pictures of the page")
    arguments = parser.parse_args()
    if not shutil.which("chromedriver"):
        sys.exit("Please install: apt-get install chromium chromium-driver")
    scratch = tempfile.mkdtemp(prefix="slipface-report-")
    report = arguments.report or make_report(os.path.abspath(arguments.program), scratch)
    failures, checks = [], 0

    def expect(what, good):
        nonlocal checks
        checks += 1
        print(("ok   " if good else "FAIL ") + what)
        if not good:
            failures.append(what)

    browser = Browser()

    def picture(name):
        if arguments.pictures:
            os.makedirs(arguments.pictures, exist_ok=True)
            browser.picture(os.path.join(arguments.pictures, name + ".png"))

    try:
        browser.open(report)
        time.sleep(0.5)
        names = lambda: browser.run("return [...document.querySelectorAll('.item .name')].map(e => e.textContent)")
        title = lambda: browser.run("return document.querySelector('main h2')?.textContent")
        expect("the page loads without an error", not browser.errors())
        expect("only what is not the same is listed at first", len(names()) > 0 and browser.run(
            "return DATA.entries.filter(e => e.state !== 'same').length") == len(names()))
        expect("the worst comes first", title() == names()[0])
        expect("pictures are inside the page", browser.run("return [...document.images].every(i => i.src.startsWith('data:') && i.naturalWidth > 0)"))
        expect("nothing is fetched", browser.run("return performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).length") == 0)
        picture("1-side")
        browser.key("4")
        time.sleep(0.5)
        count = browser.run("return +document.getElementById('heat').dataset.count")
        expect("the heat map counts as the check did", count == browser.run("return shown()[0].pixels.differing"))
        picture("2-heat")
        browser.run("const s = document.querySelector('#stage input'); s.value = 64; s.dispatchEvent(new Event('input'))")
        time.sleep(0.3)
        expect("a higher threshold leaves fewer pixels", browser.run("return +document.getElementById('heat').dataset.count") < count)
        browser.key("2")
        expect("swipe lays one picture over the other", browser.run("return document.querySelectorAll('#swipe img').length") == 2)
        browser.run("const b = document.getElementById('swipe'), r = b.getBoundingClientRect(); b.onpointermove({clientX: r.left + r.width * 0.25})")
        expect("swipe follows the pointer", browser.run("return document.querySelector('#swipe .top').style.width") == "25%")
        picture("3-swipe")
        browser.key("3")
        before = browser.run("return document.querySelector('#stage img').src")
        browser.key(" ")
        expect("space blinks", before != browser.run("return document.querySelector('#stage img').src"))
        browser.key("1")
        expect("1 shows both", browser.run("return document.querySelectorAll('#stage img').length") == 2)
        first = title()
        browser.key("j")
        expect("j goes on", title() != first)
        browser.key("k")
        expect("k goes back", title() == first)
        browser.key("a")
        command = browser.run("return document.getElementById('command').textContent")
        expect("a approves and goes on", command.endswith(" " + first) and command.startswith("slipface snapshot approve --from ") and title() != first)
        second = title()
        browser.key("r")
        expect("r rejects", second not in browser.run("return document.getElementById('command').textContent").split())
        browser.key("k")
        browser.key("s")
        expect("s skips", browser.run("return [...marks.values()].includes('skip')"))
        picture("4-marked")
        browser.run("filter = 'all'; draw()")
        expect("the filter shows all", len(names()) == browser.run("return DATA.entries.length"))
        browser.run("const s = document.getElementById('search'); s.value = 'map'; s.oninput()")
        expect("the search filters by name", all("map" in name for name in names()))
        expect("no error came up on the way", not browser.errors())
        if not arguments.report:
            approve = subprocess.run([os.path.abspath(arguments.program), *command.split()[1:]], cwd=scratch, capture_output=True, text=True,
                                     env={k: v for k, v in os.environ.items() if k not in ("CI", "GITHUB_ACTIONS")})
            expect("the command on the page approves that one", approve.returncode == 0 and "1 approved" in approve.stdout)
    finally:
        browser.close()
        shutil.rmtree(scratch)
    print(f"{checks - len(failures)} of {checks} as expected")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
