"""Worlds of libfram stepped from Python, for cases that look at single bodies: by the package (bindings/python), with
this tree's library."""

import math
import os
import sys
from typing import NamedTuple

import ladder

os.environ["FRAM_LIBRARY"] = str(ladder.ROOT / "build" / "release" / "libfram.so")
sys.path.insert(0, str(ladder.ROOT / "bindings" / "python"))
import fram  # noqa: E402  (of this tree)


class State(NamedTuple):
    """How a body moves; vectors in the global frame."""

    mass: float
    position: tuple
    orientation: tuple
    velocity: tuple
    angular_velocity: tuple


def state_of(columns, row):
    """Of a row of the package's arrays, as numbers of Python."""
    vectors = (getattr(columns, name)[row].tolist() for name in State._fields[1:])
    return State(float(columns.mass[row]), *(tuple(v) for v in vectors))


class World:
    """A scenario (path or text) as it moves.  Bodies go by slot."""

    def __init__(self, scenario, name="world", threads=1, isa=None, **keys):
        if isinstance(scenario, str):
            path = ladder.WORK / f"{name}.yaml"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(scenario)
            scenario = path
        sets = [f"{key.replace('__', '.')}={value}" for key, value in keys.items()]
        self.world = fram.Scenario.load(scenario, sets, fram.Context(threads=threads, isa=isa)).world()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.world.close()

    @property
    def time(self):
        return self.world.time

    @property
    def hash(self):
        return self.world.hash

    def step(self, count=1):
        self.world.step(count)

    def run(self, until):
        while self.time < until - 1e-9:
            self.step()

    def body(self, slot):
        """None where nobody is."""
        view = self.world.view()
        return state_of(view, slot) if 0 <= slot < len(view.lives) and view.lives[slot] else None

    def bodies(self, kind=None):
        """(slot, state) of all bodies of a kind ("floe", ...)."""
        found = self.world.bodies(kind)
        return [(int(slot), state_of(found, row)) for row, slot in enumerate(found.slot)]

    def push(self, slot, force=(0, 0, 0), moment=(0, 0, 0)):
        """An extra load in the next step only."""
        self.world.apply_wrench((slot, int(self.world.view().generation[slot])), force, moment)

    def ice_force(self):
        """On the first vessel in the last step [N]."""
        # In a list of vessels each one's name stands before the names of its channels; the first comes first.
        first = next((name for name in self.world.channels if f".{name}".endswith(".ice_force_x")), "ice_force_x")
        return tuple(self.world[f"{first[:-1]}{axis}"] for axis in "xyz")


def turned(q, v):
    """A vector turned by a quaternion w, x, y, z."""
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def length(a):
    return math.sqrt(dot(a, a))
