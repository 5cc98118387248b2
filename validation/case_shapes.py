"""Square against many-cornered floes, at a vertical cylinder."""

import json
import math

import ladder

LONG = True
SEEDS = range(1, 9)
DIAMETER, SPEED, END, START = 12.0, 0.8, 90.0, 20.0
COVERS = (0.8, 0.6)  # the first jams between the walls; the second was added when that was seen


def square():
    """A template: one square."""
    path = ladder.WORK / "shapes" / "square.geojson"
    path.parent.mkdir(parents=True, exist_ok=True)
    ring = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]
    path.write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
    return path


def scene(shape, cover):
    kind = (f"shape: templates, templates: {square()}" if shape == "square"
            else "shape: convex, vertices_min: 6, vertices_max: 9, elongation: 1")
    return f"""run: {{duration: {END}, time_step: 0.02}}
vessel:
  mode: prescribed
  x: -62
  speed: {SPEED}
  hull: {{form: cone, length: 20, beam: 20, draught: 8, freeboard: 4, flare_angle_deg: 0}}
ice:
  source: packed
  concentration: {cover}
  thickness: 1
  populations:
    - {{size: constant, diameter: {DIAMETER}, {kind}}}
domain: {{x_min: -85, x_max: 85, y_min: -60, y_max: 60, boundary: walls}}
output: {{frame_interval: 0}}
"""


def measure(cover, shape):
    """Mean and error over seeds of the mean and of the standard deviation; one load; all means; floes."""
    path = ladder.WORK / "shapes" / (f"{shape}.yaml" if cover == 0.8 else f"{shape}_{cover}.yaml")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(scene(shape, cover))
    runs = ladder.run_all([(path, f"shapes/{path.stem}_{seed}", {"run__seed": seed}) for seed in SEEDS])
    loads = [[-f for f in ladder.after(s, "ice_force_averaged_x", START)] for s in runs]
    means = [sum(x) / len(x) for x in loads]
    spreads = [math.sqrt(sum((v - m) ** 2 for v in x) / len(x)) for x, m in zip(loads, means)]
    return ladder.mean_and_error(means), ladder.mean_and_error(spreads), loads[0], means, runs[0]["floes"][0]


def case(out):
    c = ladder.Case(
        "Square floes and polygonal floes",
        7,
        f"A vertical cylinder of 20 m driven at {SPEED} m/s through fields of 80 and 60 %, 1 m thick, between walls "
        f"60 m to "
        f"either side: square floes against convex floes of 6 to 9 corners of the same area ({DIAMETER:g} m), "
        f"{len(SEEDS)} "
        f"seeds each, {START:g} to {END:g} s.",
        "Van den Berg et al. (2019): square floes load a vertical structure more than polygonal ones of the same "
        "size, in "
        "mean and standard deviation.",
        "The squares' mean and standard deviation are larger by more than 2 standard errors of the difference.",
    )
    c.header = ["cover [%]", "floes", "mean [kN]", "standard error [kN]", "standard deviation of 0.5 s means [kN]",
                "its error [kN]", "floes in the field"]
    stats = {(cover, shape): measure(cover, shape) for cover in COVERS for shape in ("square", "polygon")}
    for (cover, shape), ((mean, error), (spread, spread_error), _, _, count) in stats.items():
        c.rows.append([f"{100 * cover:.0f}", shape, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", f"{spread / 1e3:.1f}",
                       f"{spread_error / 1e3:.1f}", f"{count:.0f}"])
    for cover in COVERS:
        for what, k in (("mean", 0), ("standard deviation", 1)):
            (a, da), (b, db) = stats[cover, "square"][k], stats[cover, "polygon"][k]
            sigmas = (a - b) / math.hypot(da, db)
            c.check(sigmas > 2, f"{100 * cover:.0f} %, {what}: squares {100 * (a / b - 1):+.0f} %, {sigmas:.1f} "
                                f"standard "
                                "errors")
    c.found = ("At 60 % squares load more, as published. At 80 % the closed field jams: floes of a metre that can "
               "neither break nor be pushed under a vertical side carry the walls' reaction up to the crushing limit "
               "(40 MN), and squares load no more than polygons. A prescribed speed and walls make this worse; "
               "read it as a limit of such a set-up.")

    def draw(axes):
        for shape in ("square", "polygon"):
            load = stats[COVERS[-1], shape][2]
            axes[0].plot([START + (END - START) * i / len(load) for i in range(len(load))], [f / 1e6 for f in load],
                         lw=0.8, label=shape)
        axes[0].set(xlabel="time [s]", ylabel=f"load [MN], {100 * COVERS[-1]:.0f} %, seed 1")
        axes[0].legend()
        for at, ((cover, shape), ((mean, error), _, _, means, _)) in enumerate(stats.items()):
            axes[1].plot([at] * len(means), [m / 1e6 for m in means], ".", color="grey")
            axes[1].errorbar([at + 0.1], [mean / 1e6], yerr=[1.96 * error / 1e6], fmt="o", capsize=4)
        axes[1].set_xticks(range(len(stats)), [f"{shape}\n{100 * cover:.0f} %" for cover, shape in stats])
        axes[1].set(ylabel="mean load [MN]", ylim=(0, None))

    ladder.figure(c, out, "shapes", "One run of each; means of all seeds with 95 % interval.", draw, panels=2)
    return c
