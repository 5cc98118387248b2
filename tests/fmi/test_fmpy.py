#!/usr/bin/env python3
"""An importer that nobody here wrote, FMPy (github.com/CATIA-Systems/FMPy), validates and simulates units.

FRAM_FMPY names the folder that holds its package `fmpy` (src of its repository, with python3-lxml, python3-attr,
python3-msgpack, python3-jinja2 and python3-lark of Debian); without it, the test is skipped."""

import itertools
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

DEBIAN = "/usr/bin/python3"
SOURCE = os.environ.get("FRAM_FMPY")
if not SOURCE:
    print("skipped: FRAM_FMPY does not name FMPy's sources")
    sys.exit(77)
try:
    import lxml  # noqa: F401
    import numpy  # noqa: F401
except ImportError:
    if sys.executable == DEBIAN:
        print("skipped: numpy or lxml is not installed")
        sys.exit(77)
    sys.exit(subprocess.run([DEBIAN, *sys.argv], check=False).returncode)
sys.path.insert(0, SOURCE)
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402


SCENES = {"scenes/supply_ship.yaml": [], "scenes/level_ice.yaml": [],
          "scenes/managed_ice.yaml": ["ice.mean_floe_area=2000", "ice.concentration=0.5"],
          "tests/fmi/two_in_level_ice.yaml": []}


def roll_back(unit):
    """The importer's own state functions: the same steps again are the same."""
    description = read_model_description(str(unit))
    folder = extract(str(unit))
    ship = instantiate_fmu(folder, description, fmi_type="CoSimulation")
    is_3 = description.fmiVersion.startswith("3")
    references = [v.valueReference for v in description.modelVariables if v.causality == "output"]
    step = float(description.defaultExperiment.stepSize)
    read = ship.getFloat64 if is_3 else ship.getReal
    if not is_3:
        ship.setupExperiment()
    ship.enterInitializationMode()
    ship.exitInitializationMode()

    def ahead(first):
        for number in range(first, first + 10):
            ship.doStep(number * step, step)
        return read(references)

    ahead(0)
    state = ship.getFMUState() if is_3 else ship.getFMUstate()
    data = ship.serializeFMUState(state) if is_3 else ship.serializeFMUstate(state)
    before, after = read(references), ahead(10)
    for number in range(10):
        if number == 5:
            state = ship.deserializeFMUState(data) if is_3 else ship.deSerializeFMUstate(data)
        (ship.setFMUState if is_3 else ship.setFMUstate)(state)
        assert number >= 5 or read(references) == before
        assert ahead(10) == after
    ship.terminate()
    ship.freeInstance()
    shutil.rmtree(folder)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for (scene, words), version in itertools.product(SCENES.items(), "23"):
            unit = pathlib.Path(folder) / f"{pathlib.Path(scene).stem}_{version}.fmu"
            sets = [word for one in words for word in ("--set", one)]
            subprocess.run([os.environ["FRAM"], "fmu", scene, "-o", unit, "-q", "--fmi", version, *sets], check=True)
            findings = validate_fmu(str(unit))
            assert not findings, findings
            step = float(read_model_description(str(unit)).defaultExperiment.stepSize)
            rows = simulate_fmu(str(unit), stop_time=10 * step, step_size=step, output_interval=2 * step)
            assert len(rows) == 6 and abs(rows["time"][-1] - 10 * step) < 1e-9
            roll_back(unit)
            print(f"{unit.stem}: no findings, {len(rows.dtype.names)} columns simulated, ten roll-backs")
    return 0


sys.exit(main())
