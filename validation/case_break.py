"""A whole break, end to end: an inclined plate driven into the straight edge of level ice."""

import math

import ladder

LONG = False
# By Nevel's wedge with the load of the patch at the moment of breaking (closed system of one unknown, solved to 1e-6).
FORCE, TIME, RADIUS, LOADED = 311.743e3, 0.779357, 4.14196, 0.299987
# Of an edge that gives: the tip is down by P eta(0)/(k sum(b0) l^2) = 0.090725 m then, eta(0) = 2.1632.
LATER = 1.686608
# The break comes half a step late with all of these, which shows the order; elsewhere within the step with those.
HALF_LATE = [TIME / (n - 0.5) for n in (25, 50, 100, 200, 400)]
OTHERS = [0.017, 0.0041]
STEPS = sorted(HALF_LATE + OTHERS, reverse=True)


def scene(slope, friction, name, gives="false"):
    """Ice of 1 m whose middle plane is z = 0, edge at x = 0; a plate 2 m wide that leans by slope (x over z)."""
    hull = ladder.WORK / "break" / f"{name}.obj"
    ladder.box_obj(hull, (-10, -1, -3), (0, 1, 3), lambda x, y, z: (x + slope * z, y, z))
    return f"""run: {{duration: 0.9}}
environment: {{water: true, current_speed: 0}}
domain: {{boundary: open}}
vessel: {{mode: prescribed, x: {-0.5 * abs(slope):.17g}, speed: 0.1, hull: {{form: file, file: {hull}}}}}
ice:
  source: floes
  breakable: true
  crushing_strength: 2.0e6
  friction: {{ice_hull_static: {friction}, ice_hull_kinetic: {friction}}}
  fracture: {{thick_plate_radius: false, wide_contacts: false, edge_compliance: {gives}, edge_inertia: false}}
  floes:
    - {{length: 60, width: 80, x: 30, elevation: 0, thickness: 1, fixed: true}}
output: {{frame_interval: 0}}
"""


def ratio(angle, friction):
    """Horizontal over vertical force of a plate at an angle to the water, before anything breaks."""
    slope = 1 / math.tan(math.radians(angle))
    series = ladder.run(scene(slope, friction, f"friction_{angle}"), f"break/friction_{angle}", run__time_step=0.01,
                        run__duration=0.2, ice__breakable="false")
    return abs(series["ice_force_x"][-1] / series["ice_force_z"][-1])


def case(out):
    c = ladder.Case(
        "A whole break",
        2,
        "A plate 2 m wide at 45 degrees, frictionless, driven at 0.1 m/s into the edge of fixed ice of 1 m, its load "
        "taken as narrow (`wide_contacts: false`; wide ones are in [their own page](plates.md)): crushing, load, "
        "bending, cut; downward and upward, with a rigid edge and with a compliant one; and the "
        "direction of the load with friction.",
        "Nevel's wedge (1961) with the load of the patch, N = 3: breaks at 311.743 kN, 0.779357 s after first contact, "
        "R_bending 4.14196 m; with a compliant edge after 1.686608 s, its tip being down by 0.090725 m then. "
        "F_H/F_V = (sin g + mu cos g)/(cos g - mu sin g).",
        "First order in dt: the break comes with the first step at which the criterion is met, dt at most after it, "
        "and the load goes on growing until then. Five of the steps are successive halvings that all meet the break "
        "half a step late; two meet it elsewhere.",
    )
    c.header = ["plate", "dt [s]", "time of break [s]", "load [kN]", "R_bending [m]", "loaded radius [m]",
                "load, difference"]
    histories, errors = {}, {}
    for name, slope in (("downward", 1.0), ("upward", -1.0)):
        late, loads = [], []
        series = ladder.run_all([(scene(slope, 0, name), f"break/{name}_{dt:.6g}", {"run__time_step": f"{dt:.17g}"})
                                 for dt in STEPS])
        for dt, of_step in zip(STEPS, series):
            event = ladder.fractures(f"break/{name}_{dt:.6g}")
            # The row of a step tells the time at its end; the load is that of its beginning.
            time = event["time"][0] - dt
            late.append(time - TIME)
            loads.append(event["load"][0])
            c.rows.append([name, f"{dt:.6f}", f"{time:.5f}", f"{loads[-1] / 1e3:.3f}",
                           f"{event['crack_length'][0]:.5f}", f"{event['loaded_radius'][0]:.6f}",
                           f"{100 * (loads[-1] / FORCE - 1):.2f} %"])
            histories[name] = of_step
        errors[name] = [p / FORCE - 1 for p in loads]
        orders = ladder.observed_order([e for e, dt in zip(errors[name], STEPS) if dt in HALF_LATE])
        c.check(ladder.least(orders) >= 0.95, f"{name}: observed orders of the load {ladder.least(orders):.2f} to "
                                              f"{max(orders):.2f}, at least 0.95")
        c.check(all(-1e-9 <= t <= dt for t, dt in zip(late, STEPS)), f"{name}: breaks within a step after the exact "
                                                                     f"time")
        c.check(all(0 <= p / FORCE - 1 <= dt / TIME for p, dt in zip(loads, STEPS)),
                f"{name}: load at most dt/t above the exact one; {100 * (loads[-1] / FORCE - 1):.2f} % at dt = "
                f"{STEPS[-1]:.4f} s")
        radius, loaded = event["crack_length"][0] / RADIUS - 1, event["loaded_radius"][0] / LOADED - 1
        c.check(abs(radius) < 2e-3 and abs(loaded) < 2e-3,
                f"{name}: R_bending and loaded radius within 0.2 % at dt = {STEPS[-1]:.4f} s")
    for name, slope in (("downward", 1.0), ("upward", -1.0)):
        for dt in (0.017, 0.0041):
            of = f"break/{name}_gives_{dt:.6g}"
            ladder.run(scene(slope, 0, f"{name}_gives", "true"), of, run__time_step=dt, run__duration=1.8)
            event = ladder.fractures(of)
            time, load = event["time"][0] - dt, event["load"][0]
            c.rows.append([f"{name}, edge gives", f"{dt:.6f}", f"{time:.5f}", f"{load / 1e3:.3f}",
                           f"{event['crack_length'][0]:.5f}", f"{event['loaded_radius'][0]:.6f}",
                           f"{100 * (load / FORCE - 1):.2f} %"])
            c.check(-1e-4 <= time - LATER <= dt + 1e-4 and -1e-4 <= load / FORCE - 1 <= 1.02 * dt / LATER + 1e-4,
                    f"{name}, an edge that gives: breaks after {time:.4f} s, exact {LATER:.4f} s, at the same load, "
                    f"within a step of {dt} s")
    for angle, friction, exact in ((30, 0.1, 0.7189), (60, 0.15, 2.5427)):
        found = ratio(angle, friction)
        c.rows.append([f"F_H/F_V at {angle} deg, mu {friction}", 0.01, f"{found:.5f}", f"exact {exact}", "", "",
                       f"{100 * (found / exact - 1):.3f} %"])
        c.check(abs(found / exact - 1) <= 1e-4, f"F_H/F_V at {angle} degrees with mu {friction}: {found:.4f}, exact "
                                                f"{exact}")

    def draw(axes):
        for name, series in histories.items():
            axes[0].plot(series["time"], [f / 1e3 for f in series["ice_force_z"]], label=name)
        axes[0].plot([0, TIME, TIME, 0], [0, FORCE / 1e3, -FORCE / 1e3, 0], "k:", lw=1, label="exact")
        axes[0].set(xlabel="time [s]", ylabel="vertical force on the plate [kN]")
        axes[0].legend(loc="lower left")
        for (name, found), mark in zip(errors.items(), "ox"):
            axes[1].loglog([1e3 * dt for dt in STEPS], [100 * e for e in found], mark, mfc="none", label=name)
        axes[1].loglog([1e3 * dt for dt in STEPS], [50 * dt / TIME for dt in STEPS], "k:", label="dt/(2 t)")
        axes[1].set(xlabel="time step [ms]", ylabel="load at the break, too high by [%]")
        axes[1].set_xticks([2, 5, 10, 20, 30], ["2", "5", "10", "20", "30"])
        axes[1].set_yticks([0.1, 0.2, 0.5, 1, 2], ["0.1", "0.2", "0.5", "1", "2"])
        axes[1].minorticks_off()
        axes[1].legend()

    ladder.figure(c, out, "break", "Vertical ice force until the ice breaks (smallest step); error of the load that "
                  "breaks it.", draw, panels=2)
    return c
