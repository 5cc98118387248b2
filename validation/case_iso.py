"""Crushing of a sheet at a vertical structure, beside the pressure-area rule of ISO 19906."""

import ladder
import world

LONG = False
STRENGTH, CR = 2e6, 2.2e6
SOURCE = "ISO 19906: p = C_R (h/1 m)^n (w/h)^-0.16, C_R 2.2 MPa (1.8 to 2.8 by region)."
WIDTHS, THICKNESSES = [1, 2, 5, 10, 20, 50, 100], [0.5, 1.0, 1.5]


def iso(w, h):
    """Global load of ISO 19906 [N] with C_R = 2.2 MPa."""
    n = -0.5 + h / 5 if h < 1 else -0.3
    return CR * h**n * (w / h) ** -0.16 * w * h


def load(w, h, exponent):
    """Steady force on a vertical wall that is driven into a fixed floe."""
    text = f"""run: {{time_step: 0.01}}
environment: {{water: false}}
domain: {{boundary: open}}
vessel: {{mode: prescribed, x: -5, speed: 0.5, hull: {{form: box, length: 10, beam: {w}, draught: 5, freeboard: 5}}}}
ice:
  source: floes
  crushing_strength: {STRENGTH}
  crushing_exponent: {exponent}
  floes:
    - {{length: 30, width: {w + 40}, thickness: {h}, x: 15, elevation: 0, fixed: true}}
"""
    with world.World(text, "iso") as w_:
        w_.step(20)
        return -w_.ice_force()[0]


def case(out):
    c = ladder.Case(
        "Crushing at a vertical structure",
        5,
        "Load on a vertical wall of 1 to 100 m driven into ice of 0.5 to 1.5 m, with Fram's constant crushing strength "
        "(2 MPa) and with `ice.crushing_exponent` -0.16.",
        SOURCE,
        "Fram's load is sigma_c w h to rounding, and sigma_c (w h)^(1+e) with an exponent. A constant pressure "
        "must be too high for wide structures; how much is what this case is for. With the exponent 0.5 to 1.5 of "
        "the rule is required: a wide bound without a source.",
    )
    c.header = ["w [m]", "h [m]", "constant [MN]", "exponent -0.16 [MN]", "ISO [MN]", "constant / "
                                                                                      "ISO", "exponent / ISO"]
    found, worst = {}, 0.0
    for h in THICKNESSES:
        for w in WIDTHS:
            plain, law = load(w, h, 0), load(w, h, -0.16)
            found[w, h] = plain, law
            worst = ladder.greatest(worst, abs(plain / (STRENGTH * w * h) - 1),
                                    abs(law / (STRENGTH * (w * h) ** 0.84) - 1))
            c.rows.append([w, h, f"{plain / 1e6:.2f}", f"{law / 1e6:.2f}", f"{iso(w, h) / 1e6:.2f}",
                           f"{plain / iso(w, h):.2f}", f"{law / iso(w, h):.2f}"])
    c.check(abs(iso(5, 1) / 8.50271e6 - 1) < 1e-5, "the rule gives the source's 8.503 MN for 5 m in 1 m")
    c.check(worst <= 1e-9, f"Fram's own law: {worst:.0e} off at most")
    ratios = [found[w, h][0] / iso(w, h) for h in THICKNESSES for w in WIDTHS]
    laws = [found[w, h][1] / iso(w, h) for h in THICKNESSES for w in WIDTHS]
    c.check(ladder.least(laws) > 0.5 and ladder.greatest(laws) < 1.5,
            f"with the exponent: {min(laws):.2f} to {max(laws):.2f} of the rule, 0.5 to 1.5 expected")
    c.found = (f"Constant pressure gives {min(ratios):.2f} to {max(ratios):.2f} of the rule, growing with the width; "
               f"with the exponent {min(laws):.2f} to {max(laws):.2f}. Use the exponent for contacts wider than a "
               "few metres.")

    def draw(axes):
        import matplotlib.ticker

        fine = [10 ** (i / 25) for i in range(51)]
        axes.loglog(fine, [iso(w, 1.0) / w / 1e6 for w in fine], "k", label="ISO 19906, C_R 2.2 MPa")
        axes.loglog(WIDTHS, [found[w, 1.0][0] / w / 1e6 for w in WIDTHS], "o", mfc="none", label="Fram, constant 2 MPa")
        axes.loglog(WIDTHS, [found[w, 1.0][1] / w / 1e6 for w in WIDTHS], "x", label="Fram, exponent -0.16")
        axes.set(xlabel="width [m], ice of 1 m", ylabel="mean pressure [MPa]")
        axes.set_yticks([0.5, 1, 2, 3], ["0.5", "1", "2", "3"])
        axes.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axes.legend()

    ladder.figure(c, out, "iso", "Mean pressure on a vertical wall.", draw)
    return c
