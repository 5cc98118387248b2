"""The time step in level ice that breaks: means, scatter, largest loads and numbers of breaks."""

import statistics

import ladder

LONG = True
STEPS = [0.04, 0.02, 0.01, 0.005]  # s
STARTS = (0.0, 1.2, 2.4)  # [m] farther back
BEGIN, END = 18.0, 45.0
# Set after a first run: what halving the scene's own step changes.
MEANS_WITHIN, LARGEST_WITHIN, BREAKS_WITHIN = 0.03, 0.10, 0.05


def jobs():
    scene = ladder.ROOT / "scenes" / "level_ice.yaml"
    return [(scene, f"steps/{dt:g}_{back:g}",
             {"run__time_step": dt, "vessel__x": -32 - back, "run__duration": END, "run__transient": 0,
              "output__frame_interval": 0, "output__checkpoint_interval": 0})
            for dt in STEPS for back in STARTS]


def found(dt, series):
    """Mean, standard deviation and largest half-second mean [kN] and number of breaks, as means of the starts with
    standard errors."""
    each = []
    for back in STARTS:
        loads = [-f / 1e3 for f in ladder.after(next(series), "ice_force_averaged_x", BEGIN)]
        e = ladder.fractures(f"steps/{dt:g}_{back:g}")
        breaks = sum(time >= BEGIN and kind == 2 for time, kind in zip(e["time"], e["kind"]))
        each.append((statistics.fmean(loads), statistics.pstdev(loads), max(loads), breaks))
    return ladder.means_and_errors(each)


def case(out):
    c = ladder.Case(
        "Time step in level ice that breaks",
        3,
        "Resistance of the icebreaker of `scenes/level_ice.yaml` (2 m/s, steps of 0.01 s) and bending failures from "
        f"{BEGIN:g} to {END:g} s with steps of {', '.join(f'{dt:g}' for dt in STEPS)} s, {len(STARTS)} starts each; "
        "loads averaged over half a second.",
        "Numerical convergence; the runs with the shortest step judge.",
        "Each break takes the step in which its criterion is first met, so loads that break are first order in the "
        f"step. Between the scene's own step and half of it the mean changes by less than {100 * MEANS_WITHIN:g} %, "
        f"the largest by less than {100 * LARGEST_WITHIN:g} %, the number of breaks by less than "
        f"{100 * BREAKS_WITHIN:g} %, and two standard errors of the difference (bounds set after a first run).",
    )
    c.header = ["step [s]", "mean [kN]", "standard error", "standard deviation [kN]", "largest [kN]", "standard error",
                "breaks", "standard error"]
    series = iter(ladder.run_all(jobs()))
    by_step = {dt: found(dt, series) for dt in STEPS}
    for dt, (mean, deviation, largest, breaks) in by_step.items():
        c.rows.append([dt, f"{mean[0]:.1f}", f"{mean[1]:.1f}", f"{deviation[0]:.1f}", f"{largest[0]:.0f}",
                       f"{largest[1]:.0f}", f"{breaks[0]:.1f}", f"{breaks[1]:.1f}"])
    own, half = by_step[STEPS[-2]], by_step[STEPS[-1]]
    for name, at, within in (("mean", 0, MEANS_WITHIN), ("largest", 2, LARGEST_WITHIN), ("breaks", 3, BREAKS_WITHIN)):
        off = own[at][0] / half[at][0] - 1
        doubt = 2 * (own[at][1] ** 2 + half[at][1] ** 2) ** 0.5 / half[at][0]
        c.check(abs(off) <= within + doubt, f"{name}: with steps of {STEPS[-2]:g} s {100 * off:+.1f} % of that with "
                                            f"{STEPS[-1]:g}, two standard errors {100 * doubt:.1f} %")

    def draw(axes):
        for at, label in ((0, "mean"), (1, "standard deviation"), (2, "largest")):
            axes.errorbar(STEPS, [by_step[dt][at][0] for dt in STEPS], yerr=[2 * by_step[dt][at][1] for dt in STEPS],
                          marker="o", capsize=3, label=label)
        axes.set(xlabel="time step [s]", ylabel="load [kN]", ylim=(0, None), xlim=(0, None))
        axes.legend(loc=(0.62, 0.25))  # between the curves

    ladder.figure(c, out, "steps", "Loads against the time step, two standard errors.", draw)
    return c
