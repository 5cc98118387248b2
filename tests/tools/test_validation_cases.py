#!/usr/bin/env python3
"""A case of the validation book still runs: its worlds, its page and its verdict, by the library as it is now.  One
that cannot be made does not agree."""
import contextlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ["FRAM_SOURCE"])
sys.path.insert(0, str(ROOT / "validation"))
import case_squeeze  # noqa: E402
import run  # noqa: E402


def cannot_be_made(_):
    raise RuntimeError(f"{ROOT}/hull.obj: cannot read it\nmore")


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
print("a case runs, and its page says so; one that cannot be made does not agree")
