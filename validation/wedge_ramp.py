#!/usr/bin/env python3
"""A wedge on water under a tip load that rises: the table of src/ice/wedge_ramp.c.

A wedge-shaped beam of width b0 x with the mass M per area (ice and the water that moves with it) on a Winkler
foundation k = rho_w g, under a load that grows in proportion to time over 0 < x < a:

    xi eta_tt + (xi eta'')'' + xi eta = xi p t/tau,   p = 2/(a/l)^2 for xi < a/l,

lengths over l, time over sqrt(M/k).  At the time tau, when the load is what the static solution (Nevel 1961) has, the
table gives three ratios to that solution: the largest eta'', its place, and eta(0).

Hermite elements on a mesh graded towards the tip, all modes of vibration summed: exact in time.  The far end is free
at 24 l.

    validation/wedge_ramp.py            the static solution beside Nevel's, the table, and its error between the nodes
"""

import math

import numpy
import scipy.linalg

# The nodes of the table: quarters and sixths of decades.
LOADS = [10 ** (-1.75 + i / 4) for i in range(8)]
TIMES = [10 ** (-2 + i / 6) for i in range(19)]
FAR = 24.0
STATIC = [(0.1, 0.511657, 2.067334)]  # a/l, x_max/l, eta(0): Nevel's series (src/ice/wedge.c)


def mesh(a):
    x, h = [0.0], min(a / 6, 0.02)
    while x[-1] < FAR:
        x.append(x[-1] + h)
        if x[-1] > 2 * a:
            h = min(1.06 * h, 0.12)
    x = numpy.array(x)
    x[numpy.argmin(abs(x - a))] = a
    return x


def second_derivatives(t, size):
    return numpy.array([-6 + 12 * t, size * (-4 + 6 * t), 6 - 12 * t, size * (6 * t - 2)]) / size**2


def matrices(x, a):
    n = 2 * len(x)
    bending, mass, load = numpy.zeros((n, n)), numpy.zeros((n, n)), numpy.zeros(n)
    points, weights = numpy.polynomial.legendre.leggauss(5)
    for e, size in enumerate(numpy.diff(x)):
        part = slice(2 * e, 2 * e + 4)
        for point, weight in zip((points + 1) / 2, weights * size / 2):
            t, at = point, x[e] + point * size
            shape = numpy.array([1 - 3 * t**2 + 2 * t**3, size * (t - 2 * t**2 + t**3), 3 * t**2 - 2 * t**3,
                                 size * (t**3 - t**2)])
            curve = second_derivatives(t, size)
            bending[part, part] += at * weight * numpy.outer(curve, curve)
            mass[part, part] += at * weight * numpy.outer(shape, shape)
            if at < a:
                load[part] += shape * at * weight * 2 / a**2
    return bending, mass, load


def largest_curvature(x, u):
    """Largest eta'' and its place, by a parabola through the points of the elements where it is most accurate."""
    places, values = [], []
    for e, size in enumerate(numpy.diff(x)):
        for t in (0.5 - math.sqrt(1 / 12), 0.5 + math.sqrt(1 / 12)):
            places.append(x[e] + t * size)
            values.append(second_derivatives(t, size) @ u[2 * e:2 * e + 4])
    i = int(numpy.argmax(values))
    if not 0 < i < len(values) - 1:
        return values[i], places[i]
    near = numpy.array(places[i - 1:i + 2]) - places[i]
    fit = numpy.polyfit(near, values[i - 1:i + 2], 2)
    top = -fit[1] / (2 * fit[0])
    return numpy.polyval(fit, top), places[i] + top


def solve(a, times):
    """The static x_max and eta(0); and for each time the three ratios."""
    x = mesh(a)
    bending, mass, load = matrices(x, a)
    scale = 1 / numpy.sqrt(numpy.diag(mass))
    squares, modes = scipy.linalg.eigh((bending + mass) * scale[:, None] * scale, mass * scale[:, None] * scale)
    modes = scale[:, None] * modes
    omega, part = numpy.sqrt(squares), (modes.T @ load) / squares
    still = numpy.linalg.solve(bending + mass, load)
    curvature, place = largest_curvature(x, still)
    ratios = []
    for tau in times:
        u = modes @ (part * (1 - numpy.sin(omega * tau) / (omega * tau)))
        now, at = largest_curvature(x, u)
        ratios.append((now / curvature, at / place, u[0] / still[0]))
    return place, still[0], numpy.array(ratios)


def cubic(p, v):
    return p[1] + 0.5 * v * (p[2] - p[0] + v * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]
                                                + v * (3 * (p[1] - p[2]) + p[3] - p[0])))


def between(table, i, k):
    """Half way between the nodes i and i + 1, k and k + 1, as src/ice/wedge_ramp.c does it."""
    def at(i, k):
        return table[min(max(i, 0), len(LOADS) - 1)][min(max(k, 0), len(TIMES) - 1)]

    return cubic([cubic([at(n, m) for m in range(k - 1, k + 3)], 0.5) for n in range(i - 1, i + 3)], 0.5)


def main():
    for a, place, tip in STATIC:
        found = solve(a, [1])
        print(f"static, a/l = {a}: x_max {found[0]:.5f} ({place:.5f}), eta(0) {found[1]:.5f} ({tip:.5f})")
    table = numpy.array([solve(a, TIMES)[2] for a in LOADS])
    for q, name in enumerate(("moment", "place", "tip")):
        print(f"/* {name} */")
        for row in table[:, :, q]:
            print("    {" + ", ".join(f"{v:.4f}" for v in row) + "},")
    worst = numpy.zeros(3)
    for i in range(len(LOADS) - 1):
        a, times = math.sqrt(LOADS[i] * LOADS[i + 1]), [math.sqrt(s * t) for s, t in zip(TIMES, TIMES[1:])]
        found = solve(a, times)[2]
        for k, ratios in enumerate(found):
            worst = numpy.maximum(worst, abs(between(table, i, k) - ratios))
    print("largest error between the nodes (moment, place, tip):", worst)


if __name__ == "__main__":
    main()
