#!/usr/bin/env python3
"""No allocation that fails is hidden: the command says so, or leaves the same files as without it.

The campaign of faults draws its failures; here stand places where some were once hidden, and the calls around them.
"""

import os
import pathlib
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/torture"))
import part_faults  # noqa: E402
import torture  # noqa: E402

if os.environ.get("FRAM_TEST_SANITIZE"):
    print("skipped: a sanitizer has allocations of its own")
    sys.exit(77)


class FailingMemory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="fram-memory-test-")))
        options = types.SimpleNamespace(fram=os.environ["FRAM"], shrink=0, minutes=1, out=cls.folder, soak_hours=0)
        cls.rig = torture.Rig(options)
        cls.addClassCleanup(cls.rig.clear, cls.rig.work)

    def hold(self, words, tried):
        """These allocations, which count from the end where they are negative."""
        calls, _, _ = part_faults.plain(self.rig, words, "memory", self.folder / "plain")
        for at in tried:
            at = at if at > 0 else calls + at
            _, hit, fault, note = part_faults.inject(self.rig, words, "memory", at, False, self.folder)
            self.assertIsNotNone(hit, note)
            self.assertIsNone(fault, note)

    def test_page_of_a_study(self):
        self.hold("study study.yaml -o studied --jobs 1", range(-250, 0, 6))

    def test_first_words(self):
        """A command that has no memory for what it asks with says so."""
        self.hold("extremes tension.csv --channel tension", range(1, 7))


if __name__ == "__main__":
    unittest.main()
