"""Worlds: everything that moves, stepped, read, steered, kept and recorded."""

from __future__ import annotations

import contextlib
import operator
import os
import sys
import weakref
from dataclasses import dataclass
from typing import TYPE_CHECKING, Callable, Iterator, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from ._arguments import absolute_of, call_of, flag_of, list_of, number_of, numbers_of, path_of, whole_of
from ._library import InputError, UsageError, ffi, is_made, lib, new_error, owned, text_of
from .scenario import Scenario

if TYPE_CHECKING:
    from .runs import Run

KINDS = {"floe": lib.FRAM_BODY_FLOE, "vessel": lib.FRAM_BODY_VESSEL, "wall": lib.FRAM_BODY_WALL,
         "other": lib.FRAM_BODY_OTHER}
"""Kinds of bodies by name."""


class Channel(NamedTuple):
    """A channel or an input: its number, name, unit and a few words."""

    index: int
    name: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Bodies:
    """Bodies as arrays, a row each: SI units, global frame, orientation as quaternion w, x, y, z.

    kind: 0 floe, 1 vessel, 2 wall, 3 other.  number: that of a floe, never used twice; parent: that of the floe it
    broke from; -1 for all else.  thickness: of floes and walls [m], otherwise 0.  position: of the centre of mass.
    """

    slot: np.ndarray
    generation: np.ndarray
    kind: np.ndarray
    number: np.ndarray
    parent: np.ndarray
    mass: np.ndarray
    thickness: np.ndarray
    position: np.ndarray
    orientation: np.ndarray
    velocity: np.ndarray
    angular_velocity: np.ndarray

    def __len__(self) -> int:
        return len(self.mass)


class _Memory:
    """Memory of a world for numpy, read-only; the world lives as long as an array of it."""

    def __init__(self, keep, pointer, shape: tuple, dtype: str):
        self._keep = keep
        self.__array_interface__ = {"version": 3, "shape": shape, "typestr": np.dtype(dtype).str,
                                    "data": (int(ffi.cast("uintptr_t", pointer)), True)}


class _Keep:
    """What arrays hold of a world: nothing of Python's, whose collector does not see through arrays."""

    def __init__(self, pointer):
        self.pointer = pointer


def _closed() -> UsageError:
    return UsageError("usage", "the world was closed", key="world")


_STEPS_MOST = 2**63 - 1
"""What the library counts steps in."""
_NEVER = (-1,)
"""In place of the number of changes of a world that is not looked at: no number of one."""
_VIEW_COLUMNS = {"lives": ("u1", 1), "generation": ("u4", 1), "mass": ("f8", 1), "position": ("f8", 3),
                 "orientation": ("f8", 4), "velocity": ("f8", 3), "angular_velocity": ("f8", 3)}


class View:
    """Poses and velocities of all bodies now, by slot, in the world's own memory: nothing is copied.

    Rows where `lives` is 0 have no meaning.  An array shows the world as it goes on; what shall last is copied.  When
    the bodies need more room the arrays move: ask the view for them after each step.  One that is held longer can be
    read as long as it is held, and then shows a state before.
    """

    # A world's memory tells by a number whether anything moved; asking in each step costs no call of the library.

    def __init__(self, world: "World"):
        # Not the world, which knows its view: in a circle it would wait for Python's collector, and its recording too.
        self._keep: Optional[_Keep] = world._keep
        self._changes: Sequence[int] = _NEVER  # the number of changes as it is now, in the world's memory
        self._number = 0  # of the changes when the arrays were found
        self._columns: "dict[str, np.ndarray]" = {}  # as they were found

    def _look(self) -> None:
        """Finds the arrays where they are now."""
        if self._keep is None:
            raise _closed()
        room = ffi.new("fram_body_view *")
        if lib.fram_world_view(self._keep.pointer, room, ffi.NULL, ffi.sizeof("fram_body_view")) != 0:
            raise UsageError("usage", "the world cannot be viewed", key="world")
        count = room.slots
        for column, (dtype, width) in _VIEW_COLUMNS.items():
            shape = (count, width) if width > 1 else (count,)
            self._columns[column] = (np.asarray(_Memory(self._keep, getattr(room, column), shape, dtype))
                                     if count else _frozen(np.empty(shape, dtype)))
        self._changes, self._number = room.changes, room.changes[0]

    def _forget(self) -> None:
        """The world is closed."""
        self._keep, self._changes, self._number = None, _NEVER, 0
        self._columns.clear()

    def _fresh(self, column: str) -> np.ndarray:
        """The array of a column, where it is now."""
        if self._changes[0] != self._number:
            self._look()
        return self._columns[column]

    @property
    def lives(self) -> np.ndarray:
        """0 where nobody is."""
        return self._fresh("lives")

    @property
    def generation(self) -> np.ndarray:
        """Of the bodies: another one in the same slot has another."""
        return self._fresh("generation")

    @property
    def mass(self) -> np.ndarray:
        """[kg]"""
        return self._fresh("mass")

    @property
    def position(self) -> np.ndarray:
        """Centre of mass, global [m]; 3 columns."""
        return self._fresh("position")

    @property
    def orientation(self) -> np.ndarray:
        """Quaternion w, x, y, z; 4 columns."""
        return self._fresh("orientation")

    @property
    def velocity(self) -> np.ndarray:
        """Global [m/s]; 3 columns."""
        return self._fresh("velocity")

    @property
    def angular_velocity(self) -> np.ndarray:
        """Global [rad/s]; 3 columns."""
        return self._fresh("angular_velocity")


@dataclass(frozen=True)
class Outlines:
    """Plan outlines: those of row i are ``points[offsets[i]:offsets[i + 1]]`` [m]."""

    offsets: np.ndarray
    points: np.ndarray

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, row: int) -> np.ndarray:
        row = whole_of("row", row, "the number of a row", -2**63, 2**63 - 1)
        if not -len(self) <= row < len(self):
            raise IndexError(row)
        row %= len(self)
        return self.points[self.offsets[row]:self.offsets[row + 1]]

    def __iter__(self) -> Iterator[np.ndarray]:
        return (self[row] for row in range(len(self)))


class _Room:
    """Memory for outlines, used again when nobody has an array of it: new memory costs more than what goes into it."""

    def __init__(self, slots: int, points: int):
        self.offsets = np.empty(slots + slots // 8 + 65, np.int32)
        self.points = np.empty((points + points // 8 + 512, 2))
        self._pointers = (ffi.cast("int32_t *", self.offsets.ctypes.data), len(self.offsets),
                          ffi.cast("double *", self.points.ctypes.data), len(self.points))

    def is_free(self) -> bool:
        """Whether no array of it is held: each one holds what it was cut from."""
        return sys.getrefcount(self.offsets) == 2 and sys.getrefcount(self.points) == 2

    def fill(self, pointer, slots: int) -> Optional[Outlines]:
        """The outlines of a world by slot; None when there is not room enough."""
        count = lib.fram_world_shapes(pointer, *self._pointers)
        if count > len(self.points) or slots + 1 > len(self.offsets):
            return None
        return Outlines(_frozen(self.offsets[:slots + 1]), _frozen(self.points[:count]))


def _dtype(name: str) -> np.dtype:
    """numpy's form of a C struct of numbers, from cffi's description of it."""
    kinds = {"int": "i4", "int32_t": "i4", "uint32_t": "u4", "double": "f8"}

    def of(ctype):
        if ctype.kind == "array":
            return of(ctype.item), (ctype.length,)
        if ctype.kind == "enum":
            return "i4"
        if ctype.kind == "struct":
            fields = dict(ctype.fields)
            return np.dtype({"names": list(fields), "formats": [of(f.type) for f in fields.values()],
                             "offsets": [f.offset for f in fields.values()], "itemsize": ffi.sizeof(ctype)})
        return kinds[ctype.cname]

    return of(ffi.typeof(name))


_BODY_POINTERS = dict(ffi.typeof("fram_body_arrays").fields)
_CONTACT, _FRACTURE = _dtype("fram_contact"), _dtype("fram_fracture")


def _selection(kind: Union[str, Sequence[str], None]) -> int:
    if kind is None:
        return 0  # all
    bits = 0
    some = f"some of {', '.join(KINDS)}, or None for all"
    for word in [kind] if isinstance(kind, str) else list_of("kind", kind, some):
        if not isinstance(word, str) or word not in KINDS:
            raise UsageError("usage", f"expected one of {', '.join(KINDS)}, found {word!r}", key="kind")
        bits |= 1 << KINDS[word]
    if bits == 0:
        raise UsageError("usage", f"expected {some}, found none", key="kind")
    return bits


def _is_false(answer: object) -> bool:
    """Whether a callback returned False, Python's or numpy's: None and 0 are no answer."""
    return answer is False or isinstance(answer, np.bool_) and not answer


def _frozen(array: np.ndarray) -> np.ndarray:
    array.flags.writeable = False
    return array


class Snapshot:
    """A state that was kept.  As a context manager it goes back to the state when the block ends; UsageError at its
    begin while the world is recorded, which cannot go back.
    """

    def __init__(self, world: "World"):
        self._world, self._state = world, world.to_bytes()

    def restore(self) -> None:
        """Go back to the state; it may be done any number of times."""
        self._world.from_bytes(self._state)

    def __enter__(self) -> "Snapshot":
        if self._world.recorded:
            raise UsageError("usage", "it is recorded, and its series would not follow from one another: end the "
                             "recording before", key="world")
        return self

    def __exit__(self, kind, *_exception) -> None:
        try:
            self.restore()
        except Exception:
            if kind is None:  # otherwise what ended the block says more
                raise


class Recording:
    """A world that is being recorded; as a context manager the recording ends with the block."""

    def __init__(self, world: "World", folder: str):
        self._world, self.folder, self._number = world, folder, world._recordings

    def _refuse_ended(self) -> None:
        if self._number != self._world._recordings:
            raise UsageError("usage", "this recording has ended", key="recording")

    def checkpoint(self) -> None:
        """A checkpoint of now, from which `fram resume` can go on."""
        self._refuse_ended()
        self._world._call(lib.fram_world_checkpoint)

    def end(self) -> "Run":
        """The last checkpoint, pictures and results; the finished run."""
        from .runs import open_run
        self._refuse_ended()
        self._world._call(lib.fram_world_record_end, ffi.NULL, size=0)
        return open_run(self.folder)

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, kind, *_exception) -> None:
        if self._world._pointer is not None and self._number == self._world._recordings and self._world.recorded:
            self.end()


def _load_again(scenario: Scenario, state: bytes) -> "World":
    """What was pickled, in another process perhaps."""
    world = scenario.world()
    world.from_bytes(state)
    return world


def _three_numbers(name: str, vector) -> list[float]:
    """A vector for C; what C's numbers do not hold is told as what they hold and the library refuses."""
    try:
        if np.shape(vector) == (3,):
            return [number_of(name, x) for x in vector]
    except (TypeError, ValueError):
        pass
    raise InputError("input", f"expected three numbers, found {vector}", key=name)


def _body_id(body) -> dict[str, int]:
    """(slot, generation) for C; numbers that C does not hold are those of no body."""
    try:
        slot, generation = (operator.index(x) for x in body)
    except (TypeError, ValueError):
        raise UsageError("usage", f"expected (slot, generation) of a body, found {body}", key="body") from None
    if not (0 <= slot < 2**31 and 0 <= generation < 2**32):
        raise UsageError("usage", f"there is no living body {slot} of generation {generation}", key="body")
    return {"slot": slot, "generation": generation}


class World:
    """A world.  ``world["ice_force_x"]`` reads a channel or an input, ``world["wind_x"] = 10`` tells an input."""

    def __init__(self, pointer, scenario: Scenario):
        self._pointer = owned(pointer, lib.fram_world_destroy, scenario._pointer)
        self._keep: Optional[_Keep] = _Keep(self._pointer)
        self.scenario = scenario
        self._view: Optional[View] = None
        self._recordings = 0  # so far
        self._shapes: Optional[Outlines] = None
        self._changes: Sequence[int] = _NEVER  # the number of changes as it is now, in the world's memory
        self._shape_number = 0  # of the changes when the shapes were made
        self._rooms: list[_Room] = []
        # An item for each call that has not returned, of whatever thread: those that change the world, and others.
        self._calls: list[None] = []
        self._readers: list[None] = []
        self._begun = 0  # how many that change it have begun so far
        self._channels = self._list(lib.fram_world_channels, lib.fram_world_channel)
        self._inputs = self._list(lib.fram_world_inputs, lib.fram_world_input)

    def _list(self, count, get) -> dict[str, Channel]:
        found = {}
        for index in range(count(self._pointer)):
            channel = ffi.new("fram_channel *")
            self._call(get, index, channel, size=ffi.sizeof("fram_channel"), reads=True)
            name = text_of(channel.name)
            found[name] = Channel(index, name, text_of(channel.unit), text_of(channel.meaning))
        return found

    def _living(self):
        if self._pointer is None:
            raise _closed()
        return self._pointer

    def _call(self, function, *arguments, size: Optional[int] = None, reads: bool = False) -> None:
        """A function of the world; size: of the struct that it fills, 0 for none; reads: it changes nothing."""
        error, calls = new_error(), self._readers if reads else self._calls
        last = (error,) if size is None else (error, size)
        pointer = self._living()
        calls.append(None)
        self._begun += not reads
        try:
            status = function(pointer, *arguments, *last)
        finally:
            calls.pop()
        self.scenario._context._check(status, error)

    @contextlib.contextmanager
    def _reading(self):
        """What is read is of one state: UsageError when another call changes the world before the block ends.

        The library's functions that return no status find nothing then, which looks like a world without bodies.
        """
        begun = self._begun
        self._readers.append(None)
        try:
            is_busy = bool(self._calls)
            yield self._living()
            if is_busy or self._calls or self._begun != begun:
                raise UsageError("usage", "another call on it has not returned yet: use a world from one thread at a "
                                 "time, and not from a function that a call on it calls", key="world")
        finally:
            self._readers.pop()

    def close(self) -> None:
        """Free the world now rather than when Python finds that nobody has it.

        A recording ends; what it cannot write, as on a full disk, is an error, and the world is closed all the same.
        """
        if self._pointer is None:
            return
        if self._calls or self._readers:
            raise UsageError("usage", "another call on it has not returned yet: close it after that", key="world")
        pointer, self._pointer = self._pointer, None
        self._changes = _NEVER
        if self._view is not None:
            self._view._forget()
        viewed = weakref.ref(self._keep)
        self._keep = self._view = self._shapes = None
        self._rooms = []
        error, status = new_error(), 0
        if lib.fram_world_is_recorded(pointer):
            status = lib.fram_world_record_end(pointer, ffi.NULL, error, 0)
        if viewed() is None:  # if arrays are held the memory goes with the last of them
            ffi.release(pointer)
        self.scenario._context._check(status, error)

    def __del__(self) -> None:
        """A recording ends with its world, whatever arrays are held; the log of the context is told of that."""
        pointer = getattr(self, "_pointer", None)
        if pointer is not None and is_made(pointer) and lib.fram_world_is_recorded(pointer):
            with self.scenario._context._heard():
                lib.fram_world_record_end(pointer, ffi.NULL, ffi.NULL, 0)

    def __enter__(self) -> "World":
        return self

    def __exit__(self, *_exception) -> None:
        self.close()

    # ---- stepping ----

    def step(self, n: int = 1, callback: Optional[Callable[["World"], object]] = None) -> float:
        """`n` time steps; after each, `callback(world)` if there is one; one that returns False ends them early.

        Returns the simulated time [s].  SimulationError when the state went wrong; load a good state to go on.
        """
        n = whole_of("n", n, "0 steps or more, as many as a world can count", 0, _STEPS_MOST)
        call_of("callback", callback)
        error, check, calls = new_error(), self.scenario._context._check, self._calls
        for _ in range(n):
            pointer = self._living()
            calls.append(None)
            self._begun += 1
            try:
                status = lib.fram_world_step(pointer, error)
            finally:
                calls.pop()
            check(status, error)
            if callback is not None and _is_false(callback(self)):
                break
        return self.time

    def run_until(self, time: float, callback: Optional[Callable[["World"], object]] = None) -> float:
        """Steps until the simulated time is not before `time` [s], with a `callback` as `step`; returns the time."""
        call_of("callback", callback)
        if not number_of("time", time, "a finite time") < float("inf"):
            raise UsageError("usage", f"expected a finite time, found {time}", key="time")
        while self.time < time - 1e-9 * self.scenario.time_step:
            before = self.steps
            self.step(1)
            if callback is not None and _is_false(callback(self)) or self.steps == before:
                break
        return self.time

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return lib.fram_world_time(self._living())

    @property
    def steps(self) -> int:
        """Steps done."""
        return lib.fram_world_steps(self._living())

    @property
    def hash(self) -> str:
        """16 hexadecimal digits of the whole state, as `fram run` and run.json tell them."""
        with self._reading() as pointer:
            return f"{lib.fram_world_hash(pointer):016x}"

    # ---- channels and inputs ----

    @property
    def channels(self) -> Mapping[str, Channel]:
        """Every column of series.csv, by name."""
        return self._channels

    @property
    def inputs(self) -> Mapping[str, Channel]:
        """What the world can be told, by name."""
        return self._inputs

    def __getitem__(self, name: str) -> float:
        try:
            if name in self._channels:
                return lib.fram_world_value(self._living(), self._channels[name].index)
            if name in self._inputs:
                return lib.fram_world_input_value(self._living(), self._inputs[name].index)
        except TypeError:  # a list, say: no key of any mapping
            pass
        raise KeyError(f"{name}: the world has no such channel or input")

    def __setitem__(self, name: str, value: float) -> None:
        if not isinstance(name, str) or name not in self._inputs:
            raise KeyError(f"{name}: the world has no such input")
        if not isinstance(value, float):  # what a controller gives in each step mostly is
            value = number_of(name, value)
        self._call(lib.fram_world_set_input, self._inputs[name].index, value)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (name in self._channels or name in self._inputs)

    def values(self) -> np.ndarray:
        """All channels in their order; NaN, as each by itself, while another call on the world has not returned."""
        out = np.full(len(self._channels), np.nan)
        lib.fram_world_values(self._living(), ffi.cast("double *", out.ctypes.data), len(out))
        return out

    def set_path(self, times: Sequence[float], places: Sequence[Sequence[float]], vessel: int = 0) -> None:
        """A path from where the vessel is now: places (x, y, heading [m, m, rad]) of the ship's origin at times [s].

        A towed or driven vessel moves along it, the set point of a free one jumps to each place at its time; without
        places there is no path any more, and a towed or driven vessel goes on as fast as it went along it.  A ship with
        `propulsion` and no thrusters goes by its track, and is told none.
        """
        t = numbers_of("times", times, "times [s]").reshape(-1)
        p = numbers_of("places", places, "x, y and heading of places")
        number = whole_of("vessel", vessel, "the number of a vessel, counted from 0")
        if p.shape != (len(t), 3) and (p.size > 0 or len(t) > 0):
            raise InputError("input", f"expected x, y and heading of {len(t)} places, as many as times; found an array "
                             f"of shape {p.shape}", key="places")
        self._call(lib.fram_world_set_path, number, ffi.cast("double *", t.ctypes.data),
                   ffi.cast("double *", p.ctypes.data), len(t))

    def apply_wrench(self, body: tuple[int, int], force: Sequence[float], moment: Sequence[float] = (0, 0, 0)) -> None:
        """An extra force [N] and moment [N m] about the centre of mass, global frame, in the next step only.

        body: (slot, generation), as `bodies` and `vessel` tell them; calls add up.
        """
        f, m = (ffi.new("double[3]", _three_numbers(name, v)) for name, v in (("force", force), ("moment", moment)))
        self._call(lib.fram_body_apply_wrench, _body_id(body), f, m)

    # ---- arrays ----

    @property
    def vessel(self) -> Optional[tuple[int, int]]:
        """(slot, generation) of the first vessel, or None."""
        identity = ffi.new("fram_body_id *")
        with self._reading() as pointer:
            return (identity.slot, identity.generation) if lib.fram_world_vessel(pointer, identity) else None

    def bodies(self, kind: Union[str, Sequence[str], None] = None) -> Bodies:
        """Copies of what bodies are and how they move; kind: "floe", "vessel", "wall", "other", several, or all."""
        with self._reading() as pointer:
            return self._bodies(pointer, _selection(kind))

    @staticmethod
    def _bodies(pointer, selection: int) -> Bodies:
        size = ffi.sizeof("fram_body_arrays")
        count = lib.fram_world_bodies(pointer, selection, ffi.NULL, size)
        columns = {"id": (np.int64, 1), "kind": (np.int32, 1), "number": (np.int32, 1), "parent": (np.int32, 1),
                   "mass": (float, 1), "thickness": (float, 1), "position": (float, 3), "orientation": (float, 4),
                   "velocity": (float, 3), "angular_velocity": (float, 3)}
        arrays = {name: np.empty((count, width) if width > 1 else count, dtype)
                  for name, (dtype, width) in columns.items()}
        c = ffi.new("fram_body_arrays *", {"room": count})
        for name, array in arrays.items():
            setattr(c, name, ffi.cast(_BODY_POINTERS[name].type, array.ctypes.data))
        lib.fram_world_bodies(pointer, selection, c, size)
        both = arrays.pop("id").view(np.int32).reshape(-1, 2)
        return Bodies(slot=both[:, 0], generation=both[:, 1].view(np.uint32), **arrays)

    def outlines(self, kind: Union[str, Sequence[str], None] = "floe") -> Outlines:
        """Plan outlines of floes and walls now, global [m], in the order of `bodies(kind)`."""
        selection, bodies = _selection(kind), ffi.new("int *")
        with self._reading() as pointer:
            count = lib.fram_world_outlines(pointer, selection, ffi.NULL, 0, ffi.NULL, 0, bodies)
            offsets, points = np.empty(bodies[0] + 1, np.int32), np.empty((count, 2))
            lib.fram_world_outlines(pointer, selection, ffi.cast("int32_t *", offsets.ctypes.data), len(offsets),
                                    ffi.cast("double *", points.ctypes.data), count, ffi.NULL)
        return Outlines(offsets, points)

    def view(self) -> View:
        """Poses and velocities of all slots without a copy; the same view each time."""
        self._living()
        if self._view is None:
            self._view = View(self)
        return self._view

    def shapes(self) -> Outlines:
        """Plan outlines of floes and walls in the axes of each body, x and y about its centre of mass [m]; by slot, as
        `view` has the poses, so that row i belongs to ``view().position[i]``; other slots have no points.

        The same read-only arrays until a body comes or goes or a floe breaks, so that asking in each step is cheap;
        `outlines` gives global ones.
        """
        if self._changes[0] != self._shape_number:
            self._make_shapes()
        return self._shapes

    def _make_shapes(self) -> None:
        view = self.view()
        with self._reading() as pointer:
            view._look()
            slots, self._shapes = lib.fram_world_slots(pointer), None
            for room in self._rooms:
                if self._shapes is None and room.is_free():
                    self._shapes = room.fill(pointer, slots)
            if self._shapes is None:
                room = _Room(slots, lib.fram_world_shapes(pointer, ffi.NULL, 0, ffi.NULL, 0))
                self._rooms = [room, *self._rooms[:1]]
                self._shapes = room.fill(pointer, slots)
        self._changes, self._shape_number = view._changes, view._changes[0]

    def _records(self, function, dtype: np.dtype, ctype: str) -> np.ndarray:
        with self._reading() as pointer:
            count = function(pointer, ffi.NULL, 0, dtype.itemsize)
            out = np.zeros(count, dtype)
            function(pointer, ffi.cast(ctype, out.ctypes.data), count, dtype.itemsize)
        return out

    def contacts(self) -> np.ndarray:
        """Points where bodies touched in the last step: a structured array of fram_contact (fram/live.h)."""
        return self._records(lib.fram_world_contacts, _CONTACT, "fram_contact *")

    def fractures(self) -> np.ndarray:
        """Floes that broke in the last step: a structured array of fram_fracture (fram/live.h)."""
        return self._records(lib.fram_world_fractures, _FRACTURE, "fram_fracture *")

    # ---- states ----

    def copy(self) -> "World":
        """A second world in the same state, steered and recorded apart."""
        out = ffi.new("fram_world **")
        try:
            self._call(lib.fram_world_copy, out, reads=True)
        except BaseException:  # one of a callback, too, after a copy that was made
            lib.fram_world_destroy(out[0])
            raise
        return World(out[0], self.scenario)

    def __copy__(self) -> "World":
        return self.copy()

    def __deepcopy__(self, _memo) -> "World":
        return self.copy()

    def __reduce__(self):
        return _load_again, (self.scenario, self.to_bytes())

    def to_bytes(self) -> bytes:
        """The whole state."""
        data, size = ffi.new("void **"), ffi.new("size_t *")
        try:
            self._call(lib.fram_world_save_memory, data, size, reads=True)
            return bytes(ffi.buffer(data[0], size[0]))
        finally:
            lib.fram_data_free(self.scenario._context._pointer, data[0])

    def from_bytes(self, state: bytes) -> None:
        """Take over a state of the same scenario and files; InputError, and nothing changes, for any other."""
        try:
            data = ffi.from_buffer(state)
        except (TypeError, ValueError, BufferError):
            raise UsageError("usage", f"expected bytes, as to_bytes gives them, found {type(state).__name__}",
                             key="state") from None
        self._call(lib.fram_world_load_memory, data, len(data))

    def save(self, path: Union[str, os.PathLike]) -> None:
        """The whole state into a file."""
        self._call(lib.fram_world_save, path_of("path", path), reads=True)

    def load(self, path: Union[str, os.PathLike]) -> None:
        """Take over a state of the same scenario and files from a file: one of `save`, or a run's checkpoint
        (``checkpoint-*.fram`` in its folder), from which the world goes on as the resumed run does."""
        self._call(lib.fram_world_load, path_of("path", path))

    def snapshot(self) -> Snapshot:
        """Keep the state: ``with world.snapshot(): ...`` tries something and goes back."""
        return Snapshot(self)

    # ---- recording ----

    @property
    def recorded(self) -> bool:
        """Whether the world is being recorded."""
        return bool(lib.fram_world_is_recorded(self._living()))

    def record(self, folder: Union[str, os.PathLike], force: bool = False, with_paths: bool = False,
               live_page: Union[str, os.PathLike, None] = None,
               live: Optional[Callable[[str], None]] = None) -> Recording:
        """Record each step from now on in a run folder, as `fram run` does.

        force: also into a folder that is not empty.  with_paths: the record tells where input files lie, not their
        names alone.  ``live_page`` (the viewer's page, which `make viewer` builds) lets a browser on this machine look
        on until the recording ends: ``live(address)`` is told where.  What it raises ends the recording.
        """
        if live is not None and live_page is None:
            raise UsageError("usage", "expected live_page, the page that a browser is to look at, together with it",
                             key="live")
        definition = ffi.new("fram_record_definition *")
        lib.fram_record_default(definition, ffi.sizeof("fram_record_definition"))
        path = absolute_of("folder", folder)
        name = ffi.new("char[]", path)
        definition.folder, definition.force = name, flag_of("force", force)
        definition.with_paths, live = flag_of("with_paths", with_paths), call_of("live", live)
        page = ffi.NULL if live_page is None else ffi.new("char[]", path_of("live_page", live_page))
        told: list[str] = []
        callback = ffi.callback("void(void *, const char *)", lambda _, text: told.append(ffi.string(text).decode()))
        definition.live_page, definition.live = page, callback if live is not None else ffi.NULL
        was_recorded = self.recorded
        try:
            self._call(lib.fram_world_record, definition)
            self._recordings += 1
            if told and live is not None:
                live(told[0])
        except BaseException:  # nobody would have the recording: it ends, if it began
            if self._pointer is not None and self.recorded and not was_recorded:
                self._call(lib.fram_world_record_end, ffi.NULL, size=0)
            raise
        return Recording(self, os.fsdecode(path))

    def __repr__(self) -> str:
        return "<fram.World closed>" if self._pointer is None else \
            f"<fram.World at t = {self.time:g} s, {self['floes']:.0f} floes>"
