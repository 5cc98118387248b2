"""What is given to the package: of the kind that is asked for, or a UsageError that names the argument and says what is
allowed.  Ranges are the library's to refuse, but where C's numbers end before them."""

from __future__ import annotations

import operator
import os
from typing import Any, Sequence

import numpy as np

from ._library import UsageError, encoded_of


def refuse(name: str, expected: str, found: Any) -> UsageError:
    """The error of an argument that is not what is expected."""
    text = repr(found)
    text = text if len(text) <= 80 else text[:80] + " ..."
    return UsageError("usage", f"expected {expected}, found {text}", key=name)


def whole_of(name: str, value: Any, expected: str, least: int = -2**31, most: int = 2**31 - 1) -> int:
    """A whole number from `least` to `most`, Python's or numpy's."""
    try:
        number = operator.index(value)
    except TypeError:
        raise refuse(name, expected, value) from None
    if not least <= number <= most:
        raise refuse(name, expected, value)
    return number


def number_of(name: str, value: Any, expected: str = "a number") -> float:
    """A number, of whatever class; a text is none."""
    try:
        if not isinstance(value, (str, bytes, bytearray)):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise refuse(name, expected, value) from None


def numbers_of(name: str, values: Any, expected: str = "numbers") -> np.ndarray:
    """An array of numbers in whatever shape it has, as C has them."""
    try:
        found = np.asarray(values)
        if found.dtype.kind == "O":  # of numbers that numpy has no form of, or of anything
            found = np.array([number_of(name, x, expected) for x in found.flat]).reshape(found.shape)
    except (TypeError, ValueError, OverflowError):  # an UsageError too: all of them are to be told
        raise refuse(name, expected, values) from None
    if found.dtype.kind not in "biuf":
        raise refuse(name, expected, values)
    return np.ascontiguousarray(found, float).reshape(found.shape)


def flag_of(name: str, value: Any) -> bool:
    """True or False: a text is always true, whatever it says."""
    if isinstance(value, (bool, np.bool_)) or isinstance(value, (int, np.integer)) and value in (0, 1):
        return bool(value)
    raise refuse(name, "True or False", value)


def path_of(name: str, path: Any) -> bytes:
    """A path for C."""
    try:
        return encoded_of(name, os.fsencode(path))
    except (TypeError, UnicodeError):
        raise refuse(name, "a path", path) from None


def absolute_of(name: str, path: Any) -> bytes:
    """A path for C that lasts when the working folder changes."""
    encoded = path_of(name, path)
    return os.path.abspath(encoded) if encoded else encoded


def text_bytes_of(name: str, text: Any) -> bytes:
    """A text for C, whose scenarios are UTF-8 in every locale."""
    try:
        encoded = text.encode("utf-8", "surrogateescape") if isinstance(text, str) else os.fsencode(text)
    except (TypeError, UnicodeError):
        raise refuse(name, "a text", text) from None
    return encoded_of(name, encoded)


def call_of(name: str, function: Any):
    """What can be called, or None."""
    if function is not None and not callable(function):
        raise refuse(name, "a function, or None for none", function)
    return function


def names_of(name: str, given: Any, what: str) -> tuple[str, ...]:
    """One name, or several."""
    try:
        found = (given,) if isinstance(given, str) else tuple(given)
    except TypeError:
        found = (None,)
    if not all(isinstance(each, str) for each in found):
        raise refuse(name, f"names of {what}", given)
    return found


def one_of(name: str, value: Any, kind: type) -> Any:
    """An object of a class of this package."""
    if not isinstance(value, kind):
        raise refuse(name, f"a fram.{kind.__name__}", value)
    return value


def list_of(name: str, values: Any, expected: str) -> Sequence:
    """The members of what has some."""
    try:
        return list(values)
    except TypeError:
        raise refuse(name, expected, values) from None
