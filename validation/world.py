"""Worlds of libfram stepped from Python, for cases that look at single bodies.  Stands on the public C API alone."""

import ctypes
import math

import ladder

LIBRARY = ladder.ROOT / "build" / "release" / "libfram.so"
KINDS = ("floe", "vessel", "wall", "other")  # enum fram_body_kind


class Id(ctypes.Structure):
    _fields_ = [("slot", ctypes.c_int32), ("generation", ctypes.c_uint32)]


class State(ctypes.Structure):
    """fram_body_state"""

    _fields_ = [("kind", ctypes.c_int), ("dynamic", ctypes.c_bool), ("mass", ctypes.c_double),
                ("position", ctypes.c_double * 3), ("orientation", ctypes.c_double * 4),
                ("velocity", ctypes.c_double * 3), ("angular_velocity", ctypes.c_double * 3)]


class Load(ctypes.Structure):
    """fram_ice_load"""

    _fields_ = [(name, ctypes.c_double * 3) for name in ("force", "moment", "capped", "elastic", "friction")]
    _fields_ += [("contacts", ctypes.c_int)]


class Error(ctypes.Structure):
    """fram_error"""

    _fields_ = [("status", ctypes.c_int), ("line", ctypes.c_int), ("column", ctypes.c_int),
                ("file", ctypes.c_char * 256), ("key", ctypes.c_char * 128), ("message", ctypes.c_char * 512)]


class ContextDefinition(ctypes.Structure):
    """fram_context_definition"""

    _fields_ = [("size", ctypes.c_size_t), ("memory", ctypes.c_void_p), ("memory_user", ctypes.c_void_p),
                ("log", ctypes.c_void_p), ("log_user", ctypes.c_void_p), ("verbosity", ctypes.c_int),
                ("threads", ctypes.c_int), ("isa", ctypes.c_char_p), ("stop", ctypes.c_void_p),
                ("work", ctypes.c_void_p), ("work_user", ctypes.c_void_p)]


def library():
    lib = ctypes.CDLL(str(LIBRARY))
    lib.fram_world_time.restype = ctypes.c_double
    lib.fram_world_hash.restype = ctypes.c_uint64
    lib.fram_world_body.restype = ctypes.c_bool
    lib.fram_world_vessel.restype = ctypes.c_bool
    return lib


def size_of(struct):
    """What the C macros append for structs that a newer library may have made longer."""
    return ctypes.c_size_t(ctypes.sizeof(struct))


class World:
    """A scenario (path or text) as it moves.  Bodies go by slot; vectors are tuples in the global frame."""

    def __init__(self, scenario, name="world", threads=1, isa=None, **keys):
        self.lib, self.error = library(), Error()
        if isinstance(scenario, str):
            path = ladder.WORK / f"{name}.yaml"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(scenario)
            scenario = path
        sets = [f"{key.replace('__', '.')}={value}".encode() for key, value in keys.items()]
        array = (ctypes.c_char_p * max(1, len(sets)))(*sets)
        self.context, self.scenario, self.world = (ctypes.c_void_p() for _ in range(3))
        definition = ContextDefinition()
        self.lib.fram_context_default(ctypes.byref(definition), size_of(definition))
        definition.threads, definition.isa = threads, isa.encode() if isa else None
        self._ok(self.lib.fram_context_create(ctypes.byref(definition), ctypes.byref(self.context), self._e()))
        self._ok(self.lib.fram_scenario_load(self.context, str(scenario).encode(), array, len(sets),
                                             ctypes.byref(self.scenario), self._e()))
        self._ok(self.lib.fram_world_create(self.scenario, ctypes.byref(self.world), self._e()))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.lib.fram_world_destroy(self.world)
        self.lib.fram_scenario_destroy(self.scenario)
        self.lib.fram_context_destroy(self.context)

    def _e(self):
        return ctypes.byref(self.error)

    def _ok(self, status):
        if status != 0:
            raise RuntimeError(f"{self.error.key.decode()}: {self.error.message.decode()}")

    @property
    def time(self):
        return self.lib.fram_world_time(self.world)

    @property
    def hash(self):
        return f"{self.lib.fram_world_hash(self.world):016x}"

    def step(self, count=1):
        for _ in range(count):
            self._ok(self.lib.fram_world_step(self.world, self._e()))

    def run(self, until):
        while self.time < until - 1e-9:
            self.step()

    def _id(self, slot):
        found = Id()
        return found if self.lib.fram_world_body(self.world, slot, ctypes.byref(found)) else None

    def body(self, slot):
        state, found = State(), self._id(slot)
        if found is None:
            return None
        self._ok(self.lib.fram_body_state_get(self.world, found, ctypes.byref(state), self._e(), size_of(state)))
        return state

    def bodies(self, kind=None):
        """(slot, state) of all bodies of a kind ("floe", ...)."""
        every = ((i, self.body(i)) for i in range(self.lib.fram_world_slots(self.world)))
        return [(i, s) for i, s in every if s is not None and kind in (None, KINDS[s.kind])]

    def outline(self, slot):
        """Corners of a floe in plan."""
        found = self._id(slot)
        room = self.lib.fram_body_outline(self.world, found, None, 0)
        xy = (ctypes.c_double * (2 * room))()
        self.lib.fram_body_outline(self.world, found, xy, room)
        return [(xy[2 * i], xy[2 * i + 1]) for i in range(room)]

    def push(self, slot, force=(0, 0, 0), moment=(0, 0, 0)):
        """An extra load in the next step only."""
        triple = ctypes.c_double * 3
        self._ok(self.lib.fram_body_apply_wrench(self.world, self._id(slot), triple(*force), triple(*moment),
                                                 self._e()))

    def load(self):
        """fram_ice_load of the vessel in the last step."""
        vessel, load = Id(), Load()
        if not self.lib.fram_world_vessel(self.world, ctypes.byref(vessel)):
            raise RuntimeError("there is no vessel")
        self._ok(self.lib.fram_world_ice_load(self.world, vessel, ctypes.byref(load), self._e(), size_of(load)))
        return load


def turned(q, v):
    """A vector turned by a quaternion w, x, y, z."""
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def length(a):
    return math.sqrt(dot(a, a))
