"""What a finished run must keep: finite numbers, whole files, and books that close."""

import csv
import itertools
import json
import math
import pathlib

# Relative to the largest value of the run: sums of a few terms, each rounded.
ROUNDING = 1e-9
PARTS = (("ice_force_capped", "ice_force_below_cap", "ice_force_friction"),
         ("ice_force_bow", "ice_force_shoulder", "ice_force_midbody", "ice_force_stern", "ice_force_bottom"))
GROWING = ("ice_mass_left", "ice_mass_entered", "ice_mass_lost", "ice_mass_gained", "ice_mass_crushed", "brash_mass",
           "splits", "bendings")
# Files that are the same to the byte, whoever computed the run and however often it was interrupted.
SAME_FILES = ("record.fram", "fractures.csv", "station*.json")


def columns(path):
    """name without unit -> list of numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [head.split("[")[0] for head in rows[0]]
    values = [[float(v) if v else math.nan for v in row] for row in rows[1:]]
    return {name: [row[i] for row in values] for i, name in enumerate(names)}


def forces_add_up(series):
    """The parts of the ice load sum to the load, by mechanism and by zone, of each vessel."""
    vessels = [name.removesuffix("ice_force_x") for name in series if name.split(".")[-1] == "ice_force_x"]
    if not vessels:
        return "series.csv has no ice load"
    for vessel, parts in itertools.product(vessels, PARTS):
        parts = [p for p in parts if f"{vessel}{p}_x" in series]
        # Of all three axes: where nothing acts across, what is left there is rounding of what acts along.
        columns = [series[f"{vessel}{p}_{axis}"] for p in [*parts, "ice_force"] for axis in "xyz"]
        size = max((abs(v) for column in columns for v in column), default=0.0)
        for axis in "xyz":
            whole = series[f"{vessel}ice_force_{axis}"]
            terms = [series[f"{vessel}{p}_{axis}"] for p in parts]
            for row, value in enumerate(whole):
                if abs(sum(t[row] for t in terms) - value) > ROUNDING * size:
                    return f"the parts {', '.join(parts)} do not sum to {vessel}ice_force_{axis} in row {row + 1}"
    return None


def look_at_run(folder):
    """What is wrong with the files of a finished run; None when nothing is."""
    folder = pathlib.Path(folder)
    try:
        run = json.loads((folder / "run.json").read_text())
    except (OSError, ValueError) as problem:
        return f"run.json cannot be read: {problem}"
    if run.get("status") != "finished" or not run.get("state_hash"):
        return f"run.json says {run.get('status')} after the end"
    left = sorted(p.name for p in folder.iterdir() if p.name.endswith((".new", ".tmp")))
    if left:
        return f"temporary files are left: {', '.join(left)}"
    try:
        series = columns(folder / "series.csv")
        columns(folder / "fractures.csv")
    except (OSError, ValueError, IndexError) as problem:
        return f"series.csv or fractures.csv cannot be read: {problem}"
    for name, values in series.items():
        if not all(math.isfinite(v) for v in values):
            return f"series.csv holds a number that is none: {name}"
    for name in GROWING:
        values = series.get(name, [])
        if any(b < a for a, b in zip(values, values[1:])):
            return f"series.csv: {name} shrinks"
    if series.get("overlap_max") and min(series["overlap_max"]) < 0:
        return "series.csv: a negative overlap"
    return forces_add_up(series)


def without_wall(path):
    """The rows of series.csv without the one column that differs between runs."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    keep = [i for i, name in enumerate(rows[0]) if "wall" not in name]
    return [[row[i] for i in keep] for row in rows]


def differ(one, other):
    """How two runs that should be the same differ; None when they do not."""
    one, other = pathlib.Path(one), pathlib.Path(other)
    hashes = [json.loads((f / "run.json").read_text()).get("state_hash") for f in (one, other)]
    if hashes[0] != hashes[1]:
        return "the state differs"
    for name in sorted({p.name for run in (one, other) for pattern in SAME_FILES for p in run.glob(pattern)}):
        if (one / name).exists() != (other / name).exists():
            return f"only one of them has {name}"
        if (one / name).read_bytes() != (other / name).read_bytes():
            return f"{name} differs"
    if without_wall(one / "series.csv") != without_wall(other / "series.csv"):
        return "series.csv differs"
    return None
