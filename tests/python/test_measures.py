"""Spheres, unions, distances, followers, thickness and curvature against shapes whose measures are known."""

import unittest

import numpy as np
import shapes

import medial_vk as mv


class Spheres(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = mv.Mesh(*shapes.box((2, 1, 1)))
        cls.inside = mv.fit_spheres(cls.mesh, 12)
        cls.cover = mv.fit_spheres(cls.mesh, 8, contract="cover", balls_only=True)

    def test_contracts(self):
        self.assertTrue(self.inside.measures.inside.proved)
        self.assertTrue(self.cover.measures.cover.proved)
        proofs = mv.prove_spheres(self.mesh, self.inside, self.cover)
        self.assertTrue(proofs.inside.proved and proofs.cover.proved)
        swapped = mv.prove_spheres(self.mesh, self.cover, self.inside)
        self.assertFalse(swapped.inside.proved or swapped.cover.proved)

    def test_parts_that_were_not_measured_are_none(self):
        measures = self.cover.measures  # the balls and their proof alone
        self.assertEqual((measures.inside, measures.volume, measures.distances), (None, None, None))
        self.assertIsNone(mv.prove_spheres(self.mesh, self.inside).cover)

    def test_volumes(self):
        union = mv.measure_union(self.inside)
        self.assertAlmostEqual(self.inside.measures.volume.balls, union.volume)
        self.assertAlmostEqual(self.inside.measures.volume.uncovered, 2 - union.volume)

    def test_levels_and_gap(self):
        fit = mv.fit_spheres(self.mesh, 8, levels=True)
        self.assertEqual([len(level) for level in fit.levels][-1], len(fit))
        lower, upper = mv.measure_gap(self.mesh, self.inside)
        self.assertLessEqual(lower, upper)
        self.assertGreater(lower, 0)

    def test_thin_parts(self):
        plate = mv.Mesh(*shapes.box((2, 1.2, 0.04)))
        by_volume, by_distance = mv.fit_spheres(plate, 12), mv.fit_spheres(plate, 12, aim="distance")
        self.assertLess(mv.measure_gap(plate, by_distance)[1], mv.measure_gap(plate, by_volume)[0])
        self.assertEqual((by_volume.aim, by_distance.aim), ("volume", "distance"))
        # 12 balls of the largest radius, .02, have a two-hundredth of the plate's volume, and one as large as the ball in
        # a cube has half and more of it.
        cube = mv.Mesh(*shapes.box((1, 1, 1)))
        for mesh, count, aim in ((plate, 12, "distance"), (cube, 1, "volume")):
            auto = mv.fit_spheres(mesh, count, aim="auto", balls_only=True)
            self.assertEqual(auto.aim, aim)
            [part] = mv.fit_parts([mv.Part(mesh)], count, aim="auto", balls_only=True)
            self.assertEqual(part.aim, aim)
            np.testing.assert_array_equal(auto.radii, mv.fit_spheres(mesh, count, aim=aim, balls_only=True).radii)
        cover = mv.fit_spheres(plate, contract="cover", max_reach=0.3, balls_only=True)
        self.assertTrue(mv.prove_spheres(plate, cover=cover).cover.proved)
        self.assertLessEqual(max(cover.radii), 0.02 + 0.3)  # no centre is deeper
        with self.assertRaisesRegex(mv.errors.UsageError, "raise `count` or `max_reach`"):
            mv.fit_spheres(plate, len(cover) - 1, contract="cover", max_reach=0.3, balls_only=True)

    def test_options_out_of_range(self):
        for options in ({}, {"count": 4, "aim": "volume", "max_reach": 1.0}, {"count": 4, "aim": "far"}, {"count": 4, "error": 2.0}, {"count": 4, "contract": "none"}, {"count": -1}, {"count": 1.5},
                        {"count": "4"}):
            with self.subTest(options), self.assertRaises(mv.errors.UsageError):
                mv.fit_spheres(self.mesh, **options)


class Unions(unittest.TestCase):
    def test_two_balls(self):
        """The volume of two unit balls at distance d has a closed form: the lens of both is pi (4 + d)(2 - d)^2 / 12."""
        d = 1.2
        union = mv.measure_union(([[0, 0, 0], [d, 0, 0]], [1, 1]), complex=True)
        lens = np.pi * (4 + d) * (2 - d) ** 2 / 12
        self.assertAlmostEqual(union.volume, 8 / 3 * np.pi - lens, places=12)
        self.assertAlmostEqual(union.area, 2 * np.pi * (2 + d), places=12)
        np.testing.assert_array_equal(union.complex.edges, [[0, 1]])
        topology = union.complex.topology()
        self.assertEqual((topology.components, topology.tunnels, topology.cavities), (1, 0, 0))

    def test_on_a_device(self):
        balls = np.random.default_rng(3).random((500, 4)) * [1, 1, 1, 0.1]
        exact, near = mv.measure_union(balls), mv.measure_union_on_device(balls)
        self.assertTrue(np.all(np.abs(exact.volumes - near.volumes) <= near.volume_bounds))
        self.assertLessEqual(abs(exact.area - near.area), near.area_bound)

    def test_all_forms_of_balls(self):
        rows = np.array([[0, 0, 0, 1.0], [3, 0, 0, 2.0]])
        volumes = [mv.measure_union(form).volume for form in
                   (rows, rows.tolist(), (rows[:, :3], rows[:, 3]), mv.Balls(centres=rows[:, :3], radii=rows[:, 3]))]
        self.assertEqual(len(set(volumes)), 1)
        packed = np.zeros(2, dtype=np.dtype([("tag", "u1"), ("radius", "f8")]))
        packed["radius"] = rows[:, 3]
        self.assertEqual(mv.measure_union((rows[:, :3], packed["radius"])).volume, volumes[0])  # not aligned
        with self.assertRaisesRegex(mv.errors.UsageError, r"\(n, 4\)"):
            mv.measure_union(rows[:, :3])
        with self.assertRaisesRegex(mv.errors.UsageError, "ball 1"):
            mv.measure_union([[0, 0, 0, 1], [0, 0, 0, -1.0]])


class Distances(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        mesh = mv.Mesh(*shapes.box((1, 1, 1)))
        cls.body = mv.Body(mesh, mv.fit_spheres(mesh, 20, balls_only=True),
                           mv.fit_spheres(mesh, 8, contract="cover", balls_only=True))

    def test_two_boxes(self):
        shifts = np.linspace(0.5, 3, 26)
        poses = np.stack([shapes.pose((x, 0.2, 0.1)) for x in shifts])
        expected = np.maximum(shifts - 1, 0)
        exact = mv.distances(self.body, self.body, poses)
        self.assertTrue(np.all((exact.lower <= expected + 1e-12) & (expected <= exact.upper + 1e-12)))
        bounds = mv.distance_bounds(self.body, self.body, poses)
        self.assertTrue(np.all((bounds.lower <= expected) & (expected <= bounds.upper)))
        verdicts = mv.collide(self.body, self.body, poses)
        self.assertEqual(mv.VERDICTS[verdicts[0]], "hit")
        self.assertEqual(mv.VERDICTS[verdicts[-1]], "free")
        by_balls = mv.collide(self.body, self.body, poses, by_balls=True)
        decided = by_balls != mv.VERDICTS.index("undecided")
        np.testing.assert_array_equal(by_balls[decided], verdicts[decided])

    def test_one_pose_is_the_first_of_many(self):
        pose = shapes.pose((1.7, 0.2, 0.1), 0.3)
        for call in (mv.distance_bounds, mv.distances):
            one, many = call(self.body, self.body, pose), call(self.body, self.body, pose[None])
            self.assertEqual(one.lower, many.lower[0])
            self.assertEqual(one.upper, many.upper[0])
            self.assertEqual(one.verdicts, many.verdicts[0])

    def test_penetration_and_first_contact(self):
        deep = mv.penetration(self.body, self.body, shapes.pose((0.8, 0, 0)))
        self.assertLessEqual(deep.depth[0], 0.2 + 1e-12)
        self.assertGreaterEqual(deep.depth[1], 0.2 - 1e-12)
        contact = mv.first_contact(self.body, self.body, shapes.pose((3, 0, 0)), shapes.pose((0, 0, 0)))
        self.assertEqual(contact.verdict, "hit")
        self.assertLessEqual(contact.free_until, 2 / 3)
        self.assertGreaterEqual(contact.contact_at, 2 / 3 - 1e-6)

    def test_nearest_of_many(self):
        poses = np.stack([shapes.pose((4.0 * i, 0, 0)) for i in range(8)])
        placed = mv.PlacedBodies([self.body] * 8, poses)
        self.assertEqual(len(placed), 8)
        near = placed.nearest(self.body, shapes.pose((9.0, 0, 0)), 2)
        self.assertEqual(near.indices[:2].tolist(), [2, 3])
        self.assertTrue(near.lower[0] <= 0 <= near.upper[0] and near.lower[1] <= 2 <= near.upper[1])
        self.assertGreaterEqual(near.others, near.upper[1])
        with self.assertRaisesRegex(mv.errors.UsageError, "poses"):
            mv.PlacedBodies([self.body], poses)

    def test_poses_that_are_none(self):
        scaled = shapes.pose()
        scaled[0, 0] = 2
        mirrored = np.diag([-1.0, 1, 1, 1])
        for pose, message in ((scaled, "no rigid motion"), (mirrored, "no rigid motion"), (np.full((4, 4), np.nan), "finite"),
                              (np.eye(3), "shape"), (np.eye(4)[:, :, None], "shape")):
            with self.subTest(message), self.assertRaisesRegex(mv.errors.UsageError, message):
                mv.distance_bounds(self.body, self.body, pose)
        single = shapes.pose((1, 2, 3), 0.7).astype(np.float32)
        with self.assertRaisesRegex(mv.errors.UsageError, "rigid_pose"):
            mv.distance_bounds(self.body, self.body, single)
        self.assertGreater(mv.distance_bounds(self.body, self.body, mv.rigid_pose(single)).lower, 0)
        with self.assertRaisesRegex(mv.errors.UsageError, "scales"):
            mv.rigid_pose(scaled)
        with self.assertRaisesRegex(mv.errors.UsageError, "real"):
            mv.rigid_pose(np.eye(4) * 1j)
        with self.assertRaisesRegex(mv.errors.UsageError, "transposed"):
            mv.rigid_pose(shapes.pose((1, 2, 3)).T)


class Following(unittest.TestCase):
    def test_balls_follow_a_shift_and_a_stretch(self):
        mesh = mv.Mesh(*shapes.torus())
        balls = mv.fit_spheres(mesh, 30, balls_only=True)
        follower = mv.Follower(mesh, balls, steps=0)
        rest = follower.balls
        shifted = follower.update(mesh.vertices + [0.0, 0.0, 2.0])
        np.testing.assert_allclose(shifted.centres, rest.centres + [0, 0, 2], atol=1e-9)
        stretched = follower.update(mesh.vertices * [1.3, 1, 1])
        self.assertTrue(mv.prove_spheres(mesh.moved(mesh.vertices * [1.3, 1, 1]), stretched).inside.proved)
        measures = follower.measure()
        self.assertLess(measures.ball_volume, measures.solid_volume)
        follower.reset()
        np.testing.assert_array_equal(follower.balls.radii, rest.radii)
        with self.assertRaises(mv.errors.InvalidMeshError):
            follower.update(mesh.vertices[1:])

    def test_covers_follow(self):
        mesh = mv.Mesh(*shapes.torus())
        follower = mv.CoverFollower(mesh, mv.fit_spheres(mesh, 8, contract="cover", balls_only=True))
        vertices = mesh.vertices * [1, 1.2, 1]
        balls = follower.update(vertices)
        self.assertTrue(follower.covers_solid)
        self.assertTrue(mv.prove_spheres(mesh.moved(vertices), cover=balls).cover.proved)
        follower.tighten()
        self.assertGreater(follower.measure().ball_volume, follower.measure().solid_volume)


class Boundary(unittest.TestCase):
    def test_thickness_of_a_plate(self):
        mesh = mv.Mesh(*shapes.grid((1, 1, 0.1), 8))
        found = mv.thickness(mesh, [[0.0, 0.0, 0.05], [0.2, 0.1, -0.05]])
        self.assertTrue(np.all((found.lower <= 0.1 + 1e-3) & (0.1 <= found.upper)))
        self.assertTrue(np.all(found.in_walls))
        wall = mv.least_wall(mesh)
        self.assertTrue(wall.lower <= 0.1 <= wall.upper * (1 + 1e-12))
        self.assertAlmostEqual(wall.thinnest.radius, 0.05, places=2)

    def test_thickness_deep_in_a_solid(self):
        """A point far from the boundary, few distances: the search ends with a wide interval, not when memory does."""
        mesh = mv.Mesh(*shapes.torus(around=12, across=8))
        point = [0.91602537, 0.22605296, 0.30151356]
        found, better = (mv.thickness(mesh, [point], width=0.1, queries=queries) for queries in (50, 1000))
        self.assertLessEqual(found.lower[0], better.upper[0])
        self.assertLessEqual(better.lower[0], found.upper[0])
        self.assertGreater(found.lower[0], 0.5)  # the tube's diameter is 0.8 at most

    def test_curvature_of_a_torus(self):
        mesh = mv.Mesh(*shapes.torus(around=96, across=48))
        found = mv.analyse(mesh, resolution=80, object_angle=0.5)
        of_balls = mv.curvature(found)
        self.assertEqual(len(of_balls.tip_a.states), len(found))
        at = of_balls.at_vertices(mesh)
        self.assertEqual(at.kappa.shape, (len(mesh.vertices), 2))
        self.assertTrue(np.all(np.isfinite(at.kappa[at.known])))
        # A torus is a tube about a curve: one principal curvature is 1 / minor = 2.5 wherever it is known.
        self.assertTrue(np.all(np.abs(at.kappa[at.known][:, 0] - 2.5) < 0.25))

    def test_curvature_without_spokes(self):
        balls = mv.fit_spheres(mv.Mesh(*shapes.box((2, 1, 1))), 12, balls_only=True)
        self.assertEqual(len(mv.curvature(balls).tip_a.states), len(balls))
        with self.assertRaises(mv.errors.UsageError):
            mv.curvature(balls, method="differences")


if __name__ == "__main__":
    unittest.main()
