#!/usr/bin/env python3
"""Levels of a year, and what the tables say where runs carry none."""
import math
import re
import unittest

from studies import SHORT, StudyTest

WHOLE = unittest.skipIf(SHORT, "tests are short")


class Years(StudyTest):
    @WHOLE
    def test_a_year_of_which_no_run_saw_any_load_has_no_level(self):
        study = self.write("seeds: 12\nset: {run.duration: 0.2, run.transient: 0.1, ice.source: none}\n"
                           "extremes: {duration: 1min, hours: [100], annual: [1e-2]}\n")
        self.fram(study, "-o", self.at / "out")
        self.assertEqual([r["load_largest[N]"] for r in self.rows("out")], ["0"] * 12)
        year, = self.rows("out", "annual.csv")
        self.assertEqual((year["level"], year["low"], year["high"]), ("", "", ""))
        self.assertIn("No answer: all runs saw none", year["note"])

    @WHOLE
    def test_a_year_knows_no_more_than_the_fits_of_its_conditions(self):
        study = self.write("seeds: 12\nset: {run.duration: 0.2, run.transient: 0.1, ice.source: none}\n"
                           "extremes: {duration: 1min, hours: [100], annual: [1e-2]}\n")
        self.fram(study, "-o", self.at / "out")

        def told(values, mean=None):
            for seed, value in enumerate(values, 1):
                (row,) = (self.at / "out" / "runs").glob(f"*/{seed}.row")
                text = re.sub("load_largest .*", f"load_largest {value}", row.read_text())
                row.write_text(re.sub("load_mean .*", f"load_mean {mean(seed)}", text) if mean else text)
            self.assertEqual(self.fram(study, "-o", self.at / "out")["made"], 0)
            load = next(r for r in self.rows("out", "extremes.csv") if r["figure"] == "load_largest")
            (year,) = self.rows("out", "annual.csv")
            return load, year

        # No load in most runs, and one in one: no law of maxima has that.
        load, year = told([0] * 11 + [5000])
        self.assertEqual((load["most_probable"], year["level"]), ("", ""))
        self.assertIn("11 of 12 maxima are equal, 0, the least", load["note"])
        self.assertIn("condition 1 occurs and has no fit: 11 of 12 largest values are equal", year["note"])
        # Equal in one figure alone, runs are not the same.
        load, year = told([5000] * 12, lambda seed: 1000 + seed)
        self.assertTrue(load["note"].endswith("all 12 values are equal."), load["note"])
        self.assertTrue(year["note"].endswith("has no fit: all its 12 values are equal."), year["note"])
        load, year = told([5000] * 12, lambda seed: 1000)
        self.assertRegex(load["note"] + year["note"], "12 values are equal. The seed .*vary.*12 runs .* same; the")
        load, year = told([2 ** k for k in range(12)])
        self.assertIn("speak against Gumbel's law", load["note"])
        self.assertGreater(float(year["level"]), float(load["most_probable"]))
        self.assertRegex(year["note"], "^100 %.* condition 1, .* 9950 h. The duration.* wide.*small.* low.*1 of 1 ")
        load, year = told([-math.log(-math.log((k + 0.5) / 12)) for k in range(12)])
        self.assertNotIn("speak against", load["note"])
        self.assertNotIn("speak against", year["note"])


if __name__ == "__main__":
    unittest.main()
