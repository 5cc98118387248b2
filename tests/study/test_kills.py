#!/usr/bin/env python3
"""Studies killed at twenty random moments: what ended stays, and the answer is the same to the byte."""
import os
import random
import signal
import subprocess
import time
import unittest

from studies import FRAM, SHORT, StudyTest

RUNS = 4
STUDY = """set: {run.duration: 0.5, run.transient: 0}
seeds: 2
keep: series
vary: {grid: {vessel.speed: [1.5, 2]}}
"""
TABLES = ("summary.csv", "conditions.csv", "study.html", "effective.yaml")


class Kills(StudyTest):
    def kill_at(self, folder, words, moment, power):
        """Kills the study, or all that it has started too; whether it was still going on."""
        process = subprocess.Popen([FRAM, *words], start_new_session=True)
        time.sleep(moment)
        going = process.poll() is None
        if power:
            os.killpg(process.pid, signal.SIGKILL) if going else None
        else:
            process.kill()
        process.wait()
        return going

    def cut(self, folder):
        """What a power cut may take: files that nobody waited for to reach the disk, and whatever is about to be."""
        for path in [*folder.glob("conditions/*.yaml"), *folder.glob("runs/*/*.log"), *folder.glob("runs/*/*/*"),
                     *folder.rglob("*.new")]:
            if path.is_file():
                path.write_bytes(path.read_bytes()[:7])

    def test_kills_lose_at_most_the_runs_in_progress(self):
        study = self.write(STUDY)
        began = time.monotonic()
        self.fram(study, "-o", self.at / "whole", "--jobs", "2")
        takes = time.monotonic() - began
        moments, interrupted = random.Random(20), 0
        for i in range(4 if SHORT else 20):
            folder, power = self.at / f"killed{i}", i % 2 == 1
            words = ("study", study, "-o", folder, "--jobs", "2", "--quiet")
            interrupted += self.kill_at(folder, words, moments.uniform(0, takes), power)
            ended = {p: p.read_bytes() for p in folder.glob("runs/*/*.row")}
            if power:
                self.cut(folder)
            self.assertEqual(self.fram(*words[1:])["made"], RUNS - len(ended))
            for path, text in ended.items():
                self.assertEqual(path.read_bytes(), text)
            for table in TABLES:
                self.assertEqual((folder / table).read_bytes(), (self.at / "whole" / table).read_bytes(), table)
        self.assertGreater(interrupted, 0)


if __name__ == "__main__":
    unittest.main()
