"""Floes squeezed against a held one, beside the ridge-building line load of ISO 19906."""

import ladder
import world

LONG = False
STRENGTH, LENGTH, FLOES, SPEED = 2e6, 40.0, 4, 0.05
ROWS = [(1.0, 100.0, 2.0), (1.0, 100.0, 10.0), (0.5, 100.0, 2.0), (2.0, 100.0, 2.0), (1.0, 50.0, 2.0),
        (1.0, 200.0, 2.0), (1.0, 100.0, 0.0)]  # h [m], width D [m], R
STEPS = (0.02, 0.01)


def ridge(h, d, r):
    """Line load of ridge building times the width [N]; R in MN/m."""
    return r * 1e6 * h**1.25 * d**-0.54 * d


def load(h, d, r, dt):
    """Mean load of a wall as wide as the floes that pushes a row of them against one that is held."""
    floes = "".join(f"    - {{length: {LENGTH}, width: {d}, thickness: {h}, x: {LENGTH * (i + 0.5)}, "
                    f"fixed: {'true' if i == FLOES else 'false'}}}\n" for i in range(FLOES + 1))
    text = f"""run: {{time_step: {dt}}}
domain: {{boundary: open}}
vessel:
  {{mode: prescribed, x: -5, speed: {SPEED}, hull: {{form: box, length: 10, beam: {d}, draught: 5, freeboard: 5}}}}
ice:
  source: floes
  crushing_strength: {STRENGTH}
  ridging_resistance: {r}
  floes:
{floes}"""
    with world.World(text, "squeeze") as w:
        w.step(round(1 / dt))
        sums = 0.0
        for _ in range(round(1 / dt)):
            w.step(1)
            sums -= w.load().force[0]
    return sums * dt


def case(out):
    c = ladder.Case(
        "Floes squeezed against a held one",
        5,
        f"{FLOES} floes in a row, pushed by a wall of their width against one that is held, at {SPEED:g} m/s, with "
        "`ice.ridging_resistance` R and without; load on the wall, mean from 1 to 2 s.",
        "ISO 19906: w = R h^1.25 D^-0.54 MN/m (recalled, [0113](../decisions/0113-ridge-building.md)); without "
        "it the ice crushes over its whole face, sigma_c h D.",
        "Fram's own law, within 1 % at both steps; the fall from the crushing load is what the case is for.",
    )
    c.header = ["h [m]", "D [m]", "R", *(f"Fram, dt {1e3 * dt:.0f} ms [MN]" for dt in STEPS), "ridge building [MN]",
                "crushing [MN]"]
    for h, d, r in ROWS:
        found, law, crush = [load(h, d, r, dt) for dt in STEPS], ridge(h, d, r), STRENGTH * h * d
        limit = min(law, crush) if r > 0 else crush
        c.rows.append([h, d, r or "off", *(f"{f / 1e6:.2f}" for f in found), f"{law / 1e6:.2f}" if r else "",
                       f"{crush / 1e6:.0f}"])
        worst = max(abs(f / limit - 1) for f in found)
        c.check(worst <= 0.01, f"{h} m, {d:g} m wide, R {r:g}: {100 * worst:.2f} % off")
    c.found = ("The bound is the law itself; no rubble is made, floes overlap instead. With R of 2 a floe of 1 m and "
               "100 m presses with a twelfth of what crushes it.")
    return c
