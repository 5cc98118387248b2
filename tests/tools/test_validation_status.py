#!/usr/bin/env python3
"""The code that a page of the validation book was made on is told by what it says, not by how it is commented, what
its files call their own or what they assert."""
import os
import pathlib
import sys

ROOT = pathlib.Path(os.environ["FRAM_SOURCE"])
sys.path.insert(0, str(ROOT / "validation"))
import status  # noqa: E402

FILES = {
    "src/dynamics/solver.c": "/* sweeps */\ndouble beta = 0.8;  // rate\n",
    "src/dynamics/narrow_phase.c": "int pairs;\n",
    "src/ice/fracture.c": 'const char *no = "/* text */";\n',
    "src/ice/packing.c": "int packed;\n",
    "src/geometry/mesh.c": "int corners;\n",
    "src/geometry/mesh_seal.c": "int passes;\n",
    "src/fluid/drag.c": "double drag;\n",
    "src/fluid/lift.c": "static double lift(double u) { return u; }\nenum { MOST = 4 };\n"
                        "double both(double u) { return lift(u); }\n",
}


def parts_changed(**changes):
    changed = {path.replace("__", "/") + ".c": text for path, text in changes.items()}
    before = status.fingerprint(FILES, FILES.__getitem__)
    after = status.fingerprint(FILES, lambda path: changed.get(path, FILES[path]))
    return [part for part in status.PARTS if before[part] != after[part]]


assert parts_changed(src__dynamics__solver="double   beta\n= 0.8;") == []
assert parts_changed(src__dynamics__solver="double beta = 0.7;") == ["solver"]
assert parts_changed(src__dynamics__narrow_phase="int pairs, more;") == ["contact"]
assert parts_changed(src__ice__fracture='const char *no = "/* other */";') == ["fracture"]
assert parts_changed(src__ice__packing="int loose;") == []
assert parts_changed(src__fluid__drag="double lift;") == ["water"]
# Sealing is no geometry of what is closed: the page of cracked panels goes by it, and no other.
assert parts_changed(src__geometry__mesh_seal="int passes = 9;") == ["sealing"]
assert parts_changed(src__geometry__mesh="int corners = 9;") == ["geometry"]
MADE = {"code": dict.fromkeys(status.PARTS, "same")}
RESEALED = MADE["code"] | {"sealing": "other"}
assert status.changed("hydrostatics", MADE, RESEALED) == ["sealing"]
assert status.changed("hull_mesh", MADE, RESEALED) == []
assert status.changed("hull_mesh", MADE, MADE["code"] | {"geometry": "other"}) == ["geometry"]
# Names of a file's own are its own affair, what stands under them is not; names that others see are no file's own.
LIFT = FILES["src/fluid/lift.c"]
assert parts_changed(src__fluid__lift=LIFT.replace("lift", "raise").replace("MOST", "LIFTS_MOST")) == []
assert parts_changed(src__fluid__lift=LIFT.replace("return lift(u)", "return MOST")) == ["water"]
assert parts_changed(src__fluid__lift=LIFT.replace("both", "all")) == ["water"]
# The book is made by a build without assertions. Other code of debug builds, and code after an assertion, counts.
ASSERTED = LIFT.replace("{ return", "{\n    assert(u > 0 &&\n           fabs(u) < MOST);\n    return")
assert parts_changed(src__fluid__lift=ASSERTED) == []
assert parts_changed(src__fluid__lift=ASSERTED.replace("    return lift", "    u++;\n    return lift")) == ["water"]
assert parts_changed(src__fluid__lift="#ifndef NDEBUG\nint unused;\n#endif\n" + LIFT) == []
assert parts_changed(src__fluid__lift="#ifdef FRAM_WIDE\nint unused;\n#endif\n" + LIFT) == ["water"]
# Each part has files in this checkout: a pattern that matches nothing would call every page fresh.
empty = status.fingerprint([], None)
now = status.of_checkout()
assert all(now[part] != empty[part] for part in status.PARTS), now
print("comments, own names and assertions change no fingerprint, code changes that of its part")
