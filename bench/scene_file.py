"""Scenes of bench/peers/gen_scene.py, read: what stands before the floes, and the floes."""

import typing


class Floe(typing.NamedTuple):
    """Thickness [m] and density [kg/m3] as the file has them, and the outline about the place of the floe [m]."""

    thickness: str
    density: str
    outline: list


def read(path):
    """Lines that are no floe, and the floes."""
    head, floes = [], []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            word = line.split()
            if word and word[0] == "floe":
                v = [float(x) for x in word[6:]]
                floes.append(Floe(word[1], word[2], list(zip(v[0::2], v[1::2]))))
            else:
                head.append(line.rstrip("\n"))
    return head, floes
