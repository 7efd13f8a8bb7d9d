"""Hulls of balls against shapes whose measures are known."""

import unittest

import numpy as np
import shapes

import medial_vk as mv


class Hulls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.plate = mv.Mesh(*shapes.box((2, 1.2, 0.1)))
        cls.fit = mv.fit_hulls(cls.plate, 6)

    def test_they_lie_inside_by_proof(self):
        self.assertTrue(self.fit.proof.proved)
        self.assertEqual(len(self.fit), 6)
        self.assertEqual(self.fit.hulls.centres.shape, (6, 3, 3))
        self.assertTrue((self.fit.hulls.counts == 3).all())
        self.assertTrue(mv.prove_hulls(self.plate, self.fit.hulls).proved)
        grown = mv.Hulls(centres=self.fit.hulls.centres, radii=self.fit.hulls.radii + 1e-6, counts=self.fit.hulls.counts)
        proof = mv.prove_hulls(self.plate, grown)
        self.assertFalse(proof.proved)
        self.assertGreaterEqual(proof.greatest_lack, 0.9e-6)

    def test_volumes(self):
        lower, upper = self.fit.covered
        self.assertLessEqual(lower, upper)
        self.assertLess(upper, self.fit.solid_volume)
        self.assertAlmostEqual(self.fit.solid_volume, 0.24)
        self.assertLess(self.fit.uncovered_share[1], 0.5, "six balls would leave 98 %")
        finer = self.fit.hulls.volume(1e-5)
        self.assertLessEqual(finer[1] - finer[0], 1e-5)
        self.assertTrue(finer[0] <= upper and lower <= finer[1])

    def test_distances(self):
        ball = mv.Hulls(centres=np.zeros((1, 3, 3)), radii=np.ones((1, 3)), counts=np.array([1], dtype=np.uint32))
        np.testing.assert_allclose(ball.distances([(3, 0, 0), (0, 0.25, 0)]), [2, -0.75])
        corners = [[[-1, 0, 0], [1, 0, 0], [1, 0, 0]]]
        capsule = mv.Hulls(centres=np.array(corners, dtype=float), radii=np.full((1, 3), 0.5), counts=np.array([2], dtype=np.uint32))
        np.testing.assert_allclose(capsule.distances([(0, 2, 0), (3, 0, 0), (0.3, 0, 0)]), [1.5, 1.5, -0.5])

    def test_kinds(self):
        for kind, count in (("capsules", 2), ("cones", 2), ("balls", 1)):
            fit = mv.fit_hulls(self.plate, 3, kind=kind)
            self.assertTrue((fit.hulls.counts == count).all())
            self.assertTrue(fit.proof.proved)
            if kind == "capsules":
                np.testing.assert_array_equal(fit.hulls.radii[:, 0], fit.hulls.radii[:, 1])

    def test_errors(self):
        for options in ({}, {"count": -1}, {"count": 1.5}, {"count": 2, "kind": "cubes"}, {"error": 1.5}, {"count": 5000}):
            with self.subTest(options), self.assertRaises(mv.errors.UsageError):
                mv.fit_hulls(self.plate, **options)
        wrong = mv.Hulls(centres=np.zeros((1, 3, 3)), radii=np.ones((1, 3)), counts=np.array([4], dtype=np.uint32))
        with self.assertRaisesRegex(mv.errors.UsageError, "hull 0 has 4 balls"):
            mv.prove_hulls(self.plate, wrong)
        short = mv.Hulls(centres=np.zeros((2, 3, 3)), radii=np.ones((2, 3)), counts=np.array([1], dtype=np.uint32))
        with self.assertRaisesRegex(mv.errors.UsageError, "shape"):
            short.distances([(0, 0, 0)])


if __name__ == "__main__":
    unittest.main()
