#!/usr/bin/env python3
"""docs/python.md is what the docstrings of the package say."""

import subprocess
import sys

import package  # first: it finds the package `fram`

sys.exit(subprocess.run([sys.executable, package.SOURCE / "tools/python_reference.py", "--check"],
                        check=False).returncode)
