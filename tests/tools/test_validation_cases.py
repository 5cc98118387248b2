#!/usr/bin/env python3
"""A case of the validation book still runs: its worlds, its page and its verdict, by the library as it is now."""
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ["FRAM_SOURCE"])

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
print("a case runs, and its page says so")
