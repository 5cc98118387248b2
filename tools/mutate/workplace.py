"""A scratch copy of the tree with a build folder of its own, where faults are made and tests are run."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

# Tests that look at the sources or install them, or need a browser.
LEFT_OUT = {"tools", "package", "views", "fuzz"}
# A test that takes this many times as long as without a fault, and at least so long [s], hangs.
PATIENCE, LEAST_PATIENCE_S = 20, 60


def told_seconds(path):
    """Times by name from the report of a whole run of the tests."""
    text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    found = re.findall(r'<testcase name="([^"]+)"[^>]* time="([\d.]+)"', text)
    return {name: float(seconds) for name, seconds in found}


def end_session(session):
    """Kill all of a session: check gives each test a group of its own, which keeps the pipe open."""
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if os.getsid(int(entry.name)) == session:
                os.kill(int(entry.name), signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            continue


class Workplace:
    """Under build/mutate/<number>; the checkout itself is never touched."""

    def __init__(self, root, number, short=False):
        self.source = root
        self.root = root / "build/mutate" / str(number)
        self.build = self.root / "build/release"
        self.tests = []
        self.seconds = {}
        self.short = {"FRAM_TEST_SHORT": "1"} if short else {}
        self.told = told_seconds(root / "build/release/tests.xml")
        self.broken = set()

    def prepare(self):
        """Bring the copy to the state of the checkout; files that are equal keep their time, so little is built."""
        listing = subprocess.run([self.source / "tools/sources.sh"], stdout=subprocess.PIPE, text=True, check=True)
        names = set(listing.stdout.splitlines())
        for name in names:
            self.bring(name)
        for folder in ("src", "tests", "include", "fuzz"):
            for path in (self.root / folder).rglob("*"):
                if path.is_file() and str(path.relative_to(self.root)) not in names:
                    path.unlink()
        words = ["cmake", "--preset", "release", "--log-level=WARNING"]
        done = subprocess.run(words, cwd=self.root, capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(done.stdout + done.stderr)
        listing = subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, capture_output=True, text=True,
                                 check=True)
        self.tests = [self.test(t) for t in json.loads(listing.stdout)["tests"]]
        for test in self.tests:
            source = self.root / "tests" / f"{test['room']}/test_{test['name'].split('/', 1)[1]}.c"
            test["source"] = source.read_text(encoding="utf-8") if source.exists() else ""
        self.tests = [t for t in self.tests if t["room"] not in LEFT_OUT]

    @staticmethod
    def test(told):
        """name, room, words and environment of a test."""
        properties = {p["name"]: p["value"] for p in told["properties"]}
        environment = dict(p.split("=", 1) for p in properties.get("ENVIRONMENT", []))
        return {"name": told["name"], "room": told["name"].split("/")[0], "words": told.get("command") or [],
                "environment": environment}

    def bring(self, name):
        """Copy a file from the checkout unless it is equal."""
        source, target = self.source / name, self.root / name
        if target.exists() and target.read_bytes() == source.read_bytes():
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)
        os.utime(target)

    def put(self, path, text):
        """Write a text in place of a file of the checkout; its name in the copy."""
        target = self.root / path.relative_to(self.source)
        target.write_text(text, encoding="utf-8")
        return target

    def restore(self, path):
        """The file as in the checkout."""
        self.bring(str(path.relative_to(self.source)))

    def program(self, test):
        """What must be built for a test."""
        # Not yet built: ctest does not know the command of a program that is not there.
        if re.match(r"^\w+/\w+$", test["name"]) and (self.root / "tests" / test["room"] /
                                                     f"test_{test['name'].split('/')[1]}.c").exists():
            return f"test_{test['name'].replace('/', '_')}"
        return None

    def make(self, test):
        """Build what the test needs; the compiler's words when that fails."""
        target = self.program(test)
        targets = [target] if target else ["fram_command", "fram_shared", "fram_static", "example_controller"]
        done = subprocess.run(["ninja", "-C", str(self.build), "-j1", *targets], capture_output=True, text=True,
                              check=False)
        return None if done.returncode == 0 else done.stdout[-3000:] + done.stderr[-1000:]

    def run(self, test, patience):
        """(passed, what it said, seconds)"""
        target = self.program(test)
        words = [str(self.build / "tests" / target)] if target else test["words"]
        began = time.monotonic()
        # A session of its own, so that a test that hangs goes with all that it started.
        environment = {**os.environ, **test["environment"], **self.short}
        process = subprocess.Popen(words, cwd=self.root, env=environment, text=True, errors="replace",
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            out, _ = process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            end_session(process.pid)
            process.communicate()
            return False, "hangs", time.monotonic() - began
        return process.returncode in (0, 77), out, time.monotonic() - began

    def usual(self, test):
        """Time of a test without a fault [s], as measured here or by the last `make test`; a guess where neither is."""
        return self.seconds.get(test["name"], self.told.get(test["name"], 1.0))

    def know(self, test):
        """Run the test without a fault, once: its time; None when it fails by itself."""
        name = test["name"]
        if name not in self.seconds:
            problem = self.make(test)
            if problem:
                raise RuntimeError(problem)
            good, out, seconds = self.run(test, 600)
            self.seconds[name] = seconds
            if not good:
                self.broken.add(name)
                print(f"mutate: {name} fails without a fault and is left out: {out[-500:]}", flush=True)
        return None if name in self.broken else self.seconds[name]


def likely(test, path):
    """The test to try first: words of its name that are in the file's; it calls what the file is named for."""
    mine = set(re.split(r"[_/]", test["name"].split("/", 1)[1]))
    return len(mine & set(path.stem.split("_"))) + 2 * (path.stem in test["source"])


def first_failure(text):
    """The test function that failed, from what libcheck or Python says."""
    found = re.search(r":[FE]:[^:]*:([^:]*):", text) or re.search(r"^(?:FAIL|ERROR): (\w+)", text, re.M)
    return found[1] if found else ("hangs" if text == "hangs" else "")


