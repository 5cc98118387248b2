"""Resistance against speed in broken ice, beside published formulas."""

import math

import demo_field
import ladder
from formulas import huang, zuev

LONG = True
SEEDS = range(1, 5)
SPEEDS = [1.0, 2.0, 3.0]


def case(out):
    c = ladder.Case(
        "Resistance in broken ice against speed",
        5,
        f"Mean ice resistance of the managed field's hull at 1, 2 and 3 m/s, {len(SEEDS)} seeds each.",
        "Zuev (channels full of broken ice) and Huang et al. 2021 (A rho_i B h v^2 C^1.5/Fn, A 0.20 for a container "
        "ship).",
        "Power of the speed between Huang's (1) and that of pure inertia (2), within a factor of 2.5 of the nearer "
        "formula: neither is for this hull, and Zuev's has a part that does not depend on speed (ice that is held).",
    )
    found = [ladder.mean_and_error(demo_field.means(f"vessel__speed_{v:g}", SEEDS, vessel__speed=v)) for v in SPEEDS]
    c.header = ["speed [m/s]", "Fram [kN]", "standard error [kN]", "Zuev [kN]", "Huang [kN]"]
    for v, (mean, error) in zip(SPEEDS, found):
        c.rows.append([v, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", f"{zuev(v) / 1e3:.1f}", f"{huang(v) / 1e3:.1f}"])
        near = min(abs(math.log(mean / f(v))) for f in (zuev, huang))
        c.check(near <= math.log(2.5), f"{v} m/s: within a factor of {math.exp(near):.2f} of the nearer formula")
    power = math.log(found[-1][0] / found[0][0]) / math.log(SPEEDS[-1] / SPEEDS[0])
    c.check(1 <= power <= 2, f"grows as v^{power:.2f}, expected 1 to 2")
    c.check(abs(zuev_example() / 379.8e3 - 1) < 2e-3, "Zuev's formula gives the source's example of 379.8 kN")

    def draw(axes):
        fine = [0.5 + 0.05 * i for i in range(60)]
        axes.errorbar(SPEEDS, [m / 1e3 for m, _ in found], yerr=[1.96 * e / 1e3 for _, e in found], marker="o",
                      capsize=3, label="Fram")
        axes.plot(fine, [zuev(v) / 1e3 for v in fine], "--", label="Zuev")
        axes.plot(fine, [huang(v) / 1e3 for v in fine], ":", label="Huang 2021")
        axes.set(xlabel="speed [m/s]", ylabel="mean resistance [kN]", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "broken_ice", "Mean resistance in broken ice of 80 %.", draw)
    return c


def zuev_example():
    """B 18 m, h 1 m, 1.5 m/s, S 0.8, 910 kg/m3."""
    f = 1.5 / math.sqrt(9.81)
    return 910 * 9.81 * 18 * (0.13 * 18 + 1.3 * f + 0.5 * f * f) * (2 - 0.8) * 0.8**2
