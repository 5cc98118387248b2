"""Glancing impacts of the corner of a floe on the side of a ship, against Popov's reduction to one mass."""

import math

import ladder
import world

LONG = False
RADIUS, SIDES, THICKNESS, DENSITY, STRENGTH = 10.0, 12, 1.0, 920.0, 2e6
AREA = SIDES / 2 * RADIUS**2 * math.sin(2 * math.pi / SIDES)
MASS = DENSITY * THICKNESS * AREA
OPENING = math.pi - 2 * math.pi / SIDES  # of the corner: 150 degrees, as in IACS UR I2


def scene(lean, exponent, across, along):
    """A floe of twelve sides, corner first, meets a side that leans out by `lean` degrees from the vertical."""
    hull = ladder.WORK / "popov" / f"side_{lean}.obj"
    slope = math.tan(math.radians(lean))
    ladder.box_obj(hull, (0, -30, -3), (10, 30, 3), lambda x, y, z: (x - slope * z, y, z))
    # The upper edge of the corner is a millimetre from the side.
    place = -RADIUS - slope * THICKNESS / 2 - 1e-3
    return f"""environment: {{water: false}}
vessel: {{mode: prescribed, speed: 0, hull: {{form: file, file: {hull}}}}}
run: {{solver: {{kind: accurate, tolerance: 1.0e-12}}}}
domain: {{x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: open}}
ice:
  source: floes
  density: {DENSITY}
  crushing_strength: {STRENGTH}
  crushing_exponent: {exponent}
  crush_notches: false
  friction: {{ice_hull_static: 0, ice_hull_kinetic: 0}}
  floes:
    - {{shape: regular, sides: {SIDES}, radius: {RADIUS}, x: {place:.17g}, elevation: 0, thickness: {THICKNESS},
       velocity_x: {across}, velocity_y: {along}}}
"""


def impact(lean, exponent, across, along, dt):
    """Largest force along the normal, impulse, and the histories of time and force."""
    normal = (math.cos(math.radians(lean)), 0, math.sin(math.radians(lean)))
    with world.World(scene(lean, exponent, across, along), "popov", run__time_step=dt) as w:
        times, forces = [], []
        for _ in range(int(2 / dt)):
            w.step()
            force = sum(n * f for n, f in zip(normal, w.ice_force()))
            times.append(w.time)
            forces.append(force)
            if forces[-1] < 1 < max(forces):
                break
        return max(forces), sum(forces) * dt, (times, forces)


def exact(lean, exponent, across):
    """Largest force, impulse and depth: F = K d^n on the mass that the corner feels along the normal."""
    s, c = math.sin(math.radians(lean)), math.cos(math.radians(lean))
    # r x n of the upper edge about the middle of the floe, and its radius of gyration in pitch.
    arm = RADIUS * s - THICKNESS / 2 * c
    gyration = RADIUS**2 * (2 + math.cos(2 * math.pi / SIDES)) / 12 + THICKNESS**2 / 12
    felt = MASS / (1 + arm**2 / gyration)
    shape = math.tan(OPENING / 2) / (s * c**2)
    k, n = STRENGTH * shape**(1 + exponent), 2 * (1 + exponent)
    speed = across * c
    depth = ((n + 1) * felt * speed**2 / (2 * k))**(1 / (n + 1))
    return k * depth**n, felt * speed, depth


def case(out):
    c = ladder.Case(
        "Glancing impacts",
        2,
        "A floe of 276 t and twelve sides, corner first, meets the side of a ship that leans by 20, 35 and 50 degrees, "
        "frictionless: straight, and sliding along the side at twice the speed; constant pressure and the exponent "
        "-0.1 of the polar rules.",
        "Popov et al. (1967), Daley (1999), IACS UR I2, from memory and derived again: the effective mass at the "
        "corner, "
        "1/M = n.n/m + (r x n).I^-1.(r x n); the area of a corner of opening phi at a side that leans by beta', "
        "A = d^2 tan(phi/2)/(sin beta' cos^2 beta'); energy M v_n^2/2 = p0 int A^(1+e) dd.",
        "Force and impulse within 3 %: the lever arm and the lean are those of first contact, while the floe pitches "
        "by a few hundredths. Sliding along the side changes nothing.",
    )
    c.header = ["lean [deg]", "exponent", "speed across, along [m/s]", "dt [ms]", "force [kN]", "exact",
                "impulse [kN s]", "exact", "depth, exact [mm]"]
    curve = None
    for lean, exponent, across, along in ((20, 0, 1.0, 0.0), (35, 0, 1.0, 0.0), (50, 0, 1.0, 0.0), (35, 0, 1.0, 2.0),
                                          (35, -0.1, 1.0, 0.0), (35, -0.1, 1.0, 2.0)):
        force, impulse, depth = exact(lean, exponent, across)
        for dt in (4e-3, 2e-3, 1e-3):
            f, j, history = impact(lean, exponent, across, along, dt)
            c.rows.append([f"{lean}", f"{exponent:g}", f"{across:g}, {along:g}", f"{1e3 * dt:g}", f"{f / 1e3:.1f}",
                           f"{force / 1e3:.1f}", f"{j / 1e3:.2f}", f"{impulse / 1e3:.2f}", f"{1e3 * depth:.1f}"])
        name = f"{lean} degrees, exponent {exponent:g}, {along:g} m/s along"
        c.check(abs(f / force - 1) <= 0.03, f"{name}: force off by {100 * (f / force - 1):+.2f} %, 3 % allowed")
        c.check(abs(j / impulse - 1) <= 0.03, f"{name}: impulse off by {100 * (j / impulse - 1):+.2f} %, 3 % allowed")
        if lean == 35 and exponent == 0 and along:
            curve = history

    def draw(axes):
        axes.plot(curve[0], [f / 1e3 for f in curve[1]], label="gliding at 2 m/s")
        axes.axhline(exact(35, 0, 1.0)[0] / 1e3, color="k", lw=0.7, ls="--", label="Popov")
        axes.set_xlabel("time [s]")
        axes.set_ylabel("force along the normal [kN]")
        axes.legend()

    c.found = ("Lever arms, angles and the pressure-area law come out of patch, cap and solver as in Popov's "
               "collision; sliding along the side changes nothing. The difference that remains does not fall with "
               "the step: the floe pitches during the impact, which the closed form leaves out.")
    ladder.figure(c, out, "popov", "A corner of 150 degrees on a side that leans by 35 degrees", draw)
    return c
