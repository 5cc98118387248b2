"""The managed field and its hull, towed, with what is varied: the runs that several cases of the ladder share."""

import ladder

DEMO = ladder.ROOT / "scenes" / "managed_ice.yaml"
START = 15.0  # [s] run.transient of the scene
BEAM, THICKNESS, SPEED, CONCENTRATION = 20.0, 1.0, 2.0, 0.8  # of the scene
LENGTH, ICE_DENSITY, GRAVITY = 100.0, 910.0, 9.81
# Pictures and checkpoints are not looked at here.
PLAIN = {"output__frame_interval": 60, "output__checkpoint_interval": 0}


def resistances(name, seeds, **keys):
    """-ice_force_x over time after the start [N], one list a seed."""
    jobs = [(DEMO, f"demo/{name}_{seed}", {"run__seed": seed, **PLAIN, **keys}) for seed in seeds]
    return [[-f for f in ladder.after(s, "ice_force_x", START)] for s in ladder.run_all(jobs)]


def means(name, seeds, **keys):
    """Mean resistance of each seed [N]."""
    return [sum(r) / len(r) for r in resistances(name, seeds, **keys)]
