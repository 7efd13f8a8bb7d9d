"""Boundaries that functions know: exact answers, exceptions, interruption and the end of the process."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import traceback
import unittest

import numpy as np

import medial_vk as mv

HALF = np.array([1.0, 0.6, 0.35])


def nearest_on_torus(points, major=1.0, minor=0.4):
    """Of a torus about the z axis."""
    ring = np.hypot(points[:, 0], points[:, 1])
    along = points[:, :2] / np.maximum(ring, 1e-300)[:, None]
    out, up = ring - major, points[:, 2]
    scale = minor / np.maximum(np.hypot(out, up), 1e-300)
    return np.column_stack([along * (major + scale * out)[:, None], scale * up])


def in_torus(points, major=1.0, minor=0.4):
    return np.hypot(np.hypot(points[:, 0], points[:, 1]) - major, points[:, 2]) < minor


def nearest_on_box(points):
    """Of the surface of a box about the origin."""
    inside = np.all(np.abs(points) < HALF, axis=1)
    answers = np.clip(points, -HALF, HALF)
    axis = np.argmin(HALF - np.abs(points), axis=1)
    rows = np.flatnonzero(inside)
    sign = np.where(points[rows, axis[rows]] < 0, -1, 1)
    answers[rows, axis[rows]] = sign * HALF[axis[rows]]
    return answers


def in_box(points):
    return np.all(np.abs(points) < HALF, axis=1)


class Enough(Exception):
    pass


class Boundaries(unittest.TestCase):
    def test_torus(self):
        """Its medial axis inside is the circle of its tube, on which every radius is that of the tube."""
        found = mv.analyse_boundary(nearest_on_torus, [-1.5, -1.5, -0.5], [1.5, 1.5, 0.5], contains=in_torus, resolution=16)
        self.assertGreater(len(found), 30)
        ring = np.hypot(found.spheres.centres[:, 0], found.spheres.centres[:, 1]) - 1
        from_axis = np.hypot(ring, found.spheres.centres[:, 2])
        self.assertTrue(np.all(from_axis <= found.axis_distances + 1e-12))
        self.assertTrue(np.all(found.axis_distances <= 0.01 * found.grid.voxel_size))
        self.assertTrue(np.all(found.spheres.radii <= 0.4 - from_axis + 1e-12))
        np.testing.assert_allclose(found.spheres.radii, 0.4, atol=0.02 * found.grid.voxel_size)
        origin, side = found.grid.origin, found.grid.voxel_size
        np.testing.assert_array_equal(np.floor((found.spheres.centres - origin) / side).astype(int), found.spheres.voxels)
        self.assertEqual(len(found.sheets.is_seam), len(found))
        self.assertGreater(found.queries, len(found))

    def test_box_and_point_cloud(self):
        found = mv.analyse_boundary(nearest_on_box, -HALF, HALF, contains=in_box, resolution=12, object_angle=0.7)
        self.assertGreater(len(found), 20)
        to_sides = np.sort(np.concatenate([HALF - found.spheres.centres, HALF + found.spheres.centres], axis=1), axis=1)
        # Equally far from two sides: a medial point is that near, and the distance to a side changes no faster.
        self.assertTrue(np.all(to_sides[:, 1] - to_sides[:, 0] <= 2 * found.axis_distances + 1e-12))
        cloud = np.array([[0.0, 0, 0], [2.0, 0, 0]])

        def nearest_of_two(points):
            return cloud[np.linalg.norm(points[:, None] - cloud, axis=2).argmin(axis=1)]

        between = mv.analyse_boundary(nearest_of_two, [0.5, -1, -1], [1.5, 1, 1], resolution=8, sheets=False)
        self.assertGreater(len(between), 20)
        np.testing.assert_allclose(between.spheres.centres[:, 0], 1, atol=1e-2)
        self.assertIsNone(between.sheets)

    def test_threads_change_nothing(self):
        threads = set()

        def nearest(points):
            threads.add(threading.get_ident())
            return nearest_on_box(points)

        one, many = (mv.analyse_boundary(nearest, -HALF, HALF, contains=in_box, resolution=8, threads=n) for n in (1, 4))
        np.testing.assert_array_equal(one.spheres.centres, many.spheres.centres)
        np.testing.assert_array_equal(one.undecided.voxels, many.undecided.voxels)
        self.assertNotIn(threading.get_ident(), threads)

    def test_a_published_search_progress_and_a_nested_call(self):
        mesh = mv.Mesh([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        calls = []
        found = mv.analyse_boundary(lambda points: mesh.closest_points(points).points, [0, 0, 0], [1, 1, 1],
                                    contains=lambda points: mesh.depths(points) > 0, resolution=12, mode="thesis",
                                    progress=lambda stage, done: calls.append((stage, done)))
        self.assertGreater(len(found), 3)
        self.assertEqual({stage for stage, _ in calls}, {"extract"})
        depths = mesh.depths(found.spheres.centres)
        np.testing.assert_allclose(found.spheres.radii, depths, rtol=0, atol=1e-9)


class Failures(unittest.TestCase):
    def search(self, nearest=nearest_on_box, **options):
        return mv.analyse_boundary(nearest, -HALF, HALF, **{"resolution": 10, "contains": in_box, **options})

    def test_exceptions_arrive_as_they_are(self):
        def fail_later(points, calls=[]):  # noqa: B006
            calls.append(len(points))
            if len(calls) > 20:
                raise Enough("twenty")
            return nearest_on_box(points)

        try:
            self.search(fail_later)
            self.fail("no exception")
        except Enough as error:
            self.assertEqual(error.args, ("twenty",))
            self.assertIn("fail_later", "".join(traceback.format_tb(error.__traceback__)))
        for threads in (1, 4):
            with self.assertRaises(ZeroDivisionError):
                self.search(contains=lambda points: 1 / 0, threads=threads)
        with self.assertRaises(KeyboardInterrupt):
            self.search(lambda points: (_ for _ in ()).throw(KeyboardInterrupt))
        self.assertGreater(len(self.search()), 0)

    def test_answers_of_a_wrong_shape(self):
        for nearest, message in (
            (lambda points: points[:, :2], r"`nearest\(points\)` has the shape \(\d+, 2\)"),
            (lambda points: points[1:], r"`nearest\(points\)` has \d+ rows for \d+ points"),
            (lambda points: None, "nearest"),
            (lambda points: points * np.nan, "finite"),
            (lambda points: points + 1e6, ""),
        ):
            with self.assertRaisesRegex(mv.errors.UsageError, message):
                self.search(nearest)
        with self.assertRaisesRegex(mv.errors.UsageError, r"`contains\(points\)`"):
            self.search(contains=lambda points: points)
        with self.assertRaisesRegex(mv.errors.UsageError, "`nearest` is not callable"):
            self.search(7)
        with self.assertRaisesRegex(mv.errors.UsageError, "resolution"):
            self.search(resolution=0)
        with self.assertRaises(TypeError):
            self.search(lambda: None)

    def test_progress_that_raises(self):
        def fail(stage, done):
            raise Enough

        with self.assertRaises(Enough):
            self.search(progress=fail, resolution=16)

    def test_interruption(self):
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                self.search(resolution=200, extra_levels=6)
        finally:
            timer.join()
        # No function is called for long after that.
        calls = []
        with self.assertRaises(Enough):
            self.search(lambda points: (calls.append(0), nearest_on_box(points))[1], resolution=60,
                        progress=lambda stage, done: (_ for _ in ()).throw(Enough))
        time.sleep(0.2)
        before = len(calls)
        time.sleep(0.2)
        self.assertEqual(len(calls), before)

    def test_the_process_ends_while_threads_compute(self):
        script = """
            import threading, time, numpy as np, medial_vk as mv, test_any_boundary as t
            for i in range(2):
                threading.Thread(target=lambda: mv.analyse_boundary(
                    t.nearest_on_box, -t.HALF, t.HALF, contains=t.in_box, resolution=200), daemon=True).start()
            time.sleep(0.4)
        """
        folder = os.path.dirname(os.path.abspath(__file__))
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join([folder, os.environ.get("PYTHONPATH", "")]))
        for _ in range(3):
            command = [sys.executable, "-c", textwrap.dedent(script)]
            result = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=60)
            self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
