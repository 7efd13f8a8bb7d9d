"""Runs the Python of README.md and docs/python.md, in the order of the page, in one namespace for each page."""

import contextlib
import io
import os
import re
import runpy
import tempfile
import unittest
from pathlib import Path

import numpy as np
import shapes

ROOT = Path(__file__).resolve().parents[2]


def write_part(path):
    """An ASCII STL of a plate of 24 x 16 x 4 with a smaller block on it."""
    vertices, triangles = runpy.run_path(str(ROOT / "examples" / "python" / "boxes.py"))["solid_of_boxes"](
        [(0, 0, 0, 24, 16, 4), (4, 4, 4, 14, 12, 12)], size=4)
    lines = ["solid part"]
    for corners in vertices[triangles]:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{x:.9g}" for x in corner) for corner in corners]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid part", ""]))


class Documents(unittest.TestCase):
    def setUp(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        before, folder = os.getcwd(), tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)
        os.chdir(folder.name)
        write_part(Path("part.stl"))

    def run_page(self, name, least):
        """Runs the snippets of a page; returns what they printed."""
        text = (ROOT / name).read_text()
        snippets = list(re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
        self.assertGreaterEqual(len(snippets), least, name)
        names, printed = {"__name__": "snippets"}, io.StringIO()
        for snippet in snippets:
            line = text[: snippet.start()].count("\n") + 1
            with self.subTest(f"{name}, line {line}"), contextlib.redirect_stdout(printed):
                # The lines of the page, so that an error shows where it is.
                exec(compile("\n" * line + snippet.group(1), name, "exec"), names)
        return names, printed.getvalue()

    def test_manual(self):
        names, printed = self.run_page("docs/python.md", 15)
        self.assertTrue(Path("part.medial.ply").read_bytes().startswith(b"ply\n"))
        self.assertEqual(len(np.loadtxt("part.spheres.csv", delimiter=",")), 48)
        self.assertTrue(Path("part.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("['free', 'hit']", printed)
        self.assertIn("resolution", printed)  # the message of the error that is shown
        self.assertAlmostEqual(names["least"].upper, 4, delta=0.05)  # the plate
        self.assertTrue(names["inside"].measures.inside.proved)
        # A tree with an end in each of the five convex corners, and three branches at each junction.
        self.assertEqual((names["axis"].junctions, len(names["axis"].branches)), (3, 7))
        self.assertAlmostEqual(names["path"].width, 1, places=3)  # half the gap between both shapes

    def test_readme(self):
        _, printed = self.run_page("README.md", 1)
        self.assertRegex(printed, r"^\d+ medial spheres in \d+ sheets\n")


if __name__ == "__main__":
    unittest.main()
