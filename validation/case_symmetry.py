"""Scaled, moved, mirrored and turned scenes give scaled, moved, mirrored and turned results."""

import math

import ladder
import world

LONG = False
STEPS = 300


def scaled(scale):
    """A towed hull in a managed field with crushing, friction, current and wind, lengths times scale (Froude)."""
    root = math.sqrt(scale)
    return f"""run: {{duration: {100 * root}, time_step: {0.015625 * root}, seed: 5, scale: {30 * scale}}}
vessel:
  mode: towed
  x: {-30 * scale}
  speed: {2 * root}
  hull: {{length: {48 * scale}, beam: {12 * scale}, draught: {4 * scale}, freeboard: {2 * scale}}}
ice: {{concentration: 0.85, mean_floe_area: {64 * scale**2}, thickness: {scale}, crushing_strength: {2e6 * scale},
      elastic_modulus: {5e9 * scale}, flexural_strength: {5e5 * scale}}}
domain: {{x_min: {-64 * scale}, x_max: {64 * scale}, y_min: {-40 * scale}, y_max: {40 * scale}}}
environment: {{current_speed: {0.25 * root}, current_direction_deg: 90, wind_speed: {8 * root}}}
"""


def melting(scale):
    """A ship whose sides melt the level ice that they have bent, lengths times scale, and the heat of that too."""
    root = math.sqrt(scale)
    return f"""run: {{duration: {100 * root}, time_step: {0.02 * root}, scale: {30 * scale}}}
vessel:
  mode: towed
  x: {-32 * scale}
  speed: {2 * root}
  hull: {{form: icebreaker, length: {60 * scale}, beam: {14 * scale}, draught: {5 * scale}, freeboard: {3 * scale}}}
ice: {{source: level, breakable: true, thickness: {0.7 * scale}, crushing_strength: {2e6 * scale},
      elastic_modulus: {5e9 * scale}, flexural_strength: {5e5 * scale}, level: {{x_min: 0}},
      fracture: {{latent_heat: {334e3 * scale}}}}}
domain: {{x_min: {-80 * scale}, x_max: {60 * scale}, y_min: {-30 * scale}, y_max: {30 * scale}, boundary: open}}
"""


def turning(scale):
    """A box that turns against fixed ice so slowly that a part of its side rests there, lengths times scale."""
    root = math.sqrt(scale)
    return f"""run: {{duration: {20 * root}, time_step: {0.02 * root}, scale: {30 * scale}}}
vessel:
  mode: prescribed
  path: [{{}}, {{time: {20 * root}, heading_deg: 0.1}}]
  hull: {{form: box, length: {40 * scale}, beam: {12 * scale}, draught: {4 * scale}, freeboard: {2 * scale}}}
ice:
  source: floes
  crushing_strength: {2e6 * scale}
  thickness: {scale}
  floes: [{{length: {30 * scale}, width: {12 * scale}, x: {2 * scale}, y: {11.99 * scale}, fixed: true}}]
domain: {{x_min: {-100 * scale}, x_max: {100 * scale}, y_min: {-100 * scale}, y_max: {100 * scale}, boundary: open}}
"""


def placed(turn=0, mirror=1, hull_speed=1.5, shift=0.0, kind="accurate", stick=0.0):
    """A driven hull meets two floes off its centre line; turned by 0 or 90 degrees, mirrored, everything moving."""
    co, si = (1, 0) if turn == 0 else (0, 1)
    floes = ""
    for x, y, yaw in ((36, 3.5, 20), (37.5, -6.5, -35)):
        y, yaw = mirror * y, mirror * yaw
        floes += (f"    - {{length: 12, width: 6, x: {co * x - si * y}, y: {si * x + co * y}, yaw_deg: {turn + yaw}, "
                  f"velocity_x: {shift}}}\n")
    course = turn if hull_speed >= 0 else turn + 180
    return f"""run: {{duration: 10, time_step: 0.02, solver: {{kind: {kind}, tolerance: 1e-13}}}}
vessel:
  mode: prescribed
  heading_deg: {turn}
  speed: {abs(hull_speed)}
  course_deg: {course}
  hull: {{length: 60, beam: 14, draught: 5, freeboard: 3}}
ice:
  source: floes
  floes:
{floes}domain: {{x_min: -500, x_max: 500, y_min: -500, y_max: 500, boundary: open}}
environment: {{current_speed: {abs(shift)}, current_direction_deg: {0 if shift >= 0 else 180},
              wind_speed: {abs(shift)}, wind_direction_deg: {0 if shift >= 0 else 180}}}
"""


def forces(text, steps):
    with world.World(text, "symmetry") as w:
        found = []
        for _ in range(steps):
            w.step()
            found.append(w.ice_force())
    return found


def apart(a, b):
    """Largest difference of two histories over the largest force."""
    largest = ladder.greatest(map(world.length, a))
    return ladder.greatest(world.length([x - y for x, y in zip(p, q)]) for p, q in zip(a, b)) / largest, largest


def case(out):
    c = ladder.Case(
        "Symmetries",
        1,
        f"Ice force on a hull over {STEPS} steps: a scene scaled by Froude's rule with lambda 4 and 16; a ship in "
        "level ice that breaks and melts, and a box that turns slowly against fixed ice, with lambda 4; hull that "
        "moves in still water against ice and water that "
        "move past it (50 steps); mirrored and turned by 90 degrees.",
        "The runs themselves.",
        "Scaled: 1e-12 of the largest force (powers of four: finds hidden dimensional constants). Moved: 1e-9. "
        "Mirrored and turned: 1e-6, with the accurate solver, since the order of contacts changes.",
    )
    c.header = ["change", "largest force [kN]", "largest difference / largest force", "allowed"]
    plain = forces(scaled(1.0), STEPS)
    histories = {}

    def enter(what, a, b, allowed):
        difference, largest = apart(a, b)
        c.rows.append([what, f"{largest / 1e3:.1f}", f"{difference:.1e}", f"{allowed:.0e}"])
        c.check(difference <= allowed and largest > 1e3, f"{what}: {difference:.1e}, at most {allowed:.0e}")

    for scale in (4.0, 16.0):
        large = [tuple(x / scale**3 for x in f) for f in forces(scaled(scale), STEPS)]
        enter(f"scaled by {scale:g}", plain, large, 1e-12)
        histories[scale] = large
    large = [tuple(x / 4**3 for x in f) for f in forces(melting(4.0), STEPS)]
    enter("level ice that melts, scaled by 4", forces(melting(1.0), STEPS), large, 1e-12)
    large = [tuple(x / 4**3 for x in f) for f in forces(turning(4.0), STEPS)]
    enter("hull that turns slowly, scaled by 4", forces(turning(1.0), STEPS), large, 1e-12)
    enter("moving hull, moving ice", forces(placed(hull_speed=3.0), 50), forces(placed(hull_speed=0.0, shift=-3.0), 50),
          1e-9)
    straight = forces(placed(), 150)
    enter("mirrored", straight, [(x, -y, z) for x, y, z in forces(placed(mirror=-1), 150)], 1e-6)
    enter("turned by 90 degrees", straight, [(y, -x, z) for x, y, z in forces(placed(turn=90), 150)], 1e-6)

    def draw(axes):
        axes.plot([-f[0] / 1e3 for f in plain], lw=2.5, alpha=0.35, label="as it is")
        axes.plot([-f[0] / 1e3 for f in histories[16.0]], "k", lw=0.6, label="lambda 16, scaled back")
        axes.set(xlabel="step", ylabel="resistance [kN]")
        axes.legend()

    ladder.figure(c, out, "symmetry", "Ice resistance of the scene and of the scaled scene.", draw)
    return c
