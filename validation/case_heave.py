"""A box bobs: the solution is known, and the error must fall with the time step."""

import math

import ladder

LONG = False
LENGTH, BEAM, DRAUGHT, DENSITY, GRAVITY = 60.0, 18.0, 4.0, 1025.0, 9.81
STEPS = [0.04, 0.02, 0.01, 0.005, 0.0025]
SCENE = """run: {{duration: 20, time_step: 0.02}}
ice: {{source: none}}
domain: {{boundary: open}}
environment: {{hull_drag: {{water_form: 0, water_skin: 0, air_form: 0, air_skin: 0}}}}
vessel: {{mode: free, mass: {mass}, hull: {{form: box, length: 60, beam: 18, draught: 4, freeboard: 6}}}}
"""


def case(out):
    c = ladder.Case(
        "Heave of a box",
        3,
        "A box released 0.25 m above its equilibrium without drag or added mass: position over 20 s beside the exact "
        "cosine, at five time steps.",
        "z = -A (1 - cos w t), w^2 = rho g Awp / m (hydrostatics of a wall-sided body).",
        "First order in dt: the integrator is semi-implicit Euler.",
    )
    area = LENGTH * BEAM
    mass = DENSITY * area * (DRAUGHT + 0.25)
    frequency = math.sqrt(DENSITY * GRAVITY * area / mass)
    errors, last = [], None
    c.header = ["dt [s]", "largest error [m]", "order"]
    for dt in STEPS:
        series = ladder.run(SCENE.format(mass=mass), f"heave/{dt:g}", run__time_step=dt)
        start = series["position_z"][0]
        exact = [-0.25 * (1 - math.cos(frequency * t)) for t in series["time"]]
        # The record begins after the first step; the height of the centre of mass in the design position is unknown
        # to it, and follows from the exact motion then.
        offset = start - exact[0]
        errors.append(ladder.greatest(abs(z - offset - e) for z, e in zip(series["position_z"], exact)))
        last = (series["time"], [z - offset for z in series["position_z"]], exact)
    orders = ladder.observed_order(errors)
    for dt, error, order in zip(STEPS, errors, [None, *orders]):
        c.rows.append([dt, f"{error:.3e}", "" if order is None else f"{order:.3f}"])
    least = ladder.least(orders)
    c.check(least >= 0.95, f"observed orders {least:.3f} to {max(orders):.3f}, at least 0.95")

    def draw(axes):
        axes.loglog(STEPS, errors, "o-", label="largest error")
        axes.loglog(STEPS, [errors[0] * dt / STEPS[0] for dt in STEPS], "k:", label="first order")
        axes.set(xlabel="time step [s]", ylabel="[m]")
        axes.legend()

    ladder.figure(c, out, "heave_order", "Largest error over 20 s.", draw)

    def draw_motion(axes):
        axes.plot(last[0], last[2], "k", lw=2.5, alpha=0.3, label="exact")
        axes.plot(last[0], last[1], "--", label=f"Fram, dt = {STEPS[-1]} s")
        axes.set(xlabel="time [s]", ylabel="heave [m]")
        axes.legend(loc="upper right")

    ladder.figure(c, out, "heave_motion", "Heave.", draw_motion)
    return c
