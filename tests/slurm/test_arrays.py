#!/usr/bin/env python3
"""Studies by a real Slurm: the same bytes as here, though a node is killed and a run fails; no cluster, no words."""
import fcntl
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import cluster  # noqa: E402

FRAM = os.environ["FRAM"]
BASE = """
run: {duration: 2, time_step: 0.02, transient: 0.5}
vessel: {mode: towed, x: -30, speed: 2, ramp: 0.5, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {concentration: 0.8, mean_floe_area: 64}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
"""
# A hull lighter than the water it displaces rises faster than the lower limit allows: those runs fail.
STUDY = """
scenario: base.yaml
seeds: {seeds}
keep: {{record_of_worst: 2}}
vary: {{list: [{{run.speed_limit: 100, vessel.mass: 1.8e6}}, {{run.speed_limit: 2.1, vessel.mass: 1.0e6}},
       {{run.speed_limit: 90, vessel.mass: 1.8e6}}]}}
"""


class Arrays(unittest.TestCase):
    def setUp(self):
        self.at = pathlib.Path(tempfile.mkdtemp(prefix="fram-arrays-"))
        self.addCleanup(shutil.rmtree, self.at)
        (self.at / "base.yaml").write_text(BASE)
        self.study = self.at / "study.yaml"
        self.study.write_text(STUDY.format(seeds=int(os.environ.get("FRAM_SLURM_SEEDS", "8"))))

    def words(self, folder, *more):
        return [FRAM, "study", str(self.study), "-o", str(self.at / folder), *map(str, more)]

    def fram(self, *words, code=0, environment=None):
        done = subprocess.run(self.words(*words, "--json"), capture_output=True, text=True, env=environment)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout

    def tables(self, folder):
        return [(self.at / folder / name).read_bytes() for name in ("summary.csv", "conditions.csv")]

    def test_the_script_is_printed_and_nothing_submitted(self):
        environment = dict(os.environ, PATH="/nowhere")
        text = self.fram("it's", "--on", "slurm", "--dry-run", "--partition", "short", "--time", "1:00:00",
                         "--runs-per-task", "5", "--sbatch", "--account=ice", "--sbatch", "--comment=two words #1",
                         "--sbatch", "--exclude='n1, n2'", environment=environment)
        script = text[:text.rindex("{")]
        for line in ("#SBATCH --partition=short", "#SBATCH --time=1:00:00", "#SBATCH --account=ice", "each=5",
                     '#SBATCH --comment="two words #1"\n', "#SBATCH --exclude='n1, n2'\n"):
            self.assertIn(line, script)
        runs = 3 * int(os.environ.get("FRAM_SLURM_SEEDS", "8"))
        self.assertIn(f"#SBATCH --array=0-{(runs + 4) // 5 - 1}\n", script)
        checked = subprocess.run(["bash", "-n"], input=script, text=True, capture_output=True)
        self.assertEqual(checked.stderr, "")
        self.assertFalse((self.at / "it's" / "slurm").exists())

    def test_mistakes_are_told(self):
        error = json.loads(self.fram("out", "--on", "cloud", code=2))["error"]
        self.assertIn("local or slurm", error["message"])
        self.assertEqual(json.loads(self.fram("out", "--partition", "all", code=2))["error"]["key"], "--on")
        error = json.loads(self.fram("out", "--on", "slurm", "--sbatch", "account", code=2))["error"]
        self.assertIn("--account=ice", error["message"])
        none = dict(os.environ, PATH="/nowhere")
        error = json.loads(self.fram("out", "--on", "slurm", code=2, environment=none))["error"]
        self.assertIn("sbatch", error["message"])

    def test_the_same_bytes_though_a_node_is_lost(self):
        why = cluster.missing()
        if why:
            self.skipTest(why)
        self.fram("here")
        slurm = cluster.Cluster(4)
        self.addCleanup(slurm.stop)
        words = self.words("there", "--on", "slurm", "--runs-per-task", "2", "--poll", "2", "--json")
        process = subprocess.Popen(words, env=slurm.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + 120
        while not list(self.at.glob("there/runs/*/*.row")) and time.monotonic() < end and process.poll() is None:
            time.sleep(0.1)
        slurm.kill_node("n2")
        out, error = process.communicate(timeout=500)
        self.assertEqual(process.returncode, 0, error)
        result = json.loads(out.splitlines()[-1])
        self.assertEqual(result["failed"] * 3, result["runs"])
        self.assertEqual(self.tables("there"), self.tables("here"))
        # Its worst runs have their record, made by tasks of their own.
        records = [sorted(str(p.relative_to(self.at / d)) for p in self.at.glob(f"{d}/worst/*/record.fram"))
                   for d in ("there", "here")]
        self.assertEqual(len(records[0]), 2)
        self.assertEqual(*records)
        for path in records[0]:
            self.assertEqual((self.at / "there" / path).read_bytes(), (self.at / "here" / path).read_bytes())
        self.assertEqual(list(self.at.glob("there/worst/*.exit*")), [])
        pages = [(self.at / d / "study.html").read_bytes() for d in ("there", "here")]
        self.assertEqual(*pages)
        self.assertEqual(list(self.at.glob("there/runs/*/*.exit*")), [])
        # What is there is not run again, and nothing is submitted.
        again = self.fram("there", "--on", "slurm", environment=slurm.environment)
        self.assertEqual(json.loads(again)["made"], 0)

    def test_a_run_that_a_killed_study_left_is_waited_for(self):
        why = cluster.missing()
        if why:
            self.skipTest(why)
        self.study.write_text("scenario: base.yaml\nseeds: 2\n")
        self.fram("here")
        made = next((self.at / "here").glob("runs/*/1.row"))
        held = self.at / "there" / made.relative_to(self.at / "here").with_suffix("")
        self.fram("there", "--on", "slurm", "--dry-run")
        held.mkdir(parents=True)
        slurm = cluster.Cluster(1)
        self.addCleanup(slurm.stop)
        process = subprocess.Popen(self.words("there", "--on", "slurm", "--poll", "2", "--json"),
                                   env=slurm.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        # As the program of a run that was left does, for longer than a task tries.
        lock = os.open(held, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        time.sleep(14)
        os.close(lock)
        out, error = process.communicate(timeout=200)
        self.assertEqual(process.returncode, 0, error)
        result = json.loads(out.splitlines()[-1])
        self.assertEqual((result["failed"], result["made"]), (0, 2))
        self.assertEqual(self.tables("there"), self.tables("here"))


if __name__ == "__main__":
    program = unittest.main(exit=False)
    if program.result.skipped and program.result.wasSuccessful():
        print("skipped in part:", *[why for _, why in program.result.skipped])
    sys.exit(0 if program.result.wasSuccessful() else 1)
