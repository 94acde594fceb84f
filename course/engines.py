"""Speaks the stepping protocol (docs/course.md) with an engine: a process that reads JSON lines and answers each with one."""
import json
import subprocess
import threading

PROTOCOL = 1


class Refusal(Exception):
    """The engine answered with an error, or with what is no answer."""


class Engine:
    def __init__(self, command, timeout_s=120):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8")
        self.timeout_s = timeout_s
        self.hello = self.ask([{"do": "hello", "protocol": PROTOCOL}])[0]
        if self.hello.get("protocol") != PROTOCOL:
            raise Refusal(f"hello: found {json.dumps(self.hello)}, expected the protocol {PROTOCOL}")

    def ask(self, requests):
        """The answers to all requests, which are sent while the answers come in."""
        def send():
            try:
                for request in requests:
                    self.process.stdin.write(json.dumps(request) + "\n")
                self.process.stdin.flush()
            except OSError:
                pass  # the reader finds the end
        timer = threading.Timer(self.timeout_s, self.process.kill)
        sender = threading.Thread(target=send)
        timer.start()
        sender.start()
        try:
            answers = []
            for _ in requests:
                line = self.process.stdout.readline()
                if not line:
                    raise Refusal(f"the engine ended after {len(answers)} of {len(requests)} answers")
                try:
                    answers.append(json.loads(line))
                except ValueError:
                    raise Refusal(f"found the line {line[:80]!r}, expected JSON") from None
            return answers
        finally:
            timer.cancel()
            if self.process.poll() is None:
                sender.join(5)

    def run(self, run):
        """{"feet": [...], "grounded": [...]} or {"error": ...} of a run of a course."""
        name = run["run"]
        answer = self.ask([{"do": "load", "run": name, **run["load"]}])[0]
        if "error" in answer:
            return {"error": answer["error"]}
        requests = []
        for step in run["steps"]:
            request = {"do": "step", "run": name, **{k: v for k, v in step.items() if k != "repeat"}}
            requests += [request] * step.get("repeat", 1)
        answers = self.ask(requests + [{"do": "free", "run": name}])[:-1]
        wrong = next((a for a in answers if "error" in a or "feet" not in a), None)
        if wrong is not None:
            return {"error": wrong.get("error", {"place": "/", "found": json.dumps(wrong)[:80], "expected": "feet"})}
        return {"feet": [a["feet"] for a in answers], "grounded": [a.get("grounded") for a in answers]}

    def close(self):
        try:
            self.process.stdin.close()
        except OSError:
            pass
        try:
            return self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.wait()


def run_course(course, start_engine, say=lambda text: None):
    """Every run that the engine has the features for; one that ends is started anew. The form of an answer file."""
    engine = start_engine()
    hello = {k: v for k, v in engine.hello.items() if k in ("engine", "version", "body", "features", "note")}
    runs = {}
    for run in course["runs"]:
        if missing := sorted(set(run.get("about", {}).get("needs", [])) - set(hello.get("features", []))):
            runs[run["run"]] = {"missing": missing}
            continue
        try:
            runs[run["run"]] = engine.run(run)
        except Refusal as refusal:
            runs[run["run"]] = {"error": {"place": "/", "found": str(refusal), "expected": "an answer to every line"}}
            engine.close()
            engine = start_engine()
    engine.close()
    return {"slipface_course_answer": PROTOCOL, **hello, "runs": runs}
