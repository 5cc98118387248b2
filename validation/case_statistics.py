"""How many seeds a mean and a peak load ask for."""

import math

import demo_field
import ladder

LONG = True
SEEDS = range(1, 17)


def case(out):
    c = ladder.Case(
        "How many runs are enough",
        8,
        "Mean, significant and largest resistance of 45 s of the demo over 16 seeds, and from their scatter the number "
        "of seeds for a mean within 5 % and a peak within 15 % (95 %).",
        "Statistics of independent runs: n = (1.96 cv / wanted)^2.",
        "None: this is a measurement for users, who plan their runs by it. The verdict says no more than that the "
        "scatter is smaller than the mean.",
    )
    runs = demo_field.resistances("base", SEEDS)
    wanted = {"mean": 0.05, "significant": 0.15, "largest": 0.15}
    values = {"mean": [sum(r) / len(r) for r in runs], "significant": [ladder.significant(r) for r in runs],
              "largest": [max(r) for r in runs]}
    c.header = ["load", "mean of the seeds [kN]", "cv", "wanted", "seeds needed"]
    for name, of_seed in values.items():
        mean, error = ladder.mean_and_error(of_seed)
        cv = error * math.sqrt(len(of_seed)) / mean
        need = math.ceil((1.96 * cv / wanted[name]) ** 2)
        c.rows.append([name, f"{mean / 1e3:.1f}", f"{cv:.2f}", f"{100 * wanted[name]:.0f} %", need])
        c.check(cv < 1, f"{name}: coefficient of variation {cv:.2f}: a mean over seeds exists in practice")

    def draw(axes):
        series = runs[0]
        axes.plot([demo_field.START + 0.02 * i for i in range(len(series))], [f / 1e3 for f in series], lw=0.6)
        axes.axhline(values["mean"][0] / 1e3, color="k", ls=":", label="mean of this run")
        axes.set(xlabel="time [s]", ylabel="resistance [kN]")
        axes.legend()

    ladder.figure(c, out, "statistics", "Resistance of the first seed.", draw)
    return c
