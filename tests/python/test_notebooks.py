#!/usr/bin/env python3
"""The notebooks of bindings/python run from top to bottom: their cells, one after the other, in a plain Python."""

import json
import os
import sys
import tempfile

import package  # first: it finds the package `fram`


def play(path):
    """Run the cells of a notebook; an exception tells the cell."""
    with open(path, encoding="utf-8") as file:
        notebook = json.load(file)
    assert notebook["nbformat"] == 4, path
    names, played = {"__name__": "__main__"}, 0
    for number, cell in enumerate(notebook["cells"], start=1):
        if cell["cell_type"] != "code":
            continue
        assert not cell["outputs"], f"{path.name}: cell {number} holds an output"
        exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), names)
        played += 1
    print(f"{path.name}: {played} cells")
    return played


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.environ["TMPDIR"] = tempfile.tempdir = folder
        notebooks = sorted((package.SOURCE / "bindings/python/notebooks").glob("*.ipynb"))
        assert len(notebooks) == 4, notebooks
        for path in notebooks:
            assert play(path) >= 3
    return 0


sys.exit(main())
