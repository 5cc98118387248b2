"""A real hull afloat, against WAMIT."""

import ladder

LONG = False
# The first column of numbers is what WAMIT prints for the panels.
WAMIT = [("volume", "volume_m3", 97960.9), ("waterplane", "waterplane_area_m2", 8316.7),
         ("centre of buoyancy, z", "centre_of_buoyancy_m", -5.922808)]


def case(out):
    hull = ladder.DATA / "hulls" / "fpso_low.gdf"
    if not hull.exists():
        raise ladder.Skipped("the panels of the FPSO lie beside the sources, and are not there")
    c = ladder.Case(
        "Hydrostatics of an FPSO",
        2,
        "Volume, waterplane and centre of buoyancy of a hull of 1,775 panels (half of it, mirrored), whose cracks are "
        "sealed and reported.",
        "WAMIT's output for the same panels (MSS toolbox).",
        "0.5 %: WAMIT integrates over the leaking panels, Fram over the sealed mesh.",
    )
    now = ladder.answer("hull", hull)
    c.header = ["quantity", "WAMIT", "Fram", "difference"]
    for what, key, expected in WAMIT:
        value = now[key][2] if isinstance(now[key], list) else now[key]
        c.rows.append([what, f"{expected:.8g}", f"{value:.8g}", f"{100 * (value / expected - 1):.4f} %"])
        c.check(abs(value / expected - 1) <= 5e-3, f"{what} within 0.5 %")
    volumes = now["volume_integrals_m3"]
    spread = max(volumes) / min(volumes) - 1
    c.check(spread <= 1e-6, f"the three volume integrals agree to {spread:.0e}, at most 1e-6")
    return c
