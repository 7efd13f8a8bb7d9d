"""Meshes from arrays of every type, and from objects of other packages."""

import concurrent.futures
import copy
import multiprocessing
import pickle
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

import numpy as np
import shapes

import medial_vk as mv


def radii_of(mesh):
    """Of its medial spheres."""
    return mv.analyse(mesh, resolution=20).spheres.radii


class Arrays(unittest.TestCase):
    def setUp(self):
        self.vertices, self.triangles = shapes.torus()
        self.expected = mv.Mesh(self.vertices, self.triangles)

    def assert_same(self, mesh, vertices=None):
        np.testing.assert_array_equal(mesh.vertices, self.expected.vertices if vertices is None else vertices)
        np.testing.assert_array_equal(mesh.triangles, self.expected.triangles)

    def test_types_of_indices(self):
        for name in ("int32", "int64", "uint32", "uint64", "int16", "uint16"):
            self.assert_same(mv.Mesh(self.vertices, self.triangles.astype(name)))

    def test_types_of_coordinates(self):
        single = self.vertices.astype(np.float32)
        self.assert_same(mv.Mesh(single, self.triangles), single.astype(np.float64))
        half = (64 * self.vertices).astype(np.int32)
        self.assert_same(mv.Mesh(half, self.triangles), half.astype(np.float64))

    def test_layouts(self):
        wide = np.zeros((len(self.vertices), 7))
        wide[:, 1:6:2] = self.vertices
        turned = np.asfortranarray(self.triangles)
        self.assert_same(mv.Mesh(wide[:, 1:6:2], turned))
        self.assert_same(mv.Mesh(self.vertices[::-1][::-1], self.triangles))
        packed = np.zeros(len(self.vertices), dtype=np.dtype([("tag", "u1"), ("at", "f8", 3)]))
        packed["at"] = self.vertices
        self.assert_same(mv.Mesh(packed["at"], self.triangles))  # not aligned
        self.assert_same(mv.Mesh(self.vertices.astype(">f8"), self.triangles.astype(">i4")))
        self.assert_same(mv.Mesh(self.vertices.tolist(), self.triangles.tolist()))

    def test_the_mesh_has_its_own_copy(self):
        vertices, triangles = self.vertices.copy(), self.triangles.copy()
        mesh = mv.Mesh(vertices, triangles)
        vertices[:] = 0
        triangles[:] = 0
        self.assert_same(mesh)

    def test_views_live_longer_than_the_mesh_and_cannot_be_written_to(self):
        mesh = mv.Mesh(self.vertices, self.triangles)
        view, copy = mesh.vertices, mesh.vertices.copy()
        del mesh
        np.testing.assert_array_equal(view, copy)
        with self.assertRaises(ValueError):
            view[0] = 1

    def test_maps_to_the_input(self):
        doubled = np.concatenate([self.vertices, self.vertices[:1], [[9.0, 9.0, 9.0]]])
        mesh = mv.Mesh(doubled, self.triangles)
        self.assertEqual(mesh.report.merged_vertices, 1)
        self.assertEqual(mesh.report.unused_vertices, 1)
        self.assertEqual(mesh.vertex_of_input[-1], -1)
        self.assertEqual(mesh.vertex_of_input[-2], mesh.vertex_of_input[0])
        np.testing.assert_array_equal(mesh.triangle_of_input, np.arange(len(self.triangles)))


class OtherPackages(unittest.TestCase):
    """Shaped as their meshes are; none of the packages is required."""

    def setUp(self):
        self.vertices, self.triangles = shapes.box()

    def test_trimesh(self):
        mesh = types.SimpleNamespace(vertices=self.vertices, faces=self.triangles)
        self.assertEqual(len(mv.Mesh(mesh).triangles), 12)

    def test_open3d(self):
        class Vectors:  # has no shape of its own
            def __init__(self, rows):
                self.rows = rows

            def __len__(self):
                return len(self.rows)

            def __getitem__(self, i):
                return self.rows[i]

        mesh = types.SimpleNamespace(vertices=Vectors(self.vertices), triangles=Vectors(self.triangles.astype(np.int32)))
        self.assertEqual(len(mv.Mesh(mesh).triangles), 12)

    def test_pyvista(self):
        faces = np.column_stack([np.full(12, 3), self.triangles]).ravel()
        self.assertEqual(len(mv.Mesh(types.SimpleNamespace(points=self.vertices, faces=faces)).triangles), 12)
        quads = np.array([4, 0, 1, 2, 3])
        with self.assertRaisesRegex(mv.errors.UsageError, "triangulate"):
            mv.Mesh(types.SimpleNamespace(points=self.vertices, faces=quads))

    def test_every_call_takes_them(self):
        mesh = types.SimpleNamespace(vertices=self.vertices, faces=self.triangles)
        self.assertGreater(len(mv.analyse(mesh, resolution=12)), 0)


class Errors(unittest.TestCase):
    def test_messages_name_the_fault(self):
        vertices, triangles = shapes.box()
        cases = [
            ((vertices[:, :2], triangles), mv.errors.UsageError, r"`vertices` has the shape \(8, 2\)"),
            ((vertices, triangles[0]), mv.errors.UsageError, r"`triangles` has the shape \(3,\)"),
            ((vertices, triangles - 1), mv.errors.UsageError, "row 0 of `triangles` has the value -1"),
            ((vertices, triangles + 2**33), mv.errors.UsageError, "is no index"),
            ((vertices, triangles * 1.5), mv.errors.UsageError, "not one of integers"),
            ((vertices + 1j, triangles), mv.errors.UsageError, "not one of real numbers"),
            ((np.array([["a"] * 3]), triangles), mv.errors.UsageError, "not one of real numbers"),
            ((vertices, triangles + 1), mv.errors.InvalidMeshError, "vertex 8 of 8"),
            ((vertices * np.nan, triangles), mv.errors.InvalidMeshError, "coordinate nan"),
            (([], []), mv.errors.InvalidMeshError, ""),
            ((object(), triangles), mv.errors.UsageError, "`vertices`"),
        ]
        for arguments, kind, message in cases:
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                mv.Mesh(*arguments)
        with self.assertRaisesRegex(mv.errors.UsageError, "str has no vertices"):
            mv.Mesh("part.stl")

    def test_kinds_are_those_of_python_too(self):
        self.assertTrue(issubclass(mv.errors.UsageError, ValueError))
        self.assertTrue(issubclass(mv.errors.OutOfMemoryError, MemoryError))
        for kind in ("UsageError", "InvalidMeshError", "NoDeviceError", "OutOfMemoryError", "InternalError"):
            self.assertTrue(issubclass(getattr(mv.errors, kind), mv.errors.Error))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "größe.obj"
            vertices, triangles = shapes.box()
            lines = [f"v {x} {y} {z}\n" for x, y, z in vertices]
            lines += [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles]
            path.write_text("".join(lines))
            self.assertEqual(len(mv.read_mesh(path).triangles), 12)
            with self.assertRaisesRegex(mv.errors.InvalidMeshError, "none.obj"):
                mv.read_mesh(Path(folder) / "none.obj")


    def test_exceptions_of_an_object_arrive(self):
        class Strange:
            def __array__(self, *_args, **_keywords):
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            mv.Mesh(Strange(), [[0, 1, 2]])


class Queries(unittest.TestCase):
    def test_closest_points_and_depths_of_a_box(self):
        mesh = mv.Mesh(*shapes.box((2, 2, 2)))
        points = [[0.0, 0.0, 0.7], [3.0, 0.5, 0.5]]
        closest = mesh.closest_points(points)
        np.testing.assert_allclose(closest.points, [[0, 0, 1], [1, 0.5, 0.5]], atol=1e-15)
        np.testing.assert_allclose(closest.distances, [0.3, 2.0], atol=1e-15)
        depths = mesh.depths(points)
        self.assertTrue(np.all(depths <= [0.3, -2.0]))
        np.testing.assert_allclose(depths, [0.3, -2.0], atol=1e-12)

    def test_samples_of_the_area(self):
        mesh = mv.Mesh(*shapes.box((1, 2, 4)))
        points = mesh.sample(2800)
        self.assertLess(mesh.closest_points(points).distances.max(), 1e-15)
        # The sides have areas of 8, 4 and 2, each twice; in a triangle, samples are as many as its share to within one.
        for axis, (half, area) in enumerate(((0.5, 8), (1, 4), (2, 2))):
            on_side = np.count_nonzero(np.abs(np.abs(points[:, axis]) - half) < 1e-12)
            self.assertLessEqual(abs(on_side - 2800 * 2 * area / 28), 4)
        np.testing.assert_array_equal(points, mesh.sample(2800))
        self.assertEqual(mesh.sample(0).shape, (0, 3))

    def test_moved(self):
        mesh = mv.Mesh(*shapes.box())
        moved = mesh.moved(mesh.vertices + 1)
        np.testing.assert_array_equal(moved.vertices, mesh.vertices + 1)
        self.assertAlmostEqual(mesh.closest_points([[2.0, 0, 0]]).distances[0], 1.5)
        with self.assertRaises(mv.errors.InvalidMeshError):
            mesh.moved(mesh.vertices[:-1])

    def test_sides(self):
        mesh = mv.Mesh(*shapes.box())
        outside = mesh.on_side("outside", margin=0.25)
        self.assertEqual((mesh.side, outside.side), ("inside", "outside"))
        self.assertGreater(outside.longest_side, 1.5 - 1e-9)
        with self.assertRaisesRegex(mv.errors.UsageError, "inside, outside"):
            mesh.on_side("above")


class Pickling(unittest.TestCase):
    """A mesh is the same after it, for every call."""

    def assert_same(self, mesh, other):
        for name in ("vertices", "triangles", "vertex_of_input", "triangle_of_input"):
            np.testing.assert_array_equal(getattr(mesh, name), getattr(other, name), name)
        for name in mv.MeshReport._fields:
            np.testing.assert_array_equal(getattr(mesh.report, name), getattr(other.report, name), name)
        self.assertEqual((mesh.side, mesh.longest_side), (other.side, other.longest_side))
        one, two = (mv.analyse(m, resolution=14) for m in (mesh, other))
        self.assertGreater(len(one), 0)
        for name in ("centres", "radii", "flux", "sheets"):
            np.testing.assert_array_equal(getattr(one.spheres, name), getattr(two.spheres, name))

    def test_meshes(self):
        vertices, triangles = shapes.torus(around=20, across=10)
        two_boxes = [np.concatenate(parts) for parts in ((shapes.box()[0], shapes.box(middle=(0.4, 0.3, 0.2))[0]),
                                                         (shapes.box()[1], shapes.box()[1] + 8))]
        torus = mv.Mesh(vertices, triangles)
        open_box = mv.Mesh(shapes.box()[0], shapes.box()[1][2:])
        for name, mesh in (
            ("closed", torus),
            ("turned over, with unused vertices", mv.Mesh(np.concatenate([vertices, vertices[:2] + 9]), triangles[:, ::-1])),
            ("cut", mv.Mesh(*two_boxes)),
            ("open", open_box),
            ("outside", torus.on_side("outside", margin=0.3)),
            ("outside of an open mesh", open_box.on_side("outside")),
            ("inside of a box", torus.on_side("inside", margin=0.1)),
        ):
            with self.subTest(name):
                self.assert_same(mesh, pickle.loads(pickle.dumps(mesh)))
        self.assertGreater(mv.Mesh(*two_boxes).report.cut_faces, 0)

    def test_a_moved_mesh(self):
        mesh = mv.Mesh(*shapes.torus()).on_side("outside").moved(2 * mv.Mesh(*shapes.torus()).vertices)
        other = pickle.loads(pickle.dumps(mesh))
        np.testing.assert_array_equal(mesh.vertices, other.vertices)
        self.assertEqual(mesh.longest_side, other.longest_side)
        self.assertEqual(mesh.moved(mesh.vertices * 3).longest_side, other.moved(mesh.vertices * 3).longest_side)
        points = np.random.default_rng(1).normal(size=(50, 3))
        # The trees differ, and with them which of equally near triangles is taken.
        near, other_near = (m.closest_points(points).distances for m in (mesh, other))
        np.testing.assert_allclose(near, other_near, rtol=1e-14)

    def test_copies_are_the_mesh_itself(self):
        mesh = mv.Mesh(*shapes.box())
        self.assertIs(copy.copy(mesh), mesh)
        self.assertIs(copy.deepcopy([mesh])[0], mesh)

    def test_bodies(self):
        mesh = mv.Mesh(*shapes.box())
        balls = [[0.0, 0, 0, 0.5]], [[0.0, 0, 0, 1.0]]
        poses = np.stack([shapes.pose((x, 0.2, 0), x) for x in (0.5, 1.5, 4.0)])
        for body in (mv.Body(mesh, *balls), mv.Body(None, *balls)):
            other = pickle.loads(pickle.dumps(body))
            self.assertEqual(repr(body), repr(other))
            np.testing.assert_array_equal(mv.distance_bounds(body, body, poses).lower, mv.distance_bounds(other, other, poses).lower)
            if body.has_mesh:
                np.testing.assert_array_equal(mv.distances(body, body, poses).upper, mv.distances(other, body, poses).upper)

    def test_other_processes(self):
        mesh = mv.Mesh(*shapes.torus())
        with concurrent.futures.ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
            radii = pool.submit(radii_of, mesh).result(timeout=120)
        np.testing.assert_array_equal(radii, radii_of(mesh))

    def test_a_state_of_something_else(self):
        from medial_vk import _mesh

        state = mv.Mesh(*shapes.box())._native.state()
        for change in ({"triangles": state["triangles"] + 5}, {"flags": state["flags"][1:]}, {"report_closed": "x"}, {"vertices": None}):
            with self.assertRaises(mv.errors.Error):
                _mesh._restored({**state, **change})
        for name in state:
            with self.assertRaises(mv.errors.Error):
                _mesh._restored({key: value for key, value in state.items() if key != name})


class Import(unittest.TestCase):
    def test_import_takes_no_other_package_along(self):
        script = "import sys, medial_vk; print(any(n in sys.modules for n in ('numpy', 'matplotlib', 'tqdm')))"
        out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(out.stdout.strip(), "False")

    def test_all_names_are_there_and_documented(self):
        for name in mv.__all__:
            value = getattr(mv, name)
            if callable(value):
                self.assertTrue((value.__doc__ or "").strip(), name)


if __name__ == "__main__":
    unittest.main()
