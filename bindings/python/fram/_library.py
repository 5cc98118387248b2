"""libfram through cffi in ABI mode: the public headers are read, no compiler is needed.

The library is, in this order: what the environment variable FRAM_LIBRARY names, the one that the package carries, or
the system's ``libfram.so.0``.
"""

from __future__ import annotations

import atexit
import ctypes.util
import os
import pathlib
import re
import threading

import cffi

_HERE = pathlib.Path(__file__).resolve().parent
_HEADERS = ("error", "fram", "live", "results", "field", "hull", "ice")


def _header_folder() -> pathlib.Path:
    carried = _HERE / "include"
    return carried if carried.is_dir() else _HERE.parents[2] / "include" / "fram"


def _declarations() -> str:
    """The headers without comments, preprocessor lines and what is for compilers alone."""
    text = "".join((_header_folder() / f"{name}.h").read_text(encoding="utf-8") for name in _HEADERS)
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    text = re.sub(r'#ifdef __cplusplus.*?#endif', "", text, flags=re.S)
    text = re.sub(r"^[ \t]*#.*(\\\n.*)*$", "", text, flags=re.M)
    return text.replace("FRAM_API", "").replace("const volatile int", "int").replace("volatile int", "int")


def _library_path() -> str:
    asked = os.environ.get("FRAM_LIBRARY")
    if asked:
        return asked
    carried = _HERE / "lib" / "libfram.so.0"
    if carried.exists():
        return str(carried)
    found = ctypes.util.find_library("fram")
    if found:
        return found
    raise ImportError("libfram was not found: install the wheel of `make python`, or name it in FRAM_LIBRARY")


ffi = cffi.FFI()
ffi.cdef(_declarations())
lib = ffi.dlopen(_library_path())
# cffi finds a function when it is asked for first, and holds a lock meanwhile.  Python's collector may come just then
# and free a world, whose own calls, and those of a log that hears of it, would wait for that lock for ever.
for _name in dir(lib):
    getattr(lib, _name)


class FramError(Exception):
    """A call of the library failed.

    ``status`` is its word ("input", "usage", ...), ``message`` what was found and expected; ``file``, ``line``,
    ``column`` and ``key`` say where, and are empty or 0 where there is no place.
    """

    def __init__(self, status: str, message: str, file: str = "", line: int = 0, column: int = 0, key: str = ""):
        self.status, self.message = status, message
        self.file, self.line, self.column, self.key = file, line, column, key
        place = file + (f":{line}" if line else "") + (f":{column}" if line and column else "")
        super().__init__(": ".join(part for part in (place, key, message) if part))

    def __reduce__(self):
        return type(self), (self.status, self.message, self.file, self.line, self.column, self.key)


class UsageError(FramError, ValueError):
    """The call is wrong: an argument, or the order of calls."""


class InputError(FramError, ValueError):
    """A file or a value that was given is wrong.

    So is the name of a file or folder that is not there, or not for this user.
    """


class FileError(FramError, OSError):
    """The operating system refused to read or write what is there, as where a disk is full."""


class OutOfMemory(FramError, MemoryError):
    """There was no memory."""


class SimulationError(FramError, ArithmeticError):
    """The simulation went wrong: its state is not finite, or a body is too fast."""


class UnsupportedError(FramError, NotImplementedError):
    """This build of the library lacks an optional part."""


class InternalError(FramError, RuntimeError):
    """A defect in Fram itself."""


class Interrupted(FramError):
    """A run was stopped; it wrote a checkpoint."""


_KINDS = {lib.FRAM_ERROR_USAGE: UsageError, lib.FRAM_ERROR_INPUT: InputError, lib.FRAM_ERROR_IO: FileError,
          lib.FRAM_ERROR_MEMORY: OutOfMemory, lib.FRAM_ERROR_SIMULATION: SimulationError,
          lib.FRAM_ERROR_UNSUPPORTED: UnsupportedError, lib.FRAM_ERROR_INTERNAL: InternalError,
          lib.FRAM_INTERRUPTED: Interrupted}


def text_of(pointer) -> str:
    """A C string; names of files may hold bytes that are no UTF-8."""
    return ffi.string(pointer).decode("utf-8", "surrogateescape")


def encoded_of(name: str, encoded: bytes) -> bytes:
    """A text or a path for C, as bytes."""
    if b"\0" in encoded:
        raise UsageError("usage", "expected a text without NUL characters", key=name)
    return encoded


def check(status: int, error) -> None:
    """Raise what a status says."""
    if status == 0:
        return
    kind = _KINDS.get(status, FramError)
    raise kind(text_of(lib.fram_status_name(status)), text_of(error.message), text_of(error.file), error.line,
               error.column, text_of(error.key))


def new_error():
    """Room for an error."""
    return ffi.new("fram_error *")


# What the library made for Python: address -> (how it is destroyed, addresses of what it needs, Python objects that it
# uses), and an item for each that needs it.
# Python's collector destroys the members of a cycle in any order, a world after its context too; hence nothing is
# destroyed before what needs it, whatever the order in which it is asked for.  Threads take turns; the collector comes
# at any moment, in the middle of these functions too, and finds what they have in order.
_made: dict[int, tuple] = {}
_users: dict[int, list[None]] = {}
_unwanted: dict[int, object] = {}
_turn = threading.RLock()
_gone: list = []  # at the end of Python: what the library may still call


def _address(pointer) -> int:
    return int(ffi.cast("intptr_t", pointer))


def is_made(pointer) -> bool:
    """Whether what the library made is there still, and is this process's to end."""
    return _address(pointer) in _made


def _end(pointer) -> None:
    address = _address(pointer)
    with _turn:
        if address not in _made:
            return
        _unwanted[address] = pointer
        if _users.get(address):
            return
        found = _made.pop(address, None)
        _unwanted.pop(address, None)
        _users.pop(address, None)
    if found is None:
        return
    destroy, needs, _used = found
    destroy(pointer)
    for need in needs:
        with _turn:
            _users[need].pop()
            last = None if _users[need] else _unwanted.get(need)
        if last is not None:
            _end(last)


def owned(pointer, destroy, *needs, uses=None):
    """A pointer that is destroyed when Python has no more use of it, and before what it needs and uses is."""
    addresses = tuple(_address(need) for need in needs)
    with _turn:
        for address in addresses:
            _users.setdefault(address, []).append(None)
        _made[_address(pointer)] = (destroy, addresses, uses)
    return ffi.gc(pointer, _end)


def _leave() -> None:
    """At the end of Python recordings are ended; memory goes with the process, in no order that could be wrong."""
    for address, (destroy, _, _) in list(_made.items()):
        world = ffi.cast("fram_world *", address)
        if destroy == lib.fram_world_destroy and lib.fram_world_is_recorded(world):
            lib.fram_world_record_end(world, ffi.NULL, ffi.NULL, 0)
    _gone.extend(_made.values())
    _made.clear()


atexit.register(_leave)


def _leave_to_parent() -> None:
    """In a child of os.fork: nothing that the parent made is destroyed there, whose threads are not the child's."""
    global _turn
    _turn = threading.RLock()
    _gone.extend(_made.values())
    _made.clear()


os.register_at_fork(after_in_child=_leave_to_parent)


def version() -> str:
    """Version of the library."""
    return text_of(lib.fram_version())


def features() -> list[str]:
    """Names of the optional parts that the library was built with."""
    parts = text_of(lib.fram_features())
    return [] if parts == "none" else [part.split()[0] for part in parts.split(",")]
