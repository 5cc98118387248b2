#!/usr/bin/env python3
"""bench/run_peers.py: a table made in pieces keeps what was measured before, and tells by which machine and when."""

import argparse
import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import run_peers  # noqa: E402

NUMBERS = ("ms_least", "us_per_floe", "fram_is_faster_by", "collide_ms", "solve_ms", "forces_ms", "contact_points",
           "pairs", "ship_force_kN")
OPTIONS = {"repeat": 1, "dt": 0.02, "iterations": 10, "warm": 5, "time": 20, "solver": "fast"}


def scene(cover, time=20, **ms):
    """A scene as it is measured: the milliseconds of each program."""
    programs = {name: {"ms": value, **dict.fromkeys(NUMBERS, 1.0),
                       "penetration": {"mean_m": 0.0, "p99_m": 0.0, "max_m": 0.0}} for name, value in ms.items()}
    return {"floes": 1000, "cover": cover, "programs": programs, "options": {**OPTIONS, "time": time}}


def machine(date):
    return {"date": date, "processor": "EPYC", "cores": 2, "compiler": "gcc", "bullet": "3.24", "ode": "0.16.2"}


class Pieces(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="fram-peers-"))) / "peers"

    def report(self, date, new):
        """What the command keeps and prints after it has measured these."""
        options = argparse.Namespace(out=str(self.base), fresh=False)
        with unittest.mock.patch.object(run_peers, "machine", lambda _: machine(date)):
            run_peers.write_report(new, options)
        return json.loads(self.base.with_suffix(".json").read_text()), self.base.with_suffix(".md").read_text()

    def test_programs_are_kept_with_their_machine(self):
        self.report("2026-11-01", {"scenes": [scene(75, fram=1, ode=4), scene(90, fram=2, ode=8)]})
        kept, page = self.report("2026-11-02", {"scenes": [scene(75, fram=1.5, box3d=3)],
                                                "threads": [{"floes": 1000, "gain": [1.5], "copies": [1.9]}]})
        first, second = kept["scenes"]
        self.assertEqual({name: (row["ms"], row["machine"]["date"]) for name, row in first["programs"].items()},
                         {"fram": (1.5, "2026-11-02"), "ode": (4, "2026-11-01"), "box3d": (3, "2026-11-02")})
        self.assertEqual({row["machine"]["date"] for row in second["programs"].values()}, {"2026-11-01"})
        self.assertIn("ODE, Box3D and Jolt, 2026-11-02", page.splitlines()[0])
        words = "Measured 2026-11-01, EPYC, 2 cores; gcc; Bullet 3.24, ODE 0.16.2: "
        self.assertEqual([line.removeprefix(words) for line in page.splitlines() if line.startswith("Measured")],
                         ["ode.", "fram; ode."])

    def test_a_scene_with_other_options_begins_anew(self):
        self.report("2026-11-01", {"scenes": [scene(75, fram=1, ode=4)]})
        kept, _ = self.report("2026-11-02", {"scenes": [scene(75, time=40, fram=1)]})
        self.assertEqual([list(s["programs"]) for s in kept["scenes"]], [["fram"]])


if __name__ == "__main__":
    unittest.main()
