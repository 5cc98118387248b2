#!/usr/bin/env python3
"""What a terminal shows while a run goes on: a progress line that fits it, and warnings on lines of their own."""
import fcntl
import os
import pathlib
import pty
import re
import struct
import subprocess
import tempfile
import termios

FRAM = os.environ["FRAM"]
# It meets no ice, which it is warned of when its progress line is drawn.
SCENE = """
run: {duration: 20, time_step: 0.02}
vessel: {mode: towed, x: 40, speed: 1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: floes, floes: [{x: -40, length: 9, width: 9}]}
domain: {x_min: -64, x_max: 160, y_min: -40, y_max: 40, boundary: open}
"""
STUDY = """
scenario: scene.yaml
vary: {grid: {vessel.speed: [1, 2]}}
seeds: 2
"""


def shown(folder, columns, *words, term="xterm"):
    """What comes to a terminal that is so wide."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    environment = {**{k: v for k, v in os.environ.items() if k != "TERM"}, **({"TERM": term} if term else {})}
    process = subprocess.Popen([FRAM, *words], cwd=folder, stderr=theirs, stdout=subprocess.DEVNULL, env=environment)
    os.close(theirs)
    text = b""
    while True:
        try:
            piece = os.read(ours, 1 << 16)
        except OSError:
            piece = b""
        if not piece:
            break
        text += piece
    os.close(ours)
    assert process.wait() == 0, text
    return text.decode()


def drawn(text):
    """What stood in a line at some time."""
    return [line for line in re.split(r"(?:\r\033\[K|\r|\n)+", text) if line]


def check_run(folder):
    for columns in (40, 60, 100):
        text = shown(folder, columns, "run", "scene.yaml", "-o", f"wide-{columns}")
        lines = drawn(text)
        progress = [line for line in lines if re.match(r" *[0-9.]+ %", line)]
        assert progress and max(map(len, progress)) < columns, (columns, progress)
        assert all(re.search(r"  left (not known yet|.*\d s|less than 1 s)$", line) for line in progress), progress
        assert any("real-time factor" in line for line in progress) == (columns == 100), progress
        warnings = [line for line in lines if "warning: " in line]
        assert warnings and all(line.startswith("warning: ") for line in warnings), warnings
    # Who draws over nothing gets lines, and no escape.
    for term in ("dumb", None):
        text = shown(folder, 60, "run", "scene.yaml", "-o", f"term-{term}", term=term)
        assert "\033" not in text and "100.0 %  t = 20.00 of 20 s  real-time factor" in text, text
        assert all(re.match("warning: ", line) for line in drawn(text) if "warning: " in line), text


def check_study(folder):
    (folder / "study.yaml").write_text(STUDY)
    lines = drawn(shown(folder, 20, "study", "study.yaml", "-o", "study"))
    progress = [line for line in lines if re.match(r"\d+ of \d+ runs", line)]
    assert "4 of 4 runs" in progress and max(map(len, progress)) < 20, progress


with tempfile.TemporaryDirectory() as there:
    (pathlib.Path(there) / "scene.yaml").write_text(SCENE)
    check_run(pathlib.Path(there))
    check_study(pathlib.Path(there))
