"""Nevel's wedge against its series."""

import ladder

LONG = False

# a/l, eta(0), x_max/l, C: Nevel 1961, from the exact series (40 digits), rounded.
ROWS = [
    (0.02, 2.163818617915, 0.2808643296747, 1.078441313397),
    (0.05, 2.127262063347, 0.3925105836296, 1.151137366693),
    (0.10, 2.067333645437, 0.5114858883249, 1.255469567682),
    (0.20, 1.951214140576, 0.6781105308157, 1.451822389831),
    (0.50, 1.632347223958, 1.035387852438, 2.101864701022),
    (1.00, 1.194259321462, 1.541472476599, 3.700604211907),
]


def case(out):
    c = ladder.Case(
        "Wedge beam on the water",
        2,
        "Capacity C, breaking radius x_max and tip deflection eta(0) of a wedge loaded over 0 < x < a, from the table "
        "that the simulation itself uses.",
        "D. E. Nevel (1961), The narrow free infinite wedge on an elastic foundation; values from its power series.",
        "1e-9: the table is interpolated, nothing is approximated.",
    )
    c.header = ["a/l", "C", "C by Fram", "x_max/l", "by Fram", "largest relative error"]
    worst = 0.0
    for a, eta, x, capacity in ROWS:
        now = ladder.answer("ice", "wedge", "--a-over-l", a)
        error = ladder.greatest(abs(now["capacity_C"] / capacity - 1), abs(now["x_max"] / x - 1),
                                abs(now["eta0"] / eta - 1))
        worst = ladder.greatest(worst, error)
        c.rows.append([a, f"{capacity:.9f}", f"{now['capacity_C']:.9f}", f"{x:.9f}", f"{now['x_max']:.9f}",
                       f"{error:.1e}"])
    c.check(worst <= 1e-9, f"largest relative error {worst:.1e}, at most 1e-9")
    radii = [0.005 * 1.2**k for k in range(33)]
    found = [ladder.answer("ice", "wedge", "--a-over-l", a) for a in radii]

    def draw(axes):
        axes.plot(radii, [f["capacity_C"] for f in found], label="C")
        axes.plot(radii, [f["x_max"] for f in found], label="x_max / l")
        axes.plot(radii, [0.97043 * a ** (1 / 3) for a in radii], "k:", label="0.970 (a/l)^(1/3)")
        axes.plot([r[0] for r in ROWS], [r[3] for r in ROWS], "o", mfc="none")
        axes.plot([r[0] for r in ROWS], [r[2] for r in ROWS], "o", mfc="none")
        axes.set(xlabel="a / l", ylabel="C, x_max / l", xscale="log", yscale="log")
        axes.set_yticks([0.2, 0.5, 1, 2, 5], ["0.2", "0.5", "1", "2", "5"])
        axes.legend()

    ladder.figure(c, out, "wedge", "Capacity and breaking radius of a wedge; circles: the series.", draw)
    return c
