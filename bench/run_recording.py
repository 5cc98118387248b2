#!/usr/bin/env python3
"""What recording costs: its part of the run time, and bytes per moving floe and frame; bench/results/recording.md.

Each scene runs a few times with all that is written by default.  A run tells in run.json what its recording took, by
its own clock; the middle one of the rounds is told.  Bounds: 5 % of run time, 20 bytes per moving floe and frame, 25
where ice breaks.  Give --write to put the table into the results.
"""
import argparse
import json
import os
import pathlib
import statistics
import struct
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
import machine  # noqa: E402  (tools)

RESULTS = HERE / "results" / "recording.md"
ABOUT = """# What recording costs

`make bench-recording` (`bench/run_recording.py`); one thread on one core of a shared virtual machine.
Every run measures itself: `run.json` has `wall_s`, `recording_s` of it for all that is written (rows of the series,
frames, checkpoints, pictures and figures at the end; waiting for the disk included) and `recording_end_s`, the part at
the end, which does not grow with the run. Told is the middle of the rounds with everything as the scene says, and the
least and most of them. *Load* is how many programs wanted the machine's two cores meanwhile (the system's average over
a minute, before and after): both times are of the clock, so that a busy machine adds to each, and more to recording,
which sometimes waits for the disk and then for a core. Lengths are those of the managed field, of `make scenes`, two
minutes for 10,000 floes, and of the demo, whose floes break. Bytes are all of the record: frames, forces on the vessel,
outlines, the hull, the scenario. Bounds: 5 % of the run time, 20 bytes per moving floe and frame, 25 where ice breaks.

"""
AFTER = """
What does not grow with the run is about 0.1 s: a run of a second or two is not within the bound on time, nor one of a
few frames within that on bytes, for outlines, written once for each floe and each piece that breaks off, take about 130
bytes. Why it is as it is stands in [decision 0050](../../docs/decisions/0050-recording-tells-its-cost.md).
"""
HEADS = ("| scene | s | bodies that move | frames | record | bytes per moving body and frame | run time | of it for "
         "recording | least to most | of that at the end | rounds | load | date | processor |")
MOST_PART, MOST_BYTES, MOST_BYTES_BREAKING = 5.0, 20.0, 25.0
# Scene, how long it runs [s], and its bound on bytes.
SCENES = (("scenes/managed_ice.yaml", 60, MOST_BYTES), ("scenes/supply_ship.yaml", 600, MOST_BYTES),
          ("bench/playback.yaml", 120, MOST_BYTES), ("scenes/demo.yaml", 75, MOST_BYTES_BREAKING))
HEAD, FRAME = 24, 15


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


def kept_rows():
    """Rows of the results by scene, as they are."""
    lines = RESULTS.read_text(encoding="utf-8").splitlines() if RESULTS.exists() else []
    whole = [line for line in lines if line.count("|") == HEADS.count("|") and ".yaml" in line]
    return {line.split("|")[1].strip(): line for line in whole}


def scene_of(word):
    """A scene with a row, by its file or its name."""
    for scene, *_ in SCENES:
        if word in (scene, pathlib.Path(scene).stem):
            return scene
    raise argparse.ArgumentTypeError(f"{word} is none of {', '.join(pathlib.Path(s).stem for s, *_ in SCENES)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fram", default=HERE.parent / "build" / "release" / "fram")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--write", action="store_true", help="put the rows into bench/results/recording.md")
    parser.add_argument("scenes", nargs="*", type=scene_of, help="of those with a row, as demo; default all")
    options = parser.parse_args()
    broken, rows = [], kept_rows()
    for scene, seconds, most_bytes in SCENES:
        if options.scenes and scene not in options.scenes:
            continue
        load = [os.getloadavg()[0]]
        with tempfile.TemporaryDirectory() as base:
            told = [run(options.fram, HERE.parent / scene, seconds, pathlib.Path(base) / str(k))
                    for k in range(options.rounds)]
            size, frames, bodies, total = bytes_per_pose(pathlib.Path(base) / "0" / "record.fram")
        load.append(os.getloadavg()[0])
        parts = sorted(100 * t["recording_s"] / t["wall_s"] for t in told)
        part = statistics.median(parts)
        end = statistics.median(t["recording_end_s"] for t in told)
        wall = statistics.median(t["wall_s"] for t in told)
        rows[scene] = (f"| {scene} | {seconds} | {bodies:.0f} | {frames} | {total / 1e6:.1f} MB | {size:.1f} | "
                       f"{wall:.2f} s | {part:.1f} % | {parts[0]:.1f} to {parts[-1]:.1f} % | {end:.2f} s | "
                       f"{options.rounds} | {min(load):.0f} to {max(load):.0f} | {time.strftime('%Y-%m-%d')} | "
                       f"{machine.processor()} |")
        print(rows[scene], flush=True)
        if part > MOST_PART:
            broken.append(f"{scene}: {part:.1f} % of the run time is recording")
        if size > most_bytes:
            broken.append(f"{scene}: {size:.1f} bytes")
    if options.write:
        table = "\n".join([HEADS, "|---" * (HEADS.count("|") - 1) + "|"] + [rows[s] for s, *_ in SCENES if s in rows])
        RESULTS.write_text(ABOUT + table + "\n" + AFTER, encoding="utf-8")
    for one in broken:
        print("BROKEN: " + one)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
