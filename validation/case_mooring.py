"""A mooring line against the catenary."""

import math

import ladder

LONG = False
WEIGHT, DEPTH, PULL = 1000.0, 50.0, 400e3
STIFFNESS, PIECE = 5.0e8, 0.1  # of the elastic line [N]; of what is added up along it [m]


def suspended(pull):
    """Length and horizontal distance of the part that hangs, and the tension at its upper end."""
    c = pull / WEIGHT
    length = math.sqrt(DEPTH**2 + 2 * DEPTH * c)
    return length, c * math.asinh(length / c), pull + WEIGHT * DEPTH


LENGTH = suspended(PULL)[0] + 100  # of the line: 100 m lie on the bottom at the pull of the source


def distance(pull):
    """From anchor to upper end, inextensible."""
    length, way, _ = suspended(pull)
    return LENGTH - length + way


def stretched(pull):
    """Distance of an elastic line, and the tension at its upper end.

    By Hooke's law a piece that was PIECE long is longer by its own tension over STIFFNESS, and lies along that tension:
    `pull`, and the weight of what hangs under it.  Pieces are added up from the bottom on until they reach the top."""
    way = height = hung = 0.0
    while height < DEPTH:
        carried = WEIGHT * (hung + PIECE / 2)
        along = math.hypot(pull, carried)
        longer = PIECE * (1 + along / STIFFNESS)
        rise = longer * carried / along
        part = min(1.0, (DEPTH - height) / rise)
        way, height, hung = way + part * longer * pull / along, height + part * rise, hung + part * PIECE
        if part < 1:
            break
    lying = (LENGTH - hung) * (1 + pull / STIFFNESS)  # without friction on the bottom
    return lying + way, math.hypot(pull, WEIGHT * hung)


def stretched_tension(at):
    """The tension of the elastic line whose anchor is `at` metres away."""
    low, high = 1e3, 1e6
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if stretched(middle)[0] < at else (low, middle)
    return stretched(low)[1]


def tension(at, anchored, stiffness="1.0e+15"):
    """Tension that Fram finds for a line whose anchor is `at` metres away; two, opposite, so that nothing moves."""
    text = f"""run: {{duration: 0.01, time_step: 0.01}}
ice: {{source: none}}
domain: {{boundary: open}}
vessel:
  mode: free
  hull: {{form: box, length: 60, beam: 18, draught: 4, freeboard: 6}}
  mooring:
    depth: {DEPTH}
    equilibrium: false
    lines:
      - {{count: 2, spacing_deg: 180, distance: {at:.17g}, length: {anchored:.17g}, weight: {WEIGHT},
         stiffness: {stiffness}}}
output: {{frame_interval: 0}}
"""
    return ladder.run(text, f"mooring/{at:.6f}_{stiffness}")["line_1_tension"][0]


def case(out):
    c = ladder.Case(
        "A mooring line",
        2,
        "Tension at the upper end of a line of 1 kN/m in 50 m of water, whose anchor is moved away: slack, with a "
        "part on the bottom, and taut; almost inextensible, and elastic.",
        "The catenary: H 400 kN gives 206.1553 m of hanging line over 197.9732 m and T = H + w d = 450 kN. Elastic: "
        "Hooke's law for each piece of the line, longer by its own tension over EA, added up in pieces of 0.1 m from "
        "the bottom to the top.",
        "1e-6 without elasticity. With EA = 500 MN the line is stretched by 0.09 % at 450 kN and the tension falls to "
        "that of Hooke's law within 1e-3.",
    )
    length, way, top = suspended(PULL)
    c.header = ["pull [kN]", "anchor at [m]", "tension by Fram [kN]", "exact [kN]", "relative difference",
                "elastic by Fram [kN]", "by Hooke's law [kN]", "relative difference"]
    off, elastic_off, curve = [], [], []
    for pull in (50e3, 100e3, 200e3, 400e3, 600e3, 800e3):
        found, exact = tension(distance(pull), LENGTH), suspended(pull)[2]
        elastic, hooke = tension(distance(pull), LENGTH, f"{STIFFNESS:.1e}"), stretched_tension(distance(pull))
        off.append(abs(found / exact - 1))
        elastic_off.append(abs(elastic / hooke - 1))
        curve.append((distance(pull), found, elastic))
        c.rows.append([f"{pull / 1e3:g}", f"{distance(pull):.4f}", f"{found / 1e3:.5f}", f"{exact / 1e3:.5f}",
                       f"{found / exact - 1:.1e}", f"{elastic / 1e3:.3f}", f"{hooke / 1e3:.3f}",
                       f"{elastic / hooke - 1:.1e}"])
    found = tension(way, length)
    c.rows.append(["400, nothing on the bottom", f"{way:.4f}", f"{found / 1e3:.5f}", f"{top / 1e3:.5f}",
                   f"{found / top - 1:.1e}", "", "", ""])
    off.append(abs(found / top - 1))
    c.check(abs(length - 206.1553) < 1e-4 and abs(way - 197.9732) < 1e-4, "closed form gives the source's numbers")
    c.check(all(e <= 1e-6 for e in off), f"tension: {max(off):.1e} off at most, 1e-6 allowed")
    c.check(all(e <= 1e-3 for e in elastic_off),
            f"tension of the elastic line: {max(elastic_off):.1e} off Hooke's law at most, 1e-3 allowed")
    c.check(all(b < a for _, a, b in curve), "an elastic line pulls less at the same distance")
    c.found = ("Lines are quasi-static: neither inertia nor drag of the line, no friction on the bottom (see the "
               "limits page).")

    def draw(axes):
        pulls = [40e3 * 1.06**k for k in range(53)]
        axes.plot([distance(p) for p in pulls], [suspended(p)[2] / 1e3 for p in pulls], "k", lw=2.5, alpha=0.3,
                  label="catenary")
        axes.plot([x for x, _, _ in curve], [t / 1e3 for _, t, _ in curve], "o", mfc="none", label="Fram, inextensible")
        axes.plot([x for x, _, _ in curve], [t / 1e3 for _, _, t in curve], "x", label="Fram, EA = 500 MN")
        axes.set(xlabel="anchor to upper end [m]", ylabel="tension [kN]", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "mooring", f"A line of {LENGTH:.1f} m in 50 m of water.", draw)
    return c
