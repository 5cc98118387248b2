#!/usr/bin/env python3
"""Which pages of the validation book were made on other solver, contact, fracture, water or geometry code than there is
now.

Names them; exit code 0 whatever it finds: a page may wait, but not in silence.
Told by content, not by date: the code of a part is the hash of its files without comments and white space, with numbers
for names that a .c file has for itself, and without assertions, which the build that makes the book leaves out: so a
page does not age by a better comment, name or assertion.
"""

import argparse
import fnmatch
import hashlib
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BOOK = ROOT / "docs" / "validation" / "verdicts.json"
CONTACT = ("src/dynamics/broad*", "src/dynamics/narrow*", "src/dynamics/prism*", "src/dynamics/manifold*",
           "src/dynamics/separation*", "src/dynamics/collision*", "src/dynamics/contact.*",
           "src/ice/crushing*", "src/ice/patch*")
FIELDS = ("src/ice/field*", "src/ice/packing*", "src/ice/import*", "src/ice/feeding*")
# Acts on meshes with open edges alone, as they are read.
SEALING = ("src/geometry/mesh_seal.*",)
# Part -> its files, and those of them that belong to another part.
PARTS = {
    "solver": (("src/dynamics/*",), CONTACT),
    "contact": (CONTACT, ()),
    "fracture": (("src/ice/*",), CONTACT + FIELDS),
    "water": (("src/fluid/*",), ()),
    "geometry": (("src/geometry/*", "src/bodies/*"), SEALING),
    "sealing": (SEALING, ()),
}
# Part -> the pages that go by it, where not all do.  Hulls that other cases read from files are made by them, closed
# and with shared corners; hydrostatics reads panels with cracks.
READ_BY = {"sealing": ("hydrostatics",)}
ROOMS = sorted({name.split("/")[1] for names, _ in PARTS.values() for name in names})
COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*|("(?:\\.|[^"\\\n])*")', re.S)
# Blocks without directives of their own, and statements that end with the line.
ASSERTION = re.compile(r"^#ifndef NDEBUG\n(?:(?!#).*\n)*#endif\n|^ *assert\([^;]*\);\n", re.M)


# What a file calls its own at the left margin: static functions and data, macros, types, enumerators.
OWN = re.compile(r"^static [^;{=(]*?\b(\w+)\s*[\[(=;]|^#define (\w+)|^} (\w+);|^typedef [^;{]*\b(\w+);"
                 r"|^(?:typedef )?(?:struct|union) (\w+) {", re.M)
ENUMERATORS = re.compile(r"^(?:typedef )?enum[^{;]*{([^}]*)}", re.M)


def own_names(code):
    names = {name for found in OWN.findall(code) for name in found if name}
    return names.union(*(re.findall(r"(?:^|,)\s*(\w+)", listed) for listed in ENUMERATORS.findall(code)))


def bare(path, text):
    """Code without comments and assertions, without white space where it says nothing, and of a file that is not
    included by others without the names that are its own: the n-th of them is ~n."""
    code = ASSERTION.sub("", COMMENT.sub(lambda found: found.group(1) or " ", text))
    if path.endswith(".c"):
        own, numbers = own_names(code), {}
        code = re.sub(r"\w+", lambda found: f"~{numbers.setdefault(found.group(), len(numbers))}"
                      if found.group() in own else found.group(), code)
    return " ".join(code.split())


def fingerprint(files, read):
    """Part -> hash of its code.  files: paths from the root; read: path -> text."""
    out = {}
    for part, (names, others) in PARTS.items():
        digest = hashlib.sha256()
        for path in sorted(files):
            if any(fnmatch.fnmatch(path, n) for n in names) and not any(fnmatch.fnmatch(path, n) for n in others):
                digest.update(f"{path}\n{bare(path, read(path))}\n".encode())
        out[part] = digest.hexdigest()[:16]
    return out


def of_checkout():
    files = [str(p.relative_to(ROOT)) for room in ROOMS for p in (ROOT / "src" / room).iterdir()]
    return fingerprint([f for f in files if f.endswith((".c", ".h"))], lambda f: (ROOT / f).read_text())


def of_revision(revision):
    def git(*words):
        return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=True).stdout

    files = git("ls-tree", "-r", "--name-only", revision, *(f"src/{room}" for room in ROOMS)).split()
    return fingerprint([f for f in files if f.endswith((".c", ".h"))], lambda f: git("show", f"{revision}:{f}"))


def adopt():
    book, known = json.loads(BOOK.read_text()), {}
    for verdict in book["cases"].values():
        revision = verdict["made"].split(", ")[1].rstrip("+")
        if "code" not in verdict:
            verdict["code"] = known.setdefault(revision, None) or of_revision(revision)
            known[revision] = verdict["code"]
    BOOK.write_text(json.dumps(book, indent=1, sort_keys=True) + "\n")


def changed(name, verdict, now):
    """Parts whose code is not that which a page was made on."""
    was = verdict.get("code", {})
    return [part for part in PARTS if name in READ_BY.get(part, (name,)) and was.get(part) != now[part]]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--adopt", action="store_true",
                       help="for pages without a record of their code: take that of the revision they name")
    if words.parse_args().adopt:
        adopt()
        return 0
    now, cases = of_checkout(), json.loads(BOOK.read_text())["cases"]
    older = {}
    for name, verdict in cases.items():
        other = changed(name, verdict, now)
        if other:
            older.setdefault((verdict["made"], ", ".join(other)), []).append(name)
    fresh = len(cases) - sum(map(len, older.values()))
    print(f"validation: {fresh} of {len(cases)} pages were made on the {', '.join(PARTS)} code of now")
    for (made, parts), names in sorted(older.items()):
        print(f"  made {made}, on other {parts} code: {', '.join(sorted(names))}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
