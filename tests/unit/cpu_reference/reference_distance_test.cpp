// Whether triangles cross, how far they are apart, and which solid holds the other one, where fixed numbers of digits
// do not tell.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "cpu_reference/distance.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Corners;

struct TrianglePair {
  Corners a, b;
  double distance;  // in rational arithmetic
};

Corners turned(const Corners& t, std::size_t by) { return {t[by % 3], t[(by + 1) % 3], t[(by + 2) % 3]}; }

/// In every order of the triangles and of the corners of one, up to the roundings that the soak of distances allows.
void expect_distance(const TrianglePair& pair) {
  double size = 0;
  for (const Corners* t : {&pair.a, &pair.b}) {
    for (const Vector3d& corner : *t) size = std::max(size, corner.norm());
  }
  for (std::size_t by = 0; by < 3; ++by) {
    for (const double found : {reference::nearest_of_triangles(turned(pair.a, by), pair.b).distance,
                               reference::nearest_of_triangles(pair.b, turned(pair.a, by)).distance}) {
      if (pair.distance == 0) {
        EXPECT_EQ(found, 0);
      } else {
        EXPECT_NEAR(found, pair.distance, 64 * 0x1p-53 * size);
        EXPECT_GT(found, 0);
      }
    }
  }
}

// Pairs of meshes with needles and of soups, at a distance of 10^3 roundings and more (seeds 5137217, 6209567 twice,
// and 6214283 of soak_distances): in 64 bits, edges beside a sliver seem to cross it.
TEST(ReferenceDistance, OfSliversThatMissEachOther) {
  const std::vector<TrianglePair> pairs = {
      {{Vector3d(-0x1.63e68p-37, 0x1.62502p-35, -0x1.217d48p-35),
        Vector3d(0x1.004237fc4a99fp-63, 0x1.36c5bee012912p-60, 0x1.aae240bbbeb86p-65),
        Vector3d(0x1.2e9ce10ad314p-62, 0x1.f37a9d34649efp-62, -0x1.4a65c1fdf4081p-66)},
       {Vector3d(-0x1.754dd4c68c24p-5, 0x1.53d32fd8b1c28p-7, 0x1.5d1c796848ap-6),
        Vector3d(0x1.6d05f01d4cb55p-1, -0x1.7fc906c2c4378p-5, -0x1.06faaaf8edb4p-6),
        Vector3d(0x1.aeeaa55fe754ap-1, -0x1.88454823b2dc2p-3, -0x1.92fd757ec64f4p-2)},
       5.1417016657716985e-11},
      {{Vector3d(0x1.1c62808738012p-12, 0x1.dbbe04cc54874p-3, 0x1.105c98f5deb7p-2),
        Vector3d(0x1.2ebddf8df4d16p-60, 0x1.fe2792aaa0002p-63, 0x1.240f60d6cc621p-62),
        Vector3d(0x1.b52ep-39, -0x1.049c2p-36, 0x1.c07e08p-35)},
       {Vector3d(0x1.4e68988ef3104p-39, 0, 0),
        Vector3d(0x1.ec3f0e91c026dp-6, -0x1.e930c9685fd2fp-1, -0x1.2caa66e824941p-2),
        Vector3d(-0x1.b9b90d93f2fc2p-2, -0x1.14cfe1201bdd8p0, 0x1.194ed0d31e77p-4)},
       2.168302391100002e-12},
      {{Vector3d(-0x1.2bba29b633465p-2, 0x1.13a3c14a47dbcp-3, -0x1.30df5baf89162p-2),
        Vector3d(0x1.2e9ce10ad314p-62, 0x1.f37a9d34649efp-62, -0x1.4a65c1fdf4081p-66),
        Vector3d(-0x1.63e68p-37, 0x1.62502p-35, -0x1.217d48p-35)},
       {Vector3d(0x1.05890181aa4edp-1, -0x1.543a2a33daa2ap-3, 0x1.2f8a5fde4e528p-1),
        Vector3d(0x1.4e68988ef3104p-39, 0, 0),
        Vector3d(-0x1.d87cfe7d048b5p-2, -0x1.01bbe35f5f9fdp-3, 0x1.72fe1b1cec31ep-2)},
       1.5188609160497468e-12},
      {{Vector3d(0x1.046a9907ee9eap-2, 0x1.1fc2e9a2ea149p-2, 0x1.05e84054b159ap-3),
        Vector3d(-0x1.07647e259bb35p-1, 0x1.ca01e7dacbdf4p-1, 0x1.3bda0de446e8p-2),
        Vector3d(-0x1.13cf88b5235ep-1, 0x1.896450cca643p-1, 0x1.449be6a2e1374p-1)},
       {Vector3d(-0x1.2408145eb69a4p-2, -0x1.c1dae530e7eabp-3, -0x1.134062e582744p-1),
        Vector3d(0x1.08b80e97b3dc6p-2, 0x1.23c119e1ac66p-2, 0x1.1085996f9496cp-3),
        Vector3d(0x1.3499ec010f7p-8, 0x1.947e65456163p-5, -0x1.70a7d583a4c7p-3)},
       2.8960574095147672e-13},
  };
  for (const TrianglePair& pair : pairs) expect_distance(pair);
}

// A sliver passes through a triangle of its width, and an edge through a triangle that is all but a line.
TEST(ReferenceDistance, OfSliversThatCross) {
  const std::vector<TrianglePair> pairs = {
      {{Vector3d(0x1.8cb5d7b0de672p-22, 0x1.0ba37269ca542p-22, 0x1.1e351fa2ef67fp-21),
        Vector3d(0x1.23d9c4c5942a6p-21, 0x1.e08884156b318p-22, -0x1.97b9d38bef995p-21),
        Vector3d(0x1.588f53b3fa283p-23, -0x1.9a615449aee69p-21, -0x1.8b6db4f99c21p-22)},
       {Vector3d(-0x1.d7d601945b03ap-2, -0x1.2007db9929e29p-2, -0x1.aefba14f7ef41p-1),
        Vector3d(0x1.087a49e1f36efp-3, 0x1.42e51ae858386p-4, 0x1.e32717aa5d09dp-3),
        Vector3d(0x1.d7d6023608e0fp-2, 0x1.2008240a8a29p-2, 0x1.aefba7c0da134p-1)},
       0},
      {{Vector3d(-0x1.3815ba856e8d7p-1, 0x1.1d97080f55738p-1, 0x1.4ff96f2400d55p-1),
        Vector3d(0x1.b677fb78f077bp-3, 0x1.77416eaab4c17p-1, -0x1.6a6019b6b0effp-1),
        Vector3d(0x1.ac2555b741025p-2, 0x1.8d77491362d2cp-1, -0x1.0bada831f43dfp0)},
       {Vector3d(-0x1.880c3358ec9aap-4, 0x1.55871fcc93da5p-1, -0x1.8ec3b32f4ae72p-3),
        Vector3d(-0x1.880c75a451371p-4, 0x1.558726f026a0dp-1, -0x1.8ec3be0ae841cp-3),
        Vector3d(-0x1.880c33dc5bb11p-4, 0x1.5587233a3b3e6p-1, -0x1.8ec3d915381a3p-3)},
       0},
  };
  for (const TrianglePair& pair : pairs) expect_distance(pair);
}

// With a corner on the face, through it and above it by less than any rounding, and with an edge in its plane.
TEST(ReferenceDistance, OfTouchingTriangles) {
  const Corners face = {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};
  const auto at_height = [](double z) {
    return Corners{Vector3d(0.25, 0.25, z), Vector3d(0.25, 0.5, 1), Vector3d(0.5, 0.25, 1)};
  };
  expect_distance({face, at_height(0), 0});
  expect_distance({face, at_height(-0x1p-1000), 0});
  EXPECT_EQ(reference::nearest_of_triangles(face, at_height(0x1p-500)).distance, 0x1p-500);
  expect_distance({face, {Vector3d(0.5, -1, 0), Vector3d(0.5, 0.25, 0), Vector3d(2, 3, 0)}, 0});
}

/// A solid of some number of triangles.
reference::Mesh closed_mesh(std::vector<Vector3d> vertices, std::vector<Eigen::Vector3i> triangles) {
  return {std::move(vertices), std::move(triangles), {}, true};
}

/// The first corner decides whether another solid holds this one.
reference::Mesh tetrahedron(const Vector3d& p, const Vector3d& q, const Vector3d& r, const Vector3d& s) {
  return closed_mesh({p, q, r, s}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

/// The eight corners are those of a box: four around a face, and those across it.
reference::Mesh box_of(const std::vector<Vector3d>& corners) {
  return closed_mesh(corners, {{0, 1, 2},
                               {0, 2, 3},
                               {4, 5, 6},
                               {4, 6, 7},
                               {0, 3, 5},
                               {0, 5, 4},
                               {3, 2, 6},
                               {3, 6, 5},
                               {2, 1, 7},
                               {2, 7, 6},
                               {1, 0, 4},
                               {1, 4, 7}});
}

// A corner is 3.2e-13 from an edge of the rim of a film, which is 1 long and 1e-7 wide, and in front of the rim and of
// a face (seed 30243455 of soak_distances, by rational arithmetic). The volume of the corner and a triangle of the rim
// is 3.2e-20, less than the rounding of its terms, so that solid angles in double do not tell on which side it is.
TEST(ReferenceDistance, OfASolidBesideTheRimOfAFilm) {
  const reference::Mesh film =
      box_of({Vector3d(0, 0, 0), Vector3d(-0x1.ee8503a7ec44cp-2, 0x1.a9ffda8bb2769p-1, 0x1.1781ddd30b78dp-2),
              Vector3d(0x1.31e1015ce3bc5p-2, 0x1.61d468e0b09b2p+0, -0x1.5816d7622dc7p-6),
              Vector3d(0x1.9033028268009p-1, 0x1.19a8f735aebfcp-1, -0x1.2d034b492e554p-2),
              Vector3d(0x1.531433197bf82p-25, -0x1.ea9b0360a66c4p-28, 0x1.896cebf63d3a6p-24),
              Vector3d(0x1.903303d57c33ap-1, 0x1.19a8f6f85b5f5p-1, -0x1.2d0345237aa56p-2),
              Vector3d(0x1.31e104030c228p-2, 0x1.61d468c206eafp+0, -0x1.58167506f2c9p-6),
              Vector3d(-0x1.ee850101c3de9p-2, 0x1.a9ffda4e5f162p-1, 0x1.1781e3f8bf28ap-2)});
  reference::Motion motion;
  motion.rotation << 0x1.15e46dfe1f544p-2, -0x1.e708be56e2a95p-1, -0x1.2c4901baaa70cp-3, -0x1.95f94e38946a7p-1,
      -0x1.3ab055f7ceda8p-2, 0x1.0d645091a9e22p-1, -0x1.17538a8c315fdp-1, -0x1.b29fa8258facp-6, -0x1.ace0c3e157e14p-1;
  motion.shift = Vector3d(0x1.e5e134baf38cep-3, -0x1.117110751cfp-4, -0x1.9bfd41da25ep-9);
  const reference::Mesh outside = tetrahedron({0, 0, 0}, {0.02, 0.05, 0}, {0, 0.05, 0.02}, {-0.01, 0.05, 0});
  const reference::NearestPair nearest = reference::nearest_of_meshes(outside, film, motion);
  EXPECT_NEAR(nearest.distance, 3.25e-13, 1e-14);
  EXPECT_FALSE(reference::one_holds_the_other(outside, film, motion));
  // As far behind the edge.
  const Vector3d corner = 2 * nearest.on_b - nearest.on_a, inwards = (nearest.on_b - nearest.on_a).normalized();
  const auto at = [&](const Vector3d& beside) { return Vector3d(corner + 1e-8 * (inwards + 0.1 * beside)); };
  const reference::Mesh inside = tetrahedron(corner, at({1, 0, 0}), at({0, 1, 0}), at({0, 0, 1}));
  EXPECT_GT(reference::nearest_of_meshes(inside, film, motion).distance, 0);
  EXPECT_TRUE(reference::one_holds_the_other(inside, film, motion));
}

// The transpose of a rotation that is one to within 1e-12 is its inverse only to within as much.
TEST(ReferenceDistance, OfASolidWithinOneThatAnUnevenRotationStretches) {
  const reference::Mesh box = box_of({Vector3d(0, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 1, 0), Vector3d(1, 0, 0),
                                      Vector3d(0, 0, 1), Vector3d(1, 0, 1), Vector3d(1, 1, 1), Vector3d(0, 1, 1)});
  const reference::Motion stretch = {(1 + 4e-13) * Eigen::Matrix3d::Identity(), Vector3d::Zero()};
  const reference::Mesh inside = tetrahedron({1 + 2e-13, 0.5, 0.5}, {0.5, 0.6, 0.5}, {0.5, 0.5, 0.6}, {0.5, 0.4, 0.4});
  EXPECT_TRUE(reference::one_holds_the_other(inside, box, stretch));
}

}  // namespace
}  // namespace medial_vk
