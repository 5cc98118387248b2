"""Free decay of a vessel with added mass and linear damping: the damped oscillator."""

import math

import ladder
import world

LONG = False
RHO, G, LENGTH, BEAM, DRAUGHT = 1025.0, 9.81, 60.0, 18.0, 4.0
MASS = RHO * LENGTH * BEAM * DRAUGHT
STEPS = [0.04, 0.02, 0.01]
END = 30.0
# Inertia and stiffness about the centre of mass, which lies in the waterline: KB - KG = -2 m.
GM = BEAM**2 / 12 / DRAUGHT - DRAUGHT / 2
GML = LENGTH**2 / 12 / DRAUGHT - DRAUGHT / 2
MOTIONS = {"heave": (MASS, RHO * G * LENGTH * BEAM, 1.2 * MASS, 0.2, 0.1),
           "roll": (MASS * (0.35 * BEAM) ** 2, MASS * G * GM, 0.3 * MASS * (0.35 * BEAM) ** 2, 0.05, math.radians(0.3)),
           "pitch": (MASS * (0.25 * LENGTH) ** 2, MASS * G * GML, MASS * (0.25 * LENGTH) ** 2, 0.15, math.radians(0.1))}


def oscillator(name):
    """Whole inertia, damping coefficient, undamped frequency, damping ratio, amplitude."""
    own, stiffness, added, ratio, amplitude = MOTIONS[name]
    whole = own + added
    return whole, 2 * ratio * math.sqrt(stiffness * whole), math.sqrt(stiffness / whole), ratio, amplitude


def scene(name):
    zero = {n: "surge: 0" for n in ("surge", "sway", "heave", "roll", "pitch", "yaw")}
    added = {**zero, name: f"{name}: {MOTIONS[name][2]:.17g}"}
    damping = {**zero, name: f"{name}: {oscillator(name)[1]:.17g}"}

    def rows(of):
        return "".join(f"      - {{{of[n]}}}\n" for n in zero)

    return f"""run: {{duration: 60}}
ice: {{source: none}}
domain: {{boundary: open}}
environment: {{hull_drag: {{water_form: 0, water_skin: 0, air_form: 0, air_skin: 0}}}}
vessel:
  mode: free
  centre_of_gravity_z: 0
  hull: {{form: box, length: {LENGTH}, beam: {BEAM}, draught: {DRAUGHT}, freeboard: 6}}
  hydrodynamics:
    source: given
    added_mass:
{rows(added)}    damping:
{rows(damping)}"""


def follow(name, dt):
    """Times and displacement after a blow, and the speed right after the blow."""
    whole, _, frequency, _, amplitude = oscillator(name)
    push = whole * amplitude * frequency / dt
    with world.World(scene(name), "decay", run__time_step=dt) as w:
        slot, first = w.bodies("vessel")[0]
        force, moment = [0, 0, 0], [0, 0, 0]
        if name == "heave":
            force[2] = push
        else:
            moment[0 if name == "roll" else 1] = push
        w.push(slot, force, moment)
        times, ways = [0.0], [0.0]
        while w.time < END - 1e-9:
            w.step()
            s = w.body(slot)
            at = {"heave": s.position[2] - first.position[2], "roll": 2 * s.orientation[1],
                  "pitch": 2 * s.orientation[2]}
            times.append(w.time)
            ways.append(at[name])
        return times, ways


def exact(name, t):
    _, _, w, z, amplitude = oscillator(name)
    damped = w * math.sqrt(1 - z * z)
    return amplitude * w / damped * math.exp(-z * w * t) * math.sin(damped * t)


def case(out):
    c = ladder.Case(
        "Free decay of a vessel",
        2,
        f"A box of {LENGTH:g} x {BEAM:g} x {DRAUGHT:g} m with given added mass and linear damping is given an "
        f"impulse in heave, roll and pitch and then left free for {END:g} s, at three time steps.",
        "The damped oscillator, a exp(-z w t) sin(w' t), with w^2 = K/(M + A), K = rho g Awp, m g GM, m g GM_L.",
        "First order in dt; within 2 % of the amplitude at 0.01 s. Amplitudes of 0.1 m, 0.3 and 0.1 degrees: small "
        "enough for a linear response.",
    )
    c.header = ["motion", "undamped period [s]", "damping ratio", "dt [s]", "largest error / amplitude", "order"]
    curves = {}
    for name in MOTIONS:
        _, _, w, z, amplitude = oscillator(name)
        errors = []
        for dt in STEPS:
            times, ways = follow(name, dt)
            errors.append(ladder.greatest(abs(x - exact(name, t)) for t, x in zip(times, ways)) / amplitude)
            order = math.log2(errors[-2] / errors[-1]) if len(errors) > 1 else None
            c.rows.append([name, f"{2 * math.pi / w:.4f}", z, dt, f"{errors[-1]:.2e}",
                           "" if order is None else f"{order:.2f}"])
        curves[name] = (times, [x / amplitude for x in ways])
        orders = ladder.observed_order(errors)
        c.check(ladder.least(orders) >= 0.9, f"{name}: observed orders {orders[0]:.2f}, {orders[1]:.2f}, at least 0.9")
        c.check(errors[-1] <= 0.02, f"{name}: {100 * errors[-1]:.2f} % of the amplitude off at 0.01 s, at most 2 %")

    def draw(axes):
        for name, (times, ways) in curves.items():
            line, = axes.plot(times, ways, label=name)
            axes.plot(times[::60], [exact(name, t) / MOTIONS[name][4] for t in times[::60]], "o", mfc="none", ms=4,
                      color=line.get_color())
        axes.set(xlabel="time [s]", ylabel="displacement / a")
        axes.legend()

    ladder.figure(c, out, "decay", "Fram (lines, dt 0.01 s) and the damped oscillator (circles).", draw)
    return c
