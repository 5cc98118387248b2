"""Finer meshes of the same hull: hydrostatics, and the load at which ice breaks on it."""

import math

import case_cone
import ladder

LONG = False
FACETS = [6, 12, 24, 48, 96]


def polygon_cone(facets):
    """Volume under water of the cone of the case, with a polygon of that many sides, and of the round one."""
    slope = 1 / math.tan(math.radians(60))
    top, low = case_cone.DIAMETER / 2, case_cone.DIAMETER / 2 + 4 * slope
    area = facets / 2 * math.sin(2 * math.pi / facets)
    mean = (top * top + top * low + low * low) / 3 * 4
    return area * mean, math.pi * mean


def case(out):
    c = ladder.Case(
        "Mesh of the hull",
        3,
        "The fixed cone of 60 degrees as a pyramid of 6 to 96 sides: displaced volume, and horizontal load at the "
        "first break in 1 m of level ice (dt 5 ms).",
        "Volume of the round cone; the load of the finest mesh.",
        "Volume: exact for the mesh, second order in 1/sides to the round one. The load depends on the contact patch "
        "at the cone's nose: convergent, within 5 % from 24 sides on.",
    )
    c.header = ["sides", "volume [m3]", "to its own mesh", "to the round cone", "order", "first break [kN]",
                "to the finest", "R_bending [m]"]
    volumes, loads, radii = [], [], []
    runs = ladder.side_by_side(lambda n: case_cone.first_break(60, 1.0, facets=n, step=0.005), FACETS)
    for n, (load, radius, _) in zip(FACETS, runs):
        hull = ladder.answer("hull", case_cone.cone(60, n))
        volumes.append(hull["volume_m3"])
        loads.append(load)
        radii.append(radius)
    errors = [abs(v / polygon_cone(n)[1] - 1) for v, n in zip(volumes, FACETS)]
    own = [abs(v / polygon_cone(n)[0] - 1) for v, n in zip(volumes, FACETS)]
    orders = [None, *ladder.observed_order(errors)]
    for n, v, e, o, order, load, radius in zip(FACETS, volumes, errors, own, orders, loads, radii):
        c.rows.append([n, f"{v:.6f}", f"{o:.0e}", f"{100 * e:.3f} %", "" if order is None else f"{order:.2f}",
                       f"{load / 1e3:.0f}", f"{100 * (load / loads[-1] - 1):+.1f} %", f"{radius:.2f}"])
    worst = ladder.greatest(own)
    c.check(worst <= 1e-9, f"volume of each mesh to {worst:.0e}")
    lowest = ladder.least(orders[1:])
    c.check(lowest >= 1.8, f"volume to the round cone: orders {lowest:.2f} to {max(orders[1:]):.2f}, at least 1.8")
    worst = ladder.greatest(abs(f / loads[-1] - 1) for f, n in zip(loads, FACETS) if n >= 24)
    c.check(worst <= 0.05, f"load from 24 sides on: {100 * worst:.1f} % from the finest at most, 5 % expected")

    def draw(axes):
        axes[0].loglog(FACETS, errors, "o-", label="volume to the round cone")
        axes[0].loglog(FACETS, [errors[0] * (FACETS[0] / n) ** 2 for n in FACETS], "k:", label="second order")
        axes[0].set(xlabel="sides of the mesh", ylabel="relative error")
        axes[0].legend()
        axes[1].semilogx(FACETS, [f / 1e3 for f in loads], "o-")
        axes[1].set(xlabel="sides of the mesh", ylabel="first break [kN]", ylim=(0, 1.1e-3 * max(loads)))
        for ax in axes:
            ax.set_xticks(FACETS, FACETS)
            ax.minorticks_off()

    ladder.figure(c, out, "hull_mesh", "Error of the volume, and load at the first break.", draw, panels=2)
    return c
