"""Which crack comes first at an edge, and at which load."""

import math

import ladder

LONG = False
SIGMA, MODULUS, NU, RHO, G = 0.5e6, 5e9, 0.3, 1025.0, 9.81
AREAS = [0.01 * 2**k for k in range(10)]


def characteristic(h):
    return (MODULUS * h**3 / (12 * (1 - NU**2) * RHO * G)) ** 0.25


def limits(area, h=1.0, *words):
    return ladder.answer("ice", "break", "--contact-area", area, "--thickness", h, *words)


def case(out):
    c = ladder.Case(
        "Order of the cracks at an edge",
        2,
        "Loads at which the radial crack opens and the wedges break off, for patches of 0.01 to 5 m2 and ice of 0.5, "
        "1 and 2 "
        "m (0.5 MPa, 5 GPa), by the functions that the simulation uses.",
        "Nevel: three wedges over a/l = 0.1 carry 0.7248 sigma_f h^2, 362 kN for 1 m, and break at 7.47 m. The exact "
        "plate "
        "under a half disk of a/l = 0.1: 1/3.95955 sigma_f h^2.",
        "The numbers to 1e-3 (radial: 1 %, Westergaard's closed form). The radial crack opens first at any load: so "
        "the wedges exist when they break off.",
    )
    l = characteristic(1.0)
    b0 = 2 * math.tan(math.pi / 6)
    wedge = limits(3 * b0 / 2 * (0.1 * l) ** 2, 1.0, "--thin-plate")
    radial = limits(math.pi / 2 * (0.1 * l) ** 2, 1.0, "--thin-plate")
    unit = SIGMA * 1.0
    c.header = ["quantity", "found", "expected"]
    c.rows += [["characteristic length [m]", f"{wedge['characteristic_length']:.5f}", "14.6079"],
               ["wedges, a/l 0.1: load / (sigma_f h^2)", f"{wedge['wedge_capacity'] / unit:.5f}", "0.7248"],
               ["R_bending [m]", f"{wedge['breaking_radius']:.4f}", "7.47"],
               ["radial crack, a/l 0.1: load / (sigma_f h^2)", f"{radial['radial_capacity'] / unit:.5f}",
                f"{1 / 3.95955:.5f}"]]
    c.check(abs(wedge["characteristic_length"] / 14.6079 - 1) < 1e-5, "characteristic length")
    c.check(abs(wedge["wedge_capacity"] / unit / 0.7248 - 1) < 1e-3, "load of three wedges to 1e-3")
    c.check(abs(wedge["breaking_radius"] / 7.47 - 1) < 1e-3, "breaking radius to 1e-3")
    c.check(abs(radial["radial_capacity"] / unit * 3.95955 - 1) < 1e-2, "load of the radial crack to 1 %")
    curves = {}
    for h in (0.5, 1.0, 2.0):
        found = [limits(a, h) for a in AREAS]
        curves[h] = found
        ratios = [f["radial_capacity"] / f["wedge_capacity"] for f in found]
        c.rows.append([f"radial over wedge load, {h} m, all patches", f"{min(ratios):.3f} to "
                                                                      f"{max(ratios):.3f}", "under 1"])
        c.check(ladder.greatest(ratios) < 1, f"{h} m: radial crack first, at {min(ratios):.2f} to {max(ratios):.2f} of "
                                             f"the wedges' load")

    def draw(axes):
        for h, found in curves.items():
            line, = axes.loglog(AREAS, [f["radial_capacity"] / 1e3 for f in found], "--", label=f"radial crack, {h} m")
            axes.loglog(AREAS, [f["wedge_capacity"] / 1e3 for f in found], color=line.get_color(),
                        label=f"wedges, {h} m")
        axes.loglog(AREAS, [2e6 * a / 1e3 for a in AREAS], "k:", label="crushing, 2 MPa")
        axes.set(xlabel="horizontal area of the patch [m²]", ylabel="vertical load [kN]")
        axes.legend(fontsize=7, ncols=2)

    ladder.figure(c, out, "order", "Loads of the cracks against the area of the patch.", draw)
    return c
