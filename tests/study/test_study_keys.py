"""What a study says of its keys: whole numbers between the ends of a range, files that are not there, parts of a mean,
names of vessels."""
import collections
import subprocess
import unittest

from studies import FRAM, StudyTest

WAYS = ("latin: {count: 4, keys: {", "sobol: {count: 10, keys: {", "morris: {count: 2, keys: {")
TWO = """
run: {duration: 0.1, time_step: 0.02, transient: 0}
vessels:
  - {name: a, mode: towed, x: -30, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
  - {name: b, mode: towed, x: 30, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
domain: {x_min: -90, x_max: 90, y_min: -40, y_max: 40}
"""


class KeysTest(StudyTest):
    def test_whole_keys_have_an_equal_share_for_each_number(self):
        for way, count, runs in (("latin", 8, 8), ("sobol", 10, 30), ("morris", 8, 16)):
            study = self.write("set: {run.duration: 0.1, run.transient: 0}\n"
                               f"vary: {{{way}: {{count: {count}, keys: {{run.solver.iterations: [19.5, 23]}}}}}}\n")
            self.fram(study, "-o", self.at / way)
            values = collections.Counter(row["run.solver.iterations"] for row in self.rows(way))
            self.assertEqual(sorted(values), ["20", "21", "22", "23"])
            self.assertEqual(sum(values.values()), runs)
            if way == "latin":
                self.assertEqual(set(values.values()), {2})

    def test_keys_without_a_range_are_told(self):
        for way in WAYS:
            for key, told in (("ice.breakable", "is true or false"), ("vessel.mode", "is a word"),
                              ("title", "is a text"), ("vessel.hull.file", "is a file"),
                              ("vessel.hull", "is a section"), ("vessels", "is a list")):
                listed = key not in ("vessel.hull", "vessels")
                if listed and way == WAYS[0]:  # takes lists of values
                    continue
                self.refused(f"vary:\n  {way}{key}: [1, 2]}}}}\n",
                             f"study.yaml:3: {key}: {told} and has no range: grid, list{', table and latin' * listed}")
            self.refused(f"vary:\n  {way}run.solver.iterations: [20.2, 20.8]}}}}\n",
                         "study.yaml:3: run.solver.iterations: expected a range that holds a whole number")
            self.refused(f"vary:\n  {way}ice.thicknes: [20.2, 20.8]}}}}\n", "study.yaml:3: ice.thicknes: ",
                         "did you mean thickness?")

    def test_unknown_keys_are_told_from_the_top(self):
        self.refused("vary: {ice.thickness: [0.4, 1]}\n", "study.yaml:2: vary.ice.thickness",
                     "write vary: {grid: {ice.thickness: [...]}}")
        self.refused("vary: {latin: {cuont: 5}}\n", "study.yaml:2: vary.latin.cuont", "did you mean count?")

    def test_files_that_are_not_there_are_told_where_they_are_named(self):
        self.refused("vary:\n  table: none.csv\n", "study.yaml:3: table: ", "none.csv: cannot")
        path = self.at / "study.yaml"
        path.write_text("seeds: 2\nscenario: none.yaml\n")
        error = self.fram("check", path, code=2)["error"]
        self.assertEqual((error["file"], error["line"], error["key"]), (str(path), 2, "scenario"))
        self.assertIn("none.yaml: cannot", error["message"])

    def test_parts_of_a_mean_are_no_per_cent(self):
        for given in ("5 %", "5%", "5"):
            for key in ("mean_within", "largest_within"):
                self.refused(f"seeds: {{least: 4, most: 9, {key}: {given}}}\n",
                             f"study.yaml:2: {key}: expected a part of the mean, 1 at most, found {given}: "
                             "5 per cent are 0.05")
        for given in ("much", "0", "-1"):
            self.refused(f"seeds: {{least: 4, most: 9, mean_within: {given}}}\n", "from 1e-06 to 1,", f"found {given}")

    def test_extremes_that_will_have_no_answer_are_told_beforehand(self):
        for seeds, extremes, told in (("9", "extremes: {duration: 1h}\n", True), ("9", "", False),
                                      ("{least: 2, most: 9, mean_within: 0.1}", "extremes: {duration: 1h}\n", True),
                                      ("{least: 2, most: 10, mean_within: 0.1}", "extremes: {duration: 1h}\n", False)):
            study = self.write(f"set: {{run.duration: 0.1, run.transient: 0}}\nseeds: {seeds}\n{extremes}")
            done = subprocess.run([FRAM, "study", "check", study], capture_output=True, text=True, check=True)
            self.assertEqual("study.yaml:4: extremes: no condition will have an answer: a law takes 10 runs, and of 9 "
                             "seeds come no more" in done.stderr, told, done.stderr)

    def test_a_vessel_that_is_told_is_there_under_all_conditions(self):
        (self.at / "base.yaml").write_text(TWO)
        # Advice is given where it helps: a name of both conditions.
        self.refused("vary:\n  list: [{vessels.0.present: true}, {vessels.0.present: false}]\n",
                     "study.yaml:0: vessel: ", 'is "b", and "a" in condition 1: name the one', "as vessel: b")
        self.refused("vary:\n  grid: {vessels.0.name: [x, y]}\n",
                     "study.yaml:0: vessel: ", 'is "y", and "x" in condition 1: ', "the conditions name it otherwise")


if __name__ == "__main__":
    unittest.main()
