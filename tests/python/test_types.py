"""The types of the package, by mypy --strict: of its own sources, and of a program that uses it."""

import importlib.util
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

import medial_vk

PROGRAM = """
    import numpy as np
    from numpy.typing import NDArray

    import medial_vk as mv

    def radii(vertices: NDArray[np.float32], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
        mesh = mv.Mesh(vertices, triangles)
        found = mv.analyse(mesh, resolution=40, progress=lambda stage, done: print(stage, done))
        balls = mv.fit_spheres(mesh, 10)
        body = mv.Body(mesh, balls, (balls.centres, balls.radii))
        lower = mv.distance_bounds(body, body, np.eye(4)[None]).lower
        assert found.sheets is not None
        return np.concatenate([found.spheres.radii, lower, found.sheets.significance])
"""
WRONG = """
    import medial_vk as mv

    mv.analyse(mv.read_mesh("a.obj"), resolution="high")
"""


@unittest.skipUnless(importlib.util.find_spec("mypy"), "no mypy")
class Types(unittest.TestCase):
    def check(self, *arguments):
        command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", self.cache, *arguments]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.folder)

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder, cls.cache = holder.name, holder.name + "/cache"

    def test_the_package(self):
        result = self.check(str(Path(medial_vk.__file__).parent))
        self.assertEqual(result.stdout, "")

    def test_a_program(self):
        for text, is_right in ((PROGRAM, True), (WRONG, False)):
            path = Path(self.folder) / "program.py"
            path.write_text(textwrap.dedent(text))
            result = self.check(str(path))
            self.assertEqual(result.returncode == 0, is_right, result.stdout + result.stderr)
            if not is_right:
                self.assertIn("resolution", result.stdout)


if __name__ == "__main__":
    unittest.main()
