#!/usr/bin/env python3
"""fram extremes and fram fatigue: fits beside those of scipy and R's evd where they are installed, and bad input."""
import csv
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import unittest

FRAM = os.environ["FRAM"]
# Debian's packages belong to Debian's interpreter, which need not be the one that runs this.
SCIPY = """
import json, sys
import numpy as np
from scipy import stats
from scipy.optimize import minimize
y = np.array(json.loads(sys.stdin.read()))
def best(law, start):
    options = dict(xatol=1e-11, fatol=1e-12, maxiter=20000, maxfev=20000)
    return minimize(lambda p: law(p), start, method="Nelder-Mead", options=options).x
loc, scale = stats.gumbel_r.fit(y)
g = best(lambda p: stats.genextreme.nnlf((-p[2], p[0], np.exp(p[1])), y), [loc, np.log(scale), 0.01])
print(json.dumps({"gumbel": [loc, scale, 0], "gev": [g[0], np.exp(g[1]), g[2]]}))
"""
EVD = """
suppressMessages(library(evd)); y <- scan("stdin", quiet = TRUE)
g <- fgev(y, control = list(reltol = 1e-14)); cat(g$estimate, "\\n")
"""


def sample():
    numbers = random.Random(5)
    return [round(10 - 2 * math.log(numbers.expovariate(1)), 6) for _ in range(80)]


SCENE = """run: {duration: 2, time_step: 0.05}
vessel: {mode: towed, speed: 1, hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}}
ice: {source: floes, floes: [{x: 14, length: 6, width: 6}]}
domain: {x_min: -60, x_max: 60, y_min: -60, y_max: 60, boundary: open}
"""

MOORED = """run: {duration: 0.6, time_step: 0.1, transient: 0}
vessel:
  mode: free
  hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}
  mooring:
    depth: 50
    lines: [{kind: spring, count: 4, spacing_deg: 90, distance: 200, pretension: 5.0e+4, stiffness: 1.0e+5,
             release_time: 0.1}]
ice: {source: none}
domain: {x_min: -60, x_max: 60, y_min: -60, y_max: 60, boundary: open}
"""


class Statistics(unittest.TestCase):
    def setUp(self):
        self.at = pathlib.Path(tempfile.mkdtemp(prefix="fram-statistics-"))
        self.addCleanup(shutil.rmtree, self.at)

    def fram(self, *words, code=0):
        done = subprocess.run([FRAM, *map(str, words), "--json"], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    def write(self, text, name="series.csv"):
        (self.at / name).write_text(text)
        return self.at / name

    def maxima(self):
        file = self.write("status,load[kN]\n" + "".join(f"\"a, b\",{x}\n" for x in sample()) + "failed,\n")
        got = self.fram("extremes", file, "--channel", "load", "--maxima", "--block", "10min")
        self.assertEqual((got["series"]["values"], got["series"]["unit"]), (80, "kN"))
        return {m["method"]: [m["location"], m["scale"], m["shape"]] for m in got["methods"]}

    def close(self, got, wanted, tolerance):
        for a, b in zip(got, wanted):
            self.assertAlmostEqual(a, b, delta=tolerance)

    def test_fits_are_those_of_scipy(self):
        try:
            done = subprocess.run(["/usr/bin/python3", "-c", SCIPY], input=json.dumps(sample()), capture_output=True,
                                  text=True)
        except FileNotFoundError:
            self.skipTest("no /usr/bin/python3")
        if done.returncode:
            self.skipTest("python3-scipy is not installed")
        ours = self.maxima()
        for method, wanted in json.loads(done.stdout).items():
            self.close(ours[method], wanted, 1e-4)

    def test_fits_are_those_of_evd(self):
        if not shutil.which("Rscript"):
            self.skipTest("r-base-core is not installed")
        done = subprocess.run(["Rscript", "-e", EVD], input="\n".join(map(str, sample())), capture_output=True,
                              text=True)
        if done.returncode:
            self.skipTest("r-cran-evd is not installed")
        self.close(self.maxima()["gev"], [float(x) for x in done.stdout.split()], 2e-3)

    def test_levels_of_gumbel_follow_from_its_law(self):
        location, scale, _ = self.maxima()["gumbel"]
        got = self.fram("extremes", self.at / "series.csv", "--channel", "load", "--maxima", "--block", "10min",
                        "--method", "gumbel", "--duration", "3h", "--level", "0.9")["methods"][0]
        self.assertAlmostEqual(got["most_probable"]["level"], location + scale * math.log(18), delta=1e-9)
        level = got["levels"][0]
        self.assertAlmostEqual(level["level"], location + scale * math.log(18 / -math.log(0.9)), delta=1e-9)
        self.assertTrue(level["low"] < level["level"] < level["high"])

    def test_less_confidence_is_a_narrower_interval(self):
        numbers = random.Random(7)
        file = self.write("x\n" + "".join(f"{numbers.gauss(0, 1)}\n" for _ in range(1500)))
        every = {"acer", "upcrossing", "gumbel", "gev", "pot", "weibull"}
        for fit, answered in (("likelihood", every), ("moments", every - {"weibull"})):
            told = {}
            for confidence in (0.5, 0.95):
                got = self.fram("extremes", file, "--channel", "x", "--step", 1, "--duration", "1h", "--level", "0.9",
                                "--confidence", confidence, "--fit", fit)
                self.assertEqual(got["confidence"], confidence)
                told[confidence] = {m["method"]: (m["most_probable"], m["levels"][0]) for m in got["methods"]
                                    if m["answered"]}
            self.assertEqual(set(told[0.5]), answered)
            for method, levels in told[0.5].items():
                for less, more in zip(levels, told[0.95][method]):
                    self.assertEqual(less["level"], more["level"], method)
                    self.assertTrue(more["low"] < less["low"] < less["high"] < more["high"], (fit, method, less, more))

    def test_waves_and_minima(self):
        # A sine has one range, and its least values are the greatest of the negative one.
        rows = "".join(f"{i * 0.1:.1f},{5 + 2 * math.sin(2 * math.pi * i / 40)}\n" for i in range(4001))
        file = self.write("time[s],x[m]\n" + rows)
        got = self.fram("fatigue", file, "--channel", "x", "--slope", "3,7", "--frequency", "0.25", "-o",
                        self.at / "cycles.csv")
        self.assertAlmostEqual(got["greatest_range"], 4, delta=1e-9)
        self.assertAlmostEqual(got["cycles"], 100, delta=0.51)
        for equivalent in got["equivalent"]:
            self.assertAlmostEqual(equivalent["range"], 4, delta=0.02)
        failed = self.fram("fatigue", file, "--channel", "x", "-o", self.at / "none" / "cycles.csv", code=2)
        self.assertIn("none/cycles.csv", failed["error"]["file"])
        head, *cycles = (self.at / "cycles.csv").read_text().splitlines()
        self.assertEqual(head, "range[m],mean[m],count[1]")
        cycles = [[float(word) for word in line.split(",")] for line in cycles]
        self.assertEqual(sum(count for _, _, count in cycles), got["cycles"])
        for large, mean, _ in cycles[1:-1]:  # but for where it begins and ends
            self.close((large, mean), (4, 5), 1e-6)
        self.assertAlmostEqual(got["series"]["deviation"], 2 ** 0.5, delta=1e-3)
        self.close([got["series"][name] for name in ("mean", "least", "greatest", "step_s", "time_s")],
                   (5, 3, 7, 0.1, 400.1), 1e-3)
        self.assertAlmostEqual(self.fram("extremes", file, "--channel", "x", "--minima", "--method", "gumbel")
                               ["series"]["greatest"], -3, delta=1e-9)

    def test_times_of_a_file_begin_where_they_begin(self):
        # All rows of a file are read where nothing else was asked, those before zero too; a row at --from is before it.
        file = self.write(" time[s],\t x [kN]\n" + "".join(f"{i / 10},{i * 7919 % 100}\n" for i in range(-200, 100)))
        for words, values in (((), 300), (("--from", "-5"), 149), (("--from", "0"), 100)):
            self.assertEqual(self.fram("fatigue", file, "--channel", "x", *words)["series"]["values"], values)
        # Seconds since 1970 too, among which a row that is left out is noticed.
        rows = [f"{1700000000 + i / 10:.1f},{i * 7919 % 100}\n" for i in range(100)]
        file = self.write("time,x\n" + "".join(rows))
        self.assertEqual(self.fram("fatigue", file, "--channel", "x", "--from", "1700000000")["series"]["values"], 99)
        self.write("time,x\n" + "".join(rows[:50] + rows[51:]))
        self.refused(("fatigue", file, "--channel", "x"), "series.csv:52:", "found one of 0.2 s")

    def test_a_realization_counts_once(self):
        file = self.write("time,x\n" + "".join(f"{i},{i * 7919 % 100}\n" for i in range(100)))
        copy = self.write(file.read_text(), "copy.csv")
        self.assertEqual(self.fram("fatigue", file, copy, "--channel", "x")["series"]["values"], 200)
        for command in ("fatigue", "extremes"):
            error = self.fram(command, copy, file, f"{file.parent}/./series.csv", "--channel", "x", code=2)["error"]
            self.assertIn("would count twice", error["message"])

    def test_runs_are_realizations_of_one_condition(self):
        scene = self.write(SCENE, "scene.yaml")
        runs = {}
        for name, *keys in (("first",), ("other", "run.seed=2", "run.duration=0.3", "output.frame_interval=0"),
                            ("faster", "run.seed=3", "vessel.speed=1.5", "ice.thickness=2"),
                            ("window", "run.seed=4", "output.averaging_window=0.1")):
            runs[name] = self.at / name
            self.fram("run", scene, "-o", runs[name], "--quiet", "--set", "run.duration=0.2",
                      *(word for key in keys for word in ("--set", key)))
        shutil.copytree(runs["first"], self.at / "copy")
        # As one that a program told a wind.
        runs["told"] = self.at / "told"
        shutil.copytree(runs["other"], runs["told"])
        note = (runs["told"] / "run.json").read_text()
        self.assertIn('"told": []', note)
        (runs["told"] / "run.json").write_text(note.replace('"told": []', '"told": ["wind_x"]'))
        for command in ("fatigue", "extremes"):
            self.refused((command, runs["other"], runs["first"], self.at / "copy"),
                         "copy:0:", f"is given twice ({runs['first']} is the same), and would count twice")
            for others, told in ((("other",), None), (("other", "faster", "window"), "vessel.speed is 1 in one, 1.5"),
                                 (("window",), "output.averaging_window is 0.5 in one, 0.1"),
                                 (("told",), "what a program told it is nothing in one, wind_x in the other")):
                done = subprocess.run([FRAM, command, runs["first"], *(runs[name] for name in others)],
                                      capture_output=True, text=True, check=True)
                self.assertEqual(done.stderr.count("one condition"), told is not None, done.stderr)
                if told:
                    self.assertIn(told, done.stderr)
                    self.assertIn(f"{runs['first']} and {runs[others[-2:][0]]} are taken", done.stderr)

    def test_maxima_are_of_one_condition(self):
        rows = [f"{1 if i < 40 else 2},{x},{'' if i < 40 else x}\n" for i, x in enumerate(sample())]
        file = self.write("condition,load[N],of_2[N]\n" + "".join(rows), "summary.csv")
        words = ("--maxima", "--block", "60", "--method", "gumbel", "--channel")
        self.refused(("extremes", file, *words, "load"), "summary.csv:42: condition:", "conditions 1 and 2, which are")
        self.assertEqual(self.fram("extremes", file, *words, "of_2")["series"]["values"], 40)

    def test_a_class_of_ranges_ends_with_its_end(self):
        # Ranges of 1, 2 ... 10: one in each class of `up to 1`, `up to 2` ...
        turns = [0]
        for i in range(1, 11):
            turns.append(turns[-1] + (i if i % 2 else -i))
        file = self.write("time,x\n" + "".join(f"{i},{x}\n" for i, x in enumerate(turns)))
        done = subprocess.run([FRAM, "fatigue", str(file), "--channel", "x"], capture_output=True, text=True)
        classes = [line.split()[2:] for line in done.stdout.splitlines() if line.startswith("  up to")]
        self.assertEqual(classes, [[str(i), "0.5"] for i in range(1, 11)], done.stdout)

    def test_too_little_is_told_and_no_error(self):
        file = self.write("time,x\n" + "".join(f"{i},{i % 3}\n" for i in range(30)))
        for method in self.fram("extremes", file, "--channel", "x", "--block", "10")["methods"]:
            if method["method"] in ("acer", "upcrossing", "gumbel", "gev"):
                self.assertFalse(method["answered"])
                self.assertIn("No answer", method["note"])
                self.assertIsNone(method["most_probable"]["level"])
        # What a person has asked too much of is named.
        long = self.write("time,x\n" + "".join(f"{i},{i * 7919 % 1009}\n" for i in range(4000)), "long.csv")
        for words, told in ((("--method", "acer", "--order", "3000"), "or take a lower threshold or order"),
                            (("--method", "upcrossing", "--threshold", "2000"), "or take a lower threshold")):
            self.assertIn(told, self.fram("extremes", long, "--channel", "x", *words)["methods"][0]["note"])
        still = self.write("time,x\n" + "".join(f"{i},3\n" for i in range(300)), "still.csv")
        for method in self.fram("extremes", still, "--channel", "x")["methods"]:
            self.assertIn("constant", method["note"])
        tenth = self.write("time,x\n" + "".join(f"{i},0.1\n" for i in range(300)), "tenth.csv")
        facts = self.fram("fatigue", tenth, "--channel", "x")["series"]
        self.assertEqual((facts["mean"], facts["deviation"], facts["time_scale_s"]), (0.1, 0, 1))
        drift = self.write("time,x\n" + "".join(f"{i},{(i * 7919 % 100) / 50 + (i > 1000)}\n" for i in range(2000)),
                           "drift.csv")
        note = self.fram("extremes", drift, "--channel", "x", "--method", "gumbel", "--block",
                         "20")["methods"][0]["note"]
        self.assertIn("not stationary", note)
        # Where that takes the answer too, it is the reason, and stands before what comes of it.
        for method in ("gumbel", "gev", "acer", "upcrossing"):
            steep = self.write("time,x\n" + "".join(f"{i},{(i * 7919 % 100) / 50 + i / 500}\n" for i in range(2000)),
                               "steep.csv")
            note = self.fram("extremes", steep, "--channel", "x", "--method", method)["methods"][0]["note"]
            self.assertRegex(note, "^The means of the two halves differ .* not stationary .* of this change. No answer")
        # Not where it is what was asked for that stands in the way.
        slow = self.write("time,x\n" + "".join(f"{i},{(i * 7919 % 100) / 50 + i / 5000}\n" for i in range(2000)),
                          "slow.csv")
        words = ("extremes", slow, "--channel", "x", "--method")
        self.assertIn("not stationary", self.fram(*words, "gumbel", "--block", "20")["methods"][0]["note"])
        for asked in (("gumbel", "--block", "900"), ("gev", "--block", "900"),
                      ("pot", "--separation", "900", "--threshold", "2"), ("pot", "--threshold", "99"),
                      ("pot", "--threshold", "2.35"), ("acer", "--threshold", "99")):
            note = self.fram(*words, *asked)["methods"][0]["note"]
            self.assertRegex(note, "^No answer: .* too few")
        maxima = self.write("x\n" + "\n".join(map(str, sample())) + "\n", "m.csv")
        note = self.fram("extremes", maxima, "--channel", "x", "--maxima", "--block", "60", "--duration", "1a",
                         "--method", "gumbel")["methods"][0]["note"]
        self.assertIn("times as long as the data", note)

    def test_a_law_that_ends_at_the_sample_is_told(self):
        # Quantiles of the generalized law of shape -0.7, location 0 and scale 1, which ends at 1/0.7.
        for shape, told in ((0.7, True), (0.3, False)):
            values = [(1 - (-math.log((i + 0.5) / 60)) ** shape) / shape for i in range(60)]
            file = self.write("x\n" + "\n".join(map(str, values)) + "\n", "ends.csv")
            note = self.fram("extremes", file, "--channel", "x", "--maxima", "--block", "60", "--duration", "10min",
                             "--method", "gev")["methods"][0]["note"]
            self.assertEqual("under -0.5 likelihood has no interval" in note, told, note)
            self.assertEqual("The law ends at 1.4" in note, told, note)

    def test_plots_are_drawn_where_there_is_an_answer(self):
        self.maxima()
        words = ("extremes", self.at / "series.csv", "--channel", "load", "--maxima", "--block", "10min", "--draw")
        if "cairo" not in subprocess.run([FRAM, "--version"], capture_output=True, text=True).stdout:
            self.fram(*words, self.at / "plot.png", code=1)
            return
        self.fram(*words, self.at / "plot.png")
        self.assertEqual((self.at / "plot.png").read_bytes()[1:4], b"PNG")
        self.fram(*words, self.at / "plot.svg", "--duration", "20a")
        drawn = (self.at / "plot.svg").read_text()
        self.assertIn("<svg", drawn)
        series = self.write("time,x\n" + "".join(f"{i},{random.Random(i).expovariate(1)}\n" for i in range(2000)))
        heights = []
        for method in ("pot", "gev"):
            (told,) = self.fram("extremes", series, "--channel", "x", "--method", method, "--draw",
                                self.at / "one.svg")["methods"]
            self.assertEqual(len(told["thresholds"]) >= 10, method == "pot")
            heights.append(int(re.search(r'<svg[^>]* height="(\d+)', (self.at / "one.svg").read_text()).group(1)))
            for row in told["thresholds"][3:9:5]:
                # A fit over that threshold is the same one; its shape scatters as Smith (1984) has it.
                (fit,) = self.fram("extremes", series, "--channel", "x", "--method", "pot", "--threshold",
                                   repr(row["threshold"]))["methods"]
                self.assertEqual((row["peaks"], row["shape"]), (fit["sample"], fit["shape"]))
                star = fit["scale"] - fit["shape"] * fit["threshold"]
                half = 1.96 * (1 + fit["shape"]) / row["peaks"] ** 0.5
                self.close((row["scale_star"], row["shape_half"]), (star, half), 1e-3)
        # Without a unit the title of the upright axis is the one letter.
        self.assertEqual((self.at / "one.svg").read_text().count('x="18" y='), 1)
        # Below the probability plot stand shape and scale over the threshold.
        self.assertEqual(heights[0], 3 * heights[1])
        file = self.write("time,x\n" + "".join(f"{i},{i % 3}\n" for i in range(30)))
        self.refused(("extremes", file, "--channel", "x", "--method", "gev", "--draw", self.at / "none.png"),
                     "none.png", "no method has an answer")
        self.assertFalse((self.at / "none.png").exists())
        self.refused(("extremes", file, "--channel", "x", "--draw", file), "--draw")
        # A picture is of the kind that its name tells.
        self.refused(("extremes", file, "--channel", "x", "--draw", self.at / "a.pdf", "--force"), "--draw", ".svg")
        self.assertFalse((self.at / "a.pdf").exists())

    def test_the_last_of_many_columns_is_found(self):
        """As the series of several vessels with their lines and thrusters has them."""
        others, zeros = ",".join(f"c{i}" for i in range(700)), "0," * 700
        wide = self.write(f"time,{others},x\n" + "".join(f"{t},{zeros}{t % 3}\n" for t in range(40)), "wide.csv")
        alone = self.write("time,x\n" + "".join(f"{t},{t % 3}\n" for t in range(40)), "alone.csv")
        self.assertEqual(self.fram("fatigue", wide, "--channel", "x")["equivalent"],
                         self.fram("fatigue", alone, "--channel", "x")["equivalent"])

    def test_a_run_is_not_written_over(self):
        run, scene = self.at / "run", self.write(SCENE, "scene.yaml")
        self.fram("run", scene, "-o", run, "--quiet")
        before = (run / "series.csv").read_bytes()
        for command, option, file in (("fatigue", "-o", "series.csv"), ("fatigue", "-o", "fractures.csv"),
                                      ("extremes", "--draw", "record.fram")):
            self.refused((command, run, option, run / file), "names what the command reads")
        self.assertEqual((run / "series.csv").read_bytes(), before)
        # A run that failed is told.
        note = (run / "run.json").read_text()
        for text, told in ((note, False), (note.replace('"finished"', '"failed"'), True)):
            (run / "run.json").write_text(text)
            done = subprocess.run([FRAM, "fatigue", run], capture_output=True, text=True, check=True)
            self.assertEqual("the run failed at 2 s of 2 s" in done.stderr, told, done.stderr)
        self.write("a,b\n1,2\n", "run/series.csv")
        for words in (("fatigue", run), ("report", run, "-o", self.at / "page.html"), ("compare", run, run)):
            self.refused(words, "series.csv:1:", "without the column time[s]")

    def test_damaged_runs_are_told_with_their_line(self):
        scene, run, thin = self.write(SCENE, "scene.yaml"), self.at / "run", self.at / "thin"
        self.fram("run", scene, "-o", run, "--quiet")
        self.fram("run", scene, "-o", thin, "--quiet", "--set", "output.csv_interval=0.3")
        rows = (run / "series.csv").read_text().splitlines(keepends=True)
        for changed, said in ((rows[:20] + rows[19:], "series.csv:21: time: expected rising times, found 0.95 after"),
                              (rows[:20] + rows[21:19:-1] + rows[22:],
                               "series.csv:22: time: expected rising times, found 1 after 1.05")):
            self.write("".join(changed), "run/series.csv")
            for words in (("plot", run), ("fatigue", run)):
                self.refused(words, said)
        page = self.write("<!--BESIDE--><!--RECORD-->", "page.html")
        done = subprocess.run([FRAM, "view", run, "--page", page], capture_output=True, text=True, check=True)
        self.assertIn(f"no peaks: {run}/series.csv:22: time: expected rising times, found 1 after 1.05", done.stderr)
        self.write(rows[0], "run/series.csv")
        self.refused(("fatigue", run), "series.csv has no rows, though the run made 40 steps: it was cut off; run the")
        for words in (("plot", run), ("compare", run, thin)):
            done = subprocess.run([FRAM, *words], capture_output=True, text=True, check=True)
            self.assertIn("warning: run: series.csv has no rows, though the run made 40 steps: it was cut off; run the",
                          done.stderr.replace(str(self.at) + "/", ""))
        self.fram("report", run, "-o", self.at / "report.html")
        self.assertIn("The run's series.csv has no rows, though", (self.at / "report.html").read_text())
        # Rows that lack are warned of, those that a long interval leaves out are none.
        for changed, folder, said in ((rows[:20] + rows[25:], run, "series.csv:21: time: there are no rows from 0.95 "
                                                                   "to 1.25 s, and one every 0.05 s was written"),
                                      (rows[:9] + rows[10:20] + rows[21:], run, "0.4 to 0.5 s, nor in 1 more gap, and"),
                                      (rows[:20], run, "series.csv:20: time: there are no rows from 0.95 to 2 s, and"),
                                      (rows, run, None), (rows, thin, None)):
            self.write("".join(changed), "run/series.csv")
            done = subprocess.run([FRAM, "plot", folder], capture_output=True, text=True, check=True)
            self.assertEqual("there are no rows" in done.stderr, said is not None, done.stderr)
            self.assertIn(said or "", done.stderr)
            if said and "21:" in said:
                self.refused(("extremes", run), f"{run}/series.csv:21: time: expected times at equal distances")
        # Notes that no run wrote.
        text = (run / "run.json").read_text()
        note = json.loads(text)
        for changed, *said in (({**note, "status": "finnished"}, "run.json:0: status: expected running, finished,"),
                               ({**note, "time_s": -5}, "run.json:0: time_s: expected a number from 0", "found -5"),
                               ({**note, "steps": 1e300}, "run.json:0: steps: expected a number", "found 1e+300"),
                               ({"status": "finished", "steps": 4}, "run.json:0: time_s: is missing"),
                               ({}, "run.json:0: status: ", 'found ""')):
            self.write(json.dumps(changed), "run/run.json")
            self.refused(("plot", run), *said)
        self.write(text + "text\n", "run/run.json")
        self.refused(("plot", run), f"run.json:{text.count(chr(10)) + 1}: ", "expected the end of the file, found 't'")

    def test_lines_that_are_let_go_are_told(self):
        # They have their tension in the row of that time, of which a run that was killed tells no event.
        scene = self.write(MOORED, "moored.yaml")
        for release, told in ((0.1, True), (0, False)):
            run = self.at / f"moored-{release}"
            self.fram("run", scene, "-o", run, "--quiet", "--set", f"vessel.mooring.lines[0].release_time={release}")
            note = json.loads((run / "run.json").read_text())
            self.assertEqual(len(note["events"]), 4)
            for changes in ({}, {"status": "running", "events": []}, {"events": [], "events_left_out": 4}):
                (run / "run.json").write_text(json.dumps({**note, **changes}))
                for begin in (0, 0.1):
                    done = subprocess.run([FRAM, "fatigue", run, "--channel", "line_1_tension", "--from", str(begin)],
                                          capture_output=True, text=True, check=True)
                    self.assertEqual("were let go in 1 of 1 runs" in done.stderr, told and begin == 0,
                                     (release, changes, begin, done.stderr))

    def refused(self, words, *said):
        error = self.fram(*words, code=2)["error"]
        for word in said:
            self.assertIn(word, f"{error['file']}:{error['line']}: {error['key']}: {error['message']}")

    def test_mistakes_are_told_at_their_place(self):
        file = self.write("time[s],tension[N]\n0,1\n1,2\n2,x\n")
        self.refused(("extremes", file, "--channel", "tension"), "series.csv:4:", "expected a number", "x")
        self.refused(("extremes", file, "--channel", "tensoin"), "tensoin", "did you mean tension?")
        first = self.write("# T of a tank\ntime[s],T[N]\n0,1\n1,2\n", "first.csv")
        self.refused(("extremes", first, "--channel", "T"), "first.csv:1: T:", "comments stand behind the header")
        self.refused(("extremes", file, "--channel", "zzz"), "the file has no column of this name")
        first = self.write("# by a tank, T[kN]\ntime[s],T[N]\n0,1\n1,2\n", "first.csv")
        self.refused(("extremes", first, "--channel", "T"), "first.csv:1: T:", "comments stand behind the header")
        self.refused(("extremes", file), "channel")
        self.refused(("extremes", str(file) + "-not-there"), "series.csv-not-there")
        self.refused(("extremes", file, "--channel", "tension", "--method", "gumble"), "method", "gumble")
        self.refused(("extremes", file, "--channel", "tension", "--duration", "3 hours"), "--duration")
        self.refused(("extremes", file, "--channel", "tension", "--duration", "-3h"), "duration")
        self.refused(("extremes", file, "--channel", "tension", "--level", "1"),
                     "--level", "below 1", "found 1")
        self.refused(("extremes", file, "--channel", "time"), "channel", "name one of those")
        self.refused(("extremes", file, "--channel", "tension", "--level", "0.5;0.9"), "--level")
        self.refused(("extremes", file, "--channel", "tension", "--maxima"), "--block")
        # What a method that is named, or maxima, have no use for was passed over; a method that is none goes before.
        maxima = ("--maxima", "--block", 3)
        for words, of, option in ((("--method", "weibull"), "weibull", ("--threshold", 3)),
                                  (("--method", "gumbel"), "gumbel", ("--order", 3)),
                                  (("--method", "gev", "--block", 3), "gev", ("--separation", 3)),
                                  (("--method", "acer"), "acer", ("--fit", "moments")),
                                  (("--method", "acer", "--order", 3), "acer with --order", ("--separation", 3)),
                                  (("--method", "pot", "--fit", "moments"), "pot", ("--block", 3)),
                                  (maxima, "maxima", ("--threshold", 3)), (maxima, "maxima", ("--order", 3)),
                                  ((*maxima, "--fit", "moments"), "maxima", ("--separation", 3))):
            self.refused(("extremes", file, "--channel", "tension", *words, *option),
                         f":0: {option[0]}: has no effect on {of}; leave it out")
        for words in (("--order", 3, "--block", 3, "--method", "all"), ("--order", 3, "--separation", 3, "--block", 3),
                      ("--method", "pot", "--threshold", 3, "--separation", 3, "--fit", "moments"),
                      ("--method", "acer", "--threshold", 3, "--separation", 3), ("--method", "acer", "--order", 3),
                      ("--method", "gev", "--block", 3, "--fit", "moments")):
            self.refused(("extremes", file, "--channel", "tension", *words), "series.csv:4:")
        self.refused(("extremes", file, "--method", "gumble", "--order", 3), "method", "gumble")
        self.refused(("fatigue", file, "--channel", "tension", "--slope", "0"), "slope")
        uneven = self.write("time,x\n0,1\n1,2\n5,3\n6,1\n", "uneven.csv")
        self.refused(("fatigue", uneven, "--channel", "x"), "uneven.csv:4:", "equal distances", "found one of 4 s")
        blanks = self.write("time,x\n\n0,1\n# a comment\n1,2\n5,3\n6,1\n", "blanks.csv")
        self.refused(("fatigue", blanks, "--channel", "x"), "blanks.csv:6:", "found one of 4 s")
        quoted = self.write('time , "x, of ""A"""\n0, "1"\n1,\t"2.5" \n2,3\n', "quoted.csv")
        self.assertEqual(self.fram("fatigue", quoted, "--channel", 'x, of "A"')["series"]["values"], 3)
        self.refused(("fatigue", self.write('time,"x\n0,1\n', "open.csv"), "--channel", "x"),
                     "open.csv:1:", "column 2: the quotation mark")
        commas = self.write("time,x\n0,1\n1,2,\n2,0,5\n", "commas.csv")
        self.refused(("fatigue", commas, "--channel", "x"), "commas.csv:4:", "more cells than the header", "a decimal")
        rows = "".join(f"{0.5 * i + (400 if i > 700 else 0)},{i % 7}\n" for i in range(1000))
        gap = self.write("time,x\n" + rows, "gap.csv")
        self.refused(("extremes", gap, "--channel", "x"), "gap.csv:703:", "0.5 s as most are", "found one of 400.5 s")
        # However far a single row goes back, it is that one; else the first that does not rise.
        back = self.write("time,x\n" + "".join(f"{i},{i % 7}\n" for i in range(1000)) + "-5,3\n", "back.csv")
        self.refused(("extremes", back, "--channel", "x"), "back.csv:1002:", "found one of -1004 s, to -5")
        falls = self.write("time,x\n# down\n3,1\n2,2\n1,1\n0,2\n", "falls.csv")
        self.refused(("fatigue", falls, "--channel", "x"), "falls.csv:4:", "rising times", "found 2 after 3")
        self.refused(("extremes", self.write("x\n1\n2\n", "timeless.csv"), "--channel", "x"),
                     "timeless.csv:0: --step: is missing", "no column `time`")
        self.refused(("extremes", self.write("time[s],x\n1,1\n2,2\n", "timed.csv"), "--channel", "x", "--step", "2"),
                     "timed.csv:0: --step:", "column `time`")
        self.refused(("fatigue", self.write("time[s],x\n1,1\n", "one.csv"), "--channel", "x"), "one value alone")
        self.refused(("extremes", self.write("time,x\n0,1\n1\n", "short.csv"), "--channel", "x"), "short.csv:3:")
        self.refused(("extremes", self.write("", "empty.csv"), "--channel", "x"), "empty.csv:1:")
        twice = self.write("time,x,y,x\n0,1,2,3\n1,2,3,4\n", "twice.csv")
        self.refused(("extremes", twice, "--channel", "x"), "twice.csv:1: x:", "found columns 2 and 4")
        times = self.write("time,x,time\n0,1,0\n1,2,1\n", "times.csv")
        self.refused(("fatigue", times, "--channel", "x"), "times.csv:1: time:", "found columns 1 and 3")
        self.refused(("extremes", self.at / "none.csv", "--channel", "x"), "none.csv")
        self.refused(("extremes", self.at, "--channel", "x"), str(self.at))

    def test_times_are_those_of_studies(self):
        """By the list that tests/study/test_condition_table.c reads."""
        file = self.write("x\n1\n2\n1\n3\n")
        with open("tests/data/times.csv", newline="") as times:
            for row in csv.DictReader(times):
                words = ("extremes", file, "--channel", "x", "--step", 1, "--duration", row["text"])
                if row["seconds"]:
                    self.assertEqual(self.fram(*words)["duration_s"], float(row["seconds"]))
                else:
                    self.refused(words, "--duration", "expected a time")
        # A study's file ends a value before its blanks, words have none.
        for text in (" 3h", "\t3h"):
            self.refused((*words[:-1], text), "--duration", "expected a time")

    def test_the_runs_of_a_large_study_are_taken_at_once(self):
        files = [self.write("x\n1\n2\n", f"two{i}.csv") for i in range(300)]
        self.assertEqual(self.fram("extremes", *files, "--channel", "x", "--step", 1)["series"]["values"], 600)
        few = self.fram("extremes", *files[:1], "--channel", "x", "--step", 1)["methods"][0]["note"]
        self.assertIn("fewer than ten values", few)

    def test_series_that_hold_no_block_are_told(self):
        text = "x\n" + "".join(f"{math.sin(0.01 * i)}\n" for i in range(600))
        files = [self.write(text, f"wave{i}.csv") for i in range(4)]
        (told,) = self.fram("extremes", *files, "--channel", "x", "--step", 1, "--method", "gev")["methods"]
        self.assertIn(f"no series is as long as a block, {told['block_s']:.4g} s: run longer", told["note"])

    def test_levels_under_the_threshold_are_not_told(self):
        numbers = random.Random(7)
        file = self.write("x\n" + "".join(f"{numbers.gauss(0, 1)}\n" for _ in range(4000)))
        words = ("extremes", file, "--channel", "x", "--step", 1, "--method", "pot", "--threshold", 2)
        every = 4000 / self.fram(*words)["methods"][0]["sample"]
        words += ("--duration", 2 * every, "--level", "0.01,0.9")
        (pot,) = self.fram(*words)["methods"]
        self.assertEqual([pot["levels"][0][k] for k in ("level", "low", "high")], [None] * 3)
        self.assertTrue(2 < pot["most_probable"]["level"] < pot["levels"][1]["level"])
        self.assertIn("Levels that are not over 2 are not told", pot["note"])
        said = subprocess.run([FRAM, *map(str, words)], capture_output=True, text=True, check=True).stdout
        self.assertRegex(said, r"0\.01 quantile +not told\n")

    def test_a_law_of_rates_from_below_zero_is_written_with_a_plus(self):
        numbers = random.Random(7)
        file = self.write("x\n" + "".join(f"{numbers.gauss(-50, 1)}\n" for _ in range(4000)))
        said = subprocess.run([FRAM, "extremes", file, "--channel", "x", "--step", "1", "--method", "acer"],
                              capture_output=True, text=True, check=True).stdout
        self.assertRegex(said, r"\(x \+ [0-9.]+\)\^")


if __name__ == "__main__":
    unittest.main()
