"""Published formulas of the resistance in ice that several cases of the ladder compare with; SI units, angles in
degrees."""

import math
import typing

import demo_field


class Sheet(typing.NamedTuple):
    """Level ice, and the water under it."""

    strength: float
    modulus: float
    poisson: float = 0.3
    ice: float = 920.0
    water: float = 1025.0
    gravity: float = 9.81


class Bow(typing.NamedTuple):
    """What Lindqvist's formula asks of a ship."""

    length: float
    beam: float
    draught: float
    stem: float
    entrance: float


def lindqvist_parts(ship, sheet, h, v, mu):
    """Crushing, bending and submersion without speed [N], and by how much speed multiplies the first two, and the last
    (Lindqvist 1989)."""
    phi, alpha = math.radians(ship.stem), math.radians(ship.entrance)
    psi = math.atan(math.tan(phi) / math.sin(alpha))
    crushing = (0.5 * sheet.strength * h**2 * (math.tan(phi) + mu * math.cos(phi) / math.cos(psi))
                / (1 - mu * math.sin(phi) / math.cos(psi)))
    bending = (27 / 64 * sheet.strength * ship.beam * h**1.5
               / math.sqrt(sheet.modulus / (12 * (1 - sheet.poisson**2) * sheet.water * sheet.gravity))
               * (math.tan(psi) + mu * math.cos(phi) / (math.sin(alpha) * math.cos(psi))) * (1 + 1 / math.cos(psi)))
    submersion = (sheet.water - sheet.ice) * sheet.gravity * h * ship.beam * (
        ship.draught * (ship.beam + ship.draught) / (ship.beam + 2 * ship.draught)
        + mu * (0.7 * ship.length - ship.draught / math.tan(phi) - ship.beam / (4 * math.tan(alpha))
                + ship.draught * math.cos(phi) * math.cos(psi)
                * math.sqrt(1 / math.sin(phi) ** 2 + 1 / math.tan(alpha) ** 2)))
    return (crushing, bending, submersion, 1 + 1.4 * v / math.sqrt(sheet.gravity * h),
            1 + 9.4 * v / math.sqrt(sheet.gravity * ship.length))


def lindqvist(ship, sheet, h, v, mu):
    """Resistance in level ice [N] (Lindqvist 1989)."""
    crushing, bending, submersion, slow, deep = lindqvist_parts(ship, sheet, h, v, mu)
    return (crushing + bending) * slow + submersion * deep


def zuev(v=demo_field.SPEED, cover=demo_field.CONCENTRATION):
    """Resistance of the managed field's hull in a channel full of broken ice [N] (Zuev)."""
    f, b, h = v / math.sqrt(demo_field.GRAVITY * demo_field.THICKNESS), demo_field.BEAM, demo_field.THICKNESS
    weight = demo_field.ICE_DENSITY * demo_field.GRAVITY * b * h * h
    return weight * (0.13 * b / h + 1.3 * f + 0.5 * f * f) * (2 - cover) * cover**2


def huang(v=demo_field.SPEED, cover=demo_field.CONCENTRATION):
    """Resistance of the managed field's hull in unbroken floes, with the factor of a container ship [N] (Huang et al.
    2021)."""
    fn = v / math.sqrt(demo_field.GRAVITY * demo_field.LENGTH)
    return 0.20 * demo_field.ICE_DENSITY * demo_field.BEAM * demo_field.THICKNESS * v * v * cover**1.5 / fn
