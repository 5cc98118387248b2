#!/usr/bin/env python3
"""The supply ship as a unit of FMI 2.0 and of 3.0, steered by a controller outside, is to the bit what the same
controller in C makes of it (examples/positioning.c), and goes back to any of its states."""

import ctypes as c
import os
import pathlib
import random
import subprocess
import sys
import tempfile

from unit import Unit, World

FRAM, BUILD = os.environ["FRAM"], pathlib.Path(os.environ["FRAM_BUILD"])
if os.environ.get("FRAM_TEST_SANITIZE"):
    print("skipped: a unit under sanitizers is not loaded by a Python without them")
    sys.exit(77)
SECONDS, ROLL_BACKS = 20, 1000
SCENE = "scenes/supply_ship.yaml"
# The part of the field that the ship sees in so short a time.
SMALLER = ("domain.x_min=-90", "domain.x_max=90", "domain.y_min=-60", "domain.y_max=60", "ice.concentration=0.75")
MAGIC = b"FRAMTAB\n"  # where the world begins in a serialized state
OUTPUTS = ("offset_x", "offset_y", "heading_deviation", "velocity_x", "ice_force_x", "ice_force_y", "contacts",
           "kinetic_energy")


def within(value, most):
    return most if value > most else -most if value < -most else value


def steer(ship):
    """What examples/positioning.c does, in the same order of operations."""
    x, y, heading, u, v = ship.get("offset_x", "offset_y", "heading_deviation", "velocity_x", "velocity_y")
    surge, sway, yaw = -6e4 * x - 9e5 * u, -6e4 * y - 9e5 * v, -1.5e6 * heading
    for i in (1, 2, 3, 4):
        ship.set(f"thruster_{i}_order", within(0.25 * sway + (1 if i <= 2 else -1) * 0.25 * yaw / 26, 2e5))
    for i in (5, 6):
        ship.set(f"thruster_{i}_order", within(0.5 * surge, 7e5))


def control(ship, step, steps):
    if step == 0:
        ship.set("positioning", 0)
    if step == steps // 2:
        ship.set("positioning", 1)
        ship.set("set_point_y", 2)
    if step < steps // 2:
        steer(ship)


def hash_of(world, data):
    """The state hash of a unit's serialized state, taken over by a world of libfram."""
    world.lib.fram_world_hash.restype = c.c_uint64
    assert world.lib.fram_world_load_memory(world.c, data, c.c_size_t(len(data)), None) == 0
    return f"{world.lib.fram_world_hash(world.c):016x}"


def against_c(unit):
    told = subprocess.run([BUILD / "examples/positioning", SCENE, str(SECONDS), *SMALLER], capture_output=True,
                          text=True, check=True).stdout.split("\n")
    ship, dt = unit.instance().initialise(), unit.step_size
    steps, loads, yaws = int(SECONDS / dt + 0.5), 0, set()
    for step in range(steps):
        control(ship, step, steps)
        ship.step(step * dt, dt)
        found, expected = ship.get(*OUTPUTS), [float.fromhex(word) for word in told[step].split()]
        assert found == expected, f"step {step}: {found} in the unit, {expected} in C"
        loads += found[4] != 0 or found[5] != 0
        yaws.add(found[2])
    assert loads > steps // 10 and len(yaws) > steps // 2, f"a dull scene: {loads} steps with ice loads"
    # The unit's scenario is the scene; its state, told in bytes, has the hash that the C program printed.
    state = ship.keep()
    data = ship.bytes_of(state)
    ship.forget(state)
    world = World(BUILD / "libfram.so", unit.folder / "resources/scenario.yaml")
    head = data.index(MAGIC)
    assert hash_of(world, data[head:]) == told[steps], f"another hash than {told[steps]}"
    world.free()
    ship.free()
    print(f"{steps} steps, {loads} with ice loads: outputs and state hash {told[steps]} equal those of the C program")


def roll_backs(unit):
    """Ahead by random orders, back, and ahead again: each time the same outputs."""
    rng, dt, step = random.Random(11), unit.step_size, 0
    ship = unit.instance().initialise()
    ship.set("positioning", 0)
    for _ in range(ROLL_BACKS):
        state, before = ship.keep(), ship.get(*OUTPUTS)
        orders, steps = [rng.uniform(-7e5, 7e5) for _ in range(6)], rng.randint(1, 4)

        def ahead():
            for number, order in enumerate(orders, start=1):
                ship.set(f"thruster_{number}_order", order)
            ship.step(step * dt, steps * dt)
            return ship.get(*OUTPUTS)

        first = ahead()
        ship.back(state)
        assert ship.get(*OUTPUTS) == before
        assert ahead() == first, f"at step {step}"
        if rng.random() < 0.7:
            ship.back(state)
        else:
            step += steps
        ship.forget(state)
    ship.free()
    print(f"{ROLL_BACKS} roll-backs up to {step * dt:g} s: equal to the bit")


def main():
    with tempfile.TemporaryDirectory() as folder:
        words = [word for text in SMALLER for word in ("--set", text)]
        for version in "2", "3":
            path = pathlib.Path(folder) / f"supply_{version}.fmu"
            subprocess.run([FRAM, "fmu", SCENE, "-o", path, "-q", "--fmi", version, *words], check=True)
            unit = Unit(path, pathlib.Path(folder) / f"unpacked_{version}")
            print(f"FMI {version}.0")
            against_c(unit)
            roll_backs(unit)


main()
