"""Splitting by fracture mechanics: the largest load of an edge crack in a floe."""

import math

import ladder

LONG = False
TOUGHNESS = 150e3
LENGTHS = [20.0, 35.0, 50.0, 80.0]
SLOPE, PLATE, STRENGTH, END = 0.1, 3.0, 2e6, 1.5
STEMS = [15, 25, 40]  # half angles [deg]


def exact(length, width, place):
    """Opening force at which a floe splits, by finite elements on meshes made for it."""
    import splitting_factors  # stands on numpy, which other cases do without

    near = width / 2 - abs(place)
    factor = splitting_factors.factor(near / length, (width - near) / length)
    return factor * TOUGHNESS * math.sqrt(length)


def plate():
    """A steep plate, and its crushed area per metre that it goes into ice of 1 m, at first."""
    hull = ladder.WORK / "splitting" / "plate.obj"
    ladder.box_obj(hull, (-10, -PLATE / 2, -3), (0, PLATE / 2, 3), lambda x, y, z: (x + SLOPE * z, y, z))
    return hull, PLATE / SLOPE


def stem(half_angle):
    """An upright wedge, its edge at x = 0, and that area."""
    hull, slope = ladder.WORK / "splitting" / f"stem_{half_angle:g}.obj", math.tan(math.radians(half_angle))
    ladder.box_obj(hull, (-1, -1, -3), (0, 0, 3), lambda x, y, z: (5 * (x + y), 5 * slope * (y - x), z))
    return hull, 2 * slope


def split_load(length, width, place, load, step, half_angle=None):
    """In-plane load and kind of the first break of a fixed floe, whose side a steep plate or a stem meets."""
    hull, area = plate() if half_angle is None else stem(half_angle)
    begin = -0.5 * SLOPE if half_angle is None else 0
    # The load grows in proportion to the way, up to the exact load at 0.6 of the time.  The flexural strength lets
    # neither a radial crack open by then nor a wedge break.
    speed = load / STRENGTH / area / (0.6 * END)
    text = f"""run: {{duration: {END}, time_step: {step}}}
domain: {{boundary: open}}
vessel: {{mode: prescribed, x: {begin:.17g}, speed: {speed:.17g}, hull: {{form: file, file: {hull}}}}}
ice:
  source: floes
  breakable: true
  crush_trims: false
  crushing_strength: {STRENGTH}
  flexural_strength: {10 * load * SLOPE}
  friction: {{ice_hull_static: 0, ice_hull_kinetic: 0}}
  fracture: {{splitting: toughness, toughness: {TOUGHNESS}, narrowness: 100, edge_inertia: false}}
  floes:
    - {{length: {length}, width: {width}, x: {length / 2}, y: {-place}, elevation: 0, thickness: 1, fixed: true}}
output: {{frame_interval: 0}}
"""
    name = f"splitting/{length:g}_{width:g}_{place:g}_{step:g}_{half_angle or 'plate'}"
    ladder.run(text, name)
    events = ladder.fractures(name)
    if not events["load"]:
        raise RuntimeError(f"the floe of {length} x {width} m does not break")
    return events["load"][0], events["kind"][0], events["crack_length"][0]


def case(out):
    c = ladder.Case(
        "Splitting by fracture mechanics",
        2,
        "Fixed floes of 1 m, 20 to 80 m long, whose side meets a steep plate, frictionless, with the option "
        "`splitting: toughness` (K_IC 150 kPa m^0.5): the in-plane load at which the floe splits; bending does not "
        "reach its strength. And the same with upright stems. `narrowness` is 100, so that the floe of 60 x 80 m may "
        "split into one of 60 x 10 m: with the default, 4, it would not split at any load.",
        "Edge crack in a rectangular plate opened at its mouth: F = f h K_IC sqrt(L), f by finite elements, computed "
        "for each floe (`validation/splitting_factors.py`; 0.1334 at a width of 0.5 lengths, 0.1869 at 1, 0.2105 at "
        "2, as "
        "published). A frictionless stem of half angle b parts the ice by F/(2 tan b): it splits at 2 tan b of that "
        "load, where it is sharper than 53 degrees in all ([0557](../decisions/0557-what-parts-the-ice.md)).",
        "First order in dt: the floe splits in the first step at which the load is reached, so that the simulated "
        "load is above the exact one by less than a step's growth: by half of it with these steps.",
    )
    c.header = ["floe [m]", "stem [deg]", "off the middle [m]", "dt [s]", "load at splitting [kN]", "exact [kN]",
                "difference", "crack [m]"]
    # The exact load is met half a step late with each of them.
    steps = tuple(0.6 * END / (n - 0.5) for n in (225, 450, 900))
    squares, square = [], exact(1, 1, 0)
    floes = [(50.0, 50.0, 0.0), (50.0, 25.0, 0.0), (50.0, 100.0, 0.0), (75.0, 50.0, 0.0), (40.0, 60.0, 0.0),
             (50.0, 50.0, 12.5), (60.0, 80.0, 30.0), *((x, x, 0.0) for x in LENGTHS if x != 50)]

    def splits(floe, step, want, besides, half_angle=None):
        """A row and a check; how far the load is above the exact one."""
        length, width, place = floe
        load, kind, crack = split_load(length, width, place, want, step, half_angle)
        off, most = load / want - 1, step / (0.6 * END) + besides
        c.rows.append([f"{length:g} x {width:g}", f"2 x {half_angle}" if half_angle else "", f"{place:g}",
                       f"{step:.6f}", f"{load / 1e3:.2f}", f"{want / 1e3:.2f}", f"{100 * off:.3f} %", f"{crack:.3f}"])
        by = f"a stem of 2 x {half_angle} degrees" if half_angle else "a plate"
        c.check(kind == 1 and abs(crack / length - 1) < 1e-6 and -besides <= off <= most,
                f"{length:g} x {width:g} m, {place:g} m off the middle, {by}, dt {step:.6f}: splits across at "
                f"{100 * off:+.2f} % of the exact load, {100 * most:.2f} % allowed")
        return off

    def converges(offs, what):
        """The order of what changes as the step is halved: a table's error stays."""
        order = ladder.observed_order([a - b for a, b in zip(offs, offs[1:])])[0]
        c.check(order >= 0.9, f"{what}: observed order {order:.2f}, at least 0.9")

    for floe in floes:
        length, width, place = floe
        want = exact(length, width, place)
        # Between the nodes of Fram's table; on them 0.1 %.
        table = 1e-3 if length == width and not place else 6e-3
        offs = [splits(floe, step, want, table) for step in (steps if floe == floes[0] else steps[-1:])]
        if floe == floes[0]:
            converges(offs, "a plate")
        if length == width and not place:
            squares.append((length, (1 + offs[-1]) * want))
    for half_angle in STEMS:
        want = exact(50, 50, 0) * min(1, 2 * math.tan(math.radians(half_angle)))
        offs = [splits(floes[0], step, want, 1e-3, half_angle) for step in steps]
        converges(offs, f"a stem of 2 x {half_angle} degrees")
    c.found = ("This is an option. The default rule, that of the reference, involves no load at all: a radial crack "
               "runs through "
               "when it is shorter than S_k = 3 breaking radii, and never when it is longer.")

    def draw(axes):
        fine = [15 + i for i in range(71)]
        axes.plot(fine, [square * math.sqrt(x) / 1e3 for x in fine], "k", lw=2.5, alpha=0.3,
                  label="exact, square floes")
        axes.plot([x for x, _ in squares], [f / 1e3 for _, f in squares], "o", mfc="none", label="Fram, dt = 1 ms")
        axes.set(xlabel="side of the floe [m]", ylabel="in-plane load [kN]", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "splitting", "In-plane load at which a square floe of 1 m splits.", draw)
    return c
