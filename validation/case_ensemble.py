"""A crowd of runs: single runs part ways, their mean must not depend on the numerics."""

import demo_field
import ladder

LONG = True
SEEDS = range(1, 17)


def case(out):
    c = ladder.Case(
        "Numerics and the mean load",
        3,
        "Mean ice resistance of the managed field's hull over 16 seeds: with the time step of the scene, with half "
        "of it, and "
        "with twice the sweeps of the solver.",
        "The differences between the three ensembles.",
        "Single runs are chaotic and differ; the means differ by less than 2 standard errors, and the standard error's "
        "95 % half-width is at most 10 % of the mean.",
    )
    found = {
        "as the scene": demo_field.means("base", SEEDS),
        "half the time step": demo_field.means("half_step", SEEDS, run__time_step=0.01),
        "twice the sweeps": demo_field.means("twice", SEEDS, run__solver__iterations=60,
                                             run__solver__position_iterations=20),
    }
    c.header = ["ensemble", "mean [kN]", "standard error [kN]", "95 % half-width / mean", "difference / its error"]
    base, base_error = ladder.mean_and_error(found["as the scene"])
    for name, values in found.items():
        mean, error = ladder.mean_and_error(values)
        apart = abs(mean - base) / (error**2 + base_error**2) ** 0.5
        c.rows.append([name, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", f"{196 * error / mean:.1f} %", f"{apart:.2f}"])
        c.check(1.96 * error <= 0.1 * mean, f"{name}: half-width {196 * error / mean:.1f} % of the mean, at most 10 %")
        if name != "as the scene":
            c.check(apart < 2, f"{name}: {apart:.2f} standard errors from the scene, less than 2")

    def draw(axes):
        for at, (name, values) in enumerate(found.items()):
            mean, error = ladder.mean_and_error(values)
            axes.plot([at + 0.01 * i for i in range(-8, 8)], [v / 1e3 for v in values], ".", color="grey")
            axes.errorbar([at + 0.15], [mean / 1e3], yerr=[1.96 * error / 1e3], fmt="o", capsize=4)
        axes.set_xticks(range(len(found)), list(found))
        axes.set(ylabel="mean resistance [kN]", ylim=(0, None))

    ladder.figure(c, out, "ensemble", "Each seed (grey), mean and 95 % interval.", draw)
    return c
