#!/usr/bin/env python3
"""The Python package in the hands of a stranger: worlds closed or stepped where they must not be, copies and pickles,
values that cannot be, damaged folders of runs, orders of calls of the environment."""

import copy
import gc
import json
import os
import pathlib
import pickle
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

import package  # noqa: F401  first: it finds the package `fram`
import numpy as np

import fram
from fram import _library
from scenes import FREE, TOWED

PACKED = FREE.replace(
    "{concentration: 0.3, mean_floe_area: 64,",
    "{source: packed, concentration: 0.85, populations: [{size: power, diameter_min: 6, diameter_max: 20}],"
).replace("x_max: 64", "x_max: 2000")


def towed(**more):
    return fram.Scenario.from_text(TOWED, **more)


def in_threads(count, work):
    threads = [threading.Thread(target=work) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


class ClosesWhatIsCopied:
    """The library; while it copies the world, another thread closes that."""

    def __init__(self, world):
        self.world, self.refused = world, False

    def __getattr__(self, name):
        return getattr(_library.lib, name)

    def fram_world_copy(self, *arguments):
        try:
            self.world.close()
        except fram.UsageError:
            self.refused = True
        return _library.lib.fram_world_copy(*arguments) if self.refused else 0


class Counts:
    """The library; what it makes and what is freed again is counted."""

    MADE = ("fram_scenario_parse", "fram_world_create", "fram_world_copy", "fram_world_save_memory")
    FREED = ("fram_scenario_destroy", "fram_world_destroy", "fram_data_free")

    def __init__(self):
        self.there, self.made = 0, 0

    def __getattr__(self, name):
        function = getattr(_library.lib, name)

        def call(*arguments):
            answer = function(*arguments)
            self.there += (name in self.MADE) - (name in self.FREED)
            self.made += name in self.MADE
            return answer

        return call if name in self.MADE + self.FREED else function


class Worlds(unittest.TestCase):
    def test_a_callback_may_close_step_and_load(self):
        world = towed().world()
        with self.assertRaisesRegex(fram.UsageError, "closed"):
            world.step(3, callback=lambda w: w.close())
        gc.collect()
        world = towed().world()
        world.step(3, callback=lambda w: w.step())
        self.assertEqual(world.steps, 6)
        state = world.to_bytes()
        world.step(2, callback=lambda w: w.from_bytes(state))
        self.assertEqual(world.steps, 6)
        with self.assertRaises(RuntimeError):
            world.step(2, callback=lambda w: (_ for _ in ()).throw(RuntimeError("mine")))
        self.assertEqual(world.steps, 7)

    def test_threads_that_use_one_world_are_refused_or_wait(self):
        world = towed().world()
        done, others = [], []

        def work():
            for _ in range(40):
                try:
                    world.step()
                    done.append(1)
                except fram.UsageError as error:
                    others.append(error.message)

        in_threads(3, work)
        self.assertEqual((world.steps, len(done) + len(others)), (len(done), 120))
        self.assertTrue(all("another call on it has not returned" in message for message in others))
        world._calls.append(None)  # as while another thread steps it
        with self.assertRaisesRegex(fram.UsageError, "has not returned"):
            world.close()
        world._calls.pop()
        world.close()

    def test_what_is_made_as_a_callback_raises_is_freed(self):
        counts = Counts()
        with mock.patch("fram.world.lib", counts), mock.patch("fram.scenario.lib", counts):
            context = fram.Context()
            scenario = towed(context=context)
            world = scenario.world()
            for ask in (lambda: towed(context=context), scenario.world, world.copy, world.to_bytes):
                context._raised.append(RuntimeError("mine"))
                with self.assertRaisesRegex(RuntimeError, "mine"):
                    ask()
            gc.collect()
            self.assertEqual((counts.made, counts.there), (6, 2))

    def test_a_world_that_is_copied_is_not_closed(self):
        world = towed().world()
        library = ClosesWhatIsCopied(world)
        with mock.patch("fram.world.lib", library):
            world.copy()
        self.assertTrue(library.refused)

    def test_what_is_read_within_a_step(self):
        """Channels are no numbers, arrays and states are refused: not a world without bodies."""
        seen, refused = [], []

        def look(_level, _text):
            seen.append((world["time"], world.values()))
            self.assertIn("fram.World at t = ", repr(world))
            for ask in (world.bodies, world.outlines, world.shapes, world.contacts, world.fractures, world.to_bytes,
                        world.copy, world.close, lambda: world.hash, lambda: world.vessel):
                with self.assertRaises(fram.UsageError) as caught:
                    ask()
                refused.append(caught.exception.key)

        context = fram.Context(log=look)
        scenario = fram.Scenario.from_text(FREE.replace("x: 18", "x: 18, failure_time: 0.1"), context=context)
        world = scenario.world()
        world.step(3)  # it tells that the thruster fails
        self.assertEqual(len(seen), 1)
        for told, values in seen:
            self.assertTrue(np.isnan(told))
            self.assertTrue(np.all(np.isnan(values)))
        self.assertEqual(refused, ["world"] * 10)
        self.assertEqual(world._readers, [])
        self.assertGreater(len(world.shapes()), len(world.outlines()))

    def test_worlds_of_one_context_in_threads(self):
        alone = fram.Scenario.from_text(FREE).world()
        alone.step(30)
        scenario = fram.Scenario.from_text(FREE, context=fram.Context(threads=2))
        hashes = []

        def work():
            world = scenario.world()
            world.step(30)
            hashes.append(world.hash)

        in_threads(4, work)
        self.assertEqual(hashes, [alone.hash] * 4)

    def test_threads_that_begin_together_have_one_context(self):
        """In a process that has none yet."""
        text = ("import fram, pickle, sys, threading\n"
                "sys.setswitchinterval(1e-6)\n"
                "together, found = threading.Barrier(8), []\n"
                "def begin():\n"
                "    together.wait()\n"
                "    found.append(fram.Scenario.from_text(sys.argv[1]))\n"
                "threads = [threading.Thread(target=begin) for _ in range(8)]\n"
                "for thread in threads: thread.start()\n"
                "for thread in threads: thread.join()\n"
                "assert len({pickle.loads(pickle.dumps(scenario)).hash for scenario in found}) == 1\n")
        done = subprocess.run([sys.executable, "-c", text, TOWED], capture_output=True, text=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(pathlib.Path(fram.__file__).parents[1])})
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_what_threads_make_and_leave_is_destroyed_once(self):
        scenario = fram.Scenario.from_text(FREE, overrides={"ice.source": "none"})
        gc.collect()  # of what other tests left
        address, before = _library._address(scenario._pointer), len(_library._made)

        def work():
            for _ in range(15):
                with scenario.world() as world:
                    world.copy()

        interval = sys.getswitchinterval()
        self.addCleanup(sys.setswitchinterval, interval)
        sys.setswitchinterval(1e-6)
        in_threads(6, work)
        gc.collect()
        self.assertEqual((_library._users[address], len(_library._made)), ([], before))

    def test_interrupts_are_seen_while_the_library_works(self):
        """Ctrl-C ends what would take minutes."""
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        with tempfile.TemporaryDirectory() as folder:

            def interrupt_the_run():
                while not (pathlib.Path(folder) / "series.csv").exists():
                    time.sleep(0.01)
                os.kill(os.getpid(), signal.SIGALRM)

            other = threading.Thread(target=interrupt_the_run)
            other.start()
            with self.assertRaises(KeyboardInterrupt):
                fram.Scenario.from_text(FREE, overrides={"run.duration": 50000}).run(folder)
            other.join()
            self.assertEqual(fram.open(folder).info["status"], "interrupted")
        packed = fram.Scenario.from_text(PACKED)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaises(KeyboardInterrupt):
            packed.world()
        self.assertGreater(len(packed.replaced({"domain.x_max": 64, "ice.concentration": 0.3}).world().bodies()), 10)

    def test_copies_and_pickles(self):
        world = towed().world()
        world.step(5)
        before = world.hash
        for other in (copy.copy(world), copy.deepcopy(world), pickle.loads(pickle.dumps(world))):
            self.assertEqual(other.hash, before)
            other.step()
            self.assertNotEqual(other.hash, before)
            other.close()
        self.assertEqual(world.hash, before)
        scenario = world.scenario
        self.assertIs(copy.deepcopy(scenario), scenario)
        self.assertIs(copy.copy(scenario._context), copy.deepcopy(scenario._context))
        self.assertEqual(pickle.loads(pickle.dumps(scenario.replaced({"run.seed": 9}))).hash,
                         scenario.replaced({"run.seed": 9}).hash)
        for other in (fram.Context(), towed(context=fram.Context())):
            with self.assertRaisesRegex(TypeError, "context"):
                pickle.dumps(other)
        with self.assertRaises(fram.InputError) as caught:
            fram.Scenario.from_text("run:\n  sed: 3\n")
        there = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((there.key, there.line, str(there)), ("run.sed", 2, str(caught.exception)))

    def test_values_that_cannot_be(self):
        world = towed().world()
        for force in ((1, 2), (1, 2, 3, 4), 5):
            with self.assertRaisesRegex(fram.InputError, "three numbers") as caught:
                world.apply_wrench(world.vessel, force)
            self.assertEqual(caught.exception.key, "force")
        for moment in ((1,), None, "123", ("a", 2, 3), (1j, 2, 3), (2**1100, 0, 0), (float("nan"), 0, 0)):
            with self.assertRaises(fram.InputError) as caught:
                world.apply_wrench(world.vessel, (0, 0, 0), moment=moment)
            self.assertEqual(caught.exception.key, "moment")
        for body in (None, 1, (1,), (1, 2, 3), ("a", 1), (1.5, 1), (0, -1), (-1, 0), (2**40, 1), (0, 2**32)):
            with self.assertRaises(fram.UsageError) as caught:
                world.apply_wrench(body, (0, 0, 0))
            self.assertEqual(caught.exception.key, "body")
        for places in (np.zeros((2, 2)), np.zeros((3, 2)), np.zeros(6)):  # x, y and heading are the columns
            with self.assertRaisesRegex(fram.InputError, r"shape \("):
                world.set_path([1, 2], places)
        for until in (0, -1, float("nan"), float("inf")):
            with self.assertRaises(fram.UsageError) as caught:
                world.scenario.run("/no/such/folder", until=until)
            self.assertEqual(caught.exception.key, "until")
        with self.assertRaisesRegex(fram.InputError, "empty text"):
            world.save("")
        with self.assertRaisesRegex(fram.InputError, "another scenario, or another Fram saved it"):
            world.from_bytes(towed(overrides="run.seed=8").world().to_bytes())
        state = world.to_bytes()
        for form in (bytearray(state), memoryview(state), np.frombuffer(state, np.uint8).reshape(1, -1)):
            world.from_bytes(form)
        self.assertEqual(towed(overrides="run.seed=8").hash, towed(overrides={"run.seed": np.int64(8)}).hash)
        self.assertEqual(towed(overrides={"ice.breakable": np.bool_(True)}).hash,
                         towed(overrides={"ice.breakable": True}).hash)
        for seed in (8.0, np.float64(8), np.float32(8), np.uint8(8), np.array(8.0)):
            self.assertEqual(towed(overrides={"run.seed": seed}).hash, towed(overrides="run.seed=8").hash)
        for wrong in (5, [8.0], [("run.seed", 8)], np.ones(2), object(), np.array(8.0), dict,
                      {"run.seed": np.ones(1)}, {"run.seed": np.ndarray}):
            with self.assertRaisesRegex(fram.UsageError, "a mapping of keys to values, or texts") as caught:
                towed(overrides=wrong)
            self.assertEqual(caught.exception.key, "overrides")

    @unittest.skipIf(fram.runs.pandas is None, "without pandas")
    def test_a_row_of_pandas_is_a_mapping(self):
        table = fram.runs.pandas.DataFrame({"run.seed": [8, 9], "vessel.speed": [2.5, 3]})
        with self.assertRaisesRegex(fram.UsageError, "found Series of 2 values for run.seed"):
            towed(overrides=table)
        self.assertEqual(towed(overrides=table.iloc[1]).hash, towed(overrides=["run.seed=9", "vessel.speed=3"]).hash)

    def test_a_step_that_cannot_be_recorded_is_made(self):
        world = towed().world()
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, before)
        with tempfile.TemporaryDirectory() as folder:
            recording = world.record(pathlib.Path(folder) / "run")
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, before[1]))
            with self.assertRaisesRegex(fram.FileError, "cannot write"):
                world.step(400)
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
            self.assertEqual(fram.open(recording.folder).info["status"], "failed")
        self.assertFalse(world.recorded)
        steps, alone = world.steps, towed().world()
        world.step()
        alone.step(steps + 1)
        self.assertEqual(world.hash, alone.hash)

    def test_a_recording_that_is_not_handed_out_ends(self):
        def fail(*_told):
            raise RuntimeError("mine")

        with tempfile.TemporaryDirectory() as folder:
            page, world = pathlib.Path(folder) / "page.html", towed().world()
            page.write_text("<!--BESIDE--><!--RECORD-->")
            with self.assertRaises(fram.UsageError) as caught:
                world.record(pathlib.Path(folder) / "unseen", live=fail)
            self.assertEqual((caught.exception.key, world.recorded), ("live", False))
            with self.assertRaisesRegex(RuntimeError, "mine"):
                world.record(pathlib.Path(folder) / "run", live_page=page, live=fail)
            self.assertFalse(world.recorded)
            with world.record(pathlib.Path(folder) / "run", force=True) as recording:
                with self.assertRaisesRegex(fram.UsageError, "recorded"):
                    world.record(pathlib.Path(folder) / "other")
                self.assertTrue(world.recorded)
                recording.checkpoint()

    def test_closing_tells_what_a_recording_could_not_write(self):
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, before)
        with tempfile.TemporaryDirectory() as folder:
            for held in (False, True):
                world = towed().world()
                view = world.view().mass if held else None
                recording = world.record(pathlib.Path(folder) / str(held))
                world.step(3)
                resource.setrlimit(resource.RLIMIT_FSIZE, (2000, before[1]))
                state = str(pathlib.Path(folder) / "state.fram")
                with self.assertRaisesRegex(fram.FileError, "cannot write") as caught:
                    world.save(state)
                self.assertEqual(caught.exception.file, state)
                with self.assertRaisesRegex(fram.FileError, "cannot write"):
                    world.close()
                resource.setrlimit(resource.RLIMIT_FSIZE, before)
                self.assertEqual((fram.open(recording.folder).info["status"], repr(world)),
                                 ("failed", "<fram.World closed>"))
                del view

            environment = fram.StationKeeping(fram.Scenario.from_text(FREE))
            environment.reset()
            environment.world.record(pathlib.Path(folder) / "environment")
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, before[1]))
            with self.assertRaisesRegex(fram.FileError, "cannot write"):
                environment.close()
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
            self.assertEqual((environment.world, repr(environment._first)), (None, "<fram.World closed>"))

            def fail(_level, _text):
                raise RuntimeError("mine")

            scenario = towed(context=fram.Context(log=fail))
            with self.assertRaisesRegex(RuntimeError, "mine"), scenario.world() as world:
                world.record(pathlib.Path(folder) / "log")
                world.step()  # it meets no ice, which the log is told at the end
            scenario.world().close()

    def test_a_recorded_world_does_not_go_back(self):
        """That is told before anything is tried; what ends a block is told as it is."""
        world = towed().world()
        with tempfile.TemporaryDirectory() as folder:
            with world.record(pathlib.Path(folder) / "run"):
                world.step()
                with self.assertRaisesRegex(fram.UsageError, "world: it is recorded"), world.snapshot():
                    world.step()
            self.assertEqual(fram.open(pathlib.Path(folder) / "run").info["steps"], 1)
            with self.assertRaisesRegex(KeyError, "mine"), world.snapshot():
                world.record(pathlib.Path(folder) / "within")
                raise KeyError("mine")
            world.close()
        other = towed().world()
        with self.assertRaisesRegex(fram.UsageError, "closed"), other.snapshot():
            other.close()

    def test_a_world_closed_under_its_recording_or_view(self):
        world = towed().world()
        with tempfile.TemporaryDirectory() as folder:
            with world.record(pathlib.Path(folder) / "run"):
                world.step()
                view = world.view()
                world.close()
            self.assertEqual(fram.open(pathlib.Path(folder) / "run").info["status"], "stopped")
        for ask in (lambda: view.mass, lambda: view.lives, world.shapes, world.view):
            with self.assertRaisesRegex(fram.UsageError, "closed"):
                ask()


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.good, cls.bad = pathlib.Path(folder.name) / "good", pathlib.Path(folder.name) / "bad"
        towed().run(cls.good)

    def broken(self, name, content):
        """The run with another file in it."""
        shutil.rmtree(self.bad, ignore_errors=True)
        shutil.copytree(self.good, self.bad)
        (self.bad / name).write_bytes(content)
        return fram.open(self.bad)

    def assert_refused(self, ask, name, line, key=""):
        with self.assertRaises(fram.InputError) as caught:
            ask()
        error = caught.exception
        self.assertEqual((pathlib.Path(error.file).name, error.line, error.key), (name, line, key), error)

    def test_run_json(self):
        for content, line in ((b"", 1), (b'{\n"a": 1,\n', 3), (b"[1, 2]", 1), (bytes(range(256)), 1), (b"\xff\xfe", 1)):
            run = self.broken("run.json", content)
            self.assert_refused(lambda: run.info, "run.json", line)
            self.assert_refused(lambda: run.hash, "run.json", line)
            self.assertIn("unreadable", repr(run))
        run = self.broken("run.json", b"{}")
        self.assert_refused(lambda: run.hash, "run.json", 0, "state_hash")
        self.assertIn("None", repr(run))
        # That of a run which goes on is of its beginning: how far it has come its series tell, in whole rows.
        run = self.broken("run.json", b'{"status": "running", "time_s": 0.0, "state_hash": "0123"}')
        time = run.columns()["time"][-1]
        with (self.bad / "series.csv").open("a") as series:
            series.write("99")
        for text in (repr(run), run._repr_html_()):
            self.assertTrue("running" in text and f"{time}" in text and "0123" not in text, text)
        self.assert_refused(lambda: run.hash, "run.json", 0, "state_hash")
        (self.bad / "series.csv").unlink()
        self.assertIn("running at t = 0.0 s", repr(run))
        self.assertIn("&lt;b&gt;&amp;", self.broken("run.json", b'{"title": "<b>&"}')._repr_html_())
        run = self.broken("station.json", b"{")
        self.assert_refused(lambda: run.station, "station.json", 1)
        self.assert_refused(lambda: run.events, "station.json", 1)
        events = b'{"events": [{"kind": "b", "time_s": null}, {"kind": "a", "time_s": 1}]}'
        self.assertEqual([event["kind"] for event in self.broken("station.json", events).events], ["a", "b"])

    def test_series(self):
        for content, line, key in ((b"", 1, ""), (b"time[s],b[m]\n1,x\n2,3\n", 2, ""),
                                   (b"time[s],b[m]\n1\n2,3\n", 2, ""),
                                   (b"time[s],b[m]\n1,2,3\n2,3\n", 2, ""), (b"time[s],b[m]\n\xff,2\n2,3\n", 2, ""),
                                   (b"time[s],b[m],b[m]\n1,2,3\n", 1, "b"), (b"a[s],b[m]\n1,2\n", 1, "time")):
            run = self.broken("series.csv", content)
            self.assert_refused(lambda: run.series, "series.csv", line, key)
        for begun in (b"2", b"2,", b"2,1", b"2,1.5e-0"):  # of 2,1.5e-07: it is still being written
            run = self.broken("series.csv", b"time[s],b[m]\n1,2\n" + begun)
            np.testing.assert_array_equal(run.columns()["b"], [2])
        self.assert_refused(self.broken("series.csv", b"time[s],b[m]\n1,2\n2\n").columns, "series.csv", 3)

    def test_columns_that_nobody_asks_for_are_not_kept(self):
        path = self.broken("series.csv", b"time[s],b[m],c[N]\n1,2,5\n2,3,6\n").folder / "series.csv"
        columns, units = fram.runs._read_table(path, ["time"], ["c", "time", "none"])
        self.assertEqual((list(columns), list(units)), (["time", "c"], ["time", "b", "c"]))
        self.assertEqual((list(columns["c"]), columns["c"].base.nbytes), ([5, 6], 32))
        path.write_bytes(b"time[s],b[m],c[N]\n1,2,5\n2,x,6\n")
        self.assert_refused(lambda: fram.runs._read_table(path, [], ["c"]), "series.csv", 3)

    @unittest.skipIf(fram.runs.pandas is None, "without pandas")
    def test_the_time_of_a_series_is_a_column_and_the_index(self):
        series = self.broken("series.csv", b"time[s],b[m]\n1,2\n2,3\n3,1\n").series
        self.assertEqual(list(series.loc[2:3]["b"]), [3, 1])
        self.assertEqual(list(series.merge(series, on="time").columns), ["time", "b_x", "b_y"])
        self.assertEqual(list(fram.runs.pandas.merge_asof(series, series, on="time")["b_y"]), [2, 3, 1])
        self.assertEqual(list(series.sort_values("time", ascending=False)["b"]), [1, 3, 2])
        self.assertEqual(list(series.groupby("time")["b"].sum()), [2, 3, 1])
        self.assertEqual(list(series.reset_index().columns), ["index", "time", "b"])
        self.assertEqual(series.to_csv(index=False).splitlines()[:2], ["time,b", "1.0,2.0"])

    def test_what_a_run_is_made_of_is_not_written_over(self):
        run = self.broken("station.json", b"{}")
        os.symlink("series.csv", self.bad / "link.html")
        for name in ("series.csv", "record.fram", "run.json", "scenario.yaml", "fractures.csv", "link.html"):
            before = (self.bad / name).read_bytes()
            with self.assertRaisesRegex(fram.UsageError, "output: .*made of"):
                run.report(self.bad / name)
            self.assertEqual((self.bad / name).read_bytes(), before)
        self.assertTrue(pathlib.Path(run.report(self.bad / "mine.html")).is_file())

    def test_recordings_shorter_than_an_interval(self):
        world = towed().world()
        world.step()
        with world.record(self.bad.parent / "short"):
            world.step(2)  # of 0.02 s: the next frame would be at 0.1 s
        with self.assertRaisesRegex(fram.InputError, "no frame: .*output.frame_interval.*record for longer"):
            fram.open(self.bad.parent / "short").floes(0.05)

    def test_files_that_somebody_sent(self):
        """Nothing waits, grows without an end or leaves by an error that is not of Fram."""
        deep, long_number = b"[" * 200000, b'{"a": ' + b"1" * 10000 + b"}"
        for content in (deep, b'{"a":' * 100000, long_number):
            run = self.broken("run.json", content)
            with self.assertRaises(fram.InputError):
                run.info  # noqa: B018
        run = self.broken("series.csv", b"time[s],b_c[m]\n1,1_0\n2,3\n")
        self.assert_refused(lambda: run.columns(), "series.csv", 2)
        with self.assertRaisesRegex(fram.InputError, "lines of less than"):
            self.broken("series.csv", b"time[s]\n" + b"1" * (1 << 21) + b"\n").columns()
        name = self.bad / "series.csv"
        for make, found in ((lambda: os.mkfifo(name), "a pipe"), (lambda: name.symlink_to("/dev/zero"), "a device"),
                            (name.mkdir, "a folder")):
            name.unlink()
            make()
            for ask in (run.columns, lambda: run.series):
                with self.assertRaisesRegex(fram.InputError, found):
                    ask()
        name.rmdir()
        for kind in ("run.json", "scenario.yaml"):
            run = self.broken(kind, b"{}")
            with open(self.bad / kind, "wb") as file:
                file.truncate(1 << 40)
            with self.assertRaisesRegex(fram.InputError, "at most"):
                run.info if kind == "run.json" else run.scenario_text  # noqa: B018

    def test_files_that_are_gone(self):
        run = self.broken("series.csv", b"")
        (self.bad / "series.csv").unlink()
        (self.bad / "scenario.yaml").unlink()
        for ask in (lambda: run.series, lambda: run.scenario_text, lambda: run.columns("nothing")):
            with self.assertRaises(fram.FileError):
                ask()
        self.assertEqual(pickle.loads(pickle.dumps(run)).folder, run.folder)
        self.assertEqual(json.loads((self.bad / "run.json").read_text())["state_hash"], run.hash)


class Environment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = fram.Scenario.from_text(FREE)

    def test_a_seed_that_is_refused_changes_nothing(self):
        with fram.StationKeeping(self.scenario, interval=0.1) as environment:
            self.assertIs(environment.unwrapped, environment)
            _, before = environment.reset(seed=5)
            for seed in (-3, 2**70, 1.5):
                with self.assertRaises(fram.InputError):
                    environment.reset(seed=seed)
            environment.step(environment.action_space.sample())
            self.assertEqual(environment.reset()[1], before)
            self.assertEqual(environment.reset(seed=np.int64(5))[1], before)
        with self.assertRaises(fram.UsageError):
            environment.reset()

    def test_what_it_is_made_of(self):
        class Rewards(list):
            """Empty, and so false in truth, but callable."""

            def __call__(self, world):
                return 42.0

        with fram.StationKeeping(self.scenario, interval=0.1, reward=Rewards()) as environment:
            environment.reset()
            self.assertEqual(environment.step(environment.action_space.sample())[1], 42.0)
        one = fram.StationKeeping(self.scenario, actions="thruster_1_order", observations="offset_x", interval=0.12)
        self.assertEqual((one.actions, one.observations), (("thruster_1_order",), ("offset_x",)))
        self.assertAlmostEqual(one.interval, 0.1)
        for wrong in ({"actions": ["wind_x"]}, {"actions": ["time"]}, {"observations": ["nothing"]},
                      {"actions": ["thruster_2_order", "thruster_2_order"]}):
            with self.assertRaises(fram.InputError) as caught:
                fram.StationKeeping(self.scenario, **wrong)
            self.assertEqual(caught.exception.key, *(names[-1] for names in wrong.values()))
        for interval in (0, -1, float("nan"), float("inf")):
            with self.assertRaises(fram.InputError) as caught:
                fram.StationKeeping(self.scenario, interval=interval)
            self.assertEqual(caught.exception.key, "interval")
        for key in ("horizon", "offset_limit"):
            for limit in (-1, float("nan")):
                with self.assertRaises(fram.InputError) as caught:
                    fram.StationKeeping(self.scenario, **{key: limit})
                self.assertEqual(caught.exception.key, key)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
