#!/usr/bin/env python3
"""fram fmu, of FMI 2.0 and of 3.0: the unit holds what it must, steps as a world does, goes back to the bit, and
refuses what it cannot do."""

import ctypes as c
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

from unit import ERROR, Unit, World

FRAM, BUILD = os.environ["FRAM"], pathlib.Path(os.environ["FRAM_BUILD"])
if os.environ.get("FRAM_TEST_SANITIZE"):
    print("skipped: a unit under sanitizers is not loaded by a Python without them")
    sys.exit(77)
ROLL_BACKS = int(os.environ.get("FRAM_ROLL_BACKS", "30" if os.environ.get("FRAM_TEST_SHORT") else "500"))
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
# Units of variables by base units of the SI, as importers convert them: a degree is pi / 180 of a radian.
SI = {"s": {"s": 1}, "m": {"m": 1}, "kg": {"kg": 1}, "m/s": {"m": 1, "s": -1}, "rad/s": {"rad": 1, "s": -1},
      "deg": {"rad": 1, "factor": math.pi / 180}, "N": {"kg": 1, "m": 1, "s": -2}, "N m": {"kg": 1, "m": 2, "s": -2},
      "N s": {"kg": 1, "m": 1, "s": -1}, "J": {"kg": 1, "m": 2, "s": -2}, "W": {"kg": 1, "m": 2, "s": -3}}
TOWED = """
run: {duration: 20, time_step: 0.05, speed_limit: 5}
vessels:
  - {name: barge, mode: prescribed, hull: {form: box, length: 20, beam: 6, draught: 2, freeboard: 1},
     path: [{time: 0}, {time: 0.1, y: 0.4}, {time: 90.1, x: 360, y: 0.4}]}
  - {name: tug, mode: free, y: -40, hull: {form: box, length: 20, beam: 6, draught: 2, freeboard: 1},
     positioning: {waypoints: [{time: 0.1, x: 5, y: -35}]}}
ice: {source: none}
domain: {boundary: open}
"""
OUTPUTS = ("offset_x", "velocity_x", "yaw", "ice_force_x", "contacts", "kinetic_energy", "splits", "bendings")


class Units:
    """The tests that both versions share."""

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
        cls.fram("fmu", cls.scene, "-o", cls.folder / "ship.fmu", "-q", "--fmi", cls.version)
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
        self.assertEqual(unit.description.get("fmiVersion"), f"{self.version}.0")
        self.assertEqual(unit.description.get("description"), 'Ship & "ice" <of> its own')
        self.assertTrue((unit.folder / "resources/ice of mine.txt").exists())
        kinds = {name: v.get("causality") for name, v in unit.variables.items()}
        self.assertEqual(kinds["thruster_1_order"], "input")
        self.assertEqual(kinds["ice_force_x"], "output")
        self.assertNotIn("step_wall_time", kinds)
        self.assertEqual(unit.unit_of("ice_force_x"), "N")
        self.assertEqual(unit.variables["kinetic_energy"].get("description"),
                         "of all bodies that move freely, and of towed vessels")
        self.assertEqual(unit.variables["lines_parted"].get("description"), "lines that have parted or were let go")
        units = {u.get("name") for u in unit.description.iter("Unit")}
        for variable in unit.variables:
            self.assertIn(unit.unit_of(variable), units | {None})
        for element in unit.description.iter("Unit"):
            base = element.find("BaseUnit")
            self.assertEqual({k: float(v) for k, v in base.items()}, SI[element.get("name")], element.get("name"))
        # What an importer finds before it tells anything: the scenario's own, 10 s of it in its steps.
        for name, start in (("current_x", -6), ("current_y", 0), ("wind_x", 0)):
            told = unit.variables[name].find("Real") if self.version == "2" else unit.variables[name]
            self.assertAlmostEqual(float(told.get("start")), start, delta=1e-9, msg=name)
        times = unit.description.find("DefaultExperiment")
        self.assertEqual([float(times.get(k)) for k in ("startTime", "stopTime", "stepSize")], [0, 10, 0.05])
        for name, kind in (("thruster_1_order", "continuous"), ("positioning", "discrete"),
                           ("line_1_release", "discrete"), ("ice_force_x", "continuous")):
            self.assertEqual(unit.variables[name].get("variability"), kind)
        structure = unit.description.find("ModelStructure")
        if self.version == "2":
            outputs = [i for i, v in enumerate(unit.variables.values(), start=1) if v.get("causality") == "output"]
            self.assertEqual([int(u.get("index")) for u in structure.find("Outputs")], outputs)
        else:
            outputs = [unit.reference[name] for name in unit.outputs()]
            self.assertEqual([int(u.get("valueReference")) for u in structure.findall("Output")], outputs)
            self.assertEqual(kinds["time"], "independent")
        self.assertEqual(unit.function("GetVersion")(), f"{self.version}.0".encode())
        told = unit.folder / "documentation"
        page = (told / "index.html").read_text()
        for word in *unit.variables, "Ship &amp; ", f"FMI {self.version}.0", "begins at the importer's start time":
            self.assertIn(word, page)
        self.assertIn("geos", (told / "externalDependencies.txt").read_text())
        self.assertEqual((told / "licenses/license.txt").read_bytes(), pathlib.Path("LICENSE").read_bytes())
        # The same scenario makes the same bytes.
        (self.folder / "again").mkdir()
        self.fram("fmu", self.scene, "-o", self.folder / "again/ship.fmu", "-q", "--fmi", f"{self.version}.0")
        self.assertEqual((self.folder / "again/ship.fmu").read_bytes(), (self.folder / "ship.fmu").read_bytes())

    def test_a_controller_outside_does_what_it_does_in_c(self):
        self.addCleanup(os.chdir, os.getcwd())
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
        names = self.unit.outputs()
        self.assertEqual(instance.get(*names), [world[name] for name in names])
        self.assertEqual(instance.get("lines_parted"), [1])
        self.assertNotEqual(instance.get("ice_force_averaged_x"), [0])
        self.assertFalse([text for status, _, text in instance.told if status >= ERROR])
        released = [text for _, _, text in instance.told if "let go" in text]
        self.assertEqual(len(released), 1)
        self.assertRegex(released[0], r"^t = 3\.00 s: .* \(importer's time 103\.00 s\)$")
        instance.free()
        world.free()

    def test_what_is_allowed_once_is_allowed_again(self):
        (self.folder / "towed.yaml").write_text(TOWED)
        # The default experiment ends with the step that ends nearest to the duration.
        duration, end = (20.02, 20) if self.version == "2" else (20.03, 20.05)
        self.fram("fmu", self.folder / "towed.yaml", "-o", self.folder / "towed.fmu", "-q", "--fmi", self.version,
                  "--set", f"run.duration={duration}")
        unit = Unit(self.folder / "towed.fmu", self.folder / "towed")
        self.assertEqual(float(unit.description.find("DefaultExperiment").get("stopTime")), end)
        one, dt = unit.instance().initialise(), unit.step_size
        # Inputs hold as they are read also where they equal what they were before the paths led elsewhere; what is not
        # told of another vessel stays.
        self.assertEqual(one.get("barge.tow_velocity_x", "barge.tow_velocity_y"), [0, 4])
        one.step(0, 3 * dt)
        self.assertEqual([round(v, 9) for v in one.get("barge.velocity_x", "barge.velocity_y")], [4, 0])
        self.assertEqual([round(v, 2) for v in one.get("tug.offset_x", "tug.offset_y")], [-5, -5])
        one.set("tug.set_point_x", 2)
        one.step(3 * dt, dt)
        self.assertEqual([round(v, 9) for v in one.get("barge.velocity_x", "barge.velocity_y")], [4, 0])
        self.assertEqual([round(v, 2) for v in one.get("tug.offset_x", "tug.offset_y")], [-2, 0])
        # Under a limit of 5 m/s 4 m/s may go from any axis to any other, whichever is told first.
        for i, told in enumerate(((0, 4.5), (4, 0), (0, 4), (-4, 0), (0, -4)), start=4):
            for name, value in zip(("tow_velocity_x", "tow_velocity_y"), told):
                one.set("barge." + name, value)
            one.step(i * dt, dt)
            self.assertEqual([round(v, 9) for v in one.get("barge.velocity_x", "barge.velocity_y")], list(told))
        # What steps miss of whole time steps adds up in the importer's time: here to more than the hundredth of one
        # by which that may be another than the unit's.
        now, long = 9 * dt + 0.0099 * dt, 200 * dt * (1 + 9e-7)
        one.step(now, long)
        one.step(now + long, dt)
        one.step(now + long + 1.01 * dt, dt, status=ERROR)
        self.assertIn("stands at", one.told[-1][2])
        one.free()

    def test_orders_hold_after_the_vessels_own_controller(self):
        """What an importer's inputs say is what the thrusters do, also where it says what it said before."""
        world, instance = World(BUILD / "libfram.so", self.scene), self.unit.instance().initialise()
        orders = {"thruster_1_order": 5e4, "thruster_1_order_angle": 0, "thruster_2_order": 0,
                  "thruster_2_order_angle": 0}
        instance.set("thruster_1_order", 5e4)
        dt = self.unit.step_size
        for i in range(24):
            if i in (8, 16):
                instance.set("positioning", int(i == 8))
                world["positioning"] = int(i == 8)
            if i in (0, 16):
                for name, order in orders.items():
                    world[name] = order
            instance.step(i * dt, dt)
            world.step()
        self.assertEqual(instance.get(*orders), list(orders.values()))
        names = self.unit.outputs()
        self.assertEqual(instance.get(*names), [world[name] for name in names])
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

    def refused(self, instance, call, word):
        """The call is an error that says the word; after it the instance can be read, but not stepped, until it goes
        back to a state."""
        state, before, count = instance.keep(), instance.get(*OUTPUTS), len(instance.told)
        call()
        self.assertEqual(len(instance.told), count + 1)
        self.assertEqual(instance.told[-1][:2], (ERROR, "logStatusError"))
        self.assertIn(word, instance.told[-1][2])
        self.assertEqual(instance.get(*OUTPUTS), before)
        instance.step(0, self.unit.step_size, status=ERROR)
        self.assertIn("after an error", instance.told[-1][2])
        instance.set("wind_x", 1, status=ERROR)
        instance.back(state)
        instance.forget(state)

    def test_what_cannot_be_is_refused(self):
        instance, dt = self.unit.instance().initialise(), self.unit.step_size
        nan = float("nan")
        for step in (0.5 * dt, 1.2 * dt, 0, -dt, nan, float("inf")):
            self.refused(instance, lambda size=step: instance.step(0, size, status=ERROR), "whole multiple")
        instance.step(0, 3 * dt * (1 + 1e-9))
        for now in (0, 2.9 * dt, nan, float("inf")):
            self.refused(instance, lambda time=now: instance.step(time, dt, status=ERROR), "stands at")
        self.refused(instance, lambda: instance.set("wind_y", nan, status=ERROR), "reference 1 is an input")
        self.refused(instance, lambda: instance.set("ice_force_x", 1, status=ERROR), "no input")
        for number in (len(self.unit.variables), 10**6, 2**32 - 1):
            self.unit.reference["nothing"] = number
            self.refused(instance, lambda: instance.set("nothing", 1, status=ERROR), f"{number} names no input")
            self.refused(instance, lambda: instance.get("nothing", status=ERROR), f"{number} names no variable")

        def wind():
            instance.set("wind_x", 1e9)
            instance.step(3 * dt, dt, status=ERROR)

        self.refused(instance, wind, "wind_x")
        good = instance.keep()
        data = instance.bytes_of(good)
        for bad in (b"no state at all", b"0" * 100000, data[:200], data[:-1], b"X" + data[1:], data[:24] + data[16:],
                    data[:-9] + bytes([data[-9] ^ 1]) + data[-8:]):
            self.refused(instance, lambda some=bad: instance.from_bytes(some, status=ERROR), "")
        instance.call("Reset")
        instance.initialise().step(0, dt)
        for name in (("GetReal", "SetReal") if self.version == "2" else ("GetFloat64", "SetFloat64")):
            more = () if self.version == "2" else (c.c_size_t(1),)
            none = () if self.version == "2" else (c.c_size_t(0),)
            self.refused(instance, lambda n=name, m=more: instance.call(
                n, None, c.c_size_t(1), (c.c_double * 1)(), *m, status=ERROR), "NULL")
            self.refused(instance, lambda n=name, m=more: instance.call(
                n, (c.c_uint * 1)(), c.c_size_t(1), None, *m, status=ERROR), "NULL")
            instance.call(name, None, c.c_size_t(0), None, *none)
        instance.free()
        self.assertFalse(self.unit.instance(token="{of another}").c)
        self.assertFalse(self.unit.instance(where="/no/such/folder").c)
        self.assertFalse(self.unit.instance(name=" ").c)

    def test_states_of_another_unit_and_damaged_ones_are_refused(self):
        """The same scenario and as many variables, but others; and a bit of what stands before the world."""
        units = []
        for number, (told, read) in enumerate((("wind_x", "position_x"), ("wind_y", "velocity_x"))):
            path = self.folder / f"other_{number}.fmu"
            self.fram("fmu", self.scene, "-o", path, "-q", "--fmi", self.version, "--in", told, "--out", read)
            units.append(Unit(path, self.folder / path.stem))
        one, two = (unit.instance().initialise() for unit in units)
        one.set("wind_x", 17)
        one.step(0, self.unit.step_size)
        data, before = one.bytes_of(one.keep()), two.get("wind_y", "velocity_x")
        two.from_bytes(data, status=ERROR)
        self.assertIn("none of this unit", two.told[-1][2])
        self.assertEqual(two.get("wind_y", "velocity_x"), before)
        for at in range(0, data.index(b"FRAMTAB\n"), 3):
            one.from_bytes(data[:at] + bytes([data[at] ^ 4]) + data[at + 1:], status=ERROR)
        one.back(one.from_bytes(data))
        one.free()
        two.free()

    def test_the_order_of_calls(self):
        one, dt = self.unit.instance(), self.unit.step_size
        fresh = one.keep()
        for name in "ExitInitializationMode", "Terminate":
            one.call(name, status=ERROR)
            self.assertIn("before it enters", one.told[-1][2])
            one.back(fresh)
        one.step(0, dt, status=ERROR)
        one.call("Reset")
        one.set("thruster_2_order", 3e4)
        self.assertEqual(one.get("thruster_2_order"), [3e4])
        one.initialise(start=5.0, stop=5 + 4 * dt)
        one.step(5 + one.get("ice_force_x")[0], dt)  # 0 before the first step
        for name in "EnterInitializationMode", "ExitInitializationMode":
            state = one.keep()
            arguments = () if self.version == "2" or name[1] == "x" else (False, c.c_double(0), c.c_double(0), False,
                                                                         c.c_double(0))
            one.call(name, *arguments, status=ERROR)
            one.back(state)
        state = one.keep()
        one.step(5 + dt, 4 * dt, status=ERROR)
        self.assertIn("past the stop time", one.told[-1][2])
        one.back(state)
        one.step(5 + dt, 3 * dt)
        one.call("Terminate")
        self.assertNotEqual(one.get("velocity_x"), [0])
        one.set("wind_x", 0, status=ERROR)
        one.step(5 + 4 * dt, dt, status=ERROR)
        one.call("Reset")
        self.assertEqual(one.get("thruster_2_order", "velocity_x"), [0, 0])
        one.initialise().step(0, dt)
        one.free()
        for start, stop in ((float("nan"), None), (0, float("nan")), (1, 1), (1, 0.5)):
            two = self.unit.instance()
            self.assertRaises(AssertionError, two.initialise, start, stop)
            self.assertIn("time is not", two.told[-1][2])
            two.free()

    def test_what_is_told_to_the_log(self):
        one = self.unit.instance()
        names = (c.c_char_p * 1)(b"logStatusWarning")
        one.call("SetDebugLogging", 1, c.c_size_t(1), names)
        one.call("SetDebugLogging", 0, c.c_size_t(0), None)
        one.told.clear()
        one.set("ice_force_x", 1, status=ERROR)
        self.assertEqual(len(one.told), 1 if self.version == "2" else 0)  # 2.0 switches debug messages alone
        one.call("Reset")
        for category in self.unit.description.iter("Category"):
            one.call("SetDebugLogging", 1, c.c_size_t(1), (c.c_char_p * 1)(category.get("name").encode()))
        one.set("ice_force_x", 1, status=ERROR)
        self.assertEqual(one.told[-1][:2], (ERROR, "logStatusError"))
        one.told.clear()
        for bad in ((c.c_char_p * 1)(b"no such"), (c.c_char_p * 1)(None), None, (c.c_char_p * 1)(b"100 %d %n")):
            one.call("SetDebugLogging", 1, c.c_size_t(1), bad, status=ERROR)
        self.assertEqual(len(one.told), 4)
        self.assertIn("100 %d %n", one.told[-1][2])  # no format of the importer's printf
        one.free()

    def test_a_handle_that_is_no_state_is_refused(self):
        one, two = self.unit.instance(name="one").initialise(), self.unit.instance(name="two").initialise()
        state, again = one.keep(), one.keep()
        gone = c.c_void_p(again.value)
        one.forget(again)
        one.forget(c.c_void_p())
        size, room = c.c_size_t(), (c.c_char * 8)()
        for instance, handle in ((two, state), (one, gone), (one, c.c_void_p(1)), (one, c.c_void_p())):
            instance.call("SetFMUState", handle, status=ERROR)
            instance.call("SerializedFMUStateSize", handle, c.byref(size), status=ERROR)
            instance.call("SerializeFMUState", handle, room, c.c_size_t(8), status=ERROR)
            if handle.value:
                instance.call("FreeFMUState", c.byref(handle), status=ERROR)
        for name, arguments in (("GetFMUState", (None,)), ("SerializedFMUStateSize", (state, None)),
                                ("SerializeFMUState", (state, None, c.c_size_t(8))),
                                ("DeserializeFMUState", (None, c.c_size_t(8), c.byref(state))),
                                ("DeserializeFMUState", (room, c.c_size_t(8), None))):
            one.call(name, *arguments, status=ERROR)
            self.assertIn("NULL", one.told[-1][2])
        one.call("SerializeFMUState", state, room, c.c_size_t(8), status=ERROR)
        self.assertIn("less room", one.told[-1][2])
        one.call("GetFMUState", c.byref(state))  # a state that is handed in is used again
        one.back(state)
        one.call("FreeFMUState", state)  # the state for its address, as fmusim 0.0.39 does
        self.assertIn("address", one.told[-1][2])
        one.call("SetFMUState", state, status=ERROR)
        two.keep()  # and never forgotten: goes with the instance
        one.free()
        two.free()

    def test_files_of_one_name(self):
        """Folders, a file that two vessels share, names that are the unit's own or not ASCII."""
        for name in "a", "b":
            (self.folder / name).mkdir(exist_ok=True)
        (self.folder / "a/wind.csv").write_text("time[s],x[m/s],y[m/s]\n0,5,0\n10,5,0\n")
        (self.folder / "b/wind.csv").write_text("time[s],x[m/s],y[m/s]\n0,0.2,0\n10,0.2,0\n")
        (self.folder / "variables.txt").write_text((self.folder / "ice of mine.txt").read_text())
        odd = self.folder / "b/Größe \\ one.csv"
        odd.write_text("depth[m],x[m/s],y[m/s]\n0,0.1,0\n5,0.05,0\n")
        scene = self.folder / "files.yaml"
        text = SCENE.replace("ice of mine.txt", "variables.txt").replace(
            "current_speed: 6, current_direction_deg: 180",
            f"wind_file: a/wind.csv, current_file: '{self.folder}/b/wind.csv', current_profile_file: '{odd}'")
        scene.write_text(text.replace("b/wind.csv", "a/wind.csv"))
        self.assertIn("3 files", self.fram("fmu", scene, "-o", self.folder / "files.fmu", "--force"))
        scene.write_text(text)
        told = self.fram("fmu", scene, "-o", self.folder / "files.fmu", "--fmi", self.version, "--force")
        self.assertIn("4 files", told)
        unit = Unit(self.folder / "files.fmu", self.folder / f"files {self.version}")
        found = {str(path.relative_to(unit.resources)) for path in unit.resources.rglob("*") if path.is_file()}
        self.assertEqual(len(found), 6)
        self.assertIn("wind.csv", found)
        self.assertNotIn(str(self.folder), (unit.resources / "scenario.yaml").read_text())
        one, world = unit.instance().initialise(), World(BUILD / "libfram.so", scene)
        for i in range(20):
            one.step(i * unit.step_size, unit.step_size)
            world.step()
        self.assertEqual(one.get(*unit.outputs()), [world[name] for name in unit.outputs()])
        one.free()
        world.free()

    def test_the_command(self):
        told = self.fram("fmu", self.scene, "-o", self.folder / "few.fmu", "--in", "thruster_*", "--out", "ice_force_?",
                         "--out", "yaw")
        self.assertIn("4 inputs, 4 outputs, 1 files", told)
        for words, word in ((("--in", "no_such"), "no_such"), (("--out", "x*y"), "--out"), ((), "NAME.fmu"),
                            (("--fmi", "4"), "--fmi"), (("--fmi", "3.1"), "--fmi"), (("--fmi", ""), "--fmi")):
            output = self.folder / ("few.fmu" if words else "1-few.fmu")
            self.assertIn(word, self.fram("fmu", self.scene, "-o", output, "--force", *words, code=2))
        self.assertIn("--output", self.fram("fmu", self.scene, code=2))
        self.assertIn("time_step", self.fram("fmu", self.scene, "-o", self.folder / "bad.fmu", "--set",
                                             "run.time_step=-1", code=2))
        self.assertFalse((self.folder / "bad.fmu").exists())


class Units2(Units, unittest.TestCase):
    version = "2"

    def test_where_resources_are(self):
        """Paths and URIs, with what URIs have to escape; signs that are no escape stand for themselves."""
        odd = self.folder / "50% +é %zz %4"
        shutil.copytree(self.unit.resources, odd)
        plain = str(odd)
        for where in (plain, plain + "/", odd.as_uri(), odd.as_uri() + "/", odd.as_uri().replace("file://", "file:"),
                      odd.as_uri().replace("file://", "file://localhost"), f"file://{plain}"):
            one = self.unit.instance(where=where)
            self.assertTrue(one.c, where)
            one.free()
        self.assertFalse(self.unit.instance(where="file://").c)
        self.assertFalse(self.unit.instance(where="file:///" + "a" * 5000).c)


class Units3(Units, unittest.TestCase):
    version = "3"

    def test_time_is_the_importers(self):
        one, dt = self.unit.instance().initialise(start=-7.0), self.unit.step_size
        self.assertEqual(one.get("time"), [-7])
        self.assertEqual([one.step(-7, 4 * dt)], one.get("time"))
        self.assertAlmostEqual(one.get("time")[0], -7 + 4 * dt, delta=1e-12)
        one.set("time", 0, status=ERROR)
        one.free()

    def test_the_importer_looks_on_and_ends_steps_early(self):
        dt, seen = self.unit.step_size, []

        def look(time, may_return):
            seen.append((time, may_return, *one.get("offset_x", "time")))
            return answers.pop(0) if answers else None

        one = self.unit.instance(look=look, look_at=("offset_x", "time")).initialise()
        two = self.unit.instance().initialise()
        answers = []
        self.assertAlmostEqual(one.step(0, 4 * dt), 4 * dt, delta=1e-12)
        self.assertFalse(one.early)
        for i, (time, may_return, offset, own) in enumerate(seen):
            two.step(i * dt, dt)
            self.assertEqual([offset], two.get("offset_x"))
            self.assertEqual((time, may_return), (own, i < 3))
        self.assertEqual(len(seen), 4)
        for answer, steps in ((0, 1), (float("nan"), 1), (6.9 * dt, 2), (8 * dt, 4), (1e9, 4)):
            state, answers = one.keep(), [answer]
            self.assertAlmostEqual(one.step(4 * dt, 4 * dt), (4 + steps) * dt, delta=1e-12)
            self.assertEqual(one.early, steps < 4)
            one.back(state)
            one.forget(state)
        one.free()
        # Who does not allow it is not asked; the rest of the unit is not read, stepped or set meanwhile.
        seen.clear()
        one = self.unit.instance(look=look, look_at=("offset_x", "time"), early=False).initialise()
        answers = [0, 0]
        one.step(0, 3 * dt)
        self.assertEqual((one.early, [may for _, may, _, _ in seen]), (False, [False] * 3))
        one.free()
        for bad in (lambda: one.get("yaw", status=ERROR), lambda: one.set("wind_x", 1, status=ERROR),
                    lambda: one.step(0, dt, status=ERROR), lambda: one.call("Reset", status=ERROR),
                    lambda: one.call("GetFMUState", c.byref(c.c_void_p()), status=ERROR), lambda: one.free()):
            one = self.unit.instance(look=lambda _time, _may, call=bad: call() and None, look_at=("offset_x",))
            one.initialise()
            one.step(0, 3 * dt, status=ERROR)
            self.assertIn("given up", one.told[-1][2])
            one.free()
        for names in (("wind_x",), ("nothing",)):
            self.unit.reference["nothing"] = 10**6
            self.assertFalse(self.unit.instance(look=look, look_at=names).c)

    def test_what_3_has_and_this_unit_has_not(self):
        one = self.unit.instance().initialise()
        reference, size = (c.c_uint * 1)(0), c.c_size_t(1)
        for kind in "Float32 Int8 UInt8 Int16 UInt16 Int32 UInt32 Int64 UInt64 Boolean String".split():
            for way in "Get", "Set":
                one.call(way + kind, None, c.c_size_t(0), None, c.c_size_t(0))
                state = one.keep()
                one.call(way + kind, reference, size, (c.c_double * 1)(), size, status=ERROR)
                self.assertIn(f"fmi3{way}{kind}: all variables", one.told[-1][2])
                one.back(state)
        state = one.keep()
        for name in ("EnterEventMode EnterStepMode EnterConfigurationMode ExitConfigurationMode EvaluateDiscreteStates "
                     "EnterContinuousTimeMode").split():
            one.call(name, status=ERROR)
            self.assertIn(f"fmi3{name}: this unit does not offer that", one.told[-1][2])
        nothing = (None,) * 7
        for name in ("UpdateDiscreteStates GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction "
                     "SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction ActivateModelPartition "
                     "GetDirectionalDerivative GetAdjointDerivative GetOutputDerivatives GetVariableDependencies "
                     "GetNumberOfVariableDependencies CompletedIntegratorStep SetTime SetContinuousStates "
                     "GetContinuousStateDerivatives GetEventIndicators GetContinuousStates "
                     "GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates").split():
            one.call(name, *nothing, status=ERROR)
        one.back(state)
        for references, values in ((1, 2), (2, 1), (1, 0)):
            for name in "GetFloat64", "SetFloat64":
                one.call(name, (c.c_uint * 2)(0, 1), c.c_size_t(references), (c.c_double * 2)(), c.c_size_t(values),
                         status=ERROR)
                self.assertIn("as many values", one.told[-1][2])
                one.back(state)
        room = [c.byref(c.c_bool()), c.byref(c.c_bool()), c.byref(c.c_bool()), c.byref(c.c_double())]
        for missing in range(4):
            where = [None if i == missing else pointer for i, pointer in enumerate(room)]
            one.call("DoStep", c.c_double(0), c.c_double(self.unit.step_size), True, *where, status=ERROR)
            one.back(state)
        one.free()
        self.assertFalse(self.unit.instance(events=True).c)
        binary = self.unit.binary
        for name in "ModelExchange", "ScheduledExecution":
            function = getattr(binary, "fmi3Instantiate" + name)
            function.restype = c.c_void_p
            self.assertFalse(function(b"one", self.unit.token.encode(), b"/", False, True, *nothing))
        binary.fmi3FreeInstance(None)
        self.assertEqual(binary.fmi3DoStep(None, c.c_double(0), c.c_double(1), True, *nothing[:4]), ERROR)
        silent = self.unit.instance(logging=False)
        silent.set("ice_force_x", 1, status=ERROR)
        self.assertEqual(silent.told, [])
        silent.free()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
