#!/usr/bin/env python3
"""Two sheets whose ends pass each other: the upright load by finite elements of beams on water.

Each sheet is a strip D w'''' + rho_w g w = 0, free at its loaded end; one is pressed down and the other up by the same
load until their ends are half of both thicknesses apart.  Hermite elements, 2000 on 12 characteristic lengths.  With
the thrust T that slides them over each other in the balance too, + T w'', and in the stress, - T/h, the thickness up to
which sheets raft shows how much of it Fram's rule leaves out (tests/ice/test_crushing_sides.c, docs/decisions/0556).

    validation/raft_beams.py
"""

import math

import numpy
import scipy.sparse
import scipy.sparse.linalg

FOUNDATION, MODULUS, POISSON, STRENGTH = 1025 * 9.81, 5e9, 0.3, 6e5
ELEMENTS, REACH = 2000, 12.0


def beam(thickness, thrust=0.0):
    """Deflection of the end, and largest bending stress, under a unit load [m, Pa per N/m]."""
    stiffness = MODULUS * thickness**3 / (12 * (1 - POISSON**2))
    size = REACH * (stiffness / FOUNDATION) ** 0.25 / ELEMENTS
    bend = stiffness / size**3 * numpy.array([[12, 6 * size, -12, 6 * size], [6 * size, 4 * size**2, -6 * size,
                                              2 * size**2], [-12, -6 * size, 12, -6 * size],
                                              [6 * size, 2 * size**2, -6 * size, 4 * size**2]])
    water = FOUNDATION * size / 420 * numpy.array(
        [[156, 22 * size, 54, -13 * size], [22 * size, 4 * size**2, 13 * size, -3 * size**2],
         [54, 13 * size, 156, -22 * size], [-13 * size, -3 * size**2, -22 * size, 4 * size**2]])
    tilt = thrust / (30 * size) * numpy.array(
        [[36, 3 * size, -36, 3 * size], [3 * size, 4 * size**2, -3 * size, -size**2],
         [-36, -3 * size, 36, -3 * size], [3 * size, -size**2, -3 * size, 4 * size**2]])
    one = bend + water - tilt
    at = 2 * numpy.arange(ELEMENTS)[:, None, None] + numpy.arange(4)[None, :, None]
    row, column = numpy.broadcast_arrays(at, at.transpose(0, 2, 1))
    matrix = scipy.sparse.csc_matrix((numpy.broadcast_to(one, row.shape).ravel(), (row.ravel(), column.ravel())))
    load = numpy.zeros(2 * ELEMENTS + 2)
    load[0] = 1
    w = scipy.sparse.linalg.spsolve(matrix, load)
    # Moments in the middle of the elements.
    turn = (w[3::2] - w[1:-1:2]) / size
    return w[0], 6 * stiffness * numpy.max(numpy.abs(turn)) / thickness**2


def lift(a, b):
    """Load at which the ends of two sheets are half of both thicknesses apart [N/m]."""
    return (a + b) / 2 / (beam(a)[0] + beam(b)[0])


def limit(slope=None):
    """Thickness of two equal sheets up to which they raft; with the thrust up this slope in the balance."""
    low, high = 0.01, 1.0
    while high - low > 1e-5:
        h = (low + high) / 2
        thrust, load = 0.0, 0.0
        for _ in range(6 if slope else 1):
            down, stress = beam(h, thrust)
            load = h / (2 * down)
            thrust = load * math.tan(slope) if slope else 0.0
        low, high = (h, high) if load * stress - thrust / h <= STRENGTH else (low, h)
    return low


def main():
    print(f"sheets of 5 and 5 cm: {lift(0.05, 0.05):.3f} N/m; of 5 and 4 cm: {lift(0.05, 0.04):.3f} N/m")
    unit = (1 - POISSON**2) * STRENGTH**2 / (FOUNDATION * MODULUS)
    print(f"limit: {limit() / unit:.2f} (1 - nu^2) sigma_f^2/(rho_w g E)")
    for slope in (30, 45, 60):
        print(f"with the thrust up {slope} degrees: {limit(math.radians(slope)) / unit:.2f}")


if __name__ == "__main__":
    main()
