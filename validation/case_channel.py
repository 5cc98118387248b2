"""Sides of a channel: how the load of a ship in thin strong ice goes on once the whole hull is in it."""

import math
import statistics

import ladder

LONG = True
LENGTH, SPEED, LENGTHS, START = 60.0, 1.0, 2, -32.0
STARTS = (0.0, 0.9, 1.8)  # [m] farther back
# Starts by step [s].
ROWS = {0.02: STARTS, 0.01: STARTS[:1]}
# The longer ship in which this was seen first: in a63afc5 the load rose from 490 to 980 kN over her own length.
UIKKU_LENGTH, UIKKU_SPEED, UIKKU_START, UIKKU_STEP = 150.02, 0.5, -85.0, 0.08
# Asked for: the load is stationary after the ship has gone its own length.
WITHIN = 0.15


def job(scene, name, length, speed, start, step, more):
    """A run until the ship has gone LENGTHS of its own from where its stern is past the edge of the ice at x = 0."""
    return (ladder.ROOT / "scenes" / scene, f"channel/{name}",
            {"run__time_step": step, "run__duration": (way_in(length, start) + LENGTHS * length) / speed,
             "run__transient": 0, "vessel__x": start, "vessel__speed": speed, "ice__thickness": 0.63,
             "ice__flexural_strength": 1.03e6, "ice__crushing_strength": 5.4e6, "ice__elastic_modulus": 2.06e9,
             "ice__sleep_speed": 0.05 * speed, "output__frame_interval": 0, "output__checkpoint_interval": 0, **more})


def way_in(length, start):
    """Way after which the stern is past the edge of the ice at x = 0 [m]."""
    return length / 2 - start


def jobs():
    return [job("uikku_303.yaml", "uikku", UIKKU_LENGTH, UIKKU_SPEED, UIKKU_START, UIKKU_STEP,
                {"domain__x_max": 520})] + [
            job("level_ice.yaml", f"{dt:g}_{back:g}", LENGTH, SPEED, START - back, dt, {"domain__x_max": 240})
            for dt, starts in ROWS.items() for back in starts]


def ways(series, length, speed, start):
    """Mean load in each half of a ship length from where the whole hull is in the ice [kN], and in whole ones."""
    way = [speed * t - way_in(length, start) for t in series["time"]]
    load = [-f / 1e3 for f in series["ice_force_averaged_x"]]

    def mean(lo, hi):
        return statistics.fmean(f for w, f in zip(way, load) if lo * length <= w < hi * length)

    return [mean(k / 2, (k + 1) / 2) for k in range(2 * LENGTHS)], [mean(k, k + 1) for k in range(LENGTHS)]


def of_starts(each):
    """Means of the starts, by halves of a ship length; and with standard errors by whole ones."""
    halves, wholes = zip(*each)
    return [statistics.fmean(column) for column in zip(*halves)], ladder.means_and_errors(wholes)


def check_stationary(c, what, lengths):
    """The second length beside the first; two standard errors of their difference, over the first (0 of one start)."""
    (first, error), (second, other) = lengths
    doubt = 0 if math.isnan(error) else 2 * math.hypot(error, other) / first
    c.check(abs(second / first - 1) <= WITHIN + doubt,
            f"{what}: second length {100 * (second / first - 1):+.1f} % of the first, "
            + (f"two standard errors {100 * doubt:.1f} %" if doubt else "one start"))
    return doubt


def case(out):
    c = ladder.Case(
        "Sides of a channel",
        3,
        f"The icebreaker of `scenes/level_ice.yaml`, {LENGTH:g} m, towed at {SPEED:g} m/s through ice that is thin and "
        "strong: 0.63 m, flexural strength 1.03 MPa, crushing 5.4 MPa, 2.06 GPa; means over half a ship length from "
        f"where the whole hull is in the ice. And MT Uikku of `scenes/uikku_303.yaml`, {UIKKU_LENGTH:g} m, at "
        f"{UIKKU_SPEED:g} m/s in the same ice, in which the load once doubled until she had gone her length.",
        "None to compare with: a load in uniform ice is stationary once all of the hull is in it. What friction on the "
        "midbody and pieces beside it do is in [0330](../decisions/0330-what-jams-beside-a-hull.md) and "
        "[0400](../decisions/0400-edges-bend-under-loads-that-crush-nothing.md).",
        f"The second ship length carries within {100 * WITHIN:g} % of the first, and two standard errors of the "
        "difference, and the halved step the mean within as much.",
    )
    c.header = ["ship", "step [s]", "starts",
                *(f"{k / 2:g} to {(k + 1) / 2:g} lengths [kN]" for k in range(2 * LENGTHS)),
                "second over first length"]
    series, found, curves = iter(ladder.run_all(jobs())), {}, []

    def row(ship, step, each):
        means, lengths = of_starts(each)
        (first, _), (second, _) = lengths
        c.rows.append([ship, step, len(each), *(f"{m:.0f}" for m in means), f"{second / first:.2f}"])
        curves.append((f"{ship}, steps of {step:g} s, {len(each)} start" + "s" * (len(each) > 1), means))
        return lengths

    uikku = row("MT Uikku", UIKKU_STEP, [ways(next(series), UIKKU_LENGTH, UIKKU_SPEED, UIKKU_START)])
    for dt, starts in ROWS.items():
        found[dt] = row(f"{LENGTH:g} m", dt, [ways(next(series), LENGTH, SPEED, START - back) for back in starts])
    check_stationary(c, "MT Uikku", uikku)
    doubt = check_stationary(c, f"{LENGTH:g} m", found[0.02])
    both = [statistics.fmean(value for value, _ in found[dt]) for dt in (0.02, 0.01)]
    c.check(abs(both[1] / both[0] - 1) <= WITHIN + doubt, f"{LENGTH:g} m: with half the step "
                                                          f"{100 * (both[1] / both[0] - 1):+.1f} %")
    c.found = ("MT Uikku and half the step are one start: the page shows that the load does not grow on. In a63afc5 "
               "that of MT Uikku "
               "rose from 490 to 980 kN and stayed there. Edges that are rigid below their strength "
               "(`ice.fracture.edge_elastic: false`) carried as much (d808d29: 250, 275, 262 and 291 kN by half "
               "lengths beside 244, 252, 279 and 272).")

    def draw(axes):
        for label, means in curves:
            axes.plot([(k + 0.5) / 2 for k in range(len(means))], means, "o-", label=label)
        axes.set(xlabel="way since the whole hull is in the ice [ship lengths]", ylabel="resistance [kN]",
                 ylim=(0, None))
        axes.legend(loc="lower left")

    ladder.figure(c, out, "channel", "Means over half a ship length.", draw)
    return c
