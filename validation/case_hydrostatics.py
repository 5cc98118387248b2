"""Hulls of panels afloat, against closed forms and WAMIT."""

import math

import ladder

LONG = False
# tests/data/make_cracked_panels.py: a barge with a half round bow, whose side has twenty chords over a quarter.
PARALLEL, RADIUS, DRAUGHT, CHORDS = 138, 22, 12, 20
# The first column of numbers is what WAMIT prints for the panels of the FPSO.
WAMIT = [("volume", "volume_m3", 97960.9), ("waterplane", "waterplane_area_m2", 8316.7),
         ("centre of buoyancy, z", "centre_of_buoyancy_m", -5.922808)]


def barge():
    area = 2 * RADIUS * PARALLEL + RADIUS**2 * CHORDS * math.sin(math.pi / (2 * CHORDS))
    return [("volume", "volume_m3", DRAUGHT * area), ("waterplane", "waterplane_area_m2", area),
            ("centre of buoyancy, z", "centre_of_buoyancy_m", -DRAUGHT / 2)]


def compare(c, name, hull, expected):
    now = ladder.answer("hull", hull)
    for what, key, value in expected:
        got = now[key][2] if isinstance(now[key], list) else now[key]
        c.rows.append([name, what, f"{value:.8g}", f"{got:.8g}", f"{100 * (got / value - 1):.4f} %"])
        c.check(abs(got / value - 1) <= 5e-3, f"{name}: {what} within 0.5 %")
    volumes = now["volume_integrals_m3"]
    spread = ladder.greatest(volumes) / ladder.least(volumes) - 1
    c.check(spread <= 1e-6, f"{name}: the three volume integrals agree to {spread:.0e}, at most 1e-6")


def case(out):
    fpso = ladder.DATA / "hulls" / "fpso_low.gdf"
    c = ladder.Case(
        "Hydrostatics of hulls of panels",
        2,
        "Volume, waterplane and centre of buoyancy of hulls of panels (half of them, mirrored), whose cracks are "
        "sealed and reported: a barge with a round bow of 115 panels, and the FPSO of the Marine Systems Simulator "
        "of 1,775.",
        "The barge: a prism over its waterline, in closed form. The FPSO: WAMIT's output for the same panels (MSS "
        "toolbox); its file is not in the repository, and its rows are left out where it is not beside it.",
        "0.5 %: WAMIT integrates over the leaking panels, and the barge's bottom has fewer chords than its side; Fram "
        "integrates over the sealed mesh.",
    )
    c.header = ["hull", "quantity", "expected", "Fram", "difference"]
    compare(c, "barge", ladder.ROOT / "tests" / "data" / "cracked_panels.gdf", barge())
    if fpso.exists():
        compare(c, "FPSO", fpso, WAMIT)
    return c
