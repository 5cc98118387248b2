"""Resistance against concentration, beside published formulas for broken ice."""

import math

import demo_field
import ladder
from formulas import huang, zuev

LONG = True
SEEDS = range(1, 5)
COVERS = [0.5, 0.6, 0.7, 0.8, 0.9]


def case(out):
    c = ladder.Case(
        "Resistance against concentration",
        5,
        "Mean ice resistance of the managed field's hull in fields of 50 to 90 % (walls 150 m to either side), "
        "4 seeds each.",
        "Zuev's formula for channels of broken ice; Huang et al. (2021) for unbroken floe fields (a container ship). "
        "Neither is for this hull.",
        "Resistance grows with concentration, with a local exponent of 1.3 to 4 (published range over 0.4 to 0.9), and "
        "lies within a factor of 3 of one of the formulas.",
    )
    found = [ladder.mean_and_error(demo_field.means(f"cover_{cover:g}", SEEDS, ice__concentration=cover))
             for cover in COVERS]
    c.header = ["concentration", "Fram [kN]", "standard error [kN]", "local exponent", "Zuev [kN]", "Huang [kN]"]
    exponents = [math.log(b[0] / a[0]) / math.log(y / x)
                 for (a, b, x, y) in zip(found, found[1:], COVERS, COVERS[1:]) if a[0] > 0 and b[0] > 0]
    for i, (cover, (mean, error)) in enumerate(zip(COVERS, found)):
        exponent = f"{exponents[i - 1]:.2f}" if 0 < i <= len(exponents) else ""
        c.rows.append([cover, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", exponent, f"{zuev(cover=cover) / 1e3:.1f}",
                       f"{huang(cover=cover) / 1e3:.1f}"])
    overall = math.log(found[-1][0] / found[0][0]) / math.log(COVERS[-1] / COVERS[0])
    c.check(1.3 <= overall <= 4, f"exponent over the whole range {overall:.2f}, published 1.3 to 4")
    for exponent, low, high in zip(exponents, COVERS, COVERS[1:]):
        c.check(1.3 <= exponent <= 4, f"local exponent from {low} to {high} {exponent:.2f}, published 1.3 to 4")
    for cover, (mean, _) in zip(COVERS, found):
        near = min(abs(math.log(mean / f(cover=cover))) for f in (zuev, huang))
        c.check(near <= math.log(3), f"at {cover}: within a factor of {math.exp(near):.2f} of the nearer formula")

    def draw(axes):
        axes.errorbar(COVERS, [m / 1e3 for m, _ in found], yerr=[1.96 * e / 1e3 for _, e in found], marker="o",
                      capsize=3, label="Fram")
        axes.plot(COVERS, [zuev(cover=x) / 1e3 for x in COVERS], "--", label="Zuev")
        axes.plot(COVERS, [huang(cover=x) / 1e3 for x in COVERS], ":", label="Huang 2021")
        axes.set(xlabel="concentration", ylabel="mean resistance [kN]", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "concentration", "Mean resistance against concentration.", draw)
    return c
