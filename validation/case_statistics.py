"""How many seeds a mean and a peak load ask for."""

import math

import demo_field
import ladder

LONG = True
SEEDS = range(1, 17)
LENGTHS = [11.25, 22.5, 45.0]  # [s] of each run that count
STEP = 0.02
WANTED = {"mean": 0.05, "significant": 0.15, "largest": 0.15}
FIGURES = {"mean": lambda r: sum(r) / len(r), "significant": ladder.significant, "largest": max}


def needed(cv, wanted):
    """Runs whose mean is within the wanted part of the true one in 95 % of all cases."""
    return math.ceil((1.96 * cv / wanted) ** 2)


def case(out):
    c = ladder.Case(
        "How many runs are enough",
        8,
        f"Mean, significant and largest resistance of {LENGTHS[0]:g}, {LENGTHS[1]:g} and {LENGTHS[2]:g} s of the "
        "managed field "
        f"over {len(SEEDS)} seeds, and from their scatter the number of seeds for a mean within 5 % and a peak within "
        "15 % (95 %).",
        "Statistics of independent runs: n = (1.96 cv / wanted)^2.",
        "None: this is a measurement for users, who plan their runs by it. The verdict says no more than that the "
        "scatter is smaller than the mean.",
    )
    runs = demo_field.resistances("base", SEEDS)
    c.header = ["load", "length of a run [s]", "mean of the seeds [kN]", "cv", "wanted", "seeds needed",
                "time in all [min]"]
    scatter = {name: [] for name in WANTED}
    for name, of in FIGURES.items():
        for length in LENGTHS:
            mean, error = ladder.mean_and_error([of(r[:round(length / STEP)]) for r in runs])
            cv = error * math.sqrt(len(runs)) / mean
            scatter[name].append(cv)
            need = needed(cv, WANTED[name])
            c.rows.append([name, length, f"{mean / 1e3:.1f}", f"{cv:.2f}", f"{100 * WANTED[name]:.0f} %", need,
                           f"{need * length / 60:.1f}"])
        c.check(cv < 1, f"{name}, {length:g} s: coefficient of variation {cv:.2f}, less than 1")
    c.found = (f"A mean within 5 % requires {needed(scatter['mean'][-1], 0.05)} runs of {LENGTHS[-1]:g} s or "
               f"{needed(scatter['mean'][0], 0.05)} of {LENGTHS[0]:g} s after the transient; a largest load within 15 "
               f"% for {needed(scatter['largest'][-1], 0.15)} runs of {LENGTHS[-1]:g} s. The largest load depends on "
               f"the length of the run: longer runs have larger ones.")

    def draw(axes):
        series = runs[0]
        axes[0].plot([demo_field.START + STEP * i for i in range(len(series))], [f / 1e3 for f in series], lw=0.6)
        axes[0].axhline(sum(series) / len(series) / 1e3, color="k", ls=":", label="its mean")
        axes[0].set(xlabel="time [s]", ylabel="resistance, first seed [kN]")
        axes[0].legend()
        for name, values in scatter.items():
            axes[1].plot(LENGTHS, values, "o-", label=name)
        axes[1].set(xlabel="length of a run [s]", ylabel="coefficient of variation over seeds", ylim=(0, None))
        axes[1].legend()

    ladder.figure(c, out, "statistics", "Resistance of the first seed; scatter of the seeds against the length of the "
                  "runs.", draw, panels=2)
    return c
