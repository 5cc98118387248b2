"""Trends that the literature agrees on."""

import demo_field
import ladder

LONG = True
SEEDS = range(1, 5)
# Key, values, what is expected of the mean resistance.
SWEEPS = [
    ("thickness", "ice__thickness", [0.5, 1.0, 1.5], "grows"),
    ("speed", "vessel__speed", [1.0, 2.0, 3.0], "grows"),
    ("friction of ice on the hull", "ice__friction__ice_hull_kinetic", [0.05, 0.10, 0.15], "grows"),
]


def case(out):
    c = ladder.Case(
        "Thickness, speed, friction",
        7,
        "Mean resistance of the managed field's hull, 4 seeds each, one parameter changed at a time; of friction on "
        "the hull the kinetic one, with a static one of 0.15.",
        "Published model tests and formulas of resistance in broken ice (Zuev, Huang 2021) agree on the signs.",
        "The mean grows from the first to the last value by more than 2 standard errors of the difference.",
    )
    c.header = ["parameter", "value", "mean [kN]", "standard error [kN]"]
    curves = {}
    for name, key, values, _ in SWEEPS:
        found = []
        for value in values:
            keys = {key: value}
            if key == "ice__friction__ice_hull_kinetic":
                keys["ice__friction__ice_hull_static"] = max(value, 0.15)
            mean, error = ladder.mean_and_error(demo_field.means(f"{key}_{value:g}", SEEDS, **keys))
            found.append((mean, error))
            c.rows.append([name, value, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}"])
        curves[name] = (values, found)
        rise = (found[-1][0] - found[0][0]) / (found[-1][1] ** 2 + found[0][1] ** 2) ** 0.5
        c.check(rise > 2, f"resistance grows with {name}: by {rise:.1f} standard errors")

    def draw(axes):
        for name, (values, found) in curves.items():
            axes.errorbar([v / values[1] for v in values], [m / 1e3 for m, _ in found],
                          yerr=[1.96 * e / 1e3 for _, e in found], marker="o", capsize=3, label=name)
        axes.set(xlabel="parameter / its middle value", ylabel="mean resistance [kN]", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "trends", "Mean resistance and 95 % intervals.", draw)
    return c
