"""Floes squeezed against a held one, beside the ridge-building line load of ISO 19906 and the thrust that rafts."""

import math

import ladder
import world

LONG = False
STRENGTH, LENGTH, FLOES, SPEED = 2e6, 40.0, 4, 0.05
ROWS = [(1.0, 100.0, 2.0), (1.0, 100.0, 10.0), (0.5, 100.0, 2.0), (2.0, 100.0, 2.0), (1.0, 50.0, 2.0),
        (1.0, 200.0, 2.0), (1.0, 100.0, 0.0)]  # h [m], width D [m], R
RAFTS = [(0.05, 30.0), (0.05, 45.0), (0.03, 45.0), (0.1, 45.0)]  # h [m], slope of edges [deg], 100 m wide, no ridges
RAFT_SPEED = 0.005  # so little force stops no row that is pushed faster within a second [m/s]
FRICTION, E, NU, FLEXURAL, WEIGHT = 0.1, 5e9, 0.3, 5e5, 1025 * 9.81
STEPS = (0.02, 0.01)


def ridge(h, d, r):
    """Line load of ridge building times the width [N]; R in MN/m."""
    return r * 1e6 * h**1.25 * d**-0.54 * d


def raft(h, slope):
    """Thrust per metre at which sheets of one thickness slide over each other [N/m]; none where they break before."""
    length = math.sqrt(2) * (E * h**3 / (12 * (1 - NU**2)) / WEIGHT) ** 0.25
    lift = WEIGHT * h * length / 4
    if 6 * math.exp(-math.pi / 4) * math.sin(math.pi / 4) * lift * length / h**2 > FLEXURAL:
        return math.inf
    return lift * math.tan(math.radians(slope) + math.atan(FRICTION))


def load(h, d, r, dt, slope=0, speed=SPEED):
    """Mean load of a wall as wide as the floes that pushes a row of them against one that is held."""
    floes = "".join(f"    - {{length: {LENGTH}, width: {d}, thickness: {h}, x: {LENGTH * (i + 0.5)}, "
                    f"fixed: {'true' if i == FLOES else 'false'}}}\n" for i in range(FLOES + 1))
    text = f"""run: {{time_step: {dt}}}
domain: {{boundary: open}}
vessel:
  {{mode: prescribed, x: -5, speed: {speed}, hull: {{form: box, length: 10, beam: {d}, draught: 5, freeboard: 5}}}}
ice:
  source: floes
  crushing_strength: {STRENGTH}
  ridging_resistance: {r}
  rafting_edge_angle_deg: {slope}
  friction: {{ice_ice_static: {FRICTION}, ice_ice_kinetic: {FRICTION}}}
  floes:
{floes}"""
    with world.World(text, "squeeze") as w:
        w.step(round(1 / dt))
        sums = 0.0
        for _ in range(round(1 / dt)):
            w.step(1)
            sums -= w.ice_force()[0]
    return sums * dt


def case(out):
    c = ladder.Case(
        "Floes squeezed against a held one",
        5,
        f"{FLOES} floes in a row, pushed by a wall of their width against one that is held, at {SPEED:g} m/s, with "
        "`ice.ridging_resistance` R, with `ice.rafting_edge_angle_deg`, and without both; load on the wall, mean from "
        f"1 to 2 s. Rafts are pushed at {RAFT_SPEED:g} m/s.",
        "ISO 19906: w = R h^1.25 D^-0.54 MN/m (recalled, [0113](../decisions/0113-ridge-building.md)); without "
        "it the ice crushes over its whole face, sigma_c h D. Rafts: two half-infinite beams on water pushed h apart, "
        "up a slope with friction, where they do not break before (Hetenyi 1946, after Parmerter 1975, "
        "[0556](../decisions/0556-thin-ice-rafts.md)).",
        "Fram's own law, within 1 % at both steps; the fall from the crushing load is what the case is for.",
    )
    c.header = ["h [m]", "D [m]", "R or edges", *(f"Fram, dt {1e3 * dt:.0f} ms [MN]" for dt in STEPS), "bound [MN]",
                "crushing [MN]"]
    for h, d, r in ROWS:
        found, law, crush = [load(h, d, r, dt) for dt in STEPS], ridge(h, d, r), STRENGTH * h * d
        limit = min(law, crush) if r > 0 else crush
        c.rows.append([h, d, r or "off", *(f"{f / 1e6:.2f}" for f in found), f"{law / 1e6:.2f}" if r else "",
                       f"{crush / 1e6:.0f}"])
        worst = ladder.greatest(abs(f / limit - 1) for f in found)
        c.check(worst <= 0.01, f"{h} m, {d:g} m wide, R {r:g}: {100 * worst:.2f} % off")
    for h, slope in RAFTS:
        found, crush = [load(h, 100.0, 0, dt, slope, RAFT_SPEED) for dt in STEPS], STRENGTH * h * 100
        limit = min(100 * raft(h, slope), crush)
        c.rows.append([h, 100, f"edges of {slope:g} deg", *(f"{f / 1e6:.4f}" for f in found),
                       f"{limit / 1e6:.4f}" if limit < crush else "breaks before", f"{crush / 1e6:.0f}"])
        worst = ladder.greatest(abs(f / limit - 1) for f in found)
        c.check(worst <= 0.01, f"{h} m, edges of {slope:g} degrees: {100 * worst:.2f} % off")
    c.found = ("The bound is the law itself; no rubble is made, floes overlap instead. With R of 2 a floe of 1 m and "
               "100 m presses with a twelfth of what crushes it.")
    return c
