#!/usr/bin/env python3
"""Values that a study draws from ranges have the digits that the ranges ask for: nine are read well, and of a narrow
range about a large number they would be one value."""
import collections
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

    def test_values_of_a_list_are_met_equally_often(self):
        lists = {"vessel.mode": ["towed", "free"], "ice.breakable": ["true", "false"], "title": ["a", "b c", "d"],
                 "run.solver.iterations": ["20", "30", "50"], "ice.crushing_strength": ["1e6", "2e6"]}
        keys = ", ".join(f"{key}: [{', '.join(values)}]" for key, values in lists.items() if key[:7] != "ice.cru")
        study = "set: {run.duration: 0.1, run.transient: 0}\nvary:\n  latin: {count: 8, seed: %d, keys: {%s}}\n"
        both = "vessel.x: [-20.5, -20], ice.crushing_strength: {values: [1e6, 2e6]}, ice.thickness: [0.4, 1.2], " + keys
        self.fram(self.write(study % (3, both)), "-o", self.at / "out")
        rows = self.rows("out")
        for key, values in lists.items():
            counts = collections.Counter(row[key] for row in rows)
            self.assertEqual(sorted(counts), sorted(values))
            self.assertLessEqual(max(counts.values()) - min(counts.values()), 1, counts)
        self.assertEqual(len({(row["vessel.mode"], row["ice.breakable"]) for row in rows}), 4)
        # Ranges beside lists are drawn as they are beside ranges, in the same strata.
        ranges = "vessel.x: [-20.5, -20], ice.crushing_strength: [1e6, 2e6], ice.thickness: [0.4, 1.2]"
        self.fram(self.write(study % (3, ranges)), "-o", self.at / "ranges")
        for key in ("vessel.x", "ice.thickness"):
            self.assertEqual([row[key] for row in rows], [row[key] for row in self.rows("ranges")])
        self.assertEqual([row["ice.crushing_strength"] for row in rows],
                         [f"{1 + (float(row['ice.crushing_strength']) > 1.5e6)}e6" for row in self.rows("ranges")])
        self.fram(self.write(study % (4, both)), "-o", self.at / "other")
        self.assertNotEqual([row["title"] for row in rows], [row["title"] for row in self.rows("other")])

    def test_two_of_which_one_is_a_word_are_no_range(self):
        study = "set: {run.duration: 0.1, run.transient: 0}\nvary:\n  latin: {count: 4, keys: {vessel.hull.freeboard: "
        self.fram(self.write(study + "[auto, 2.5]}}\n"), "-o", self.at / "words")
        counts = collections.Counter(row["vessel.hull.freeboard"] for row in self.rows("words"))
        self.assertEqual(counts, {"auto": 2, "2.5": 2})

    def test_lists_that_are_none_are_refused(self):
        latin = "vary:\n  latin: {count: 4, keys: {%s}}\n"
        self.refused(latin % "vessel.mode: towed", "study.yaml:3: vessel.mode: expected a list of values")
        self.refused(latin % "vessel.mode: []", "study.yaml:3: vessel.mode: expected a list of values")
        self.refused(latin % "vessel.mode: [towed, flying]", "vessel.mode", "flying")
        self.refused(latin % "vessel.speed: {values: 2}", "study.yaml:3: values: expected a list of values")
        self.refused(latin % "vessel.speed: {values: [[1], 2]}", "study.yaml:3", "expected one value of the key")
        self.refused(latin % "vessel.speed: 2", "study.yaml:3: vessel.speed: expected the ends of a range")

    def test_levels_of_morris(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary:\n  morris: {count: 2, levels: 4, keys: "
                           "{vessel.x: [-20.000001, -20], ice.thickness: [0.4, 1.2]}}\n")
        self.fram(study, "-o", self.at / "out")
        for row in self.rows("out"):
            level = (float(row["vessel.x"]) + 20.000001) / 1e-6 * 3
            self.assertLess(abs(level - round(level)), 1e-4)


if __name__ == "__main__":
    unittest.main()
