#!/usr/bin/env python3
"""Numbers of the report and of compare that can be counted by hand: four floes of known size, a box that is driven into
ice that does not bend, and what series.csv has."""
import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile

FRAM = os.environ["FRAM"]
DENSITY, THICKNESS = 920, 0.5
FLOES = f"""
run: {{duration: 0.5, time_step: 0.1}}
vessel: {{present: false}}
ice:
  source: floes
  thickness: {THICKNESS}
  density: {DENSITY}
  floes: [{{length: 10, width: 10, thickness: 2, fixed: true}},
          {{length: 20, width: 10, x: 30}}, {{length: 20, width: 20, x: 60}},
          {{length: 20, width: 30, x: 90}}]
domain: {{x_min: -100, x_max: 200, y_min: -40, y_max: 40, boundary: open}}
"""
BEAM, SPEED, WAY = 10, 1, 6
# The bow stands 2 m before the edge of the sheet.
BOX = f"""
run: {{duration: {WAY + 2}, time_step: 0.02, transient: 1}}
vessel:
  mode: prescribed
  x: -22
  speed: {SPEED}
  hull: {{form: box, length: 40, beam: {BEAM}, draught: 4, freeboard: 3}}
ice: {{source: level, thickness: {THICKNESS}, density: {DENSITY}, breakable: true, flexural_strength: 1e9,
  crush_trims: true, level: {{x_min: 0}}}}
domain: {{x_min: -60, x_max: 60, y_min: -30, y_max: 30, boundary: open}}
"""


def run(folder, name, text, *keys):
    (folder / f"{name}.yaml").write_text(text)
    words = [word for key in keys for word in ("--set", key)]
    subprocess.run([FRAM, "run", folder / f"{name}.yaml", "-o", folder / name, "-q", *words], check=True)
    return folder / name


def report(folder):
    """First cell of each row of the report, and the numbers of the others."""
    subprocess.run([FRAM, "report", folder, "-q"], check=True)
    rows = re.findall(r"<tr>(.*?)</tr>", (folder / "report.html").read_text(), re.S)
    cells = [[re.sub(r"<[^>]+>", "", c) for c in re.findall(r"<t[dh].*?</t[dh]>", row, re.S)] for row in rows]
    numbers = re.compile(r"[-+]?\d+\.?\d*(e[-+]?\d+)?(?![.\d])")
    return {c[0]: [float(n[0]) if (n := numbers.match(v.replace("\u2212", "-"))) else None for v in c[1:]]
            for c in cells if c}


def compare(a, b):
    done = subprocess.run([FRAM, "compare", a, b, "--json"], capture_output=True, text=True, check=True)
    told = json.loads(done.stdout)
    return told, {row["name"]: (row["a"], row["b"]) for row in told["rows"]}


def column(folder, name, transient):
    with open(folder / "series.csv", newline="") as file:
        return [float(row[name]) for row in csv.DictReader(file) if float(row["time[s]"]) > transient]


def shrink_loads(folder, factor):
    """The same run with smaller loads, and works a quarter of that, as of a model."""
    head, *rows = (line.split(",") for line in (folder / "series.csv").read_text().splitlines())
    for i, name in enumerate(head):
        less = factor if name.startswith("ice_force_averaged_") else factor / 4 if name == "crushing_work[J]" else None
        for row in rows if less else []:
            row[i] = repr(less * float(row[i]))
    (folder / "series.csv").write_text("\n".join(map(",".join, [head, *rows])) + "\n")


def close(found, expected, part):
    assert abs(found - expected) <= part * abs(expected), (found, expected)


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        floes = run(folder, "floes", FLOES)
        rows = report(floes)
        assert rows["floes"] == [4], rows["floes"]
        areas = (100, 200, 400, 600)
        close(rows["mean floe area [m2]"][0], sum(areas) / 4, 1e-3)
        close(rows["median floe area [m2]"][0], (200 + 400) / 2, 1e-3)
        close(rows["largest floe [m2]"][0], 600, 1e-3)
        volume = 100 * 2 + (200 + 400 + 600) * THICKNESS
        close(rows["ice mass [t]"][0], volume * DENSITY * 1e-3, 1e-3)
        close(rows["mean thickness [m]"][0], volume / sum(areas), 1e-3)
        assert rows["of these fixed"] == [1], rows["of these fixed"]

        # Three of them: the middle one is the median.
        close(report(run(folder, "three", FLOES.replace("{length: 20, width: 10, x: 30}, ", "")))[
            "median floe area [m2]"][0], 400, 1e-3)

        # What the box has taken the place of is crushed, but for a rim in front of it, and the books close on it.
        box = run(folder, "box", BOX)
        rows = report(box)
        crushed = rows["ice mass crushed"][0]
        close(crushed, WAY * BEAM * THICKNESS * DENSITY * 1e-3, 0.1)
        assert abs(rows["not accounted for at the last frame"][0]) < 0.01 * crushed, rows

        # Of the same scenario, the same state; of another, another; the numbers are those of the series.
        told, _ = compare(floes, run(folder, "again", FLOES))
        assert told["same_scenario"] and told["same_state"], told
        thin = run(folder, "thin", FLOES, "ice.thickness=0.4")
        told, _ = compare(floes, thin)
        assert not told["same_scenario"] and not told["same_state"], told
        # What neither tells is not the same of both.
        for each in (floes, thin):
            note = json.loads((each / "run.json").read_text())
            (each / "run.json").write_text(json.dumps({**note, "state_hash": "", "scenario_hash": ""}))
        told, _ = compare(floes, thin)
        assert not any(told[k] for k in ("same_scenario", "same_as_read", "same_state")), told
        for name, wind in (("a", 5), ("b", 9), ("c", 5)):
            (folder / name).mkdir()
            (folder / name / "wind.csv").write_text(f"time[s],x[m/s],y[m/s]\n0,{wind},0\n")
        windy = [run(folder, f"wind_{n}", FLOES, f"environment.wind_file={n}/wind.csv") for n in "abc"]
        for key, expected in (("same_scenario", [True, False, True]), ("only_files_differ", [False, True, False])):
            assert [compare(windy[0], w)[0][key] for w in windy] == expected, key
        page = folder / "windy.html"
        done = subprocess.run([FRAM, "compare", *windy[:2], "-o", page], capture_output=True, text=True, check=True)
        for text in (done.stdout, page.read_text()):
            assert "the same but for the files that they name" in text, text
        soft = run(folder, "soft", BOX, "ice.crushing_strength=1e6")
        told, rows = compare(box, soft)
        for k, each in enumerate((box, soft)):
            load = [1e-3 * v for v in column(each, "ice_force_averaged_x[N]", 1)]
            assert min(load) < -1000 and max(load) <= 0, (min(load), max(load))
            close(rows["ice load along X, minimum"][k], min(load), 1e-9)
            assert abs(rows["ice load along X, maximum"][k] - max(load)) < 1e-9 * -min(load), (rows, max(load))
            mean = sum(load) / len(load)
            close(rows["ice load along X, mean"][k], mean, 1e-3)
            deviation = (sum((v - mean) ** 2 for v in load) / len(load)) ** 0.5
            close(rows["ice load along X, standard deviation"][k], deviation, 5e-3)
            close(rows["x at the end"][k], -22 + SPEED * (WAY + 2), 1e-3)
        # Where the last row is not of the end, that is said.
        sparse = run(folder, "sparse", BOX.replace(f"duration: {WAY + 2}", "duration: 1"), "output.csv_interval=0.7")
        told, rows_then = compare(sparse, sparse)
        assert told["same_state"] and not any("the end" in name for name in rows_then), rows_then
        close(rows_then["x in the last row, at 0.7 s"][0], -22 + SPEED * 0.7, 1e-3)
        assert rows_then["floes split until the last row, at 0.7 s"] == (0, 0), rows_then
        both = compare(box, sparse)[1]
        assert f"floes in the last row, at {WAY + 2} and 0.7 s" in both, both
        rows_then = report(sparse)
        assert all("in the last row, at 0.7 s" in (sparse / "report.html").read_text().split(f">{head}</th>")[1][:60]
                   for head in ("mass of ice", "energy")), rows_then
        # Headings are next to each other on either side of astern.
        water = BOX.replace("source: level", "source: none").replace("transient: 1", "transient: 0")
        ends = [run(folder, f"to{h}", water, f"vessel.heading_deg={h}", "run.duration=0.02") for h in (179.9, -179.9)]
        a, b = compare(*ends)[1]["heading at the end"]
        assert abs(a - 179.9) < 1e-6 and abs(b - 180.1) < 1e-6, (a, b)
        # A vertical face is pushed through ice that crushes: strength x beam x thickness.
        close(rows["ice load along X, minimum"][0], -2e6 * BEAM * THICKNESS * 1e-3, 0.02)
        close(rows["ice load along X, minimum"][1], -1e6 * BEAM * THICKNESS * 1e-3, 0.02)
        # Under 10 kN loads are told in newtons, those of both runs, and under 10 kJ works in joules.
        for factor, unit, of_work in ((2e-3, "kN", "kJ"), (0.4, "N", "J")):
            shrink_loads(box, factor)
            shrink_loads(soft, factor)
            told, small = compare(box, soft)
            units = {row["unit"] for row in told["rows"] if row["name"].startswith("ice load")}
            assert units == {unit}, (factor, units)
            assert next(row["unit"] for row in told["rows"] if row["name"] == "work of crushing") == of_work, told
        close(small["ice load along X, minimum"][1], 0.8 * rows["ice load along X, minimum"][1], 1e-9)
    print("floes, crushed ice and loads as counted by hand")


main()
