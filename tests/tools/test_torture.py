#!/usr/bin/env python3
"""The campaign of faults finds what it is for: commands that misbehave on purpose are found, named and made small."""

import copy
import os
import pathlib
import random
import stat
import subprocess
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TORTURE = ROOT / "tools/torture"
sys.path.insert(0, str(TORTURE))
import books  # noqa: E402
import extras  # noqa: E402
import fixture  # noqa: E402
import mangle  # noqa: E402
import scenario  # noqa: E402
import schema  # noqa: E402

FRAM = os.environ["FRAM"]
# Stands in for the command: does what it does, but for one fault.
DOUBLE = """#!{python}
import os, pathlib, signal, sys
words = sys.argv[1:]
text = pathlib.Path(words[1]).read_text() if len(words) > 1 and words[0] == "run" else ""
if {condition}:
    {fault}
os.execv({fram!r}, [{fram!r}, *words])
"""


class Campaign(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="fram-torture-test-")))

    def double(self, condition, fault):
        path = self.folder / "fram"
        path.write_text(DOUBLE.format(python=sys.executable, condition=condition, fault=fault, fram=FRAM))
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def torture(self, fram, only, *more):
        return subprocess.run([sys.executable, TORTURE / "torture.py", "--fram", fram, "--jobs", "1", "--only", only,
                               "--out", self.folder / "out", *more], capture_output=True, text=True, check=False)

    def case_that_finishes(self):
        """The first case that the command itself runs to its end: which it is changes with the schema."""
        for number in range(12):
            done = self.torture(FRAM, f"scenarios:{number}", "--seed", "2")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            if "'finished': 1" in done.stdout:
                return f"scenarios:{number}"
        return self.fail("no case of twelve ran to its end")

    def test_what_misbehaves_is_found(self):
        only = self.case_that_finishes()
        fram = self.double("'concentration' in text", "os.kill(os.getpid(), signal.SIGSEGV)")
        done = self.torture(fram, only, "--seed", "2", "--shrink", "20")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("run dies of SIGSEGV", done.stdout)
        folder = self.folder / "out" / only.replace(":", "-")
        left = (folder / "scenario.yaml").read_text()
        self.assertIn("concentration", left)
        self.assertLess(len(left.splitlines()), 30, left)
        self.assertNotIn("environment", left)
        self.assertIn(f"--seed 2 --only {only}", (folder / "finding.txt").read_text())
        fram = self.double("words[:1] == ['run'] and '--until' not in words", "sys.exit(1)")
        done = self.torture(fram, only, "--seed", "2", "--shrink", "0")
        self.assertIn("run fails without a word", done.stdout)
        # The second run of a case, which is interrupted, runs another scene.
        fram = self.double("'--until' in words", "words += ['--set', 'run.seed=99', '--set', 'vessel.speed=0.123']")
        done = self.torture(fram, only, "--seed", "2", "--shrink", "0")
        self.assertIn("resumed, on two threads and baseline kernels: ", done.stdout)

    def test_a_failing_call_reaches_the_command(self):
        """Over a few cases the preloaded library makes calls fail, and the command tells them."""
        told = 0
        for number in range(2):
            done = self.torture(FRAM, f"faults:{number}", "--seed", "5")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            told += "told the failure" in done.stdout
        self.assertGreater(told, 0)


class Parts(unittest.TestCase):
    def test_the_schema_is_whole(self):
        sections = schema.read(FRAM)
        keys = {".".join((*k.path, k.name)): k for s in sections for k in s.keys}
        step = keys["run.time_step"]
        self.assertEqual((step.kind, step.low, step.high, step.default), ("number", 1e-7, 10.0, 0.01))
        self.assertEqual(keys["vessel.mode"].choices, ("prescribed", "towed", "free"))
        self.assertTrue(keys["vessel.mass"].automatic)
        self.assertAlmostEqual(keys["ice.smallest_floe_area"].default, 0.0002 * 30**2)
        self.assertTrue(next(s for s in sections if s.path[-1:] == ("lines[]",)).is_list)

    def test_drawing_is_the_same_for_a_seed(self):
        sections = schema.read(FRAM)
        one, two = (scenario.random_scenario(random.Random(7), sections) for _ in range(2))
        self.assertEqual(one, two)
        data = b"{\"a\": [1, 2, 3]}\n" * 9
        self.assertEqual(mangle.mangle(random.Random(3), data), mangle.mangle(random.Random(3), data))

    def test_drawing_reaches_what_asks_for_several_keys(self):
        """Lists of vessels, drifting level ice and so on are drawn, and the keys of any vessel of a list change."""
        sections = schema.read(FRAM)
        reached, changed = set(), 0
        for number in range(200):
            tree = scenario.scene(random.Random(number))
            reached.update(extras.reached(tree))
            if "vessels" in tree:
                before = copy.deepcopy(tree["vessels"])
                scenario.perturb(random.Random(number), [s for s in sections if s.path == ("vessel", "hull")], tree, 3)
                self.assertNotIn("vessel", tree)
                changed += before[1:] != tree["vessels"][1:]
        self.assertEqual(reached, set(extras.REACHED))
        self.assertGreater(changed, 0)

    def test_plain_scenes_are_sound(self):
        """Before keys are changed, most scenes pass the check."""
        sound = 0
        with tempfile.TemporaryDirectory(prefix="fram-torture-test-") as folder:
            path = pathlib.Path(folder, "scene.yaml")
            for number in range(24):
                path.write_text(scenario.text_of(scenario.scene(random.Random(number))) + "\n", encoding="utf-8")
                sound += subprocess.run([FRAM, "check", path], capture_output=True, check=False).returncode == 0
        self.assertGreaterEqual(sound, 18)

    def test_the_runs_that_are_hurt_break_ice(self):
        with tempfile.TemporaryDirectory(prefix="fram-torture-test-") as folder:
            rig = types.SimpleNamespace(root=ROOT, fram=types.SimpleNamespace(path=FRAM))
            folder = fixture.make(rig, pathlib.Path(folder, "fixture"))
            self.assertTrue(fixture.broke_ice(folder / "done"))
            subprocess.run([FRAM, "run", "scene.yaml", "-o", "short", "--until", "0.2", "-q"], cwd=folder, check=True)
            self.assertFalse(fixture.broke_ice(folder / "short"))

    def test_shrinking_keeps_what_fails(self):
        tree = {"a": {"b": 1, "c": [{"d": 2, "e": 3}, {"d": 4}]}, "f": 5}
        small = scenario.shrink(tree, lambda t: any(x.get("e") == 3 for x in t.get("a", {}).get("c", [])))
        self.assertEqual(small, {"a": {"c": [{"e": 3}]}})

    def test_books_that_do_not_close_are_told(self):
        series = {f"{p}_{axis}": [0.0, 1.0] for parts in books.PARTS for p in parts for axis in "xyz"}
        for axis in "xyz":
            series["ice_force_" + axis] = [0.0, 3.0]
            series["ice_force_bow_" + axis] = [0.0, -1.0]
        self.assertIsNone(books.forces_add_up(series))
        series["ice_force_friction_y"][1] += 1e-6
        self.assertIn("ice_force_y in row 2", books.forces_add_up(series))
        listed = {"ship." + name: column for name, column in series.items()}
        self.assertIn("ship.ice_force_y in row 2", books.forces_add_up(listed))
        self.assertIn("no ice load", books.forces_add_up({"time": [0.0]}))


if __name__ == "__main__":
    unittest.main()
