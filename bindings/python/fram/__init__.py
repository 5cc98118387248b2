"""Fram: vessels in sea ice.

    import fram

    world = fram.Scenario.load("scenes/demo.yaml", {"run.seed": 7}).world()
    world.step(100)
    print(world.time, world["ice_force_x"], world.hash)

Units are SI; the global frame has X, Y horizontal and Z up.  A failed call raises a `FramError` that tells file, line
and key.  One world is to be used from one thread at a time; a step releases Python's lock.
"""

from ._library import (FileError, FramError, InputError, InternalError, Interrupted, OutOfMemory, SimulationError,
                       UnsupportedError, UsageError, features, version)
from .context import Context
from .environment import Box, StationKeeping
from .runs import Floe, Run, open_run, plot_outlines
from .scenario import Scenario
from .world import Bodies, Channel, Outlines, Recording, Snapshot, View, World

open = open_run  # noqa: A001: fram.open(folder), as there is no better word for it
__version__ = version()
__all__ = ["Bodies", "Box", "Channel", "Context", "FileError", "Floe", "FramError", "InputError", "InternalError",
           "Interrupted", "OutOfMemory", "Outlines", "Recording", "Run", "Scenario", "SimulationError", "Snapshot",
           "StationKeeping", "UnsupportedError", "UsageError", "View", "World", "features", "open", "open_run",
           "plot_outlines", "version"]
