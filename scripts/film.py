#!/usr/bin/env python3
"""The film of the README, docs/images/film.webm: paint, walk, stop, why, cure; reach; a snapshot report that names a moved prop. Its frames are
those of the program, driven off-screen by the scripts below.

usage: film.py PROGRAM [--check] [--frames FOLDER]

--check runs the scripts with one frame a scene and encodes nothing: what they expect has to hold, and every frame to be there. --frames
leaves the frames. Encoding needs Debian's ffmpeg."""
import argparse, json, os, pathlib, re, shutil, subprocess, sys, tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "docs/images/film.webm"
SIZE, BAR, MOST_BYTES = (960, 600), 44, 2_000_000

# Of each scene: caption, level, and its script, where "shot SECONDS" is a frame that stays so long, and "N times: A; B" repeats.
WALKED = """
set step_up=0
camera eye -19,1.5,-3.4 target -19,-0.8,-6.6
viewport hover @-19,-1,-5.6
key P
command playtest.start
wait 10
12 times: hold W 5; shot 0.1
key Escape
finish
expect repeats yes
"""
SCENES = [
    ("Paint: this floor is ice", "assets/levels/easy.obj", """
camera eye 0,2.4,9 target 0,0.2,-6
only palette 250
park_mouse
shot 1.2
click "Palette/ice"
key B
expect brush ice
shot 0.6
viewport drag @-3.2,-1,1.5 @-2.2,-1,1.5
shot 0.3
viewport drag @-2.2,-1,1.5 @-1,-1,1.2
shot 0.3
viewport drag @-1,-1,1.2 @0.4,-1,1
shot 0.3
viewport drag @0.4,-1,1 @1.8,-1,0.8
shot 0.3
viewport drag @1.8,-1,0.8 @1.8,-1,-1
shot 0.3
viewport drag @1.8,-1,-1 @-1.5,-1,-1.2
shot 0.3
viewport drag @-1.5,-1,-1.2 @-3.2,-1,-1.2
expect dirty yes
shot 1.2
"""),
    ("Walk: the stairs stop the player", "assets/levels/playground.obj", "only view\n" + WALKED),
    ("Why: the face, the rule and its limit", "assets/levels/playground.obj", WALKED.replace("12 times: hold W 5; shot 0.1", "hold W 60") + """
only why 350
camera eye -23.6,2.8,-3 target -18.6,0.3,-7.6
finish
park_mouse
shot 5.5
hover "Why/Headline/Cure"
shot 1
"""),
    ("Cure: one click, the same run again", "assets/levels/playground.obj", WALKED.replace("12 times: hold W 5; shot 0.1", "hold W 60") + """
only why 350
camera eye -23.6,2.8,-3 target -18.6,0.3,-7.6
finish
click "Why/Headline/Cure"
finish
expect setting step_up=on
command lab.start
park_mouse
14 times: key .; key .; key .; key .; key .; shot 0.12
shot 1.4
"""),
    ("Reach: where the player can get, and how soon", "assets/levels/easy.obj", """
only reach 250
command view.overlay
command view.top
camera frame
command reach.run
8 times: wait 20; shot 0.2
finish
click "Reach/Search on"
park_mouse
8 times: wait 20; shot 0.2
finish
click "Reach/Search on"
park_mouse
8 times: wait 20; shot 0.2
finish
shot 1.5
"""),
    ("Snapshots: the report names the prop that moved", "YARD", """
review REPORT
only review
park_mouse
shot 6
"""),
]


def script_of(lines, folder, check):
    """The editor's script, and (file, seconds) of each frame."""
    script, frames = [], []
    for line in lines.strip().splitlines():
        repeated = re.fullmatch(r"(\d+) times: (.*)", line)
        for _ in range(int(repeated[1]) if repeated else 1):
            for verb in (repeated[2] if repeated else line).split("; "):
                if verb.startswith("shot "):
                    frames.append((folder / f"{len(frames):03}.png", float(verb[5:])))
                    verb = f'screenshot "{frames[-1][0]}"'
                script.append(verb)
    if check:  # the last frame alone
        script = [verb for verb in script if not verb.startswith("screenshot") or str(frames[-1][0]) in verb]
        frames = frames[-1:]
    return "\n".join(script) + "\n", frames


def run(*command):
    done = subprocess.run([str(each) for each in command], cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"film.py: exit code {done.returncode} of {' '.join(map(str, command))}\n{done.stdout}")


def moved_prop(program, folder):
    """A project whose suite was approved before a crate moved, and the report of the check after that."""
    shutil.copytree(ROOT / "assets/props", folder / "props")
    (folder / "screenshots").mkdir()
    suite = {"version": 1, "defaults": {"size": [640, 360]},
             "scenes": [{"name": "yard", "level": "../props/yard.obj", "camera": {"eye": [6, 6, 12], "target": [0, 0.5, 0]}}]}
    (folder / "screenshots/scenes.json").write_text(json.dumps(suite))
    environment = {name: value for name, value in os.environ.items() if name not in ("CI", "GITHUB_ACTIONS")}
    subprocess.run([program, "snapshot", "approve"], cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL)
    level = folder / "props/yard.slipface.json"
    data = json.loads(level.read_text())
    prop = next(each for each in data["props"] if each["name"] == "iron crate")
    prop["position"][0] += 1.5
    level.write_text(json.dumps(data, indent=2))
    said = subprocess.run([program, "snapshot", "check", "--out", "out"], cwd=folder, env=environment, text=True, stdout=subprocess.PIPE)
    wanted = f"prop `{prop['name']}` moved 1.5 m"
    if said.returncode != 1 or wanted not in said.stdout:
        sys.exit(f"film.py: the check does not say \"{wanted}\"\n{said.stdout}")
    return folder / "out/report.json"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--frames", type=pathlib.Path)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        film, captions, time = [], [], 0.0
        for number, (caption, level, lines) in enumerate(SCENES):
            folder = (given.frames or work).resolve() / f"scene-{number}"
            folder.mkdir(parents=True, exist_ok=True)
            if level == "YARD":
                lines = lines.replace("REPORT", f'"{moved_prop(given.program, work / "project")}"')
                level = work / "project/props/yard.obj"
            script, frames = script_of(lines, folder, given.check)
            (work / "film.script").write_text(script)
            run(given.program, "edit", ROOT / level, "--script", work / "film.script", "--size", "x".join(map(str, SIZE)))
            if missing := [path for path, _ in frames if not path.exists()]:
                sys.exit(f"film.py: {missing[0]} was not written")
            captions.append((caption, time, time := time + sum(seconds for _, seconds in frames)))
            film += frames
            print(f"{caption}: {len(frames)} frames", flush=True)
        if not given.check:
            encode(film, captions, work)


def encode(film, captions, work):
    (work / "list").write_text("".join(f"file '{path}'\nduration {seconds}\n" for path, seconds in film) + f"file '{film[-1][0]}'\n")
    filters = [f"pad=iw:ih+{BAR}:0:0:0x181a1e"]
    for number, (caption, begin, end) in enumerate(captions):
        (work / f"caption-{number}").write_text(caption)
        filters.append(f"drawtext=fontfile=/usr/share/fonts/opentype/inter/Inter-SemiBold.otf:textfile={work}/caption-{number}:fontsize=20:"
                       f"fontcolor=0xf1b054:x=(w-text_w)/2:y=h-{BAR}+({BAR}-text_h)/2:enable='between(t,{begin},{end - 0.01})'")
    run("ffmpeg", "-y", "-f", "concat", "-safe", "0", "-i", work / "list", "-vf", ",".join(filters + ["fps=10"]), "-c:v", "libvpx-vp9",
        "-crf", "34", "-b:v", "0", "-pix_fmt", "yuv420p", work / "film.webm")
    run("ffmpeg", "-y", "-sseof", "-9", "-i", work / "film.webm", "-frames:v", "1", "-q:v", "3", work / "film.jpg")
    seconds, size = captions[-1][2], (work / "film.webm").stat().st_size
    print(f"{OUT.relative_to(ROOT)}: {seconds:.0f} s, {size} bytes")
    if size > MOST_BYTES:
        sys.exit(f"expected at most {MOST_BYTES} bytes")
    for path in (OUT, OUT.with_suffix(".jpg")):
        shutil.move(work / path.name, path)


if __name__ == "__main__":
    main()
