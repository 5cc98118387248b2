"""The time step in a field of floes that break: numbers of breaks, means and largest loads."""

import statistics

import ladder

LONG = True
STEPS = [0.04, 0.02, 0.01, 0.005]  # s
SEEDS = range(1, 17)
BEGIN, END = 4.0, 16.0
RULES = ("response", "step")
# Set before the first run of this case: between the two shortest steps.
MEANS_WITHIN, LARGEST_WITHIN, BREAKS_WITHIN = 0.05, 0.10, 0.10
SCENE = f"""run: {{duration: {END}, transient: {BEGIN}}}
domain: {{x_min: -80, x_max: 60, y_min: -40, y_max: 40}}
vessel: {{mode: towed, x: -45, speed: 2, hull: {{length: 48, beam: 12, draught: 4}}}}
ice:
  source: voronoi
  concentration: 0.88
  mean_floe_area: 150
  thickness: 0.35
  breakable: true
output: {{frame_interval: 0, checkpoint_interval: 0}}
"""


def jobs():
    return [(SCENE, f"field_steps/{rule}_{dt:g}_{seed}",
             {"run__time_step": dt, "run__seed": seed, "ice__fracture__load_over": rule,
              "output__csv_interval": dt})
            for rule in RULES for dt in STEPS for seed in SEEDS]


def found(rule, dt, series):
    """Bending failures, splits, mean load, largest half-second mean and largest load of a step [kN]: means of the seeds
    with standard errors."""
    each = []
    for seed in SEEDS:
        run = next(series)
        kinds = ladder.fractures(f"field_steps/{rule}_{dt:g}_{seed}")["kind"]
        averaged = [-f / 1e3 for f in ladder.after(run, "ice_force_averaged_x", BEGIN)]
        raw = [-f / 1e3 for f in ladder.after(run, "ice_force_x", BEGIN)]
        each.append((kinds.count(2), kinds.count(1), statistics.fmean(raw), ladder.greatest(averaged),
                     ladder.greatest(raw)))
    return ladder.means_and_errors(each)


def case(out):
    c = ladder.Case(
        "Time step in a field of floes that break",
        3,
        "An icebreaker of 48 m towed at 2 m/s through 88 % of floes of 150 m2 and 0.35 m, 140 m by 80 m, walls around; "
        f"breaks in {END:g} s and loads from {BEGIN:g} s on, {len(SEEDS)} seeds, with steps of "
        f"{', '.join(f'{dt:g}' for dt in STEPS)} s. A floe breaks by its load over the time in which its edge responds "
        "(`load_over: response`, the default), or by the impulse of one step over that step (`step`, the reference's).",
        "Numerical convergence ([0176](../decisions/0176-edges-take-time-to-respond.md)).",
        f"By default, from steps of {STEPS[-2]:g} to {STEPS[-1]:g} s the numbers of breaks stay within "
        f"{100 * BREAKS_WITHIN:g} %, the mean within {100 * MEANS_WITHIN:g} %, the largest half-second mean within "
        f"{100 * LARGEST_WITHIN:g} %, and two standard errors of the difference. By `step` floes bend the more often "
        "the shorter the step. Largest loads of one step are impulses over the step where nothing limits them.",
    )
    c.header = ["rule", "step [s]", "bendings", "splits", "mean [kN]", "largest half-second mean [kN]",
                "largest of a step [kN]"]
    series = iter(ladder.run_all(jobs()))
    table = {(rule, dt): found(rule, dt, series) for rule in RULES for dt in STEPS}
    for (rule, dt), columns in table.items():
        c.rows.append([rule, dt, *(f"{mean:.1f} ± {error:.1f}" for mean, error in columns)])
    longer, shorter = table["response", STEPS[-2]], table["response", STEPS[-1]]
    for at, name, within in ((0, "bendings", BREAKS_WITHIN), (1, "splits", BREAKS_WITHIN), (2, "mean", MEANS_WITHIN),
                             (3, "largest half-second mean", LARGEST_WITHIN)):
        off = longer[at][0] / shorter[at][0] - 1
        doubt = 2 * (longer[at][1] ** 2 + shorter[at][1] ** 2) ** 0.5 / shorter[at][0]
        c.check(abs(off) <= within + doubt, f"{name}: with steps of {STEPS[-2]:g} s {100 * off:+.0f} % of that with "
                                            f"{STEPS[-1]:g}, two standard errors {100 * doubt:.0f} %")
    grows = {rule: table[rule, STEPS[-1]][0][0] / table[rule, STEPS[0]][0][0] for rule in RULES}
    c.check(grows["step"] > 1.3 and grows["response"] < grows["step"],
            f"bendings from steps of {STEPS[0]:g} to {STEPS[-1]:g} s: {grows['response']:.2f} times by `response`, "
            f"{grows['step']:.2f} times by `step`")

    def draw(axes):
        for rule, mark in zip(RULES, "os"):
            for ax, at in zip(axes, (0, 3)):
                means, errors = zip(*(table[rule, dt][at] for dt in STEPS))
                ax.errorbar([1e3 * dt for dt in STEPS], means, yerr=[2 * e for e in errors], marker=mark, capsize=3,
                            label=rule)
        axes[0].set(xlabel="time step [ms]", ylabel="bending failures", ylim=(0, None), xlim=(0, None))
        axes[1].set(xlabel="time step [ms]", ylabel="largest half-second mean [kN]", ylim=(0, None), xlim=(0, None))
        axes[0].legend()

    ladder.figure(c, out, "field_steps", "Bending failures and largest loads against the time step, two standard "
                  "errors.", draw, panels=2)
    return c
