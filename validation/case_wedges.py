"""What the number of wedges does: to the load of a break, and to a ship in level ice."""

import math
import statistics

import ladder

LONG = True
COUNTS = [2, 3, 4, 5, 6, 8]
OF_SHIP = [3, 4, 5, 6, 8]  # these must give one resistance
STARTS = (0.0, 1.6, 3.2)  # [m] farther back
BEGIN, END = 18.0, 45.0


def jobs():
    scene = ladder.ROOT / "scenes" / "level_ice.yaml"
    return [(scene, f"wedges/{n}_{back:g}",
             {"ice__fracture__wedges": n, "vessel__x": -32 - back, "run__duration": END, "run__transient": 0,
              "output__frame_interval": 0, "domain__x_max": 130, "domain__y_min": -40, "domain__y_max": 40})
            for n in OF_SHIP for back in STARTS]


def mean_radius(n):
    """Mean R_bending of all breaks of a ship's runs [m]."""
    events = [ladder.fractures(f"wedges/{n}_{back:g}") for back in STARTS]
    return statistics.fmean(r for e in events for r, kind in zip(e["crack_length"], e["kind"]) if kind == 2)


def case(out):
    c = ladder.Case(
        "Number of wedges",
        3,
        "N wedges share a load: capacity and breaking radius of 1 m of ice under a patch of 0.2 m2 for N = 2 to 8 "
        "(fram ice break), and for N = 3 to 8 mean resistance and mean R_bending of the icebreaker of "
        f"`scenes/level_ice.yaml` from {BEGIN:g} to {END:g} s, {len(STARTS)} starts each.",
        "P = sigma_f h^2 (N b0/6) C, b0 = 2 tan(pi/(2 N)): N b0 falls from 4 (N = 2) to pi.",
        "Converges: N b0 - pi = pi^3/(12 N^2), second order in 1/N. From N = 3 to 8 the ship's resistance stays within "
        "5 % of that with N = 3, and two standard errors of the difference.",
    )
    c.header = ["N", "capacity [kN]", "to N = 32", "R_bending [m]", "ship: resistance [kN]", "standard error [kN]",
                "ship: mean R_bending [m]"]

    def by_hand(n):
        return ladder.answer("ice", "break", "--contact-area", 0.2, "--wedges", n)

    last = by_hand(32)
    series = iter(ladder.run_all(jobs()))
    resistance, capacity = {}, {}
    for n in COUNTS:
        now = by_hand(n)
        capacity[n] = now["wedge_capacity"]
        c.rows.append([n, f"{now['wedge_capacity'] / 1e3:.1f}",
                       f"{100 * (now['wedge_capacity'] / last['wedge_capacity'] - 1):+.2f} %",
                       f"{now['breaking_radius']:.3f}", "", "", ""])
        if n in OF_SHIP:
            loads = [ladder.after(next(series), "ice_force_averaged_x", BEGIN) for _ in STARTS]
            mean, error = resistance[n] = ladder.mean_and_error([-sum(f) / len(f) for f in loads])
            c.rows[-1][-3:] = [f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", f"{mean_radius(n):.2f}"]
    errors = [capacity[n] / last["wedge_capacity"] - 1 for n in (2, 4, 8)]
    orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
    c.check(ladder.least(orders) >= 1, f"capacity: observed orders in 1/N {orders[0]:.2f}, {orders[1]:.2f}, at least 1")
    mean, error = resistance[OF_SHIP[0]]
    for n in OF_SHIP[1:]:
        off, doubt = resistance[n][0] / mean - 1, 2 * math.hypot(error, resistance[n][1]) / mean
        c.check(abs(off) <= 0.05 + doubt, f"resistance of the ship with N = {n}: {100 * off:+.1f} % of that with N = "
                                          f"{OF_SHIP[0]}, two standard errors {100 * doubt:.1f} %")
    beside = [100 * (resistance[n][0] / mean - 1) for n in OF_SHIP[1:]]
    edge = 100 * (1 - capacity[OF_SHIP[-1]] / capacity[OF_SHIP[0]])
    from_most = max(abs(100 * (resistance[n][0] / resistance[OF_SHIP[-1]][0] - 1)) for n in OF_SHIP)
    c.found = (f"An edge converges at second order; from N = {OF_SHIP[0]} to {OF_SHIP[-1]} its capacity falls by "
               f"{edge:.0f} % (N tan(pi/(2 N)) and a little for what the wedges stand on). The ship's resistance is "
               f"{min(beside):+.0f} to {max(beside):+.0f} % of that with N = {OF_SHIP[0]}, not evenly in N, and within "
               f"{from_most:.1f} % of that with N = {OF_SHIP[-1]}. "
               "It was +21 % from N = 3 to 5 while broken pieces arched between hull and sheet and corners carried as "
               "edges do ([0111](../decisions/0111-ice-yields-to-ice.md), "
               "[0044](../decisions/0044-wedges-that-are-there.md)), and -14 to -18 % from N = 3 while the breaking "
               "radius was that of the cracks between wedges "
               "([0568](../decisions/0568-wedges-break-across-their-axes.md)).")

    def draw(axes):
        axes[0].plot(COUNTS, [capacity[n] / 1e3 for n in COUNTS], "o-")
        axes[0].axhline(last["wedge_capacity"] / 1e3, color="k", ls=":", label="N = 32")
        axes[0].set(xlabel="N", ylabel="capacity [kN]", ylim=(0, 1.1e-3 * max(capacity.values())))
        axes[0].legend(loc="lower right")
        means, errors = zip(*(resistance[n] for n in OF_SHIP))
        axes[1].errorbar(OF_SHIP, [m / 1e3 for m in means], yerr=[2 * e / 1e3 for e in errors], marker="o", capsize=3)
        axes[1].set_xticks(OF_SHIP)
        axes[1].set(xlabel="N", ylabel="mean resistance of the ship [kN]", ylim=(0, None))

    ladder.figure(c, out, "wedges", "Capacity of an edge and resistance of a ship (two standard errors) against N.",
                  draw, panels=2)
    return c
