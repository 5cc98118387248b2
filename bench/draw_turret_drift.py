#!/usr/bin/env python3
"""Picture and columns of docs/turret-study.md from tables in bench/results.

Writes docs/pictures/turret_study.png and prints mean and largest load of each condition with the digits that their
uncertainty leaves.  Needs matplotlib."""
import csv
import math
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plot  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from words import words_of  # noqa: E402  (tools)
COLOURS = {"0.5": "#004488", "1": "#d65f00", "1.5": "#009e73"}


def rows(name):
    with open(ROOT / "bench" / "results" / name, newline="") as file:
        return list(csv.DictReader(file))


def with_uncertainty(mean, half):
    """Half the interval to two digits decides."""
    decimals = 1 - math.floor(math.log10(half))
    return " ± ".join(f"{round(x, decimals):.{max(decimals, 0)}f}" for x in (mean, half))


def main():
    words_of(__doc__).parse_args()
    means = rows("turret_drift_conditions.csv")
    rare = {r["condition"]: r for r in rows("turret_drift_extremes.csv") if r["figure"] == "line_tension_largest"}
    figure, panels = plot.subplots(1, 3, figsize=(12, 4), dpi=100, layout="constrained")
    for panel, title in zip(panels, ("Mean load [kN]", "Largest load of a run [kN]",
                                     "Most probable largest tension of 3 h [MN]")):
        panel.set_title(title, fontsize=11, loc="left")
        panel.set_xlabel("drift [m/s]")
        panel.grid(color="#e6e8ea")
        panel.spines[["top", "right"]].set_visible(False)
    for thickness, colour in COLOURS.items():
        of = [r for r in means if r["ice.thickness"] == thickness]
        speed = [float(r["environment.current_speed"]) for r in of]
        for panel, name in zip(panels, ("load_mean", "load_largest")):
            panel.errorbar(speed, [float(r[f"{name}[N]"]) * 1e-3 for r in of],
                           [float(r[f"{name}_half[N]"]) * 1e-3 for r in of], color=colour, marker="o", markersize=4,
                           capsize=3, label=f"ice of {thickness} m")
        levels = [[float(rare[r["condition"]][n]) * 1e-6 for n in ("most_probable", "low", "high")] for r in of]
        panels[2].errorbar(speed, [l[0] for l in levels],
                           [[l[0] - l[1] for l in levels], [l[2] - l[0] for l in levels]],
                           color=colour, marker="o", markersize=4, capsize=3)
    for panel in panels[:2]:
        panel.set_ylim(bottom=0)
    panels[0].legend(frameon=False)
    figure.savefig(ROOT / "docs" / "pictures" / "turret_study.png")
    for r in means:
        print(r["ice.thickness"], r["environment.current_speed"],
              *(with_uncertainty(float(r[f"{n}[N]"]) * 1e-3, float(r[f"{n}_half[N]"]) * 1e-3)
                for n in ("load_mean", "load_largest")), sep=" | ")


if __name__ == "__main__":
    main()
