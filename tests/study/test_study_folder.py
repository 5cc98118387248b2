#!/usr/bin/env python3
"""Folders of studies: of another scenario they are told, of something else they are left alone; who starts a study may
ignore how programs end; and what is told meanwhile is of the study."""
import fcntl
import os
import shutil
import signal
import subprocess
import unittest

from studies import FRAM, StudyTest


class Folders(StudyTest):
    def test_a_folder_of_a_study_of_another_scenario_is_told(self):
        short = "set: {run.duration: 0.1, run.transient: 0}\nseeds: 1\n"
        self.fram(self.write(short), "-o", self.at / "out")
        (self.at / "other.yaml").write_text((self.at / "base.yaml").read_text())
        study = self.write(short)
        for name, tells in (("base.yaml", False), ("other.yaml", True), ("other.yaml", False)):
            study.write_text(f"scenario: {name}\n{short}# {name}\n")
            done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], check=True, capture_output=True,
                                  text=True)
            self.assertEqual("was of a study of " in done.stderr, tells, done.stderr)
            self.assertEqual("base.yaml" in done.stderr, tells)
        # The study as it was read is of the same scenario, one of the same name elsewhere is of another.
        record, away = self.at / "out" / "effective.yaml", self.at / "away"
        away.mkdir()
        (away / "other.yaml").write_text((self.at / "base.yaml").read_text())
        (away / "study.yaml").write_text(study.read_text())
        for path, tells in ((record, False), (study, False), (away / "study.yaml", True)):
            done = subprocess.run([FRAM, "study", path, "-o", self.at / "out"], check=True, capture_output=True,
                                  text=True)
            self.assertEqual(f"was of a study of {self.at}/other.yaml" in done.stderr, tells, done.stderr)
            self.assertEqual("warning" in done.stderr, tells, done.stderr)
        # One of something else is left alone, --force or not.
        (self.at / "mine").mkdir()
        (self.at / "mine" / "letter").write_text("")
        error = self.fram(study, "-o", self.at / "mine", "--force", code=2)["error"]
        self.assertEqual(error["message"], "the folder holds something else than a study; name another one")
        self.assertEqual([p.name for p in (self.at / "mine").iterdir()], ["letter"])

    def test_a_study_that_begins_in_the_same_folder_takes_nothing_away(self):
        """The first file of a study is there under another name for a moment, which is no leftover then."""
        path, folder = self.write("seeds: 1\nset: {run.duration: 1.5}\n"), self.at / "out"
        folder.mkdir()
        first = folder / "study.yaml.0123456789abcdef.new"
        first.write_text("half of it")
        lock = os.open(folder, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        self.assertIn("another study is writing", self.fram(path, "-o", folder, code=2)["error"]["message"])
        self.assertEqual(first.read_text(), "half of it")
        os.close(lock)
        self.assertEqual(self.fram(path, "-o", folder)["runs"], 1)
        self.assertFalse(first.exists())
        # Beside something else it is no folder of a study.
        shutil.rmtree(folder)
        folder.mkdir()
        first.write_text("half of it")
        (folder / "mine").write_text("mine")
        self.fram(path, "-o", folder, code=2)
        self.assertTrue(first.exists())

    def test_runs_end_well_where_the_starter_ignored_sigchld(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nseeds: 1\n")
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], capture_output=True, text=True,
                              preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_files_that_are_read_at_once_are_not_told(self):
        """A second after the first run had ended its file was told as being read, 0 %, by that of each later one."""
        study = self.write("seeds: 4\nset: {run.duration: 10}\n")
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--jobs", "1"], check=True,
                              capture_output=True, text=True)
        self.assertNotIn("reading", done.stderr)


if __name__ == "__main__":
    unittest.main()
