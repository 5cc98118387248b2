#!/usr/bin/env python3
"""Name the functions that nothing in src/ calls, those that only their own file calls although a header declares
them, and the public ones that no C test calls:  tools/check_unused.py

A function that other files can see (extern, or static inline in a header) is used when its name stands in src/ or
include/ somewhere else than where it is declared and defined.  What only tests use is not the program's: it belongs
into tests/, or is listed here with the reason why it stays.  What one file of src/ uses, and no test or other program,
is static there.  Prints file: message; exit code 1 when there is one.
"""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from check_rooms import without_comments  # noqa: E402
from words import words_of  # noqa: E402

# Used by tests only, and why it stays.
KEPT = {
    "overlay_triangulate": "the step under overlay_convex_pieces that GEOS's own triangulation is an oracle for",
    "sheet_edge_deflection": "the field between the breaking radius and the edge, against the closed form",
    "sheet_stress_strip": "the stress that the breaking radius of a strip is held against",
    "world_difference": "names the first field in which two worlds differ: what a failed test must say",
}

# Used by their own file only, and why a header declares them.
ENGINE = "pages of the validation book are of this code as it is: static when it changes"
DECLARED = {
    "drift_tile_mass": ENGINE,
    "flooding_discharge": ENGINE,
    "fracture_has_parts": ENGINE,
    "island_leader": ENGINE,
    "triangle_moments": ENGINE,
    "world_row": "the header tells all that a handle of a world gives",
}

FUNCTION = re.compile(r"^(?!typedef\b|return\b|else\b|#)[A-Za-z_][\w \*]*?[ \*]([a-z_]\w*)\(", re.M)
WORD = re.compile(r"\b[a-z_]\w*\b")


def code_of(*patterns):
    found = {}
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            found[path] = without_comments(path.read_text())
    return found


def declared(code):
    """Function -> paths, one for each declaration or definition of it that other files may see."""
    places = collections.defaultdict(list)
    for path, text in code.items():
        for found in FUNCTION.finditer(text):
            if path.suffix == ".h" or not found.group().startswith("static "):
                places[found.group(1)].append(path)
    return places


def own(code, places, elsewhere):
    """Functions that a header declares and one .c file alone names, the one that defines them."""
    named = collections.Counter()
    in_headers = collections.Counter()
    for path, text in code.items():
        words = WORD.findall(text)
        if path.suffix == ".h":
            in_headers.update(words)
        else:
            named.update(set(words))
    for name, paths in sorted(places.items()):
        headers = sum(path.suffix == ".h" for path in paths)
        if 0 < headers < len(paths) and named[name] == 1 and in_headers[name] == headers and name not in elsewhere:
            yield name


def main():
    words_of(__doc__).parse_args()
    code = code_of("src/*/*.[ch]", "include/fram/*.h")
    used = collections.Counter(word for text in code.values() for word in WORD.findall(text))
    programs = code_of("tests/**/*.[ch]", "fuzz/*.[ch]", "bench/*.[ch]", "bindings/**/*.[ch]")
    elsewhere = {word for text in programs.values() for word in WORD.findall(text)}
    tests = {word for text in code_of("tests/**/*.[ch]").values() for word in WORD.findall(text)}
    places = declared(code)
    count = 0
    for name, paths in sorted(places.items()):
        where = paths[0].relative_to(ROOT)
        if name.startswith("fram_") and (ROOT / "include" / "fram") in [path.parent for path in paths]:
            if name not in tests:
                print(f"{where}: {name} is public and no C test calls it")
                count += 1
        elif used[name] <= len(paths) and name != "main" and name not in KEPT:
            print(f"{where}: nothing in src/ uses {name}: delete it, or move it to where it is used")
            count += 1
    for name in own(code, places, elsewhere):
        if used[name] > len(places[name]) and name not in DECLARED:
            print(f"{places[name][0].relative_to(ROOT)}: only its own file uses {name}: make it static")
            count += 1
    for name in sorted({**KEPT, **DECLARED}):
        if name not in places:
            print(f"tools/check_unused.py: {name} is listed with a reason to stay, and there is no such function")
            count += 1
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
