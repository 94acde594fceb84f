#!/usr/bin/env python3
"""The files of docs/scale, as far as they can be checked without a cluster: YAML, the shell in them, and that their shards are
those of one whole. The commands run with a `slipface` that only writes down its arguments.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

root = Path(__file__).resolve().parent.parent
bad = []


def runs(script, env):
    """The arguments of every slipface that a script starts."""
    with tempfile.TemporaryDirectory() as folder:
        stub = Path(folder) / "slipface"
        stub.write_text(f'#!/bin/sh\necho "$@" >> {folder}/calls\n')
        stub.chmod(0o755)
        done = subprocess.run(["bash", "-euc", script], cwd=folder, env={"PATH": f"{folder}:/usr/bin:/bin", **env},
                              capture_output=True, text=True)
        if done.returncode != 0:
            bad.append(f"exit {done.returncode}: {script}\n{done.stderr}")
        calls = Path(folder) / "calls"
        return calls.read_text().splitlines() if calls.exists() else []


def check_shards(name, calls):
    shards = [re.search(r"--shard (\d+)/(\d+)", call) for call in calls]
    found = sorted((int(s[1]), int(s[2])) for s in shards if s)
    if found != [(i + 1, len(calls)) for i in range(len(calls))]:
        bad.append(f"{name}: shards {found}")
    if len({call for call in calls}) != len(calls):
        bad.append(f"{name}: two shards write the same")


name = "docs/scale/github-actions.yml"
flow = yaml.safe_load((root / name).read_text())
jobs = flow["jobs"]
for job in jobs.values():
    for step in job["steps"]:
        if ("uses" in step) == ("run" in step):
            bad.append(f"{name}: a step has uses or run: {step}")
if jobs["report"]["needs"] != "shard":
    bad.append(f"{name}: report has to wait for shard")
check = next(step["run"] for step in jobs["shard"]["steps"] if step.get("name") == "Check")
check_shards(name, [call for shard in jobs["shard"]["strategy"]["matrix"]["shard"] for call in
                    runs(check.replace("${{ matrix.shard }}", str(shard)), {"SHARDS": str(flow["env"]["SHARDS"])})])

name = "docs/scale/kubernetes.yaml"
job, merge = yaml.safe_load_all((root / name).read_text())
spec = job["spec"]
if (job["apiVersion"], job["kind"], spec["completionMode"]) != ("batch/v1", "Job", "Indexed"):
    bad.append(f"{name}: expected an indexed job")
container = spec["template"]["spec"]["containers"][0]
check_shards(name, [call for index in range(spec["completions"]) for call in
                    runs(container["args"][0], {"JOB_COMPLETION_INDEX": str(index)})])
for one in (spec["template"], merge["spec"]["jobTemplate"]["spec"]["template"]):
    volumes = {volume["name"] for volume in one["spec"]["volumes"]}
    for mount in one["spec"]["containers"][0]["volumeMounts"]:
        if mount["name"] not in volumes:
            bad.append(f"{name}: no volume {mount['name']}")
print("\n".join(bad))
sys.exit(1 if bad else 0)
