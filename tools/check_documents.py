#!/usr/bin/env python3
"""Check the documents: what they cite is in the repository.

Rules:
  - a link of a Markdown file leads to a file of the repository, and its #part to a heading there (with --installed, to
    one that is installed, or to one of the repository of which packages are made without, as their page says);
  - a path in a Markdown file that begins with a folder of the repository (`src/ice/floe.h`, tests/cli/common.sh) is
    there; * stands for any letters, <words> and upper-case names for what the reader fills in;
  - `fram WORD` in a Markdown file names a command of the table in src/cli/main.c;
  - what a decision **Replaces** links back to it in its first paragraph;
  - a test in a Markdown file, `ROOM/TOPIC` of tests/ROOM/test_TOPIC, is there, and so are the cases of it that are
    named behind it;
  - a comment or text of any other file, tests apart, that names a page docs/*.md, a scene or a source in a room
    (src/ROOM/*.[ch]) names one that is there.

What a build makes (build/, out/, node_modules/) is not looked for.  Prints file:line: message for each breach; exit
code 1 when there is one."""

import os
import pathlib
import re
import subprocess
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEXT_SUFFIXES = {".c", ".h", ".py", ".sh", ".cmake", ".txt", ".yaml", ".js", ".mjs", ".ipynb", ".html"}
FOLDERS = r"(?:src|tests|docs|scenes|tools|bench|fuzz|examples|bindings|include|viewer|validation|cmake|packaging)"
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
PATH = re.compile(rf"(?<![\w./$-]){FOLDERS}/[\w.*<>{{}}|,/-]*[\w*>}}]")
PAGE = re.compile(r"(?<![\w./-])(?:docs|scenes)/[\w./-]+\.(?:md|yaml|png|svg)\b")
SOURCE = re.compile(r"(?<![\w./-])(src/\w+)/\w+\.[ch]\b")
HEADING = re.compile(r"^#{1,6} +(.*?)#*$", re.M)
FENCE = re.compile(r"^```.*?^```$", re.M | re.S)
COMMAND = re.compile(r"`fram ([a-z]+)")
COMMAND_ROW = re.compile(r'^    \{"([a-z]+)",', re.M)
# Names of cases have two words at least.
TEST = re.compile(r"`([a-z]+)/([a-z0-9_]+)`((?:,? [a-z0-9]+(?:_[a-z0-9]+)+)*)")
REPLACES = re.compile(r"^\*\*Replaces\*\*(?:[^\n]|\n(?!\n))*", re.M)
CASE = re.compile(r"START_TEST\((\w+)\)")
# What packages leave to the sources, as docs/packages.md says.
SOURCES = ("src/", "tests/", "include/", "bindings/", "bench/peers/", "tools/", "validation/", "CONTRIBUTING.md/")
# Patterns and places that a reader fills in are no files.
OPEN = re.compile(r"[<>{}|,]|NNNN|\bNAME\b|[A-Z]{4,}\b(?!\.md)")


def own_files():
    listing = subprocess.run([ROOT / "tools/sources.sh"], stdout=subprocess.PIPE, text=True, check=True)
    return [pathlib.Path(name) for name in listing.stdout.splitlines()]


def anchor(heading):
    """The name by which a heading is linked to, as the hosts of repositories make it."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def anchors(path):
    """All anchors of a page: a heading that comes again is numbered."""
    found, counts = set(), {}
    for heading in HEADING.findall(FENCE.sub("", path.read_text(encoding="utf-8"))):
        name = anchor(heading)
        found.add(name if name not in counts else f"{name}-{counts[name]}")
        counts[name] = counts.get(name, 0) + 1
    return found


def is_there(name):
    """A file or folder of the repository, or one that a build makes; * as in a shell; a C file may be named without its
    ending."""
    if "node_modules" in name.split("/"):
        return True
    if "*" in name:
        return any(ROOT.glob(name))
    return any((ROOT / (name + end)).exists() for end in ("", ".c", ".h", ".py", ".sh"))


def link_breach(page, target, root=ROOT):
    """Why a link of page, which lies under root, leads nowhere, or None."""
    if re.match(r"[a-z]+:", target):
        return None
    name, _, part = target.partition("#")
    path = (root / page.parent / name).resolve() if name else root / page
    if not path.exists() or root not in (path, *path.parents):
        return f"the link {target} leads to nothing in {'the repository' if root == ROOT else root}"
    if part and path.suffix == ".md" and part not in anchors(path):
        return f"the link {target} leads to no heading of its page"
    return None


def without_links(text):
    """The text with its lines, but not its links, whose names are relative to the page."""
    return LINK.sub(lambda link: "\n" * link[0].count("\n"), text)


def commands():
    """Those of the command, none where there is no command."""
    table = ROOT / "src/cli/main.c"
    return set(COMMAND_ROW.findall(table.read_text(encoding="utf-8"))) if table.exists() else set()


def test_breaches(line):
    """What is wrong about the tests that a line of a Markdown file names."""
    for room, topic, cases in TEST.findall(line):
        if not (ROOT / "tests" / room).is_dir() or is_there(f"src/{room}/{topic}"):
            continue
        files = sorted((ROOT / "tests" / room).glob(f"test_{topic}.*"))
        if not files:
            yield f"there is no test {room}/{topic}"
        found = set(CASE.findall(files[0].read_text(encoding="utf-8"))) if files else set()
        for case in re.findall(r"\w+", cases):
            if found and case not in found:
                yield f"the test {room}/{topic} has no case {case}"


def first_paragraph(text):
    """What follows the title of a page."""
    return text.partition("\n\n")[2].partition("\n\n")[0]


def unanswered(page, text):
    """Line and message for each decision that this one replaces and that does not say so."""
    for paragraph in REPLACES.finditer(text):
        for target in LINK.findall(paragraph[0]):
            old = ROOT / page.parent / target
            # What is not there is told as a link.
            if old.is_file() and f"({page.name})" not in first_paragraph(old.read_text(encoding="utf-8")):
                line = text.count("\n", 0, paragraph.start()) + 1
                yield line, f"{target} is replaced by this page, and its first paragraph does not name it"


def breaches(page):
    """Line and message of each breach."""
    text = (ROOT / page).read_text(encoding="utf-8", errors="replace")
    known = commands()
    markdown = page.suffix == ".md"
    for link in LINK.finditer(text) if markdown else ():
        said = link_breach(page, link[1])
        if said:
            yield text.count("\n", 0, link.start()) + 1, said
    if page.parent == pathlib.Path("docs/decisions"):
        yield from unanswered(page, text)
    for number, line in enumerate(without_links(text).split("\n"), 1):
        for name in (PATH if markdown else PAGE).findall(line):
            if not OPEN.search(name) and not is_there(name.rstrip(".")):
                yield number, f"{name} is not in the repository"
        for word in COMMAND.findall(line) if markdown and known else ():
            if word not in known:
                yield number, f"`fram {word}` is no command"
        for said in test_breaches(line) if markdown else ():
            yield number, said
        for source in SOURCE.finditer(line) if not markdown else ():
            # Libraries have folders of that name too, but not our rooms.
            if (ROOT / source[1]).is_dir() and not is_there(source[0]):
                yield number, f"{source[0]} is not in the repository"


def in_the_sources(page, target, without):
    """Whether a link leads to what packages are made without."""
    place = os.path.normpath(page.parent / target.partition("#")[0])
    return f"{place}/".startswith(without) and (ROOT / place).exists()


def check_installed(folder, without):
    """How many links of the Markdown files in a folder lead nowhere; they stand as they do in the repository."""
    bad = 0
    for path in sorted(folder.rglob("*.md")):
        page = path.relative_to(folder)
        for target in LINK.findall(path.read_text(encoding="utf-8")):
            said = link_breach(page, target, folder)
            if said and not in_the_sources(page, target, without):
                print(f"{page}: {said}")
                bad += 1
    return bad


def main():
    words = words_of(__doc__)
    words.add_argument("--installed", type=pathlib.Path, metavar="FOLDER",
                       help="the documents of a package instead of those of the repository: their links")
    words.add_argument("--without", metavar="FOLDER/", action="append", default=[],
                       help="what this package leaves to the sources beside the folders that all leave to them")
    options = words.parse_args()
    if options.installed:
        return 1 if check_installed(options.installed.resolve(), (*SOURCES, *options.without)) else 0
    bad = 0
    for page in own_files():
        # Tests name files that they plant, or that must be missing.
        if page.suffix == ".md" or page.suffix in TEXT_SUFFIXES and page.parts[0] != "tests":
            for number, message in breaches(page):
                print(f"{page}:{number}: {message}")
                bad += 1
    return 1 if bad else 0


sys.exit(main())
