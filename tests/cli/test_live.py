#!/usr/bin/env python3
"""`fram run --live` as a client on this machine meets it: the address that is printed, the record as it grows, the end.

Skipped (77) without libmicrohttpd or the viewer's page.
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.parse
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

FRAM = os.environ["FRAM"]
SCENE = """
run: {duration: 4, time_step: 0.02}
vessel: {mode: towed, speed: 2, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {mean_floe_area: 64, concentration: 0.7, breakable: true}
domain: {x_min: -64, x_max: 96, y_min: -40, y_max: 40}
output: {frame_interval: 0.1}
"""


def fetch(address):
    with urllib.request.urlopen(address, timeout=60) as answer:
        return answer.headers, answer.read()


def follow(address, enough=float("inf"), stop=None):
    """The whole record, as a page gets it; and in how many pieces.  stop: called when there are enough bytes."""
    record, pieces = b"", 0
    while True:
        headers, piece = fetch(f"{address}record?from={len(record)}")
        record += piece
        pieces += piece != b""
        if stop and len(record) >= enough:
            stop()
            stop = None
        if headers["Fram-Run"] == "ended":
            return record, pieces
        time.sleep(0.02)


def start(*words):
    run = subprocess.Popen([FRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for line in run.stderr:
        if line.startswith("live view: "):
            return run, line.split()[-1]
    raise AssertionError(f"no address: {run.wait()}")


def watch(*words):
    """The record that a client saw, and what the command answered."""
    run, address = start(*words)
    host = urllib.parse.urlsplit(address).hostname
    assert host == "127.0.0.1", address
    _, page = fetch(address)
    assert b'data-beside="record"' in page and b"<!--RECORD-->" not in page, "this is no page that follows a record"
    record, pieces = follow(address)
    out, _ = run.communicate(timeout=120)
    assert run.returncode == 0, run.returncode
    try:
        fetch(address)
    except urllib.error.URLError:
        pass
    else:
        raise AssertionError("somebody answers when the run has ended")
    return record, pieces, json.loads(out)


def record_of(seen, folder):
    """The run's record out of what a client saw; behind it stand the loads of the vessel and its peaks."""
    record = (folder / "record.fram").read_bytes()
    assert seen[:len(record)] == record, "the client saw another record"
    behind = seen[len(record):]
    loads = json.loads(behind[behind.index(b'{"mechanisms"'):].rstrip(b"\0"))
    assert len(loads["vessels"]) == 1 and loads["vessels"][0]["peaks"], loads
    return record


def check(folder):
    scene = folder / "scene.yaml"
    scene.write_text(SCENE)
    plain = subprocess.run([FRAM, "run", scene, "-o", folder / "plain", "--quiet", "--json"], check=True,
                           capture_output=True, text=True)
    seen, pieces, answer = watch("run", scene, "-o", folder / "run", "--json", "--quiet", "--live")
    record = record_of(seen, folder / "run")
    assert record == (folder / "plain/record.fram").read_bytes(), "the record is another one when somebody looks on"
    assert answer["state_hash"] == json.loads(plain.stdout)["state_hash"]
    # What stood in the folder before is not shown as if it were this run.
    _, _, answer = watch("run", scene, "-o", folder / "run", "--json", "--live", "--force", "--until", "2")
    assert answer["finished"] is False
    seen, _, answer = watch("resume", folder / "run", "--json", "--live")
    record = record_of(seen, folder / "run")
    assert record == (folder / "plain/record.fram").read_bytes()
    # Who looks on at a run that is interrupted gets its loads and peaks too; the ship meets ice before 4 s.
    run, address = start("run", scene, "-o", folder / "cut", "--quiet", "--live", "--set", "run.duration=400")
    seen, _ = follow(address, 1.1 * len(record), lambda: run.send_signal(signal.SIGINT))
    run.communicate(timeout=120)
    assert run.returncode == 130, run.returncode
    record_of(seen, folder / "cut")
    print(f"the record of {len(record)} bytes came in {pieces} pieces")


def main():
    if "libmicrohttpd" not in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
        skip("this build has no libmicrohttpd")
    if not (pathlib.Path(FRAM).parent.parent / "viewer/playback.html").exists():
        skip("the viewer's page is not there (make viewer)")
    with tempfile.TemporaryDirectory(prefix="fram-live-") as folder:
        check(pathlib.Path(folder))


main()
