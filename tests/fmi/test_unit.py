#!/usr/bin/env python3
"""fram fmu: the unit holds what it must, steps as a world does, goes back to the bit, and refuses what it cannot do."""

import ctypes as c
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

from unit import ERROR, Unit, World

FRAM, BUILD = os.environ["FRAM"], pathlib.Path(os.environ["FRAM_BUILD"])
if os.environ.get("FRAM_TEST_SANITIZE"):
    print("skipped: a unit under sanitizers is not loaded by a Python without them")
    sys.exit(77)
ROLL_BACKS = int(os.environ.get("FRAM_ROLL_BACKS", "60" if os.environ.get("FRAM_TEST_SHORT") else "1000"))
SCENE = """
title: Ship & "ice" <of> its own
run: {duration: 10, time_step: 0.05}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}, {x: -18, kind: main, rudder_deg: 25}]
ice: {source: file, file: ice of mine.txt, thickness: 0.4, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 6, current_direction_deg: 180}
"""
OUTPUTS = ("offset_x", "velocity_x", "yaw", "ice_force_x", "contacts", "kinetic_energy", "splits", "bendings")


class Units(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name) / "a folder"
        cls.folder.mkdir()
        (cls.folder / "ice of mine.txt").write_text(
            "\n".join(f"{x} {y}\n{x + 9} {y}\n{x + 9} {y + 9}\n{x} {y + 9}\n"
                      for x in (25, 36, 47) for y in (-16, -5, 6)))
        cls.scene = cls.folder / "scene.yaml"
        cls.scene.write_text(SCENE)
        cls.fram("fmu", cls.scene, "-o", cls.folder / "ship.fmu", "-q")
        cls.unit = Unit(cls.folder / "ship.fmu", cls.folder / "unpacked unit")

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def fram(cls, *words, code=0):
        done = subprocess.run([FRAM, *words], capture_output=True, text=True, check=False)
        assert done.returncode == code, done.stderr
        return done.stderr

    def test_what_the_unit_holds(self):
        unit = self.unit
        self.assertEqual(unit.description.get("fmiVersion"), "2.0")
        self.assertEqual(unit.description.get("description"), 'Ship & "ice" <of> its own')
        self.assertTrue((unit.folder / "resources/ice of mine.txt").exists())
        kinds = {name: v.get("causality") for name, v in unit.variables.items()}
        self.assertEqual(kinds["thruster_1_order"], "input")
        self.assertEqual(kinds["ice_force_x"], "output")
        self.assertNotIn("step_wall_time", kinds)
        self.assertEqual(unit.variables["ice_force_x"].find("Real").get("unit"), "N")
        units = {u.get("name") for u in unit.description.iter("Unit")}
        for variable in unit.variables.values():
            self.assertIn(variable.find("Real").get("unit"), units | {None})
        outputs = [i for i, v in enumerate(unit.variables.values(), start=1) if v.get("causality") == "output"]
        self.assertEqual([int(u.get("index")) for u in unit.description.find("ModelStructure/Outputs")], outputs)
        self.assertEqual(unit.binary.fmi2GetVersion(), b"2.0")
        # The same scenario makes the same bytes.
        (self.folder / "again").mkdir()
        self.fram("fmu", self.scene, "-o", self.folder / "again/ship.fmu", "-q")
        self.assertEqual((self.folder / "again/ship.fmu").read_bytes(), (self.folder / "ship.fmu").read_bytes())

    def test_a_controller_outside_does_what_it_does_in_c(self):
        os.chdir("/")  # nothing depends on the working folder
        world, instance = World(BUILD / "libfram.so", self.scene), self.unit.instance().initialise(start=100.0)
        dt = self.unit.step_size
        for i in range(120):
            x, v = instance.get("offset_x", "velocity_x")
            self.assertEqual((x, v), (world["offset_x"], world["velocity_x"]))
            order = -2e4 * x - 4e5 * v
            instance.set("thruster_2_order", order)
            world["thruster_2_order"] = order
            if i == 60:
                instance.set("line_1_release", 1)
                world["line_1_release"] = 1
            instance.step(100 + i * dt, dt)
            world.step()
        names = [name for name, v in self.unit.variables.items() if v.get("causality") == "output"]
        self.assertEqual(instance.get(*names), [world[name] for name in names])
        self.assertEqual(instance.get("lines_parted"), [1])
        self.assertNotEqual(instance.get("ice_force_averaged_x"), [0])
        self.assertFalse([text for status, _, text in instance.told if status >= ERROR])
        instance.free()
        world.free()

    def test_roll_backs_are_equal_to_the_bit(self):
        rng, dt = random.Random(3), self.unit.step_size
        one, two = self.unit.instance(name="one").initialise(), self.unit.instance(name="two").initialise()
        step = 0
        for number in range(ROLL_BACKS):
            if step > 180:
                one.call("Reset")
                one.initialise()
                step = 0
            state = one.keep()
            before, told = one.get(*OUTPUTS), rng.uniform(-1e5, 1e5)
            one.set("thruster_2_order", told)
            one.step(step * dt, 2 * dt)
            after = one.get(*OUTPUTS)
            one.back(state)
            self.assertEqual(one.get(*OUTPUTS), before)
            other = one
            if number % 5 == 0:  # through bytes, in another instance
                other = two
                foreign = two.from_bytes(one.bytes_of(state))
                two.back(foreign)
                two.forget(foreign)
                self.assertEqual(two.get(*OUTPUTS), before)
            other.set("thruster_2_order", told)
            other.step(step * dt, 2 * dt)
            self.assertEqual(other.get(*OUTPUTS), after)
            if other is two:
                one.set("thruster_2_order", told)
                one.step(step * dt, 2 * dt)
            one.forget(state)
            step += 2
        one.free()
        two.free()

    def test_what_cannot_be_is_refused(self):
        instance, dt = self.unit.instance().initialise(), self.unit.step_size
        for step in (0.5 * dt, 1.2 * dt, 0, -dt, float("nan"), float("inf")):
            instance.step(0, step, status=ERROR)
            self.assertIn("whole multiple", instance.told[-1][2])
        instance.step(0, 3 * dt * (1 + 1e-9))
        instance.step(0, dt, status=ERROR)
        self.assertIn("stands at", instance.told[-1][2])
        instance.set("wind_x", float("nan"), status=ERROR)
        instance.set("ice_force_x", 1, status=ERROR)
        self.unit.reference["nothing"] = 10**6
        instance.set("nothing", 1, status=ERROR)
        instance.set("wind_x", 1e9)
        instance.step(3 * dt, dt, status=ERROR)
        self.assertIn("wind_x", instance.told[-1][2])
        instance.from_bytes(b"no state at all", status=ERROR)
        instance.from_bytes(b"0" * 100000, status=ERROR)
        instance.call("Reset")
        instance.initialise().step(0, dt)
        instance.call("SetupExperiment", 0, c.c_double(0), c.c_double(9), 0, c.c_double(0), status=ERROR)
        for name in ("GetReal", "SetReal"):
            instance.call(name, None, c.c_size_t(1), (c.c_double * 1)(), status=ERROR)
            instance.call(name, (c.c_uint * 1)(), c.c_size_t(1), None, status=ERROR)
            instance.call(name, None, c.c_size_t(0), None)
        instance.free()
        self.assertFalse(self.unit.instance(guid="{of another}").c)
        self.assertFalse(self.unit.instance(where="file:///no/such/folder").c)
        early = self.unit.instance()
        early.step(0, dt, status=ERROR)
        early.free()

    def test_a_handle_that_is_no_state_is_refused(self):
        one, two = self.unit.instance(name="one").initialise(), self.unit.instance(name="two").initialise()
        state, again = one.keep(), one.keep()
        gone = c.c_void_p(again.value)
        one.forget(again)
        one.forget(c.c_void_p())
        size, room = c.c_size_t(), (c.c_char * 8)()
        for instance, handle in ((two, state), (one, gone), (one, c.c_void_p(1)), (one, c.c_void_p())):
            instance.call("SetFMUstate", handle, status=ERROR)
            instance.call("SerializedFMUstateSize", handle, c.byref(size), status=ERROR)
            instance.call("SerializeFMUstate", handle, room, c.c_size_t(8), status=ERROR)
            if handle.value:
                instance.call("FreeFMUstate", c.byref(handle), status=ERROR)
        one.call("SerializeFMUstate", state, room, c.c_size_t(8), status=ERROR)
        self.assertIn("less room", one.told[-1][2])
        one.call("GetFMUstate", c.byref(state))  # a state that is handed in is used again
        one.back(state)
        one.call("FreeFMUstate", state)  # the state for its address, as fmusim 0.0.39 does
        self.assertIn("address", one.told[-1][2])
        one.call("SetFMUstate", state, status=ERROR)
        two.keep()  # and never forgotten: goes with the instance
        one.free()
        two.free()

    def test_the_command(self):
        told = self.fram("fmu", self.scene, "-o", self.folder / "few.fmu", "--in", "thruster_*", "--out", "ice_force_?",
                         "--out", "yaw")
        self.assertIn("4 inputs, 4 outputs, 1 files", told)
        for words, word in ((("--in", "no_such"), "no_such"), (("--out", "x*y"), "--out"), ((), "NAME.fmu")):
            output = self.folder / ("few.fmu" if words else "1-few.fmu")
            self.assertIn(word, self.fram("fmu", self.scene, "-o", output, "--force", *words, code=2))
        self.assertIn("--output", self.fram("fmu", self.scene, code=2))
        self.assertIn("time_step", self.fram("fmu", self.scene, "-o", self.folder / "bad.fmu", "--set",
                                             "run.time_step=-1", code=2))
        self.assertFalse((self.folder / "bad.fmu").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
