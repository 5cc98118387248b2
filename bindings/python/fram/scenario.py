"""Scenarios: what a run is told."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from ._arguments import absolute_of, call_of, flag_of, number_of, path_of, text_bytes_of
from ._library import UsageError, ffi, lib, new_error, owned, text_of
from .context import Context, context_of, default_context

if TYPE_CHECKING:
    from .runs import Run
    from .world import World

Overrides = Union[Mapping[str, Any], Sequence[str], str, None]


def _no_overrides(found: str) -> UsageError:
    return UsageError("usage", f"expected a mapping of keys to values, or texts like run.seed=7, found {found}",
                      key="overrides")


def _count_of(values: Any) -> str:
    """How many they are, for a message; a class, or an array of another library, may not say."""
    try:
        return f" of {len(values)} values"
    except TypeError:
        return ""


def _members(overrides: Any, mapping: bool) -> list:
    """Its items, or what it has in it."""
    try:
        return [(key, value) for key, value in overrides.items()] if mapping else list(overrides)
    except (TypeError, ValueError) as error:  # a class, an array of no dimension, items that are no pairs
        raise _no_overrides(f"{type(overrides).__name__} {overrides}") from error


def _override_texts(overrides: Overrides) -> list[bytes]:
    """{"run.seed": 7} or ["run.seed=7"] as the library takes them; what has items, as a row of pandas, is a mapping."""
    if overrides is None:
        return []
    if isinstance(overrides, (str, bytes, os.PathLike)):
        return [text_bytes_of("overrides", overrides)]
    if not hasattr(overrides, "items"):
        texts = _members(overrides, False)
        for text in texts:
            if not isinstance(text, (str, bytes, os.PathLike)):
                raise _no_overrides(f"{type(text).__name__} {text}")
        return [text_bytes_of("overrides", text) for text in texts]

    items = _members(overrides, True)
    for key, value in items:
        if getattr(value, "ndim", 0):  # a column of a whole table
            raise _no_overrides(f"{type(value).__name__}{_count_of(value)} for {key}")

    def word(value: Any) -> str:
        if isinstance(value, (bool, np.bool_)):
            return "true" if value else "false"
        return repr(float(value)) if isinstance(value, float) else str(value)

    # A path is written as the file system has it, whose bytes Python's str tells by the locale.
    return [text_bytes_of("overrides", f"{key}=") + path_of("overrides", value) if isinstance(value, os.PathLike)
            else text_bytes_of("overrides", f"{key}={word(value)}") for key, value in items]


def _read_again(how: str, what: bytes, base, overrides: list[bytes]) -> "Scenario":
    """What was pickled, in another process perhaps; its files are read there."""
    return Scenario._make(how, what, base, overrides, default_context())


class Scenario:
    """A scenario that was read and checked; it never changes.  Made by `load` or `from_text`."""

    def __init__(self, pointer, context: Context, origin: tuple):
        self._context, self._origin = context, origin
        self._pointer = owned(pointer, lib.fram_scenario_destroy, context._pointer)

    @classmethod
    def load(cls, path: Union[str, os.PathLike], overrides: Overrides = None,
             context: Optional[Context] = None) -> "Scenario":
        """Read a scenario file.

        overrides: values given over those of the file, ``{"run.seed": 7}``, a row of a pandas table or
        ``["run.seed=7"]``.  InputError says which file, line and key are wrong.
        """
        return cls._make("load", path_of("path", path), None, _override_texts(overrides),
                         context_of(context))

    @classmethod
    def from_text(cls, text: str, base: Union[str, os.PathLike, None] = None, overrides: Overrides = None,
                  context: Optional[Context] = None) -> "Scenario":
        """A scenario from YAML text; relative paths in it start from the folder `base` (default: the working one)."""
        folder = None if base is None else path_of("base", base)
        return cls._make("parse", text_bytes_of("text", text), folder, _override_texts(overrides),
                         context_of(context))

    @classmethod
    def _make(cls, how: str, what: bytes, base, overrides: list[bytes], context: Context) -> "Scenario":
        error, out = new_error(), ffi.new("fram_scenario **")
        keep = [ffi.new("char[]", text) for text in overrides]
        items = ffi.new("char *[]", keep) if keep else ffi.NULL
        if how == "load":
            status = lib.fram_scenario_load(context._pointer, what, items, len(keep), out, error)
        else:
            folder = ffi.NULL if base is None else ffi.new("char[]", base)
            status = lib.fram_scenario_parse(context._pointer, what, folder, items, len(keep), out, error)
        # Read again from where it was read, wherever the working folder is by then.
        origin = (how, os.path.abspath(what) if how == "load" else what,
                  os.path.abspath(base or b".") if how == "parse" else None, overrides)
        made = cls(out[0], context, origin) if status == 0 else None  # it goes when a callback's exception is raised
        context._check(status, error)
        return made

    def __copy__(self) -> "Scenario":
        return self  # it never changes

    def __deepcopy__(self, _memo) -> "Scenario":
        return self

    def __reduce__(self):
        if self._context is not default_context():
            raise TypeError("a scenario of a context of its own cannot be pickled; make it without a context")
        return _read_again, self._origin

    def replaced(self, overrides: Overrides) -> "Scenario":
        """The same scenario with further overrides, read again."""
        how, what, base, before = self._origin
        return self._make(how, what, base, before + _override_texts(overrides), self._context)

    @property
    def text(self) -> str:
        """The effective scenario as YAML, every default filled in."""
        return text_of(lib.fram_scenario_text(self._pointer))

    @property
    def notes(self) -> str:
        """What follows from the scenario for a reader's eye: lengths, loads, thresholds, warnings."""
        return text_of(lib.fram_scenario_notes(self._pointer))

    @property
    def hash(self) -> str:
        """64 hexadecimal digits that name the effective scenario."""
        return text_of(lib.fram_scenario_hash(self._pointer))

    @property
    def duration(self) -> float:
        """Simulated time of a run [s]."""
        return lib.fram_scenario_duration(self._pointer)

    @property
    def time_step(self) -> float:
        """Fixed time step of a run [s]."""
        return lib.fram_scenario_time_step(self._pointer)

    @property
    def files(self) -> dict[str, str]:
        """The files that the scenario names, by key, as absolute paths."""
        found, number = {}, 0
        while lib.fram_scenario_file(self._pointer, number) != ffi.NULL:
            key = text_of(lib.fram_scenario_file_key(self._pointer, number))
            found[key] = text_of(lib.fram_scenario_file(self._pointer, number))
            number += 1
        return found

    def check(self) -> None:
        """Make the vessel, not the ice; InputError for what cannot be, warnings to the context's log."""
        error = new_error()
        self._context._check(lib.fram_scenario_check(self._pointer, error), error)

    def world(self) -> "World":
        """A new world at time 0."""
        from .world import World
        error, out = new_error(), ffi.new("fram_world **")
        status = lib.fram_world_create(self._pointer, out, error)
        made = World(out[0], self) if status == 0 else None
        self._context._check(status, error)
        return made

    def run(self, folder: Union[str, os.PathLike], force: bool = False, until: Optional[float] = None,
            progress: Optional[Callable[[float, float], None]] = None) -> "Run":
        """Run to the end, or to the simulated time `until`, with all results in `folder`, as `fram run` does.

        force: also into a folder that is not empty.  progress: called as ``progress(time, end)`` a few times a
        second; an exception in it, or Ctrl-C at any time, ends the run with a checkpoint and is raised.
        """
        from .runs import open_run
        definition = ffi.new("fram_run_definition *")
        lib.fram_run_default(definition, ffi.sizeof("fram_run_definition"))
        path = absolute_of("folder", folder)
        name = ffi.new("char[]", path)
        definition.folder, definition.force = name, flag_of("force", force)
        definition.stop, progress = self._context._stop, call_of("progress", progress)
        if until is not None and not 0 < number_of("until", until, "a finite time after 0 s") < float("inf"):
            raise UsageError("usage", f"expected a finite time after 0 s, found {until}", key="until")
        definition.until = 0 if until is None else until

        @ffi.callback("void(void *, const fram_progress *)", onerror=self._context._keep_exception)
        def forward(_user, told):
            if progress is not None:  # without it Python still looks for Ctrl-C here
                progress(told.time, told.end)

        definition.progress = forward
        error = new_error()
        self._context._check(lib.fram_run(self._pointer, definition, ffi.NULL, error, 0), error)
        return open_run(os.fsdecode(path))
