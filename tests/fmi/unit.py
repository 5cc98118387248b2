"""A small importer of FMI 2.0 co-simulation units, and worlds of libfram, by ctypes alone."""

import ctypes as c
import pathlib
import xml.etree.ElementTree as xml
import zipfile

LOGGER = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p, c.c_char_p)
OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3


class Callbacks(c.Structure):
    _fields_ = [("logger", LOGGER), ("allocate", c.c_void_p), ("free", c.c_void_p), ("finished", c.c_void_p),
                ("environment", c.c_void_p)]


class Unit:
    """An unpacked unit: its description and its binary."""

    def __init__(self, path, folder):
        self.folder = pathlib.Path(folder)
        with zipfile.ZipFile(path) as archive:
            assert archive.testzip() is None
            archive.extractall(folder)
        self.description = xml.parse(self.folder / "modelDescription.xml").getroot()
        self.name = self.description.find("CoSimulation").get("modelIdentifier")
        self.variables = {v.get("name"): v for v in self.description.iter("ScalarVariable")}
        self.reference = {name: int(v.get("valueReference")) for name, v in self.variables.items()}
        self.step_size = float(self.description.find("DefaultExperiment").get("stepSize"))
        self.binary = c.CDLL(str(self.folder / f"binaries/linux64/{self.name}.so"))
        self.binary.fmi2Instantiate.restype = c.c_void_p
        self.binary.fmi2GetVersion.restype = c.c_char_p

    def instance(self, guid=None, where=None, name="one"):
        return Instance(self, guid or self.description.get("guid"), where, name)


class Instance:
    def __init__(self, unit, guid, where, name):
        self.unit, self.told = unit, []

        def log(_environment, instance, status, category, form, text):
            assert form == b"%s" and instance == name.encode()
            self.told.append((status, category.decode(), text.decode()))

        self.callbacks = Callbacks(LOGGER(log), None, None, None, None)
        where = where or (unit.folder / "resources").as_uri()
        self.c = unit.binary.fmi2Instantiate(name.encode(), 1, guid.encode(), where.encode(), c.byref(self.callbacks),
                                              0, 0)

    def call(self, name, *arguments, status=OK):
        found = getattr(self.unit.binary, "fmi2" + name)(c.c_void_p(self.c), *arguments)
        assert found == status, f"{name}: status {found}, {self.told}"

    def initialise(self, start=0.0):
        self.call("SetupExperiment", 0, c.c_double(0), c.c_double(start), 0, c.c_double(0))
        self.call("EnterInitializationMode")
        self.call("ExitInitializationMode")
        return self

    def get(self, *names):
        count = len(names)
        references = (c.c_uint * count)(*(self.unit.reference[name] for name in names))
        values = (c.c_double * count)()
        self.call("GetReal", references, c.c_size_t(count), values)
        return list(values)

    def set(self, name, value, status=OK):
        self.call("SetReal", (c.c_uint * 1)(self.unit.reference[name]), c.c_size_t(1), (c.c_double * 1)(value),
                  status=status)

    def step(self, time, step, status=OK):
        self.call("DoStep", c.c_double(time), c.c_double(step), 1, status=status)

    def keep(self):
        state = c.c_void_p()
        self.call("GetFMUstate", c.byref(state))
        return state

    def back(self, state):
        self.call("SetFMUstate", state)

    def forget(self, state):
        self.call("FreeFMUstate", c.byref(state))
        assert not state.value

    def bytes_of(self, state):
        size = c.c_size_t()
        self.call("SerializedFMUstateSize", state, c.byref(size))
        data = (c.c_char * size.value)()
        self.call("SerializeFMUstate", state, data, size)
        return bytes(data)

    def from_bytes(self, data, status=OK):
        state = c.c_void_p()
        self.call("DeSerializeFMUstate", data, c.c_size_t(len(data)), c.byref(state), status=status)
        return state

    def free(self):
        self.unit.binary.fmi2FreeInstance(c.c_void_p(self.c))


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
