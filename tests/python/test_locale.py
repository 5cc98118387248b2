#!/usr/bin/env python3
"""A program whose locale has a decimal comma, as those with Qt or GTK in Germany, gets the same bytes as any other:
files of a run, pages, drawings, texts and messages."""

import json
import locale
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import package  # first: it finds the package `fram`
from test_same_run import TOWED, without_wall_times

import fram
from fram import _library

COMMA = "de_DE.UTF-8"
folders = tempfile.TemporaryDirectory()
os.environ["LOCPATH"] = folders.name


def make_locale():
    """The locale with a comma, wherever this machine has none; the test is skipped where it cannot be made."""
    try:
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(folders.name, COMMA)], check=True,
                       capture_output=True)
        locale.setlocale(locale.LC_ALL, COMMA)
    except (OSError, subprocess.CalledProcessError, locale.Error) as error:
        package.skip(f"no locale with a decimal comma can be made here ({error})")
    comma = locale.localeconv()["decimal_point"]
    locale.setlocale(locale.LC_ALL, "C")
    assert comma == ",", comma


def plot(run, path):
    """The loads of a run as SVG, by the library."""
    error, names = _library.new_error(), _library.ffi.new("char[]", b"ice_force_x")
    _library.check(_library.lib.fram_plot(run._context._pointer, os.fsencode(run.folder),
                                          _library.ffi.new("char *[]", [names]), 1, float("nan"), float("nan"),
                                          os.fsencode(path), error), error)


def without_numbers_of_cairo(content):
    """Drawings have names that count on in a process, also in a page, where they are base64."""
    return re.sub(rb"surface\d+|base64,[\w+/=]+", b"", content)


def answers(folder, shown):
    """What the library tells and writes: a run into the folder, and pages of the run `shown`."""
    scenario = fram.Scenario.from_text(TOWED, overrides={"ice.thickness": 0.625})
    run, shown = scenario.run(folder), shown or fram.open(folder)
    shown.report(folder / "report.html")
    plot(shown, folder / "loads.svg")
    found = {name: without_wall_times(folder / name) for name in ("series.csv", "run.json")}
    found.update((name, without_numbers_of_cairo((folder / name).read_bytes())) for name in
                 ("scenario.yaml", "fractures.csv", "record.fram", "report.html", "loads.svg"))
    found["keys"] = sorted(json.loads((folder / "run.json").read_text()))
    found["floes"] = [floe.properties for floe in run.floes(0.55)]
    try:
        scenario.replaced({"ice.thickness": -0.625})
    except fram.InputError as error:
        found["message"] = str(error)
    return run, {"text": scenario.text, "notes": scenario.notes, "hash": scenario.hash, **found}


class Locale(unittest.TestCase):
    def test_a_decimal_comma_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            shown, plain = answers(pathlib.Path(folder) / "plain", None)
            self.addCleanup(locale.setlocale, locale.LC_ALL, "C")
            locale.setlocale(locale.LC_ALL, COMMA)
            _, comma = answers(pathlib.Path(folder) / "comma", shown)
            self.assertEqual(locale.localeconv()["decimal_point"], ",")  # it is still the program's
        self.assertIn("-0.625", plain["message"])
        for name, text in plain.items():
            self.assertEqual(comma[name], text, name)


if __name__ == "__main__":
    make_locale()
    unittest.main(argv=sys.argv[:1])
