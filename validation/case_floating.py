"""Bodies afloat: volumes, levers, and the periods of a floe."""

import math

import ladder
import world

LONG = False
RHO, ICE, GRAVITY = 1025.0, 920.0, 9.81
CUBE = [(0.2, 0.00692820323), (0.5, 0.1082531755), (math.sqrt(3) / 2, 0.5), (1.6, 0.9980058684)]
LEVERS = [(5, 0.0730745278), (15, 0.2280707852), (26, 0.4348300074)]


def cube_volume(t):
    """Volume of the unit cube below a distance t from its lowest corner along the diagonal."""
    u = t * math.sqrt(3)
    return sum((-1) ** k * math.comb(3, k) * max(0, u - k) ** 3 for k in range(4)) / 6


def cube():
    """The unit cube with a diagonal upright, lowest corner in the origin."""
    a, b, c = 1 / math.sqrt(2), 1 / math.sqrt(6), 1 / math.sqrt(3)

    def turn(x, y, z):
        return ((x - y) * a, (x + y - 2 * z) * b, (x + y + z) * c)

    path = ladder.WORK / "floating" / "cube.obj"
    ladder.box_obj(path, (0, 0, 0), (1, 1, 1), turn)
    return path


def lever(heel):
    """GZ of a box of 10 x 4 x 2 m at half the water's density: its centre is in the water plane at any heel."""
    co, si = math.cos(math.radians(heel)), math.sin(math.radians(heel))
    path = ladder.WORK / "floating" / "box.obj"
    ladder.box_obj(path, (-5, -2, -1), (5, 2, 1), lambda x, y, z: (x, co * y - si * z, si * y + co * z))
    return abs(ladder.answer("hull", path)["centre_of_buoyancy_m"][1])


SCENE = """run: {duration: 100}
vessel: {present: false}
domain: {boundary: open}
environment: {ice_drag: {water_form: 0, water_skin: 0, air_form: 0, air_skin: 0}}
ice:
  source: floes
  density: 920
  floes: [x]
"""


def period(dt, floe, look):
    """Mean period over ten, from upward zero crossings."""
    with world.World(SCENE.replace("floes: [x]", f"floes:\n    - {{length: 10, width: 10{floe}}}"), "floating",
                     run__time_step=dt) as w:
        crossings, before = [], None
        while len(crossings) < 11:
            w.step()
            now = look(w.body(0))
            if before is not None and before < 0 <= now:
                crossings.append(w.time - dt * now / (now - before))
            before = now
        return (crossings[-1] - crossings[0]) / 10


def case(out):
    c = ladder.Case(
        "Floating bodies",
        2,
        "Volume of a cube with its diagonal upright at four immersions; righting lever of a box; draught and the "
        "periods of heave and roll of a floe of 10 x 10 x 1 m without added mass.",
        "Closed forms: inclusion and exclusion of corners; BM + tan^2 of a wall-sided box; rho g Awp / m; GM = 9.2332 "
        "m.",
        "Volumes, levers and draught to 1e-9: pressure is integrated exactly over clipped triangles. Periods "
        "converge at second order in dt (semi-implicit Euler changes the period only at second order); roll has a "
        "finite amplitude of 0.5 degrees. The check asks for first order only.",
    )
    c.header = ["quantity", "found", "exact", "relative difference"]
    path, worst = cube(), 0.0
    for t, exact in CUBE:
        found = ladder.answer("hull", path, "--draught", t)["volume_m3"]
        worst = ladder.greatest(worst, abs(found / exact - 1))
        c.rows.append([f"cube, immersion {t:.4g} m: volume", f"{found:.10g} m3", f"{exact:.10g}",
                       f"{found / exact - 1:.1e}"])
    c.check(worst <= 2e-9, f"volumes to {worst:.0e}, at most 2e-9 (digits of the source)")
    worst = 0.0
    for heel, exact in LEVERS:
        found = lever(heel)
        worst = ladder.greatest(worst, abs(found / exact - 1))
        c.rows.append([f"box, GZ at {heel} deg", f"{found:.10g} m", f"{exact:.10g}", f"{found / exact - 1:.1e}"])
    c.check(worst <= 2e-9, f"levers to {worst:.0e}, at most 2e-9")

    draught = ICE / RHO
    with world.World(SCENE.replace("floes: [x]", "floes:\n    - {length: 10, width: 10}"), "floating") as w:
        w.step(100)
        found = 0.5 - w.body(0).position[2]
    c.rows.append(["floe, draught", f"{found:.10g} m", f"{draught:.10g}", f"{found / draught - 1:.1e}"])
    c.check(abs(found / draught - 1) <= 1e-9, f"draught to {abs(found / draught - 1):.0e}")

    gm = 10**2 / 12 / draught + draught / 2 - 0.5
    exact = {"heave": 2 * math.pi * math.sqrt(draught / GRAVITY),
             "roll": 2 * math.pi * math.sqrt((100 + 1) / 12 / (GRAVITY * gm))}
    looks = {"heave": (f", elevation: {0.5 - draught + 0.02}", lambda s: s.position[2] - (0.5 - draught)),
             "roll": (", roll_deg: 0.5", lambda s: s.orientation[1])}
    steps, errors = (0.02, 0.01, 0.005), {}
    for name in exact:
        errors[name] = []
        for dt in steps:
            found = period(dt, *looks[name])
            errors[name].append(abs(found / exact[name] - 1))
            c.rows.append([f"floe, period of {name}, dt {dt}", f"{found:.8g} s", f"{exact[name]:.8g}",
                           f"{found / exact[name] - 1:.1e}"])
        order = math.log2(errors[name][0] / errors[name][1])
        c.check(order >= 0.95, f"{name}: observed order {order:.2f}, at least 0.95")
        c.check(errors[name][-1] <= 1e-4, f"{name}: period to {errors[name][-1]:.1e} at dt = {steps[-1]} s, at most "
                                          f"1e-4")

    def draw(axes):
        fine = [math.sqrt(3) * i / 200 for i in range(201)]
        axes[0].plot(fine, [cube_volume(t) for t in fine], label="exact")
        axes[0].plot([t for t, _ in CUBE], [ladder.answer("hull", path, "--draught", t)["volume_m3"] for t, _ in CUBE],
                     "o", mfc="none", label="Fram")
        axes[0].set(xlabel="immersion of the cube [m]", ylabel="volume [m³]")
        axes[0].legend()
        for name, values in errors.items():
            axes[1].loglog(steps, values, "o-", label=name)
        axes[1].loglog(steps, [errors["heave"][0] * (dt / steps[0]) ** 2 for dt in steps], "k:", label="second order")
        axes[1].set(xlabel="time step [s]", ylabel="relative error of the period")
        axes[1].set_xticks(steps, [f"{dt:g}" for dt in steps])
        axes[1].minorticks_off()
        axes[1].legend()

    ladder.figure(c, out, "floating", "A cube on its corner, and the periods of a floe.", draw, panels=2)
    return c
