#!/usr/bin/env python3
"""The wheel of `make python`, where it was built: installed by pip without a network, it runs with what it carries."""

import os
import re
import subprocess
import sys
import tempfile

import package  # first: it finds a Python with numpy and cffi

PROGRAM = """
import fram
world = fram.Scenario.from_text("vessel: {present: false}\\nice: {mean_floe_area: 64}\\n"
                                "domain: {x_min: -40, x_max: 40, y_min: -40, y_max: 40}").world()
world.step(5)
print(world.hash, fram.__file__)
print(open("/proc/self/maps").read())
"""


def told(**more):
    environment = {**{key: value for key, value in os.environ.items() if not key.startswith("FRAM_")}, **more}
    return subprocess.run([sys.executable, "-c", PROGRAM], env=environment, check=True, capture_output=True, text=True,
                          cwd="/").stdout


def main():
    wheels = sorted((package.SOURCE / "build/python").glob("fram-*.whl"))
    if not wheels:
        package.skip("there is no wheel; make python builds it")
    if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True, check=False).returncode:
        package.skip("python3-pip is not installed")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--target", folder,
                        wheels[-1]], check=True)
        out = told(PYTHONPATH=folder)
        assert folder in out.splitlines()[0], out.splitlines()[0]
        for name in ("libfram", "libgeos", "libfyaml", "libnettle"):
            places = set(re.findall(rf"\S+/{name}\S*", out))
            assert places and all(place.startswith(folder) for place in places), places
        here = told(PYTHONPATH=str(package.SOURCE / "bindings/python"),
                    FRAM_LIBRARY=str(package.BUILD / "libfram.so"))
        assert here.split()[0] == out.split()[0], "the wheel's library steps another way"
    print(f"{wheels[-1].name}: installed, and runs")
    return 0


sys.exit(main())
