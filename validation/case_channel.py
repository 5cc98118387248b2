"""Sides of a channel: how the load of a ship in thin strong ice goes on once the whole hull is in it."""

import statistics

import ladder

LONG = True
LENGTH, SPEED, LENGTHS, START = 60.0, 1.0, 2, -32.0
STARTS = (0.0, 0.9, 1.8)  # [m] farther back
# Step [s], whether edges bend below their strength, starts.
ROWS = [(0.02, True, STARTS), (0.01, True, STARTS[:1]), (0.02, False, STARTS)]
# Asked for: the load is stationary after the ship has gone its own length.
WITHIN = 0.15


def way_in(back):
    """Way after which the stern is past the edge of the ice at x = 0 [m]."""
    return LENGTH / 2 - START + back


def jobs():
    scene = ladder.ROOT / "scenes" / "level_ice.yaml"
    return [(scene, f"channel/{dt:g}_{'bends' if bends else 'rigid'}_{back:g}",
             {"run__time_step": dt, "run__duration": (way_in(back) + LENGTHS * LENGTH) / SPEED, "run__transient": 0,
              "vessel__x": START - back, "domain__x_max": 240, "vessel__speed": SPEED, "ice__thickness": 0.63,
              "ice__flexural_strength": 1.03e6, "ice__crushing_strength": 5.4e6, "ice__elastic_modulus": 2.06e9,
              "ice__sleep_speed": 0.05 * SPEED, "ice__fracture__edge_elastic": "true" if bends else "false",
              "output__frame_interval": 0, "output__checkpoint_interval": 0})
            for dt, bends, starts in ROWS for back in starts]


def ways(series, back):
    """Mean load in each half of a ship length from where the whole hull is in the ice [kN], and what tells others."""
    way = [SPEED * t for t in series["time"]]
    load = [-f / 1e3 for f in series["ice_force_averaged_x"]]

    def mean(lo, hi):
        return statistics.fmean(f for w, f in zip(way, load) if lo <= w - way_in(back) < hi)

    return [mean(k * LENGTH / 2, (k + 1) * LENGTH / 2) for k in range(2 * LENGTHS)], mean


def case(out):
    c = ladder.Case(
        "Sides of a channel",
        3,
        f"The icebreaker of `scenes/level_ice.yaml`, {LENGTH:g} m, towed at {SPEED:g} m/s through ice that is thin and "
        "strong: 0.63 m, flexural strength 1.03 MPa, crushing 5.4 MPa, 2.06 GPa; means over half a ship length from "
        "where the whole hull is in the ice, with edges that bend under any load (the default) and with edges that "
        "are rigid until something breaks or crushes.",
        "None to compare with: a load in uniform ice is stationary once all of the hull is in it. What friction on the "
        "midbody and pieces beside it do is in [0330](../decisions/0330-what-jams-beside-a-hull.md) and "
        "[0400](../decisions/0400-edges-bend-under-loads-that-crush-nothing.md).",
        f"The second ship length carries within {100 * WITHIN:g} % of the first, and two standard errors of the "
        "difference, and the halved step the mean within as much.",
    )
    c.header = ["edges", "step [s]", "starts", *(f"{k / 2:g} to {(k + 1) / 2:g} lengths [kN]" for k in
                                                range(2 * LENGTHS)), "second over first length"]
    series, halves, curves = iter(ladder.run_all(jobs())), {}, []
    for dt, bends, starts in ROWS:
        each = [ways(next(series), back) for back in starts]
        means = [statistics.fmean(column) for column in zip(*(parts for parts, _ in each))]
        lengths = [[mean(k * LENGTH, (k + 1) * LENGTH) for _, mean in each] for k in range(2)]
        halves[dt, bends] = [ladder.mean_and_error(values) for values in lengths]
        first, second = (value for value, _ in halves[dt, bends])
        name = "bend" if bends else "rigid"
        c.rows.append([name, dt, len(starts), *(f"{m:.0f}" for m in means), f"{second / first:.2f}"])
        label = "edges bend" if bends else "edges are rigid"
        curves.append((f"{label}, steps of {dt:g} s, starts: {len(starts)}", means))
    (first, error), (second, other) = halves[0.02, True]
    doubt = 2 * (error**2 + other**2) ** 0.5 / first
    c.check(abs(second / first - 1) <= WITHIN + doubt,
            f"edges bend: second length {100 * (second / first - 1):+.1f} % of the first, two standard errors "
            f"{100 * doubt:.1f} %")
    both = [statistics.fmean(value for value, _ in halves[dt, True]) for dt in (0.02, 0.01)]
    c.check(abs(both[1] / both[0] - 1) <= WITHIN + doubt, f"edges bend: with half the step "
                                                          f"{100 * (both[1] / both[0] - 1):+.1f} %")
    c.found = ("Starts differ by more than the edges do, and half the step is one start: the page shows that "
               "the load does not grow on, and no difference between the two kinds of edges.")

    def draw(axes):
        for label, means in curves:
            axes.plot([(k + 0.5) / 2 for k in range(len(means))], means, "o-", label=label)
        axes.set(xlabel="way since the whole hull is in the ice [ship lengths]", ylabel="resistance [kN]",
                 ylim=(0, None))
        axes.legend()

    ladder.figure(c, out, "channel", "Means over half a ship length.", draw)
    return c
