"""Surfaces between sites in space: exact answers, and the numbers of the tool."""

import json
import os
import subprocess
import tempfile
import types
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


class Surfaces(unittest.TestCase):
    def test_between_two_points(self):
        found = mv.site_voronoi([[[0.0, 0, 0]], [[2.0, 0, 0]]], resolution=16)
        self.assertGreaterEqual(len(found), 25)  # a section of 1 x 1 by voxels of 3 / 16
        np.testing.assert_allclose(found.points.positions[:, 0], 1, atol=1e-12)
        from_axis = np.hypot(found.points.positions[:, 1], found.points.positions[:, 2])
        np.testing.assert_allclose(found.points.distances, np.hypot(1, from_axis))
        np.testing.assert_allclose(found.points.object_angles, np.arctan2(1, from_axis))
        np.testing.assert_array_equal(found.points.contacts[:, :2], np.broadcast_to([[0, 0, 0], [2, 0, 0]], (len(found), 2, 3)))
        self.assertTrue(np.all(np.isnan(found.points.contacts[:, 2:])))
        np.testing.assert_array_equal(found.points.sites, np.tile([0, 1, -1, -1], (len(found), 1)))
        self.assertEqual((len(found.pieces), int(found.pieces.faces[0]), len(found.undecided)), (1, len(found.faces), 0))
        # Normals of faces lead from the first site to the second.
        a, b, c = (found.points.positions[found.faces.corners[:, k]] for k in (0, 1, 2))
        self.assertTrue(np.all(np.cross(b - a, c - a)[:, 0] > 0))

    def test_sites_of_every_kind(self):
        solid = mv.Mesh(*shapes.box((2, 2, 2)))
        plain = types.SimpleNamespace(vertices=shapes.box((2, 2, 2))[0], faces=shapes.box()[1])
        segment = mv.Site(segments=[[[3.0, -1, 0], [3.0, 1, 0]]])
        triangle = mv.Site(triangles=[[[0.0, 0, 3], [1.0, 0, 3], [0.0, 1, 3]]], points=[[0.0, 0, 4]])
        first, second = (mv.site_voronoi([mesh, segment, triangle], resolution=20) for mesh in (solid, plain))
        np.testing.assert_array_equal(first.points.positions, second.points.positions)
        self.assertEqual({tuple(pair) for pair in first.faces.sites.tolist()}, {(0, 1), (0, 2), (1, 2)})
        # In the middle between the side of the box at x = 1 and the segment at x = 3.
        near = np.abs(first.points.positions[:, 1:]).max(axis=1) < 0.5
        between = near & np.all(first.points.sites[:, :2] == [0, 1], axis=1)
        self.assertGreater(between.sum(), 4)
        x, _, z = first.points.positions[between].T
        np.testing.assert_allclose(x - 1, np.hypot(3 - x, z), atol=1e-9)
        distances = solid.closest_points(first.points.positions).distances
        of_solid = first.points.sites[:, 0] == 0
        np.testing.assert_allclose(distances[of_solid], first.points.distances[of_solid],
                                   atol=1e-12 + first.points.errors.max())

    def test_solids_that_overlap(self):
        found = mv.site_voronoi([mv.Mesh(*shapes.box()), mv.Mesh(*shapes.box(middle=(0.5, 0.2, 0.1)))], resolution=12)
        np.testing.assert_array_equal(found.overlaps, [[0, 1]])
        self.assertGreater(len(found.overlapping), 0)

    def test_roadmap(self):
        # A wall with a hole of 1 x 1 between two rooms; the wall is four boxes, which are sites of their own.
        walls = [((1, 4, 1.5), (0, 0, 1.25)), ((1, 4, 1.5), (0, 0, -1.25)), ((1, 1.5, 1), (0, 1.25, 0)), ((1, 1.5, 1), (0, -1.25, 0))]
        meshes = [mv.Mesh(*shapes.box(sides, middle)) for sides, middle in walls]
        found = mv.site_voronoi(meshes, resolution=24, margin=1.0)
        roadmap = found.roadmap()
        self.assertGreater(len(roadmap), 0)
        self.assertEqual(len(roadmap.component_of_point), len(found))
        path = roadmap.widest_path([-1.2, 0.1, 0.0], [1.2, 0.0, 0.1])
        self.assertTrue(0.45 < path.width <= 0.5)
        np.testing.assert_array_equal(path.line[[0, -1]], [[-1.2, 0.1, 0.0], [1.2, 0.0, 0.1]])
        on_graph = path.points >= 0
        np.testing.assert_array_equal(path.line[on_graph], found.points.positions[path.points[on_graph]])
        steps = np.linalg.norm(np.diff(path.line, axis=0), axis=1)
        self.assertAlmostEqual(path.length, steps.sum())
        for mesh in meshes:
            self.assertGreaterEqual(mesh.closest_points(path.line).distances.min(), path.width)
        for place in ([0, 0, 1.25], [np.nan, 0, 0]):
            with self.assertRaises(mv.errors.UsageError):
                roadmap.widest_path(place, [1.2, 0, 0])

    def test_threads_progress_and_errors(self):
        sites = [mv.Mesh(*shapes.torus()), [[0.0, 0, 0]]]
        calls = []
        one = mv.site_voronoi(sites, resolution=40, threads=1, progress=lambda stage, done: calls.append(stage))
        three = mv.site_voronoi(sites, resolution=40, threads=3)
        np.testing.assert_array_equal(one.points.positions, three.points.positions)
        self.assertEqual(set(calls), {"surface"})
        for bad, kind, message in (
            (sites[:1], mv.errors.InvalidMeshError, ""),
            ([sites[0], sites[0]], mv.errors.InvalidMeshError, ""),
            ([sites[0], mv.Site()], mv.errors.InvalidMeshError, ""),
            ([sites[0], [1.0, 2.0, 3.0]], mv.errors.UsageError, r"`points` has the shape \(3,\)"),
        ):
            with self.assertRaisesRegex(kind, message):
                mv.site_voronoi(bad, resolution=10)
        with self.assertRaisesRegex(mv.errors.UsageError, r"`segments` has the shape \(2, 3\)"):
            mv.Site(segments=[[0, 0, 0], [1, 1, 1]])
        with self.assertRaises(mv.errors.UsageError):
            mv.site_voronoi(sites, resolution=0)

    def test_plots(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        found = mv.site_voronoi([mv.Mesh(*shapes.box()), [[2.0, 0, 0]], [[0.0, 2, 0]]], resolution=12)
        axes = found.plot(alpha=0.8)
        axes.figure.canvas.draw()
        self.assertEqual(len(axes.collections), 1 + 3)  # the box, and three pairs
        plt.close(axes.figure)


@unittest.skipUnless(TOOL, "MEDIAL_VK_TOOL names no tool")
class AsTheTool(unittest.TestCase):
    def test_same_surface_and_roadmap(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder) / f"{i}.obj" for i in range(2)]
            meshes = shapes.torus(around=24, across=12), shapes.box((0.5, 0.5, 0.5), (0.1, 0, 0))
            for path, mesh in zip(paths, meshes):
                write_obj(path, *mesh)
            command = [TOOL, "voronoi", *map(str, paths), "--segment", "2,0,0,2,1,0", "--resolution", "30", "--quiet",
                       "-o", "v.npz", "--roadmap", "map.json", "--from=0,0,0.9", "--to=2.2,0.2,0"]
            subprocess.run(command, check=True, cwd=folder)
            sites = [*(mv.Mesh(*mesh) for mesh in meshes), mv.Site(segments=[[[2, 0, 0], [2, 1, 0]]])]
            found = mv.site_voronoi(sites, resolution=30)
            with np.load(Path(folder) / "v.npz") as arrays:
                for key, values in (
                    ("point", found.points.positions),
                    ("distance", found.points.distances),
                    ("error", found.points.errors),
                    ("object_angle", found.points.object_angles),
                    ("contacts", np.nan_to_num(found.points.contacts)),
                    ("sites", np.where(found.points.sites < 0, 2**32 - 1, found.points.sites)),
                    ("voxel", found.points.voxels),
                    ("faces", found.faces.corners),
                    ("face_sites", found.faces.sites),
                    ("face_piece", found.faces.pieces),
                    ("piece_area", found.pieces.areas),
                    ("piece_least_clearance", found.pieces.least_clearances),
                    ("undecided", found.undecided),
                    ("tied", found.tied),
                    ("grid_origin", found.grid.origin),
                    ("voxel_side", found.grid.voxel_size),
                    ("grid_size", found.grid.size),
                ):
                    np.testing.assert_array_equal(values, arrays[key], key)
            written = json.loads((Path(folder) / "map.json").read_text())
        roadmap = found.roadmap()
        np.testing.assert_array_equal(roadmap.points, [link["nodes"] for link in written["links"]])
        np.testing.assert_array_equal(roadmap.widths, [link["width"] for link in written["links"]])
        self.assertEqual(roadmap.components, written["components"])
        path = roadmap.widest_path([0, 0, 0.9], [2.2, 0.2, 0])
        self.assertEqual((path.width, path.length), (written["path"]["width"], written["path"]["length"]))
        np.testing.assert_array_equal(path.line, written["path"]["line"])


if __name__ == "__main__":
    unittest.main()
