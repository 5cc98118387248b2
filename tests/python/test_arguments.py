#!/usr/bin/env python3
"""Arguments of the Python package that are of the wrong kind: each is refused by an error of Fram's own that names it,
whatever function it is given to."""

import inspect
import pathlib
import sys
import tempfile
import unittest

import package  # noqa: F401  first: it finds the package `fram`
import numpy as np

import fram
from scenes import FREE, TOWED

HALF = "\ud800"  # half a pair of surrogates, which no text for C and no path has
EMPTY, PAIR = [], (1, 2)  # of no numbers, and of two
PARTS = [object(), 1j, [None], [[1, 2], [3]], {1: 2}, b"\0", "a\0b", HALF, np.array("x"),
         np.array(["2020-01-01"], "M8[D]"), dict]
NUMBERS = [*PARTS, "abc", "5", None, EMPTY, PAIR, 10**400]
NUMBERS_OR_NONE = [wrong for wrong in NUMBERS if wrong is not None]
WHOLE = [*NUMBERS, 1.5, float("nan"), 2**70, -2**70]
TEXTS = [wrong for wrong in PARTS if not isinstance(wrong, (str, bytes))] + [None, 5, 2.5, [], "a\0b", HALF]
FLAGS = [*NUMBERS, 2, 1.5]
CALLS = [object(), 5, "abc", [], True]
ANY = object()  # what may be given is not to be told by its kind


class Arguments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.at = pathlib.Path(folder.name)
        cls.scenario = fram.Scenario.from_text(TOWED)
        cls.run_made = cls.scenario.run(cls.at / "run")
        cls.world = cls.scenario.world()
        cls.environment = fram.StationKeeping(fram.Scenario.from_text(FREE))
        cls.environment.reset()
        cls.addClassCleanup(cls.environment.close)

    def assert_refused(self, key, function, *arguments, **named):
        with self.assertRaises(fram.FramError) as caught:
            function(*arguments, **named)
        self.assertEqual(caught.exception.key, key)
        self.assertRegex(caught.exception.message, "expected |no living body")

    def assert_each_refused(self, function, valid, wrong):
        """Each parameter of the function is in `wrong`, so that none is forgotten."""
        names = [name for name, p in inspect.signature(function).parameters.items() if p.kind != p.VAR_KEYWORD]
        self.assertEqual(sorted(wrong), sorted(names), function)
        for name, values in wrong.items():
            for value in () if values is ANY else values:
                with self.subTest(function=function.__qualname__, argument=name, value=repr(value)[:40]):
                    self.assert_refused(name, function, **{**valid, name: value})

    def test_of_worlds(self):
        w, path = self.world, {"times": [1], "places": [(0, 0, 0)]}
        self.assert_each_refused(w.step, {}, {"n": [*WHOLE, -1, 2**63], "callback": CALLS})
        self.assertEqual(w.steps, 0)
        self.assert_each_refused(w.run_until, {"time": 0}, {"time": [*NUMBERS, float("nan")], "callback": CALLS})
        lists = [wrong for wrong in NUMBERS if wrong is not EMPTY]
        self.assert_each_refused(w.set_path, path, {
            "times": [wrong for wrong in lists if wrong is not PAIR], "places": lists,
            "vessel": [*WHOLE, -1, 1, 2**31, 2**40]})
        vectors = [*NUMBERS, ("1", "2", "3")]
        self.assert_each_refused(w.apply_wrench, {"body": w.vessel, "force": (0, 0, 0)},
                                 {"body": NUMBERS, "force": vectors, "moment": vectors})
        for function in (w.bodies, w.outlines):
            self.assert_each_refused(function, {}, {"kind": [5, "abc", [], [[]], [5], ["floe", None], object()]})
        self.assert_each_refused(w.from_bytes, {}, {"state": [None, 5, "abc", [1], object()]})
        self.assert_each_refused(w.save, {}, {"path": TEXTS})
        self.assert_each_refused(w.load, {}, {"path": TEXTS})
        self.assert_each_refused(w.record, {"folder": self.at / "record"}, {
            "folder": TEXTS, "force": FLAGS, "with_paths": FLAGS, "live": CALLS,
            "live_page": [wrong for wrong in TEXTS if wrong is not None]})
        self.assertFalse((self.at / "record").exists())
        for value in NUMBERS:
            self.assert_refused("wind_x", w.__setitem__, "wind_x", value)
        for name in (None, 5, [], "nothing"):
            with self.assertRaises(KeyError):
                w[name]
            with self.assertRaises(KeyError):
                w[name] = 1
            self.assertNotIn(name, w)
        for row in ("a", None, 1.5, slice(0, 1)):
            self.assert_refused("row", w.outlines().__getitem__, row)

    def test_what_is_a_number_is_taken(self):
        from decimal import Decimal
        from fractions import Fraction
        w = self.scenario.world()
        for value in (3, np.float32(3), np.int64(3), np.array(3.0), Decimal(3), Fraction(3), True):
            w["wind_x"] = value
            self.assertEqual(w["wind_x"], float(value))
        w.set_path((Fraction(1, 2), 2**10), [(Decimal(1), 2, 0), (np.float32(3), 4, 0)], vessel=np.int64(0))
        w.set_path([], [])
        w.step(np.int32(2))
        self.assertEqual(w.steps, 2)

    def test_of_scenarios_and_runs(self):
        s, r, contexts = self.scenario, self.run_made, [5, "abc", 0, [], fram.Context]
        overrides = [5, [5], [None], object(), dict, "a\0b", ["a\0b"], {"run.seed": "a\0b"}]
        self.assert_each_refused(fram.Scenario.load, {"path": "x.yaml"},
                                 {"path": TEXTS, "overrides": overrides, "context": contexts})
        self.assert_each_refused(fram.Scenario.from_text, {"text": TOWED}, {
            "text": TEXTS, "base": [wrong for wrong in TEXTS if wrong is not None], "overrides": overrides,
            "context": contexts})
        self.assert_each_refused(s.replaced, {}, {"overrides": overrides})
        self.assert_each_refused(s.run, {"folder": self.at / "none"}, {
            "folder": TEXTS, "force": FLAGS, "until": NUMBERS_OR_NONE, "progress": CALLS})
        self.assertFalse((self.at / "none").exists())
        for function in (fram.Run, fram.open):
            self.assert_each_refused(function, {"folder": self.at / "run"}, {"folder": TEXTS, "context": contexts})
        self.assert_each_refused(r.floes, {}, {"time": NUMBERS})
        self.assert_each_refused(r.columns, {}, {"table": TEXTS})
        self.assert_each_refused(r.report, {}, {"output": [wrong for wrong in TEXTS if wrong is not None]})

    def test_of_pictures(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("without matplotlib")
        r = self.run_made
        self.assert_each_refused(r.plot, {}, {"channels": [None, 5, [5], [None], object()], "axes": ANY})
        self.assert_each_refused(r.plot_field, {}, {"time": NUMBERS, "axes": ANY})
        self.assert_each_refused(fram.plot_outlines, {}, {
            "outlines": [None, 5, "abc", [1, 2], [[1, 2]], [[(1, 2, 3)]], [None], object()], "axes": ANY})

    def test_of_contexts_and_environments(self):
        self.assert_each_refused(fram.Context, {}, {"threads": [*WHOLE, 0, 257], "log": CALLS,
                                                    "isa": [wrong for wrong in TEXTS if wrong is not None] + ["abc"]})
        free = fram.Scenario.from_text(FREE)
        names = [5, [5], [None], object()]
        self.assert_each_refused(fram.StationKeeping, {"scenario": free}, {
            "scenario": [None, 5, "abc"], "actions": names, "observations": names, "interval": NUMBERS,
            "horizon": NUMBERS_OR_NONE, "offset_limit": NUMBERS_OR_NONE, "reward": CALLS})
        e = self.environment
        self.assert_each_refused(e.reset, {}, {"seed": [*NUMBERS_OR_NONE, 1.5, float("nan")], "options": ANY})
        self.assert_each_refused(e.step, {}, {"action": [wrong for wrong in NUMBERS if wrong is not PAIR]})
        bounds = [wrong for wrong in NUMBERS if wrong is not EMPTY and wrong is not PAIR]
        self.assert_each_refused(fram.Box, {"low": 0, "high": 1}, {"low": bounds, "high": bounds,
                                                                   "dtype": ["abc", str, object, complex, 5, HALF,
                                                                             "\udcff", "f8,\0"]})
        self.assert_refused("high", fram.Box, [0, 0], [1, 1, 1])
        box = fram.Box(0, 1)
        self.assert_each_refused(box.seed, {}, {
            "seed": [wrong for wrong in WHOLE if wrong is not None and str(wrong) != str(2**70)]})
        for wrong in (*PARTS, "0.5", None):
            self.assertNotIn(wrong, box)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
