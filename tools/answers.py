#!/usr/bin/env python3
"""Numbers that the pages for users give of ready scenes, beside what these scenes give now:  make answers

Runs what the README and docs/tutorials.md run, and compares; exit code 1 where they differ.
A sentence stands here as it does in its page; it is found there by its words, whatever numbers it has.
"""

import csv
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "out"
TUTORIALS, README, STATION, RESULTS = "docs/tutorials.md", "README.md", "docs/station.md", "docs/results.md"
NUMBER = r"\d[\d,]*(?:\.\d+)?"
# Floes below this are pieces that broke off, not the sheet [m2].
SHEET = 15


class Run:
    """What a folder of results says after the transient, or from one time to another."""

    def __init__(self, name, vessel="", since=None, until=math.inf):
        self.folder = OUT / name
        self.station_file = self.folder / (f"station-{vessel}.json" if vessel else "station.json")
        if since is None:
            setting = re.search(r"^ *transient: (\S+)", (self.folder / "scenario.yaml").read_text(), re.M)
            since = float(setting.group(1))
        with open(self.folder / "series.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if since < float(row["time[s]"]) <= until]
        self.columns = {name.split("[")[0].removeprefix(f"{vessel}."): [float(row[name]) for row in rows]
                        for name in rows[0]}

    def mean(self, name):
        return statistics.fmean(self.columns[name])

    def astern(self):
        return -min(self.columns["ice_force_averaged_x"])

    def largest_along_x(self):
        return max(abs(x) for x in self.columns["ice_force_averaged_x"])

    def offsets(self):
        return [math.hypot(x, y) for x, y in zip(self.columns["offset_x"], self.columns["offset_y"])]

    def loads(self):
        return [math.hypot(x, y) for x, y in zip(self.columns["ice_force_averaged_x"],
                                                self.columns["ice_force_averaged_y"])]

    def time_of(self, values):
        """Of the largest one, to a second."""
        return f"{max(zip(values, self.columns['time']))[1]:.0f}"

    def load(self):
        return statistics.fmean(self.loads())

    def largest_load(self):
        return max(self.loads())

    def station(self, name, what):
        return json.loads(self.station_file.read_text())[name][what]

    def use_of_lines(self):
        """Largest tension over the breaking load of its line."""
        return max(line["utilisation"] for line in json.loads(self.station_file.read_text())["lines"])

    def fractures(self):
        with open(self.folder / "fractures.csv", newline="") as file:
            return [{name.split("[")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def broken(self, kind):
        return sum(row["kind"] == kind for row in self.fractures())


SPLIT, BENT = 1, 2


def kilo(newton):
    return f"{newton / 1e3:,.0f}"


def mega(newton, digits=2):
    return f"{newton / 1e6:.{digits}f}"


def of_station(run):
    return (run.station("offset_m", "mean"), run.station("offset_m", "greatest"),
            run.station("thruster_power_W", "mean") / 1e3, run.station("ice_load_N", "mean"))


def demo():
    run = Run("demo")
    splits, bendings = run.broken(SPLIT), run.broken(BENT)
    yield README, f"bow {splits + bendings} times, some"
    yield README, (f"{kilo(run.load())} kN on average, {kilo(run.largest_load())} kN at most (0.5 s mean); {splits} "
                   f"splits and {bendings} bending failures in 75 s")


def towed():
    run = Run("tow")
    yield README, (f"do not break? | {kilo(run.load())} kN on average, {kilo(run.largest_load())} kN at most "
                   "(0.5 s mean)")
    yield TUTORIALS, (f"the mean ice load from 15 to 60 s is {kilo(-run.mean('ice_force_x'))} kN astern and the mean "
                      f"tow force {kilo(run.mean('tow_force_x'))} kN")
    yield TUTORIALS, (f"averaged over half a second is {kilo(run.astern())} kN, and {kilo(run.largest_load())} kN with "
                      "what pushes sideways")


def peak():
    """That which the picture on the page shows: fram why out/tow --peak 1 -o docs/pictures/peak.png"""
    done = subprocess.run([ROOT / "build" / "release" / "fram", "why", Run("tow").folder, "--peak", "1", "--no-rerun",
                           "--json", "--quiet"], check=True, capture_output=True, text=True)
    told = json.loads(done.stdout)
    first = told["floes"][0]
    yield RESULTS, (f"at {told['time']:.2f} s: floe {first['floe']} carries "
                    f"{100 * sum(first['parts'].values()) / told['load']:.0f} % of {told['load'] / 1e3:.1f} kN, and "
                    f"leans on {len(first['chain']) - 1} more floes")


def ships():
    run = Run("packed_field")
    yield README, f"packed to 85 %? | {kilo(run.load())} kN on average, {kilo(run.largest_load())} kN at most"
    ship, breaker = Run("three_vessels", "ship"), Run("three_vessels", "icebreaker")
    yield README, (f"{kilo(ship.load())} kN of ice load on average, {kilo(ship.largest_load())} kN at most (0.5 s "
                   f"mean), and an offset of {ship.station('offset_m', 'greatest'):.2f} m; the icebreaker itself meets "
                   f"{kilo(breaker.load())} kN on average")


def own_ice():
    yield TUTORIALS, f"mean load of {kilo(-Run('own_ice').mean('ice_force_x'))} kN astern from 15 to 30 s"


def moored():
    run = Run("moored")
    load, peak = (run.station("ice_load_N", what) for what in ("mean", "greatest"))
    mean, largest = (run.station("offset_m", what) for what in ("mean", "greatest"))
    use = f"{100 * run.use_of_lines():.0f} %"
    yield README, (f"{mega(load)} MN on average, {mega(peak)} MN at most; {largest:.2f} m of offset, {use} of the "
                   "breaking load")
    yield TUTORIALS, (f"a mean ice load of {mega(load)} MN with a largest half-second mean of {mega(peak)} MN pushes "
                      f"it {mean:.2f} m off station on average and {largest:.2f} m at most; the tension of the most "
                      f"loaded line reaches {mega(run.station('line_tension_largest_N', 'greatest'))} MN, {use} of its "
                      "breaking load")
    yield TUTORIALS, f"Load and offset are largest at {run.time_of(run.loads())} and {run.time_of(run.offsets())} s"


def positioned():
    mean, largest, power, load = of_station(Run("dp"))
    fast_mean, fast_largest, fast_power, fast_load = of_station(Run("dp_fast"))
    yield README, f"within {largest:.2f} m, using {power:.0f} kW of thruster power on average"
    yield TUTORIALS, (f"the offset is {mean:.2f} m on average and {largest:.2f} m at most, for {power:.0f} kW of mean "
                      f"thruster power; with the faster passive observer it is {fast_mean:.2f} m on average and "
                      f"{fast_largest:.2f} m at most, for {fast_power:.0f} kW")
    yield TUTORIALS, f"Mean ice loads are {kilo(load)} and {kilo(fast_load)} kN"


def level():
    breaks = [row for row in Run("level").fractures() if row["kind"] == BENT and row["floe_area"] > SHEET]
    loads, lengths = ([row[name] for row in breaks] for name in ("load", "crack_length"))
    radius = statistics.fmean(row["loaded_radius"] for row in breaks)
    told = f"{kilo(statistics.fmean(loads))} kN on average ({kilo(min(loads))} to {kilo(max(loads))})"
    length = f"{statistics.fmean(lengths):.1f} m from the load"
    yield README, f"{told}, {length}, in {len(breaks)} breaks of the sheet"
    yield TUTORIALS, (f"the sheet {len(breaks)} times in 24 s, at {told} and {length} ({min(lengths):.1f} to "
                      f"{max(lengths):.1f})")
    yield TUTORIALS, f"the loaded radius is {radius:.2f} m, not the 0.35 m"


def ensemble():
    means = [-Run(f"seed_{seed}").mean("ice_force_x") / 1e3 for seed in (1, 2, 3, 4)]
    mean, deviation = statistics.fmean(means), statistics.stdev(means)
    first, second, third, last = (f"{value:.0f}" for value in means)
    yield TUTORIALS, (f"{first}, {second}, {third} and {last} kN: a mean of {mean:.0f} kN with a standard deviation of "
                      f"{deviation:.0f} kN, hence a standard error of the mean of {deviation:.0f}/sqrt(4) = "
                      f"{deviation / 2:.0f} kN, {50 * deviation / mean:.1f} %")


def drillship():
    managed, level_ice, water = Run("managed"), Run("unmanaged"), Run("open")
    runs = (managed, level_ice)
    offset = [[run.station("offset_m", what) for what in ("mean", "greatest")] for run in (water, *runs)]

    def row(name, figure, digits=1):
        return f"| {name} | 0 | " + " | ".join(f"{mega(figure(run), digits)} MN" for run in runs)

    yield TUTORIALS, row("ice load, mean", Run.load, 2)
    yield TUTORIALS, row("ice load, largest over half a second", Run.largest_load)
    yield TUTORIALS, row("ice load along X, the drift, mean", lambda run: abs(run.mean("ice_force_averaged_x")), 2)
    yield TUTORIALS, row("ice load along X, largest", Run.largest_along_x)
    yield TUTORIALS, "| offset, mean and largest | " + " | ".join(
        f"{mean:.{digits}f} m, {largest:.{digits}f} m" for (mean, largest), digits in zip(offset, (2, 1, 1)))
    yield TUTORIALS, "| heading off the drift, largest | 0 | " + " | ".join(
        f"{max(map(abs, run.columns['heading_deviation'])):.1f} degrees" for run in runs)
    tension = [f"{mega(run.station('line_tension_largest_N', 'greatest'), digits)} MN"
               for run, digits in zip((water, *runs), (2, 1, 1))]
    use = [f"{100 * run.use_of_lines():.0f} %" for run in (water, *runs)]
    yield TUTORIALS, "| largest tension of a line | " + " | ".join(tension)
    yield TUTORIALS, "| the same, of the breaking load | " + " | ".join(use)
    yield README, f"{tension[1]} at most, {use[1]} of the breaking load, and an offset of {offset[1][1]:.1f} m"
    beside = Run("managed", since=150, until=300)
    drift, least = (abs(run.mean("ice_force_averaged_x")) for run in (managed, beside))
    yield TUTORIALS, (f"the managed field gives {mega(least)} MN on average along X and "
                      f"{mega(beside.largest_along_x(), 1)} MN at most, an offset of {max(beside.offsets()):.1f} m and "
                      f"a line tension of {mega(max(beside.columns['line_tension_max']), 1)} MN")
    yield TUTORIALS, (f"the mean load along the drift from {mega(abs(level_ice.mean('ice_force_averaged_x')))} to "
                      f"{mega(least)} or {mega(drift)} MN")
    yield TUTORIALS, f"a single jam at {managed.time_of(managed.loads())} s"


def station():
    for name, words in (("supply_ship", "supply ship, 70 %, drift begins to turn (7 of 90 degrees)"),
                        ("turret_ship", "turret ship, 80 %, drift reverses"),
                        ("conical_unit", "conical unit, 95 %, 1 m")):
        run = Run(name)
        loads = [run.station("ice_load_N", what) for what in ("mean", "significant", "greatest")]
        told = ", ".join(f"{mega(load)} MN" if load >= 1e5 else f"{kilo(load)} kN" for load in loads)
        yield STATION, (f"| {words} | {run.station('offset_m', 'greatest'):.2f} m of "
                        f"{run.station('offset_m', 'limit'):g} m | {told}")
    yield STATION, f"its mean of {mega(loads[0])} MN and peak of {mega(loads[-1])} MN lie inside"


SHORT = (demo, towed, peak, ships, own_ice, moored, positioned, level, ensemble)
LONG = (drillship, station)


def commands(long):
    """What the pages tell their readers to type, for the runs that the answers are of."""
    text = (ROOT / TUTORIALS).read_text()
    first, last = text.index("## 1."), len(text) if long else text.index("## 8.")
    yield from re.findall(r"^    (.*)", text[first:last], re.M)
    for name in ("demo", "packed_field", "three_vessels"):
        yield f"build/release/fram run scenes/{name}.yaml -o out/{name} --force"
    if long:
        yield "tools/scenes.sh"


def find(text, sentence):
    """Where a page has the sentence, with whatever numbers, over whatever lines."""
    parts = re.split(f"({NUMBER})", sentence)
    words = [re.sub(r"(?:\\ )+", r"\\s+", re.escape(part)) for part in parts[::2]]
    return list(re.finditer(f"({NUMBER})".join(words), text)), parts[1::2]


def replaced(text, found, numbers):
    for group in range(len(numbers), 0, -1):
        start, end = found.span(group)
        text = text[:start] + numbers[group - 1] + text[end:]
    return text


def compare(page, sentence, write):
    """Whether the page says so."""
    path = ROOT / page
    text = path.read_text()
    found, numbers = find(text, sentence)
    if len(found) != 1:
        sys.exit(f"{page} has {len(found)} sentences like this one, expected 1: {sentence}")
    if list(found[0].groups()) == numbers:
        return True
    print(f"{page} says: {' '.join(found[0].group().split())}\n  now it is: {sentence}")
    if write:
        path.write_text(replaced(text, found[0], numbers))
    return False


def main():
    words = words_of(__doc__)
    words.add_argument("--long", action="store_true",
                       help="drillships of tutorial 8 and the scenes of docs/station.md, too (ten minutes)")
    words.add_argument("--write", action="store_true",
                       help="write the numbers of now into the pages, whose dates are for you to change")
    words.add_argument("--keep", action="store_true", help="take runs that are there as they are (out/)")
    options = words.parse_args()
    if not options.keep:
        OUT.mkdir(exist_ok=True)
        for command in commands(options.long):
            print(command, flush=True)
            subprocess.run(["bash", "-c", command], cwd=ROOT, check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
    sections = SHORT + (LONG if options.long else ())
    same = [compare(page, sentence, options.write) for section in sections for page, sentence in section()]
    print(f"{sum(same)} of {len(same)} sentences are those of now")
    return 0 if all(same) else 1


if __name__ == "__main__":
    sys.exit(main())
