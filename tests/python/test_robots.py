"""Parts of an assembly as balls, and the least distance among links."""

import os
import pickle
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import shapes

import medial_vk as mv

TOOL = os.environ.get("MEDIAL_VK_TOOL", "")

URDF = """<robot name="arm">
<link name="base">
  <collision><origin xyz="0 0 0.5"/><geometry><mesh filename="box.obj"/></geometry></collision>
  <collision><origin xyz="0 1 0.5"/><geometry><mesh filename="ring.obj"/></geometry></collision>
</link>
<link name="arm">
  <collision><geometry><mesh filename="ring.obj"/></geometry></collision>
  <collision><origin xyz="3 0 0"/><geometry><sphere radius="0.25"/></geometry></collision>
</link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""
BOX, RING = shapes.box((1, 0.6, 0.4)), shapes.torus(around=24, across=12)


def parts_of_robot():
    ring = mv.Mesh(*RING)
    return [
        mv.Part(mv.Mesh(*BOX), link="base", name="box", pose=shapes.pose((0, 0, 0.5))),
        mv.Part(ring, link="base", name="ring", pose=shapes.pose((0, 1, 0.5))),
        mv.Part(ring, link="arm", name="ring"),
        mv.Part(ball=((0.0, 0.0, 0.0), 0.25), link="arm", name="tip", pose=shapes.pose((3, 0, 0))),
    ]


class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.parts = parts_of_robot()
        cls.fits = mv.fit_parts(cls.parts, total=16)

    def test_numbers_and_proofs(self):
        self.assertEqual(sum(map(len, self.fits)), 16)
        for part, fit in zip(self.parts[:3], self.fits):
            self.assertEqual(len(fit), fit.count)
            self.assertTrue(fit.measures.inside.proved)
            self.assertTrue(mv.prove_spheres(part.mesh, inside=fit.proved).inside.proved)
            shift = np.array([0.0, 1, 0.5]) if part is self.parts[1] else np.array([0, 0, 0.5]) if part is self.parts[0] else 0
            np.testing.assert_allclose(fit.centres, fit.proved.centres + shift, atol=1e-15)
            self.assertAlmostEqual(fit.spheres_volume, mv.measure_union(fit).volume, places=12)
            self.assertEqual(fit.of_shape, False)
        ball = self.fits[3]
        np.testing.assert_array_equal(ball.centres, [[3, 0, 0]])
        np.testing.assert_array_equal(ball.radii, [0.25])
        self.assertEqual((ball.measures, len(ball.proved), ball.of_shape), (None, 0, True))
        self.assertAlmostEqual(ball.solid_volume, np.pi / 48)

    def test_pickled(self):
        again = mv.fit_parts(pickle.loads(pickle.dumps(self.parts)), total=16)
        for fit, other in zip(self.fits, pickle.loads(pickle.dumps(again))):
            np.testing.assert_array_equal(fit.centres, other.centres)
            np.testing.assert_array_equal(fit.radii, other.radii)

    def test_other_numbers(self):
        per_link = mv.fit_parts(self.parts[:2], count_per_link=5, balls_only=True)
        self.assertEqual(sum(map(len, per_link)), 5)
        self.assertIsNone(per_link[0].spheres_volume)
        each = mv.fit_parts(self.parts[:2], 3, levels=True)
        self.assertEqual([len(fit) for fit in each], [3, 3])
        self.assertEqual([len(level) for level in each[0].levels], [1, 3])
        # The solid is a cylinder that the mesh lies in: its volume counts.
        of_shape = mv.fit_parts([mv.Part(mv.Mesh(*BOX), volume=0.3)], 2)[0]
        self.assertEqual((of_shape.solid_volume, of_shape.of_shape), (0.3, True))
        self.assertAlmostEqual(of_shape.measures.volume.solid, 0.3)

    def test_progress(self):
        stages = set()
        mv.fit_parts(self.parts[:1], 2, balls_only=True, progress=lambda stage, done: stages.add(stage))
        self.assertIn("spheres", stages)

    def test_errors(self):
        for parts, options, message in (
            (self.parts, {"total": 3}, ""),
            ([mv.Part(link="arm", name="nothing")], {"count": 3}, "nothing"),
            ([mv.Part(self.parts[0].mesh, ball=((0, 0, 0), 1), name="both")], {"count": 3}, "both"),
            ([mv.Part(self.parts[0].mesh, pose=2 * np.eye(4))], {"count": 3}, "`pose`"),
            ([mv.Part(self.parts[0].mesh, pose=np.eye(3))], {"count": 3}, "`pose`"),
            ([mv.Part(ball=((0, 0), 1))], {"count": 3}, "`ball`"),
            ([mv.Part(ball=((0, 0, 0), -1), name="ball")], {"count": 3}, "ball"),
            (self.parts, {"count": 0}, ""),
        ):
            with self.assertRaisesRegex(mv.errors.UsageError, message):
                mv.fit_parts(parts, **options)

    @unittest.skipUnless(TOOL, "MEDIAL_VK_TOOL names no tool")
    def test_same_as_the_tool(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, (vertices, triangles) in (("box", BOX), ("ring", RING)):
                lines = [f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()]
                lines += [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles.tolist()]
                (Path(folder) / f"{name}.obj").write_text("".join(lines))
            (Path(folder) / "arm.urdf").write_text(URDF)
            command = [TOOL, "spheres", "arm.urdf", "--total", "16", "--quiet", "-o", "arm.csv"]
            subprocess.run(command, check=True, cwd=folder)
            rows = [line.split(",") for line in (Path(folder) / "arm.csv").read_text().splitlines()[1:]]
        own = [(part.link, *ball) for part, fit in zip(self.parts, self.fits) for ball in np.column_stack([fit.centres, fit.radii]).tolist()]
        self.assertEqual([(row[0], *map(float, row[1:])) for row in rows], own)


class Groups(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # Three links; the last has two boxes.
        cls.bodies = [mv.Body(mv.Mesh(*shapes.box((1, 1, 1)))), mv.Body(mv.Mesh(*RING)), mv.Body(mv.Mesh(*BOX))]
        cls.at = [np.eye(4), np.eye(4), shapes.pose((0, 0, 1.0)), shapes.pose((0.2, 0, -0.7), 0.5)]
        cls.group = mv.BodyGroup([*cls.bodies, cls.bodies[2]], [0, 1, 2, 2], poses=cls.at)
        rng = np.random.default_rng(3)
        cls.poses = np.stack([[shapes.pose(rng.normal(scale=2, size=3), rng.normal()) for _ in range(3)] for _ in range(12)])

    def by_pairs(self, poses, find):
        """Of all pairs of bodies on different links."""
        bodies, links = [*self.bodies, self.bodies[2]], [0, 1, 2, 2]
        lower, upper = np.full(len(poses), np.inf), np.full(len(poses), np.inf)
        for i in range(4):
            for j in range(i):
                if links[i] == links[j]:
                    continue
                placed = [poses[:, links[k]] @ self.at[k] for k in (i, j)]
                found = find(bodies[i], bodies[j], mv.rigid_pose(np.linalg.inv(placed[0]) @ placed[1]))
                lower, upper = np.minimum(lower, found.lower), np.minimum(upper, found.upper)
        return lower, upper

    def test_boxes_at_a_known_distance(self):
        group = mv.BodyGroup([self.bodies[0]] * 3, [0, 1, 2], [[0, 1], [0, 2]])
        poses = np.stack([shapes.pose(), shapes.pose((1.75, 0, 0)), shapes.pose((0, -3, 0))])
        found = group.least_distances(poses, exact=True)
        self.assertTrue(found.lower[0] <= 0.75 <= found.upper[0])
        self.assertLess(found.upper[0] - found.lower[0], 1e-12)
        self.assertEqual(sorted(found.upper_pairs[0].tolist()), [0, 1])
        self.assertEqual(mv.VERDICTS[found.verdicts[0]], "free")
        # The other two would touch, but are not compared.
        poses[2] = poses[1]
        self.assertEqual(mv.VERDICTS[group.least_distances(poses, exact=True).verdicts[0]], "free")
        poses[1] = shapes.pose((0.5, 0, 0))
        self.assertEqual(mv.VERDICTS[group.least_distances(poses, exact=True, limit=0).verdicts[0]], "hit")
        self.assertEqual(group.least_distances(poses[None]).lower.shape, (1,))

    def test_as_all_pairs(self):
        lower, upper = self.by_pairs(self.poses, mv.distances)
        found = self.group.least_distances(self.poses, exact=True)
        self.assertEqual(len(found), 12)
        self.assertGreater(np.count_nonzero(found.lower > 0), 3)
        # Both intervals hold the distance, for poses that differ by their rounding: some fifty of 2^-53 in products of
        # entries and coordinates below 10.
        self.assertLess(np.abs(self.poses).max(), 10)
        slack = 50 * 2.0**-53 * 100
        self.assertTrue(np.all(found.lower <= upper + slack) and np.all(lower <= found.upper + slack))
        self.assertLess(np.max(found.upper - found.lower), 1e-11)

    def test_threads_start_and_limit(self):
        all_of_them = self.group.least_distances(self.poses, exact=True, threads=1)
        np.testing.assert_array_equal(all_of_them.lower, self.group.least_distances(self.poses, exact=True, threads=3).lower)
        previous = None
        for i, poses in enumerate(self.poses):
            previous = self.group.least_distances(poses, exact=True, start=previous)
            self.assertTrue(previous.lower[0] <= all_of_them.upper[i] and all_of_them.lower[i] <= previous.upper[0])
        near = self.group.least_distances(self.poses, exact=True, limit=0.5)
        far = all_of_them.lower > 0.5
        self.assertTrue(np.all(near.lower[far] >= 0.5))
        np.testing.assert_allclose(near.lower[~far], all_of_them.lower[~far], atol=1e-12)

    def test_by_balls(self):
        box = mv.Mesh(*shapes.box())
        inside, cover = mv.fit_spheres(box, 8, balls_only=True), mv.fit_spheres(box, 8, contract="cover", balls_only=True)
        group = mv.BodyGroup([mv.Body(None, inside, cover)] * 2, [0, 1])
        poses = np.stack([[shapes.pose(), shapes.pose((1.5 + i, 0, 0))] for i in range(3)])
        found = group.least_distances(poses)
        exact = 0.5 + np.arange(3)
        self.assertTrue(np.all(found.lower <= exact) and np.all(exact <= found.upper))
        with self.assertRaises(mv.errors.UsageError):
            group.least_distances(poses, exact=True)

    def test_errors(self):
        one = self.bodies[0]
        for arguments, message in (
            (([one, one], [0]), "`links`"),
            (([one, one], [0, 1.5]), "`links`"),
            (([one, one], [0, -1]), "`links`"),
            (([one, one], [0, 1], [[0, 0]]), ""),
            (([one, one], [0, 1], [[0, 7]]), ""),
            (([one, one], [0, 1], [0, 1]), "`pairs`"),
        ):
            with self.assertRaisesRegex(mv.errors.UsageError, message):
                mv.BodyGroup(*arguments)
        with self.assertRaisesRegex(mv.errors.UsageError, r"\(n, 3, 4, 4\)"):
            self.group.least_distances(np.eye(4)[None])
        with self.assertRaisesRegex(mv.errors.UsageError, "rigid"):
            self.group.least_distances(np.stack([np.eye(4) * 2] * 3))
        with self.assertRaisesRegex(mv.errors.UsageError, "start"):
            self.group.least_distances(self.poses, start=self.group.least_distances(self.poses))


class Starts(unittest.TestCase):
    def test_one_pose_after_another(self):
        mesh = mv.Mesh(*shapes.torus())
        body = mv.Body(mesh, mv.fit_spheres(mesh, 12, balls_only=True), mv.fit_spheres(mesh, 12, contract="cover", balls_only=True))
        bounds = exact = None
        for x in np.linspace(3, 4, 6):
            pose = shapes.pose((x, 0.1, 0.2), x)
            bounds, exact = mv.distance_bounds(body, body, pose, start=bounds), mv.distances(body, body, pose, start=exact)
            without = mv.distances(body, body, pose)
            self.assertTrue(exact.lower <= without.upper and without.lower <= exact.upper)
            self.assertTrue(bounds.lower <= exact.upper and exact.lower <= bounds.upper)
        many = mv.distance_bounds(body, body, [shapes.pose((3, 0, 0))])
        with self.assertRaisesRegex(mv.errors.UsageError, "one pose"):
            mv.distance_bounds(body, body, [pose], start=bounds)
        with self.assertRaisesRegex(mv.errors.UsageError, "one pose"):
            mv.distance_bounds(body, body, pose, start=many)
        # Indices that the bodies do not have are ignored.
        odd = mv.DistanceBounds(lower=0, upper=0, verdicts=0, cover_pairs=(10**6, -7), inside_pairs=(2**40, 0))
        self.assertGreater(mv.distance_bounds(body, body, pose, start=odd).upper, 0)


if __name__ == "__main__":
    unittest.main()
