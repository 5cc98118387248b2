#!/usr/bin/env python3
"""A case of the validation book still runs: its worlds, its page and its verdict, by the library as it is now.  One
that cannot be made does not agree, and runs are read again as long as the files that they name are the same.  A NaN
agrees with nothing, wherever it stands.  Worlds have what cases ask of them."""
import contextlib
import io
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ["FRAM_SOURCE"])
sys.path[:0] = [str(ROOT / "tests/python"), str(ROOT / "validation")]
import package  # noqa: E402,F401  first: it finds the package `fram`, by which worlds of cases are stepped
import case_field_steps  # noqa: E402
import case_positioning  # noqa: E402
import case_same_bits  # noqa: E402
import case_squeeze  # noqa: E402
import case_towed_box  # noqa: E402
import ladder  # noqa: E402
import run  # noqa: E402
import world  # noqa: E402


def cannot_be_made(_):
    raise RuntimeError(f"{ROOT}/hull.obj: cannot read it\nmore")


def read_again(path, beam):
    """Whether a run is read again whose hull has this beam now."""
    ladder.box_obj(path, (-5, -beam / 2, -2), (5, beam / 2, 2))
    ladder.MADE.clear()
    ladder.REUSED.clear()
    ladder.run(f"run: {{duration: 0.1}}\nvessel: {{hull: {{form: file, file: {path}}}}}\n"
               "ice: {source: floes, floes: [{length: 9, width: 9, x: 50}]}\n", "hull")
    return ladder.REUSED == ["hull"]


def exact_box(of):
    """What a case of the towed box asks for, but one sideways load."""
    w, h, exponent, step = of
    load = case_towed_box.STRENGTH * w * h if exponent == 0 else case_towed_box.case_iso.iso(w, h)
    last = (w, h) == case_towed_box.ROWS[-1] and step == case_towed_box.STEPS[-1]
    return load, load, math.nan if last else 0.0


def check_nan():
    """max(), min() and sorted() pass over one that is not the first."""
    for values in ((1.0, math.nan, 2.0), (math.nan, 1.0), (1.0, 2.0, math.nan)):
        assert math.isnan(ladder.greatest(values)) and math.isnan(ladder.least(*values)), values
        assert not ladder.rises(values), values
    assert ladder.greatest(abs(x) for x in (-3, 2)) == 3 and ladder.least(0.0, 1.0, -1.0) == -1
    assert ladder.rises([1, 1, 2]) and not ladder.rises([2, 1])
    asked = ladder.run_all, case_towed_box.job, case_towed_box.loads
    ladder.run_all, case_towed_box.job, case_towed_box.loads = list, lambda *of: of, exact_box
    box = case_towed_box.case(None)
    ladder.run_all, case_towed_box.job, case_towed_box.loads = asked
    assert [good for _, good in box.checks] == [False, True], box.checks


def follow(bandwidth):
    """A loop whose offset has a NaN behind its first value, with the slowest observer."""
    return [0.0, 1.0, 2.0], [0.0, math.nan if bandwidth < 1 else 1.2, 1.3 if bandwidth < 1 else 0.5]


def check_nan_of_runs():
    """One in a largest load, beside a sound mean, and one in a peak."""
    load = {"time": (0.0, 30.0, 40.0, 50.0), "ice_force_x": (0.0, -1e3, -2e3, -3e3)}
    load["ice_force_averaged_x"] = (0.0, -1e3, math.nan, -3e3)
    asked = ladder.fractures, ladder.figure, case_positioning.follow, case_positioning.exact
    ladder.fractures, ladder.figure = lambda _: {"kind": ()}, lambda *_: None
    case_positioning.follow = follow
    case_positioning.exact = lambda: ([0.0, 1.0], [0.0, case_positioning.PEAK], [0.0, case_positioning.INTEGRAL])
    breaks = case_field_steps.found("response", 0.01, iter([load] * 16))
    positioning = case_positioning.case(None)
    ladder.fractures, ladder.figure, case_positioning.follow, case_positioning.exact = asked
    assert breaks[2][0] == 2 and all(map(math.isnan, breaks[3])) and breaks[4][0] == 3, breaks
    text, good = positioning.checks[-1]
    assert "lag shows" in text and not good, positioning.checks


def check_worlds():
    """Where nobody is there is no body; the ice force is that of the first of several vessels; a processor without some
    instructions is no fault of the library."""
    ladder.box_obj(ladder.WORK / "hull.obj", (-5, -2, -2), (5, 2, 2))
    ship = f"hull: {{form: file, file: {ladder.WORK}/hull.obj}}, mode: prescribed, speed: 1"
    text = (f"vessels: [{{name: B, x: -20, {ship}}}, {{name: A, x: 40, {ship}}}]\n"
            "ice: {source: floes, floes: [{length: 9, width: 9, x: -10.4, fixed: true}]}\n")
    with world.World(text, "ships") as w:
        w.step(20)
        assert w.ice_force()[0] < 0 and w.ice_force() == tuple(w.world[f"B.ice_force_{axis}"] for axis in "xyz")
        assert w.body(0) and not w.body(99) and not w.body(-1)
    path = ladder.WORK / "ships.yaml"
    assert case_same_bits.hash_of(path, 0.1, {"isa": "none"}).startswith("not on this machine (expected baseline")
    assert len(case_same_bits.hash_of(path, 0.1, {"isa": "baseline"})) == 16
    try:
        case_same_bits.hash_of(path, 0.1, {"threads": 0})
        raise AssertionError("no thread is taken")
    except world.fram.UsageError as why:
        assert why.key == "threads", why


check_nan()
check_nan_of_runs()
with tempfile.TemporaryDirectory() as out:
    done = subprocess.run([sys.executable, str(ROOT / "validation" / "run.py"), "--only", "squeeze", "--out", out],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    page = (pathlib.Path(out) / "squeeze.md").read_text()
    assert "**Verdict: agrees.**" in page and page.count("- agrees:") == 11, page
    for asked in ("x", "0", "4", ""):
        done = subprocess.run([sys.executable, str(ROOT / "validation" / "run.py"), "--only", "squeeze", "--out", out],
                              capture_output=True, text=True, env={**os.environ, "FRAM_UIKKU_STARTS": asked})
        assert done.returncode != 0 and done.stderr == f"FRAM_UIKKU_STARTS: expected 1 to 3, found '{asked}'\n", done
    sys.argv[1:] = ["--only", "squeeze", "--out", out]
    case_squeeze.case = cannot_be_made
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        assert run.main() == 1
    verdict = json.loads((pathlib.Path(out) / "verdicts.json").read_text())["cases"]["squeeze"]
    assert not verdict["good"] and verdict["failed"][0].endswith("): RuntimeError: hull.obj: cannot read it"), verdict
    assert "0 of 1 cases agree" in (pathlib.Path(out) / "README.md").read_text()

    ladder.WORK = pathlib.Path(out) / "work"
    check_worlds()
    beams = (4, 4, 5, 5)
    assert [read_again(ladder.WORK / "hull.obj", beam) for beam in beams] == [False, True, False, True]
print("a case runs, and its page says so; runs are read again while their files are the same")
