"""Drag of water and wind on floes, against closed forms."""

import math

import ladder
import world

LONG = False
RHO, ICE = 1025.0, 920.0
DRAUGHT = ICE / RHO
STEPS = (0.2, 0.1, 0.05)


def scene(floe, environment, density=ICE):
    return (f"run: {{duration: 100000}}\nvessel: {{present: false}}\n"
            "domain: {x_min: -1000000, x_max: 1000000, y_min: -1000000, y_max: 1000000, boundary: open}\n"
            f"environment: {environment}\nice:\n  source: floes\n  density: {density}\n  floes:\n    - {{{floe}}}\n")


def drift(dt, until):
    """Speed of a floe of 10 x 10 x 1 m, from rest in a current of 0.3 m/s."""
    text = scene("length: 10, width: 10", "{current_speed: 0.3, air_density: 0, "
                 "ice_drag: {water_form: 1, water_skin: 0.01}}")
    with world.World(text, "drag", run__time_step=dt) as w:
        times, speeds = [0.0], [0.0]
        while w.time < until - 1e-9:
            w.step()
            times.append(w.time)
            speeds.append(w.body(0).velocity[0])
        return times, speeds


def wind_drift():
    """Final speed over the wind's, of a large thin floe: Ca 1.5e-3, Cw 5e-3, skin alone."""
    text = scene("length: 1000, width: 1000, thickness: 1", "{wind_speed: 10, air_density: 1.25, ice_drag: "
                                                            "{water_form: 0,"
                 " water_skin: 0.01, air_form: 0, air_skin: 0.003}}")
    with world.World(text, "drag", run__time_step=0.5) as w:
        w.run(40000)
        return w.body(0).velocity[0] / 10


def spin_torque(sides, form, skin, density=ICE):
    """Torque of the water on a regular floe of 10 m radius that spins at 0.5 rad/s: from one short step."""
    dt, spin, radius = 1e-4, 0.5, 10.0
    text = scene(f"shape: regular, sides: {sides}, radius: {radius}, spin: {spin}", "{air_density: 0, ice_drag: "
                 f"{{water_form: {form}, water_skin: {skin}}}}}", density)
    with world.World(text, "drag", run__time_step=dt) as w:
        s = w.body(0)
        w.step()
        # Moment of inertia of a regular polygon about its axis, over the mass.
        inertia = s.mass * radius**2 / 6 * (2 + math.cos(2 * math.pi / sides))
        return inertia * (spin - w.body(0).angular_velocity[2]) / dt


def case(out):
    c = ladder.Case(
        "Drag of floes",
        2,
        "A floe of 10 x 10 x 1 m from rest in a current of 0.3 m/s; the steady drift in wind; the torque on a "
        "spinning disc (64 sides) and on a spinning square.",
        "u_rel = U/(1 + U t/L), L = 17.6770 m (bottom, two sides, form); with N^2 = rho_a Ca/(rho_w Cw), U_i/U_a = "
        "N/(1 + N) = 0.018768 for sides without drag); (pi/5) rho Cf w^2 R^5 for the bottom, and the sides' skin; "
        "1/2 rho Cd d w^2 b^4.",
        "First order in dt for the drift; 1 % for the wind drift, since sides drag too; torques 0.5 % (level floes use "
        "closed forms on the sides and a six-point quadrature per triangle on the bottom), that of the disc within "
        "0.1 % of what 64 sides leave of the round one's (a bound set after a first run).",
    )
    c.header = ["quantity", "found", "exact", "relative difference"]
    length = 2 * 92000 / (RHO * (0.01 * 100 + 0.01 * 2 * 10 * DRAUGHT + 1.0 * 10 * DRAUGHT))
    end = 0.3 - 0.3 / (1 + 0.3 * 60 / length)
    c.check(abs(end - 0.15136) < 1e-5, f"closed form: u(60 s) = {end:.5f} m/s, as in the source")
    errors, curve = [], None
    for dt in STEPS:
        curve = drift(dt, 60)
        errors.append(abs(curve[1][-1] - end))
        now = curve[1][-1]
        c.rows.append([f"drift after 60 s, dt {dt}", f"{now:.7f} m/s", f"{end:.7f}", f"{now / end - 1:.1e}"])
    order = ladder.least(ladder.observed_order(errors))
    c.check(order >= 0.95, f"drift: observed order {order:.2f}, at least 0.95")
    c.check(errors[-1] <= 1e-3 * end, f"drift: {errors[-1] / end:.1e} off at dt = {STEPS[-1]} s, at most 1e-3")
    found, exact = wind_drift(), math.sqrt(1.25 * 1.5e-3 / (RHO * 5e-3))
    exact = exact / (1 + exact)
    c.rows.append(["wind drift over the wind's speed", f"{found:.6f}", f"{exact:.6f}", f"{found / exact - 1:.1e}"])
    c.check(abs(found / exact - 1) <= 0.01, f"wind drift {100 * (found / exact - 1):.2f} % off, at most 1 %")

    rim, spin, radius = math.cos(math.pi / 64), 0.5, 10.0
    bottom = math.pi / 5 * RHO * 0.01 * spin**2 * radius**5
    sides = 0.5 * RHO * 0.01 * (spin * radius) ** 2 * radius * 2 * math.pi * radius * DRAUGHT
    found = spin_torque(64, 0, 0.01)
    c.rows.append(["disc, torque of skin [kN m]", f"{found / 1e3:.4f}", f"{(bottom + sides) / 1e3:.4f} (round)",
                   f"{found / (bottom + sides) - 1:.1e}"])
    apart, expected = found / (bottom + sides) - 1, -10 * (1 - rim) / 3
    c.check(abs(apart - expected) <= 1e-3, f"disc: {100 * apart:.2f} % off the round one (64 sides: "
                                           f"{100 * expected:.2f} % expected), at most 0.1 % from that")
    half = radius / math.sqrt(2)
    exact = 0.5 * RHO * DRAUGHT * spin**2 * half**4
    found = spin_torque(4, 1, 0)
    c.rows.append(["square, torque of form [kN m]", f"{found / 1e3:.4f}", f"{exact / 1e3:.4f}",
                   f"{found / exact - 1:.1e}"])
    c.check(abs(found / exact - 1) <= 5e-3, f"square: {100 * (found / exact - 1):.3f} % off, at most 0.5 %")

    def draw(axes):
        times, speeds = curve
        axes.plot(times, [0.3 - 0.3 / (1 + 0.3 * t / length) for t in times], "k", lw=2.5, alpha=0.3, label="exact")
        axes.plot(times, speeds, "--", label=f"Fram, dt = {STEPS[-1]} s")
        axes.axhline(0.3, color="grey", lw=0.8, ls=":", label="current")
        axes.set(xlabel="time [s]", ylabel="speed of the floe [m/s]", ylim=(0, None))
        axes.legend(loc="lower right")

    ladder.figure(c, out, "drag", "A floe from rest in a current.", draw)
    return c
