#!/usr/bin/env python3
"""A world that is stepped and recorded in Python leaves what `fram run` leaves, but for wall times.

Several vessels with events in an endless field, a moored ship in level ice that drifts past, floes that break under a
towed hull while somebody looks on."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import package  # first: it finds the package `fram`

import fram

FRAM = os.environ["FRAM"]
PAGE = package.SOURCE / "build/viewer/playback.html"
SEVERAL = """
run: {duration: 3, time_step: 0.02, seed: 9}
vessels:
  - name: ship
    mode: free
    hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
    mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5, release_time: 1}]}
    thrusters: [{x: 18, failure_time: 2}, {x: -18}]
    positioning: {active: true}
  - {name: tug, mode: towed, x: 30, y: 20, speed: 1.5, hull: {length: 40, beam: 10, draught: 4, freeboard: 2}}
ice: {concentration: 0.7, mean_floe_area: 64, thickness: 0.4, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -60, y_max: 60, boundary: feeding, drift_speed: 1.5}
output: {frame_interval: 0.3, checkpoint_interval: 1, picture_interval: 2}
"""
DRIFTING = """
run: {duration: 3, time_step: 0.02, seed: 2}
vessel:
  mode: free
  x: -30
  hull: {form: icebreaker, length: 60, beam: 14, draught: 5, freeboard: 3, stem_angle_deg: 30, entrance_angle_deg: 32,
         flare_angle_deg: 10, stern_angle_deg: 30, parallel_midbody: 0.45}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
ice: {source: level, thickness: 0.2, breakable: true, level: {x_min: 1}}
domain: {x_min: -80, x_max: 60, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 3, drift_direction_deg: 180}
output: {frame_interval: 0.3, checkpoint_interval: 1}
"""
TOWED = """
run: {duration: 2, time_step: 0.02}
vessel: {mode: towed, x: -26, speed: 3, ramp: 0.1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice:
  source: floes
  thickness: 0.5
  breakable: true
  floes: [{length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}, {length: 40, width: 20, x: 20.5, y: -11}]
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}
output: {frame_interval: 0.1, checkpoint_interval: 0.5}
"""


def without_wall_times(path):
    """A file of a run as it is the same for each run."""
    content = path.read_bytes()
    if path.name == "series.csv":
        rows = [line.split(b",") for line in content.splitlines()]
        wall = [i for i, head in enumerate(rows[0]) if b"wall" in head]
        assert wall
        return [[word for i, word in enumerate(row) if i not in wall] for row in rows]
    if path.name == "run.json":
        return {key: value for key, value in json.loads(content).items()
                if key == "time_s" or not (key.endswith(("_s", "_ms")) or key == "real_time_factor")}
    return len(content) if path.name.startswith("checkpoint-") else content  # it holds the checksum of the series


class SameRun(unittest.TestCase):
    def compare(self, text, more=(), **words):
        """The folders of the command's run and of the world's; returns what the last tells."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scene.yaml").write_text(text)
            subprocess.run([FRAM, "run", folder / "scene.yaml", "-o", folder / "run", "--quiet", *more], check=True,
                           capture_output=True)
            world = fram.Scenario.load(folder / "scene.yaml").world()
            with world.record(folder / "live", **words):
                world.run_until(world.scenario.duration)
            files = [{str(path.relative_to(top)): without_wall_times(path) for path in top.rglob("*") if path.is_file()}
                     for top in (folder / "run", folder / "live")]
            self.assertEqual(files[0].keys(), files[1].keys())
            for file, content in files[0].items():
                self.assertEqual(content, files[1][file], file)
            run = fram.open(folder / "live")
            return run.info, run.events, len(run.columns("fractures")["time"]) if "fractures.csv" in files[0] else 0

    def test_several_vessels_with_events_in_an_endless_field(self):
        info, events, _ = self.compare(SEVERAL)
        self.assertEqual((info["status"], info["steps"]), ("finished", 150))
        # Four lines let go and a thruster that failed; and the tug comes to the band.
        self.assertEqual([event["vessel"] for event in events], ["ship"] * 4 + ["tug", "ship"], events)

    def test_level_ice_that_drifts(self):
        info, _, broken = self.compare(DRIFTING)
        self.assertEqual(info["steps"], 150)
        self.assertGreater(broken, 0)

    def test_floes_that_break_while_somebody_looks_on(self):
        if not PAGE.exists() or "libmicrohttpd" not in fram.features():
            self.assertGreater(self.compare(TOWED)[2], 0)
            return
        told = []
        self.assertGreater(self.compare(TOWED, ["--live"], live_page=PAGE, live=told.append)[2], 0)
        self.assertTrue(told[0].startswith("http://127.0.0.1:"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
