#!/usr/bin/env python3
"""What a floe costs in fields of 10,000, 50,000 and 100,000 floes with equally many touching pairs per floe:
bench/results/scale.md.

A field of 10,000 floes is packed by the current, its poses are taken as a new scene, and copies of that are laid side
by side across the current, 1, 5 and 10 of them, so that every floe has the neighbours that it had.  Sizes are run in
turn, one thread on one core; ratios are taken inside each round and their median is told.  Ends with code 1 when a
floe of a larger field costs more than 1.25 times as much.  Give --write to put the table into the results.
"""

import csv
import math
import pathlib
import statistics
import sys

import run_peers
import scene_file

BOUND = 1.25
BASE = 10000
COPIES = (1, 5, 10)
PACK = {90: 40, 98: 60}  # seconds until the current has pressed most of the field together
ABOUT = """# Cost per floe in larger fields

`bench/run_scale.py`, {date}; {processor}, {cores} cores of a shared virtual machine, one thread on one core;
{compiler}. 10,000 floes, packed by a current of 0.3 m/s ({packed}), and 5 and 10 copies of that field side by
side, so that touching pairs per floe are equal. Time step 0.02 s, 10 iterations, {warm:g} s unmeasured, {time:g} s
measured; median of {repeat} rounds in turn. Bound: {bound} times the cost in 10,000 floes.

| cover % | floes | ms a step | us per floe | over 10,000 | touching pairs per floe | contact points per floe | met |
|---|---|---|---|---|---|---|---|
"""


def packed_scene(options, cover):
    """The poses of 10,000 floes after a while in the current, as a scene, made once: floes lie level, turned about
    the vertical."""
    out = run_peers.WORK / "scenes" / f"packed{BASE}_c{cover}.scene"
    if out.exists():
        return out
    start, dump = run_peers.scene_of(BASE, cover), run_peers.WORK / "packed.csv"
    run_peers.command(options.fram, "bench", "--scene", start, "--warm", PACK[cover] - 1, "--time", PACK[cover],
                      "--dump", dump, "--json", "--quiet")
    head, floes = scene_file.read(start)
    with open(dump, encoding="utf-8", newline="") as file, open(out, "w", encoding="utf-8") as scene:
        for line in head:
            word = line.split()
            if word and word[0] == "ship":  # at rest and out of the way, in the open water that the field has left
                line = " ".join(word[:7] + ["0", "0"])
            print(line, file=scene)
        for (thickness, density, outline), row in zip(floes, csv.DictReader(file)):
            x, y, z, w = (float(row[k]) for k in ("qx", "qy", "qz", "qw"))
            yaw = math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))
            c, s = math.cos(yaw), math.sin(yaw)
            turned = " ".join(f"{c * u - s * v:.6f} {s * u + c * v:.6f}" for u, v in outline)
            print("floe", thickness, density, row["x"], row["y"], len(outline), turned, file=scene)
    return out


def copies_of(packed, copies):
    """The packed scene `copies` times, side by side across the current."""
    out = packed.with_name(f"{packed.stem}_x{copies}.scene")
    head, width = [], 0.0
    lines = packed.read_text(encoding="utf-8").splitlines()
    for line in lines:
        word = line.split()
        if word and word[0] == "domain":
            width = float(word[4]) - float(word[2])
            line = " ".join(word[:4] + [f"{float(word[2]) + copies * width:.6f}"])
        if not word or word[0] != "floe":
            head.append(line)
    with open(out, "w", encoding="utf-8") as scene:
        print("\n".join(head), file=scene)
        for k in range(copies):
            for line in lines:
                word = line.split()
                if word and word[0] == "floe":
                    print(*word[:4], f"{float(word[4]) + k * width:.6f}", *word[5:], file=scene)
    return out


def measure(options, cover):
    packed = packed_scene(options, cover)
    scenes = {BASE * k: copies_of(packed, k) for k in COPIES}
    rounds = [{n: run_peers.run_fram(options, scene, options.core) for n, scene in scenes.items()}
              for _ in range(options.repeat)]
    for n in scenes:
        ratio = statistics.median(r[n]["ms_per_step_median"] / n / (r[BASE]["ms_per_step_median"] / BASE)
                                  for r in rounds)
        ms = statistics.median(r[n]["ms_per_step_median"] for r in rounds)
        found = rounds[0][n]
        yield (f"| {cover} | {n:,} | {ms:.2f} | {1e3 * ms / n:.3f} | {ratio:.2f} | {found['loaded_pairs'] / n:.3f} |"
               f" {found['contact_points'] / n:.3f} | {'yes' if ratio <= BOUND else 'no'} |"), ratio <= BOUND


def main():
    words = run_peers.words_of_runs(__doc__, covers=[90, 98], time=2, warm=1)
    words.add_argument("--write", action="store_true")
    options = words.parse_args()
    packed = ", ".join(f"{PACK[c]} s at {c} % cover" for c in options.covers)
    text = ABOUT.format(**run_peers.machine(), packed=packed, warm=options.warm, time=options.time - options.warm,
                        repeat=options.repeat, bound=BOUND)
    met = True
    for cover in options.covers:
        for line, good in measure(options, cover):
            print(line, flush=True)
            text += line + "\n"
            met = met and good
    if options.write:
        (pathlib.Path(run_peers.HERE) / "results" / "scale.md").write_text(text, encoding="utf-8")
    return 0 if met else 1


if __name__ == "__main__":
    sys.exit(main())
