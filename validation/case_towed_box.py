"""A vertical box towed through level ice that can break, beside the global pressure of ISO 19906."""

import case_iso
import ladder

LONG = False
STRENGTH, SPEED, EXPONENT, LENGTH = 2e6, 0.5, -0.16, 20.0
ROWS = [(w, h) for h in (0.5, 1.0, 1.5) for w in (5, 10, 20, 40)]  # [m]
STEPS = (0.02, 0.01)
WAY, SKIP = 15.0, 5.0  # after the front has met the ice [m]
GAP = 2.0


def job(w, h, exponent, dt):
    text = f"""run: {{duration: {(GAP + WAY) / SPEED}, time_step: {dt}}}
domain: {{boundary: open, x_min: -60, x_max: 60, y_min: -60, y_max: 60}}
vessel:
  mode: towed
  x: {-LENGTH / 2 - GAP}
  speed: {SPEED}
  hull: {{form: box, length: {LENGTH}, beam: {w}, draught: 5, freeboard: 5}}
ice:
  source: level
  breakable: true
  thickness: {h}
  crushing_strength: {STRENGTH}
  crushing_exponent: {exponent}
  level: {{x_min: 0}}
output: {{frame_interval: 10, checkpoint_interval: 0, csv_interval: 0.1}}
"""
    return text, f"towed_box/{w:g}_{h:g}_{exponent:g}_{dt:g}", {}


def loads(series):
    """Mean and largest load after the front has gone SKIP into the ice, and the largest sideways [N]."""
    along = [-f for f in ladder.after(series, "ice_force_x", (GAP + SKIP) / SPEED)]
    sideways = map(abs, ladder.after(series, "ice_force_y", 0))
    return sum(along) / len(along), ladder.greatest(along), ladder.greatest(sideways)


def case(out):
    c = ladder.Case(
        "A vertical box towed through level ice",
        5,
        f"A box of 5 to 40 m beam and {LENGTH:g} m length, towed at {SPEED:g} m/s through a sheet of 0.5 to 1.5 m "
        f"that can break (2 MPa, constant and with `ice.crushing_exponent` {EXPONENT:g}), {WAY:g} m of way; load from "
        f"{SKIP:g} m on.",
        case_iso.SOURCE,
        "With a constant pressure sigma_c w h, steady, within 0.1 % at both steps: the sides slide along what the "
        "front has cut and carry nothing, and nothing bends at a vertical wall. With the exponent 0.5 to 1.5 of the "
        "rule: a wide bound without a source.",
    )
    jobs = [(w, h, e, dt) for w, h in ROWS for e in (0, EXPONENT) for dt in STEPS]
    found = {j: loads(s) for j, s in zip(jobs, ladder.run_all([job(*j) for j in jobs]))}
    c.header = ["w [m]", "h [m]", *(f"constant, dt {1e3 * dt:.0f} ms: mean, largest [MN]" for dt in STEPS),
                "sigma_c w h [MN]", f"exponent {EXPONENT:g}, mean [MN]", "ISO [MN]", "constant / ISO", "exponent / ISO"]
    worst, ratios, laws, seams = 0.0, [], [], []
    for w, h in ROWS:
        own, rule = STRENGTH * w * h, case_iso.iso(w, h)
        plain = [found[w, h, 0, dt] for dt in STEPS]
        law = found[w, h, EXPONENT, STEPS[1]][0]
        worst = ladder.greatest(worst, *(abs(f / own - 1) for p in plain for f in p[:2]), *(p[2] / own for p in plain))
        ratios.append(plain[1][0] / rule)
        laws.append(law / rule)
        seams.append(law / (STRENGTH * (w * h) ** (1 + EXPONENT)))
        c.rows.append([w, h, *(f"{p[0] / 1e6:.2f}, {p[1] / 1e6:.2f}" for p in plain), f"{own / 1e6:.0f}",
                       f"{law / 1e6:.2f}", f"{rule / 1e6:.2f}", f"{ratios[-1]:.2f}", f"{laws[-1]:.2f}"])
    c.check(worst <= 1e-3, f"constant pressure: mean, largest and sideways load {worst:.1e} off at most")
    c.check(ladder.least(laws) > 0.5 and ladder.greatest(laws) < 1.5,
            f"with the exponent {min(laws):.2f} to {max(laws):.2f} of the rule")
    c.found = (f"A constant pressure gives {min(ratios):.2f} to {max(ratios):.2f} of the rule, growing with the "
               f"width; with the exponent {min(laws):.2f} to {max(laws):.2f}. Where tiles of the sheet meet under the "
               f"front, each has its own area in the exponent's law: {min(seams):.2f} to {max(seams):.2f} times the "
               "load of one area.")
    return c
