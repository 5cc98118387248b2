"""MT Uikku towed through level ice: a first look at one published test."""

import statistics

import ladder

LONG = True
SCENE = ladder.ROOT / "scenes" / "uikku_303.yaml"  # every parameter, fixed before the first run
STARTS = [(-85.0, "0"), (-83.4, "1/3"), (-81.7, "2/3")]  # vessel.x [m], part of R_bending (4.9 m)
ENTRY, LENGTHS = 50.0, 2  # [s] 20 s after the bow's full entry; ship lengths that count at least
LPP, SPEED = 150.02, 1.0
MEASURED = {"mean": 780.0, "standard deviation": 160.0, "largest": 1260.0, "smallest": 370.0}  # [kN]


def numbers(load):
    """The published four of a load [N], in kN."""
    return [x / 1e3 for x in (statistics.fmean(load), statistics.pstdev(load), max(load), min(load))]


def case(out):
    c = ladder.Case(
        "MT Uikku in level ice, test 303",
        6,
        "Resistance towed at 1 m/s in 1.04 m of level ice, averaged over 0.5 s at full scale, from 20 s after the "
        "bow's full entry over two ship lengths; three starts that differ by a third of R_bending.",
        "Hu and Zhou (2016), IJNAOE 8, 169-176: full-scale values of the 1:31.56 model. Inputs in "
        "`scenes/uikku_303.yaml`, fixed before the first run; the hull's angles are not published (30 and 21 degrees "
        "are recalled), nor friction (0.1) and ice density.",
        "None: a first look, not a campaign. Numbers are shown without a bound, since results were known before one "
        "was written down; published formulas are 22 to 51 % off on the whole campaign. The verdict says only that "
        "the runs are long enough.",
    )
    c.header = ["start", *(f"{name} [kN]" for name in MEASURED), "breaks of the sheet", "R_bending, mean [m]"]
    names = [f"uikku/{-x:g}" for x, _ in STARTS]
    keys = {"output__frame_interval": 0, "output__checkpoint_interval": 0}
    series = ladder.run_all([(SCENE, n, {"vessel__x": x, **keys}) for n, (x, _) in zip(names, STARTS)])
    found, curves = [], []
    for (_, offset), name, s in zip(STARTS, names, series):
        load = [-f for f in ladder.after(s, "ice_force_averaged_x", ENTRY)]
        c.check((s["time"][-1] - ENTRY) * SPEED >= LENGTHS * LPP - 0.1, f"start {offset}: two ship lengths count")
        events = ladder.fractures(name)
        bites = [r for t, kind, area, r in zip(events["time"], events["kind"], events["floe_area"],
                                               events["crack_length"]) if t >= ENTRY and kind == 2 and area > 150]
        found.append(numbers(load))
        curves.append((offset, s))
        c.rows.append([f"{offset} R_bending", *(f"{x:.0f}" for x in found[-1]), len(bites),
                       f"{statistics.fmean(bites):.2f}"])
    mean = [statistics.fmean(column) for column in zip(*found)]
    c.rows.append(["mean of three", *(f"{x:.0f}" for x in mean), "", ""])
    c.rows.append(["measured", *(f"{x:.0f}" for x in MEASURED.values()), "", ""])
    spread = max(f[0] for f in found) - min(f[0] for f in found)
    off = ", ".join(f"{name} {100 * (x / y - 1):+.0f} %" for x, (name, y) in zip(mean, MEASURED.items()))
    c.found = f"Deviation: {off}; the starts' means are {spread:.0f} kN apart. [Why](../level_ice.md)."

    def draw(axes):
        for offset, s in curves:
            axes.plot(s["time"][::25], [-f / 1e3 for f in s["ice_force_averaged_x"][::25]], lw=0.6,
                      label=f"start {offset}")
        axes.axhline(MEASURED["mean"], color="k", ls="--", lw=0.8, label="measured mean, largest, smallest")
        for name in ("largest", "smallest"):
            axes.axhline(MEASURED[name], color="k", ls=":", lw=0.8)
        axes.axvline(ENTRY, color="grey", lw=0.8)
        axes.set(xlabel="time [s]", ylabel="resistance [kN]", ylim=(0, None))
        axes.legend(ncols=4, fontsize=8)

    ladder.figure(c, out, "uikku", "Resistance averaged over 0.5 s; the part left of the grey line is not used.",
                  draw)
    return c
