#!/usr/bin/env python3
"""Scenes of users: what a step costs, beside an older build of Fram.

Every scene in turn, the older program and this one after each other in each round, with one and with two threads.
--old names the command of an older version, built elsewhere; without it, or where it refuses a scene, there is no
ratio.  Times are process CPU time of one thread and the least of the rounds, since other work on a machine only adds to
it; real-time factors are the best of the rounds, by wall time, and are less than the machine could do where it was
shared.  Give --write to put the table into the results.
"""

import argparse
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile

import kept_page

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import machine  # noqa: E402  (tools)

NEW = ROOT / "build" / "release" / "fram"
RESULTS = ROOT / "bench" / "results" / "users.md"

FIELD = """
title: A field of floes and an icebreaking hull
run: {{duration: 60, time_step: 0.02, seed: 1, scale: 1}}
vessel:
  mode: towed
  x: {start}
  y: 0
  heading_deg: 0
  speed: 2
  ramp: 5
  hull: {{form: icebreaker, length: 100, beam: 20, draught: 7, freeboard: 4, stem_angle_deg: 30, entrance_angle_deg: 32,
         flare_angle_deg: 10, stern_angle_deg: 30, parallel_midbody: 0.45}}
ice: {{source: voronoi, concentration: {cover}, mean_floe_area: 80, size_deviation: 0.7, roundness: 0.2, thickness: 1,
      density: 910, crushing_strength: 2.0e6{breaking}}}
domain: {{x_min: -{half}, x_max: {half}, y_min: -{half}, y_max: {half}, boundary: walls}}
environment: {{current_speed: 0.3, wind_speed: {wind}}}
"""
BREAKING = ", breakable: true"


def field(half, wind, breaking="", cover=0.8):
    return FIELD.format(half=half, start=-half + 70, wind=wind, breaking=breaking, cover=cover)


SCENES = {
    "demo": "scenes/demo.yaml",
    "field_12k": field(490, 0),
    "field_12k_wind": field(490, 8),
    "field_12k_breaking": field(490, 8, BREAKING),
    "field_10k_90": field(447, 0, BREAKING, 0.9),
    "level_ice": "scenes/level_ice.yaml",
    "uikku_303": "scenes/uikku_303.yaml",
    "conical_unit": "scenes/conical_unit.yaml",
    "supply_ship": "scenes/supply_ship.yaml",
    "turret_ship": "scenes/turret_ship.yaml",
    "real_input": "scenes/real_input.yaml",
    "field_100k": field(1415, 8),
}


# Until the vessel is well in the ice [s]; others: --warm.
WARM = {"level_ice": 40, "uikku_303": 100}


def bench(program, scene, warm, time, threads):
    words = [program, "bench", scene, "--warm", warm, "--time", time, "--threads", threads, "--json", "--quiet"]
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, cwd=ROOT)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}"
    return json.loads(done.stdout.splitlines()[-1]), None


def measure(name, scene, options):
    """The row of one scene, or what went wrong."""
    news, olds, twos = [], [], []
    for _ in range(options.repeat):
        for program, threads, to in ((options.old, 1, olds), (NEW, 1, news), (NEW, 2, twos)):
            if program is None:
                continue
            result, reason = bench(program, scene, WARM.get(name, options.warm), options.time, threads)
            if result is not None:
                to.append(result)
            elif to is not olds:
                return {"scene": name, "reason": reason}
    best = min(news, key=lambda r: r["ms_per_step_median"])
    old = min((r["ms_per_step_median"] for r in olds), default=None)
    row = {"scene": name, "floes": best["floes"], "median": best["ms_per_step_median"],
           "floe": best["us_per_floe_step"],
           "mean": best["ms_mean"], "p999": best["ms_p999"], "longest": best["ms_longest"],
           "one": max(r["real_time_factor"] for r in news), "two": max(r["real_time_factor"] for r in twos),
           "shares": [best["share_" + s] for s in ("forces", "collision", "solver", "crushing", "fracture")]}
    row["ratio"] = old / best["ms_per_step_median"] if old else None
    return row


def line(row):
    if "reason" in row:
        return f"| {row['scene']} | not run: {row['reason']} |" + " |" * 13
    ratio = f"{row['ratio']:.2f}" if row["ratio"] else "-"
    shares = " | ".join(f"{100 * s:.0f}" for s in row["shares"])
    return (f"| {row['scene']} | {row['floes']} | {row['median']:.3f} | {row['floe']:.3f} | {ratio} | "
            f"{row['mean']:.3f} | {row['p999']:.2f} | {row['longest']:.2f} | {row['one']:.2f} | {row['two']:.2f} | "
            f"{shares} |")


def page(rows, options):
    compiler = subprocess.run(["cc", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    head = "| scene | floes | median ms | us per floe | old/new | mean ms | 99.9 % ms | longest ms |" \
           " real time, 1 thread | 2 threads | forces % | collision % | solver % | crushing % | fracture % |"
    return "\n".join([
        "# Scenes of users", "",
        f"{datetime.date.today()}; {machine.processor()}; {compiler}; load average {machine.load()} at the end.",
        f"`bench/run_users.py`, rounds: {options.repeat}; {options.warm:g} s of warm-up "
        f"({', '.join(f'{name} {warm} s' for name, warm in WARM.items())}) and {options.time:g} s measured; old "
        "and new after each other in each round.", "",
        "CPU time of one thread, the least of the rounds; shares, mean and long steps are those of that round.",
        "old/new is the ratio of median steps; -: the older program refuses the scene. What happens may differ",
        "between the programs. Real-time factors are by wall time, the best of the rounds: on a shared machine they",
        "are lower than it could do, and those of two threads may be lower than those of one. With fewer than",
        "1,000 steps the 99.9 % rank is the longest step. A vessel that has not reached the ice tells of ice at rest.",
        "",
        head, "|" + "---|" * 15, *map(line, rows), ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--old", type=pathlib.Path, help="the command of an older build")
    parser.add_argument("--repeat", type=int, default=3, help="rounds (%(default)s)")
    parser.add_argument("--only", nargs="+", choices=sorted(SCENES), help="scenes, default all")
    parser.add_argument("--warm", type=float, default=2, help="before the measuring (%(default)s) [s]")
    parser.add_argument("--time", type=float, default=4, help="measured (%(default)s) [s]")
    parser.add_argument("--write", action="store_true",
                        help="write the page of all scenes, bench/results/users.md; what stands there by hand is kept")
    parser.add_argument("--out", type=pathlib.Path, help="write the page of these scenes to another file")
    options = parser.parse_args()
    if options.write and options.only:
        parser.error("--write is of all scenes, whose page has one date and one machine: leave out --only, or give "
                     "--out FILE")
    for program in (NEW, options.old):
        if program is not None and not program.exists():
            sys.exit(f"run_users: there is no {program}: build it first")
    if options.repeat < 1:
        sys.exit("run_users: --repeat must be 1 or more")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, scene in SCENES.items():
            if options.only and name not in options.only:
                continue
            path = scene
            if "\n" in scene:
                path = pathlib.Path(folder) / f"{name}.yaml"
                path.write_text(scene)
            rows.append(measure(name, path, options))
            print(line(rows[-1]), flush=True)
    for path in ([RESULTS] if options.write else []) + ([options.out] if options.out else []):
        kept_page.write(path, page(rows, options))


if __name__ == "__main__":
    main()
