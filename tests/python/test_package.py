#!/usr/bin/env python3
"""The Python package: every method, its errors, and that a world has the hash of the command's run."""

import gc
import inspect
import itertools
import json
import os
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import package  # first: it finds the package `fram`
import numpy as np

import fram

FRAM = os.environ["FRAM"]
TOWED = """
run: {duration: 2, time_step: 0.02}
vessel:
  mode: towed
  x: -26
  speed: 3
  ramp: 0.1
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
ice:
  source: floes
  thickness: 0.5
  breakable: true
  floes:
    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}
    - {length: 40, width: 20, x: 20.5, y: -11}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}
output: {frame_interval: 0.1}
"""
FREE = """
run: {duration: 2, time_step: 0.05}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5, release_time: 0.5}]}
  thrusters: [{x: 18}, {x: -18, kind: main, rudder_deg: 25}]
  positioning: {active: true}
ice: {concentration: 0.5, mean_floe_area: 64, thickness: 0.3}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
"""
# Vessels that nothing keeps on station.
PASSING = """
run: {duration: 0.2, time_step: 0.05}
vessels:
  - {name: tug, mode: towed, speed: 3, hull: {length: 30, beam: 8, draught: 3}, approach: {limit: 40, look_ahead: 30}}
  - {name: ship, mode: towed, x: 80, y: 20, hull: {length: 30, beam: 8, draught: 3}}
ice: {source: none}
"""


def towed(**more):
    return fram.Scenario.from_text(TOWED, **more)


class Package(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def command(self, text, *words):
        """A run of the command; its answer."""
        scene = self.folder / "scene.yaml"
        scene.write_text(text)
        told = subprocess.run([FRAM, "run", scene, "-o", self.folder / "run", "--json", "-q", *words], check=True,
                              capture_output=True, text=True)
        return json.loads(told.stdout)

    def test_a_stepped_world_has_the_hash_of_the_command(self):
        for text in (TOWED, FREE):
            answer = self.command(text, "--force")
            world = fram.Scenario.load(self.folder / "scene.yaml").world()
            world.run_until(world.scenario.duration)
            self.assertEqual(world.hash, answer["state_hash"])
            self.assertEqual(world.steps, answer["steps"])
            self.assertEqual(world.hash, fram.open(self.folder / "run").hash)
            last = fram.open(self.folder / "run").columns()
            for name in world.channels:
                if name != "step_wall_time":
                    self.assertAlmostEqual(world[name], last[name][-1], delta=1e-9 * (1 + abs(world[name])))

    def test_scenarios(self):
        path = self.folder / "scene.yaml"
        path.write_text(TOWED)
        one = fram.Scenario.load(path, {"run.seed": 7, "vessel.speed": 2.5})
        two = fram.Scenario.load(str(path), ["run.seed=7", "vessel.speed=2.5"])
        self.assertEqual(one.hash, two.hash)
        self.assertNotEqual(one.hash, towed().hash)
        self.assertEqual(towed(overrides={"run.seed": 7}).replaced({"vessel.speed": 2.5}).hash, one.hash)
        self.assertIn("seed: 7", one.text)
        self.assertTrue(one.notes)
        self.assertEqual((one.duration, one.time_step, one.files), (2, 0.02, {}))
        one.check()
        (self.folder / "floes.txt").write_text("0 0\n8 0\n8 8\n0 8\n")
        text = "vessel: {present: false}\nice: {source: file, file: floes.txt}\n" \
               "domain: {x_min: -20, x_max: 20, y_min: -20, y_max: 20, boundary: open}\n"
        found = fram.Scenario.from_text(text, self.folder)
        self.assertEqual(found.files, {"ice.file": str(self.folder / "floes.txt")})
        self.assertIsNone(found.world().vessel)
        with self.assertRaises(fram.InputError) as told:
            fram.Scenario.from_text(text)
        self.assertEqual((told.exception.key, told.exception.line), ("ice.file", 2))
        with self.assertRaises(fram.InputError) as told:
            fram.Scenario.load(path, {"run.time_step": -1})
        self.assertEqual((told.exception.key, told.exception.status), ("run.time_step", "input"))
        with self.assertRaises(ValueError) as told:
            fram.Scenario.from_text("run:\n  durration: 3\n")
        self.assertEqual(told.exception.line, 2)
        self.assertIn("durration", str(told.exception))
        with self.assertRaises(fram.InputError):
            fram.Scenario.load(self.folder / "absent.yaml")
        with self.assertRaises(fram.UsageError):
            fram.Scenario.from_text("run\0")

    def test_texts_are_utf_8_in_a_locale_that_is_not(self):
        text = ("import fram, sys\n"
                "assert sys.getfilesystemencoding() == 'ascii'\n"
                "word = 'K\\xf6ln'\n"
                "for title, overrides in (('', {'title': word}), ('', ['title=' + word]), ('title: ' + word, None)):\n"
                "    scenario = fram.Scenario.from_text(title + sys.argv[1], overrides=overrides)\n"
                "    assert 'title: \"K\\xf6ln\"' in scenario.text\n")
        done = subprocess.run([sys.executable, "-c", text, TOWED], capture_output=True, text=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(pathlib.Path(fram.__file__).parents[1]),
                                   "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_paths_are_of_the_file_system_in_a_locale_that_is_not_utf_8(self):
        """A name of UTF-8 bytes, as Python tells it with ISO 8859-1, is that file again."""
        (self.folder / "K\xf6ln.txt").write_text("0 0\n9 0\n9 9\n0 9\n", encoding="utf-8")
        shown = pathlib.Path(os.fsencode(self.folder / "K\xf6ln.txt").decode("iso8859-1"))
        with mock.patch("os.fsencode", lambda path: os.fspath(path).encode("iso8859-1")):
            scenario = fram.Scenario.from_text(FREE, overrides={"ice.source": "file", "ice.file": shown})
        self.assertIn("K\xf6ln.txt", scenario.text)
        scenario.check()

    def test_a_scenario_stays_what_it_was_when_the_working_folder_changes(self):
        (self.folder / "other").mkdir()
        for folder, seed in ((self.folder, 3), (self.folder / "other", 4)):
            (folder / "scene.yaml").write_text(TOWED + f"title: folder {seed}\n")
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        one = fram.Scenario.load("scene.yaml")
        (self.folder / "floes.txt").write_text("0 0\n8 0\n8 8\n0 8\n")
        text = "vessel: {present: false}\nice: {source: file, file: floes.txt}\n" \
               "domain: {x_min: -20, x_max: 20, y_min: -20, y_max: 20, boundary: open}\n"
        two, three = fram.Scenario.from_text(text), fram.Scenario.from_text(text, ".")
        kept = [pickle.dumps(s) for s in (one, two, three)]
        os.chdir(self.folder / "other")
        for scenario, state in zip((one, two, three), kept):
            self.assertEqual(pickle.loads(state).hash, scenario.hash)
            self.assertEqual(scenario.replaced({"run.seed": 5}).replaced({"run.seed": 1}).hash, scenario.hash)

    def test_stepping_reading_and_telling(self):
        world = towed().world()
        times = []
        self.assertAlmostEqual(world.step(3, lambda w: times.append(w.time)), 0.06)
        np.testing.assert_allclose(times, [0.02, 0.04, 0.06])
        self.assertAlmostEqual(world.step(9, lambda w: False), 0.08)
        self.assertAlmostEqual(world.run_until(0.2, lambda w: w.time < 0.15), 0.16)
        self.assertEqual(world.copy().step(9, lambda w: np.all(w.values() > 1e300)), world.time + 0.02)
        self.assertEqual(world.copy().run_until(0.3, lambda w: np.bool_(False)), world.time + 0.02)
        self.assertEqual(world.step(0), world.time)
        for bad in (lambda: world.step(-1), lambda: world.run_until(float("nan"))):
            with self.assertRaises(fram.UsageError):
                bad()
        values = world.values()
        for name, channel in world.channels.items():
            self.assertEqual(values[channel.index], world[name])
        self.assertEqual(world.channels["ice_force_x"].unit, "N")
        self.assertIn("ice", world.channels["ice_force_x"].meaning)
        world["tow_velocity_x"] = 1
        self.assertEqual(world["tow_velocity_x"], 1)
        self.assertIn("tow_velocity_x", world)
        self.assertEqual(world.inputs["tow_velocity_x"].unit, "m/s")
        self.assertNotIn("set_point_x", world)
        with self.assertRaises(KeyError):
            world["no_such"]
        with self.assertRaises(KeyError):
            world["ice_force_x"] = 1
        with self.assertRaises(fram.InputError) as told:
            world["wind_x"] = float("nan")
        self.assertEqual(told.exception.key, "wind_x")
        world.set_path([world.time + 0.2], [(-25.0, 0.1, 0.0)])
        world.step(10)
        self.assertAlmostEqual(world["position_y"], 0.1, delta=0.02)
        world.set_path([], [])
        with self.assertRaises(fram.InputError):
            world.set_path([9, 10], [(0, 0, 0)])
        with self.assertRaises(fram.UsageError):
            world.set_path([9], [(0, 0, 0)], vessel=4)
        self.assertIn("floes", repr(world))

    def test_arrays(self):
        world = towed().world()
        broken = 0
        for _ in range(100):
            world.step()
            broken += len(world.fractures())
        self.assertGreater(broken, 0)
        bodies, floes, view = world.bodies(), world.bodies("floe"), world.view()
        self.assertEqual(len(floes), world["floes"])
        self.assertEqual(len(bodies), world["bodies"])
        self.assertEqual(len(world.bodies(["floe", "vessel"])), len(floes) + 1)
        np.testing.assert_array_equal(view.position[bodies.slot], bodies.position)
        np.testing.assert_array_equal(view.orientation[bodies.slot], bodies.orientation)
        np.testing.assert_array_equal(view.generation[bodies.slot], bodies.generation)
        self.assertTrue(view.lives[bodies.slot].all())
        self.assertEqual(len(set(floes.number)), len(floes))
        with self.assertRaises(ValueError):
            view.position[0, 0] = 1
        world = towed().world()  # where no floe is tilted
        floes, outlines = world.bodies("floe"), world.outlines("floe")
        self.assertEqual(len(outlines), len(floes))
        for outline, mass, thickness in zip(outlines, floes.mass, floes.thickness):
            x, y = outline.T
            area = 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
            self.assertAlmostEqual(mass / (area * thickness), 920, delta=40)
        self.assertEqual(outlines[-1].shape[1], 2)
        with self.assertRaises(IndexError):
            outlines[len(outlines)]
        world.step(100)
        contacts = world.contacts()
        slot = world.vessel[0]
        sign = np.where(contacts["a"]["slot"] == slot, 1.0, np.where(contacts["b"]["slot"] == slot, -1.0, 0.0))
        load = (sign[:, None] * contacts["impulse"]).sum(axis=0) / world.scenario.time_step
        np.testing.assert_allclose(load, [world[f"ice_force_{axis}"] for axis in "xyz"], rtol=1e-9, atol=1e-3)
        # They act where they say and along their normals: moments are those of the channels but for a step of way.
        size = np.linalg.norm(contacts["impulse"], axis=1).sum() / world.scenario.time_step
        self.assertGreater(size, 0)
        arms = contacts["point"] - world.view().position[slot]
        moment = np.cross(arms, sign[:, None] * contacts["impulse"]).sum(axis=0) / world.scenario.time_step
        np.testing.assert_allclose(moment, [world[f"ice_moment_{axis}"] for axis in "xyz"], atol=0.1 * size)
        self.assertGreater(abs(moment).max(), size)
        np.testing.assert_allclose(np.linalg.norm(contacts["normal"], axis=1), 1, rtol=1e-12)
        along = (contacts["normal"] * contacts["impulse"]).sum(axis=1)
        np.testing.assert_allclose(along, contacts["normal_impulse"], atol=1e-9 * size)
        self.assertAlmostEqual(contacts["depth"].max(), world["overlap_max"], delta=1e-12)
        with self.assertRaises(fram.UsageError):
            world.bodies("ship")
        for read in (world.bodies, world.outlines):
            with self.assertRaisesRegex(fram.UsageError, "found none"):
                read([])  # not all of them

    def assert_arrays_tell_what_copies_tell(self, world):
        """Views and shapes equal what copies tell, to the bit, and outlines that are turned here to rounding."""
        bodies, view, shapes = world.bodies(), world.view(), world.shapes()
        rows = bodies.slot
        for name in ("mass", "position", "orientation", "velocity", "angular_velocity", "generation"):
            np.testing.assert_array_equal(getattr(view, name)[rows], getattr(bodies, name))
        self.assertEqual(view.lives.astype(bool).sum(), len(bodies))
        self.assertEqual(len(shapes), len(view.lives))
        outlines = world.outlines(None)
        self.assertEqual(len(shapes.points), len(outlines.points))
        for row, slot in enumerate(rows):
            w, x, y, z = view.orientation[slot]
            turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z)],
                             [2 * (x * y + w * z), 1 - 2 * (x * x + z * z)]])
            np.testing.assert_allclose(shapes[slot] @ turn.T + view.position[slot, :2], outlines[row], atol=1e-9)

    def test_views_go_with_the_world(self):
        world = towed().world()
        view, held, kept = world.view(), [], 0
        self.assertIs(world.view(), view)
        for _ in range(100):
            shapes, position = world.shapes(), view.position
            before = position.copy()
            world.step()
            held.append((position, shapes))  # read at the end, when bodies have moved to larger memory
            if view.position is position:
                kept += 1
                self.assertFalse(np.array_equal(position, before))  # live
            if not len(world.fractures()):
                self.assertIs(world.shapes(), shapes)
        self.assertTrue(0 < kept < 100)
        self.assert_arrays_tell_what_copies_tell(world)
        for array in (view.position, view.angular_velocity, view.lives, world.shapes().points, world.shapes().offsets):
            with self.assertRaises(ValueError):
                array[0] = 1
        with self.assertRaises(ValueError):
            view.position.flags.writeable = True  # the world's own memory
        # After a load and in a copy.
        state, shapes = world.to_bytes(), world.shapes()
        other = world.copy()
        world.step(20)
        self.assert_arrays_tell_what_copies_tell(world)
        world.from_bytes(state)
        self.assertIsNot(world.shapes(), shapes)
        self.assert_arrays_tell_what_copies_tell(world)
        self.assert_arrays_tell_what_copies_tell(other)
        np.testing.assert_array_equal(view.position, other.view().position)
        # When the world is closed, or nobody has it any more, arrays that are held can be read.
        last, values = view.position, view.position.copy()
        mass = other.view().mass
        world.close()
        with self.assertRaisesRegex(fram.UsageError, "closed"):
            view.position
        with self.assertRaises(fram.UsageError):
            world.shapes()
        del other
        gc.collect()
        np.testing.assert_array_equal(last, values)
        self.assertTrue((mass > 0).any())
        self.assertTrue(all(np.isfinite(position).all() and np.isfinite(shapes.points).all()
                            for position, shapes in held))

    def test_memory_of_shapes_is_used_again_when_nobody_has_it(self):
        for keeps in (False, True):
            world = towed().world()
            held, copies, places, again = [], [], set(), 0
            for step in range(100):
                world.step()
                shapes = world.shapes()
                if keeps and step % 10 == 0:  # the whole, a part, one outline
                    held.append((shapes, shapes.points[3:], shapes[len(shapes) - 1])[len(held) % 3])
                    copies.append(np.array(getattr(held[-1], "points", held[-1])))
                if len(world.fractures()):
                    again += shapes.points.ctypes.data in places
                places.add(shapes.points.ctypes.data)
                np.testing.assert_array_equal(np.diff(shapes.offsets), self.lengths(world))
            self.assertEqual(again > 0, not keeps)
            for kept, copied in zip(held, copies):
                np.testing.assert_array_equal(getattr(kept, "points", kept), copied)

    @staticmethod
    def lengths(world):
        """Vertices of the outline in each slot, by another way."""
        bodies, outlines, found = world.bodies(), world.outlines(None), np.zeros(len(world.view().lives), int)
        found[bodies.slot] = np.diff(outlines.offsets)
        return found

    def test_a_recorded_world_that_is_closed_under_a_view_ends_its_recording(self):
        world = towed().world()
        world.record(self.folder / "live")
        world.step(3)
        position = world.view().position
        world.close()
        self.assertEqual(fram.open(self.folder / "live").info["status"], "stopped")
        self.assertTrue(np.isfinite(position).all())

    def test_forces_act_on_bodies(self):
        world = towed().world()
        floes = world.bodies("floe")
        free = int(np.argmax(floes.position[:, 1] < 0))
        body = (floes.slot[free], floes.generation[free])
        other = world.copy()
        world.apply_wrench(body, (1e6, 0, 0), (0, 0, 1e5))
        world.apply_wrench(body, (1e6, 0, 0))
        world.step()
        other.step()
        gain = world.view().velocity[body[0], 0] - other.view().velocity[body[0], 0]
        self.assertAlmostEqual(gain / (2e6 * 0.02 / floes.mass[free]), 1, delta=0.1)
        turn = world.view().angular_velocity[body[0]] - other.view().angular_velocity[body[0]]
        inertia = floes.mass[free] * (40 ** 2 + 20 ** 2) / 12  # of a floe of 40 m by 20 m
        self.assertAlmostEqual(turn[2] / (1e5 * 0.02 / inertia), 1, delta=0.3)
        with self.assertRaises(fram.UsageError):
            world.apply_wrench((body[0], 99), (1, 0, 0))

    def test_the_watched_point_stays_as_positioning_changes_hands(self):
        """A ship that way points turn about its well, 18 m before amidships, lies 18 m off whoever steers."""
        text = FREE[:FREE.index("  mooring:")] + """
  thrusters: [{x: 18}, {x: -18}]
  positioning: {active: true, waypoints: [{time: 0}, {time: 0.1, heading_deg: 90}]}
  station: {watch_x: 18}
ice: {source: none}
"""
        world = fram.Scenario.from_text(text).world()
        world.step(4)
        for on in (0, 1, 0):
            self.assertAlmostEqual(world["offset_x"], 18, delta=0.1)
            self.assertAlmostEqual(world["offset_y"], -18, delta=0.1)
            world["positioning"] = on
            world.step()

    def test_states(self):
        world = fram.Scenario.from_text(FREE).world()
        world.step(5)
        before = world.hash
        with world.snapshot() as kept:
            world["positioning"] = 0
            world["thruster_1_order"] = 1e4
            world.step(5)
            after = world.hash
            kept.restore()
            self.assertEqual(world.hash, before)
        self.assertEqual(world.hash, before)
        other = world.copy()
        for one in (world, other):
            one["positioning"] = 0
            one["thruster_1_order"] = 1e4
            one.step(5)
            self.assertEqual(one.hash, after)
        world.save(self.folder / "state.fram")
        other = world.scenario.world()
        other.load(self.folder / "state.fram")
        self.assertEqual(other.hash, world.hash)
        self.assertEqual(other.to_bytes(), world.to_bytes())
        with self.assertRaises(fram.InputError):
            towed().world().from_bytes(world.to_bytes())
        with self.assertRaises(fram.InputError):
            world.load(self.folder / "absent")
        with self.assertRaises(fram.FramError):
            world.save(self.folder / "no/such/folder/state")
        self.assertEqual(other.hash, world.hash)

    def test_recording_and_runs(self):
        world = towed().world()
        with world.record(self.folder / "live") as recording:
            self.assertTrue(world.recorded)
            begun = fram.open(self.folder / "live")  # tables of no row, not files without heads
            self.assertEqual((len(begun.columns()["time"]), len(begun.fractures["time"])), (0, 0))
            broken = []
            world.step(50, lambda w: broken.extend(w.fractures()))
            recording.checkpoint()
            world.step(50, lambda w: broken.extend(w.fractures()))
            with self.assertRaises(fram.UsageError):
                world.record(self.folder / "other")
        self.assertFalse(world.recorded)
        self.command(TOWED)
        run, mine = fram.open(self.folder / "run"), fram.open(self.folder / "live")
        self.assertEqual(run.hash, mine.hash)
        for name in ("record.fram", "fractures.csv"):
            self.assertEqual((run.folder / name).read_bytes(), (mine.folder / name).read_bytes())
        self.assertEqual(mine.info["status"], "finished")
        self.assertIn("duration", mine.scenario_text)
        self.assertEqual(mine.units["ice_force_x"], "N")
        self.assertEqual(len(mine.columns()["time"]), 100)
        self.assertEqual(len(mine.series), 100 if hasattr(mine.series, "iloc") else len(mine.series))
        told = mine.columns("fractures")
        self.assertGreater(len(told["time"]), 0)
        for name in ("kind", "floe", "pieces", "first_piece", "load", "crack_length", "stress_ratio", "floe_area",
                     "pieces_area", "area_lost", "area_gained"):
            own = "stress_over_strength" if name == "stress_ratio" else name
            np.testing.assert_allclose([event[name] for event in broken], told[own], rtol=1e-9, err_msg=name)
        np.testing.assert_allclose([event["place"] for event in broken],
                                   np.transpose([told[f"place_{axis}"] for axis in "xyz"]), rtol=1e-9)
        floes = mine.floes(1.0)
        self.assertGreaterEqual(len(floes), 3)
        self.assertEqual(floes[0].outline.shape[1], 2)
        # Rings are not closed, as those of a world, and as large as the record says.
        for floe in floes:
            x, y = floe.outline.T
            self.assertFalse(np.array_equal(floe.outline[0], floe.outline[-1]))
            if floe.properties["kind"] == "floe":
                area = 0.5 * (np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
                self.assertAlmostEqual(area / floe.properties["area"], 1, delta=0.01)
        with self.assertRaises(fram.InputError):
            mine.floes(99)
        self.assertTrue(os.path.exists(mine.report()))
        self.assertIn("finished", repr(mine))
        self.assertIn("state_hash", mine._repr_html_())
        self.assertEqual(mine.events, [])
        with self.assertRaises(fram.InputError):
            fram.open(self.folder)
        later = world.record(self.folder / "later")
        world.step()
        for call in (recording.end, recording.checkpoint):
            with self.assertRaises(fram.UsageError):
                call()
        self.assertTrue(world.recorded)
        self.assertEqual(later.end().info["steps"], 101)
        with self.assertRaises(fram.UsageError):
            later.end()
        with world.record(self.folder / "within") as recording:
            recording.end()
            last = world.record(self.folder / "last")
        self.assertTrue(world.recorded)
        last.end()
        told = []
        again = towed().run(self.folder / "third", progress=lambda time, end: told.append((time, end)))
        self.assertEqual(again.hash, run.hash)
        self.assertEqual(told[-1][1], 2)
        half = towed().run(self.folder / "third", force=True, until=0.5)
        self.assertEqual(half.info["status"], "stopped")
        world = towed().world()
        world.load(self.folder / "third/checkpoint-000000000025.fram")
        self.assertEqual((world.hash, world.steps), (half.hash, 25))
        station = fram.Scenario.from_text(FREE).run(self.folder / "station")
        self.assertIsNotNone(station.station)
        self.assertEqual(station.stations, {"": station.station})
        self.assertEqual(len(station.events), 4)
        # A line that a program lets go has not parted.
        world = fram.Scenario.from_text(FREE.replace(", release_time: 0.5", "")).world()
        with world.record(self.folder / "let_go"):
            world["line_1_release"] = 1
            world.step(20)
        self.assertEqual([event["kind"] for event in fram.open(self.folder / "let_go").events], ["line_release"])
        said = subprocess.run([FRAM, "extremes", self.folder / "let_go", "--channel", "line_tension_max"], check=True,
                              capture_output=True, text=True)
        self.assertNotIn("parted", said.stdout)
        passing = fram.Scenario.from_text(PASSING).run(self.folder / "passing")
        self.assertEqual(passing.stations, {})
        self.assertEqual([(event["kind"], event["vessel"], event["other"]) for event in passing.events],
                         [("approach", "tug", "ship")])
        (self.folder / "bad").mkdir()
        (self.folder / "bad/run.json").write_text("{}")
        (self.folder / "bad/series.csv").write_text("time[s],x[m]\n1,2\nthree,4\n5,6\n7,")
        with self.assertRaises(fram.InputError) as error:
            fram.open(self.folder / "bad").columns()
        self.assertEqual(error.exception.line, 3)
        # Units are those of the heads: rows are not read for them.
        self.assertEqual(fram.open(self.folder / "bad").units, {"time": "s", "x": "m"})
        with self.assertRaises(fram.FileError):
            fram.open(self.folder / "bad").columns("fractures")

    def test_optional_libraries(self):
        run = towed().run(self.folder / "run")
        columns = run.columns()
        try:
            import xarray  # noqa: F401
            data = run.to_xarray()
            self.assertEqual(data["ice_force_x"].attrs["units"], "N")
            np.testing.assert_array_equal(data["time"], columns["time"])
            np.testing.assert_array_equal(data["ice_force_x"], columns["ice_force_x"])
            self.assertEqual(data.attrs["state_hash"], run.hash)
            # One that goes on has none.
            whole = (run.folder / "run.json").read_text()
            (run.folder / "run.json").write_text(json.dumps({**run.info, "status": "running"}))
            self.assertNotIn("state_hash", run.to_xarray().attrs)
            (run.folder / "run.json").write_text(whole)
        except ImportError:
            print("without xarray")
        try:
            import matplotlib  # noqa: F401
            self.assertEqual(len(run.plot(["ice_force_x", "ice_force_y"]).get_lines()), 2)
            for line, name in zip(run.plot(["yaw", "position_x"]).get_lines(), ("yaw", "position_x")):
                drawn = np.transpose([columns["time"], columns[name]])
                np.testing.assert_array_equal(line.get_xydata(), drawn)
                self.assertEqual(line.get_label(), f"{name} [{run.units[name]}]")
            np.testing.assert_allclose(fram.runs._going_on(np.array([179.9, -179.9, np.nan, 179, 0, -179, 170])),
                                       [179.9, 180.1, np.nan, 179, 0, -179, -190])
            with self.assertRaises(fram.InputError):
                run.plot("no_such")
            told = {tuple(kind.get_facecolor()[0]): len(kind.get_paths()) for kind in run.plot_field(0.5).collections}
            self.assertEqual(list(told.values()), [2, 4, 1])  # floes, walls, the ship
            self.assertEqual(len(fram.plot_outlines(towed().world().outlines()).collections), 1)
        except ImportError:
            print("without matplotlib")

    def test_optional_libraries_that_are_broken(self):
        """As those that were built for another numpy: what does not need them is not in need of them."""
        for name in ("pandas", "gymnasium"):
            (self.folder / "broken" / name).mkdir(parents=True)
            (self.folder / "broken" / name / "__init__.py").write_text("raise ValueError('numpy.dtype size changed')")
        text = ("import sys, fram\n"
                "run = fram.Scenario.from_text(sys.argv[1], overrides='run.duration=0.1').run(sys.argv[2])\n"
                "assert isinstance(run.series, dict) and isinstance(run.fractures, dict)\n"
                "assert isinstance(fram.StationKeeping(fram.Scenario.from_text(sys.argv[3])).action_space, fram.Box)\n")
        path = os.pathsep.join((str(self.folder / "broken"), str(pathlib.Path(fram.__file__).parents[1])))
        done = subprocess.run([sys.executable, "-c", text, TOWED, self.folder / "with broken", FREE],
                              capture_output=True, text=True, check=False, env={**os.environ, "PYTHONPATH": path})
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_callbacks_raise_through_the_library(self):
        class Mine(Exception):
            pass

        def log(level, text):
            heard.append((level, text))
            if fail:
                raise Mine(text)

        heard, fail = [], False
        context = fram.Context(threads=2, log=log)
        scenario = towed(context=context)
        scenario.run(self.folder / "run")
        self.assertTrue(any(level == "info" for level, _ in heard))
        fail = True
        with self.assertRaises(Mine):
            scenario.run(self.folder / "run", force=True)
        fail = False
        scenario.run(self.folder / "run", force=True)

        def stop(time, end):
            raise Mine

        with self.assertRaises(Mine):
            scenario.run(self.folder / "run", force=True, progress=stop)
        world = scenario.world()
        with self.assertRaises(Mine):
            world.step(5, lambda w: stop(w.time, 0))
        self.assertEqual(world.steps, 1)
        for bad in ({"threads": 0}, {"isa": "sse9"}):
            with self.assertRaises(fram.UsageError):
                fram.Context(**bad)

    def test_a_failed_world_is_not_stepped_on(self):
        world = towed().world()
        state = world.to_bytes()
        floes = world.bodies("floe")
        for slot, generation, y in zip(floes.slot, floes.generation, floes.position[:, 1]):
            if y < 0:
                world.apply_wrench((slot, generation), (1e30, 0, 0))
        with self.assertRaises(ArithmeticError):
            world.step()
        with self.assertRaises(fram.UsageError):
            world.step()
        world.from_bytes(state)
        world.step()

    def test_nothing_outlives_what_it_needs(self):
        for _ in range(20):
            scenario = towed(context=fram.Context(log=lambda level, text: None))
            world = scenario.world()
            del scenario
            world.step()
            copy = world.copy()
            del world
            gc.collect()
            copy.step()
        with copy:
            pass
        with self.assertRaises(fram.UsageError):
            copy.step()
        self.assertIn("closed", repr(copy))

    def test_what_the_collector_meets_in_a_circle_is_destroyed_in_order(self):
        # In a process of its own: a wrong order is a crash. The world, its scenario and context are in one circle with
        # the functions of the script; a recording goes on when Python ends. The collector comes while cffi holds the
        # lock under which it finds a function that is asked for first, as it may.
        text = ("import fram, gc, sys\n"
                "gc.disable()\n"
                "class Circle: pass\n"
                "def make():\n"
                "    c = Circle(); c.self = c\n"
                "    c.context = fram.Context(log=lambda level, text: c)\n"
                "    c.scenario = fram.Scenario.from_text(sys.argv[1], context=c.context)\n"
                "    c.world = c.scenario.world(); c.other = c.world.copy(); c.world.step(2)\n"
                "    c.place, c.shapes = c.world.view().position, c.world.shapes()\n"
                "    return c\n"
                "for _ in range(5): make()\n"
                "with fram._library.ffi._lock: gc.collect()\n"
                "assert not fram._library._made, fram._library._made\n"
                "make().world.record(sys.argv[3])\n"
                "with fram._library.ffi._lock: gc.collect()\n"
                "assert not fram._library._made, fram._library._made\n"
                "kept = make()\n"
                "keep = lambda: kept\n"
                "kept.recording = kept.world.record(sys.argv[2])\n"
                "kept.world.step(3)\n")
        folder, collected = self.folder / "at the end", self.folder / "collected"
        done = subprocess.run([sys.executable, "-c", text, TOWED, folder, collected], capture_output=True, text=True,
                              check=False, timeout=60,
                              env={**os.environ, "PYTHONPATH": str(pathlib.Path(fram.__file__).parents[1])})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(fram.open_run(folder).info["steps"], 5)
        self.assertEqual(fram.open_run(collected).info["status"], "stopped")

    def test_a_world_that_was_looked_at_goes_with_its_last_name(self):
        """Not when the collector comes; a view alone keeps what it shows."""
        self.addCleanup(gc.enable)
        gc.disable()
        world = towed().world()
        world.record(self.folder / "looked at")
        world.step()
        view, address = world.view(), fram._library._address(world._pointer)
        world.shapes()
        del world
        self.assertEqual(fram.open(self.folder / "looked at").info["status"], "stopped")
        self.assertTrue(np.isfinite(view.position[view.lives != 0]).all())
        del view
        self.assertNotIn(address, fram._library._made)

    def test_a_recording_ends_with_its_world(self):
        """Whatever arrays are held; the log hears of it, also one that goes with the world."""
        for arrays, circle in itertools.product((False, True), repeat=2):
            heard, known = [], []

            def log(_level, text, heard=heard, known=known):
                heard.append((text, len(known)))

            world = fram.Scenario.from_text(TOWED, context=fram.Context(log=log)).world()
            folder = world.record(self.folder / f"goes {arrays} {circle}").folder
            world.step()
            heard.clear()
            place = world.view().position if arrays else None
            known.extend([world] if circle else [])
            del log, world, known
            gc.collect()
            self.assertEqual(fram.open(folder).info["status"], "stopped")
            self.assertIn("met no ice", heard[0][0])
            if arrays:
                self.assertTrue(np.all(np.isfinite(place[0])))

    def test_environment(self):
        environment = fram.StationKeeping(fram.Scenario.from_text(FREE), interval=0.2, horizon=1)
        self.assertIs(environment.unwrapped, environment)
        self.assertEqual(environment.action_space.shape, (len(environment.actions),))
        first, info = environment.reset(seed=3)
        self.assertTrue(environment.observation_space.contains(first))
        environment.action_space.seed(1)
        path = [environment.action_space.sample() for _ in range(5)]

        def play():
            rows = [environment.step(action) for action in path]
            return [row[0] for row in rows], rows[-1]

        one, last = play()
        self.assertEqual(len(last), 5)
        self.assertTrue(last[3] and not last[2])
        again, told = environment.reset(seed=3)
        np.testing.assert_array_equal(first, again)
        self.assertEqual(info, told)
        two, _ = play()
        np.testing.assert_array_equal(one, two)
        self.assertLessEqual(last[1], 0)
        self.assertNotEqual(environment.reset(seed=4)[1]["hash"], told["hash"])
        environment.render()
        for bad in ([0.0], np.full(len(environment.actions), np.nan)):
            with self.assertRaises(fram.InputError):
                environment.step(bad)
        environment.close()
        with self.assertRaises(fram.UsageError):
            environment.step(path[0])
        strict = fram.StationKeeping(fram.Scenario.from_text(FREE), interval=0.2, offset_limit=0)
        strict.reset()
        self.assertTrue(strict.step(path[0])[2])
        with self.assertRaises(fram.InputError):
            fram.StationKeeping(towed())
        with self.assertRaises(fram.InputError):
            fram.StationKeeping(fram.Scenario.from_text(FREE), observations=["no_such"])
        box = fram.Box([0, -1], [1, 1])
        self.assertIn(box.sample(), box)
        for low, high in ((5, np.inf), (-np.inf, -5), (-np.inf, np.inf), (-1.7e308, 1.7e308)):
            half = fram.Box([low], [high])
            self.assertIn(half.sample(), half)
        for low, high, shape in ((-1, 1, ()), (-1, [1, 2], (2,))):
            wide = fram.Box(low, high)
            self.assertEqual(wide.shape, shape)
            self.assertIn(wide.sample(), wide)
        with self.assertRaises(fram.InputError):
            fram.Box([0, 2], [1, 1])
        self.assertNotIn([2, 0], box)
        self.assertIn("Box", repr(box))

    def test_actions_are_parts_of_what_thrusters_can_do(self):
        """-1 and 1 are the ends of each order, 0 lies between them; what is told back is the world's."""
        text = FREE.replace("rudder_deg: 25}", "rudder_deg: 25, thrust_astern: 4.0e4}")
        # An azimuth that must not push astern turns from edge to edge round by the bow.
        for middle, angles in ((175, (-165, -5, 155)), (185, (-155, 5, 165)), (180, (-160, 0, 160)),
                               (160, (-180, -20, 140)), (200, (-140, 20, 180)), (100, (-179.999, 0, 179.999))):
            keys = {"ice.source": "none", "vessel.thrusters[0].forbidden_deg": middle,
                    "vessel.thrusters[0].forbidden_width_deg": 40}
            azimuth = fram.StationKeeping(fram.Scenario.from_text(text, overrides=keys), "thruster_1_order_angle")
            azimuth.reset()
            for action, angle in zip((-1.0, 0.0, 1.0), angles):
                azimuth.step([action])
                off = azimuth.world["thruster_1_order_angle"] - angle
                self.assertAlmostEqual((off + 180) % 360, 180, delta=1e-9, msg=f"{middle}, {action}")
        environment = fram.StationKeeping(fram.Scenario.from_text(text), interval=0.19)
        self.assertEqual(environment.interval, 0.2)
        ends = {"thruster_1_order": (0, 1e5), "thruster_1_order_angle": (-179.999, 179.999),
                "thruster_2_order": (-4e4, 1e5), "thruster_2_order_angle": (-25, 25)}
        for action in (-1, 1, 0.5, 0, 7):
            environment.reset()
            observed, reward, _, _, told = environment.step(np.full(len(environment.actions), float(action)))
            world, part = environment.world, (min(action, 1) + 1) / 2
            for name, (low, high) in ends.items():
                self.assertAlmostEqual(world[name], low + part * (high - low), delta=1e-9 * high, msg=name)
            np.testing.assert_array_equal(observed, [world[name] for name in environment.observations])
            self.assertEqual((told["time"], world.steps), (world.time, 4))
        self.assertEqual(environment.observations[:3], ("offset_x", "offset_y", "heading_deviation"))
        x, y, turn = observed[:3]
        self.assertTrue(x != 0 and y != 0 and turn != 0)
        self.assertEqual(reward, -((x ** 2 + y ** 2) ** 0.5 + 0.1 * abs(turn)))

    def test_words(self):
        self.assertRegex(fram.version(), r"^\d+\.\d+\.\d+$")
        self.assertIsInstance(fram.features(), list)
        self.assertEqual([name for name in fram.features() if not name.isidentifier()], [])
        self.assertEqual(fram.__version__, fram.version())

    def test_every_public_name_has_a_docstring_and_is_tried_here(self):
        here = pathlib.Path(__file__).read_text(encoding="utf-8")
        for name in fram.__all__:
            thing = getattr(fram, name)
            self.assertTrue(inspect.getdoc(thing), name)
            if not inspect.isclass(thing) or issubclass(thing, BaseException):
                continue
            for member, value in vars(thing).items():
                a_member = inspect.isfunction(value) or isinstance(value, (property, classmethod))
                if member.startswith("_") or not a_member:
                    continue
                self.assertTrue(inspect.getdoc(getattr(thing, member)) or inspect.getdoc(value), f"{name}.{member}")
                self.assertTrue(re.search(rf"\.{re.escape(member)}\b", here), f"{name}.{member} is not tried")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
