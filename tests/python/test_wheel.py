"""The wheel: built without a network, audited, the same bytes twice, installed into a clean environment, used, removed;
and `pip install` of the source tree, editable, too.

    test_wheel.py SOURCE_DIR"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
PROGRAM = """
import medial_vk, numpy, pathlib, sys
assert pathlib.Path(medial_vk.__file__).is_relative_to(sys.prefix), medial_vk.__file__
vertices = numpy.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
found = medial_vk.analyse(medial_vk.Mesh(vertices, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]), resolution=12)
assert len(found) > 0 and found.certificate.rejected == 0
print(medial_vk.__version__)
"""


def run(*command, **options):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: exit code {result.returncode}\n{result.stdout}\n{result.stderr}")
    return result.stdout


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        cls.wheel = cls.build("first")
        # That of the system's NumPy: a wheel of it is not at hand without a network.
        run("/usr/bin/python3", "-m", "venv", "--system-site-packages", cls.folder / "venv")
        cls.python = cls.folder / "venv/bin/python"
        cls.environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        cls.environment["PIP_NO_INDEX"] = "1"

    @classmethod
    def build(cls, name):
        return Path(run(ROOT / "scripts/build-wheel", "-o", cls.folder / name).splitlines()[-1])

    def pip(self, *arguments):
        return run(self.python, "-m", "pip", "--disable-pip-version-check", *arguments, env=self.environment, cwd=self.folder)

    def test_content(self):
        self.assertRegex(self.wheel.name, r"^medial_vk-[\d.]+-cp\d+-cp\d+-manylinux_2_\d+_\w+\.whl$")
        with zipfile.ZipFile(self.wheel) as archive:
            names = archive.namelist()
            record = next(name for name in names if name.endswith(".dist-info/RECORD"))
            rows = [line.split(",") for line in archive.read(record).decode().splitlines()]
            self.assertEqual(sorted(row[0] for row in rows), sorted(names))
            for path, digest, size in rows:
                if path == record:
                    continue
                content = archive.read(path)
                self.assertEqual(len(content), int(size))
                found = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
                self.assertEqual(digest, f"sha256={found}")
            self.assertIn("medial_vk/py.typed", names)
            self.assertIn("medial_vk/_native.pyi", names)
            self.assertTrue(any(re.search(r"licenses/third_party/pybind11", name) for name in names))
            everything = b"".join(archive.read(name) for name in names)
        self.assertNotIn(str(ROOT).encode() + b"/", everything)

    def test_the_same_bytes_again(self):
        self.assertEqual(self.wheel.read_bytes(), self.build("second").read_bytes())

    def test_installed_used_and_removed(self):
        self.pip("install", self.wheel)
        check = subprocess.run([str(self.python), "-m", "pip", "check"], capture_output=True, text=True, env=self.environment)
        self.assertNotIn("medial", check.stdout)  # other packages of the system may lack something
        version = run(self.python, "-c", PROGRAM, env=self.environment, cwd=self.folder).strip()
        self.assertIn(f"-{version}-", self.wheel.name)
        self.pip("uninstall", "--yes", "medial-vk")
        left = [path for path in (self.folder / "venv/lib").rglob("*medial*")]
        self.assertEqual(left, [])

    def test_editable(self):
        """Sources of the tree are imported; a change of one counts at once, without another installation."""
        self.pip("install", "--editable", ROOT)
        where = "import medial_vk; from pathlib import Path; print(Path(medial_vk.__file__).resolve())"
        file = run(self.python, "-c", where, env=self.environment, cwd=self.folder).strip()
        self.assertEqual(Path(file), ROOT / "python/medial_vk/__init__.py")
        program = PROGRAM.replace("assert pathlib.Path(medial_vk.__file__).is_relative_to(sys.prefix), medial_vk.__file__", "")
        run(self.python, "-c", program, env=self.environment, cwd=self.folder)
        self.pip("uninstall", "--yes", "medial-vk")
        left = [path for path in (self.folder / "venv/lib").rglob("*medial*")]
        self.assertEqual(left, [])

    def test_source_tree(self):
        self.pip("install", ROOT)
        run(self.python, "-c", PROGRAM, env=self.environment, cwd=self.folder)
        self.pip("uninstall", "--yes", "medial-vk")


if __name__ == "__main__":
    unittest.main()
