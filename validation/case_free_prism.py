"""A prism that spins freely: what must stay stays, and its middle axis is unstable."""

import math

import ladder
import world

LONG = False
SIZE, DENSITY = (10.0, 4.0, 1.0), 920.0
MASS = DENSITY * SIZE[0] * SIZE[1] * SIZE[2]
INERTIA = [MASS / 12 * (SIZE[(i + 1) % 3] ** 2 + SIZE[(i + 2) % 3] ** 2) for i in range(3)]
SPIN, END = 1.0, 40.0
STEPS = [0.02, 0.01, 0.005]
# Which axis is upright, but for half a degree: roll and pitch of the floe.
STARTS = {"smallest (x)": (0.5, -89.5), "middle (y)": (89.5, 0.5), "largest (z)": (0.5, 0.5)}


def scene(roll, pitch):
    return (f"environment: {{water: false}}\nvessel: {{present: false}}\ndomain: {{boundary: open}}\n"
            f"ice: {{source: floes, density: {DENSITY}, thickness: {SIZE[2]}, floes: [ ] }}\n").replace(
        "floes: [ ] }", f"floes: [{{length: {SIZE[0]}, width: {SIZE[1]}, elevation: 0, spin: {SPIN}, "
                        f"roll_deg: {roll}, pitch_deg: {pitch}}}]}}")


def local(state, v):
    """A global vector in the prism's own axes."""
    w, x, y, z = state.orientation
    return world.turned((w, -x, -y, -z), v)


def euler(first, times):
    """The spin about the own axes at these times: Euler's equations by Runge and Kutta's method in steps of 1 ms."""
    def rate(o):
        return [(INERTIA[(i + 1) % 3] - INERTIA[(i + 2) % 3]) / INERTIA[i] * o[(i + 1) % 3] * o[(i + 2) % 3]
                for i in range(3)]

    found, now, o, dt = [], 0.0, list(first), 1e-3
    for t in times:
        for _ in range(round((t - now) / dt)):
            a = rate(o)
            b = rate([x + dt / 2 * y for x, y in zip(o, a)])
            c = rate([x + dt / 2 * y for x, y in zip(o, b)])
            d = rate([x + dt * y for x, y in zip(o, c)])
            o = [x + dt / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(o, a, b, c, d)]
        now = t
        found.append(tuple(o))
    return found


def follow(roll, pitch, dt):
    """Times, spin in own axes, largest drift of angular momentum and of energy."""
    with world.World(scene(roll, pitch), "free_prism", run__time_step=dt) as w:
        def look():
            s = w.bodies("floe")[0][1]
            o = local(s, s.angular_velocity)
            turn = world.turned(s.orientation, [i * x for i, x in zip(INERTIA, o)])
            return o, turn, 0.5 * sum(i * x * x for i, x in zip(INERTIA, o))

        first = look()
        times, spins, momentum, energy = [0.0], [first[0]], 0.0, 0.0
        while w.time < END - 1e-9:
            w.step(round(0.1 / dt))
            o, turn, e = look()
            away = [a - b for a, b in zip(turn, first[1])]
            momentum = ladder.greatest(momentum, world.length(away) / world.length(first[1]))
            energy = ladder.greatest(energy, abs(e / first[2] - 1))
            times.append(round(w.time, 6))
            spins.append(o)
    return times, spins, momentum, energy


def case(out):
    c = ladder.Case(
        "A prism that spins freely",
        1,
        f"A prism of 10 x 4 x 1 m at 1 rad/s about each of its axes, half a degree off, without any force for {END:g} "
        f"s.",
        "Euler's equations, integrated by the Runge-Kutta method with steps of 1 ms from the same start.",
        "Angular momentum and energy to 1e-9 at any time step (implicit midpoint rule); spin about the smallest "
        "and the largest axis stays near it, about the intermediate one tumbles; first order in dt or better.",
    )
    c.header = ["upright axis", "dt [s]", "momentum, drift", "energy, drift", "largest error of the spin "
                                                                              "[rad/s]", "order"]
    picture = None
    for name, (roll, pitch) in STARTS.items():
        errors = []
        for dt in STEPS:
            times, spins, momentum, energy = follow(roll, pitch, dt)
            exact = euler(spins[0], times)
            errors.append(ladder.greatest(world.length([a - b for a, b in zip(o, e)]) for o, e in zip(spins, exact)))
            order = math.log2(errors[-2] / errors[-1]) if len(errors) > 1 else None
            c.rows.append([name, dt, f"{momentum:.1e}", f"{energy:.1e}", f"{errors[-1]:.2e}",
                           "" if order is None else f"{order:.2f}"])
            c.check(momentum <= 1e-9 and energy <= 1e-9, f"{name}, dt {dt}: momentum {momentum:.0e}, energy "
                                                         f"{energy:.0e}")
            if order is not None:
                c.check(order >= 0.95, f"{name}, dt {dt}: order {order:.2f}, at least 0.95")
        axis = "xyz".index(name[-2])
        turned_over = min(o[axis] / spins[0][axis] for o in spins) < -0.5
        c.check(turned_over == name.startswith("middle"), f"{name}: {'turns over' if turned_over else 'stays'}")
        if name.startswith("middle"):
            picture = (times, spins, exact)

    def draw(axes):
        times, spins, exact = picture
        for i, label in enumerate("xyz"):
            line, = axes.plot(times, [o[i] for o in spins], label=f"about {label}")
            axes.plot(times[::8], [o[i] for o in exact[::8]], "o", mfc="none", ms=4, color=line.get_color())
        axes.set(xlabel="time [s]", ylabel="spin in own axes [rad/s]")
        axes.legend(loc="lower left")

    ladder.figure(c, out, "free_prism", "Intermediate axis upright: Fram (lines) and Euler's equations (circles).",
                  draw)
    return c
