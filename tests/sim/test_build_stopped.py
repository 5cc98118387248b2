#!/usr/bin/env python3
"""Ctrl-C while a scenario is built: the making of the ice ends, with one error, exit code 130 and nothing written.

Each scene would take many minutes to build.  The signal comes with the first word about how far the work is, so that
the making has begun; a making that does not listen runs into the watchdog.
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

FRAM = os.environ["FRAM"]
WATCHDOG = 300  # [s]; generous: no clock decides whether the test passes
WIDE = "domain: {x_min: -4000, x_max: 4000, y_min: -4000, y_max: 4000, boundary: open}\n"
SCENES = {
    "packed": "ice: {source: packed, concentration: 0.85, populations: [{size: constant, diameter: 20}]}\n" + WIDE,
    "sized": "ice: {concentration: 0.9, populations: [{size: lognormal, diameter: 10}]}\n" + WIDE,
    "voronoi": "ice: {concentration: 0.9, mean_floe_area: 40}\n" + WIDE,
    "level": "ice: {source: level, level: {tile_size: 8}}\n" + WIDE,
}
failures = []


def check(good, what):
    if not good:
        failures.append(what)


def interrupt(words, folder, number):
    """The words of the progress, the exit code and the last line of the answer."""
    with subprocess.Popen([FRAM, *words, "--json"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True) as process:
        try:
            heard = ""
            while not re.search(r": (\d+ %|round \d)", heard):
                heard = process.stderr.readline()
                if not heard:
                    break
            process.send_signal(number)
            out, err = process.communicate(timeout=WATCHDOG)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return heard, None, "", ""
    return heard, process.returncode, err, out.splitlines()[-1] if out else ""


with tempfile.TemporaryDirectory() as folder:
    for name, text in SCENES.items():
        pathlib.Path(folder, name + ".yaml").write_text("vessel: {present: false}\n" + text)
    cases = [("run", "packed", signal.SIGINT), ("run", "level", signal.SIGTERM), ("run", "sized", signal.SIGINT),
             ("check", "level", signal.SIGINT), ("field", "voronoi", signal.SIGTERM),
             ("bench", "packed", signal.SIGINT)]
    for command, scene, number in cases:
        words = [command, scene + ".yaml"]
        words += ["-o", "out"] if command == "run" else ["--build"] if command == "check" else []
        heard, code, err, last = interrupt(words, folder, number)
        what = f"fram {' '.join(words)}"
        check(heard, f"{what}: no word about how far it is")
        check(code == 130, f"{what}: exit code {code}, {err}")
        check("interrupted while" in err, f"{what}: says {err}")
        error = json.loads(last or "{}").get("error", {})
        check(error.get("status") == "interrupted", f"{what}: answers {last}")
        check(not pathlib.Path(folder, "out").exists(), f"{what}: has left a folder")
for failure in failures:
    print("FAILED:", failure)
sys.exit(bool(failures))
