#!/usr/bin/env python3
"""What reading costs in Python: all poses and outlines of 10,000 floes after each step, beside the step itself.

In a field nearly without contact, whose steps are the shortest there are, and in one that a ship breaks.

FRAM_LIBRARY names the library (default: that of build/release).  Give --write to put the tables into the results."""

import argparse
import datetime
import os
import pathlib
import platform
import statistics
import sys
import textwrap
import time

import kept_page

ROOT = pathlib.Path(__file__).resolve().parent.parent
os.environ.setdefault("FRAM_LIBRARY", str(ROOT / "build/release/libfram.so"))
sys.path[:0] = [str(ROOT / "bindings/python"), str(ROOT / "tools")]
import machine  # noqa: E402  (tools)

SCENE = """
run: {time_step: 0.02, duration: 100}
vessel: {mode: towed, x: -400, speed: 2, ramp: 1, hull: {length: 76, beam: 16, draught: 6, freeboard: 4}}
ice: {source: voronoi, concentration: 0.8, mean_floe_area: 64, thickness: 0.5}
domain: {x_min: -500, x_max: 500, y_min: -400, y_max: 400}
"""
PUSHED = """
run: {time_step: 0.02, duration: 100}
vessel: {mode: towed, x: -250, speed: 3, ramp: 0.1, hull: {length: 76, beam: 16, draught: 6, freeboard: 4}}
ice: {source: voronoi, concentration: 0.8, mean_floe_area: 64, thickness: 0.5, breakable: true}
domain: {x_min: -500, x_max: 500, y_min: -400, y_max: 400}
"""
BOUND = 0.02
STEPS, PAIRS = 60, 400


def median_of(calls, rounds=STEPS):
    """Median computing time of each of several calls, taken in turn [s]. Wall time would tell a step, which others
    interrupt, as longer than it is beside short calls, which nobody interrupts."""
    times = [[] for _ in calls]
    for _ in range(rounds):
        for call, list_of in zip(calls, times):
            before = time.thread_time()
            call()
            list_of.append(time.thread_time() - before)
    return [statistics.median(list_of) for list_of in times]


def measure(name, scene, warm):
    """A section of the page: the calls in turn, and steps with and without reading in turn."""
    import fram
    world = fram.Scenario.from_text(scene).world()
    world.step(warm)
    broken, shapes, renewals = 0, world.shapes(), []
    view = world.view()

    def fast():
        return view.position, view.orientation, world.shapes()

    def with_reading():
        world.step()
        fast()

    calls = {"step": world.step, "poses by view and outlines in body axes (no copy)": fast,
             "the same, positions and orientations copied":
                 lambda: (view.position.copy(), view.orientation.copy(), world.shapes()),
             "outlines in global axes": world.outlines, "bodies (copies of all columns)": lambda: world.bodies("floe"),
             "contacts": world.contacts, "all channels": world.values}
    times = median_of(calls.values())
    nothing = median_of([world.step, lambda: (len(calls), len(scene))])[1]
    without, read = median_of([world.step, with_reading], PAIRS)
    for _ in range(STEPS):
        world.step()
        broken += len(world.fractures()) > 0
        before = time.thread_time()
        now = world.shapes()
        if now is not shapes:
            renewals.append(time.thread_time() - before)
            shapes = now
    world.step(1)
    rows = "".join(f"| {call} | {1e3 * t:.4f} | {100 * t / times[0]:.2f} % |\n" for call, t in zip(calls, times))
    full = 100 * (times[3] + times[4]) / times[0]
    return "\n".join([
        f"## {name}\n",
        f"{int(world['floes'])} floes, {len(world.contacts())} contact points; floes broke in {broken} of {STEPS}",
        f"steps, and outlines were made anew in {len(renewals)}" +
        (f", which took {1e3 * statistics.mean(renewals):.2f} ms each and "
         f"{100 * sum(renewals) / STEPS / times[0]:.2f} % of the time of all.\n" if renewals else ".\n"),
        "| call | ms | share of a step |\n|---|---|---|\n" + rows,
        f"A step with poses and outlines read after it and one without, in turn: {1e3 * read:.3f} and",
        f"{1e3 * without:.3f} ms, {PAIRS} of each: {100 * (read / without - 1):+.2f} % (bound: {100 * BOUND:g} %). A",
        f"line of Python that reads nothing takes {1e3 * nothing:.4f} ms after a step, poses and outlines",
        f"{1e3 * times[1]:.4f} ms.",
        f"With global outlines and copies of all columns it is {full:.1f} %.\n"])


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--write", action="store_true",
                       help="write bench/results/python.md; what stands there by hand is kept")
    options = words.parse_args()
    head = (f"{datetime.date.today()}; {machine.processor()}; Python {platform.python_version()}; load average "
            f"{machine.load()} at the start. One thread, medians of computing time over {STEPS} steps, by "
            "`bench/run_python.py`. Outlines in the axes of their bodies are "
            "made when a floe breaks, comes or goes, and are the same arrays until then; poses are the world's own "
            "memory. A call by itself pays for an interpreter that a step has put out of the caches; a step with "
            "reading and one without tell what reading adds, as far as the machine's other work lets them.")
    text = "\n\n".join(["# Reading a world from Python", textwrap.fill(head, 119),
                         measure("Nearly without contact", SCENE, 20) + "\n" +
                         measure("Pushed and broken by a ship", PUSHED, 150)])
    if options.write:
        kept_page.write(ROOT / "bench/results/python.md", text)
    print(text)
    return 0  # what falls short stands in docs/limits.md


if __name__ == "__main__":
    sys.exit(main())
