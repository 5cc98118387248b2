"""Impacts limited by crushing, against their closed forms."""

import math

import ladder
import world

LONG = False
MASS, SPEED, STRENGTH = 92000.0, 0.5, 2e6


def scene(corner_first, exponent):
    reach = math.sqrt(50) if corner_first else 5.0
    return f"""environment: {{water: false}}
vessel: {{present: false}}
run: {{solver: {{kind: accurate, tolerance: 1.0e-12}}}}
domain: {{x_min: -100, x_max: {reach:.17g}, y_min: -100, y_max: 100, boundary: walls, wall_height: 60}}
ice:
  source: floes
  density: 920
  crushing_strength: {STRENGTH}
  crushing_exponent: {exponent}
  cap_ice_wall: true
  floes: [x]
""".replace("floes: [x]", f"floes:\n    - {{length: 10, width: 10, elevation: 0, velocity_x: {SPEED}, "
                          f"yaw_deg: {45 if corner_first else 0}}}")


def impact(corner_first, exponent, dt):
    """Largest force, penetration, time of the stop, speed afterwards, and the histories."""
    with world.World(scene(corner_first, exponent), "crushing", run__time_step=dt) as w:
        slot = w.bodies("floe")[0][0]
        speed, start = SPEED, w.body(slot).position[0]
        times, forces, ways, stop = [], [], [], None
        for _ in range(6000):
            w.step()
            s = w.body(slot)
            force = MASS * (speed - s.velocity[0]) / dt
            if speed > 1e-9 >= s.velocity[0]:
                # The last step needs a part of the cap only: the stop falls inside it.
                stop = w.time - dt + dt * min(1, force / max(forces, default=force))
            speed = s.velocity[0]
            times.append(w.time)
            forces.append(force)
            ways.append(s.position[0] - start)
            if stop is not None and w.time > stop + 20 * dt:
                break
        return ladder.greatest(forces), ladder.greatest(ways), stop, abs(speed), (times, forces, ways)


def exact(corner_first, exponent):
    """F = K d^n: largest force, penetration and the time of the stop."""
    if not corner_first:
        force = STRENGTH * 10
        return force, MASS * SPEED**2 / (2 * force), MASS * SPEED / force
    n = 1 + exponent
    k = STRENGTH * 2**n  # A = 2 h d with h = 1 m
    depth = ((n + 1) * MASS * SPEED**2 / (2 * k)) ** (1 / (n + 1))
    # The way over d_max, u, goes at v/d_max sqrt(1 - u^(n+1)): the integral of its inverse is a beta function.
    whole = math.sqrt(math.pi) * math.gamma(1 + 1 / (n + 1)) / math.gamma(0.5 + 1 / (n + 1))
    return k * depth**n, depth, whole * depth / SPEED


def wall_into_floe(trims):
    """Forces on a vertical wall of 6 m that is driven three thicknesses (0.8 m) into a fixed floe."""
    text = f"""run: {{time_step: 0.01}}
environment: {{water: false}}
domain: {{boundary: open}}
vessel: {{mode: prescribed, x: -5, speed: 0.5, hull: {{form: box, length: 10, beam: 6, draught: 5, freeboard: 5}}}}
ice:
  source: floes
  crushing_strength: {STRENGTH}
  crush_trims: {trims}
  floes:
    - {{length: 30, width: 20, thickness: 0.8, x: 15, elevation: 0, fixed: true}}
"""
    with world.World(text, "crushing") as w:
        found = []
        while w.time < 3 * 0.8 / 0.5 - 1e-9:
            w.step()
            found.append(w.ice_force())
        return found[1:]  # the first step only touches


def case(out):
    c = ladder.Case(
        "Impacts limited by crushing",
        2,
        "A floe of 92 t at 0.5 m/s meets a wall: with its face, with a corner, and with a corner under a "
        "pressure-area law of exponent -0.1; and a vertical wall that is driven three thicknesses into a fixed "
        "floe.",
        "Closed forms: F = K d^n, d_max = ((n+1) m v^2/(2 K))^(1/(n+1)), stop after d_max/v B(1/(n+1), 1/2)/(n+1).",
        "First order in dt for times and penetrations; forces to 1e-3; no rebound; the wall's force is sigma_c L h at "
        "every step and level, however deep (1 % where crushed ice is cut away: a bound set after a first run).",
    )
    c.header = ["impact", "dt [ms]", "force [kN]", "exact", "penetration [mm]", "exact", "order", "stop [s]", "exact"]
    curve = None
    for name, corner_first, exponent, steps in (("face", False, 0, (2e-4, 1e-4, 5e-5)),
                                                ("corner", True, 0, (4e-3, 2e-3, 1e-3)),
                                                ("corner, A^-0.1", True, -0.1, (4e-3, 2e-3, 1e-3))):
        force, depth, end = exact(corner_first, exponent)
        errors, late = [], []
        for dt in steps:
            f, d, t, rebound, history = impact(corner_first, exponent, dt)
            errors.append(abs(d - depth))
            late.append(abs(t - end))
            order = math.log2(errors[-2] / errors[-1]) if len(errors) > 1 and errors[-1] > 1e-12 else None
            c.rows.append([name, f"{1e3 * dt:g}", f"{f / 1e3:.3f}", f"{force / 1e3:.3f}", f"{1e3 * d:.4f}",
                           f"{1e3 * depth:.4f}", "" if order is None else f"{order:.2f}", f"{t:.6f}", f"{end:.6f}"])
        c.check(abs(f / force - 1) <= 1e-3, f"{name}: force off by {abs(f / force - 1):.1e}, at most 1e-3")
        c.check(errors[-1] <= 0.05 * depth, f"{name}: penetration off by {100 * errors[-1] / depth:.2f} %, at most 5 %")
        c.check(order is None or order >= 0.9, f"{name}: observed order "
                + (f"{order:.2f}" if order is not None else "none (exact)") + ", at least 0.9")
        exact_stop = late[-1] < 1e-9
        stop_order = math.inf if exact_stop else ladder.observed_order(late)[-1]
        c.check(stop_order >= 0.9, f"{name}: stop {1e3 * late[-1]:.2f} ms off at the smallest step, observed order "
                + ("none (exact)" if exact_stop else f"{stop_order:.2f}") + ", at least 0.9")
        c.check(rebound < 1e-6, f"{name}: stands still after the stop, to {rebound:.0e} m/s")
        if name == "corner":
            curve = history
    cap = STRENGTH * 6 * 0.8
    for trims, allowed in (("false", 1e-6), ("true", 1e-2)):
        wall = wall_into_floe(trims)
        spread = ladder.greatest(abs(-f[0] / cap - 1) for f in wall)
        level = ladder.greatest(abs(f[2]) / cap for f in wall)
        name = f"wall, crush_trims {trims}"
        c.rows.append([f"{name}, 3 h deep", "10", f"{-min(f[0] for f in wall) / 1e3:.3f}", f"{cap / 1e3:.3f}",
                       *5 * [""]])
        c.check(spread <= allowed, f"{name}: force off sigma_c L h by {spread:.1e} at most, at any of {len(wall)} "
                                   f"steps; {allowed:g} allowed")
        c.check(level <= 1e-9, f"{name}: vertical part of its force {level:.0e}, at most 1e-9")
    c.found = ("Where crushed ice is cut away (crush_trims, on for fixed and level ice), a rim of the edge threshold "
               "stays beside the hull and adds 0.1 % to the load. An impact that ends within one step, as the face "
               "would at dt = 10 ms, is a perfectly plastic stop: the impulse is right, the force is not (mass times "
               "speed over dt). Errors of a corner's penetration, a micrometre, "
               "do not fall monotonically: the order is checked between the last two steps only.")

    def draw(axes):
        times, forces, ways = curve
        k = 2 * STRENGTH
        w = math.sqrt(k / MASS)
        end = math.pi / 2 / w
        axes[0].plot(times, [f / 1e3 for f in forces], label="Fram, dt = 1 ms")
        axes[0].plot([end * i / 100 for i in range(101)],
                     [k * SPEED / w * math.sin(w * end * i / 100) / 1e3 for i in range(101)], "k--", label="exact")
        axes[0].set(xlabel="time [s]", ylabel="force [kN]")
        axes[0].legend()
        end = ways.index(max(ways))
        axes[1].plot([1e3 * d for d in ways[:end]], [f / 1e3 for f in forces[:end]])
        axes[1].plot([0, 1e3 * SPEED / w], [0, k * SPEED / w / 1e3], "k--")
        axes[1].set(xlabel="penetration [mm]", ylabel="force [kN]")

    ladder.figure(c, out, "crushing", "Corner into a wall, constant crushing strength.", draw, panels=2)
    return c
