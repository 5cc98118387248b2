"""Friction and collisions of rigid bodies whose end is known."""

import math

import ladder
import world

LONG = False
GRAVITY = 9.81
AIR = 100.0  # height at which there is no water [m]
PLAIN = "environment: {air_density: 0}\nvessel: {present: false}\n"
OPEN = "domain: {x_min: -500, x_max: 500, y_min: -500, y_max: 500, boundary: open}\n"


def plane(friction, angle, box):
    """A box of 2 x 2 x 0.5 m on a large fixed plate, high in the air, both nose down by an angle."""
    height, slope = 0.5 + 0.25, math.radians(angle)
    x, z = height * math.sin(slope), AIR + height * math.cos(slope)
    pair = f"friction: {{ice_ice_static: {friction}, ice_ice_kinetic: {friction}}}"
    return (PLAIN + OPEN + f"ice:\n  source: floes\n  smallest_floe_area: 0.01\n  {pair}\n  floes:\n"
            f"    - {{length: 60, width: 60, thickness: 1, elevation: {AIR}, pitch_deg: {angle}, fixed: true}}\n"
            f"    - {{length: 2, width: 2, thickness: 0.5, x: {x:.17g}, elevation: {z:.17g}, pitch_deg: {angle}, "
            f"{box}}}\n")


def slide(dt, heading):
    """Time and way to the stop of a box at 2 m/s, mu 0.1."""
    vx, vy = 2 * math.cos(math.radians(heading)), 2 * math.sin(math.radians(heading))
    text = plane(0.1, 0, f"yaw_deg: {heading}, velocity_x: {vx:.17g}, velocity_y: {vy:.17g}")
    # It stands when slower than 1e-9 m/s, of which the default tolerance leaves more.
    with world.World(text, "rigid", run__time_step=dt, run__solver__tolerance=1e-12) as w:
        while w.time < 4:
            w.step()
            s = w.body(1)
            if world.length(s.velocity) < 1e-9:
                break
        return w.time, math.hypot(s.position[0], s.position[1])


def incline(dt, angle, until=2.0):
    """Way down the slope from rest, mu 0.3."""
    with world.World(plane(0.3, angle, "spin: 0"), "rigid", run__time_step=dt) as w:
        first = w.body(1).position[:]
        w.run(until)
        return world.length([a - b for a, b in zip(w.body(1).position, first)])


def meet(dt):
    """Velocities and lost energy of 92 t at 1 m/s that meets 46 t at -0.5 m/s."""
    text = (OPEN + "environment: {water: false}\nvessel: {present: false}\nice:\n  source: floes\n  density: 920\n  "
                   "floes:\n"
            "    - {length: 10, width: 10, x: -5.005, elevation: 0, velocity_x: 1}\n"
            "    - {length: 10, width: 5, x: 5.005, elevation: 0, velocity_x: -0.5}\n")
    with world.World(text, "rigid", run__time_step=dt, run__solver__kind="accurate",
                     run__solver__tolerance=1e-12) as w:
        energy = [0.5 * s.mass * s.velocity[0] ** 2 for _, s in w.bodies("floe")]
        w.run(0.4)
        found = [s for _, s in w.bodies("floe")]
        return [s.velocity[0] for s in found], sum(energy) - sum(0.5 * s.mass * s.velocity[0] ** 2 for s in found)


def corner(dt):
    """Speed and spin after a corner of a 10 x 10 m floe at 1 m/s meets a face without friction or crushing."""
    text = (OPEN + "environment: {water: false}\nvessel: {present: false}\nice:\n  source: floes\n  density: 920\n"
            "  cap_ice_ice: false\n  friction: {ice_ice_static: 0, ice_ice_kinetic: 0}\n  floes:\n"
            "    - {length: 10, width: 10, x: 0, elevation: 0, velocity_x: 1}\n"
            "    - {length: 4, width: 20, x: 7.001, y: 14.9995, elevation: 0, fixed: true}\n")
    with world.World(text, "rigid", run__time_step=dt, run__solver__kind="accurate",
                     run__solver__tolerance=1e-12) as w:
        for _ in range(round(0.05 / dt)):
            w.step()
            s = w.body(0)
            if abs(s.angular_velocity[2]) > 1e-6:
                break
        w.step()  # the step before may only have closed the gap
        s = w.body(0)
        return s.velocity[0], abs(s.angular_velocity[2])


def case(out):
    c = ladder.Case(
        "Sliding, slopes and collisions",
        2,
        "A box that slides to a stop (mu 0.1, 2 m/s) along, across and between the directions of the friction "
        "rows; a box on slopes (mu 0.3); two floes that meet head on; a floe that is caught at a corner.",
        "Coulomb's law and the conservation of momentum: v^2/(2 mu g), g (sin a - mu cos a), plastic impact.",
        "First order in dt for what takes time (a stop falls inside a step); 1e-6 and better for the impact head on, "
        "whatever the step; 2e-4 at a corner, which is wider, for the reason given below.",
    )
    c.header = ["test", "dt [s]", "found", "exact", "difference", "order"]

    def enter(what, values, exact, unit, bound, ordered=True):
        before, orders = None, []
        for dt, value in values:
            error = abs(value - exact)
            order = math.log2(before / error) if before and error != 0 and ordered else None
            c.rows.append([what, f"{dt:g}", f"{value:.8g} {unit}", f"{exact:.8g}", f"{error:.1e}",
                           f"{order:.2f}" if order is not None else ""])
            before = error
            orders += [] if order is None else [order]
        c.check(error <= bound, f"{what}: {error:.1e} {unit} off at the smallest step, at most {bound:g}")
        if orders:
            c.check(ladder.least(orders) >= 0.9, f"{what}: observed order {ladder.least(orders):.2f}, at least 0.9")

    stop = 4 / (2 * 0.1 * GRAVITY)
    ways = {dt: slide(dt, 0) for dt in (0.02, 0.01, 0.005)}
    enter("slide, distance", [(dt, way) for dt, (_, way) in ways.items()], stop, "m", 0.02)
    enter("slide, time", [(dt, t) for dt, (t, _) in ways.items()], 2 / (0.1 * GRAVITY), "s", 0.006, ordered=False)
    for heading in (22.5, 45):
        enter(f"slide, distance at {heading:g} deg", [(0.01, slide(0.01, heading)[1])], ways[0.01][1], "m", 1e-6)
    angles = [12, 16, 16.6, 16.8, 18, 20, 22.5, 25, 30]
    found = [2 * incline(0.005, a) / 4 for a in angles]
    steep = GRAVITY * (math.sin(math.radians(25)) - 0.3 * math.cos(math.radians(25)))
    enter("slope of 25 deg, acceleration", [(dt, 2 * incline(dt, 25) / 4) for dt in (0.02, 0.01, 0.005)], steep, "m/s2",
          0.01)
    c.check(found[angles.index(16.6)] < 1e-3 < found[angles.index(16.8)],
            "sticks at 16.6 degrees and slides at 16.8 (exact limit: 16.699)")
    for dt in (0.01, 0.005):
        velocities, loss = meet(dt)
        enter(f"head on, speed after (dt {dt})", [(dt, v) for v in velocities], 0.5, "m/s", 1e-9, ordered=False)
        enter(f"head on, energy lost (dt {dt})", [(dt, loss)], 34500, "J", 1e-3)
    for dt in (4e-4, 2e-4):
        speed, spin = corner(dt)
        enter(f"corner, speed after (dt {dt})", [(dt, speed)], 0.6, "m/s", 2e-4)
        enter(f"corner, spin after (dt {dt})", [(dt, spin)], 0.12, "rad/s", 2e-4)
    c.found = ("The corner's contact is 0.5 mm of face, not a point: the lever arm is 0.25 mm short of 5 m, which "
               "explains the difference.")

    def draw(axes):
        fine = [10 + 0.1 * i for i in range(211)]
        exact = [max(0, GRAVITY * (math.sin(math.radians(a)) - 0.3 * math.cos(math.radians(a)))) for a in fine]
        axes.plot(fine, exact, "k", lw=2.5, alpha=0.3, label="exact")
        axes.plot(angles, found, "o", mfc="none", label="Fram, dt = 5 ms")
        axes.set(xlabel="slope [deg]", ylabel="acceleration [m/s²]")
        axes.legend()

    ladder.figure(c, out, "rigid", "Acceleration of a box on a slope with mu = 0.3: it sticks below 16.7 "
                                   "degrees.", draw)
    return c
