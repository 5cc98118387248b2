#!/usr/bin/env python3
"""What recording costs: its part of the run time, and bytes per moving floe and frame; bench/results/recording.md.

Each scene runs a few times with all that is written by default.  A run tells in run.json what its recording took, by
its own clock; the middle one of the rounds is told.  Bounds: 5 % of run time, 20 bytes per moving floe and frame.  Give
--write to put the table into the results.
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
machine, nothing else running. Every run measures itself: `run.json` has `wall_s`, `recording_s` of it for all that is
written (rows of the series, frames, checkpoints, pictures and figures at the end; waiting for the disk included) and
`recording_end_s`, the part at the end, which does not grow with the run; middle of {rounds} runs with everything as the
scene says. Lengths are those of the managed field, of `make scenes`, two minutes for 10,000 floes. Bytes are all of the
record: frames, forces on the vessel, outlines, the hull, the scenario. Bounds: 5 % of the run time, 20 bytes per moving
floe and frame.

"""
AFTER = """
The managed field is near the bound: single runs of it lay between 4.1 and 5.1 % earlier on 2026-11-22, on a busier
machine.
What does not grow with the run is about 0.1 s, half of it for `plan.png`: a run of a second or two is not within the
bound on time (120 s of the supply ship, 1.0 s, 11 %; 24 s of the 10,000 floes, 2.1 s, 6 %), nor one of a few frames
within that on bytes, for outlines, written once, take about 130 bytes a floe. Why it is as it is stands in [decision
0050](../../docs/decisions/0050-recording-tells-its-cost.md).
"""
MOST_PART, MOST_BYTES = 5.0, 20.0
# Scene and how long it runs [s].
SCENES = (("scenes/managed_ice.yaml", 60), ("scenes/supply_ship.yaml", 600), ("bench/playback.yaml", 120))
HEAD, FRAME = 24, 11


def run(fram, scene, seconds, folder):
    subprocess.run([str(w) for w in (fram, "run", scene, "-o", folder, "-q", "--set", f"run.duration={seconds}",
                                     "--threads", "1")], check=True)
    return json.loads((folder / "run.json").read_text())


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
             "for recording | of that at the end |", "|---|---|---|---|---|---|---|---|---|"]
    broken = []
    for scene, seconds in SCENES:
        with tempfile.TemporaryDirectory() as base:
            told = [run(options.fram, HERE.parent / scene, seconds, pathlib.Path(base) / str(k))
                    for k in range(options.rounds)]
            size, frames, bodies, total = bytes_per_pose(pathlib.Path(base) / "0" / "record.fram")
        part = 100 * statistics.median(t["recording_s"] / t["wall_s"] for t in told)
        end = statistics.median(t["recording_end_s"] for t in told)
        wall = statistics.median(t["wall_s"] for t in told)
        lines.append(f"| {scene} | {seconds} | {bodies:.0f} | {frames} | {total / 1e6:.1f} MB | {size:.1f} | "
                     f"{wall:.2f} s | {part:.1f} % | {end:.2f} s |")
        if part > MOST_PART:
            broken.append(f"{scene}: {part:.1f} % of the run time is recording")
        if size > MOST_BYTES:
            broken.append(f"{scene}: {size:.1f} bytes")
    text = "\n".join(lines)
    print(text)
    if options.write:
        head = ABOUT.format(day=time.strftime("%Y-%m-%d"), processor=processor(), rounds=options.rounds)
        (HERE / "results" / "recording.md").write_text(head + text + "\n" + AFTER, encoding="utf-8")
    for one in broken:
        print("BROKEN: " + one)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
