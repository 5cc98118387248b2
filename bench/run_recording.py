#!/usr/bin/env python3
"""What recording costs: run time with and without it, and bytes per moving floe and frame; bench/results/recording.md.

Each scene runs in turn with all that is written by default, with frames only, and with next to nothing written; ratios
are taken within a round, and the middle one of the rounds is told.  Bounds: 5 % of run time, 20 bytes per moving floe
and frame.  Give --write to put the table into the results.
"""
import argparse
import json
import pathlib
import platform
import statistics
import struct
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ABOUT = """# What recording costs

`make bench-recording` (`bench/run_recording.py`), {day}; {processor}, one thread on one core of a shared virtual
machine, nothing else running. Every row of the series, frames and checkpoints as the scene says, and the pictures at
the end, against a run that writes next to nothing; middle of {rounds} rounds of both in turn. Bytes are all of the
record: frames, forces on the vessel, outlines, the hull, the scenario. Bounds: 5 % of the run time, 20 bytes per moving
floe and frame.

"""
MOST_PART, MOST_BYTES = 5.0, 20.0
# Scene, shortened to so many seconds.  Frames and checkpoints as the scene or the defaults say.
SCENES = (("scenes/demo.yaml", 60), ("scenes/supply_ship.yaml", 120), ("bench/playback.yaml", 24))
NOTHING = ("output.frame_interval=0", "output.checkpoint_interval=0", "output.csv_interval=10000")
WAYS = {"all": (), "nothing": NOTHING}
HEAD, FRAME = 24, 8


def run(fram, scene, seconds, sets, folder):
    words = [fram, "run", scene, "-o", folder, "-q", "--force", "--until", str(seconds), "--threads", "1"]
    for one in sets:
        words += ["--set", one]
    subprocess.run([str(w) for w in words], check=True)
    return json.loads((folder / "run.json").read_text())["wall_s"]


def bytes_per_pose(record):
    """Bytes of the whole record over the poses in it, and its frames."""
    data, at, poses, frames = record.read_bytes(), HEAD, 0, 0
    while at + HEAD <= len(data):
        kind, size = struct.unpack_from("<IQ", data, at + 4)
        if kind == FRAME:
            poses += struct.unpack_from("<i", data, at + HEAD + 40)[0]
            frames += 1
        at += HEAD + (size + 7) // 8 * 8
    return len(data) / poses, frames, poses / frames, len(data)


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.machine()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fram", default=HERE.parent / "build" / "release" / "fram")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--write", action="store_true", help="put the table into bench/results/recording.md")
    options = parser.parse_args()
    lines = ["| scene | s | bodies that move | frames | record | bytes per moving body and frame | run time | of it "
             "for recording |", "|---|---|---|---|---|---|---|---|"]
    broken = []
    for scene, seconds in SCENES:
        times = {way: [] for way in WAYS}
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for _ in range(options.rounds):
                for way, sets in WAYS.items():
                    times[way].append(run(options.fram, HERE.parent / scene, seconds, sets, folder / way))
            size, frames, bodies, total = bytes_per_pose(folder / "all" / "record.fram")
        part = 100 * statistics.median(1 - b / a for a, b in zip(times["all"], times["nothing"]))
        lines.append(f"| {scene} | {seconds} | {bodies:.0f} | {frames} | {total / 1e6:.1f} MB | {size:.1f} | "
                     f"{statistics.median(times['all']):.2f} s | {part:.1f} % |")
        if part > MOST_PART:
            broken.append(f"{scene}: {part:.1f} % of the run time is recording")
        if size > MOST_BYTES and bodies > 100:
            broken.append(f"{scene}: {size:.1f} bytes")
    text = "\n".join(lines)
    print(text)
    if options.write:
        head = ABOUT.format(day=time.strftime("%Y-%m-%d"), processor=processor(), rounds=options.rounds)
        (HERE / "results" / "recording.md").write_text(head + text + "\n", encoding="utf-8")
    for one in broken:
        print("BROKEN: " + one)
    sys.exit(1 if broken else 0)


main()
