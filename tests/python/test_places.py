#!/usr/bin/env python3
"""What was named by a relative path, and what a process began, is the same afterwards: when the program changes its
working folder, and when it forks."""

import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import unittest

import package  # noqa: F401  first: it finds the package `fram`
from test_misuse import FREE, TOWED
from test_same_run import without_wall_times

import fram

def box(length, beam, draught, freeboard, at=(0,)):
    """A box as STL text, or one at each of these y."""
    x, y, corners = length / 2, beam / 2, []
    for middle in at:
        for z in (-draught, freeboard):
            corners += [(-x, middle - y, z), (x, middle - y, z), (x, middle + y, z), (-x, middle + y, z)]
    faces = ((0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7),
             (2, 7, 6), (3, 0, 4), (3, 4, 7))
    facets = ("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % corners[first + i] for i in face) +
              "endloop\nendfacet\n" for first in range(0, len(corners), 8) for face in faces)
    return "solid box\n" + "".join(facets) + "endsolid box\n"


class InTwoFolders(unittest.TestCase):
    """Each test begins in a folder `here`, beside which there is one `there`."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.here, self.there = (pathlib.Path(folder.name).resolve() / name for name in ("here", "there"))
        self.here.mkdir()
        self.there.mkdir()
        os.chdir(self.here)

    def assert_same_run(self, one, other):
        names = sorted(path.name for path in one.iterdir())
        self.assertEqual(names, sorted(path.name for path in other.iterdir()))
        for name in names:
            self.assertEqual(without_wall_times(one / name), without_wall_times(other / name), name)


class WorkingFolder(InTwoFolders):
    def test_a_recording_goes_on_where_it_began(self):
        world = fram.Scenario.from_text(TOWED).world()
        with world.record("run") as recording:
            world.step(5)
            os.chdir(self.there)
            world.step(10)
            recording.checkpoint()
            world.step(5)
        self.assertEqual(list(self.there.iterdir()), [])
        self.assertEqual(fram.open(self.here / "run").info["status"], "finished")

    def test_a_run_stays_where_it_is(self):
        run = fram.Scenario.from_text(TOWED).run("run", progress=lambda *_: os.chdir(self.there))
        os.chdir(self.here)
        again = fram.open("run")
        kept = pickle.dumps(again)
        os.chdir(self.there)
        for one in (run, again, pickle.loads(kept)):
            self.assertEqual((one.info["status"], one.folder), ("finished", self.here / "run"))
        self.assertEqual(list(self.there.iterdir()), [])

    def test_a_scenario_keeps_its_files(self):
        (self.here / "ship.stl").write_text(box(48, 4, 4, 2, (-6, 6)))
        (self.there / "ship.stl").write_text(box(20, 6, 2, 1))  # another one of the same name
        text = TOWED.replace("{length: 48, beam: 12, draught: 4, freeboard: 2}", "{form: file, file: ship.stl}")
        (self.here / "scene.yaml").write_text(text)
        scenarios = [fram.Scenario.load("scene.yaml"), fram.Scenario.from_text(text),
                     fram.Scenario.from_text(text, base="../here")]
        hashes = {scenario.world().hash for scenario in scenarios}
        os.chdir(self.there)
        hashes |= {scenario.world().hash for scenario in scenarios}
        self.assertEqual(len(hashes), 1)
        os.unlink("ship.stl")
        floes = scenarios[0].run("run").floes(0)
        # A hull of two parts has an outline for each.
        sides = [sorted(set(f.outline[:, 1].round(3))) for f in floes if f.properties["kind"] == "vessel"]
        self.assertEqual(sides, [[-8, -4], [4, 8]])
        for scenario in scenarios:
            self.assertEqual(scenario.files["vessel.hull.file"].replace("here/../", ""), str(self.here / "ship.stl"))


def with_children(world, works):
    """A recorded world, with children of fork on the way that do such works and end as programs do; their failures."""
    failed = 0
    with world.record("with"):
        world.step(7)
        for work in works:
            if os.fork() == 0:
                signal.alarm(30)  # rather than for ever
                work()
                sys.exit(0)
            failed += os.wait()[1] != 0
        world.step(13)
    return failed


def go_on(context):
    """What a child does with a world of its parent, whose threads it does not have."""
    world = fram.Scenario.from_text(FREE, context=context).world()
    world.step(3)
    if os.fork() == 0:
        signal.alarm(30)
        world.step(3)
        pathlib.Path("hash").write_text(world.hash)
        world.close()
        sys.exit(0)
    failed = os.wait()[1] != 0
    world.step(3)
    return failed or pathlib.Path("hash").read_text() != world.hash


def parent():
    """The process of its own in which Forks does all this; 0 when all went well."""
    world = fram.Scenario.from_text(TOWED).world()
    works = (lambda: world.step(2), lambda: sys.exit(world.recorded or world.close()))
    return with_children(world, works) + go_on(fram.Context(threads=2))


class Forks(InTwoFolders):
    def test_a_child_leaves_what_its_parent_began_alone(self):
        world = fram.Scenario.from_text(TOWED).world()
        with world.record("alone"):
            world.step(20)
        subprocess.run([sys.executable, pathlib.Path(__file__).resolve(), "parent"], check=True)
        self.assert_same_run(self.here / "alone", self.here / "with")


if __name__ == "__main__":
    if sys.argv[1:] == ["parent"]:
        sys.exit(parent())
    unittest.main(argv=sys.argv[:1])
