"""Walls close by, and the size of the floes: what both do to the mean load of the managed field."""

import demo_field
import ladder

LONG = True
SEEDS = range(1, 5)
HALF_WIDTHS = [30, 50, 100, 150, 200]
AREAS = [50, 100, 200, 400]


def case(out):
    c = ladder.Case(
        "Confinement and floe size",
        7,
        "Mean resistance of the managed field's hull (beam 20 m, 80 %) between walls 30 to 200 m to either side, "
        f"and with floes of a mean area of 50 to 400 m2; {len(SEEDS)} seeds each.",
        "Model tests in basins of several widths: a field that cannot yield sideways loads more; larger floes at "
        "the same concentration load more (they are fewer and heavier, and jam).",
        "The load falls as the walls move away, and no longer changes by more than 2 standard errors from 150 to 200 "
        "m (the "
        "field size of the managed field is enough). Grows from the smallest floes to the largest.",
    )
    c.header = ["half width [m]", "mean floe area [m2]", "mean [kN]", "standard error [kN]"]
    by_width, by_area = [], []
    for half in HALF_WIDTHS:
        by_width.append(ladder.mean_and_error(demo_field.means(f"width_{half}", SEEDS, domain__y_min=-half,
                                                               domain__y_max=half)))
        c.rows.append([half, 100, *(f"{x / 1e3:.1f}" for x in by_width[-1])])
    for area in AREAS:
        by_area.append(ladder.mean_and_error(demo_field.means(f"area_{area}", SEEDS, ice__mean_floe_area=area)))
        c.rows.append([150, area, *(f"{x / 1e3:.1f}" for x in by_area[-1])])

    def sigmas(a, b):
        return (b[0] - a[0]) / (a[1] ** 2 + b[1] ** 2) ** 0.5

    c.check(sigmas(by_width[-1], by_width[0]) > 2, f"walls at 30 m load more than at 200 m: "
                                                   f"{by_width[0][0] / by_width[-1][0]:.2f}"
            f" times, {sigmas(by_width[-1], by_width[0]):.1f} standard errors")
    last = sigmas(by_width[-2], by_width[-1])
    c.check(abs(last) < 2, f"150 and 200 m: {abs(last):.1f} standard errors apart, less than 2")
    c.check(sigmas(by_area[0], by_area[-1]) > 2, f"400 m2 loads more than 50 m2: {by_area[-1][0] / by_area[0][0]:.2f} "
                                                 f"times, "
            f"{sigmas(by_area[0], by_area[-1]):.1f} standard errors")

    def draw(axes):
        for ax, xs, found, label in ((axes[0], HALF_WIDTHS, by_width, "walls to either side [m]"),
                                     (axes[1], AREAS, by_area, "mean floe area [m²]")):
            ax.errorbar(xs, [m / 1e3 for m, _ in found], yerr=[1.96 * e / 1e3 for _, e in found], marker="o", capsize=3)
            ax.set(xlabel=label, ylabel="mean resistance [kN]", ylim=(0, None))

    ladder.figure(c, out, "confinement", "Mean resistance and 95 % intervals.", draw, panels=2)
    return c
