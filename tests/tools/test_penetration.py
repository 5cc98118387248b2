#!/usr/bin/env python3
"""bench/penetration.py: overlaps of placed and turned floes, of walls, and none where there is none."""

import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import penetration  # noqa: E402

SQUARE = "floe 1 910 0 0 4 -1 -1 1 -1 1 1 -1 1\n"


class Penetration(unittest.TestCase):
    def measure(self, poses, domain="-100 -100 100 100"):
        """poses: (x, y, yaw) or (x, y, yaw, z) of squares of 2 m, 1 m thick."""
        with tempfile.TemporaryDirectory() as folder:
            scene, file = pathlib.Path(folder, "a.scene"), pathlib.Path(folder, "a.csv")
            scene.write_text("icescene 1\ndomain " + domain + "\n" + SQUARE * len(poses))
            lines = ["id,x,y,z,qx,qy,qz,qw,tilt_deg"]
            for i, (x, y, yaw, *z) in enumerate(poses):
                lines.append(f"{i},{x},{y},{z[0] if z else 0},0,0,{math.sin(yaw / 2)!r},{math.cos(yaw / 2)!r},0")
            file.write_text("\n".join(lines) + "\n")
            return penetration.measure(scene, file)

    def test_squares_side_by_side(self):
        found = self.measure([(0, 0, 0), (1.9, 0.3, 0), (10, 0, 0), (12.01, 0, 0)])
        self.assertEqual(found["pairs"], 1)
        self.assertAlmostEqual(found["max_m"], 0.1, 12)
        self.assertAlmostEqual(found["sum_per_floe_m"], 0.1 / 4, 12)

    def test_a_corner_into_a_side(self):
        found = self.measure([(0, 0, 0), (1 + math.sqrt(2) - 0.05, 0, math.pi / 4)])
        self.assertEqual(found["pairs"], 1)
        self.assertAlmostEqual(found["mean_m"], 0.05, 9)

    def test_corners_that_pass(self):
        reach = 2 * math.sqrt(2)
        self.assertEqual(self.measure([(0, 0, math.pi / 4), (reach - 0.2, 0.9, math.pi / 4)])["pairs"], 0)

    def test_rafted_floes(self):
        self.assertEqual(self.measure([(0, 0, 0), (1, 0, 0, -1.01)])["pairs"], 0)
        self.assertAlmostEqual(self.measure([(0, 0, 0), (1, 0, 0, -0.97)])["max_m"], 0.03, 12)

    def test_walls(self):
        found = self.measure([(0, 0, 0)], "-0.75 -5 5 5")
        self.assertEqual(found["pairs"], 1)
        self.assertAlmostEqual(found["max_m"], 0.25, 12)

    def test_nothing_overlaps(self):
        self.assertEqual(self.measure([(0, 0, 0), (2, 0, 0)])["pairs"], 0)


if __name__ == "__main__":
    unittest.main(verbosity=0)
