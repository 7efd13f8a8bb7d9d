"""Shapes in the plane: exact answers, and the numbers of the tool."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import medial_vk as mv

TOOL = os.environ.get("MEDIAL_VK_TOOL", "")
BOX = np.array([[0.0, 0], [4, 0], [4, 1], [0, 1]])


def star(spikes, turn=0.3):
    """A polygon with `spikes` convex and as many reflex corners."""
    angles = turn + np.pi * np.arange(2 * spikes) / spikes
    radii = np.where(np.arange(2 * spikes) % 2 == 0, 5.0, 2.3)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def distance_to(points, segments, p):
    """From each of `p` to the nearest of the segments, by brute force."""
    a, b = points[segments[:, 0]], points[segments[:, 1]]
    along = b - a
    t = np.clip(((p[:, None] - a) * along).sum(-1) / (along * along).sum(-1), 0, 1)
    return np.linalg.norm(a + t[..., None] * along - p[:, None], axis=-1).min(axis=1)


class Shapes(unittest.TestCase):
    def test_a_box_with_a_hole(self):
        shape = mv.PlaneShape([BOX, [[1, 0.25], [2, 0.25], [2, 0.75], [1, 0.75]]], fill="evenodd")
        self.assertEqual((shape.report.area, shape.report.perimeter, shape.report.segments), (3.5, 13.0, 8))
        np.testing.assert_array_equal(shape.report.upper, [4, 1])
        a, b = shape.points[shape.segments[:, 0]], shape.points[shape.segments[:, 1]]
        self.assertAlmostEqual(((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2).sum(), 3.5)  # the inside is on the left
        near = shape.nearest([[1.5, 0.1], [1.5, 0.5], [-1.0, 0.5]])
        np.testing.assert_allclose(near.distances, [0.1, 0.25, 1])
        np.testing.assert_array_equal(near.inside, [True, False, False])
        np.testing.assert_allclose(near.points[[0, 2]], [[1.5, 0], [0, 0.5]])

    def test_rings_that_cross(self):
        both = [BOX, BOX + [2, 0.5]]
        self.assertAlmostEqual(mv.PlaneShape(both).report.area, 8 - 1)
        self.assertAlmostEqual(mv.PlaneShape(both, fill="evenodd").report.area, 8 - 2)
        self.assertEqual(mv.PlaneShape(both).report.crossings, 2)

    def test_objects_of_other_packages(self):
        class Geometry:
            def __init__(self, interface):
                self.__geo_interface__ = interface

        ring = [*map(tuple, BOX), tuple(BOX[0])]
        hole = [(1, 0.25), (2, 0.25), (2, 0.75), (1, 0.75), (1, 0.25)]  # the same way round as the outer ring
        over_it = [(0.9, 0.2), (2.1, 0.2), (2.1, 0.8), (0.9, 0.8), (0.9, 0.2)]
        polygon = {"type": "Polygon", "coordinates": (ring, hole)}
        cases = [
            (polygon, 3.5),
            ({"type": "MultiPolygon", "coordinates": [(ring, hole), (over_it,)]}, 4.0),
            ({"type": "Feature", "geometry": polygon}, 3.5),
            ({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": polygon}]}, 3.5),
            ({"type": "GeometryCollection", "geometries": [polygon]}, 3.5),
        ]
        for interface, area in cases:
            self.assertAlmostEqual(mv.PlaneShape(Geometry(interface)).report.area, area, msg=interface["type"])
        for interface in ({"type": "Point", "coordinates": (0, 0)}, {}, {"type": "Polygon"}, 7):
            with self.assertRaises(mv.errors.UsageError):
                mv.PlaneShape(Geometry(interface))

    def test_errors(self):
        for rings, kind, message in (
            ([BOX[:, :1]], mv.errors.UsageError, r"`rings` has the shape \(4, 1\) where \(n, 2\)"),
            (7, mv.errors.UsageError, "int is no shape"),
            (BOX * np.nan, mv.errors.InvalidMeshError, ""),
            ([[0, 0], [1, 1]], mv.errors.InvalidMeshError, ""),
            ([], mv.errors.InvalidMeshError, ""),
        ):
            with self.assertRaisesRegex(kind, message):
                mv.PlaneShape(rings)
        with self.assertRaisesRegex(mv.errors.UsageError, "nonzero, evenodd"):
            mv.PlaneShape(BOX, fill="winding")
        with self.assertRaises(mv.errors.UsageError):
            mv.plane_axis(BOX, object_angle=2)


class Axis(unittest.TestCase):
    def test_a_box(self):
        axis = mv.plane_axis(BOX, object_angle=0)
        self.assertEqual((len(axis.nodes), len(axis.branches), axis.junctions), (6, 5, 2))
        self.assertAlmostEqual(axis.length, 3 + 4 * np.sqrt(0.5))
        inner = axis.nodes.kinds == mv.AXIS_NODE_KINDS.index("meeting")
        np.testing.assert_allclose(sorted(axis.nodes.points[inner].tolist()), [[0.5, 0.5], [3.5, 0.5]])
        np.testing.assert_allclose(axis.nodes.radii[inner], 0.5)
        np.testing.assert_allclose(axis.nodes.object_angles[inner], np.pi / 2)
        self.assertTrue(np.all(axis.arcs.kinds == mv.PLANE_CURVE_KINDS.index("segments")))
        # A fire from a corner reaches the junction after the diagonal, less the radius there.
        at_corners = np.isfinite(axis.branches.significance)
        np.testing.assert_allclose(axis.branches.significance[at_corners], np.sqrt(0.5) - 0.5)
        line = mv.plane_axis(BOX, object_angle=0).prune(0.8).longest_paths()
        self.assertEqual((len(line.branches), line.excess), (1, 0))
        self.assertAlmostEqual(line.length, 3)
        self.assertEqual(len(mv.plane_axis(BOX, object_angle=1.0).branches), 1)

    def test_every_arc_of_a_star_is_equally_far_from_two_contacts(self):
        shape = mv.PlaneShape(star(5) * [1.3, 1])  # without its symmetry, which leaves lines alone
        axis = mv.plane_axis(shape, side="both", object_angle=0)
        kinds = set(axis.arcs.kinds.tolist())
        self.assertIn(mv.PLANE_CURVE_KINDS.index("point_and_segment"), kinds)
        arcs = np.repeat(np.arange(len(axis.arcs)), 9)
        share = np.tile(np.linspace(0, 1, 9), len(axis.arcs))
        t = axis.arcs.t[arcs, 0] * (1 - share) + axis.arcs.t[arcs, 1] * share
        samples = axis.at(arcs, t)
        found = distance_to(shape.points, shape.segments, samples.points)
        # Both are within epsilon of the axis, and a distance changes no faster than its place.
        np.testing.assert_allclose(samples.radii, found, atol=2 * axis.epsilon + 1e-12)
        for arc in (0, len(axis.arcs) - 1):
            for end in (0, 1):
                at = axis.at([arc], [axis.arcs.t[arc, end]])
                np.testing.assert_allclose(at.points[0], axis.nodes.points[axis.arcs.nodes[arc, end]], atol=1e-9)

    def test_branches_and_lines(self):
        axis = mv.plane_axis(star(5), object_angle=0.3)
        first, step = axis.branches.first, 0.01
        self.assertEqual(first[-1], len(axis.branches.arcs))
        for i, line in enumerate(axis.lines(step=step)):
            arcs, turned = (a[first[i] : first[i + 1]] for a in (axis.branches.arcs, axis.branches.reversed))
            ends = axis.arcs.nodes[arcs[0]][int(turned[0])], axis.arcs.nodes[arcs[-1]][1 - int(turned[-1])]
            np.testing.assert_array_equal(ends, axis.branches.ends[i])
            np.testing.assert_allclose(line.points[[0, -1]], axis.nodes.points[axis.branches.ends[i]], atol=1e-9)
        with self.assertRaisesRegex(mv.errors.UsageError, "step"):
            axis.lines(step=-1)
        with self.assertRaisesRegex(mv.errors.UsageError, "1000000, of [0-9]+ arcs"):
            axis.at([10**6], [0.0])

    def test_threads_and_progress(self):
        shape, calls = mv.PlaneShape(star(300)), []
        one = mv.plane_axis(shape, threads=1, progress=lambda stage, done: calls.append((stage, done)))
        three = mv.plane_axis(shape, threads=3)
        np.testing.assert_array_equal(one.nodes.points, three.nodes.points)
        np.testing.assert_array_equal(one.arcs.t, three.arcs.t)
        self.assertEqual({stage for stage, _ in calls}, {"axis"})

    def test_plots(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        axis = mv.plane_axis(star(5))
        ax = axis.plot(colour="object_angles", discs=20)
        ax.figure.canvas.draw()
        self.assertEqual(len(ax.collections), 3)  # discs, boundary and axis
        lower, upper = np.array([ax.get_xlim(), ax.get_ylim()]).T
        self.assertTrue(np.all((lower <= axis.shape.report.lower) & (axis.shape.report.upper <= upper)))
        with self.assertRaisesRegex(mv.errors.UsageError, "projection"):
            axis.plot(plt.figure().add_subplot(projection="3d"))
        plt.close("all")


class AsPublished(unittest.TestCase):
    def test_points_of_a_box(self):
        found = mv.plane_axis_as_published(BOX)
        self.assertGreater(len(found), 100)
        # The medial axis of the box, from whose points the distances to the sides are known.
        x, y = found.points.T
        to_sides = np.sort(np.column_stack([x, 4 - x, y, 1 - y]), axis=1)
        np.testing.assert_allclose(to_sides[:, 0], to_sides[:, 1], atol=4 * 2.0**-28)  # epsilon is 4 * 2^-30
        np.testing.assert_allclose(found.radii, to_sides[:, 0], atol=4 * 2.0**-30)
        self.assertEqual(found.discs, found.undetermined + sum(found.decided))
        self.assertLess(found.missed_angle, 0.6)

    def test_circles(self):
        shape = mv.PlaneShape(BOX)
        across = shape.decide_circle([2, 0.5], 0.3)
        self.assertTrue(across.has_medial_point)
        self.assertIn(across.line, (3, 8, 13))
        y = across.points[across.found, 1] - 0.5
        self.assertLess(y[0] * y[1], 0)  # the axis is between them
        beside = shape.decide_circle([2, 0.2], 0.1, [0.0, 2.0, 4.0])
        self.assertFalse(beside.has_medial_point)
        self.assertEqual((beside.line, len(beside.found)), (0, 0))
        np.testing.assert_allclose(beside.feet[:, 1], 0, atol=1e-12)
        with self.assertRaises(mv.errors.UsageError):
            shape.decide_circle([2, 0.2], 0.3)


class Voronoi(unittest.TestCase):
    def test_three_points(self):
        found = mv.plane_voronoi([[[0, 0]], [[2, 0]], [[1, 2]]])
        centre = found.nodes.points[found.nodes.degrees == 3]
        np.testing.assert_allclose(centre, [[1, 0.75]])  # as far from (0, 0) as from (1, 2): 1 + y^2 = (2 - y)^2
        self.assertEqual(sorted(map(tuple, found.arc_sites.tolist())), [(0, 1), (0, 2), (1, 2)])
        roadmap = found.roadmap()
        self.assertEqual((len(roadmap), roadmap.components), (3, 1))
        # The narrowest place between the first two points is the middle, and a disc of radius 1 passes there.
        between = np.flatnonzero(np.all(found.arc_sites[roadmap.arcs] == [0, 1], axis=1))
        self.assertTrue(1 - 1e-6 <= roadmap.widths[between[0]] <= 1)

    def test_a_path_between_walls(self):
        sites = [mv.PlaneShape(BOX), mv.PlaneShape(BOX + [0, 3]), [[4.0, 1.5], [4.0, 2.5]]]
        roadmap = mv.plane_voronoi(sites).roadmap()
        path = roadmap.widest_path([1.0, 2.0], [7.0, 2.0])
        # It passes between a box and the segment, whose ends are half a unit from both boxes.
        self.assertTrue(0.2499 <= path.width <= 0.25 or path.width > 0.25)
        self.assertGreaterEqual(path.length, np.hypot(6, 0))
        np.testing.assert_array_equal(path.line[[0, -1]], [[1, 2], [7, 2]])
        for place in ([1.0, 0.5], [np.nan, 0], [4.0, 2.0]):
            with self.assertRaises(mv.errors.UsageError):
                roadmap.widest_path(place, [7.0, 2.0])

    def test_errors(self):
        with self.assertRaisesRegex(mv.errors.UsageError, "two sites"):
            mv.plane_voronoi([BOX])
        with self.assertRaisesRegex(mv.errors.UsageError, r"`sites` has the shape \(2,\)"):
            mv.plane_voronoi([BOX, [1, 2]])
        with self.assertRaisesRegex(mv.errors.UsageError, "site 1 has no point"):
            mv.plane_voronoi([BOX, []])
        with self.assertRaises(mv.errors.InvalidMeshError):
            mv.plane_voronoi([[[0, 0], [0, 0]], [[1, 1]]])

    def test_sites_that_meet_are_refused(self):
        far, line, box = [[9.0, 9.0]], [[-1.0, 0.5], [5.0, 0.5]], mv.PlaneShape(BOX)
        ring_with_hole = mv.PlaneShape([BOX * 4, BOX + [6, 1]], fill="evenodd")
        for sites, names in (
            ([line, far, [[2.0, 0.0], [2.0, 1.0]]], "sites 0 and 2 cross or touch"),  # in a point that is an end of neither
            ([far, line, [[2.0, 0.5], [2.0, 1.0]]], "sites 1 and 2 cross or touch"),  # an end on a line
            ([line, line[::-1]], "sites 0 and 1 cross or touch"),
            ([line, [[5.0, 0.5], [6.0, 3.0]]], "sites 0 and 1 cross or touch"),  # ends
            ([line, [[2.0, 0.5]]], "sites 0 and 1 cross or touch"),  # a point on a line
            ([far, [[3.0, 3.0]], [[3.0, 3.0]]], "sites 1 and 2 cross or touch"),
            ([box, line], "sites 0 and 1 cross or touch"),
            ([box, mv.PlaneShape(BOX + [3.5, 0.5])], "sites 0 and 1 cross or touch"),
            ([far, box, [[1.0, 0.5]]], "site 2 lies in site 1"),
            ([mv.PlaneShape(BOX / 2 + [1, 0.25]), box], "site 0 lies in site 1"),
            # Of the two parts of a site, the second one lies in the other site.
            ([mv.PlaneShape([BOX - [0, 9], BOX / 2 + [1, 0.25]]), box], "site 0 lies in site 1"),
        ):
            with self.subTest(names), self.assertRaisesRegex(mv.errors.InvalidMeshError, names):
                mv.plane_voronoi(sites)
        # Apart: in a hole, and a line that crosses itself, as far from a point as its nearest part.
        mv.plane_voronoi([ring_with_hole, [[7.0, 1.5]]])
        found = mv.plane_voronoi([[[0, 0], [2, 2], [2, 0], [0, 2]], [[8.0, 1.0]]])
        t = found.arcs.t.mean(axis=1)
        samples = found.at(np.arange(len(found.arcs)), t)
        np.testing.assert_allclose(samples.radii, np.hypot(*(samples.points - [8, 1]).T), atol=1e-9)
        np.testing.assert_allclose(samples.radii, distance_to(found.points, found.segments, samples.points), atol=1e-9)


@unittest.skipUnless(TOOL, "MEDIAL_VK_TOOL names no tool")
class AsTheTool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, *rings):
        lines = [f"{x!r},{y!r},{i}\n" for i, ring in enumerate(rings) for x, y in np.asarray(ring).tolist()]
        path = self.folder / name
        path.write_text("x,y,ring\n" + "".join(lines))
        return str(path)

    def run_tool(self, *arguments):
        subprocess.run([TOOL, *arguments, "--quiet"], check=True, cwd=self.folder)

    def assert_axis(self, axis, file):
        for name, values in (("point", axis.nodes.points), ("radius", axis.nodes.radii), ("degree", axis.nodes.degrees)):
            np.testing.assert_array_equal(values, [node[name] for node in file["nodes"]])
        self.assertEqual([mv.AXIS_NODE_KINDS[i] for i in axis.nodes.kinds], [node["kind"] for node in file["nodes"]])
        for name, values in (("nodes", axis.arcs.nodes), ("t", axis.arcs.t), ("origin", axis.arcs.origins), ("along", axis.arcs.along)):
            np.testing.assert_array_equal(values, [arc[name] for arc in file["arcs"]])
        for arc, contacts, is_point in zip(file["arcs"], axis.arcs.contacts, axis.arcs.contact_is_point):
            self.assertEqual([(*c.items(),)[0] for c in arc["contacts"]], [("point" if p else "segment", i) for i, p in zip(contacts, is_point)])
        self.assertEqual([mv.PLANE_CURVE_KINDS[i] for i in axis.arcs.kinds], [arc["kind"] for arc in file["arcs"]])
        np.testing.assert_array_equal(axis.branches.lengths, [branch["length"] for branch in file["branches"]])
        significance = [np.nan if b["significance"] is None else b["significance"] for b in file["branches"]]
        np.testing.assert_array_equal(axis.branches.significance, significance)
        self.assertEqual(axis.branches.arcs.tolist(), [arc for branch in file["branches"] for arc in branch["arcs"]])
        self.assertEqual(axis.epsilon, file["epsilon"])

    def assert_lines(self, lines, file):
        self.assertEqual(len(lines), len(file["branches"]))
        for line, branch in zip(lines, file["branches"]):
            np.testing.assert_array_equal(np.column_stack([line.points, line.radii, line.object_angles]), branch["line"])

    def test_same_axis(self):
        rings = star(7), star(4)[::-1] / 3
        path = self.write("star.csv", *rings)
        for own, arguments, keywords in (
            (lambda axis: axis, [], {}),
            (lambda axis: axis, ["--side", "both", "--object-angle", "0.2", "--margin", "3"], {"side": "both", "object_angle": 0.2, "margin": 3.0}),
            (lambda axis: axis.prune(0.5, 0.1), ["--prune-length", "0.5", "--prune-significance", "0.1"], {}),
            (lambda axis: axis.longest_paths(), ["--longest-path", "--object-angle", "0.1"], {"object_angle": 0.1}),
        ):
            with self.subTest(arguments):
                self.run_tool("plane", path, "-o", "axis.json", "--smooth", "0.4", *arguments)
                file = json.loads((self.folder / "axis.json").read_text())
                shape = mv.PlaneShape(rings, fill="evenodd")
                np.testing.assert_array_equal(shape.points, file["points"])
                np.testing.assert_array_equal(shape.segments, file["segments"])
                axis = own(mv.plane_axis(shape, **keywords))
                self.assertGreater(len(axis.arcs), 3)
                self.assert_axis(axis, file)
                self.assert_lines(axis.lines(smooth=0.4), file)

    def test_same_points_as_published(self):
        path = self.write("star.csv", star(5))
        self.run_tool("plane", path, "-o", "axis.csv", "--mode", "thesis")
        found = mv.plane_axis_as_published(star(5))
        rows = np.loadtxt(self.folder / "axis.csv", delimiter=",", skiprows=1)
        np.testing.assert_array_equal(np.column_stack([found.points, found.radii, found.object_angles]), rows[:, :4])

    def test_same_curves_and_roadmap(self):
        rings = [star(5), star(4) + [9, 1], star(3) + [2, 11]]
        paths = [self.write(f"{i}.csv", ring) for i, ring in enumerate(rings)]
        self.run_tool("voronoi", *paths, "-o", "curves.json", "--roadmap", "map.json", "--from=-2,6", "--to=7,8")
        file = json.loads((self.folder / "curves.json").read_text())
        found = mv.plane_voronoi([mv.PlaneShape(ring) for ring in rings])
        self.assert_axis(found, file)
        np.testing.assert_array_equal(found.site_of_segment, file["site_of_segment"])
        roadmap, written = found.roadmap(), json.loads((self.folder / "map.json").read_text())
        np.testing.assert_array_equal(roadmap.widths, [link["width"] for link in written["links"]])
        path = roadmap.widest_path([-2, 6], [7, 8])
        self.assertEqual((path.width, path.length), (written["path"]["width"], written["path"]["length"]))
        np.testing.assert_array_equal(path.line, written["path"]["line"])


if __name__ == "__main__":
    unittest.main()
