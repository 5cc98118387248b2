#!/usr/bin/env python3
"""Studies of tables as large as they may be: what is checked runs, and what is written down is read again."""
import unittest

from studies import StudyTest


class LargeTables(StudyTest):
    def test_a_table_and_a_record_of_many_conditions_are_read_whole(self):
        # What a table may have, the study that is made of it writes down and reads again; nothing to simulate here.
        filler = "# a line that says nothing, as long as those of many keys are in a large table\n" * (1 << 18)
        (self.at / "c.csv").write_text("vessel.speed\n1.5\n2\n" + filler)
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nvary: {table: c.csv}\n")
        self.assertEqual(self.fram("check", study)["conditions"], 2)
        self.assertEqual(self.fram(study, "-o", self.at / "out")["runs"], 2)
        with open(self.at / "out" / "effective.yaml", "a") as file:
            file.write(filler)
        self.fram("list", self.at / "out")


if __name__ == "__main__":
    unittest.main()
