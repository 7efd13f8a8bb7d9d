"""Medial spheres, fits and measures have the numbers and bytes of the tool."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import shapes

import medial_vk as mv

TOOL = os.environ.get("MEDIAL_VK_TOOL", "")


def write_obj(path, vertices, triangles):
    lines = [f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles.tolist()]
    path.write_text("".join(lines))


def report_of(page):
    """The report in a page."""
    text = page.html.decode().split('<script type="application/json" id="report">')[1].split("</script>")[0]
    return json.loads(text)


@unittest.skipUnless(TOOL, "MEDIAL_VK_TOOL names no tool")
class AsTheTool(unittest.TestCase):
    def test_same_bytes(self):
        vertices, triangles = shapes.torus()
        for options, arguments in (
            ({}, []),
            ({"mode": "thesis"}, ["--mode", "thesis"]),
            ({"object_angle": 0.8, "radius": 0.02}, ["--object-angle", "0.8", "--radius", "0.02"]),
            ({"simplify": True, "sheet_angle": 8.0}, ["--simplify", "--sheet-angle", "8"]),
        ):
            with self.subTest(options), tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "torus.obj"
                write_obj(path, vertices, triangles)
                for name in ("tool.ply", "tool.csv"):
                    command = [TOOL, str(path), "--resolution", "40", "--quiet", "-o", str(path.with_name(name)), *arguments]
                    subprocess.run(command, check=True)
                found = mv.analyse(mv.Mesh(vertices, triangles), resolution=40, **options)
                subprocess.run([TOOL, str(path), "--resolution", "40", "--quiet", "-o", str(path.with_name("tool.npz")), *arguments],
                               check=True)
                found.save(path.with_name("own.npz"))
                with np.load(path.with_name("own.npz")) as own, np.load(path.with_name("tool.npz")) as tool:
                    self.assertEqual(set(own), set(tool))
                    for name in own:
                        np.testing.assert_array_equal(own[name], tool[name], name)
                for name in ("own.ply", "own.csv"):
                    found.save(path.with_name(name))
                    tool = path.with_name(name.replace("own", "tool"))
                    self.assertEqual(path.with_name(name).read_bytes(), tool.read_bytes(), name)

    def test_same_bytes_outside(self):
        vertices, triangles = shapes.torus()
        outside = mv.analyse(mv.Mesh(vertices, triangles).on_side("outside", margin=0.5), resolution=30)
        self.assertEqual(outside.side, "outside")
        self.assertGreater(len(outside), 0)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "torus.obj"
            write_obj(path, vertices, triangles)
            for extension in ("ply", "csv", "npz"):
                tool, own = (path.with_name(f"{name}.{extension}") for name in ("tool", "own"))
                subprocess.run([TOOL, str(path), "--resolution", "30", "--side", "outside", "--margin", "0.5", "--quiet",
                                "-o", str(tool)], check=True)
                outside.save(own)
                if extension == "npz":
                    with np.load(own) as mine, np.load(tool) as theirs:
                        self.assertEqual(set(mine), set(theirs))
                        for name in mine:
                            np.testing.assert_array_equal(mine[name], theirs[name], name)
                else:
                    self.assertEqual(own.read_bytes(), tool.read_bytes())

    def test_same_fatness(self):
        """Of the report, and of the page, which has the report in it."""
        vertices, triangles = shapes.torus()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "torus.obj"
            write_obj(path, vertices, triangles)
            report = path.with_name("report.json")
            subprocess.run([TOOL, str(path), "--resolution", "30", "--quiet", "--report", str(report), "-o", str(path) + ".ply"],
                           check=True)
            expected = json.loads(report.read_text())["fatness"]["angles"]
        found = mv.analyse(mv.Mesh(vertices, triangles), resolution=30, volumes=True)
        fatness = found.fatness([angle["object_angle"] for angle in expected])
        for field, key in (("spheres", "points"), ("least_radii", "least_radius"), ("largest_voxels", "largest_voxel"),
                           ("components", "components"), ("proves_connected", "proves_connected")):
            np.testing.assert_array_equal(getattr(fatness, field), [angle[key] for angle in expected])
        try:
            page = found.page()
        except mv.errors.UsageError as error:
            self.skipTest(str(error))
        self.assertEqual(report_of(page)["fatness"]["angles"], expected)

    def test_same_histograms(self):
        vertices, triangles = shapes.grid((1, 0.8, 0.2), 3)
        mesh = mv.Mesh(vertices, triangles)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "plate.obj"
            write_obj(path, vertices, triangles)
            subprocess.run([TOOL, str(path), "--resolution", "10", "--quiet", "--thickness-histogram", "thickness.csv", "-o", "plate.ply"],
                           check=True, cwd=folder)
            subprocess.run([TOOL, "spheres", str(path), "--count", "8", "--quiet", "--histogram", "fit.csv", "-o", "spheres.csv"],
                           check=True, cwd=folder)
            thickness = np.loadtxt(Path(folder) / "thickness.csv", delimiter=",", skiprows=1)
            rows = [line.split(",") for line in (Path(folder) / "fit.csv").read_text().splitlines()[1:]]
        found = mv.thickness(mesh, mesh.sample(10_000)).histogram()
        np.testing.assert_array_equal(thickness[:, 2:], np.column_stack([found.by_lower_ends, found.by_upper_ends]))
        np.testing.assert_allclose(thickness[:, 1], found.edges[1:], rtol=1e-14)
        self.assertAlmostEqual(found.by_lower_ends.sum(), 1)
        measures = mv.fit_spheres(mesh, 8).measures
        for name, histogram in (("boundary", measures.boundary_to_envelope), ("envelope", measures.envelope_to_boundary)):
            np.testing.assert_array_equal(histogram.shares, [float(row[3]) for row in rows if row[0] == name])
            self.assertTrue(histogram.lower <= histogram.least <= histogram.mean <= histogram.greatest <= histogram.upper)

    def test_same_spheres(self):
        vertices, triangles = shapes.torus()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "torus.obj"
            write_obj(path, vertices, triangles)
            out = path.with_suffix(".csv")
            subprocess.run([TOOL, "spheres", str(path), "--count", "16", "--quiet", "-o", str(out)], check=True)
            rows = [line.split(",") for line in out.read_text().splitlines()[1:]]
        fit = mv.fit_spheres(mv.Mesh(vertices, triangles), 16)
        table = np.array([[float(x) for x in row[:4]] for row in rows])
        np.testing.assert_array_equal(table, np.column_stack([fit.centres, fit.radii]))


if __name__ == "__main__":
    unittest.main()
