"""What the resistance of a ship in level ice is made of, beside the parts of Lindqvist's formula."""

import dataclasses
import statistics

import case_lindqvist
import formulas
import ladder

LONG = True
MECHANISMS = ["splitting", "bending", "crushing", "chain", "accumulation", "submersion", "impact", "friction"]
BREAKING = ["bending", "crushing", "splitting"]  # ice that has not broken, or breaks now


@dataclasses.dataclass
class Ship:
    """A scene and what Lindqvist's formula asks for; metres, degrees, pascals, m/s."""

    scene: str
    length: float
    beam: float
    draught: float
    stem: float
    entrance: float
    thickness: float
    strength: float
    modulus: float
    speed: float
    transient: float
    duration: float


SHIPS = {
    "icebreaker, 60 m": Ship("level_ice", 60, 14, 5, 30, 32, 0.7, 0.5e6, 5e9, 2.0, 45, 75),
    "MT Uikku, test 303": Ship("uikku_303", 150.02, 22.22, 9.55, 30, 21, 1.04, 592e3, 1390e6, 1.0, 50, 130),
}
FRICTION = 0.1


def lindqvist(s, mu):
    """Crushing, bending and submersion at speed [N]."""
    bow = formulas.Bow(s.length, s.beam, s.draught, s.stem, s.entrance)
    crushing, bending, submersion, slow, deep = formulas.lindqvist_parts(
        bow, formulas.Sheet(s.strength, s.modulus), s.thickness, s.speed, mu)
    return crushing * slow, bending * slow, submersion * deep


def formula_parts(s):
    """Mean, and its parts by breaking, submersion and friction: friction is what vanishes without it [N]."""
    with_friction, without = lindqvist(s, FRICTION), lindqvist(s, 0)
    return sum(with_friction), without[0] + without[1], without[2], sum(with_friction) - sum(without)


def means(s, series):
    """Resistance after the transient by mechanism [N], and the largest fault of their sum over the largest load [1]."""
    rows = [k for k, t in enumerate(series["time"]) if t - s.transient > 1e-9 * t]
    parts = {m: -statistics.fmean(series[f"mechanism_{m}_x"][k] for k in rows) for m in MECHANISMS}
    load = series["ice_force_x"]
    off = ladder.greatest(abs(sum(series[f"mechanism_{m}_x"][k] for m in MECHANISMS) - f) for k, f in enumerate(load))
    return parts, off / ladder.greatest(map(abs, load))


def case(out):
    c = ladder.Case(
        "Shares of breaking, submersion and friction in level ice",
        5,
        "Mean resistance of the icebreaker of `scenes/level_ice.yaml` and of MT Uikku in test 303, after the scenes' "
        "transients (30 s at 2 m/s, a ship length; 80 s at 1 m/s, half of one), by mechanism "
        "([theory](../theory.md#mechanisms-of-an-ice-load)), beside the parts of Lindqvist's "
        "formula. Breaking is bending, crushing and splitting; submersion is the load of pieces that broke off "
        "earlier: "
        "submersion, accumulation, chains and impact; friction is separate in both; in the formula it is what "
        "vanishes at mu 0.",
        "Lindqvist (1989) with the scenes' inputs. Enkvist (1983, POAC, 484-493) surveys measured relations of "
        "breaking and submersion; his numbers were not at hand.",
        "No bound on the shares: none was written down before they were known. The mechanisms add up to the load in "
        "every step to 1e-9 of its largest.",
    )
    c.header = ["ship", "by", "mean [kN]", "breaking [%]", "submersion [%]", "friction [%]", *MECHANISMS]
    series = ladder.run_all([(ladder.ROOT / "scenes" / f"{s.scene}.yaml", f"shares/{s.scene}",
                              {"run__duration": s.duration}) for s in SHIPS.values()])
    bars = []
    for (name, s), run in zip(SHIPS.items(), series):
        parts, off = means(s, run)
        mean = sum(parts.values())
        breaking = sum(parts[m] for m in BREAKING)
        found = [breaking, mean - breaking - parts["friction"], parts["friction"]]
        total, *expected = formula_parts(s)
        c.rows.append([name, "Fram", f"{mean / 1e3:.0f}", *(f"{100 * p / mean:.0f}" for p in found),
                       *(f"{100 * parts[m] / mean:.1f} %" for m in MECHANISMS)])
        c.rows.append([name, "Lindqvist", f"{total / 1e3:.0f}", *(f"{100 * p / total:.0f}" for p in expected),
                       *[""] * len(MECHANISMS)])
        bars += [(f"{name}\nFram", found), (f"{name}\nLindqvist", expected)]
        c.check(off <= 1e-9, f"{name}: the mechanisms add up to the load in every step to {off:.1e} of its largest")
    icebreaker = SHIPS["icebreaker, 60 m"]
    same = sum(lindqvist(icebreaker, FRICTION)) / case_lindqvist.lindqvist(icebreaker.thickness, icebreaker.speed)
    c.check(abs(same - 1) < 1e-12, "the formula in parts is that of the page on the icebreaker's resistance")
    c.found = FOUND

    def draw(axes):
        left = [0.0] * len(bars)
        for k, part in enumerate(("breaking", "submersion", "friction")):
            width = [b[k] / 1e3 for _, b in bars]
            axes.barh(range(len(bars)), width, left=left, label=part, color=("C1", "C0", "C5")[k])
            left = [a + b for a, b in zip(left, width)]
        axes.set_yticks(range(len(bars)), [name for name, _ in bars], fontsize=8)
        axes.invert_yaxis()
        axes.set(xlabel="mean resistance [kN]")
        axes.legend(fontsize=8)

    ladder.figure(c, out, "shares", "Mean resistance in level ice by its parts.", draw)
    return c


FOUND = (
    "Friction has much the same share in both. Breaking has a smaller share here and broken pieces a larger one, for "
    "two reasons. "
    "Pieces are rigid and lean on the sheet beside the channel: the chains of the table, which the formula does not "
    "have, since its submersion is the buoyancy of ice that covers the hull. And the load that bends the sheet is "
    "quasi-static and ends with the break, while the formula's breaking grows with speed. A piece that is crushed at "
    "its limit counts as breaking, so that the share of breaking is rather too large than too small. The towed MT "
    "Uikku was measured at 780 kN on average; this is one start over half a ship length, and [its own "
    "page](uikku_campaign.md) has three over two.")
