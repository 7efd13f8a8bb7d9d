"""The scripts of examples/python: each runs, and what it prints and writes holds."""

import csv
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import medial_vk as mv

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


class Examples(unittest.TestCase):
    def setUp(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("no matplotlib")
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_example(self, name, *arguments):
        """The output of an example that has written its picture."""
        command = [sys.executable, EXAMPLES / f"{name}.py", *map(str, arguments), "--out", self.folder]
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "Agg"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        picture = (self.folder / f"{name}.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", picture[16:24])
        self.assertTrue(800 <= width <= 1300 and 350 <= height <= 700, (width, height))
        return done.stdout

    def test_thickness(self):
        """The floor of the bracket's pocket is 1.2 mm thick, 16 x 24 mm large, and a wall on both of its sides."""
        text = self.run_example("thickness")
        lower, upper = map(float, re.search(r"thinnest wall: (\S+) to (\S+),", text).groups())
        self.assertTrue(1.188 <= lower <= 1.2 <= upper <= 1.212, text)  # the default width of an interval is 1 %
        walls, triangles = map(int, re.search(r"(\d+) of (\d+) triangles in walls", text).groups())
        self.assertTrue(0.5 * triangles < walls < triangles, text)
        self.assertGreater(float(re.search(r"thinner than \S+: (\S+)%", text).group(1)), 5, text)

    def test_sheets(self):
        """The seat is 4 thick, the sides are 3 thick and equally large."""
        text = self.run_example("sheets", "--resolution", 60)
        found = re.findall(r"sheet (\d+): +(\S+)%, thickness (\S+)", text)
        self.assertGreaterEqual(len(found), 4, text)
        thickness = [float(row[2]) for row in found]
        self.assertAlmostEqual(thickness[0], 4, delta=0.05)
        self.assertLess(abs(thickness[2] - 3) + abs(thickness[3] - 3), 0.05)
        self.assertAlmostEqual(float(found[2][1]), float(found[3][1]), delta=1.0)
        with np.load(self.folder / "sheets.npz") as arrays:
            self.assertEqual(int(re.match(r"(\d+) spheres", text).group(1)), len(arrays["sheet"]))

    def test_spheres_inside_an_arm(self):
        text = self.run_example("robot_spheres", "--contract", "inside", "--count", 12)
        self.assertEqual(len(re.findall(r"\d+ balls, inside proved, ", text)), 7, text)
        self.check_spheres("elbow", "inside")

    def test_spheres_that_cover_a_link(self):
        maker = EXAMPLES.parent / "robot_arm" / "make_arm.py"
        subprocess.run([sys.executable, maker, self.folder], check=True)
        robot = self.folder / "robot_arm" / "elbow.urdf"
        robot.write_text('<robot name="one"><link name="elbow"><visual><geometry><mesh filename="meshes/elbow.obj"/>'
                         "</geometry></visual></link></robot>")
        text = self.run_example("robot_spheres", robot, "--count", 8)
        self.assertRegex(text, r"^elbow +\d+ balls, cover proved, ")
        self.check_spheres("elbow", "cover")

    def check_spheres(self, link, contract):
        """The balls of the file have the contract."""
        text = (self.folder / "robot_spheres.yml").read_text()
        part = re.search(rf"^  {link}:\n((?:    .*\n)+)", text, re.MULTILINE).group(1)
        rows = np.array([[float(x) for x in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", ball)] for ball in part.split("- center:")[1:]])
        self.assertEqual(rows.shape[1], 4)
        mesh = mv.read_mesh(self.folder / "robot_arm" / "meshes" / f"{link}.obj")
        self.assertTrue(getattr(mv.prove_spheres(mesh, rows, rows), contract).proved)

    def test_distance_over_a_path(self):
        text = self.run_example("distance_path")
        free, verdict, contact = re.match(r"free until (\S+), (\w+) at (\S+)", text).groups()
        self.assertEqual(verdict, "hit")
        self.assertLessEqual(float(free), float(contact))
        self.assertLess(float(contact) - float(free), 1e-4)
        with open(self.folder / "distance_path.csv", newline="") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        for row in rows:  # both intervals contain the distance
            self.assertLessEqual(row["lower_by_balls"], row["upper"])
            self.assertLessEqual(row["lower"], row["upper_by_balls"])
        self.assertTrue(all(row["lower"] > 0 for row in rows if row["time"] < float(free) - 1e-6))
        self.assertTrue(any(row["upper"] == 0 for row in rows if row["time"] > float(contact)))

    def test_character(self):
        text = self.run_example("character", "--frames", 8)
        self.assertIn("8 of 8 frames proved", text)
        least, most = map(float, re.search(r"fill (\S+)% to (\S+)%", text).groups())
        self.assertTrue(80 < least <= most < 100, text)  # of the rest pose, 128 balls fill nine tenths
        with np.load(self.folder / "character.npz") as arrays:
            self.assertEqual(arrays["centre"].shape[::2], (8, 3))
            self.assertEqual(arrays["radius"].shape, arrays["centre"].shape[:2])


if __name__ == "__main__":
    unittest.main()
