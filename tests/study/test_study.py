#!/usr/bin/env python3
"""Studies: the same bytes however they were run, stopped, killed and widened; mistakes told at their place."""
import base64
import csv
import hashlib
import json
import math
import os
import re
import shutil
import signal
import statistics
import subprocess
import time
import unittest

from studies import BASE, FRAM, SHORT, StudyTest

# Many runs for their numbers: their sums stand in tests in C of this room, what starts and stops runs in other methods.
WHOLE = unittest.skipIf(SHORT, "tests are short")


class Studies(StudyTest):
    def test_a_row_for_each_run_and_its_numbers_are_those_of_the_run(self):
        study = self.write("seeds: {least: 2, first: 5}\nkeep: series\n"
                           "vary: {grid: {ice.thickness: [0.5, 1], vessel.speed: [1.5, 2]}}\n")
        self.assertEqual(self.fram(study, "-o", self.at / "out")["runs"], 8)
        rows = self.rows("out")
        self.assertEqual([(r["condition"], r["ice.thickness"], r["vessel.speed"], r["seed"]) for r in rows],
                         [(str(1 + i), h, v, s) for i, (h, v) in enumerate(
                             [("0.5", "1.5"), ("0.5", "2"), ("1", "1.5"), ("1", "2")]) for s in ("5", "6")])
        # One run by hand: the same state, and the same load.
        subprocess.run([FRAM, "run", self.at / "base.yaml", "-o", self.at / "one", "--set", "ice.thickness=1",
                        "--set", "vessel.speed=2", "--set", "run.seed=6", "--quiet"], check=True)
        note = json.loads((self.at / "one" / "run.json").read_text())
        self.assertEqual(rows[7]["state_hash"], note["state_hash"])
        with open(self.at / "one" / "series.csv", newline="") as file:
            forces = [[float(r[f"ice_force_averaged_{axis}[N]"]) for axis in "xy"] for r in csv.DictReader(file)
                      if float(r["time[s]"]) > 1]
        loads = [math.hypot(*force) for force in forces]
        for axis, values in zip("xy", zip(*forces)):
            self.assertAlmostEqual(float(rows[7][f"force_{axis}_mean[N]"]), sum(values) / len(values),
                                   delta=1e-9 * max(loads))
        deviation = math.sqrt(sum((x - sum(loads) / len(loads)) ** 2 for x in loads) / len(loads))
        self.assertAlmostEqual(float(rows[7]["load_deviation[N]"]) / deviation, 1, delta=1e-2)
        self.assertTrue(sum(loads) / len(loads) < float(rows[7]["load_significant[N]"]) <= max(loads))
        self.assertEqual(float(rows[7]["time[s]"]), 3)
        self.assertAlmostEqual(float(rows[7]["load_mean[N]"]), sum(loads) / len(loads), delta=1e-9 * max(loads))
        self.assertAlmostEqual(float(rows[7]["load_largest[N]"]), max(loads), delta=1e-9 * max(loads))
        means = self.rows("out", "conditions.csv")
        self.assertLessEqual({"load_mean[N]", "load_significant[N]", "load_largest[N]", "load_range_equivalent[N]"},
                             self.check_means("out"))
        pair = [float(r["load_mean[N]"]) for r in rows[6:]]
        self.assertAlmostEqual(float(means[3]["load_mean[N]"]), sum(pair) / 2, delta=1e-6)
        # Student's t of two values: 12.706 times the standard error.
        self.assertAlmostEqual(float(means[3]["load_mean_half[N]"]) / (abs(pair[0] - pair[1]) / 2), 12.7062, delta=1e-3)
        # Shares of mechanisms: of the mean load vector, along it; they add up to all of it.
        with open(self.at / "one" / "series.csv", newline="") as file:
            late = [r for r in csv.DictReader(file) if float(r["time[s]"]) > 1]
        total = [sum(float(r[f"ice_force_{a}[N]"]) for r in late) for a in "xy"]
        names = [n[6:-3] for n in rows[7] if n.startswith("share_") and n.endswith("[1]")]
        self.assertEqual(len(names), 8)
        for name in names:
            part = [sum(float(r[f"mechanism_{name}_{a}[N]"]) for r in late) for a in "xy"]
            along = (part[0] * total[0] + part[1] * total[1]) / (total[0] ** 2 + total[1] ** 2)
            self.assertAlmostEqual(float(rows[7][f"share_{name}[1]"]), along, delta=1e-6)
            pair = [float(r[f"share_{name}[1]"]) for r in rows[6:]]
            self.assertAlmostEqual(float(means[3][f"share_{name}[1]"]), sum(pair) / 2, delta=1e-9)
        for row in rows:
            shares = [row[f"share_{n}[1]"] for n in names]
            self.assertNotIn("-0", shares)
            if float(row["load_mean[N]"]) > 0:
                self.assertAlmostEqual(sum(map(float, shares)), 1, delta=1e-6)
            else:
                self.assertEqual(set(shares), {""})
        # Damage-equivalent ranges are those of `fram fatigue`.
        (folder,) = [p for p in (self.at / "out" / "runs").glob("*/6")
                     if json.loads((p / "run.json").read_text())["state_hash"] == rows[7]["state_hash"]]
        done = subprocess.run([FRAM, "fatigue", folder, "--channel", "load", "--slope", "3", "--json"],
                              capture_output=True, text=True, check=True)
        said = json.loads(done.stdout.splitlines()[-1])["equivalent"][0]["range"]
        self.assertGreater(said, 0)
        self.assertAlmostEqual(float(rows[7]["load_range_equivalent[N]"]) / said, 1, delta=1e-9)
        self.assertEqual(rows[7]["line_tension_range_equivalent[N]"], "")
        kept = list((self.at / "out" / "runs").glob("*/5/*"))
        self.assertEqual({p.name for p in kept}, {"scenario.yaml", "run.json", "series.csv", "fractures.csv"})

    def test_a_vessel_of_a_list_has_its_figures(self):
        (self.at / "two.yaml").write_text("""
run: {duration: 3, time_step: 0.02, transient: 1}
vessels:
  - {name: east, mode: towed, x: -30, speed: 2, hull: {length: 30, beam: 10, draught: 4, freeboard: 2}}
  - {name: moored, mode: free, x: 30, hull: {form: box, length: 20, beam: 10, draught: 4, freeboard: 2},
     mooring: {depth: 80, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}}
ice: {concentration: 0.8, mean_floe_area: 64}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
""")
        study = self.at / "study.yaml"
        rows, made = {}, {}
        for vessel in (None, "east", "moored"):
            study.write_text("scenario: two.yaml\nkeep: series\n" + (f"vessel: {vessel}\n" if vessel else ""))
            made[vessel] = self.fram(study, "-o", self.at / "out")["made"]
            (rows[vessel],) = self.rows("out")
        # Another vessel is told of without another run.
        self.assertEqual(made, {None: 1, "east": 0, "moored": 0})
        self.assertEqual(rows[None], rows["east"])
        self.assertEqual(rows["east"]["state_hash"], rows["moored"]["state_hash"])
        (series,) = (self.at / "out" / "runs").glob("*/1/series.csv")
        with open(series, newline="") as file:
            lines = [r for r in csv.DictReader(file) if float(r["time[s]"]) > 1]
        for name in ("east", "moored"):
            load = [math.hypot(float(r[f"{name}.ice_force_averaged_x[N]"]), float(r[f"{name}.ice_force_averaged_y[N]"]))
                    for r in lines]
            self.assertAlmostEqual(float(rows[name]["load_mean[N]"]), sum(load) / len(load), delta=1e-9 * max(load))
        done = subprocess.run([FRAM, "fatigue", series.parent, "--channel", "moored.line_tension_max", "--slope", "3",
                               "--json"], capture_output=True, text=True, check=True)
        said = json.loads(done.stdout.splitlines()[-1])["equivalent"][0]["range"]
        self.assertAlmostEqual(float(rows["moored"]["line_tension_range_equivalent[N]"]) / said, 1, delta=1e-9)
        tension = max(float(r["moored.line_tension_max[N]"]) for r in lines)
        self.assertAlmostEqual(float(rows["moored"]["line_tension_largest[N]"]), tension, delta=1e-6 * tension)
        self.assertEqual(rows["east"]["line_tension_largest[N]"], "")
        mean = sum(float(r["moored.line_tension_max[N]"]) for r in lines) / len(lines)
        self.assertTrue(1.001 * mean < float(rows["moored"]["line_tension_significant[N]"]) <= tension)
        offsets = [math.hypot(*(float(r[f"moored.offset_{axis}[m]"]) for axis in "xy")) for r in lines]
        turns = [abs(float(r["moored.heading_deviation[deg]"])) for r in lines]
        for name, value in (("offset_mean[m]", sum(offsets) / len(offsets)), ("offset_largest[m]", max(offsets)),
                            ("heading_deviation_largest[deg]", max(turns))):
            self.assertAlmostEqual(float(rows["moored"][name]) / value, 1, delta=1e-9)

    @WHOLE
    def test_a_ship_with_another_one_and_without_it(self):
        (self.at / "two.yaml").write_text("""
run: {duration: 3, time_step: 0.02, transient: 1}
vessels:
  - {name: breaker, mode: towed, x: 12, speed: 2, ramp: 0.5, hull: {length: 24, beam: 8, draught: 3, freeboard: 2}}
  - {name: ship, mode: towed, x: -30, speed: 2, ramp: 0.5, hull: {length: 40, beam: 10, draught: 4, freeboard: 2}}
ice: {concentration: 0.8, mean_floe_area: 64}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
""")
        study = self.at / "study.yaml"
        vary = "vary: {grid: {vessels.breaker.present: [false, true]}}\n"
        # Without a name the first that is present would be one ship here and the other one there.
        study.write_text("scenario: two.yaml\nseeds: 4\n" + vary)
        error = self.fram("check", study, code=2)["error"]
        self.assertEqual(error["key"], "vessel")
        self.assertIn("condition 2 (vessels.breaker.present=true): the first vessel", error["message"])
        study.write_text("scenario: two.yaml\nvessel: ship\nseeds: 4\n" + vary)
        self.assertEqual(self.fram(study, "-o", self.at / "out")["failed"], 0)
        page = (self.at / "out" / "study.html").read_text()
        self.assertIn("the horizontal ice force on ship, averaged", page)
        # The table of differences is that of the runs, seed by seed, and means without pairs.
        runs = [float(r["load_mean[N]"]) for r in self.rows("out")]
        row = next(r for r in self.rows("out", "differences.csv") if r["figure"] == "load_mean")
        self.assertEqual((row["condition"], row["less"], row["key"], row["pairs"]),
                         ("2", "1", "vessels.breaker.present", "4"))
        by_seed = [b - a for a, b in zip(runs[:4], runs[4:])]
        mean, half = sum(by_seed) / 4, 3.182446305284263 * statistics.stdev(by_seed) / 2
        self.assertAlmostEqual(float(row["difference"]), mean, delta=1e-9 * max(runs))
        self.assertAlmostEqual(float(row["half"]), half, delta=1e-9 * max(runs))
        self.assertAlmostEqual(float(row["means_difference"]), mean, delta=1e-9 * max(runs))
        self.assertGreater(half, 0)
        told = re.search(r"breaker\.present</td><td>(-?[0-9.]+) ± ([0-9.]+)(<br>higher|<br>lower|)<",
                         page.replace("\u200b", "")).groups()
        self.assertAlmostEqual(float(told[1]), half * 1e-3, delta=0.06 * half * 1e-3)
        self.assertEqual(told[2], "<br>higher" if mean > half else "<br>lower" if mean < -half else "")
        # What is found only as a run begins is its reason, the same wherever the study lies.
        study.write_text("scenario: two.yaml\nvessel: ship\nvary: {grid: {ice.concentration: [0.8, 0.9999]}}\n")
        for folder in ("here", "elsewhere"):
            self.assertEqual(self.fram(study, "-o", self.at / folder)["failed"], 1)
        self.assertEqual((self.at / "here" / "summary.csv").read_bytes(),
                         (self.at / "elsewhere" / "summary.csv").read_bytes())
        reason = self.rows("here")[1]["reason"]
        self.assertRegex(reason, r"^[0-9a-f]+\.yaml:[0-9:]+: ice\.concentration: concentration")
        # A scenario with several ships whose first one is always the same needs no name; the study has it.
        study.write_text("scenario: two.yaml\n")
        self.fram(study, "-o", self.at / "one")
        self.assertIn('"vessel": "breaker"', (self.at / "one" / "effective.yaml").read_text())
        self.assertFalse((self.at / "one" / "differences.csv").exists())

    def test_a_vessel_that_is_not_there_is_refused(self):
        (self.at / "base.yaml").write_text(BASE.replace("vessel: {", "vessel: {name: alone, "))
        self.refused("vessel: tug\n", "study.yaml:2", "vessel", "alone", '"tug"')
        self.refused("vessel: [alone]\n", "study.yaml:2", "vessel")
        self.refused("vessel: alone\nvary: {grid: {vessel.present: [true, false]}}\n", "condition 2", "there is none")
        study = self.write("vessel: alone\n")
        self.assertEqual(self.fram(study, "-o", self.at / "out")["runs"], 1)
        self.assertGreater(float(self.rows("out")[0]["load_mean[N]"]), 0)

    def test_the_same_bytes_however_it_was_run(self):
        study = self.write("seeds: 3\nvary: {grid: {vessel.speed: [1.5, 2]}}\n")
        self.fram(study, "-o", self.at / "one", "--jobs", "1")
        self.fram(study, "-o", self.at / "many", "--jobs", "5")
        # Killed on the way, twice, and gone on with.
        for moment in (0.15, 0.4):
            process = subprocess.Popen([FRAM, "study", study, "-o", self.at / "killed", "--quiet"])
            time.sleep(moment)
            process.kill()
            process.wait()
        self.fram(study, "-o", self.at / "killed")
        # Narrow first, then wider: what is there is not run again.
        self.fram(self.write("seeds: 2\nvary: {grid: {vessel.speed: [2]}}\n", "small.yaml"), "-o", self.at / "wide")
        self.assertEqual(self.fram(study, "-o", self.at / "wide")["made"], 4)
        self.assertEqual(self.fram(study, "-o", self.at / "wide")["made"], 0)
        for table in ("summary.csv", "conditions.csv", "study.html"):
            whole = (self.at / "one" / table).read_bytes()
            for other in ("many", "killed", "wide"):
                self.assertEqual((self.at / other / table).read_bytes(), whole, f"{other} {table}")

    def names(self, folder):
        at = self.at / folder
        return sorted(str(p.relative_to(at)) for p in at.rglob("*") if p.is_file())

    def test_what_a_kill_leaves_half_done_goes_when_the_study_goes_on(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nseeds: 2\n")
        self.fram(study, "-o", self.at / "out")
        whole = self.names("out")
        (run,) = [p.with_suffix("") for p in (self.at / "out" / "runs").glob("*/1.row")]
        part = "." + "0123456789abcdef" + ".new"
        for path in (self.at / "out" / "summary.csv", self.at / "out" / "study.nc", run.with_suffix(".row"),
                     self.at / "out" / "conditions" / f"{run.parent.name}.yaml"):
            path.with_name(path.name + part).write_text("half")
        # Killed between the row of a run and the end of its folder: the log is the last thing to go.
        run.mkdir()
        (run / "series.csv").write_text("time[s]\n")
        run.with_suffix(".log").write_text("")
        # What others have put there stays.
        (self.at / "out" / "notes.new").write_text("mine")
        self.assertEqual(self.fram(study, "-o", self.at / "out")["made"], 0)
        self.assertEqual(self.names("out"), sorted([*whole, "notes.new"]))
        # A folder that is kept stays when less is kept later: its run ended whole.
        keeps = self.write("set: {run.duration: 0.1, run.transient: 0}\nkeep: series\n")
        self.fram(keeps, "-o", self.at / "kept")
        self.fram(self.write("set: {run.duration: 0.1, run.transient: 0}\n"), "-o", self.at / "kept")
        self.assertEqual(len(list((self.at / "kept" / "runs").glob("*/1/series.csv"))), 1)
        # Where it is to be more than was kept, that is told.
        for keep, said in (("series", False), ("all", True)):
            self.write(f"set: {{run.duration: 0.1, run.transient: 0}}\nkeep: {keep}\n")
            done = subprocess.run([FRAM, "study", study, "-o", self.at / "kept"], capture_output=True, text=True)
            self.assertEqual("1 run was made while the study kept less" in done.stderr, said, done.stderr)

    @WHOLE
    def test_the_effective_study_is_the_study(self):
        study = self.write("set: {run.duration: 0.2, run.transient: 0.1}\nseeds: {least: 2, first: 3}\n"
                           "vary: {latin: {count: 3, keys: {vessel.speed: [1, 2], ice.thickness: [0.5, 1]}}}\n"
                           "extremes: {duration: 1h, levels: [0.7]}\n")
        self.fram(study, "-o", self.at / "out")
        effective = self.at / "out" / "effective.yaml"
        text = effective.read_text()
        for name in ("study.yaml", "base.yaml"):
            self.assertRegex(text, f"# .*{name}, sha256 {hashlib.sha256((self.at / name).read_bytes()).hexdigest()}\n")
        self.fram(effective, "-o", self.at / "again")
        for table in ("summary.csv", "conditions.csv", "extremes.csv", "index.csv"):
            self.assertEqual((self.at / "again" / table).read_bytes(), (self.at / "out" / table).read_bytes(), table)
        rows = self.rows("out", "index.csv")
        self.assertEqual({r["id"] for r in rows}, {p.name for p in (self.at / "out" / "runs").iterdir()})
        # How it stands, told from the folder alone, as the tables have it.
        (self.at / "base.yaml").unlink()
        told = self.fram("list", self.at / "out")
        self.assertEqual([told[k] for k in ("conditions", "runs", "wanted", "failed")], [3, 6, 6, 0])
        for one, row, mean in zip(told["list"], rows, self.rows("out", "conditions.csv")):
            self.assertEqual((one["id"], one["runs"]), (row["id"], 2))
            self.assertEqual(one["load_mean_N"], float(mean["load_mean[N]"]))
        # A seed that takes longer than those behind it hides none of them.
        (self.at / "out" / "runs" / rows[1]["id"] / "3.row").unlink()
        told = self.fram("list", self.at / "out")
        self.assertEqual([told[k] for k in ("runs", "wanted")], [5, 6])
        self.assertEqual(told["list"][1]["load_mean_N"], float(self.rows("out")[3]["load_mean[N]"]))
        self.assertIn("no study", self.fram("list", self.at, code=2)["error"]["message"])

    @WHOLE
    def test_many_runs_that_are_there_cost_reading_alone(self):
        count = 100 if SHORT else 1000
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary: {latin: {count: %d, keys: "
                           "{vessel.speed: [1, 2]}}}\n" % count)
        one = self.write("set: {run.duration: 0.1, run.transient: 0}\n", "one.yaml")
        self.fram(one, "-o", self.at / "one")
        (row,) = (self.at / "one" / "runs").glob("*/1.row")
        # Makes the folder and runs nothing.
        subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--on", "slurm", "--dry-run"], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        folders = list((self.at / "out" / "runs").iterdir())
        self.assertEqual(len(folders), count)
        for folder in folders:
            shutil.copy(row, folder / "1.row")
        self.fram(study, "-o", self.at / "out")
        before = {p: p.stat().st_ino for d in ("conditions", "runs") for p in (self.at / "out" / d).rglob("*")}
        told = self.fram(study, "-o", self.at / "out")
        self.assertEqual((told["runs"], told["made"]), (count, 0))
        # No file of a condition or run was put in place again, and none was added.
        after = {p: p.stat().st_ino for d in ("conditions", "runs") for p in (self.at / "out" / d).rglob("*")}
        self.assertEqual(after, before)
        self.assertEqual(self.fram("list", self.at / "out")["runs"], count)
        # Bytes a run, beside what an empty file and page have.
        if (self.at / "out" / "study.nc").exists():
            self.assertLess((self.at / "out" / "study.nc").stat().st_size, 150000 + 300 * count)
        self.assertLess((self.at / "out" / "study.html").stat().st_size, 400000 + 500 * count)

    def test_a_failure_is_a_row_and_stops_nothing(self):
        # A hull lighter than the water it displaces rises to its waterline, faster than the lower limit allows.
        study = self.write("seeds: 2\nvary: {grid: {run.speed_limit: [2.1, 100], vessel.mass: [1.0e6]}}\n"
                           "extremes: {duration: 1h}\n")
        result = self.fram(study, "-o", self.at / "out")
        self.assertEqual((result["runs"], result["failed"]), (4, 2))
        # Nothing is told of what no run has: no 0, and no method that was not asked.
        for row, runs in zip(self.rows("out", "extremes.csv"), (0, 2)):
            self.assertEqual([row[k] for k in ("method", "runs", "most_probable", "low", "below_0.9_high")],
                             ["gumbel", str(runs), "", "", ""])
            self.assertIn(f"No answer: {runs} block maxima are too few", row["note"])
        rows = self.rows("out")
        self.assertEqual([r["status"] for r in rows], ["failed", "failed", "finished", "finished"])
        self.assertIn("run.speed_limit", rows[0]["reason"])
        self.assertEqual(rows[0]["load_mean[N]"], "")
        self.assertEqual(self.rows("out", "conditions.csv")[0]["failed"], "2")
        page = (self.at / "out" / "study.html").read_text()
        self.assertTrue("<td>2, 2 failed</td>" in page)
        self.assertNotIn("<td>0 (0 to 0)</td>", page)
        for seed in (1, 2):
            self.assertTrue(f"<td>1</td><td>{seed}</td><td>the simulation went wrong" in page)
        # Of the condition without an answer the charts show nothing: a band has no corner at it.
        for text in re.findall("data:image/svg.xml;base64,([^\"]*)", page):
            for band in re.findall('fill-opacity:0.18;" d="([^"]*)"', base64.b64decode(text).decode()):
                corners = {float(x) for x in re.findall("[ML] ([0-9.]+) [0-9.]+", band)}
                self.assertLess(max(corners) - min(corners), 30, band)
        self.assertEqual(self.fram(study, "-o", self.at / "out")["made"], 0)
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], capture_output=True, text=True)
        self.assertIn("condition 1, seed 1: the simulation went wrong", done.stderr)
        self.assertEqual(self.fram(study, "-o", self.at / "out", "--retry")["made"], 2)
        if (self.at / "out" / "study.nc").exists():
            self.assertEqual(self.netcdf("out")["status"][1], [[2, 2], [1, 1]])

    def test_the_reason_of_a_failure_is_told_whole(self):
        study = self.write("seeds: 2\nset: {run.speed_limit: 2.0001, run.duration: 9}\n")
        self.fram(study, "-o", self.at / "out", code=1)
        said = {r["seed"]: r["reason"] for r in self.rows("out")}
        self.assertGreater(max(map(len, said.values())), 255)
        for note in (self.at / "out" / "runs").glob("*/*/run.json"):
            self.assertEqual(json.loads(note.read_text())["message"], said[note.parent.name])

    def test_what_would_be_submitted_is_no_result(self):
        study = self.write("seeds: 2\n")
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--on", "slurm", "--dry-run"], check=True,
                              capture_output=True, text=True)
        self.assertIn("#SBATCH", done.stdout)
        self.assertIn("0 runs of 1 condition, 0 failed; nothing was submitted", done.stderr)
        self.assertNotIn("study.html", done.stderr)
        page = (self.at / "out" / "study.html").read_text()
        self.assertIn("No run has ended yet", page)
        for empty in ("Seeds and means", "Worst runs"):
            self.assertNotIn(empty, page)
        self.fram(study, "-o", self.at / "out")
        page = (self.at / "out" / "study.html").read_text()
        self.assertNotIn("No run has ended yet", page)
        # Commands are broken into lines where the page ends.
        self.assertRegex(page, '<td class="command"><code>fram run')
        self.assertRegex(page, r"td\.command{white-space:normal")

    def test_what_fails_throughout_is_no_success_and_asks_for_no_more_seeds(self):
        study = self.write("seeds: {least: 2, most: 9, mean_within: 0.1}\n"
                           "set: {run.speed_limit: 2.1, vessel.mass: 1.0e6}\n")
        result = self.fram(study, "-o", self.at / "out", code=1)
        self.assertEqual((result["runs"], result["failed"]), (2, 2))
        page = (self.at / "out" / "study.html").read_text()
        for empty in ("Seeds and means", "Worst runs"):
            self.assertNotIn(empty, page)

    def test_vessels_that_cannot_be_built_are_told_before_anything_runs(self):
        study = self.write("seeds: 2\nvary:\n  grid: {vessel.mass: [1.0e6, 1.0e8, 1.2e6]}\n")
        for words in (("check", study), (study, "-o", self.at / "out")):
            error = self.fram(*words, code=2)["error"]
            self.assertEqual((error["file"], error["line"], error["key"]), (str(study), 4, "vessel.mass"))
            self.assertIn("condition 2 (vessel.mass=1.0e8)", error["message"])
        self.assertEqual(list(self.at.glob("out/runs/*/*")), [])

    @WHOLE
    def test_seeds_go_on_until_the_interval_is_narrow(self):
        study = self.write("seeds: {least: 2, most: 9, mean_within: 0.08, confidence: 0.9}\n")
        rows = self.fram(study, "-o", self.at / "out")["runs"]
        self.assertGreater(rows, 2)
        mean = self.rows("out", "conditions.csv")[0]
        narrow = float(mean["load_mean_half[N]"]) <= 0.08 * float(mean["load_mean[N]"])
        self.assertTrue(narrow or rows == 9)
        extent = self.fram("check", study)
        self.assertEqual((extent["runs_least"], extent["runs_most"]), (2, 9))
        # The page asks for more seeds where the study would, not where half the interval is over a tenth.
        for within, tells in (("1", None), ("0.001", "wider than 0.1 % of the mean")):
            asked = self.write(f"seeds: {{least: 2, most: 3, mean_within: {within}}}\n")
            self.fram(asked, "-o", self.at / "out")
            page = (self.at / "out" / "study.html").read_text()
            self.assertEqual("Seeds with &quot;more&quot;" in page or 'Seeds with "more"' in page, tells is not None)
            self.assertIn(tells or "Conditions", page)
        # Until a rare load is known: ten runs carry a law, and any interval will do.
        rare = self.write("seeds: {least: 4, most: 14, extreme_within: 1}\nextremes: {duration: 30s}\n")
        self.assertEqual(self.fram(rare, "-o", self.at / "rare")["runs"], 10)
        self.assertEqual(self.fram("list", self.at / "rare")["list"][0]["wanted"], 10)
        self.assertIn("extreme_within: 1", (self.at / "rare" / "effective.yaml").read_text())
        # The program of a run that is short takes its time all the same.
        self.assertGreater(extent["run_s"], 0.1)
        self.assertGreaterEqual(extent["run_s_packed"], extent["run_s"])

    def test_seeds_that_draw_nothing_are_told(self):
        ice = "ice: {source: floes, floes: [{length: 8, width: 8, x: -1}]}"
        (self.at / "still.yaml").write_text(re.sub("ice: .*", ice, (self.at / "base.yaml").read_text()))
        for scene, tells in (("base", False), ("still", True)):
            study = self.write("")
            study.write_text(f"scenario: {scene}.yaml\nseeds: 2\nset: {{run.duration: 1.5, run.transient: 0.5}}\n")
            done = subprocess.run([FRAM, "study", study, "-o", self.at / scene], check=True, capture_output=True,
                                  text=True)
            told = "1 of 1 conditions: all runs came out the same, since nothing that run.seed" in done.stderr
            self.assertEqual(told, tells, done.stderr)

    def test_check_and_list_refuse_what_they_have_no_use_for(self):
        study = self.write("seeds: 1\nset: {run.duration: 0.2, run.transient: 0.1}\n")
        self.fram(study, "-o", self.at / "out")
        for words in (("-o", self.at / "other"), ("--retry",), ("--on", "slurm"), ("--dry-run",), ("--poll", 5)):
            for call in (("check", study), ("list", self.at / "out")):
                error = self.fram(*call, *words, code=2)["error"]
                self.assertIn("leave it out", error["message"], words)
                self.assertIn(error["key"], ("--output", *words))
        self.assertFalse((self.at / "other").exists())
        self.assertEqual(self.fram("check", study, "-j", 1)["jobs"], 1)
        for call, jobs in ((("list", self.at / "out"), 1), (("list", self.at / "out"), -1), (("check", study), -1),
                           (("check", study), 4097)):
            self.assertEqual(self.fram(*call, "-j", jobs, code=2)["error"]["key"], "--jobs")

    def test_what_a_study_takes_is_told_for_what_can_be_done_at_once(self):
        def told(text, jobs):
            done = subprocess.run([FRAM, "study", "check", self.write(text), "--jobs", str(jobs)], check=True,
                                  capture_output=True, text=True)
            scale = {"s": 1, "min": 60, "h": 3600, "days": 86400}
            one, total = (re.search(name + ": about ([0-9.e+-]+) ([a-z]+)", done.stdout).groups()
                          for name in ("one run", "total"))
            return float(total[0]) * scale[total[1]] / (float(one[0]) * scale[one[1]]), done.stdout
        # One run is no faster on four cores; the fifth of five waits.
        for seeds, jobs, turns in ((1, 4, 1), (5, 4, 2), (6, 2, 3)):
            ratio, text = told(f"seeds: {seeds}\n", jobs)
            self.assertAlmostEqual(ratio, turns, delta=0.02 * turns, msg=text)
            self.assertNotIn("told by the first", text)
        self.assertEqual(self.fram("check", self.at / "study.yaml")["run_seen"], 1)
        # Conditions that are the same scenario take their runs once; without a number of jobs it is that of the run.
        study = self.write("seeds: 3\nvary: {list: [{vessel.speed: 1.5}, {vessel.speed: 2}, {vessel.speed: 1.50}]}\n")
        told = self.fram("check", study)
        self.assertEqual([told[k] for k in ("conditions", "different", "runs_least", "runs_most")], [3, 2, 6, 6])
        self.assertLessEqual(told["jobs"], len(os.sched_getaffinity(0)))
        core = str(min(os.sched_getaffinity(0)))
        one = subprocess.run(["taskset", "-c", core, FRAM, "study", "check", study, "--json"], check=True,
                             capture_output=True, text=True)
        self.assertEqual(json.loads(one.stdout)["jobs"], 1)

    @WHOLE
    def test_conditions_of_a_list_a_table_and_a_hypercube(self):
        study = self.write("vary:\n  list:\n    - {vessel.speed: 1.5, ice.thickness: 0.5}\n"
                           "    - {vessel.speed: 2, ice.thickness: 1}\n")
        self.assertEqual(self.fram("check", study)["conditions"], 2)
        (self.at / "c.csv").write_text("vessel.speed[m/s],run.solver.iterations\n1.5,20.0\n2,20\n2,20.0\n")
        self.assertEqual(self.fram("check", self.write("vary: {table: c.csv}\n"))["different"], 2)
        latin = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary:\n  latin: {count: 8, seed: 3, keys: "
                           "{vessel.speed: [1, 2], ice.thickness: [0.4, 1.2]}}\n")
        self.fram(latin, "-o", self.at / "out")
        rows, orders = self.rows("out"), []
        for key, lo, hi in (("vessel.speed", 1, 2), ("ice.thickness", 0.4, 1.2)):
            places = [(float(r[key]) - lo) / (hi - lo) * 8 for r in rows]
            self.assertEqual(sorted(int(p) for p in places), list(range(8)))
            # Each anywhere in its stratum, and the strata of one key in another order than those of the other.
            self.assertGreater(max(p % 1 for p in places) - min(p % 1 for p in places), 0.3)
            orders.append([int(p) for p in places])
        self.assertNotEqual(*orders)
        self.refused("vary:\n  table:\n", "study.yaml:3: table", "expected the name of a CSV file")
        self.refused("vary: {grid: {run.seed: [1, 2]}}\n", "study.yaml:2", "seeds are given by")
        # Texts too, and mistakes at their place in the table; but those of `set` in the study file.
        (self.at / "c.csv").write_text('vessel.mode,"ice.thickness[m]"\r\n"towed",1\r\n\r\ntowed,-1\r\n')
        table = "vary: {table: c.csv}\n"
        self.refused(table, "c.csv:4: ice.thickness", "condition 2", "-1")
        self.refused("set: {vessel.speed: fast}\n" + table, "study.yaml:2: vessel.speed")
        self.refused("seeds: 100000\nvary: {latin: {count: 1000, keys: {vessel.speed: [1, 2]}}}\n", "seeds",
                     "100000000 runs")

    def test_ctrl_c_keeps_what_ended(self):
        study = self.write("set: {run.duration: %g}\nseeds: 20\nextremes: {duration: 1min}\n" % (1.5 if SHORT else 5))
        process = subprocess.Popen([FRAM, "study", study, "-o", self.at / "out", "--jobs=2"], stderr=subprocess.DEVNULL)
        end = time.monotonic() + 60
        while len(list(self.at.glob("out/runs/*/*.row"))) < 11 and time.monotonic() < end:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        there = len(self.rows("out"))
        self.assertEqual((there < 20, self.rows("out", "extremes.csv")[0]["runs"]), (True, str(there)))
        self.assertEqual(self.fram(study, "-o", self.at / "out")["runs"], 20)

    @WHOLE
    def test_the_page_and_the_netcdf_file(self):
        study = self.write("seeds: {least: 2, first: 4}\nkeep: series\n"
                           "vary: {grid: {ice.thickness: [0.5, 1], vessel.speed: [2, 2.5]}}\n")
        self.fram(study, "-o", self.at / "out")
        rows = self.rows("out")
        # Options of commands are not broken into lines.
        page = re.sub("</?i>", "", (self.at / "out" / "study.html").read_text())
        worst = max(rows, key=lambda r: float(r["load_largest[N]"]))
        # Shares of mechanisms in the order of their heads, of the last condition.
        names = re.findall("<th[^>]*>([a-z]+)</th>", page[page.index("Mechanisms of the load"):])[:8]
        last = self.rows("out", "conditions.csv")[3]
        cells = [f"{100 * float(last[f'share_{n}[1]']):.1f} ± {100 * float(last[f'share_{n}_half[1]']):.1f}"
                 for n in names]
        for words in ("Heat maps", "Worst runs", "</td><td>".join(cells), "<b>8", "Largest load", "image/svg",
                      f"--set run.seed={worst['seed']} --set output.frame_interval=1"):
            self.assertTrue(words in page, words)
        self.assertNotIn("thruster power", page)
        # Keys have their units in heads and over heat maps.
        for words in (">ice.thickness [m]</th>", "ice.thickness [m] downwards, vessel.speed [m/s] across"):
            self.assertTrue(words in page.replace("\u200b", ""), words)
        # The uncertainty, to two digits, decides how many digits a mean has.
        mean, half = (float(last[n]) * 1e-3 for n in ("load_mean[N]", "load_mean_half[N]"))
        decimals = 1 - math.floor(math.log10(half))
        shown = [f"{round(x, decimals):.{max(decimals, 0)}f}" for x in (mean, half)]
        self.assertIn(f"<td>{shown[0]} ± {shown[1]}<", page)
        self.assertNotIn("Rare loads", page)
        # The command of the worst run makes its record and playback; given again, the study links to it.
        command, name = re.search("<code>(fram run [^<]* fram view worst/([^<]*))</code>", page).groups()
        command = command.replace("&amp;&amp;", "&&").replace("fram ", FRAM + " ").replace("-o ", "--quiet -o ")
        done = subprocess.run(command, shell=True, cwd=self.at / "out", capture_output=True, text=True)
        if "make viewer" not in done.stderr:
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((self.at / "out" / "worst" / name / "playback.html").exists())
        self.fram(study, "-o", self.at / "out")
        self.assertIn(f'<a href="worst/{name}/playback.html">playback</a>' if done.returncode == 0 else
                      f"<code>fram view worst/{name}</code> makes it", (self.at / "out" / "study.html").read_text())
        if not (self.at / "out" / "study.nc").exists():
            self.skipTest("this build has no NetCDF")
        data = self.netcdf("out")
        self.assertEqual([data[n][1] for n in ("condition", "seed", "status")], [[1, 2, 3, 4], [4, 5], [[1, 1]] * 4])
        self.assertEqual(data["ice.thickness"], ["m", [0.5, 0.5, 1, 1]])
        for head in (h for h in rows[0] if "[" in h):
            name, unit = head[:-1].split("[")
            told = [None if math.isnan(x) else x for of in data[name][1] for x in of]
            self.assertEqual([data[name][0], told], [unit, [float(r[head]) if r[head] else None for r in rows]], name)

    @WHOLE
    def test_words_of_keys_stand_in_the_netcdf_file(self):
        words = ["a, b", "\u00fcber", "3"]
        study = self.write("seeds: 1\nset: {run.duration: 0.2, run.transient: 0.1}\n"
                           f"vary: {{list: {json.dumps([{'title': w, 'ice.breakable': w == '3'} for w in words])}}}\n")
        for folder in ("out", "again"):
            self.fram(study, "-o", self.at / folder)
        file = self.at / "out" / "study.nc"
        if not file.exists():
            self.skipTest("this build has no NetCDF")
        self.assertEqual(file.read_bytes(), (self.at / "again" / "study.nc").read_bytes())
        data = self.netcdf("out")
        self.assertEqual([data[name][1] for name in ("title", "ice.breakable")], [words, [0, 0, 1]])

    @WHOLE
    def test_extremes_of_conditions_and_of_a_year(self):
        study = self.write("seeds: 12\nvary: {grid: {vessel.speed: [2, 2.5]}}\n"
                           "extremes: {duration: 10min, method: gumbel, levels: [0.9], hours: [100, 20], "
                           "annual: [1e-2, 1e-4]}\n")
        self.fram(study, "-o", self.at / "out")
        rows = self.rows("out", "extremes.csv")
        self.assertEqual([(r["condition"], r["figure"], r["runs"]) for r in rows],
                         [("1", "load_largest", "12"), ("2", "load_largest", "12")])
        # The command says the same of the same largest loads.
        with open(self.at / "out" / "summary.csv") as file:
            lines = file.read().splitlines()
        (self.at / "second.csv").write_text("\n".join([lines[0], *lines[13:]]) + "\n")
        done = subprocess.run([FRAM, "extremes", self.at / "second.csv", "--channel", "load_largest", "--maxima",
                               "--block", "2", "--duration", "10min", "--method", "gumbel", "--level", "0.9", "--json"],
                              capture_output=True, text=True, check=True)
        said = json.loads(done.stdout.splitlines()[-1])["methods"][0]
        for name, level in (("most_probable", said["most_probable"]), ("below_0.9", said["levels"][0])):
            self.assertAlmostEqual(float(rows[1][name]) / level["level"], 1, delta=1e-12)
        self.assertLess(float(rows[1]["low"]), float(rows[1]["most_probable"]))
        self.assertLess(float(rows[1]["most_probable"]), float(rows[1]["high"]))
        # The page has the same, to three digits, and a plot of each condition.
        page = (self.at / "out" / "study.html").read_text()
        cell = "%.3g (%.3g to %.3g)" % tuple(float(rows[1][n]) * 1e-3 for n in ("most_probable", "low", "high"))
        self.assertIn(f"<td>{cell}</td>", page[page.index("Rare loads"):])
        self.assertIn("Levels of 10 min by Gumbel", page)
        year = self.rows("out", "annual.csv")
        self.assertEqual([float(r["annual_probability"]) for r in year], [1e-2, 1e-4])
        # By hand: the level where 180,000 and 36,000 blocks expect -log(1 - p) exceedances.
        fits = []
        for i in (0, 12):
            (self.at / "one.csv").write_text("\n".join([lines[0], *lines[1 + i:13 + i]]) + "\n")
            done = subprocess.run([FRAM, "extremes", self.at / "one.csv", "--channel", "load_largest", "--maxima",
                                   "--block", "2", "--method", "gumbel", "--json"],
                                  capture_output=True, text=True, check=True)
            fits.append(json.loads(done.stdout.splitlines()[-1])["methods"][0])
        for row, p in zip(year, (1e-2, 1e-4)):
            x = float(row["level"])
            expected = sum(1800 * h * math.exp(-(x - f["location"]) / f["scale"]) for h, f in zip((100, 20), fits))
            self.assertAlmostEqual(expected / -math.log1p(-p), 1, delta=1e-6)
            self.assertTrue(float(row["low"]) < x < float(row["high"]))
        # The same by a scatter diagram: a table of conditions with a column of hours.
        (self.at / "scatter.csv").write_text("hours[h],vessel.speed[m/s]\n100,2\n20,2.5\n")
        before = (self.at / "out" / "annual.csv").read_bytes()
        ask = ("seeds: 12\nvary: {table: scatter.csv}\n"
               "extremes: {duration: 10min, levels: [0.9], annual: [1e-2, 1e-4]%s}\n")
        told = self.fram(self.write(ask % ""), "-o", self.at / "out")
        self.assertEqual((told["made"], (self.at / "out" / "annual.csv").read_bytes()), (0, before))
        self.assertIn("hours: [100, 20]", (self.at / "out" / "effective.yaml").read_text())
        self.refused((ask % ", hours: [100, 20]"), "study.yaml:4: hours", "remove one")
        self.refused("vary: {grid: {vessel.speed: [2, 2.5]}}\nextremes: {annual: [0.1]}\n",
                     "annual levels take `hours`")
        self.refused("vary: {grid: {vessel.speed: [2, 2.5]}}\nextremes: {hours: [5000, 5000], annual: [0.1]}\n",
                     "at most 8784, found 10000")
        # Without a year the rest stays; the runs are there.
        self.fram(self.write("seeds: 12\nvary: {grid: {vessel.speed: [2, 2.5]}}\n"
                             "extremes: {duration: 10min, method: gumbel, levels: [0.9]}\n"), "-o", self.at / "out")
        self.assertEqual(self.rows("out", "extremes.csv"), rows)
        self.assertFalse((self.at / "out" / "annual.csv").exists())
        # By gev twelve runs do not tell the shape of a tail as far out as that.
        self.fram(self.write("seeds: 12\nvary: {grid: {vessel.speed: [2, 2.5]}}\n"
                             "extremes: {method: gev, hours: [100, 20], annual: [1e-2]}\n"), "-o", self.at / "out")
        (year,) = self.rows("out", "annual.csv")
        self.assertEqual((year["level"], year["high"]), ("", ""))
        # 0.4767 log(180,000/0.01005)^2 = 132.8.
        self.assertIn("133 runs of condition 1, which has 12", year["note"])
        few = self.write("set: {run.duration: 1, run.transient: 0.5}\nseeds: 3\n"
                         "extremes: {hours: [10], annual: [0.1]}\n")
        self.fram(few, "-o", self.at / "few")
        self.assertIn("too few", self.rows("few", "extremes.csv")[0]["note"])
        self.assertIn("condition 1", self.rows("few", "annual.csv")[0]["note"])
        # Tables that a study no longer asks for are of the one before.
        (self.at / "few" / "sensitivity.csv").touch()
        self.fram(self.write("set: {run.duration: 1, run.transient: 0.5}\nseeds: 3\n"), "-o", self.at / "few")
        for name in ("extremes.csv", "annual.csv", "sensitivity.csv"):
            self.assertFalse((self.at / "few" / name).exists(), name)

    @WHOLE
    def test_conditions_that_are_the_same_scenario_share_their_runs(self):
        # As Morris' designs on few levels have them: their runs have one folder, and are made once.
        base = "set: {run.duration: 0.3, run.transient: 0.1}\nkeep: summary\n"
        same = ("vary: {list: [{vessel.speed: 1, ice.thickness: 1}, {ice.thickness: 1, vessel.speed: 2}, "
                "{ice.thickness: 1, vessel.speed: 1}, {vessel.speed: 1.0, ice.thickness: 1}]}\n")
        told = self.fram(self.write(base + "seeds: 2\n" + same), "-o", self.at / "twins", "--jobs", 4)
        self.assertEqual((told["runs"], told["made"], told["failed"]), (8, 4, 0))
        told = self.fram(self.write(base + "seeds: 3\n" + same), "-o", self.at / "twins", "--jobs", 4)
        self.assertEqual((told["runs"], told["made"], told["failed"]), (12, 2, 0))
        rows = self.rows("twins")
        for seed in range(3):
            first, other, *twins = [rows[3 * c + seed] for c in range(4)]
            self.assertNotEqual(first["state_hash"], other["state_hash"])
            self.assertEqual([t["state_hash"] for t in twins], 2 * [first["state_hash"]])

    @WHOLE
    def test_which_input_moves_the_load(self):
        if not SHORT:  # its sums stand in tests/study/test_sensitivity.c
            study = self.write("vary: {sobol: {count: 10, keys: {vessel.speed: [1, 2], output.averaging_window: "
                               "[0.1, 0.2]}}}\n")
            self.assertEqual(self.fram(study, "-o", self.at / "sobol")["runs"], 40)
            rows = self.rows("sobol", "sensitivity.csv")
            self.assertEqual([r["key"] for r in rows[:2]], ["vessel.speed", "output.averaging_window"])
            self.assertGreater(float(rows[0]["total"]), 0)
        study = self.write("vary: {morris: {count: 3, levels: 6, seed: 2, keys: {vessel.speed: [1, 2], "
                           "output.averaging_window: [0.1, 0.3], output.frame_interval: [0.1, 0.4]}}}\n")
        self.assertEqual(self.fram(study, "-o", self.at / "morris")["runs"], 12)
        rows = self.rows("morris", "sensitivity.csv")
        # The effective study is the design, not its points alone.
        table, other = (self.at / "morris" / "sensitivity.csv").read_bytes(), self.at / "other.yaml"
        for design, runs in (("morris", 12), *([] if SHORT else [("sobol", 40)])):
            effective = (self.at / design / "effective.yaml").read_text()
            self.assertEqual(len(re.findall('^#   - {"vessel.speed": ', effective, re.M)), runs)
            other.write_text(effective)
            told = self.fram(other, "-o", self.at / design)
            self.assertEqual((told["runs"], told["made"]), (runs, 0))
            self.assertFalse((self.at / design / "differences.csv").exists())
        self.assertEqual((self.at / "morris" / "sensitivity.csv").read_bytes(), table)
        page = (self.at / "morris" / "study.html").read_text()
        self.assertIn("Morris' effects", page)
        # A longer window makes the largest load smaller.
        row = next(r for r in rows if r["figure"] == "load_largest" and r["key"] == "output.averaging_window")
        self.assertLess(float(row["mu"]), 0)
        cells = "<td[^>]*>([^<]*)</td>" * 3
        shown = re.search('row">Largest load</th><td>output.averaging_window</td><td>kN</td>' + cells, page).groups()
        for text, name in zip(shown, ("mu_star", "mu", "sigma")):
            value = float(row[name]) / 1000
            self.assertAlmostEqual(float(text), value, delta=0.006 * abs(value))
        # How often frames are recorded moves no load.
        self.assertEqual([float(r["mu_star"]) for r in rows if r["key"] == "output.frame_interval"],
                         [0] * (len(rows) // 3))
        self.assertTrue(all(r["note"] == "" for r in rows if r["key"] == "vessel.speed"))
        # Where nothing moves the table says so.
        study = self.write("set: {run.duration: 0.1, run.transient: 0, ice.concentration: 0.1}\n"
                           "vary: {sobol: {count: 10, keys: {output.frame_interval: [0.1, 0.4]}}}\n")
        self.fram(study, "-o", self.at / "none")
        for row in self.rows("none", "sensitivity.csv"):
            self.assertEqual((row["first"], row["total"]), ("", ""))
            self.assertIn("all values are equal", row["note"])
        self.refused("vary: {sobol: {count: 5, keys: {vessel.speed: [1, 2]}}}\n", "study.yaml:2: count", "10")
        self.refused("vary: {morris: {count: 5, levels: 3, keys: {vessel.speed: [1, 2]}}}\n", "levels", "even")
        self.refused("vary: {morris: {count: 5, keys: {vessel.speed: [1, 1]}}}\n", "vessel.speed", "wider")
        self.refused("vary: {morrris: {count: 5}}\n", "study.yaml:2: vary.morrris", "did you mean morris?")
        self.refused("extremes: {methd: gev}\n", "study.yaml:2: extremes.methd", "did you mean method?")
        self.refused("extremes: {method: pot}\n", "study.yaml:2: method", "keep: series")
        self.refused("extremes: {duration: 3x}\n", "duration", "3x")
        self.refused("extremes: {hours: [1, 2], annual: [0.01]}\n", "hours", "1 conditions, found 2")
        self.refused("extremes: {annual: [0.01]}\n", "study.yaml:2: hours", "annual levels take")
        self.refused("extremes: {hours: [9000], annual: [0.01]}\n", "hours", "8784")
        self.refused("extremes: {levels: [1]}\n", "levels", "to 0.999999999, found 1")
        self.refused("esdes: 3\n", "esdes", "did you mean seeds?")

    def test_mistakes_are_told_at_their_place(self):
        self.refused("vary: {grid: {ice.thicknes: [1]}}\n", "study.yaml:2: ice.thicknes",
                     "condition 1 (ice.thicknes=1): ")
        # One of several conditions is told with its values, wherever the mistake is: in a value of the study, in a key
        # of the scenario that the value makes wrong, and in what is only found when the field is made.
        self.refused("vary: {grid: {ice.thickness: [1, 2], domain.x_min: [-64, 0]}}\n", "base.yaml:3: vessel.x: "
                     "condition 2 (ice.thickness=1, domain.x_min=0): expected vessel.x")
        self.refused("vary:\n  grid: {ice.concentration: [0.5, 0.9999]}\n", "study.yaml:3: ice.concentration: "
                     "condition 2 (ice.concentration=0.9999): concentration")
        self.refused("set:\n  run.duration: -1\n", "study.yaml:3: run.duration")
        for wrong, right in (("extrem_within", "extreme_within"), ("max_within", "largest_within"),
                             ("min", "least"), ("maximum", "most"), ("mean_witin", "mean_within")):
            self.refused(f"seeds: {{{wrong}: 2}}\n", f"study.yaml:2: seeds.{wrong}", f"did you mean {right}?")
        # Not taken for the key before the sign, with a value that begins behind it.
        self.refused("set: {title=a: b}\n", "study.yaml:2: title=a: expected a key")
        self.refused("vary: {grid: {title=a: [b, c]}}\n", "study.yaml:2: title=a: expected a key")
        (self.at / "c.csv").write_text("title=a\nb\n")
        self.refused("vary: {table: c.csv}\n", "c.csv:0: title=a: expected a key")
        self.refused("seeds: 0\n", "study.yaml:2: seeds")
        self.refused("seeds: 0x10\n", "study.yaml:2: seeds")
        self.refused("seeds: {least: 5, most: 9}\n", "mean_within")
        for key in ("mean_within", "largest_within", "extreme_within"):
            self.refused(f"seeds: {{least: 5, most: 9, {key}: 5}}\n", f"2: {key}: expected a part", "per cent are 0.05")
        self.refused("seeds: {least: 1, most: 9, mean_within: 0.1}\n", "two seeds")
        self.refused("seeds:\n  least: 4\n  most: 40\n  extreme_within: 0.1\n",
                     "study.yaml:5: extreme_within: takes `extremes`")
        self.refused("seeds: {least: 4, most: 9, extreme_within: 0.1}\nextremes: {duration: 3h}\n",
                     "study.yaml:2: extreme_within: expected most from 10 on")
        self.refused("vary: {grid: {run.seed: [1, 2]}}\n", "run.seed", "`seeds`")
        self.refused("vary: {grid: {vessel.speed: []}}\n", "vessel.speed")
        self.refused("vary: {list: [{vessel.speed: 1}, {ice.thickness: 1}]}\n", "alone, as vessel.speed")
        self.refused("vary: {list: [{vessel.speed: 1, ice.thickness: 1}, {ice.thickness: 1}]}\n", "speed is missing")
        self.refused("vary: {latin: {count: 3, keys: {vessel.speed: [2, 1]}}}\n",
                     "study.yaml:2: vessel.speed: expected the smaller end first, as [1, 2]")
        self.refused("vary: {table: none.csv}\n", "none.csv")
        self.refused("nonsense: 1\n", "study.yaml:2: nonsense")
        (self.at / "empty.yaml").write_text("")
        self.assertIn("no study", self.fram("check", self.at / "empty.yaml", code=2)["error"]["message"])
        self.fram(self.at / "none.yaml", "-o", self.at / "out", code=2)
        error = self.fram(self.write("seeds: 1\n"), "-o", self.at / "out", "--poll", "5", code=2)["error"]
        self.assertIn("slurm alone", error["message"])
        # A study that was killed in its first moment leaves a part of its first file, which is in nobody's way.
        (self.at / "begun").mkdir()
        (self.at / "begun" / ("study.yaml." + "0" * 16 + ".new")).write_text("scen")
        self.fram(self.write("set: {run.duration: 0.1, run.transient: 0}\nseeds: 1\n"), "-o", self.at / "begun")
        # A folder that holds something else stays as it is.
        (self.at / "full").mkdir()
        (self.at / "full" / "letter.txt").write_text("x")
        self.fram(self.write("seeds: 1\n"), "-o", self.at / "full", code=2)
        self.assertEqual([p.name for p in (self.at / "full").iterdir()], ["letter.txt"])
        # One key is one, however an item of a list is called.
        (self.at / "base.yaml").write_text(BASE.replace("vessel: {", "vessels: [{name: a, ").replace("2}}", "2}}]"))
        (self.at / "c.csv").write_text("vessels.a.speed,vessels[0].speed\n1,2\n")
        for text, at in (('vary: {grid: {vessels.a.speed: [1], "vessels[0].speed": [5]}}', "study.yaml:2: vessels[0]"),
                         ("set: {vessels.0.speed: 1, vessels.a.speed: 2}", "study.yaml:2: vessels.a"),
                         ("vary: {table: c.csv}", "c.csv:0: vessels[0]")):
            self.refused(text + "\n", at + ".speed: is the same key as vessels.")


if __name__ == "__main__":
    unittest.main()
