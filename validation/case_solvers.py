"""The three solvers of Fram on the same small field."""

import ladder

LONG = True
SEEDS = range(1, 5)
SOLVERS = ("accurate", "fast", "sequential")
START, END = 8.0, 30.0
SCENE = """run: {duration: 30, time_step: 0.02}
vessel:
  mode: towed
  x: -42
  speed: 2
  ramp: 1
  hull: {length: 40, beam: 10, draught: 4, freeboard: 2}
ice: {concentration: 0.85, mean_floe_area: 40, thickness: 0.8, density: 910}
domain: {x_min: -66, x_max: 60, y_min: -30, y_max: 30}
output: {frame_interval: 0}
"""


def case(out):
    c = ladder.Case(
        "Three solvers, one field",
        4,
        "A hull of 40 m towed at 2 m/s through a small field of 85 % (some 150 floes): the same seeds under the "
        "accurate "
        "solver (to 1e-6 m/s), the fast one (default) and projected Gauss-Seidel in contact order, 30 sweeps each.",
        "The accurate solver.",
        "Single runs diverge after some collisions, means must not: difference of the paired means under 3.2 "
        "standard "
        "errors (95 % of Student's t for four seeds), and the impulse of the first second of contact within 5 %.",
    )
    path = ladder.WORK / "solvers" / "field.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(SCENE)
    runs = {kind: ladder.run_all([(path, f"solvers/{kind}_{seed}", {"run__seed": seed, "run__solver__kind": kind})
                                  for seed in SEEDS]) for kind in SOLVERS}
    c.header = ["solver", "mean load [kN]", "standard error [kN]", "to accurate, paired [kN]", "over its error",
                "mean residual [mm/s]", "first impulse, to accurate"]

    def means(kind):
        return [sum(x) / len(x) for x in ([-f for f in ladder.after(s, "ice_force_x", START)] for s in runs[kind])]

    def first_impulse(series):
        """Of the first second of contact."""
        begin = next(i for i, f in enumerate(series["ice_force_x"]) if f != 0)
        return sum(series["ice_force_x"][begin: begin + 50])

    best, firsts = means("accurate"), [first_impulse(s) for s in runs["accurate"]]
    for kind in SOLVERS:
        values = means(kind)
        mean, error = ladder.mean_and_error(values)
        apart, of_apart = ladder.mean_and_error([a - b for a, b in zip(values, best)])
        residual = [r for s in runs[kind] for r in ladder.after(s, "solver_residual", START)]
        share = sum(first_impulse(s) for s in runs[kind]) / sum(firsts) - 1
        sigmas = abs(apart) / of_apart if of_apart != 0 else 0.0
        c.rows.append([kind, f"{mean / 1e3:.1f}", f"{error / 1e3:.1f}", f"{apart / 1e3:+.1f}", f"{sigmas:.2f}",
                       f"{1e3 * sum(residual) / len(residual):.4f}", f"{100 * share:+.2f} %"])
        if kind != "accurate":
            c.check(sigmas < 3.2, f"{kind}: mean {apart / 1e3:+.1f} kN from accurate, {sigmas:.2f} standard errors")
            c.check(abs(share) < 0.05, f"{kind}: impulse of the first second of contact {100 * share:+.2f} %, 5 % "
                                       f"allowed")

    def draw(axes):
        for kind, style in zip(SOLVERS, ("-", "--", ":")):
            s = runs[kind][0]
            axes[0].plot(s["time"], [-f / 1e3 for f in s["ice_force_averaged_x"]], style, lw=0.9, label=kind)
        axes[0].set(xlabel="time [s]", ylabel="0.5 s mean of the load [kN], seed 1")
        axes[0].legend()
        for at, kind in enumerate(SOLVERS):
            values = means(kind)
            mean, error = ladder.mean_and_error(values)
            axes[1].plot([at] * len(values), [v / 1e3 for v in values], ".", color="grey")
            axes[1].errorbar([at + 0.15], [mean / 1e3], yerr=[1.96 * error / 1e3], fmt="o", capsize=4)
        axes[1].set_xticks(range(len(SOLVERS)), SOLVERS)
        axes[1].set(ylabel="mean load [kN]", ylim=(0, None))

    ladder.figure(c, out, "solvers", "One seed; means of all seeds with 95 % interval.", draw, panels=2)
    return c
