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

# A scheduler that makes the tasks of an array one after the other, at once.
SBATCH = """#!/bin/bash
[ "$1" != --version ] || exit 0
script=${!#}
last=$(sed -n 's/^#SBATCH --array=0-//p' "$script")
for task in $(seq 0 "$last"); do
    SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=$task bash "$script"
done >/dev/null 2>&1 &
echo 7
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
        done = subprocess.run(self.words(*words, "--json"), capture_output=True, text=True, env=environment,
                              timeout=300)
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
        limited = self.fram("it's", "--on", "slurm", "--dry-run", "--runs-per-task", "5", "-j", "2")
        self.assertIn(f"#SBATCH --array=0-{(runs + 4) // 5 - 1}%2\n", limited)
        checked = subprocess.run(["bash", "-n"], input=script, text=True, capture_output=True)
        self.assertEqual(checked.stderr, "")
        self.assertFalse((self.at / "it's" / "slurm").exists())

    def test_mistakes_are_told(self):
        error = json.loads(self.fram("out", "--on", "cloud", code=2))["error"]
        self.assertIn("local or slurm", error["message"])
        self.assertEqual(json.loads(self.fram("out", "--partition", "all", code=2))["error"]["key"], "--on")
        error = json.loads(self.fram("out", "--on", "slurm", "--sbatch", "account", code=2))["error"]
        self.assertIn("--account=ice", error["message"])
        # By as many letters as sbatch tells an option from others.
        for option, told in (("--array=0-9%2", "--array"), ("--arr=0-0", "--array"), ("--ar\t0-0", "--array"),
                             ("--clusters=far", "--clusters"), ("--cluster=far", "--clusters"),
                             ("--quiet", "--quiet"), ("--qu", "--quiet")):
            error = json.loads(self.fram("out", "--on", "slurm", f"--sbatch={option}", code=2))["error"]
            self.assertEqual(error["key"], "--sbatch")
            self.assertIn("expected no " + told, error["message"])
        for option in ("--acc=ice", "--cluster-constraint=ib", "--qos=high"):
            self.fram("out", "--on", "slurm", "--sbatch", option, "--dry-run")
        # Zero is no default here; the bounds are the library's, told by the names of options.
        for option, value, told in (("--poll", 0, "above zero"), ("--runs-per-task", 0, "above zero"),
                                    ("--poll", 3601, "found 3601"), ("--runs-per-task", 1000001, "found 1000001"),
                                    ("--jobs", 4097, "found 4097"), ("--jobs", -1, "found -1")):
            error = json.loads(self.fram("out", "--on", "slurm", option, value, code=2))["error"]
            self.assertEqual(error["key"], option)
            self.assertIn(told, error["message"])
        none = dict(os.environ, PATH="/nowhere")
        error = json.loads(self.fram("out", "--on", "slurm", code=2, environment=none))["error"]
        self.assertIn("sbatch", error["message"])

    def scheduler(self):
        """Programs by the names of Slurm's, in front of all others."""
        programs = self.at / "bin"
        programs.mkdir()
        cancel = f'#!/bin/sh\necho "$1" >>"{self.at}/cancelled"\n'
        for name, text in (("sbatch", SBATCH), ("squeue", "#!/bin/sh\n"), ("scancel", cancel)):
            (programs / name).write_text(text)
            (programs / name).chmod(0o755)
        return dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")

    def test_failures_are_made_again(self):
        self.study.write_text(STUDY.format(seeds=1))
        environment = self.scheduler()
        words = ("out", "--on", "slurm", "--poll", "20")
        first = json.loads(self.fram(*words, environment=environment))
        self.assertEqual((first["failed"], first["made"]), (1, 3))
        # It ends, which it did not where tasks found that the run has failed already; it fails again.
        failed, = [p for p in (self.at / "out").glob("runs/*/1.row") if "failed" in p.read_text()]
        changed, tables = failed.stat().st_mtime_ns, self.tables("out")
        # To be shown what would be submitted takes nothing away: no table, and no array that a killed call left.
        (self.at / "out" / "slurm" / "1.job").write_text("4711\n")
        self.fram(*words, "--retry", "--dry-run", environment=environment)
        self.assertEqual((failed.stat().st_mtime_ns, self.tables("out")), (changed, tables))
        again = json.loads(self.fram(*words, "--retry", environment=environment))
        self.assertEqual((again["failed"], again["made"]), (1, 1))
        self.assertEqual((self.at / "cancelled").read_text(), "4711\n")
        self.assertEqual(list((self.at / "out" / "slurm").glob("*.job")), [])

    def test_runs_of_another_fram_are_made_again(self):
        """From the start: what they left is of a Fram that may have counted otherwise."""
        self.study.write_text("scenario: base.yaml\nseeds: 2\nkeep: all\nset: {output.checkpoint_interval: 0.5}\n")
        environment = self.scheduler()
        words = ("out", "--on", "slurm", "--poll", "20")
        self.assertEqual(json.loads(self.fram(*words, environment=environment))["made"], 2)
        tables = self.tables("out")
        other, cut = sorted((self.at / "out").glob("runs/*/*.row"))
        other.write_text("fram study row 7" + other.read_text()[other.read_text().index("\n"):])
        cut.write_text(cut.read_text()[:200])
        left = [row.with_suffix("") / "left" for row in (other, cut)]
        for path in left:
            self.assertTrue(list(path.parent.glob("checkpoint-*.fram")))
            path.write_text("")
        self.fram(*words, "--dry-run", environment=environment)
        self.assertTrue(all(p.exists() for p in (other, cut, *left)))
        self.assertEqual(json.loads(self.fram(*words, environment=environment))["made"], 2)
        self.assertEqual(self.tables("out"), tables)
        self.assertFalse(any(p.exists() for p in left))

    def wait_for_end(self, process):
        out, error = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, error)
        return json.loads(out.splitlines()[-1])

    def start_while_held(self, words, environment, held):
        """A study that goes on while another program writes into the folder of a run, and leaves that alone."""
        lock = os.open(held, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        process = subprocess.Popen(self.words(*words, "--json"), env=environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(4)
        self.assertIsNone(process.poll())
        self.assertTrue((held / "left").exists())
        os.close(lock)
        return self.wait_for_end(process)

    def test_runs_of_another_fram_wait_for_who_writes_them(self):
        self.study.write_text("scenario: base.yaml\nseeds: 2\nkeep: all\n")
        environment = self.scheduler()
        words = ("out", "--on", "slurm", "--poll", "20")
        self.assertEqual(json.loads(self.fram(*words, environment=environment))["made"], 2)
        tables = self.tables("out")
        rows = sorted((self.at / "out").glob("runs/*/*.row"))
        for others in (rows, rows[1:]):
            for row in others:
                row.write_text("fram study row 7" + row.read_text()[row.read_text().index("\n"):])
            held = rows[1].with_suffix("")
            (held / "left").write_text("")
            self.assertEqual(self.start_while_held(words, environment, held)["made"], len(others))
            self.assertFalse((held / "left").exists())
            self.assertEqual(self.tables("out"), tables)

    def test_what_a_task_began_of_a_run_of_another_fram_stays(self):
        """It is taken away once: what is there when its task met another program is of this Fram."""
        self.study.write_text("scenario: base.yaml\nseeds: 1\nkeep: all\n")
        environment = self.scheduler()
        words = ("out", "--on", "slurm", "--poll", "20")
        self.fram(*words, environment=environment)
        tables = self.tables("out")
        row, = (self.at / "out").glob("runs/*/*.row")
        row.write_text("fram study row 7" + row.read_text()[row.read_text().index("\n"):])
        run = row.with_suffix("")
        met = f"""#!/bin/bash
[ "$1" != --version ] && [ ! -e "{self.at}/met" ] || exec "{self.at}/real" "$@"
touch "{self.at}/met"
mkdir "{run}" && touch "{run}/begun"
echo "fram: error: {run}: another run is writing into this folder" >"{run}.log"
echo 2 >"{run}.exit"
echo 7
"""
        (self.at / "bin" / "sbatch").rename(self.at / "real")
        (self.at / "bin" / "sbatch").write_text(met)
        (self.at / "bin" / "sbatch").chmod(0o755)
        self.assertEqual(json.loads(self.fram(*words, environment=environment))["made"], 1)
        self.assertTrue((run / "begun").exists())
        self.assertEqual(self.tables("out"), tables)

    def test_the_worst_of_another_row_are_made_from_the_start(self):
        """What lies beside a row that differs from the run's own is of a Fram that counted otherwise."""
        self.study.write_text("scenario: base.yaml\nseeds: 2\nkeep: {record_of_worst: 1}\n"
                              "set: {output.checkpoint_interval: 0.5}\n")
        environment = self.scheduler()
        words = ("out", "--on", "slurm", "--poll", "20")
        self.fram(*words, environment=environment)
        row, = (self.at / "out" / "worst").glob("*.row")
        run, whole = row.with_suffix(""), row.read_text()
        self.assertTrue(list(run.glob("checkpoint-*.fram")))
        row.write_text("fram study row 7" + whole[whole.index("\n"):])
        row.with_suffix(".exit").write_text("0\n")
        (run / "left").write_text("")
        self.start_while_held(words, environment, run)
        self.assertEqual(row.read_text(), whole)
        self.assertFalse((run / "left").exists())
        # No more is known of what has no row.
        row.unlink()
        (run / "left").write_text("")
        self.fram(*words, environment=environment)
        self.assertEqual(row.read_text(), whole)
        self.assertTrue((run / "left").exists())
        # One that is no longer among the worst stays while another program writes it.
        self.study.write_text("scenario: base.yaml\nseeds: 2\nset: {output.checkpoint_interval: 0.5}\n")
        lock = os.open(run, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        self.fram("out")
        self.assertTrue((run / "left").exists() and row.exists())
        os.close(lock)
        self.fram("out")
        self.assertFalse(run.exists() or row.exists())

    def test_what_a_limit_of_time_stopped_goes_on(self):
        self.study.write_text("scenario: base.yaml\nseeds: 1\nkeep: all\n")
        self.fram("here")
        script = self.fram("there", "--on", "slurm", "--dry-run")
        program = self.at / "program"
        program.write_text(f'#!/bin/sh\necho "$1" >>{self.at}/calls\nexec {FRAM} "$@"\n')
        program.chmod(0o755)
        script = "".join(f"fram={program}\n" if line.startswith("fram=") else line
                         for line in script[:script.rindex("{")].splitlines(keepends=True))
        there = self.at / "there"
        condition = next(there.glob("conditions/*.yaml"))
        run = there / "runs" / condition.stem / "1"
        (there / "slurm").mkdir()
        (there / "slurm" / "1.list").write_text(f"{condition.stem} 1\n")
        task = dict(os.environ, SLURM_ARRAY_TASK_ID="0", SLURM_ARRAY_JOB_ID="7")
        whole = json.loads((self.at / "here" / run.relative_to(there) / "run.json").read_text())
        for damage, calls in ((False, ["resume"]), (True, ["resume", "run"])):
            subprocess.run([FRAM, "run", condition, "-o", run, "--set", "run.seed=1", "--until", "1", "--force", "-q"],
                           check=True)
            for path in run.glob("checkpoint-*.fram") if damage else ():
                path.write_bytes(b"no checkpoint")
            subprocess.run(["bash", "-c", script], check=True, env=task)
            self.assertEqual((self.at / "calls").read_text().split(), calls)
            self.assertEqual((run.parent / "1.exit").read_text(), "0\n")
            self.assertEqual(json.loads((run / "run.json").read_text())["state_hash"], whole["state_hash"])
            (run.parent / "1.exit").unlink()
            (self.at / "calls").unlink()
        # Killed before its code has its name, a task leaves nothing where the runs lie.
        subprocess.run(["bash", "-c", "mv() { :; }\n" + script], check=True, env=task)
        self.assertEqual(list(run.parent.glob("*.exit*")), [])

    def test_nodes_that_cannot_start_the_command(self):
        """A fault of nodes is no answer of a scenario: other nodes take the runs, and where there are none it ends."""
        self.study.write_text(STUDY.format(seeds=2))
        self.fram("here")
        environment = self.scheduler()
        faults = {"missing": "fram=/nowhere/fram", "library": "fram=" + str(self.at / "library"),
                  "version": "fram=" + str(self.at / "version")}
        for name, said, code in (("library", "error while loading shared libraries: libice.so.1", 127),
                                 ("version", "version 'GLIBC_9' not found (required by fram)", 1)):
            (self.at / name).write_text(f"#!/bin/sh\necho \"$0: {said}\" >&2\nexit {code}\n")
            (self.at / name).chmod(0o755)
        # Tasks go to n0 and n1 in turn, to n1 alone where n0 is left out; n0 has the fault, or both.
        sbatch = """#!/bin/bash
[ "$1" != --version ] || exit 0
echo "$*" >>"{at}/words"
script=${{!#}}
last=$(sed -n 's/^#SBATCH --array=0-//p' "$script")
sed 's|^fram=.*|{fault}|' "$script" >"$script.bad"
for task in $(seq 0 "$last"); do
    node=n$((task % 2)) file=$script.bad
    case $* in *--exclude=n0*) node=n1 ;; esac
    [ $node = n0 ] || file="$script{everywhere}"
    SLURMD_NODENAME=$node SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=$task bash "$file"
done >/dev/null 2>&1 &
echo 7
"""
        for name, everywhere in (("missing", False), *((name, True) for name in faults)):
            with self.subTest(fault=name, everywhere=everywhere):
                (self.at / "bin" / "sbatch").write_text(
                    sbatch.format(at=self.at, fault=faults[name], everywhere=".bad" if everywhere else ""))
                out = f"out-{name}-{everywhere}"
                words = self.words(out, "--on", "slurm", "--poll", "20", "--json")
                done = subprocess.run(words, env=environment, capture_output=True, text=True, timeout=300)
                self.assertEqual(done.returncode, 2 if everywhere else 0, done.stderr)
                if everywhere:
                    self.assertRegex(json.loads(done.stdout)["error"]["message"],
                                     r"did not start on the node n[01] \(exit code 127\): .*"
                                     r"(No such file|libice\.so\.1|GLIBC_9)")
                    self.assertEqual(list((self.at / out).glob("runs/*/*.row")), [])
                else:
                    self.assertIn("the node n0 cannot start", done.stderr)
                    self.assertIn("--exclude=n0 ", (self.at / "words").read_text())
                    self.assertEqual(self.tables(out), self.tables("here"))

    def test_the_same_bytes_though_a_node_has_no_command(self):
        why = cluster.missing()
        if why:
            self.skipTest(why)
        self.study.write_text("scenario: base.yaml\nseeds: 12\n")
        self.fram("here")
        programs, empty = self.at / "programs", self.at / "empty"
        programs.mkdir()
        empty.mkdir()
        shutil.copy(FRAM, programs / "fram")
        slurm = cluster.Cluster(4)
        self.addCleanup(slurm.stop)
        slurm.hide_from_node("n3", programs, empty)
        words = [str(programs / "fram"), *self.words("there", "--on", "slurm", "--runs-per-task", "1", "--poll", "2",
                                                     "--json")[1:]]
        done = subprocess.run(words, env=slurm.environment, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the node n3 cannot start", done.stderr)
        self.assertEqual(json.loads(done.stdout)["failed"], 0)
        self.assertEqual(self.tables("there"), self.tables("here"))

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
        out, error = process.communicate(timeout=3000)
        self.assertEqual(process.returncode, 0, error)
        result = json.loads(out.splitlines()[-1])
        self.assertEqual((result["failed"], result["made"]), (0, 2))
        self.assertEqual(self.tables("there"), self.tables("here"))


if __name__ == "__main__":
    program = unittest.main(exit=False)
    if program.result.skipped and program.result.wasSuccessful():
        print("skipped in part:", *[why for _, why in program.result.skipped])
    sys.exit(0 if program.result.wasSuccessful() else 1)
