"""Stress under the load at the edge of a semi-infinite sheet: the radial crack."""

import ladder

LONG = False
EXACT = [(0.05, 4.98671), (0.1, 3.95955), (0.2, 2.94937)]  # nu = 0.3, half disk


def case(out):
    c = ladder.Case(
        "Edge-loaded sheet, before it cracks",
        2,
        "sigma_yy h^2 / P under a half disk of radius a on the free edge, nu = 0.3: the value the simulation uses, "
        "and the tabulated exact integral.",
        "Westergaard's closed form and the exact plate on an elastic foundation.",
        "1 % between the closed form and the exact plate for a/l <= 0.3, where it is used; beyond, the exact table.",
    )
    c.header = ["a/l", "exact", "used by Fram", "difference", "table of Fram", "difference"]
    used_error = table_error = 0.0
    for a, exact in EXACT:
        now = ladder.answer("ice", "sheet", "--a-over-l", a, "--nu", 0.3)
        used, table = now["sigma_h2_over_P"] / exact - 1, now["exact_sigma_h2_over_P"] / exact - 1
        used_error, table_error = ladder.greatest(used_error, abs(used)), ladder.greatest(table_error, abs(table))
        c.rows.append([a, exact, now["sigma_h2_over_P"], f"{100 * used:.2f} %", now["exact_sigma_h2_over_P"],
                       f"{100 * table:.4f} %"])
    c.check(used_error <= 0.01, f"the value in use: {100 * used_error:.2f} % at most, 1 % allowed")
    c.check(table_error <= 1e-5, f"the table: {table_error:.1e} at most, 1e-5 allowed")
    radii = [0.01 * 1.12**k for k in range(47)]
    found = [ladder.answer("ice", "sheet", "--a-over-l", a, "--nu", 0.3) for a in radii]

    def draw(axes):
        axes.plot(radii, [f["closed_form_sigma_h2_over_P"] for f in found], "--", label="closed form")
        axes.plot(radii, [f["exact_sigma_h2_over_P"] for f in found], label="exact, tabulated")
        axes.plot(radii, [f["sigma_h2_over_P"] for f in found], "k:", label="in use")
        axes.plot([a for a, _ in EXACT], [s for _, s in EXACT], "o", mfc="none")
        axes.set(xlabel="a / l", ylabel="sigma_yy h² / P", xscale="log")
        axes.legend()

    ladder.figure(c, out, "sheet", "Stress under the load; circles: the exact plate.", draw)
    return c
