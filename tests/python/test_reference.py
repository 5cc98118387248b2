#!/usr/bin/env python3
"""docs/python.md is what the docstrings of the package say, with types and defaults as a program writes them."""

import subprocess
import sys

import package  # first: it finds the package `fram`

page = (package.SOURCE / "docs/python.md").read_text()
for text in ("columns(self, table: str = 'series') -> dict[str, np.ndarray]", "fram.Channel(index: int, name: str,"):
    if text not in page:
        sys.exit(f"docs/python.md lacks {text}")
sys.exit(subprocess.run([sys.executable, package.SOURCE / "tools/python_reference.py", "--check"],
                        check=False).returncode)
