#!/usr/bin/env python3
"""Values that a study draws from ranges have the digits that the ranges ask for: nine are read well, and of a narrow
range about a large number they would be one value."""
import unittest

from studies import StudyTest


class Values(StudyTest):
    def test_digits_of_a_range(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary:\n  latin: {count: 8, seed: 3, keys: "
                           "{vessel.x: [-20.000001, -20], ice.thickness: [0.4, 1.2]}}\n")
        self.fram(study, "-o", self.at / "out")
        rows = self.rows("out")
        places = [(float(r["vessel.x"]) + 20.000001) / 1e-6 * 8 for r in rows]
        self.assertEqual(sorted(int(p) for p in places), list(range(8)))
        self.assertTrue(all(len(r["ice.thickness"].replace(".", "").lstrip("0")) <= 9 for r in rows))

    def test_a_range_of_one_value(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary:\n  latin: {count: 2, keys: "
                           "{vessel.x: [-20.0000000123, -20.0000000123], ice.thickness: [0.4, 1.2]}}\n")
        self.fram(study, "-o", self.at / "out")
        self.assertEqual({float(r["vessel.x"]) for r in self.rows("out")}, {-20.0000000123})

    def test_levels_of_morris(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary:\n  morris: {count: 2, levels: 4, keys: "
                           "{vessel.x: [-20.000001, -20], ice.thickness: [0.4, 1.2]}}\n")
        self.fram(study, "-o", self.at / "out")
        for row in self.rows("out"):
            level = (float(row["vessel.x"]) + 20.000001) / 1e-6 * 3
            self.assertLess(abs(level - round(level)), 1e-4)


if __name__ == "__main__":
    unittest.main()
