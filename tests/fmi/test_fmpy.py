#!/usr/bin/env python3
"""An importer that nobody here wrote, FMPy (github.com/CATIA-Systems/FMPy), validates and simulates units.

FRAM_FMPY names the folder that holds its package `fmpy` (src of its repository, with python3-lxml, python3-attr,
python3-msgpack, python3-jinja2 and python3-lark of Debian); without it, the test is skipped."""

import os
import pathlib
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
from fmpy import read_model_description, simulate_fmu  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402


SCENES = {"scenes/supply_ship.yaml": [], "scenes/level_ice.yaml": [],
          "scenes/managed_ice.yaml": ["ice.mean_floe_area=2000", "ice.concentration=0.5"],
          "tests/fmi/two_in_level_ice.yaml": []}


def main():
    with tempfile.TemporaryDirectory() as folder:
        for scene, words in SCENES.items():
            unit = pathlib.Path(folder) / f"{pathlib.Path(scene).stem}.fmu"
            sets = [word for one in words for word in ("--set", one)]
            subprocess.run([os.environ["FRAM"], "fmu", scene, "-o", unit, "-q", *sets], check=True)
            findings = validate_fmu(str(unit))
            assert not findings, findings
            step = float(read_model_description(str(unit)).defaultExperiment.stepSize)
            rows = simulate_fmu(str(unit), stop_time=10 * step, step_size=step, output_interval=2 * step)
            assert len(rows) == 6 and abs(rows["time"][-1] - 10 * step) < 1e-9
            print(f"{unit.stem}: no findings, {len(rows.dtype.names)} columns simulated")
    return 0


sys.exit(main())
