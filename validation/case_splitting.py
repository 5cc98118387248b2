"""Splitting by fracture mechanics: the largest load of an edge crack in a floe."""

import math

import ladder

LONG = False
TOUGHNESS = 150e3
# Largest opening force over h K_IC sqrt(L), width over length of the floe (weight functions).
FACTORS = [(0.5, 0.1334), (1.0, 0.1869), (2.0, 0.2105), (3.0, 0.2107)]
LENGTHS = [20.0, 35.0, 50.0, 80.0]
SLOPE, PLATE, STRENGTH, END = 0.1, 3.0, 2e6, 1.5


def factor(ratio):
    """Straight between the source's values."""
    for (x, f), (y, g) in zip(FACTORS, FACTORS[1:]):
        if x <= ratio <= y:
            return f + (g - f) * (ratio - x) / (y - x)
    return FACTORS[-1][1]


def exact(length, width):
    return factor(width / length) * TOUGHNESS * math.sqrt(length)


def split_load(length, width, step):
    """In-plane load and kind of the first break of a fixed floe: a steep plate driven into the middle of one side."""
    hull, load = ladder.WORK / "splitting" / "plate.obj", exact(length, width)
    ladder.box_obj(hull, (-10, -PLATE / 2, -3), (0, PLATE / 2, 3), lambda x, y, z: (x + SLOPE * z, y, z))
    # The load grows in proportion to the way, up to the exact load at 0.6 of the time.  The flexural strength lets the
    # radial crack open well before the load at which the floe splits, and no wedge break by then.
    speed = load / STRENGTH / PLATE * SLOPE / (0.6 * END)
    text = f"""run: {{duration: {END}, time_step: {step}}}
domain: {{boundary: open}}
vessel: {{mode: prescribed, x: {-0.5 * SLOPE:.17g}, speed: {speed}, hull: {{form: file, file: {hull}}}}}
ice:
  source: floes
  breakable: true
  crush_trims: false
  crushing_strength: {STRENGTH}
  flexural_strength: {load * SLOPE / 0.4}
  friction: {{ice_hull_static: 0, ice_hull_kinetic: 0}}
  fracture: {{splitting: toughness, toughness: {TOUGHNESS}, narrowness: 100}}
  floes:
    - {{length: {length}, width: {width}, x: {length / 2}, elevation: 0, thickness: 1, fixed: true}}
output: {{frame_interval: 0}}
"""
    name = f"splitting/{length:g}_{width:g}_{step:g}"
    ladder.run(text, name)
    events = ladder.fractures(name)
    if not events["load"]:
        raise RuntimeError(f"the floe of {length} x {width} m does not break")
    return events["load"][0] / SLOPE, events["kind"][0], events["crack_length"][0]


def case(out):
    c = ladder.Case(
        "Splitting by fracture mechanics",
        2,
        "Fixed floes of 1 m, 20 to 80 m long, whose side meets a steep plate, frictionless, with the option "
        "`splitting: toughness` (K_IC 150 kPa m^0.5): the in-plane load at which the floe splits.",
        "Edge crack in a rectangular plate opened at its mouth: F = f h K_IC sqrt(L), f by width over length "
        "(0.1334 at 0.5, 0.1869 at 1, 0.2105 at 2).",
        "First order in dt: the floe splits in the first step at which the load is reached, so that the simulated "
        "load is above the exact one by less than a step's growth.",
    )
    c.header = ["floe [m]", "dt [s]", "load at splitting [kN]", "exact [kN]", "difference", "crack [m]"]
    steps, squares = (4e-3, 2e-3, 1e-3), []
    for length, width in [(50.0, 50.0), (50.0, 25.0), (50.0, 100.0), *((x, x) for x in LENGTHS if x != 50)]:
        want = exact(length, width)
        for step in steps if (length, width) == (50, 50) else steps[-1:]:
            load, kind, crack = split_load(length, width, step)
            c.rows.append([f"{length:g} x {width:g}", step, f"{load / 1e3:.2f}", f"{want / 1e3:.2f}",
                           f"{100 * (load / want - 1):.2f} %", f"{crack:.3f}"])
            c.check(kind == 1 and abs(crack / length - 1) < 1e-6 and -1e-6 <= load / want - 1 <= 2 * step / END,
                    f"{length:g} x {width:g} m, dt {step}: splits across at {100 * (load / want - 1):+.2f} % of the "
                    f"exact load, {200 * step / END:.2f} % allowed")
        if length == width:
            squares.append((length, load))
    c.found = ("This is the option. The default rule of the reference has no load at all: a radial crack runs through "
               "when it is shorter than S_k = 3 breaking radii, and never when it is longer.")

    def draw(axes):
        fine = [15 + i for i in range(71)]
        axes.plot(fine, [exact(x, x) / 1e3 for x in fine], "k", lw=2.5, alpha=0.3, label="exact, square floes")
        axes.plot([x for x, _ in squares], [f / 1e3 for _, f in squares], "o", mfc="none", label="Fram, dt = 1 ms")
        axes.set(xlabel="side of the floe [m]", ylabel="in-plane load [kN]", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "splitting", "In-plane load at which a square floe of 1 m splits.", draw)
    return c
