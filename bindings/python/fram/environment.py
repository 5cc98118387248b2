"""A Gymnasium-style environment: reset, step and spaces by the contract that it documents, without needing it."""

from __future__ import annotations

from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from ._arguments import call_of, names_of, number_of, numbers_of, one_of, refuse, whole_of
from ._library import InputError, SimulationError, UsageError
from .scenario import Scenario
from .world import World


class Box:
    """A box of real numbers, as gymnasium.spaces.Box: low, high, shape, dtype, sample, contains."""

    def __init__(self, low, high, dtype=np.float64):
        try:
            dtype = np.dtype(dtype)
        except (TypeError, ValueError):  # UnicodeError too
            raise refuse("dtype", "a type of real numbers", dtype) from None
        if dtype.kind not in "biuf":
            raise refuse("dtype", "a type of real numbers", dtype)
        numbers_of("low", low)
        numbers_of("high", high)
        try:
            ends = np.broadcast_arrays(low, high)
        except ValueError:
            raise refuse("high", f"as many numbers as low has, {low}", high) from None
        self.low, self.high = (np.array(bound, dtype) for bound in ends)
        if np.any(self.low > self.high):
            raise InputError("input", f"expected low <= high, found {low} and {high}", key="low")
        self.shape, self.dtype = self.low.shape, dtype
        self._random = np.random.default_rng()

    def seed(self, seed: Optional[int] = None) -> None:
        """Begin the random numbers of `sample` anew."""
        self._random = np.random.default_rng(None if seed is None else
                                             whole_of("seed", seed, "a whole number from 0, or None", 0, 2**128 - 1))

    def sample(self) -> np.ndarray:
        """A random point; a side without end counts from -1 to 1, or to 1 beyond its other end."""
        low = np.where(np.isfinite(self.low), self.low, np.minimum(-1, self.high - 1))
        high = np.where(np.isfinite(self.high), self.high, np.maximum(1, self.low + 1))
        # By halves: the way from end to end of large bounds is no number.
        return np.asarray(2 * self._random.uniform(low / 2, high / 2), self.dtype)

    def contains(self, x: Any) -> bool:
        """Whether x is a point of the box."""
        try:
            x = numbers_of("x", x)
        except UsageError:
            return False
        return x.shape == self.shape and bool(np.all(x >= self.low) and np.all(x <= self.high))

    __contains__ = contains

    def __repr__(self) -> str:
        return f"Box({self.low}, {self.high}, {self.shape}, {self.dtype})"


def _box(low, high):
    try:
        from gymnasium.spaces import Box as Theirs
    except Exception:  # noqa: BLE001: also one that was built for another numpy
        return Box(low, high)
    return Theirs(np.asarray(low, np.float64), np.asarray(high, np.float64), dtype=np.float64)


OBSERVATIONS = ("offset_x", "offset_y", "heading_deviation", "velocity_x", "velocity_y", "angular_velocity_z",
                "ice_force_averaged_x", "ice_force_averaged_y")
"""What a controller of a station sees by default."""


def station_reward(world: World) -> float:
    """Less the horizontal offset [m], and a tenth of the deviation of the heading [deg]."""
    return -float(np.hypot(world["offset_x"], world["offset_y"]) + 0.1 * abs(world["heading_deviation"]))


def _names(key: str, given: Union[str, Sequence[str], None], default: Sequence[str], what: str) -> tuple[str, ...]:
    return tuple(default) if given is None else names_of(key, given, what)


def _limit(key: str, given: Optional[float], expected: str) -> float:
    """A number, infinite if need be; ranges are for who calls."""
    return float("inf") if given is None else number_of(key, given, expected)


ASTERN = 179.999
"""The greatest angle [deg] to either side: at 180 the sides would be one."""


def _half_turn(angle: float) -> float:
    """The angle from -180 to 180 [deg]."""
    return (angle + 180) % 360 - 180


def _around_bow(told: Callable[[float], float]) -> tuple[float, float]:
    """The least and the greatest angle [deg] of an azimuth, outside of a sector that reaches astern, if it has one.

    told: what an angle becomes.  That is the nearer edge within the sector, and so the other one from its middle on: as
    far as one of steps that double comes.
    """
    for side in (-ASTERN, ASTERN):
        edge = told(side)
        way = _half_turn(side - edge)
        if abs(way) < 1e-6:  # it may stand there
            continue
        while told(edge + way) == edge:
            way *= 2
        other = told(edge + way)
        low, high = (edge, other) if way < 0 else (other, edge)
        return (low if low <= 0 else low - 360), (high if high >= 0 else high + 360)
    return -ASTERN, ASTERN


class StationKeeping:
    """Keeping a vessel on station in ice by orders to its thrusters.

    actions: names of orders to thrusters (default: all), each scaled so that -1 to 1 is what it can do; of an azimuth
    whose forbidden sector covers astern, from edge to edge round by the bow.  They go evenly from the least to the
    greatest order: 0 is their middle, half of an azimuth's thrust and no rest; no thrust is -1 there, and
    (-low - high)/(high - low) of one with thrust astern.
    observations: names of channels.  interval: simulated time of one `step` [s], rounded to whole time steps.
    horizon: simulated time after which an episode is truncated [s].  offset_limit: an episode ends when the offset
    exceeds it [m].  reward: of the world after each step.
    """

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None
    spec = None

    def __init__(self, scenario: Scenario, actions: Optional[Sequence[str]] = None,
                 observations: Sequence[str] = OBSERVATIONS, interval: float = 0.5, horizon: Optional[float] = None,
                 offset_limit: float = float("inf"), reward: Callable[[World], float] = station_reward):
        self._scenario = one_of("scenario", scenario, Scenario)
        self._limit = _limit("offset_limit", offset_limit, "0 or more")
        self._reward = station_reward if reward is None else call_of("reward", reward)
        self._seed: Optional[int] = None
        self._first = scenario.world()
        inputs = self._first.inputs
        if "positioning" not in inputs:
            raise InputError("input", "expected one free vessel with thrusters, and no list of vessels", key="vessel")
        orders = tuple(name for name in inputs if name.startswith("thruster_") and "_order" in name)
        self.actions = _names("actions", actions, orders, "orders to thrusters")
        self.observations = _names("observations", observations, (), "channels or inputs")
        for name in self.actions:
            if name not in orders:
                raise InputError("input", f"expected orders to thrusters ({', '.join(orders)}), whose limits are known",
                                 key=name)
            if self.actions.count(name) > 1:
                raise InputError("input", "expected each order once: the last one alone would count", key=name)
        for name in self.observations:
            if name not in self._first:
                raise InputError("input", "the world has no such channel or input", key=name)
        if not 0 < number_of("interval", interval, "a time above 0") < float("inf"):
            raise InputError("input", f"expected a time above 0, found {interval}", key="interval")
        for name, limit in (("horizon", horizon), ("offset_limit", offset_limit)):
            if not _limit(name, limit, "0 or more") >= 0:
                raise InputError("input", f"expected 0 or more, found {limit}", key=name)
        self._ranges = np.array([self._range(name) for name in self.actions]).reshape(-1, 2)
        self._steps = max(1, round(interval / scenario.time_step))
        self.interval = self._steps * scenario.time_step
        self._horizon = scenario.duration if horizon is None else horizon
        self.action_space = _box(np.full(len(self.actions), -1.0), np.full(len(self.actions), 1.0))
        ends = np.full(len(self.observations), np.inf)
        self.observation_space = _box(-ends, ends)
        self.world: Optional[World] = None

    def _range(self, name: str) -> tuple[float, float]:
        """What an order can be at least and at most: the library limits it, and tells what it became."""
        with self._first.copy() as world:
            world["positioning"] = 0

            def told(value: float) -> float:
                world[name] = value
                return world[name]

            is_force = world.inputs[name].unit == "N"
            most = 1e15 if is_force else ASTERN
            low = told(-most)
            return (low, told(most)) if is_force or abs(low) < 90 else _around_bow(told)  # no rudder turns so far

    def _observe(self) -> np.ndarray:
        return np.array([self.world[name] for name in self.observations], np.float64)

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict] = None):
        """A new episode; a seed is that of the scenario (ice field, noise), without one the last episode begins again.

        Returns observation and info.
        """
        del options
        if seed is not None and not number_of("seed", seed, "a whole number").is_integer():
            raise InputError("input", f"expected a whole number, found {seed}", key="seed")
        if seed is not None and seed != self._seed:
            first = self._scenario.replaced({"run.seed": int(seed)}).world()
            self._first.close()
            self._first, self._seed = first, int(seed)
        if self.world is not None:
            self.world.close()
        self.world = self._first.copy()
        self.world["positioning"] = 0
        return self._observe(), {"hash": self.world.hash}

    def step(self, action):
        """Orders for one interval.  Returns observation, reward, terminated, truncated, info."""
        if self.world is None:
            raise UsageError("usage", "call reset before step", key="step")
        action = numbers_of("action", action, f"{len(self.actions)} finite numbers")
        if action.shape != (len(self.actions),) or not np.all(np.isfinite(action)):
            raise InputError("input", f"expected {len(self.actions)} finite numbers, found {action}", key="action")
        low, high = self._ranges[:, 0], self._ranges[:, 1]
        told = low + (np.clip(action, -1, 1) + 1) / 2 * (high - low)
        for name, value in zip(self.actions, told):
            self.world[name] = value
        info: dict[str, Any] = {}
        failed = False
        try:
            self.world.step(self._steps)
        except SimulationError as error:
            failed, info["error"] = True, str(error)
        offset = float(np.hypot(self.world["offset_x"], self.world["offset_y"]))
        info["time"] = self.world.time
        truncated = not failed and self.world.time >= self._horizon - 1e-9
        return self._observe(), self._reward(self.world), failed or offset > self._limit, truncated, info

    @property
    def unwrapped(self) -> "StationKeeping":
        """This environment, as that of a wrapper is asked for."""
        return self

    def __enter__(self) -> "StationKeeping":
        return self

    def __exit__(self, *_exception) -> None:
        self.close()

    def render(self) -> None:
        """Nothing is drawn; see `fram.plot_outlines`."""

    def close(self) -> None:
        """Free the worlds."""
        world, self.world = self.world, None
        try:
            if world is not None:
                world.close()
        finally:
            self._first.close()
