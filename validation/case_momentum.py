"""Floes that collide without water: momentum stays, energy does not grow."""

import ladder
import world

LONG = False
SIDE, THICKNESS, DENSITY, COUNT = 8.0, 1.0, 900.0, 5
ABOUT, ACROSS = SIDE**2 / 6, (SIDE**2 + THICKNESS**2) / 12  # moments of inertia over the mass [m2]


def scene():
    """25 square floes at random that collide: drawn by a small fixed generator, with no library's."""
    lines, state = [], 12345

    def draw():
        nonlocal state
        state = (1103515245 * state + 12345) % 2**31
        return state / 2**31

    for i in range(COUNT):
        for k in range(COUNT):
            x, y = 13 * (i - 2), 13 * (k - 2)
            lines.append(f"    - {{length: {SIDE}, width: {SIDE}, x: {x}, y: {y}, elevation: 0, "
                         f"yaw_deg: {360 * draw():.6f}, velocity_x: {-0.2 * (i - 2) + 0.4 * draw() - 0.2:.6f}, "
                         f"velocity_y: {-0.2 * (k - 2) + 0.4 * draw() - 0.2:.6f}, spin: {0.2 * draw() - 0.1:.6f}}}")
    return ("run: {time_step: 0.02}\nvessel: {present: false}\nenvironment: {water: false}\n"
            "domain: {x_min: -1000, x_max: 1000, y_min: -1000, y_max: 1000, boundary: open}\n"
            f"ice:\n  source: floes\n  density: {DENSITY}\n  thickness: {THICKNESS}\n  floes:\n" + "\n".join(lines))


def books(w):
    """Linear momentum, angular momentum about the origin (vertical part), kinetic energy."""
    px = py = turn = energy = 0.0
    for _, s in w.bodies("floe"):
        m, v, r = s.mass, s.velocity, s.position
        axis = world.turned(s.orientation, (0, 0, 1))
        along = world.dot(axis, s.angular_velocity)
        # Of a square plate: one moment about its axis, another about every line across it.
        spin = [m * (ACROSS * o + (ABOUT - ACROSS) * along * a) for o, a in zip(s.angular_velocity, axis)]
        px, py = px + m * v[0], py + m * v[1]
        turn += m * (r[0] * v[1] - r[1] * v[0]) + spin[2]
        energy += 0.5 * (m * world.dot(v, v) + world.dot(spin, s.angular_velocity))
    return px, py, turn, energy


def follow(kind, rigid):
    """Largest drifts and the energy over time.  Overlap of floes that yield to each other is crushed ice, which no
    position correction moves: it acts on rigid ones."""
    keys = {"run__solver__kind": kind}
    if rigid:
        keys["ice__cap_ice_ice"] = "false"
    with world.World(scene(), "momentum", **keys) as w:
        first = books(w)
        scale = sum(s.mass * world.length(s.velocity) for _, s in w.bodies("floe"))
        arm = sum(s.mass * world.length(s.velocity) * world.length(s.position) for _, s in w.bodies("floe"))
        times, energies, linear, angular, growth = [0], [1.0], 0.0, 0.0, 0.0
        while w.time < 60 - 1e-9:
            w.step()
            now = books(w)
            linear = ladder.greatest(linear, abs(now[0] - first[0]) / scale, abs(now[1] - first[1]) / scale)
            angular = ladder.greatest(angular, abs(now[2] - first[2]) / arm)
            growth = ladder.greatest(growth, now[3] / first[3] - energies[-1])
            times.append(w.time)
            energies.append(now[3] / first[3])
    return linear, angular, growth, (times, energies)


def case(out):
    c = ladder.Case(
        "Momentum and energy of colliding floes",
        1,
        "25 square floes of 8 m collide without water or gravity for 60 s, restitution 0, friction 0.3; "
        "with each of the three solvers: floes that yield to each other, as by default, and rigid ones "
        "(`ice.cap_ice_ice: false`), whose overlap is corrected.",
        "Newton's laws: the forces between floes cancel.",
        "Contacts: linear and angular momentum to 1e-10 of the sum of their magnitudes, and kinetic energy never "
        "increases "
        "(1e-12 of the first a step for rounding). Position correction moves bodies without a velocity: it does not "
        "change linear momentum, and changes the angular momentum about a fixed point slightly; its bounds, 1e-4 and "
        "1e-8 of energy a step, were set after a first run and predict nothing.",
    )
    c.header = ["solver", "floes", "linear momentum, drift", "angular momentum, drift",
                "largest growth of energy in a step", "energy left"]
    curves, turned = {}, 0.0
    for rigid in (False, True):
        for kind in ("sequential", "fast", "accurate"):
            linear, angular, growth, curve = follow(kind, rigid)
            c.rows.append([kind, "rigid, corrected" if rigid else "yield", f"{linear:.1e}", f"{angular:.1e}",
                           f"{growth:.1e}", f"{curve[1][-1]:.4f}"])
            c.check(linear <= 1e-10, f"{kind}, {'rigid' if rigid else 'yielding'} floes: linear momentum")
            if rigid:
                curves[kind] = curve
                turned = max(turned, angular)
                c.check(angular <= 1e-4, f"{kind}: angular momentum drifts by {angular:.1e} of its magnitude in 60 s, "
                                         "at most 1e-4 with correction")
                c.check(growth <= 1e-8, f"{kind}: energy grows by {growth:.1e} in a step at most, 1e-8 with correction")
            else:
                c.check(angular <= 1e-10, f"{kind}: angular momentum drifts by {angular:.1e}, at most 1e-10")
                c.check(growth <= 1e-12, f"{kind}: energy grows by {growth:.1e} in a step at most, at most 1e-12")
    c.check(turned > 1e-9, f"rigid floes are corrected: it shows in their angular momentum, by {turned:.1e}")
    c.found = ("Contacts conserve to rounding. Position correction rotates a tilted, spinning floe very slightly and "
               "keeps its velocities, which is where the drifts of rigid floes come from; they are far smaller than "
               "any drag. Floes that yield, as by default, are not corrected "
               "([0111](../decisions/0111-ice-yields-to-ice.md)): there correction changes no bit.")

    def draw(axes):
        for kind, style in zip(curves, ("-", "--", ":")):
            axes.plot(*curves[kind], style, label=kind)
        axes.set(xlabel="time [s]", ylabel="kinetic energy / first", ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "momentum", "Kinetic energy: collisions are plastic and dissipate it.", draw)
    return c
