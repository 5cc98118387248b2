#!/usr/bin/env python3
"""An importer that nobody here wrote, fmusim of the Modelica Association, checks and simulates units.

FRAM_FMUSIM names the program, which tools/fmusim.sh builds; without it, the test is skipped.  fmusim holds a unit's
description against the standard's schema and its own rules before it simulates."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile

from unit import Unit

FMUSIM = os.environ.get("FRAM_FMUSIM")
if not FMUSIM:
    print("skipped: FRAM_FMUSIM does not name fmusim (tools/fmusim.sh builds it)")
    sys.exit(77)
SCENES = {"scenes/supply_ship.yaml": [], "scenes/level_ice.yaml": ["domain.x_max=120"],
          "scenes/managed_ice.yaml": ["ice.mean_floe_area=2000", "ice.concentration=0.5"],
          "tests/fmi/two_in_level_ice.yaml": []}


def simulate(folder, unit, *words, code=0):
    """Rows of the results, each a dict of texts; what fmusim and the unit's log said."""
    output, log = folder / "results.csv", folder / "log.txt"
    output.unlink(missing_ok=True)
    log.write_text("")
    done = subprocess.run([FMUSIM, *map(str, words), "--output-file", output, "--logging-on", "--log-file", log,
                           "--log-level", "ok", unit.file], capture_output=True, text=True, check=False, cwd=folder)
    told = done.stdout + done.stderr + log.read_text()
    assert done.returncode == code, f"exit code {done.returncode}: {told}"
    if code != 0:
        return [], told
    with open(output, encoding="utf-8") as file:
        return list(csv.DictReader(file)), told


def text(value):
    return f"{value:.16g}"


def as_stepped_here(unit, rows, step, told):
    """The same values as by this folder's own importer, in all the digits that fmusim writes."""
    ship = unit.instance().initialise()
    for name, value in told.items():
        ship.set(name, value)
    for number, row in enumerate(rows[1:]):
        ship.step(number * step, step)
        found = dict(zip(list(row)[1:], map(text, ship.get(*list(row)[1:]))))
        differing = {name for name in found if float(found[name]) != float(row[name])}
        assert not differing, f"{unit.name}, row {number + 1}: {differing}"
    ship.free()


def scene(folder, path, words, version):
    file = folder / f"{pathlib.Path(path).stem}_{version}.fmu"
    sets = [word for one in words for word in ("--set", one)]
    subprocess.run([os.environ["FRAM"], "fmu", path, "-o", file, "-q", "--fmi", version, *sets], check=True)
    unit = Unit(file, folder / "unpacked" / file.stem)
    unit.file, dt = file, unit.step_size
    rows, told = simulate(folder, unit, "--stop-time", 100 * dt, "--output-interval", 4 * dt)
    assert len(rows) == 26 and "rror" not in told, told
    as_stepped_here(unit, rows, 4 * dt, {})
    print(f"{file.stem}: read and checked, {len(rows)} rows of {len(rows[0])} columns, as stepped here; "
          f"the unit said {'nothing' if not told.strip() else repr(told.strip())}")
    return unit


def inputs(folder, unit):
    """What a table of inputs tells the unit."""
    dt = unit.step_size
    table = folder / "in.csv"
    table.write_text('"time","wind_x","positioning","thruster_5_order"\n0,-9,0,4e5\n1e9,-9,0,4e5\n')
    rows, _ = simulate(folder, unit, "--stop-time", 100 * dt, "--output-interval", 2 * dt, "--input-file", table)
    as_stepped_here(unit, rows, 2 * dt, {"wind_x": -9, "positioning": 0, "thruster_5_order": 4e5})
    print(f"inputs from a table: as told here; offset_x {rows[-1]['offset_x']} m at the end")


def states(folder, unit):
    """Half way, the state into a file and from it into another process: the second half is the same."""
    dt = unit.step_size
    every, half = ("--output-interval", 2 * dt), 50 * dt
    whole, _ = simulate(folder, unit, "--stop-time", 2 * half, *every)
    simulate(folder, unit, "--stop-time", half, *every, "--final-fmu-state-file", folder / "state")
    second, _ = simulate(folder, unit, "--start-time", half, "--stop-time", 2 * half, *every,
                         "--initial-fmu-state-file", folder / "state")
    strip = [[value for name, value in row.items() if name != "time"] for row in (*whole[25:], *second)]
    assert strip[:26] == strip[26:], "the second half from a state is another"
    print(f"state in a file, {(folder / 'state').stat().st_size} bytes: the second half is the same in every digit")


def looked_at(folder, unit):
    """Rows between communication points are those of shorter steps."""
    dt = unit.step_size
    long, _ = simulate(folder, unit, "--stop-time", 40 * dt, "--output-interval", 10 * dt, "--early-return-allowed",
                       "--record-intermediate-values")
    short, _ = simulate(folder, unit, "--stop-time", 40 * dt, "--output-interval", dt)
    places = {round(float(row["time"]) / dt): row for row in long}
    assert len(places) == 41, sorted(places)
    for number, row in enumerate(short):
        found = places[number]
        assert all(found[name] == value for name, value in row.items() if name != "time"), f"row {number}"
    print("values between communication points: as those of steps of their length, in every digit")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print(subprocess.run([FMUSIM, "--version"], capture_output=True, text=True, check=True).stdout.strip())
        for version in "2", "3":
            units = [scene(folder, path, words, version) for path, words in SCENES.items()]
            inputs(folder, units[0])
            for unit in (units[0], units[-1]):
                states(folder, unit)
            if version == "3":
                looked_at(folder, units[-1])
            unit, dt = units[0], units[0].step_size
            _, told = simulate(folder, unit, "--stop-time", 10 * dt, "--output-interval", 1.3 * dt, code=3)
            assert "no whole multiple" in told, told
            print("a communication step that does not fit is refused: " + told.strip().splitlines()[-1])


main()
