"""Level ice against a fixed cone, beside Croasdale's formula."""

import math

import ladder

LONG = False
DIAMETER, STRENGTH, MODULUS, FRICTION, RHO, GRAVITY, NU = 5.0, 0.7e6, 8e9, 0.15, 1025.0, 9.81, 0.3
FACETS, SPEED = 24, 0.5
# Angle [deg], thickness [m].  The one at 60 degrees in 1 m is the source's.
CASES = [(60, 0.4), (60, 0.6), (60, 1.0), (60, 1.5), (45, 1.0), (52.5, 1.0), (67.5, 1.0)]


def croasdale(angle, h):
    """Horizontal load that breaks the sheet (Croasdale 1978; H_B of IceFloe)."""
    a = math.radians(angle)
    xi = (math.sin(a) + FRICTION * math.cos(a)) / (math.cos(a) - FRICTION * math.sin(a))
    l = (MODULUS * h**3 / (12 * RHO * GRAVITY * (1 - NU**2))) ** 0.25
    return 0.68 * xi * STRENGTH * (RHO * GRAVITY * h**5 / MODULUS) ** 0.25 * (DIAMETER + math.pi**2 * l / 4)


def cone(angle, facets=FACETS):
    """A cone that is DIAMETER wide at the waterline, with a flat top and bottom."""
    slope = 1 / math.tan(math.radians(angle))
    rings = [(z, DIAMETER / 2 - z * slope) for z in (-4.0, min(2.5, (DIAMETER / 2 - 0.4) / slope))]
    corners = [(r * math.cos(2 * math.pi * i / facets), r * math.sin(2 * math.pi * i / facets), z)
               for z, r in rings for i in range(facets)]
    faces = [(i + 1, (i + 1) % facets + 1, facets + (i + 1) % facets + 1, facets + i + 1) for i in range(facets)]
    faces += [tuple(range(facets, 0, -1)), tuple(range(facets + 1, 2 * facets + 1))]
    path = ladder.WORK / "cone" / f"cone_{angle:g}_{facets}.obj"
    ladder.write_obj(path, corners, faces)
    return path


def scene(angle, h, facets=FACETS, seconds=25, step=0.01):
    start = -(DIAMETER / 2 + h) - 1
    return f"""run: {{duration: {seconds}, time_step: {step}}}
vessel: {{mode: prescribed, x: {start:.17g}, speed: {SPEED}, hull: {{form: file, file: {cone(angle, facets)}}}}}
ice:
  source: level
  breakable: true
  thickness: {h}
  flexural_strength: {STRENGTH}
  elastic_modulus: {MODULUS}
  crushing_strength: 2.0e6
  friction: {{ice_hull_static: {FRICTION}, ice_hull_kinetic: {FRICTION}}}
  level: {{x_min: 0}}
domain: {{x_min: -20, x_max: 60, y_min: -40, y_max: 40, boundary: open}}
output: {{frame_interval: 0}}
"""


def first_break(angle, h, facets=FACETS, step=0.01):
    """Horizontal load in the step of the first break, R_bending then, and the channels of the run."""
    name = f"cone/{angle:g}_{h:g}_{facets}_{step:g}"
    series = ladder.run(scene(angle, h, facets, step=step), name)
    event = ladder.fractures(name)
    until = event["time"][0] + 1e-9
    load = ladder.greatest(-f for t, f in zip(series["time"], series["ice_force_x"]) if t <= until)
    return load, event["crack_length"][0], series


def case(out):
    c = ladder.Case(
        "Level ice against a fixed cone",
        5,
        "A cone of 5 m at the waterline in level ice that breaks upwards: horizontal load at the first break over "
        "thickness and angle, and the largest and mean load of the first 20 s, with pieces on the cone.",
        "Croasdale's breaking term H_B (1978, as in OpenFAST's IceFloe: D 5 m, 60 degrees, 1 m, 0.7 MPa, 8 GPa, mu "
        "0.15: 1.844 MN), which spreads the break over the cone's width and the sheet beside it. sigma_c 2 MPa, N "
        "3.",
        "The first break at 0.4 to 1.2 of H_B (expectation set before the first run): Fram's is the break of a "
        "local patch of wedges, Croasdale's of a whole circumferential crack. It must grow with thickness and "
        "angle as H_B does.",
    )
    c.header = ["angle [deg]", "h [m]", "first break [kN]", "H_B [kN]", "ratio", "R_bending [m]", "largest 0.5 s mean "
                                                                                                  "[kN]",
                "mean after 10 s [kN]"]
    found = {}
    c.check(abs(croasdale(60, 1) / 1.84414e6 - 1) < 2e-3, "the formula gives the source's number to 0.2 %")
    runs = ladder.side_by_side(lambda job: first_break(*job), CASES)
    for (angle, h), (load, radius, series) in zip(CASES, runs):
        found[angle, h] = load
        window = [-f for f in series["ice_force_averaged_x"]]
        later = [-f for f in ladder.after(series, "ice_force_x", 10)]
        ratio = load / croasdale(angle, h)
        c.rows.append([angle, h, f"{load / 1e3:.0f}", f"{croasdale(angle, h) / 1e3:.0f}", f"{ratio:.2f}",
                       f"{radius:.2f}",
                       f"{max(window) / 1e3:.0f}", f"{sum(later) / len(later) / 1e3:.0f}"])
        c.check(0.4 <= ratio <= 1.2, f"{angle} degrees, {h} m: first break at {ratio:.2f} of H_B, expected 0.4 to 1.2")
    half, _, _ = first_break(60, 1.0, step=0.005)
    c.rows.append(["60, dt / 2", 1.0, f"{half / 1e3:.0f}", f"{croasdale(60, 1) / 1e3:.0f}",
                   f"{half / croasdale(60, 1):.2f}", "", "", ""])
    by_h = [found[60, h] for h in (0.4, 0.6, 1.0, 1.5)]
    power = math.log(by_h[-1] / by_h[0]) / math.log(1.5 / 0.4)
    of_formula = math.log(croasdale(60, 1.5) / croasdale(60, 0.4)) / math.log(1.5 / 0.4)
    c.check(ladder.rises(by_h), f"grows with thickness, as h^{power:.2f} (H_B: h^{of_formula:.2f})")
    by_angle = [found[a, 1.0] for a in (45, 52.5, 60, 67.5)]
    c.check(ladder.rises(by_angle), "grows with the angle")

    def draw(axes):
        fine = [0.3 + 0.02 * i for i in range(66)]
        axes[0].plot(fine, [croasdale(60, h) / 1e6 for h in fine], "k--", label="Croasdale, H_B")
        axes[0].fill_between(fine, [0.4e-6 * croasdale(60, h) for h in fine], [1.2e-6 * croasdale(60, h) for h in fine],
                             color="grey", alpha=0.15, lw=0, label="0.4 to 1.2 of it")
        axes[0].plot([0.4, 0.6, 1.0, 1.5], [f / 1e6 for f in by_h], "o", label="Fram, first break")
        axes[0].set(xlabel="thickness [m], 60 degrees", ylabel="horizontal load [MN]")
        axes[0].legend()
        fine = [44 + i / 2 for i in range(50)]
        axes[1].plot(fine, [croasdale(a, 1) / 1e6 for a in fine], "k--")
        axes[1].fill_between(fine, [0.4e-6 * croasdale(a, 1) for a in fine], [1.2e-6 * croasdale(a, 1) for a in fine],
                             color="grey", alpha=0.15, lw=0)
        axes[1].plot([45, 52.5, 60, 67.5], [f / 1e6 for f in by_angle], "o")
        axes[1].set(xlabel="angle of the cone [deg], 1 m", ylabel="horizontal load [MN]")

    ladder.figure(c, out, "cone", "Horizontal load at the first break.", draw, panels=2)
    return c
