"""What tests of studies share: a small scenario, and the command."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

FRAM = os.environ["FRAM"]
# Under sanitizers a run takes twenty times as long: fewer there.
SHORT = "FRAM_TEST_SHORT" in os.environ
BASE = """
run: {duration: 3, time_step: 0.02, transient: 1}
vessel: {mode: towed, x: -30, speed: 2, ramp: 0.5, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {concentration: 0.8, mean_floe_area: 64}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
"""


class StudyTest(unittest.TestCase):
    def setUp(self):
        self.at = pathlib.Path(tempfile.mkdtemp(prefix="fram-study-"))
        self.addCleanup(shutil.rmtree, self.at)
        (self.at / "base.yaml").write_text(BASE)

    def write(self, text, name="study.yaml"):
        path = self.at / name
        path.write_text("scenario: base.yaml\n" + text)
        return path

    def fram(self, *words, code=0):
        done = subprocess.run([FRAM, "study", *map(str, words), "--json"], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    def rows(self, folder, name="summary.csv"):
        with open(self.at / folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def netcdf(self, folder):
        """Units and values of all variables of study.nc."""
        read = ("import sys, json, xarray; d = xarray.open_dataset(sys.argv[1]); print(json.dumps("
                "{n: [v.attrs.get('units'), v.values.tolist()] for n, v in d.variables.items()}))")
        done = subprocess.run(["/usr/bin/python3", "-c", read, self.at / folder / "study.nc"], capture_output=True,
                              text=True)
        if done.returncode:
            self.skipTest("python3-xarray or python3-netcdf4 is not installed")
        return json.loads(done.stdout)

    def check_means(self, folder):
        """Each figure of conditions.csv is the mean of that figure of the condition's runs; returns their heads."""
        runs, seen = self.rows(folder), set()
        for row in self.rows(folder, "conditions.csv"):
            of = [r for r in runs if r["condition"] == row["condition"]]
            for head in (h for h in row if "[" in h and "_half[" not in h):
                values = [float(r[head]) for r in of if r[head]]
                if values:
                    mean = sum(values) / len(values)
                    self.assertAlmostEqual(float(row[head]), mean, delta=1e-9 * max(map(abs, values)), msg=head)
                    seen.add(head)
                else:
                    self.assertEqual(row[head], "", head)
        return seen

    def refused(self, text, *said):
        error = self.fram("check", self.write(text), code=2)["error"]
        for word in said:
            self.assertIn(word, f"{error['file']}:{error['line']}: {error['key']}: {error['message']}")
