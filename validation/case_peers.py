"""The same scenes under Fram's three solvers, Bullet and ODE: the mean load on a ship."""

import argparse
import os
import shutil
import subprocess
import sys

import ladder

sys.path.insert(0, str(ladder.ROOT / "bench"))
import run_peers  # noqa: E402  (the benchmark's own driver: one place knows how the programs are built and called)

LONG = True
FLOES, SEEDS = 300, range(1, 7)
# Cover [%] and what judges there: the accurate solver takes minutes a run in a packed field.
JUDGES = {75: "accurate", 90: "sequential, 300 sweeps"}
OPTIONS = {"fram": str(ladder.FRAM), "dt": 0.02, "iterations": 30, "time": 20.0, "warm": 5.0,
           "core": f"0-{(os.cpu_count() or 1) - 1}", "programs": ("bullet_f64", "ode"), "box3d": None, "jolt": None}


def peers():
    """Programs of the other engines, or why there are none."""
    if not shutil.which("g++") or not shutil.which("pkg-config"):
        raise ladder.Skipped("g++ or pkg-config is not there to build the programs of Bullet and ODE")
    for module in ("bullet-float64", "ode"):
        if subprocess.run(["pkg-config", "--exists", module]).returncode != 0:
            raise ladder.Skipped(f"{module} is not installed; `tools/deps.sh --install peers` does it")
    built = run_peers.build_peers(argparse.Namespace(**OPTIONS))
    return {"Bullet (double)": built["bullet_f64"], "ODE": built["ode"]}


def load_of(programs, name, scene):
    """Mean load on the ship [kN]."""
    if name in programs:
        found = run_peers.run_peer(argparse.Namespace(**OPTIONS), programs[name], scene)
    else:
        solver, _, sweeps = name.removeprefix("Fram, ").partition(", ")
        options = argparse.Namespace(**{**OPTIONS, "solver": solver,
                                        "iterations": int(sweeps.split()[0]) if sweeps else OPTIONS["iterations"]})
        found = run_peers.run_fram(options, scene, OPTIONS["core"])
    return abs(found["ship_force_kN"])


def case(out):
    programs = peers()
    c = ladder.Case(
        "Mean load under other solvers and engines",
        4,
        f"A box ship of 80 x 20 m at constant speed through {FLOES} floes, 75 % in still water and 90 % packed by a "
        "current, in the same text scene and water model: Fram's fast and sequential solver, Bullet and ODE; "
        f"{len(SEEDS)} seeds, dt 0.02 s, {OPTIONS['iterations']} iterations, mean of 5 to 20 s.",
        "The reference on the same scenes: Fram's accurate solver (to 1e-6 m/s) at 75 %, 300 sweeps in contact order "
        "at "
        "90 %, where the accurate one takes minutes a run. Bullet 3.24 and ODE 0.16 (bench/peers).",
        "Fast and sequential within 2 standard errors of the reference. The other engines differ in friction (pyramid) "
        "and in contact points: within 20 % or 2 standard errors.",
    )
    c.header = ["cover [%]", "program", "mean load [kN]", "standard error [kN]", "difference from the reference "
                "(first row), paired [kN]",
                "over its standard error"]
    picture = {}
    for cover, judge in JUDGES.items():
        scenes = [run_peers.scene_of(FLOES, cover, seed) for seed in SEEDS]
        names = [*(f"Fram, {solver}" for solver in (judge, "fast", "sequential")), *programs]
        found = ladder.side_by_side(lambda job: load_of(programs, *job), [(n, s) for n in names for s in scenes])
        loads = {name: found[i * len(scenes): (i + 1) * len(scenes)] for i, name in enumerate(names)}
        best = loads[f"Fram, {judge}"]
        for name, values in loads.items():
            mean, error = ladder.mean_and_error(values)
            apart, of_apart = ladder.mean_and_error([a - b for a, b in zip(values, best)])
            sigmas = apart / of_apart if of_apart > 0 else 0.0
            c.rows.append([cover, name, f"{mean:.1f}", f"{error:.1f}", f"{apart:+.1f}", f"{sigmas:+.2f}"])
            if name in ("Fram, fast", "Fram, sequential"):
                c.check(abs(sigmas) < 2, f"{cover} %, {name}: {apart:+.1f} kN from the reference, {abs(sigmas):.2f} "
                                         "standard errors, less than 2")
            elif name in programs:
                share = apart / ladder.mean_and_error(best)[0]
                c.check(abs(share) <= 0.2 or abs(sigmas) < 2,
                        f"{cover} %, {name}: {100 * share:+.0f} % from the reference ({abs(sigmas):.2f} standard "
                        f"errors)")
        picture[cover] = loads

    def draw(axes):
        for ax, (cover, loads) in zip(axes, picture.items()):
            for at, (name, values) in enumerate(loads.items()):
                mean, error = ladder.mean_and_error(values)
                ax.plot([at] * len(values), values, ".", color="grey")
                ax.errorbar([at + 0.2], [mean], yerr=[1.96 * error], fmt="o", capsize=4)
            short = [n.replace("Fram, ", "").replace(" (double)", "") for n in loads]
            ax.set_xticks(range(len(loads)), ["reference", *short[1:]], rotation=25)
            ax.set(ylabel="mean load [kN]", title=f"{cover} %", ylim=(0, None))

    ladder.figure(c, out, "peers", "Each seed (grey), mean and 95 % interval; the reference is the table's first row.",
                  draw, panels=2)
    return c
