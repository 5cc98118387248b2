"""Runs that `fram run` or a recorded world left in a folder."""

from __future__ import annotations

import array
import csv
import html
import json
import math
import os
import pathlib
import stat
import tempfile
from dataclasses import dataclass
from typing import IO, Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np

from ._arguments import absolute_of, list_of, names_of, number_of, numbers_of, path_of, refuse
from ._library import FileError, InputError, ffi, lib, new_error, text_of
from .context import Context, context_of, default_context

try:
    import pandas
except Exception:  # noqa: BLE001: also one that was built for another numpy
    pandas = None


@dataclass(frozen=True)
class Floe:
    """A floe, wall or vessel, or one of the hulls of a catamaran, seen from above: outline [m] and what the record
    tells of it."""

    outline: np.ndarray
    properties: Mapping[str, Any]


_TABLE_MOST = 16 << 30
_TEXT_MOST = 64 << 20
"""Bytes of a table, which are as many as the command reads, and of a scenario or a JSON object."""
_LINE_MOST = 1 << 20
"""Characters of a line of a table, as the command."""
_KINDS = ((stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a pipe"), (stat.S_ISSOCK, "a socket"))


def _open_text(path: pathlib.Path, most: int = _TABLE_MOST) -> IO[str]:
    """A regular file as text; bytes that are none become what no number and no key has.

    The folder may be one that somebody sent: nothing waits for a pipe's other end, or reads a device without an end.
    """
    try:
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0))
    except OSError as error:
        raise FileError("io", str(error), file=str(path)) from error
    about = os.fstat(descriptor)
    if not stat.S_ISREG(about.st_mode):
        os.close(descriptor)
        found = next((kind for is_such, kind in _KINDS if is_such(about.st_mode)), "a device")
        raise InputError("input", f"expected a regular file, found {found}", file=str(path))
    file = open(descriptor, encoding="utf-8", errors="surrogateescape", newline="")
    if about.st_size > most:
        file.close()
        raise InputError("input", f"expected a file of at most {most} bytes, found {about.st_size}", file=str(path))
    return file


def _read_text(path: pathlib.Path) -> str:
    """A whole file, with line ends as Python has them."""
    with _open_text(path, _TEXT_MOST) as file:
        try:
            text = file.read(_TEXT_MOST)
        except OSError as error:
            raise FileError("io", str(error), file=str(path)) from error
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _read_object(path: pathlib.Path) -> dict[str, Any]:
    """A JSON object in a file."""
    text = _read_text(path)
    try:
        found = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError("input", f"expected a JSON object: {error.msg}", file=str(path), line=error.lineno,
                         column=error.colno) from error
    except (RecursionError, ValueError) as error:  # nested without an end, a number of thousands of digits
        raise InputError("input", f"expected a JSON object: {error}", file=str(path)) from error
    if not isinstance(found, dict):
        raise InputError("input", f"expected a JSON object, found {type(found).__name__}", file=str(path), line=1)
    return found


def _heads(row: list[str], path: pathlib.Path, needed: Sequence[str]) -> dict[str, str]:
    """Units by name of a row of heads name[unit]."""
    units: dict[str, str] = {}
    for head in row:
        name, _, unit = head.partition("[")
        if name in units:
            raise InputError("input", "expected each column once, found two of this name", file=str(path), line=1,
                             key=name)
        units[name] = unit.rstrip("]")
    for name in needed:
        if name not in units:
            raise InputError("input", "expected a column of this name, found none", file=str(path), line=1, key=name)
    return units


def _lines(file: IO[str], path: pathlib.Path) -> Iterator[str]:
    """Lines that are whole: one without an end is still being written, and its last number may be half of one."""
    while line := file.readline(_LINE_MOST):
        if line[-1] in "\r\n":
            yield line
        elif len(line) >= _LINE_MOST:
            raise InputError("input", f"expected lines of less than {_LINE_MOST} characters", file=str(path))


def _rows(file: IO[str], path: pathlib.Path) -> Iterator[list[str]]:
    """The rows of a table, one at a time: as texts they take ten times what their numbers take."""
    try:
        for number, row in enumerate(csv.reader(_lines(file, path)), start=1):
            if number > 1 and "_" in "".join(row):  # 1_0 is a number of Python's, and of nobody else's
                raise InputError("input", "expected a row of numbers, found an underscore", file=str(path),
                                 line=number)
            yield row
    except csv.Error as error:
        raise InputError("input", f"expected rows of numbers: {error}", file=str(path)) from error
    except OSError as error:
        raise FileError("io", str(error), file=str(path)) from error


def _read_units(rows: Iterator[list[str]], path: pathlib.Path, needed: Sequence[str] = ()) -> dict[str, str]:
    """Units by name of the columns of a table with heads name[unit]."""
    heads = next(rows, None)
    if heads is None:
        raise InputError("input", "expected a row of heads, found an empty file", file=str(path), line=1)
    return _heads(heads, path, needed)


def _read_table(path: pathlib.Path, needed: Sequence[str] = (),
                kept: Optional[Sequence[str]] = None) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """Columns and units of a table with heads name[unit]; a last row that is not whole yet is left out.

    kept: names of the columns that are wanted, of those that are there; None: all.  Each row is looked at whole.
    """
    values = array.array("d")
    with _open_text(path) as file:
        rows = _rows(file, path)
        units = _read_units(rows, path, needed)
        at = [i for i, name in enumerate(units) if kept is None or name in kept]
        for number, row in enumerate(rows, start=2):
            try:
                if len(row) != len(units):
                    raise ValueError(f"there are {len(row)}")
                numbers = [float(word) for word in row]
            except ValueError as error:
                raise InputError("input", f"expected {len(units)} numbers: {error}", file=str(path),
                                 line=number) from error
            values.extend(numbers if kept is None else [numbers[i] for i in at])
    table = np.array(values).reshape(-1, max(len(at), 1))
    names = list(units)
    return {names[i]: table[:, k] for k, i in enumerate(at)}, units


def _going_on(angles: np.ndarray) -> np.ndarray:
    """Angles [deg] without the jump at half a turn."""
    known, values = np.isfinite(angles), angles.copy()
    turns = np.round(np.diff(angles[known], prepend=angles[known][:1]) / 360)
    values[known] -= 360 * np.cumsum(turns)
    return values


def _last_time(path: pathlib.Path) -> Optional[float]:
    """Time of the last whole row [s]; None without rows."""
    with _open_text(path) as file:
        at = list(_read_units(_rows(file, path), path, ["time"])).index("time")
        last = None
        for line in _lines(file, path):
            last = line
    try:
        return None if last is None else float(last.replace("_", "?").split(",")[at])
    except (IndexError, ValueError) as error:
        raise InputError("input", "expected a row of numbers at the end", file=str(path)) from error


FIELD_STYLES = {"floe": {}, "wall": {"facecolor": "#736b66"}, "vessel": {"facecolor": "#cc472e"}}
"""How `Run.plot_field` draws each kind, those below first, in the colours of a run's pictures."""


class Run:
    """The folder of a run, read when asked for; it may still be going on."""

    def __init__(self, folder: Union[str, os.PathLike], context: Optional[Context] = None):
        # The same run wherever the working folder is by then, here or where it is unpickled.
        self.folder = pathlib.Path(os.fsdecode(absolute_of("folder", folder)))
        self._context = context_of(context)
        if not (self.folder / "run.json").is_file():
            raise InputError("input", "expected the folder of a run, found no run.json in it", file=str(self.folder))

    @property
    def info(self) -> dict[str, Any]:
        """run.json: version, hashes, status, computing time."""
        return _read_object(self.folder / "run.json")

    @property
    def hash(self) -> str:
        """State hash at the end, as `World.hash`; InputError for a run that goes on or was killed."""
        found = self._known_hash()
        if found is None:
            raise InputError("input", "expected the state hash of a run, found none", key="state_hash",
                             file=str(self.folder / "run.json"))
        return found

    def _known_hash(self) -> Optional[str]:
        """None of a run that goes on or was killed: run.json has that of its beginning."""
        info = self.info
        return None if info.get("status") == "running" else info.get("state_hash")

    @property
    def scenario_text(self) -> str:
        """The effective scenario as YAML."""
        return _read_text(self.folder / "scenario.yaml")

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column of the series."""
        path = self.folder / "series.csv"
        with _open_text(path) as file:
            return _read_units(_rows(file, path), path)

    def columns(self, table: str = "series") -> dict[str, np.ndarray]:
        """The columns of series.csv or fractures.csv as numpy arrays."""
        if not isinstance(table, str):
            raise refuse("table", 'the name of a table, as "series" or "fractures"', table)
        path_of("table", table)
        return _read_table(self.folder / f"{table}.csv")[0]

    @property
    def series(self):
        """series.csv as a pandas DataFrame over time; without pandas, as `columns`.

        The index is the time too: ``to_csv(path, index=False)`` writes it once.
        """
        columns = _read_table(self.folder / "series.csv", ["time"])[0]
        if pandas is None:
            return columns
        # Without a name: the column alone is meant where tables are merged, sorted or grouped by "time".
        return pandas.DataFrame(columns).set_index("time", drop=False).rename_axis(None)

    @property
    def fractures(self):
        """fractures.csv, a row a broken floe: a pandas DataFrame, or without pandas a dict of arrays."""
        columns = self.columns("fractures")
        return columns if pandas is None else pandas.DataFrame(columns)

    def to_xarray(self):
        """The series as an xarray Dataset over time, with units as attributes, and the run's state hash if it has
        ended; ImportError without xarray."""
        import xarray
        columns, units = _read_table(self.folder / "series.csv", ["time"])
        time = columns.pop("time")
        data = xarray.Dataset({name: ("time", values, {"units": units[name]}) for name, values in columns.items()},
                              coords={"time": ("time", time, {"units": units["time"]})})
        found = self._known_hash()
        if found is not None:
            data.attrs["state_hash"] = found
        return data

    @property
    def station(self) -> Optional[dict[str, Any]]:
        """Results of station keeping (station.json) of the one vessel of a scenario, or None."""
        path = self.folder / "station.json"
        return _read_object(path) if path.exists() else None

    @property
    def stations(self) -> dict[str, dict[str, Any]]:
        """Results of station keeping by the name of the vessel; of a vessel without a name, as `station`, under ""."""
        found = {} if self.station is None else {"": self.station}
        for path in sorted(self.folder.glob("station-*.json")):
            found[path.stem.partition("-")[2]] = _read_object(path)
        return found

    @property
    def events(self) -> list[dict[str, Any]]:
        """What befell the vessels, in order of time: lines that parted, thrusters that failed, position lost, ships
        that were beset or left their track, approaches; of a list of vessels each with the name of its ``vessel``."""
        stations = self.stations
        found = [{**event, "vessel": name} if name else event
                 for name, station in stations.items() for event in station.get("events", [])]
        # Vessels that nothing keeps on station have theirs in run.json alone.
        found += [event for event in self.info.get("events", []) if event.get("vessel", "") not in stations]
        # What befell at no known time comes last.
        return sorted(found, key=lambda event: math.inf if event.get("time_s") is None else event["time_s"])

    def floes(self, time: float) -> list[Floe]:
        """Outlines of floes, walls and vessel at a time [s] of the record, between frames by interpolation (what breaks
        or leaves before the next frame goes on with its velocity); a hull that leaves water open between its parts has
        one for each, with the same properties."""
        moment = number_of("time", time, "a time [s]")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "field.geojson")
            error = new_error()
            self._context._check(lib.fram_export_geojson(self._context._pointer, os.fsencode(self.folder),
                                                         os.fsencode(path), moment, ffi.NULL, error, 0), error)
            with open(path, encoding="utf-8") as file:
                features = json.load(file)["features"]
        found = []
        for f in features:
            parts, many = f["geometry"]["coordinates"], f["geometry"]["type"] == "MultiPolygon"
            found += [Floe(np.array(part[0][:-1]), f["properties"]) for part in (parts if many else [parts])]
        return found

    def report(self, output: Union[str, os.PathLike, None] = None) -> str:
        """Write the run's HTML report; its path.

        output: a file that is there is replaced; one that the run is made of is a UsageError.
        """
        result, error = ffi.new("fram_result *"), new_error()
        where = ffi.NULL if output is None else ffi.new("char[]", path_of("output", output))
        self._context._check(lib.fram_report(self._context._pointer, os.fsencode(self.folder), where, False, result,
                                             error, ffi.sizeof("fram_result")), error)
        return text_of(result.path)

    def plot(self, channels: Union[str, Sequence[str]], axes=None):
        """Channels over time, by matplotlib; shown by a notebook.  Returns the axes."""
        import matplotlib.pyplot as pyplot
        names = names_of("channels", channels, "channels")
        columns, units = _read_table(self.folder / "series.csv", ["time"], ["time", *names])
        for name in names:
            if name not in columns:
                raise InputError("input", "the run has no such channel", key=name)
        axes = axes if axes is not None else pyplot.figure(figsize=(8, 3)).gca()
        for name in names:
            values = _going_on(columns[name]) if units[name] == "deg" else columns[name]
            axes.plot(columns["time"], values, label=f"{name} [{units[name]}]", linewidth=1)
        axes.set_xlabel("time [s]")
        axes.legend()
        return axes

    def plot_field(self, time: float, axes=None):
        """The ice from above at a time [s], walls in grey and vessels in red over it, by matplotlib.  Returns the
        axes."""
        floes = self.floes(time)
        for kind, style in FIELD_STYLES.items():
            axes = plot_outlines([floe.outline for floe in floes if floe.properties["kind"] == kind], axes, **style)
        return axes

    def _progress(self) -> dict[str, Any]:
        """`info` for who reads it; that of a run which goes on or was killed is of its beginning, its series go on."""
        info = self.info
        if info.get("status") != "running":
            return info
        try:
            time = _last_time(self.folder / "series.csv")
        except (InputError, FileError):
            time = None
        known = {key: value for key, value in info.items() if key not in ("steps", "state_hash")}
        return known if time is None else {**known, "time_s": time}

    def __repr__(self) -> str:
        try:
            info = self._progress()
        except (InputError, FileError):
            return f"<fram.Run {self.folder}: unreadable>"
        return f"<fram.Run {self.folder}: {info.get('status')} at t = {info.get('time_s')} s>"

    def __reduce__(self):
        if self._context is not default_context():
            raise TypeError("a run of a context of its own cannot be pickled; open it without a context")
        return Run, (self.folder,)

    def _repr_html_(self) -> str:
        info = self._progress()
        rows = "".join(f"<tr><td>{key}</td><td>{html.escape(str(info.get(key, '')))}</td></tr>"
                       for key in ("title", "status", "steps", "time_s", "wall_s", "state_hash"))
        return f"<table>{rows}</table>"


def plot_outlines(outlines, axes=None, **style):
    """Polygons from above, by matplotlib: of `World.outlines`, or a list of arrays.  Returns the axes."""
    import matplotlib.pyplot as pyplot
    from matplotlib.collections import PolyCollection
    found = [numbers_of("outlines", outline, "outlines of two columns")
             for outline in list_of("outlines", outlines, "a list of outlines")]
    if any(outline.ndim != 2 or outline.shape[1] != 2 for outline in found):
        raise refuse("outlines", "outlines of two columns", outlines)
    axes = axes if axes is not None else pyplot.figure(figsize=(6, 6)).gca()
    style = {"facecolor": "#dfe9f2", "edgecolor": "#33536b", "linewidth": 0.5, **style}
    axes.add_collection(PolyCollection(found, **style))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    return axes


def open_run(folder: Union[str, os.PathLike], context: Optional[Context] = None) -> Run:
    """The run in a folder, also as `fram.open`; InputError when there is none."""
    return Run(folder, context)
