"""A small importer of co-simulation units of FMI 2.0 and 3.0, and worlds of libfram, by ctypes alone."""

import ctypes as c
import pathlib
import xml.etree.ElementTree as xml
import zipfile

LOGGER_2 = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p, c.c_char_p)
LOGGER_3 = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)
LOOK_3 = c.CFUNCTYPE(None, c.c_void_p, c.c_double, c.c_bool, c.c_bool, c.c_bool, c.c_bool, c.POINTER(c.c_bool),
                     c.POINTER(c.c_double))
OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3


class Callbacks(c.Structure):
    _fields_ = [("logger", LOGGER_2), ("allocate", c.c_void_p), ("free", c.c_void_p), ("finished", c.c_void_p),
                ("environment", c.c_void_p)]


class Unit:
    """An unpacked unit: its description and its binary."""

    def __init__(self, path, folder):
        self.folder = pathlib.Path(folder)
        with zipfile.ZipFile(path) as archive:
            assert archive.testzip() is None
            archive.extractall(folder)
        self.description = xml.parse(self.folder / "modelDescription.xml").getroot()
        self.version = int(self.description.get("fmiVersion")[0])
        self.name = self.description.find("CoSimulation").get("modelIdentifier")
        self.variables = {v.get("name"): v for v in self.description.find("ModelVariables")}
        self.reference = {name: int(v.get("valueReference")) for name, v in self.variables.items()}
        self.step_size = float(self.description.find("DefaultExperiment").get("stepSize"))
        self.token = self.description.get("guid" if self.version == 2 else "instantiationToken")
        self.resources = self.folder / "resources"
        place = "linux64" if self.version == 2 else "x86_64-linux"
        self.binary = c.CDLL(str(self.folder / f"binaries/{place}/{self.name}.so"))
        for name in ("Instantiate" if self.version == 2 else "InstantiateCoSimulation",):
            self.function(name).restype = c.c_void_p
        self.function("GetVersion").restype = c.c_char_p

    def function(self, name):
        return getattr(self.binary, f"fmi{self.version}{name}")

    def instance(self, token=None, where=None, name="one", **words):
        return (Instance2 if self.version == 2 else Instance3)(self, token or self.token, where, name, **words)

    def unit_of(self, variable):
        """The unit that the description gives a variable; None without one."""
        element = self.variables[variable]
        return (element.find("Real") if self.version == 2 else element).get("unit")

    def outputs(self):
        return [name for name, v in self.variables.items() if v.get("causality") == "output"]


class Instance:
    """What the versions share."""

    def __init__(self, unit):
        self.unit, self.told = unit, []

    def call(self, name, *arguments, status=OK):
        if self.unit.version == 2:
            name = name.replace("FMUState", "FMUstate").replace("Deserialize", "DeSerialize")
        found = self.unit.function(name)(c.c_void_p(self.c), *arguments)
        assert found == status, f"{name}: status {found}, {self.told}"

    def arrays(self, names, values):
        """References and values as the versions want them."""
        count = len(names)
        references = (c.c_uint * count)(*(self.unit.reference[name] for name in names))
        return (references, c.c_size_t(count), values) + ((c.c_size_t(count),) if self.unit.version == 3 else ())

    def get(self, *names, status=OK):
        values = (c.c_double * len(names))()
        self.call("GetReal" if self.unit.version == 2 else "GetFloat64", *self.arrays(names, values), status=status)
        return list(values)

    def set(self, name, value, status=OK):
        self.call("SetReal" if self.unit.version == 2 else "SetFloat64", *self.arrays([name], (c.c_double * 1)(value)),
                  status=status)

    def keep(self):
        state = c.c_void_p()
        self.call("GetFMUState", c.byref(state))
        return state

    def back(self, state):
        self.call("SetFMUState", state)

    def forget(self, state):
        self.call("FreeFMUState", c.byref(state))
        assert not state.value

    def bytes_of(self, state):
        size = c.c_size_t()
        self.call("SerializedFMUStateSize", state, c.byref(size))
        data = (c.c_char * size.value)()
        self.call("SerializeFMUState", state, data, size)
        return bytes(data)

    def from_bytes(self, data, status=OK):
        state = c.c_void_p()
        self.call("DeserializeFMUState", data, c.c_size_t(len(data)), c.byref(state), status=status)
        return state

    def free(self):
        self.unit.function("FreeInstance")(c.c_void_p(self.c))


class Instance2(Instance):
    def __init__(self, unit, token, where, name):
        super().__init__(unit)

        def log(_environment, instance, status, category, form, text):
            assert form == (b"%s" if b"%" in text else text) and instance == name.encode()
            self.told.append((status, category.decode(), text.decode()))

        self.callbacks = Callbacks(LOGGER_2(log), None, None, None, None)
        where = where or unit.resources.as_uri()
        self.c = unit.binary.fmi2Instantiate(name.encode(), 1, token.encode(), where.encode(), c.byref(self.callbacks),
                                             0, 0)

    def initialise(self, start=0.0, stop=None):
        self.call("SetupExperiment", 0, c.c_double(0), c.c_double(start), stop is not None, c.c_double(stop or 0))
        self.call("EnterInitializationMode")
        self.call("ExitInitializationMode")
        return self

    def step(self, time, step, status=OK):
        self.call("DoStep", c.c_double(time), c.c_double(step), 1, status=status)
        return time + step


class Instance3(Instance):
    """look: called with the time and whether the step may end early; returns the time where it shall end, or None."""

    def __init__(self, unit, token, where, name, look=None, look_at=(), events=False, early=True, logging=True):
        super().__init__(unit)

        def log(environment, status, category, text):
            assert environment == 4711
            self.told.append((status, category.decode(), text.decode()))

        def look_on(environment, time, may_set, may_get, done, may_return, wanted, wanted_time):
            assert environment == 4711 and not may_set and may_get and done and not wanted[0]
            answer = look(time, may_return)
            if answer is not None:
                wanted[0], wanted_time[0] = True, answer

        self.kept = LOGGER_3(log), LOOK_3(look_on)
        references = (c.c_uint * len(look_at))(*(unit.reference[name] for name in look_at))
        self.c = unit.binary.fmi3InstantiateCoSimulation(
            name.encode(), token.encode(), (where or f"{unit.resources}/").encode(), False, logging, events, early,
            references, c.c_size_t(len(look_at)), c.c_void_p(4711), self.kept[0], self.kept[1] if look else None)

    def initialise(self, start=0.0, stop=None):
        self.call("EnterInitializationMode", False, c.c_double(0), c.c_double(start), stop is not None,
                  c.c_double(stop or 0))
        self.call("ExitInitializationMode")
        return self

    def step(self, time, step, status=OK):
        """The time that the unit reached; self.early: it was before the step's end."""
        event, end, early, reached = c.c_bool(True), c.c_bool(True), c.c_bool(True), c.c_double()
        self.call("DoStep", c.c_double(time), c.c_double(step), True, c.byref(event), c.byref(end), c.byref(early),
                  c.byref(reached), status=status)
        assert not event.value and not end.value
        self.early = early.value
        return reached.value


class World:
    """A world of libfram, stepped in C's way."""

    def __init__(self, library, path):
        self.lib = c.CDLL(str(library))
        self.lib.fram_world_value.restype = c.c_double
        self.context, self.scenario, self.c = c.c_void_p(), c.c_void_p(), c.c_void_p()
        assert self.lib.fram_context_create(None, c.byref(self.context), None) == 0
        assert self.lib.fram_scenario_load(self.context, str(path).encode(), None, 0, c.byref(self.scenario), None) == 0
        assert self.lib.fram_world_create(self.scenario, c.byref(self.c), None) == 0

    def __getitem__(self, name):
        return self.lib.fram_world_value(self.c, self.lib.fram_world_find_channel(self.c, name.encode()))

    def __setitem__(self, name, value):
        index = self.lib.fram_world_find_input(self.c, name.encode())
        assert self.lib.fram_world_set_input(self.c, index, c.c_double(value), None) == 0, name

    def step(self):
        assert self.lib.fram_world_step(self.c, None) == 0

    def free(self):
        self.lib.fram_world_destroy(self.c)
        self.lib.fram_scenario_destroy(self.scenario)
        self.lib.fram_context_destroy(self.context)
