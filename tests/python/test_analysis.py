"""Medial spheres: results, progress, interruption, plots and pages."""

import copy
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest

import numpy as np
import shapes

import medial_vk as mv


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = mv.Mesh(*shapes.torus())
        cls.found = mv.analyse(cls.mesh, resolution=40, volumes=True, medial_mesh=True)

    def test_spheres_of_a_torus(self):
        spheres = self.found.spheres
        ring = np.hypot(np.hypot(spheres.centres[:, 0], spheres.centres[:, 1]) - 1, spheres.centres[:, 2])
        self.assertGreater(len(spheres), 100)
        self.assertLess(ring.max(), 0.05)  # the polyhedron's medial axis is near the circle
        self.assertLess(np.abs(spheres.radii - 0.4).max(), 0.05)
        np.testing.assert_allclose(np.linalg.norm(spheres.spokes_a, axis=1), 1, atol=1e-6)
        self.assertEqual(self.found.certificate.passed, len(spheres))

    def test_fields_have_the_stated_shapes(self):
        n = len(self.found)
        spheres = self.found.spheres
        self.assertEqual(spheres.centres.dtype, np.float64)
        self.assertEqual(spheres.voxels.shape, (n, 3))
        origin, side = self.found.grid.origin, self.found.grid.voxel_size
        np.testing.assert_array_equal(np.floor((spheres.centres - origin) / side).astype(int), spheres.voxels)
        self.assertAlmostEqual(self.found.significance.of_ball.sum(), 1)
        self.assertEqual(self.found.significance.topology.tunnels, 1)
        self.assertEqual(self.found.medial_mesh.topology.tunnels, 1)
        self.assertEqual(int(self.found.sheets.points.sum()), n)
        self.assertEqual(len(self.found.undecided), len(self.found.undecided.kinds))

    def test_results_cannot_be_assigned(self):
        with self.assertRaises(AttributeError):
            self.found.spheres = None
        self.assertIn("array of shape", repr(self.found))

    def test_saved_files_read_back(self):
        with tempfile.TemporaryDirectory() as folder:
            self.found.save(os.path.join(folder, "a.npz"))
            with np.load(os.path.join(folder, "a.npz")) as arrays:
                np.testing.assert_array_equal(arrays["centre"], self.found.spheres.centres)
            with self.assertRaisesRegex(mv.errors.UsageError, "extension"):
                self.found.save(os.path.join(folder, "a.xyz"))

    def assert_same(self, one, two):
        """All fields, which for results are those of results in them."""
        self.assertIs(type(one), type(two))
        if isinstance(one, np.ndarray):
            self.assertEqual(one.dtype, two.dtype)
            np.testing.assert_array_equal(one, two)
        elif hasattr(one, "_fields"):
            for name in one._fields:
                if name != "_native":
                    self.assert_same(getattr(one, name), getattr(two, name))
        elif isinstance(one, mv.Mesh):
            self.assert_same(one.triangles, two.triangles)
        else:
            self.assertEqual(one, two)

    def files_of(self, found):
        with tempfile.TemporaryDirectory() as folder:
            for name, options in (("a.ply", {}), ("b.ply", {"ascii": True}), ("a.csv", {}), ("a.npz", {})):
                path = os.path.join(folder, name)
                found.save(path, **options)
                with open(path, "rb") as file:
                    yield file.read()

    def test_pickled(self):
        around = self.mesh.on_side("outside", margin=0.5)
        for name, found in (
            ("with everything", mv.analyse(self.mesh, resolution=30, keep_volume=0.9, removal_orders=True, medial_mesh=True, simplify=True)),
            ("without sheets", mv.analyse(self.mesh, resolution=20, sheets=False, object_angle=0.7)),
            ("as published", mv.analyse(self.mesh, resolution=20, mode="thesis")),
            ("outside", mv.analyse(around, resolution=20, volumes=True)),
        ):
            with self.subTest(name):
                other = pickle.loads(pickle.dumps(found))
                self.assert_same(found, other)
                self.assertEqual(found._native.state(), other._native.state())
                self.assertEqual(list(self.files_of(found)), list(self.files_of(other)))
                self.assert_same(found.fatness([0.7, 1.0]), other.fatness([0.7, 1.0]))
                try:
                    page = found.page(title="a", up="z")
                except mv.errors.UsageError:
                    continue  # a build without pages
                self.assertEqual(page.html, other.page(title="a", up="z").html)
        self.assert_same(self.found, copy.deepcopy(self.found))

    def test_states_of_something_else(self):
        from medial_vk import _analysis, _native

        state = self.found._native.state()
        version = _native.VERSION.encode()
        with self.assertRaisesRegex(mv.errors.UsageError, "was not pickled by medial-vk " + _native.VERSION):
            _analysis._restored(self.mesh, state.replace(version, b"9" * len(version), 1))
        for wrong in (b"", state[:-1], state + b"0", state[: len(state) // 2]):
            with self.assertRaises(mv.errors.UsageError):
                _analysis._restored(self.mesh, wrong)
        # Every number of a list or a text that is too large ends the reading.
        random = np.random.default_rng(5)
        for place in random.integers(40, len(state) - 8, size=300):
            damaged = state[:place] + b"\xff" * 8 + state[place + 8 :]
            try:
                _native.restore_analysis(self.mesh._native, damaged)
            except mv.errors.UsageError:
                pass

    def test_what_cannot_be_pickled_says_so(self):
        union = mv.measure_union(self.found, complex=True)
        curves = mv.plane_voronoi([[[0.0, 0]], [[1.0, 1]]])
        for thing, name in (
            (union, "DualComplex"),
            (curves, "PlaneAxis"),
            (curves.roadmap(), "PlaneRoadmap"),
            (mv.PlaneShape([[0, 0], [4, 0], [4, 1]]), "PlaneShape"),
            (mv.curvature(self.found), "Curvature"),
            (mv.default_context(), "Context"),
            (mv.Follower(self.mesh, [[1.0, 0, 0, 0.1]]), "Follower"),
        ):
            for act in (pickle.dumps, copy.deepcopy):
                with self.subTest(name), self.assertRaisesRegex(TypeError, f"^{name} cannot be pickled, nor copied deeply"):
                    act(thing)
        self.assert_same(mv.measure_union(self.found), pickle.loads(pickle.dumps(mv.measure_union(self.found))))

    def test_page(self):
        try:
            page = self.found.page(title="a <torus>")
        except mv.errors.UsageError as error:
            self.skipTest(str(error))
        self.assertTrue(page.html.lower().startswith(b"<!doctype html>"))
        self.assertIn("srcdoc", page._repr_html_())
        self.assertIn("medial spheres", self.found._repr_html_())

    def test_plots(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        for axes in (self.found.plot(), self.found.plot(colour="sheets"), self.found.balls.plot(mesh=self.mesh)):
            axes.figure.canvas.draw()
            plt.close(axes.figure)

    def test_plots_of_several_objects(self):
        """Axes show all that was drawn in them, with equal scales; numbers must fit what they colour."""
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        axes = self.mesh.plot(colour=np.arange(len(self.mesh.vertices)), label="number")
        lower, upper = self.mesh.vertices.min(axis=0), self.mesh.vertices.max(axis=0)
        self.mesh.moved(self.mesh.vertices + [5, 0, 0]).plot(axes, colour="red", alpha=0.5)
        limits = np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()])
        np.testing.assert_allclose(limits, np.column_stack([lower, upper + [5, 0, 0]]))
        self.found.balls.plot(axes, colour=self.found.spheres.flux)
        axes.figure.canvas.draw()
        for colour in (np.zeros(3 + len(self.mesh.vertices)), np.zeros((2, 2))):
            with self.assertRaisesRegex(mv.errors.UsageError, "one number for each"):
                self.mesh.plot(axes, colour=colour)
            with self.assertRaisesRegex(mv.errors.UsageError, "one number for each"):
                self.found.balls.plot(axes, colour=colour)
        plt.close(axes.figure)

    def test_sheets_of_successive_numbers_have_different_colours(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        from medial_vk import _plots

        numbers = np.arange(300)
        axes = _plots.plot_points(np.random.default_rng(1).random((300, 3)), numbers, None, None, "sheets")
        axes.figure.canvas.draw()
        colours = axes.collections[0].to_rgba(axes.collections[0].get_array())
        self.assertTrue(np.all(np.any(colours[1:] != colours[:-1], axis=1)))
        plt.close(axes.figure)


class Determinism(unittest.TestCase):
    def test_threads_change_nothing(self):
        mesh = mv.Mesh(*shapes.grid((1, 0.7, 0.3), 6))
        one, two = (mv.analyse(mesh, resolution=30, threads=count) for count in (1, 3))
        for name in ("centres", "radii", "spokes_a", "spokes_b", "sheets", "flux"):
            np.testing.assert_array_equal(getattr(one.spheres, name), getattr(two.spheres, name))


class Progress(unittest.TestCase):
    def setUp(self):
        self.mesh = mv.Mesh(*shapes.torus())

    def test_stages_and_shares(self):
        calls = []
        mv.analyse(self.mesh, resolution=40, progress=lambda stage, done: calls.append((stage, done)))
        self.assertIn("extract", {stage for stage, _ in calls})
        self.assertTrue(all(0 <= done <= 1 for _, done in calls))

    def test_an_exception_of_the_callback_ends_the_call_and_arrives(self):
        class Enough(Exception):
            pass

        def fail(stage, done):
            raise Enough(stage)

        for _ in range(3):
            with self.assertRaises(Enough) as raised:
                mv.analyse(self.mesh, resolution=40, progress=fail)
            self.assertEqual(raised.exception.args, ("extract",))
        self.assertGreater(len(mv.analyse(self.mesh, resolution=20)), 0)  # the context is as before

    def test_the_callback_may_call_again(self):
        counts = []

        def again(_stage, _done):
            if not counts:
                counts.append(len(mv.analyse(self.mesh, resolution=10)))

        found = mv.analyse(self.mesh, resolution=20, progress=again)
        self.assertGreater(len(found), 0)
        self.assertGreater(counts[0], 0)

    def test_the_callback_runs_on_the_thread_of_the_caller(self):
        threads = set()
        mv.analyse(self.mesh, resolution=20, progress=lambda stage, done: threads.add(threading.get_ident()))
        self.assertEqual(threads, {threading.get_ident()})

    def test_a_callback_that_cannot_be_called(self):
        with self.assertRaisesRegex(mv.errors.UsageError, "progress"):
            mv.analyse(self.mesh, resolution=20, progress=7)

    def test_a_bar(self):
        mv.analyse(self.mesh, resolution=20, progress=True)


class Interruption(unittest.TestCase):
    """Ctrl-C arrives as a signal; a call that takes many times as long as the delay must end with KeyboardInterrupt."""

    def setUp(self):
        # A program that was started in the background may ignore the signal.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))

    def interrupted(self, work, delay=0.3):
        timer = threading.Timer(delay, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                work()
        finally:
            timer.cancel()
            timer.join()

    def test_analysis(self):
        mesh = mv.Mesh(*shapes.torus(around=200, across=100))
        self.interrupted(lambda: mv.analyse(mesh, resolution=700))

    def test_spheres(self):
        mesh = mv.Mesh(*shapes.torus(around=200, across=100))
        self.interrupted(lambda: mv.fit_spheres(mesh, 4000))

    def test_work_that_cannot_be_stopped_is_abandoned(self):
        rng = np.random.default_rng(1)
        balls = rng.random((400_000, 4)) * [1, 1, 1, 0.02]
        self.interrupted(lambda: mv.measure_union(balls, complex=True))
        self.assertAlmostEqual(mv.measure_union([[0, 0, 0, 1.0]]).volume, 4 / 3 * np.pi)

    def test_many_poses(self):
        mesh = mv.Mesh(*shapes.torus(around=100, across=60))
        body = mv.Body(mesh)
        poses = np.tile(np.eye(4), (300_000, 1, 1))
        poses[:, :3, 3] = np.random.default_rng(2).normal(scale=2, size=(len(poses), 3))
        self.interrupted(lambda: mv.distances(body, body, poses))


class Contexts(unittest.TestCase):
    def test_threads_share_a_context(self):
        mesh = mv.Mesh(*shapes.torus())
        expected = mv.analyse(mesh, resolution=24).spheres.centres
        results, failures = [], []

        def work():
            try:
                results.append(mv.analyse(mesh, resolution=24).spheres.centres)
            except BaseException as error:  # noqa: B902 - any failure of a thread is one of the test
                failures.append(error)

        threads = [threading.Thread(target=work) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])
        for centres in results:
            np.testing.assert_array_equal(centres, expected)

    def test_contexts_of_their_own(self):
        mesh = mv.Mesh(*shapes.torus())
        contexts = [mv.Context(threads=1) for _ in range(3)]
        results = [None] * 3

        def work(i):
            results[i] = mv.analyse(mesh, resolution=24, context=contexts[i]).spheres.radii

        threads = [threading.Thread(target=work, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(results[0], results[1])
        np.testing.assert_array_equal(results[0], results[2])

    def test_no_device_of_that_name(self):
        with self.assertRaisesRegex(mv.errors.NoDeviceError, "no such thing"):
            mv.Context("no such thing")

    def test_the_process_ends_while_threads_compute(self):
        script = """
            import threading, time, shapes, medial_vk as mv
            mesh = mv.Mesh(*shapes.torus())
            mv.analyse(mesh, resolution=10)
            for _ in range(2):
                threading.Thread(target=lambda: mv.analyse(mesh, resolution=400), daemon=True).start()
            time.sleep(0.3)
        """
        folder = os.path.dirname(os.path.abspath(__file__))
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join([folder, os.environ.get("PYTHONPATH", "")]))
        result = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, env=environment)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    @unittest.skipUnless(hasattr(os, "fork"), "no fork")
    def test_a_forked_process_makes_its_own(self):
        mesh = mv.Mesh(*shapes.box())
        mine = mv.default_context()
        child = os.fork()
        if child == 0:
            status = 1
            try:
                own = mv.default_context() is not mine
                try:
                    mv.analyse(mesh, resolution=10, context=mine)
                except mv.errors.UsageError:
                    status = 0 if own else 2
            finally:
                os._exit(status)
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline:
            pid, status = os.waitpid(child, os.WNOHANG)
            if pid:
                break
            time.sleep(0.05)
        else:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            self.fail("the forked process did not end")
        self.assertEqual(os.waitstatus_to_exitcode(status), 0)


if __name__ == "__main__":
    unittest.main()
