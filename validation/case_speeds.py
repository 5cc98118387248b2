"""Speed of an icebreaker at full power over the thickness of level ice, beside what is published of the ship."""

import formulas
import ladder

LONG = True
KNOT = 0.5144
ICE, FRICTION = formulas.Sheet(strength=0.5e6, modulus=5e9), 0.1
SHIP = formulas.Bow(length=104.0, beam=24.0, draught=8.0, stem=22, entrance=35)
BOLLARD_PULL, OPEN_WATER = 2.10e6, 8.75
# Thickness [m], published speed [knots], whether it was measured in ice trials or is what the ship is said to do.
PUBLISHED = [(0.72, 12.7, "trial"), (0.81, 12.0, "trial"), (1.2, 6.0, "stated"), (1.8, 3.5, "stated")]
TOO_THICK = 4.0  # [m] more than twice what the ship is said to go through
DURATION, LATE = 60, 20  # [s] of a run, and of its end that counts


def lindqvist(h, v):
    return formulas.lindqvist(SHIP, ICE, h, v, FRICTION)


def formula_speed(h):
    """Where Lindqvist's resistance meets Riska's net thrust [m/s]."""
    low, high = 0.0, OPEN_WATER
    for _ in range(60):
        v = 0.5 * (low + high)
        thrust = BOLLARD_PULL * (1 - v / (3 * OPEN_WATER) - 2 / 3 * (v / OPEN_WATER) ** 2)
        low, high = (v, high) if thrust > lindqvist(h, v) else (low, v)
    return low


def job(h, start):
    return (ladder.ROOT / "scenes" / "polaris.yaml", f"speeds/{h:g}",
            {"ice__thickness": h, "vessel__speed": start, "run__duration": DURATION if h < TOO_THICK else 2 * DURATION,
             "run__transient": 0, "run__time_step": round(min(0.01, 0.02 / start), 4), "output__frame_interval": 0})


def case(out):
    c = ladder.Case(
        "Speed of an icebreaker at full power over the thickness of the ice",
        6,
        "IB Polaris (`scenes/polaris.yaml`) drives itself through level ice at full power from near the formula's "
        f"speed; the mean speed of the last {LATE} s of {DURATION}, one start. In {TOO_THICK:g} m it has to ram.",
        "Published of the ship: 12.7 and 12.0 knots in 0.72 and 0.81 m of ice in her trials (Aker Arctic Newsletter, "
        "September 2017), 6 knots in 1.2 m (Arctia, IB Polaris), 3.5 knots in 1.8 m (Maritime Reporter, Great Ships of "
        "2016), bollard pull 214 t, 17 knots in open water. The angles of the bow, strength and friction are not "
        "published with them: those of `scenes/vessels/icebreaker.yaml` and the defaults. Beside it the speed at which "
        "Lindqvist's resistance (1989) meets Riska's net thrust (1997) for the same inputs.",
        "Within 25 % of the speeds measured in the trials, and at least the stated ones, which a builder holds in ice "
        "of a stated strength; slower in thicker ice; no more than 1.5 times what is stated. Written when runs with a "
        "step of 0.01 s were known: 11.7 knots in 0.81 m, 10.3 in 1.2 m, 7.9 in 1.8 m, so that the last was known to "
        "fail.",
    )
    c.header = ["h [m]", "published [knots]", "", "Fram [knots]", "Fram / published", "formula [knots]"]
    thicknesses = [h for h, _, _ in PUBLISHED]
    series = ladder.run_all([job(h, max(2.0, formula_speed(h))) for h in thicknesses] + [job(TOO_THICK, 3.0)])
    found = []
    for (h, published, kind), s in zip(PUBLISHED, series):
        late = ladder.after(s, "velocity_x", s["time"][-1] - LATE)
        found.append(sum(late) / len(late) / KNOT)
        ratio = found[-1] / published
        c.rows.append([h, published, kind, f"{found[-1]:.1f}", f"{ratio:.2f}", f"{formula_speed(h) / KNOT:.1f}"])
        if kind == "trial":
            c.check(0.75 <= ratio <= 1.25, f"{h} m: {ratio:.2f} of the speed in the trials, expected 0.75 to 1.25")
        else:
            c.check(1 <= ratio <= 1.5, f"{h} m: {ratio:.2f} of the stated speed, expected 1 to 1.5")
    c.check(ladder.rises(found[::-1]), "slower in thicker ice")
    thick = series[-1]
    way, rams = max(thick["position_x"]) - thick["position_x"][0], ladder.greatest(thick["rams"])
    c.rows.append([TOO_THICK, "-", "", f"rams {rams:.0f} times", "", f"{formula_speed(TOO_THICK) / KNOT:.1f}"])
    c.check(rams >= 1, f"{TOO_THICK:g} m: besets and rams, {rams:.0f} times in {2 * DURATION} s, over {way:.0f} m")

    def draw(axes):
        fine = [0.3 + 0.05 * i for i in range(40)]
        axes.plot(fine, [formula_speed(h) / KNOT for h in fine], "--", label="Lindqvist and Riska")
        for kind, mark in (("trial", "s"), ("stated", "D")):
            of_kind = [(h, v) for h, v, k in PUBLISHED if k == kind]
            axes.plot(*zip(*of_kind), mark, label=f"published, {kind}")
        axes.plot(thicknesses, found, "o-", label="Fram")
        axes.set(xlabel="thickness [m]", ylabel="speed [knots]", ylim=(0, 17))
        axes.legend(fontsize=8)

    ladder.figure(c, out, "speeds", "Speed at full power over the thickness of the ice.", draw)
    return c
