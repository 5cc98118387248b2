#!/usr/bin/env python3
"""Whether a packed field comes to rest: bench/results/packed.md.

1,000 floes at 98 % cover are pressed against a wall by a current of 0.3 m/s, for several seeds, and one of them for
10,000 steps from 60 s on.  Means of the last second; root mean square velocity from the kinetic energy (with what
turns, so no less than it is).  Ends with code 1 when a field moves by more than 1 mm/s or overlaps by more than 1 % of
its thickness, or when the energy grows.  Give --write to put the tables into the results.
"""

import pathlib
import sys

import run_peers
import scene_file

FLOES, REST = 1000, 130  # seconds after which a field counts as packed
LONG = (60, 100, 150, 200, 260)
JITTER, OVERLAP, THICKNESS = 1e-3, 0.01, 1.0  # m/s, share of the thickness, m
ABOUT = """# A packed field comes to rest

`bench/run_packed.py`, {date}; {processor}, {cores} cores of a shared virtual machine; {compiler}. 1,000 floes, 98 %
cover, pressed against a wall by a current of 0.3 m/s (`bench/peers/gen_scene.py --n 1000 --coverage 0.98 --current 0.3
0 --ship-speed 0`), time step 0.02 s, {iterations} iterations, fast solver. Pairs, overlap and residual are means of the
last second, the largest overlap is that of the last second, energy and velocity are those at the end.
"""
HEAD = ("| {first} | kinetic energy J | rms velocity mm/s | loaded pairs | mean overlap mm | largest overlap mm |"
        " residual m/s | ms a step |\n|---|---|---|---|---|---|---|---|")


def mass_of(scene):
    """Of all floes [kg]."""
    mass = 0.0
    for floe in scene_file.read(scene)[1]:
        p = floe.outline
        twice = sum(p[i - 1][0] * p[i][1] - p[i][0] * p[i - 1][1] for i in range(len(p)))
        mass += float(floe.thickness) * float(floe.density) * twice / 2
    return mass


def at_rest(options, scene, seconds):
    options.time, options.warm = seconds, seconds - 1
    found = run_peers.run_fram(options, scene, options.core)
    found["rms"] = (2 * found["kinetic_energy_J"] / mass_of(scene)) ** 0.5
    return found


def row_of(first, r):
    return (f"| {first} | {r['kinetic_energy_J']:.2g} | {1e3 * r['rms']:.2g} | {r['loaded_pairs']:.0f} |"
            f" {1e3 * r['mean_penetration_m']:.2g} | {1e3 * r['max_penetration_m']:.2g} |"
            f" {r['solver_residual_m_per_s']:.1g} | {r['ms_per_step_median']:.2f} |")


def main():
    words = run_peers.words_of_runs(__doc__, covers=[98], time=0, warm=0)
    words.add_argument("--seeds", type=int, default=14)
    words.add_argument("--write", action="store_true")
    options = words.parse_args()
    lines, good = [f"\n## Seeds, {REST} s after the start\n", HEAD.format(first="seed")], True
    for seed in range(1, options.seeds + 1):
        found = at_rest(options, run_peers.scene_of(FLOES, options.covers[0], seed), REST)
        good = good and found["rms"] < JITTER and found["max_penetration_m"] < OVERLAP * THICKNESS
        lines.append(row_of(seed, found))
        print(lines[-1], flush=True)
    lines += ["\n## 10,000 steps of the first\n", HEAD.format(first="seconds")]
    energies = []
    for seconds in LONG:
        found = at_rest(options, run_peers.scene_of(FLOES, options.covers[0]), seconds)
        energies.append(found["kinetic_energy_J"])
        lines.append(row_of(seconds, found))
        print(lines[-1], flush=True)
    good = good and max(energies) == energies[0]
    if options.write:
        text = ABOUT.format(**run_peers.machine(), iterations=options.iterations) + "\n".join(lines) + "\n"
        (pathlib.Path(run_peers.HERE) / "results" / "packed.md").write_text(text, encoding="utf-8")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
