#!/usr/bin/env python3
"""The list of faults and its runner: faults are found wherever their text stands, stale ones are named, and verdicts
hold for equal code alone."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/mutate"))
import mutants  # noqa: E402
import mutate  # noqa: E402
import verdicts  # noqa: E402
import workplace  # noqa: E402

LIST = """# A comment.
[sign] the sum subtracts
- a + b
+ a - b

[index] a second entry
file: two.c
after: int second(
- v[0]
+ v[1]
test: runs/all
survives: nobody looks
"""


class Place:
    """A workplace where nothing is built or run."""

    tests = [{"name": name, "room": name.split("/")[0], "source": ""}
             for name in ("base/sum", "base/two", "runs/all", "sim/step")]
    seconds = {test["name"]: 0.1 for test in tests}
    problem = None
    folder_is_there = True

    def __init__(self, *_):
        pass

    def prepare(self):
        if not self.folder_is_there:
            raise RuntimeError("no such preset")

    @staticmethod
    def usual(test):
        return len(test["name"])

    know = usual

    def put(self, *_):
        pass

    restore = put

    def make(self, _):
        return self.problem

    def run(self, *_):
        return False, "tests/x.c:12:F:sum:adds:0: no", 0.1


class Listing(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="fram-mutate-")))
        self.plant("tests/mutants/base.txt", LIST)
        self.plant("src/base/one.c", "int sum(int a, int b) { return a\n    + b; }\n")
        self.plant("src/base/two.c", "int first(int *v) { return v[0]; }\nint second(int *v) { return v[0] + v[0]; }\n")

    def plant(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def test_texts_are_found_however_they_are_broken(self):
        one, two = mutants.read(self.root)
        self.assertEqual((one.kind, one.what, two.survives), ("sign", "the sum subtracts", "nobody looks"))
        self.assertEqual((one.test, two.test), ("", "runs/all"))
        path, text = mutants.locate(self.root, one)
        self.assertEqual((path.name, text), ("one.c", "int sum(int a, int b) { return a - b; }\n"))
        self.assertIn("second(int *v) { return v[1] + v[0]; }", mutants.locate(self.root, two)[1])
        self.assertEqual(mutants.check(self.root), ([], 2))
        (self.root / "src/base/one.c").rename(self.root / "src/base/moved.c")
        self.assertEqual(mutants.check(self.root), ([], 2))

    def test_stale_entries_are_named(self):
        self.plant("src/base/three.c", "int other(int a, int b) { return a + b; }\n")
        self.plant("src/base/two.c", "int second(int *w) { return w[0]; }\n")
        problems, _ = mutants.check(self.root)
        self.assertEqual(len(problems), 2)
        self.assertIn("base.txt:2: stands 2 times", problems[0])
        self.assertIn("base.txt:6: stands 0 times", problems[1])
        self.plant("tests/mutants/base.txt", "[oddity] of no kind\n- a\n+ b\n")
        self.assertIn("begins with [kind]", mutants.check(self.root)[0][0])
        self.plant("tests/mutants/base.txt", "[sign] nothing to put\n- a\n")
        self.assertIn("a text to find", mutants.check(self.root)[0][0])

    def test_verdicts_hold_for_equal_code(self):
        one, _ = mutants.read(self.root)
        path = self.root / "bench/results/mutants.csv"
        self.plant("tests/base/test_sum.c", "a test")
        book = verdicts.Verdicts(path)
        row = {"verdict": verdicts.CAUGHT, "test": "base/sum", "function": "f", "seconds": "0.1", "code": "abc",
               "test_code": verdicts.test_code(self.root, "base/sum")}
        book.put(one, row)
        again = verdicts.Verdicts(path)
        self.assertTrue(again.known(self.root, one, "abc"))
        self.assertFalse(again.known(self.root, one, "other code"))
        self.plant("tests/base/test_sum.c", "another test")
        self.assertFalse(again.known(self.root, one, "abc"))

    def test_the_test_that_is_named_comes_first(self):
        one, two = mutants.read(self.root)
        path = pathlib.Path("two.c")
        names = [[t["name"] for t in mutate.order(Place, m, path, first)] for m in (one, two) for first in (0, 2)]
        self.assertEqual(names[0], ["base/two", "base/sum", "runs/all", "sim/step"])
        self.assertEqual(names[1], ["base/two", "base/sum"])
        self.assertEqual(names[2], ["runs/all", "base/two", "base/sum", "sim/step"])
        self.assertEqual(names[3], ["runs/all", "base/two"])

    def campaign(self, place, *more):
        """Exit code of a run of all faults, each known as caught on older code, and what is known afterwards."""
        path = self.root / "bench/results/mutants.csv"
        book = verdicts.Verdicts(path)
        for mutant in mutants.read(self.root):
            book.put(mutant, {"verdict": verdicts.CAUGHT, "test": "base/sum", "code": "older", "test_code": "older"})
        with unittest.mock.patch.multiple(mutate, ROOT=self.root, Workplace=place), \
                unittest.mock.patch.object(sys, "argv", ["mutate.py", "--results", str(path), *more]), \
                contextlib.redirect_stdout(io.StringIO()):
            return mutate.main(), verdicts.Verdicts(path).rows

    def test_verdicts_of_older_code_are_no_answer(self):
        code, rows = self.campaign(Place)
        self.assertEqual((code, {row["function"] for row in rows.values()}), (0, {"adds"}))
        code, rows = self.campaign(type("Broken", (Place,), {"problem": "error: expected ';'"}))
        self.assertEqual((code, rows), (1, {}))
        code, rows = self.campaign(Place, "--minutes", "0")
        self.assertEqual((code, {row["code"] for row in rows.values()}), (1, {"older"}))
        with self.assertRaisesRegex(RuntimeError, "no such preset"):
            self.campaign(type("Nowhere", (Place,), {"folder_is_there": False}))

    def test_failures_are_named(self):
        self.assertEqual(workplace.first_failure("tests/x.c:12:F:vec:lengths:0: no"), "lengths")
        self.assertEqual(workplace.first_failure("FAIL: test_a (x.y)\n"), "test_a")
        self.assertEqual(workplace.first_failure("hangs"), "hangs")
        test = {"name": "geometry/mesh_check", "source": "mesh_weld(&m); overlay_union();"}
        self.assertEqual(workplace.likely(test, pathlib.Path("mesh_check.c")), 2)
        self.assertEqual(workplace.likely(test, pathlib.Path("voronoi.c")), 0)
        self.assertEqual(workplace.likely(test, pathlib.Path("overlay.c")), 2)


if __name__ == "__main__":
    unittest.main()
