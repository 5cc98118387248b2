"""The list of mutants: small plausible faults, by room, in tests/mutants/<room>.txt.

An entry is a block of lines, blocks are parted by empty lines, lines of '#' are comments:

    [sign] the cross product turns the other way
    file: vec.h
    after: static inline vec3 vec3_cross(
    - a.y * b.z - a.z * b.y
    + a.y * b.z + a.z * b.y
    test: base/vec (the test to try first, of any room; where it is not named, the likeliest are guessed)
    survives: why no test can tell (only where none does)

The text after '-' must stand exactly once in the room, or in the file named, or, with 'after', be looked for from there
on; how it is broken into lines does not matter.  Several '-' lines are one text.  Files may move within their room.
"""

import collections
import re

KINDS = ("sign", "factor", "off-by-one", "missing", "index", "comparison", "clamp", "swap", "constant", "logic")
# Calls go down the floors: a fault is looked for by tests of its own room first, then by those of rooms above.
ROOMS = ("base", "geometry", "bodies", "dynamics", "fluid", "ice", "vessel", "model", "io", "results", "sim", "study",
         "api", "cli")

Mutant = collections.namedtuple("Mutant", "room kind what file after old new test survives place")


class Stale(Exception):
    """A mutant that does not fit the code any more."""


def _block(room, lines, place):
    """One entry from its numbered lines."""
    head = re.match(r"^\[([\w-]+)\] (.+)$", lines[0])
    if not head or head[1] not in KINDS:
        raise Stale(f"{place}: begins with [kind] and what it breaks; kinds are {', '.join(KINDS)}")
    fields = {"file": "", "after": "", "test": "", "survives": ""}
    old, new = [], []
    for line in lines[1:]:
        word, _, rest = line.partition(" ")
        if word == "-":
            old.append(rest)
        elif word == "+":
            new.append(rest)
        elif word.rstrip(":") in fields and word.endswith(":"):
            fields[word[:-1]] = rest.strip()
        else:
            raise Stale(f"{place}: a line begins with file:, after:, test:, survives:, - or +: {line}")
    if not old or not new:
        raise Stale(f"{place}: a text to find and one to put in its place")
    return Mutant(room, head[1], head[2], fields["file"], fields["after"], "\n".join(old), "\n".join(new),
                  fields["test"], fields["survives"], place)


def read(root):
    """All mutants, room by room."""
    found = []
    for room in ROOMS:
        path = root / "tests/mutants" / f"{room}.txt"
        if not path.exists():
            continue
        block, began = [], 0
        for number, line in enumerate([*path.read_text(encoding="utf-8").splitlines(), ""], 1):
            if line.startswith("#"):
                continue
            if line.strip():
                began = began if block else number
                block.append(line)
            elif block:
                found.append(_block(room, block, f"tests/mutants/{room}.txt:{began}"))
                block = []
    return found


def pattern(text):
    """A text, however it is broken into lines."""
    return re.compile(r"\s+".join(re.escape(word) for word in text.split()))


def _from(text, after):
    """Where to look from: behind the only place of a text; None where there is none."""
    if not after:
        return 0
    places = list(pattern(after).finditer(text))
    return places[0].end() if len(places) == 1 else None


def locate(root, mutant):
    """(file, its text with the fault), or Stale."""
    folder = root / "src" / mutant.room
    hits = []
    for path in sorted(folder.glob("*.[ch]")):
        if mutant.file and path.name != mutant.file:
            continue
        text = path.read_text(encoding="utf-8")
        begin = _from(text, mutant.after)
        if begin is None:
            continue
        places = list(pattern(mutant.old).finditer(text, begin))
        # With a place to look from, the first one is meant.
        hits += [(path, text, m) for m in (places[:1] if mutant.after else places)]
    if len(hits) != 1:
        begin = mutant.old.splitlines()[0]
        raise Stale(f"{mutant.place}: stands {len(hits)} times in src/{mutant.room}, not once: {begin}")
    path, text, match = hits[0]
    return path, text[:match.start()] + mutant.new + text[match.end():]


def check(root):
    """Every mutant that is stale, as messages."""
    try:
        mutants = read(root)
    except Stale as stale:
        return [str(stale)], 0
    problems, seen = [], {}
    for mutant in mutants:
        try:
            path, text = locate(root, mutant)
        except Stale as stale:
            problems.append(str(stale))
            continue
        same = seen.setdefault((path, text), mutant)
        if same is not mutant:
            problems.append(f"{mutant.place}: the same fault as {same.place}")
        if text == path.read_text(encoding="utf-8"):
            problems.append(f"{mutant.place}: changes nothing")
    return problems, len(mutants)
