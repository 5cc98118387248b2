"""Sweeps of the solver and time step in a packed field: convergence of the load and of what is left over."""

import math

import demo_field
import ladder

LONG = True
SEEDS = range(1, 5)
SWEEPS = [5, 10, 20, 40, 80]
STEPS = [0.04, 0.02, 0.01]


def runs(name, **keys):
    jobs = [(demo_field.DEMO, f"demo/{name}_{seed}",
             {"run__seed": seed, "ice__concentration": 0.9, **demo_field.PLAIN, **keys}) for seed in SEEDS]
    return ladder.run_all(jobs)


def summary(series):
    """Mean load with its error over seeds, mean residual, mean of the largest overlap in a step."""
    loads = [[-f for f in ladder.after(s, "ice_force_x", demo_field.START)] for s in series]
    means = ladder.mean_and_error([sum(x) / len(x) for x in loads])

    def of(channel):
        values = [v for s in series for v in ladder.after(s, channel, demo_field.START)]
        return sum(values) / len(values)

    return means, of("solver_residual"), of("overlap_max")


def case(out):
    c = ladder.Case(
        "Sweeps and time step in a dense field",
        3,
        f"The managed field at 90 %, {len(SEEDS)} seeds: mean load, mean residual of the solver (largest "
        "complementarity "
        "error of a step) and mean largest overlap, for 5 to 80 sweeps of the fast solver and for three time steps.",
        "The runs themselves; load compared with that of 80 sweeps.",
        "The residual falls with the sweeps. The mean load from 20 sweeps on differs from that of 80 by less than "
        "2 standard errors; so do the time steps.",
    )
    c.header = ["sweeps", "dt [s]", "mean load [kN]", "standard error [kN]", "residual [mm/s]", "largest overlap [mm]"]
    found = {}
    for n in SWEEPS:
        found[n] = summary(runs(f"sweeps_{n}", run__solver__iterations=n))
    steps = {dt: summary(runs(f"dt90_{dt:g}", run__time_step=dt)) for dt in STEPS}
    for (n, dt), ((mean, error), residual, overlap) in [*(((n, 0.02), f) for n, f in found.items()),
                                                       *(((30, dt), f) for dt, f in steps.items())]:
        c.rows.append([n, dt, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", f"{1e3 * residual:.3f}",
                       f"{1e3 * overlap:.2f}"])

    def apart(a, b):
        return abs(a[0] - b[0]) / math.hypot(a[1], b[1])

    for n in SWEEPS[2:-1]:
        c.check(apart(found[n][0], found[80][0]) < 2, f"{n} sweeps: {apart(found[n][0], found[80][0]):.2f} standard "
                                                      "errors from 80")
    for dt in STEPS[:-1]:
        c.check(apart(steps[dt][0], steps[STEPS[-1]][0]) < 2,
                f"dt {dt}: {apart(steps[dt][0], steps[STEPS[-1]][0]):.2f} standard errors from dt {STEPS[-1]}")
    residuals = [found[n][1] for n in SWEEPS]
    orders = ladder.observed_order(residuals)
    c.found = (f"Observed orders of the residual in 1/sweeps: {', '.join(f'{o:.1f}' for o in orders)} for each "
               "doubling from 5 on.")
    c.check(residuals[-1] < residuals[0] / 4, f"residual falls {residuals[0] / residuals[-1]:.0f}-fold from 5 to 80 "
                                              f"sweeps")

    def draw(axes):
        loads = [found[n][0] for n in SWEEPS]
        axes[0].errorbar(SWEEPS, [m / 1e3 for m, _ in loads], yerr=[1.96 * e / 1e3 for _, e in loads], marker="o",
                         capsize=3)
        axes[0].set(xlabel="sweeps", ylabel="mean load [kN]", ylim=(0, None), xscale="log")
        axes[1].loglog(SWEEPS, [1e3 * r for r in residuals], "o-", label="residual [mm/s]")
        axes[1].loglog(SWEEPS, [1e3 * found[n][2] for n in SWEEPS], "s-", label="largest overlap [mm]")
        axes[1].set(xlabel="sweeps")
        axes[1].legend()
        for ax in axes:
            ax.set_xticks(SWEEPS, SWEEPS)
            ax.minorticks_off()

    ladder.figure(c, out, "iterations", "Load, residual and overlap against the number of sweeps.", draw, panels=2)
    return c
