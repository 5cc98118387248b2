#!/usr/bin/env python3
"""What reading costs in Python: all poses and outlines of 10,000 floes after each step, beside the step itself.

Writes bench/results/python.md; FRAM_LIBRARY names the library (default: that of build/release)."""

import os
import pathlib
import platform
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
os.environ.setdefault("FRAM_LIBRARY", str(ROOT / "build/release/libfram.so"))
sys.path.insert(0, str(ROOT / "bindings/python"))
import fram  # noqa: E402

SCENE = """
run: {time_step: 0.02, duration: 100}
vessel: {mode: towed, x: -400, speed: 2, ramp: 1, hull: {length: 76, beam: 16, draught: 6, freeboard: 4}}
ice: {source: voronoi, concentration: 0.8, mean_floe_area: 64, thickness: 0.5}
domain: {x_min: -500, x_max: 500, y_min: -400, y_max: 400}
"""
BOUND = 0.02
STEPS = 60


def median_of(calls):
    """Median computing time of each of several calls, taken in turn [s]. Wall time would tell a step, which others
    interrupt, as longer than it is beside short calls, which nobody interrupts."""
    times = [[] for _ in calls]
    for _ in range(STEPS):
        for call, list_of in zip(calls, times):
            before = time.thread_time()
            call()
            list_of.append(time.thread_time() - before)
    return [statistics.median(list_of) for list_of in times]


def main():
    world = fram.Scenario.from_text(SCENE).world()
    floes = int(world["floes"])
    world.step(20)
    names = ["step", "view (no copy)", "bodies (copies of poses and velocities)", "outlines", "contacts",
             "all channels"]
    times = median_of([world.step, world.view, lambda: world.bodies("floe"), world.outlines, world.contacts,
                       world.values])
    rows = "".join(f"| {name} | {1e3 * t:.3f} | {100 * t / times[0]:.2f} % |\n" for name, t in zip(names, times))
    share = (times[1] + times[3]) / times[0]
    share_copied = (times[2] + times[3]) / times[0]
    text = (f"# Reading a world from Python\n\n{floes} floes, one thread, medians of computing time over {STEPS} steps "
            f"({platform.processor() or platform.machine()}, Python {platform.python_version()}), by "
            "`bench/run_python.py`.\n\n| call | ms | share of a step |\n|---|---|---|\n" + rows +
            f"\nPoses by view and all outlines: {100 * share:.2f} % of a step; with copies of the poses instead "
            f"{100 * share_copied:.2f} % (bound: {100 * BOUND:g} %).\n")
    (ROOT / "bench/results/python.md").write_text(text)
    print(text)
    return 0  # what falls short stands in docs/limits.md


sys.exit(main())
