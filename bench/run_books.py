#!/usr/bin/env python3
"""Whether mechanisms and zones add up to the ice load in every step of every ready scene, to its end.

Runs bench/books_bench.c on each scenes/*.yaml, one after the other, the quick ones first, in the idle class of the
system's scheduler, and writes bench/results/books.csv and books.md after each.  A scene that was stopped (--most, or a
signal to this script) stands there with the time that it reached.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import textwrap
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path.insert(0, str(ROOT / "tools"))
from machine import processor  # noqa: E402  (tools)

RESULTS = HERE / "results"
BOUND = 1e-9
# Those that take longest, last.
LONG = ("supply_ship", "turret_ship", "conical_unit", "drillship", "uikku_303", "escort", "drillship_circle",
        "drillship_one_icebreaker", "drillship_two_icebreakers")
KEYS = ("scene", "time", "duration", "vessels", "steps", "loaded", "peak", "step", "zones", "row", "processor", "date",
        "commit")
ABOUT = """# Parts of the ice load and the load

`make books` (`bench/run_books.py`, `bench/books_bench.c`); {processor}. Every scene of `scenes/` is stepped from its
start to its end, or for as long as five minutes of a core last (`--most`): the scenes of an hour take hours, and their
ice and code are those of the others. Of such a scene the time that it reached is told. After every step, for every
vessel, in each axis, the sum of the parts is held against the ice load:

- *step*: the eight mechanisms, force and moment, as the step leaves them in memory;
- *zones*: the five zones of the hull, force, as the step leaves them;
- *row*: what a row of `series.csv` says, its twelve digits read back: mechanisms against the load, force and moment,
  zones and (at the cap, below it, friction) against the force.

Told is the largest difference of an axis over the largest load of that vessel in the whole scene (force for forces,
moment for moments). Bound: 1e-9. *Loaded* are steps with ice on a vessel.

{verdict}

"""


def git_commit():
    said = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    return said.stdout.strip()


def read_results():
    path = RESULTS / "books.csv"
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as f:
        return {row["scene"]: row for row in csv.DictReader(f)}


def is_good(row):
    return all(float(row[k]) <= BOUND for k in ("step", "zones", "row"))


def is_whole(row):
    return float(row["time"]) >= float(row["duration"]) * (1 - 1e-9)


def verdict(rows):
    steps = sum(int(r["steps"]) for r in rows)
    most = max(max(float(r[k]) for k in ("step", "zones", "row")) for r in rows)
    broken = [r["scene"] for r in rows if not is_good(r)]
    short = [f"{r['scene']} ({float(r['time']):.0f} of {float(r['duration']):.0f} s)" for r in rows if not is_whole(r)]
    all_scenes = len(list((ROOT / "scenes").glob("*.yaml")))
    text = f"In {steps:,} steps of {len(rows)} of {all_scenes} scenes the largest is {most:.1e}"
    text += f"; **over the bound: {', '.join(broken)}**." if broken else ", within the bound."
    return text + (f" Stopped before the end: {', '.join(short)}." if short else " Each of them went to its end.")


def write(results):
    RESULTS.mkdir(exist_ok=True)
    rows = [results[name] for name in sorted(results)]
    with (RESULTS / "books.csv").open("w", encoding="utf-8", newline="") as f:
        out = csv.DictWriter(f, KEYS, lineterminator="\n")
        out.writeheader()
        out.writerows(rows)
    lines = ["| scene | s | vessels | steps | loaded | largest load | step | zones | row | date | commit |",
             "|---|---|---|---|---|---|---|---|---|---|---|"]
    for r in rows:
        reached = f"{float(r['time']):g}" + ("" if is_whole(r) else f" of {float(r['duration']):g}")
        lines.append(f"| {r['scene']} | {reached} | {r['vessels']} | {int(r['steps']):,} | {int(r['loaded']):,} | "
                     f"{float(r['peak']) / 1e3:.1f} kN | {float(r['step']):.1e} | {float(r['zones']):.1e} | "
                     f"{float(r['row']):.1e} | {r['date']} | {r['commit']} |")
    head = ABOUT.format(processor=processor(), verdict=textwrap.fill(verdict(rows), 118, break_on_hyphens=False))
    (RESULTS / "books.md").write_text(head + "\n".join(lines) + "\n", encoding="utf-8")


def run(program, name, most, keep):
    """The last line of the scene's program; keep(line) for each."""
    scene = ROOT / "scenes" / f"{name}.yaml"
    with subprocess.Popen([str(program), str(scene), str(most)], stdout=subprocess.PIPE, text=True) as child:
        for line in child.stdout:
            keep(json.loads(line))
    return child.returncode


def order(names):
    return sorted(names, key=lambda n: (LONG.index(n) + 1 if n in LONG else 0, n))


def name_of(word):
    """A ready scene's name, by it or its file."""
    name = pathlib.Path(word).stem
    if word not in (name, f"scenes/{name}.yaml") or not (ROOT / "scenes" / f"{name}.yaml").exists():
        raise argparse.ArgumentTypeError(f"there is no scenes/{name}.yaml")
    return name


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bench", default=ROOT / "build" / "release" / "bench" / "books_bench")
    parser.add_argument("--most", type=float, default=300, help="processor time of a scene at most [s]")
    parser.add_argument("--now", action="store_true", help="not in the idle class, for short scenes")
    parser.add_argument("scenes", nargs="*", type=name_of, help="names of scenes, as demo, default all")
    options = parser.parse_args()
    if not options.now:
        os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
    names = options.scenes or [p.stem for p in (ROOT / "scenes").glob("*.yaml")]
    results, failed, where = read_results(), [], {"date": time.strftime("%Y-%m-%d"), "commit": git_commit()}
    for name in order(names):
        def keep(told, scene=name):
            results[scene] = {"scene": scene, **told, **where}
            write(results)
        code = run(options.bench, name, options.most, keep)
        print(name, "exit code", code, {k: results[name][k] for k in ("time", "step", "zones", "row", "processor")},
              flush=True)
        if code != 0:
            failed.append(name)
    sys.exit(f"BROKEN: {', '.join(failed)}" if failed else 0)


if __name__ == "__main__":
    main()
