"""Contacts that are wide along the edge: inclined plates driven into level ice, whose edge gives before it breaks."""

import functools
import math

import ladder

LONG = False
WEDGES, WATER, GRAVITY, POISSON, ICE = 3, 1025.0, 9.81, 0.3, 920.0
CRUSHING = 2e6
BASE = (1.0, 5e9, 0.5e6)  # thickness [m], elastic modulus and flexural strength [Pa]
WIDTHS = [2, 5, 10, 20, 50]
SPEED = 0.1
# The break comes half a step late with all of these.
STEPS_TO_THE_BREAK = [25, 50, 100]
THIN = [(0.05, 5e9, 0.5e6), (0.2, 1e9, 0.5e6), (0.3, 2e9, 1e6), (0.5, 2e9, 1e6)]
THIN_WIDTH, THIN_SPEEDS, THIN_STEPS = 20, (0.2, 1), (0.02, 0.005)
# With inertia there is no closed form: the load at long steps beside that at the shortest.
HEAVY_SPEED, HEAVY_STEPS = 1, (0.02, 0.01, 0.005, 0.0025, 0.00125)
TILES = ["auto", 10, 100]
# Two plates side by side: width of each, and of the gap between them.
PAIRS = [(10, 0.01), (5, 2), (5, 10), (2, 20)]
# Width, speed, steps of what is looked at after the break.
AFTER, AFTER_STEPS = [(20, 0.1), (20, 0.5), (50, 0.1), (50, 0.5)], (0.01, 0.005)
# Set after a first run: what is left as the step goes to nothing; what halving it changes after the break.
LEFT, LEFT_THIN, HALVED, HEAVY = 0.005, 0.05, 0.1, 0.2


def wedge(a):
    """Capacity C and tip deflection eta(0) of Nevel's wedge by finite elements, a over the characteristic length."""
    import numpy  # other cases do without
    import wedge_ramp

    x = wedge_ramp.mesh(a)
    bending, mass, load = wedge_ramp.matrices(x, a)
    still = numpy.linalg.solve(bending + mass, load)
    return 1 / wedge_ramp.largest_curvature(x, still)[0], still[0]


@functools.cache
def wedges(ice):
    """Load of wedges on both sides of a narrow contact, how far it puts their tips down, and the sheet's
    characteristic length."""
    thickness, modulus, strength = ice
    length = (modulus * thickness**3 / (12 * (1 - POISSON**2) * WATER * GRAVITY)) ** 0.25
    breadths = WEDGES * 2 * math.tan(math.pi / (2 * WEDGES))
    a = 0.01 * length
    for _ in range(10):  # each divides the error by ten or more
        capacity, tip = wedge(a / length)
        load = strength * thickness**2 / 6 * capacity * breadths
        a = math.sqrt(2 * load / CRUSHING / breadths)
    return load, load * tip / (WATER * GRAVITY * length**2 * breadths), length


def by_hand(ice, width):
    """Load that breaks an edge under a frictionless plate at 45 degrees, and the plate's way until then.

    Wedges on both sides of a long beam on the water: each part is crushed in proportion to what it bears, and the edge
    goes down as one."""
    at_ends, down, length = wedges(ice)
    load = at_ends + ice[2] * ice[0] ** 2 / 6 * width / (0.455938127766 * length)
    stiffness = at_ends / down + WATER * GRAVITY * length * width / math.sqrt(2)
    return load, load / (CRUSHING * width) + load / stiffness


def of_a_pair(ice, width, gap):
    """The same of each of two such plates with a gap between them: where on its width both together bend the edge
    most.  Each edge goes down under its own plate alone."""
    breadths, length, metre = WEDGES * 2 * math.tan(math.pi / (2 * WEDGES)), wedges(ice)[2], ice[2] * ice[0] ** 2 / 6
    a, along = 0.01 * length, metre / (0.455938127766 * length)
    for _ in range(10):
        capacity, tip = wedge(a / length)
        bears = metre * capacity * breadths

        def reach(x):
            return x / (bears + 2 * along * abs(x))

        def bend(x):
            return (reach(x + width / 2) - reach(x - width / 2)) / width

        load = 1 / max(bend(x) + bend(x - width - gap) for x in (-width / 2, 0, width / 2))
        a = math.sqrt(2 * load * bears / (bears + along * width) / CRUSHING / breadths)
    stiffness = WATER * GRAVITY * (length**2 * breadths / tip + width * length / math.sqrt(2))
    return load, load / (CRUSHING * width) + load / stiffness


class Plate:
    """A run of a plate, or of two, that breaks the edge, and what is known of it."""

    def __init__(self, name, ice, width, gap=None, step=None, halves=None, speed=SPEED, after=0.0, **more):
        self.name, self.ice, self.width, self.speed, self.more = f"plates/{name}", ice, width, speed, more
        self.gap = gap
        self.load, self.way = by_hand(ice, width) if gap is None else of_a_pair(ice, width, gap)
        self.step = step or self.way / speed / (halves - 0.5)  # halves: of a step, the break comes half a step late
        self.away = math.ceil(2.2 / (speed * self.step)) * self.step  # time before the plate meets ice
        self.until = self.away + self.way / speed + 3 * self.step + after
        self.growth = speed * self.step / self.way  # of the load in a step, over the load at the break

    def scenario(self):
        thickness, modulus, strength = self.ice
        hull = ladder.WORK / "plates" / f"{self.width:g}_{self.gap}.obj"
        middles = [0] if self.gap is None else [-(self.width + self.gap) / 2, (self.width + self.gap) / 2]
        # No part of it is over the ice at the start: ice is cleared there.
        ladder.boxes_obj(hull, [((-10, y - self.width / 2, -3), (0, y + self.width / 2, 1)) for y in middles],
                         lambda x, y, z: (x + z, y, z))
        x = -(1 - ICE / WATER) * thickness - self.speed * self.away
        return f"""run: {{duration: {self.until:.17g}, time_step: {self.step:.17g}}}
domain: {{boundary: open, x_min: -40, x_max: 120, y_min: -100, y_max: 100}}
vessel: {{mode: prescribed, x: {x:.17g}, speed: {self.speed}, hull: {{form: file, file: {hull}}}}}
ice:
  source: level
  breakable: true
  thickness: {thickness}
  density: {ICE}
  elastic_modulus: {modulus}
  flexural_strength: {strength}
  crushing_strength: {CRUSHING}
  friction: {{ice_hull_static: 0, ice_hull_kinetic: 0}}
  fracture: {{thick_plate_radius: false, wedges: {WEDGES}, edge_inertia: false}}
  level: {{x_min: 0}}
output: {{frame_interval: 0, csv_interval: {self.step:.17g}}}
"""

    def run(self):
        series = ladder.run(self.scenario(), self.name, **self.more)
        event = ladder.fractures(self.name)
        if not event["time"]:
            raise RuntimeError(f"{self.name}: nothing breaks")
        # The row of a step tells the time at its end; the load is that of its beginning.
        self.late = event["time"][0] - self.step - self.away - self.way / self.speed
        self.found = event["load"][0]
        self.off = self.found / self.load - 1
        self.after = ladder.greatest(map(abs, ladder.after(series, "ice_force_z", event["time"][0] - self.step / 2)))
        return self

    def row(self, label, after=False):
        thickness, modulus, strength = self.ice
        return [label, f"{thickness:g} m, {modulus / 1e9:g} GPa, {strength / 1e6:g} MPa", self.speed,
                f"{self.step:.4f}", f"{self.found / 1e3:.4g}", f"{self.load / 1e3:.4g}", f"{100 * self.off:+.2f} %",
                f"{self.late:+.4f}", f"{self.after / 1e3:.0f}" if after else ""]


def halved(c, label, each):
    """The same at steps that are halved, beside the closed form."""
    for plate in each:
        c.rows.append(plate.row(label))
    c.check(all(-LEFT <= p.off <= p.growth + LEFT and -0.01 * p.way / p.speed <= p.late <= 1.1 * p.step for p in each),
            f"{label}: breaks within a step of the exact time, the load at most a step's growth too high "
            f"({', '.join(f'{100 * p.off:+.2f}' for p in each)} %; {100 * LEFT:g} % besides)")
    coarse, fine = each[0].off - each[1].off, each[1].off - each[2].off
    order = ladder.observed_order([coarse, fine])[0]
    c.check(order >= 0.9 and abs(each[2].off - fine) <= LEFT,
            f"{label}: observed order {order:.2f}; {100 * (each[2].off - fine):+.2f} % are left as the step goes to "
            "nothing")


def thin(c, each):
    """Ice that goes down by much of its thickness before it breaks."""
    for plate in each:
        c.rows.append(plate.row(f"{THIN_WIDTH} m"))
    for ice in THIN:
        of_ice = [p for p in each if p.ice == ice]
        c.check(all(-LEFT <= p.off <= p.growth + LEFT_THIN for p in of_ice),
                f"{ice[0]:g} m of ice, {ice[1] / 1e9:g} GPa, {ice[2] / 1e6:g} MPa: "
                f"{100 * min(p.off for p in of_ice):+.1f} to {100 * max(p.off for p in of_ice):+.1f} %, where a step's "
                "growth is "
                f"{100 * min(p.growth for p in of_ice):.1f} to {100 * max(p.growth for p in of_ice):.0f} % "
                f"({100 * LEFT_THIN:g} % besides)")


def heavy(c, each):
    """Thin ice whose edge has inertia: at long steps it would break within a step, at any load."""
    for plate in each:
        c.rows.append(plate.row(f"{THIN_WIDTH} m, inertia"))
    for ice in THIN:
        loads = [p.found for p in each if p.ice == ice]
        off = [load / loads[-1] - 1 for load in loads[:-1]]
        c.check(ladder.greatest(map(abs, off)) <= HEAVY,
                f"{ice[0]:g} m of ice with inertia, {HEAVY_SPEED} m/s: at steps of "
                f"{', '.join(f'{1000 * p.step:g}' for p in each if p.ice == ice)} ms "
                f"{', '.join(f'{100 * (p.found / p.load):.0f}' for p in each if p.ice == ice)} % of what breaks it at "
                f"rest; {100 * min(off):+.0f} to {100 * max(off):+.0f} % from that of the shortest step")


def case(out):
    c = ladder.Case(
        "Contacts that are wide along the edge",
        2,
        f"Plates of {', '.join(map(str, WIDTHS))} m at 45 degrees, frictionless, driven at {SPEED:g} m/s into level "
        "ice of 1 m whose edge gives before it breaks, as by default, and has no inertia (narrow loads on fixed floes "
        f"are in [a whole break](break.md)); {THIN_WIDTH} m against thin, soft and strong ice, faster, also with "
        "inertia; 50 m over tiles of "
        "other sizes; two plates side by side; the largest load from the break on, of pieces that are pushed down as "
        "one.",
        "Three wedges (Nevel 1961, by finite elements in `validation/wedge_ramp.py`) beside a long beam on the water "
        "loaded at its end (Hetenyi 1946): P = sigma_f h^2/6 (C sum(b0) + w/(0.4559 l)), crushed by P/(sigma_c w) and "
        "down by P/(k (l^2 sum(b0)/eta(0) + w l/sqrt(2))) then "
        "([0128](../decisions/0128-wide-contacts-and-corners-by-hand.md), [0220](../decisions/0220-edges-give.md), "
        "[0562](../decisions/0562-an-edge-gives-as-far-as-it-is-thick.md)). Each of two plates bends the edge under "
        "the other by what an even load of that width makes there, P/w (H(d + w/2) - H(d - w/2)) with H(x) = "
        "x/(A + 2 B |x|) of wedges A and beam B w ([0564](../decisions/0564-loads-bend-an-edge-together.md)). After "
        "the break there is none.",
        "First order in dt: the break comes with the first step at which the load is reached, and the load is too high "
        "by a step's growth at most; steps that halve and meet the break half a step late show the order. The size of "
        f"tiles changes nothing. What is left besides, {100 * LEFT:g} and in thin ice {100 * LEFT_THIN:g} %, and "
        f"{100 * HALVED:g} % by half the step after the break, were set after a first run, and {100 * HEAVY:g} % by "
        "the step with inertia ([0566](../decisions/0566-no-more-than-breaks-the-ice.md)).",
    )
    c.header = ["plate", "ice", "speed [m/s]", "dt [s]", "load at the break [kN]", "by hand [kN]", "difference",
                "late by [s]", "largest in 1 s from then [kN]"]
    by_width = {w: [Plate(f"{w}_{n}", BASE, w, halves=n) for n in STEPS_TO_THE_BREAK] for w in WIDTHS}
    by_pair = {(w, gap): [Plate(f"pair_{w}_{gap}_{n}", BASE, w, gap, halves=n) for n in STEPS_TO_THE_BREAK]
               for w, gap in PAIRS}
    of_thin = [Plate(f"thin_{ice[0]}_{v}_{dt}", ice, THIN_WIDTH, step=dt, speed=v)
               for ice in THIN for v in THIN_SPEEDS for dt in THIN_STEPS]
    of_heavy = [Plate(f"heavy_{ice[0]}_{dt}", ice, THIN_WIDTH, step=dt, speed=HEAVY_SPEED,
                      ice__fracture__edge_inertia="true") for ice in THIN for dt in HEAVY_STEPS]
    tiles = [Plate(f"tile_{size}", BASE, 50, step=0.01, ice__level__tile_size=size) for size in TILES]
    after = {(w, v): [Plate(f"after_{w}_{v}_{dt}", BASE, w, step=dt, speed=v, after=1) for dt in AFTER_STEPS]
             for w, v in AFTER}
    ladder.side_by_side(Plate.run, [p for each in (*by_width.values(), *by_pair.values(), of_thin, of_heavy, tiles,
                                                   *after.values()) for p in each])
    for w, each in by_width.items():
        halved(c, f"{w} m", each)
    for (w, gap), each in by_pair.items():
        halved(c, f"two of {w} m, {gap:g} m between", each)
    thin(c, of_thin)
    heavy(c, of_heavy)
    for plate, size in zip(tiles, TILES):
        c.rows.append(plate.row(f"50 m, tiles {size}{'' if size == 'auto' else ' m'}"))
    c.check(ladder.greatest(p.found for p in tiles) <= 1.001 * ladder.least(p.found for p in tiles),
            f"tiles of other sizes: {min(p.found for p in tiles) / 1e3:.1f} to "
            f"{max(p.found for p in tiles) / 1e3:.1f} kN")
    for (w, v), pair in after.items():
        c.rows += [p.row(f"{w} m", True) for p in pair]
        c.check(abs(pair[1].after / pair[0].after - 1) <= HALVED,
                f"{w} m at {v:g} m/s, from the break on: {pair[1].after / pair[1].load:.2f} times the load that "
                f"breaks, with half the step {100 * (pair[1].after / pair[0].after - 1):+.1f} %")

    def draw(axes):
        fine = [0.5 * 1.15**i for i in range(34)]
        axes.plot(fine, [by_hand(BASE, w)[0] / 1e3 for w in fine], "k", lw=2.5, alpha=0.3, label="wedges and beam")
        axes.axhline(by_hand(BASE, 1e-6)[0] / 1e3, color="k", ls=":", lw=1, label="wedges alone: a narrow load")
        axes.plot(WIDTHS, [by_width[w][-1].found / 1e3 for w in WIDTHS], "o", mfc="none", label="Fram, shortest step")
        axes.set(xlabel="width of the plate [m]", ylabel="load that breaks 1 m of ice [kN]", ylim=(0, None),
                 xlim=(0, 55))
        axes.legend()

    ladder.figure(c, out, "plates", "Load that breaks the edge of level ice over the width of the contact.", draw)
    return c
