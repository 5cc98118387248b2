#!/usr/bin/env python3
"""docs/python.md from the docstrings of the package.

FRAM_LIBRARY names libfram where the package does not carry it."""

import inspect
import pathlib
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bindings/python"))
PAGE = ROOT / "docs/python.md"
MARK = "<!-- written by tools/python_reference.py from here on -->\n"


class Plain:
    """A text that is shown as it is."""

    def __init__(self, text):
        self.text = text

    def __repr__(self):
        return self.text


def annotation(of):
    """A type as it is written, without the quotation marks that only Python's reading order asks for."""
    if of is inspect.Parameter.empty:
        return of
    text = of if isinstance(of, str) else getattr(of, "__forward_arg__", None) or inspect.formatannotation(of)
    return Plain(text.replace("'", "").replace('"', ""))


def default(of):
    """Functions and classes by their names, not where they lie in memory."""
    return Plain(of.__name__) if inspect.isfunction(of) or inspect.isclass(of) and of is not inspect.Parameter.empty \
        else of


def signature(thing):
    try:
        found = inspect.signature(thing)
    except (TypeError, ValueError):
        return ""
    parameters = [p.replace(annotation=annotation(p.annotation), default=default(p.default))
                  for p in found.parameters.values()]
    return str(found.replace(parameters=parameters, return_annotation=annotation(found.return_annotation)))


def members(thing):
    for name, value in vars(thing).items():
        if name.startswith("_"):
            continue
        if isinstance(value, property):
            yield f"**`{name}`**", inspect.getdoc(value)
        elif isinstance(value, classmethod) or inspect.isfunction(value):
            yield f"**`{name}{signature(getattr(thing, name))}`**", inspect.getdoc(value)


def described(thing):
    """A class, a function or an exception as Markdown."""
    name = thing.__name__
    lines = [f"### `fram.{name}`\n"]
    if inspect.isclass(thing) and not issubclass(thing, BaseException):
        lines = [f"### `fram.{name}{signature(thing)}`\n"]
    elif inspect.isfunction(thing):
        lines = [f"### `fram.{name}{signature(thing)}`\n"]
    lines.append((inspect.getdoc(thing) or "") + "\n")
    if inspect.isclass(thing):
        lines += [f"- {head}: {' '.join((text or '').split())}\n" for head, text in members(thing)]
    return "\n".join(lines[:2]) + "\n" + "".join(lines[2:])


def main():
    words = words_of(__doc__)
    words.add_argument("--check", action="store_true", help="write nothing; exit code 1 where the page is another")
    check = words.parse_args().check
    import fram
    names = [name for name in fram.__all__ if name != "open"]
    text = "\n".join(described(getattr(fram, name)) for name in sorted(names, key=str.lower))
    page = PAGE.read_text().split(MARK)[0] + MARK + "\n" + text
    if check:
        if PAGE.read_text() != page:
            print("FAILED: docs/python.md is not what tools/python_reference.py writes; run it")
            return 1
        return 0
    PAGE.write_text(page)
    return 0


sys.exit(main())
