// Certified extraction on the device, in float, against the independent reference in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "mesh/winding/winding_number.h"
#include "reference_bridge/reference_bridge.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

struct Solid {
  const char* name;
  Mesh (*make)();
};

const Solid kSolids[] = {
    {"box",
     [] {
       return test::make_box({1, 0.7, 0.5});
     }},
    {"sphere", [] { return test::make_sphere(1, 2000); }},
    {"capsule", [] { return test::make_capsule(0.4, 1.5, 48); }},
    {"oblate_ellipsoid",
     [] {
       return test::make_ellipsoid({1, 1, 0.4}, 60);
     }},
    {"triaxial_ellipsoid",
     [] {
       return test::make_ellipsoid({1, 0.6, 0.35}, 60);
     }},
    {"l_shape", [] { return test::make_l_shape(1, 0.35, 0.4); }},
    {"cup", [] { return test::make_cup(1, 0.25, 1.2, 48); }},
    {"flat_torus", [] { return test::make_torus(1, 0.4, 40, 80, 0.5); }},
    {"plate_with_hole", [] { return test::make_plate_with_hole(1, 0.2, 0.4); }},
};

// The voxels on which the two must agree: those whose point is clearly salient (object angle 0.05 above the threshold:
// far more than float changes) and clearly inside its voxel (5 % of the side; rounding moves points by 1e-4 of it).
struct Missing {
  std::size_t firm = 0;
  std::size_t clear = 0;
};

// A point may represent a medial point within epsilon of it (Lemma 2.3), which may lie in the next voxel or have an
// angle below the threshold. The others are firm.
Missing missing_from(const Extraction& there, const Extraction& here, const ExtractionOptions& options) {
  const test::SphereByVoxel found = test::spheres_by_voxel(there);
  Missing missing;
  for (const auto& [voxel, index] : test::spheres_by_voxel(here)) {
    if (found.contains(voxel)) continue;
    const MedialSphere& s = here.spheres[index];
    const bool salient = static_cast<double>(s.object_angle) >= options.object_angle + 0.05;
    const double depth = test::depth_in_voxel(here.grid, test::to_eigen(s.centre));
    missing.firm += salient && depth > options.epsilon;
    missing.clear += salient && depth >= 0.05;
  }
  return missing;
}

// The rule. A voxel in which only one of the two found a firm point was not dismissed by the other one (dismissal is
// proved on both sides), so the other one counts it as undecided: there are never more missing than undecided voxels.
// Searches are tried in different orders, so some may differ; but of the clear ones at most one in 200, and one.
void expect_explained(const Missing& missing, std::uint64_t undecided, std::size_t points) {
  EXPECT_LE(missing.firm, undecided);
  EXPECT_LE(missing.clear, 1 + points / 200);
}

// Sums over levels that a lost or doubled cell would break.
void expect_consistent(const CertifiedExtraction& result, const ExtractionOptions& options, bool closed) {
  const ExtractionCounters& c = result.extraction.measurements.counters;
  ASSERT_GT(c.levels.size(), options.extra_levels);
  const std::size_t finest = c.levels.size() - 1 - options.extra_levels;
  std::uint64_t found = 0;
  for (std::size_t level = 0; level < c.levels.size(); ++level) {
    EXPECT_LE(c.levels[level].kept, c.levels[level].visited) << "level " << level;
    EXPECT_GE(c.levels[level].contacts, c.levels[level].kept) << "every kept cell has a nearest triangle";
    found += c.levels[level].found;
    EXPECT_GE(c.levels[level].lines, c.levels[level].found) << "level " << level;
    if (level < finest) {
      EXPECT_EQ(c.levels[level].found, 0u);
      EXPECT_EQ(c.levels[level].lines, 0u);
    }
    if (level == 0) continue;
    // Eight children test every contact of their parent.
    const std::uint64_t tests = c.levels[level].triangle_tests + c.levels[level].cluster_tests;
    if (level <= finest) {
      EXPECT_GE(tests, 8 * c.levels[level - 1].contacts) << "level " << level;
    }
    if (c.levels[level].cluster_tests > 0) {
      EXPECT_EQ(c.levels[level].cluster_tests, 8 * c.levels[level - 1].contacts) << "level " << level;
    }
    // Parts of a voxel are examined until it has a point, and a point drops all remaining parts.
    const std::uint64_t most = 8 * (c.levels[level - 1].kept - c.levels[level - 1].found);
    EXPECT_LE(c.levels[level].visited, most) << "level " << level;
  }
  // Some top cells of a solid are clear of its boundary: their sides are computed with the tree. Flux uses the list:
  // every sample of every point has a nearest triangle.
  if (closed) {
    EXPECT_GT(c.levels[0].node_tests, 0u);
  }
  EXPECT_GE(c.levels[finest].triangle_tests, 48 * c.found);
  EXPECT_EQ(found, c.found + result.certificate.rejected);
  EXPECT_EQ(c.found, result.extraction.spheres.size());
  EXPECT_EQ(result.certificate.passed, result.extraction.spheres.size());
  // A cell of each undecided voxel is kept at every level up to the one at which it is given up: the last one, or, of
  // cells below 1/4096 of the longest side that can hold no points but those near a face or at the threshold, an
  // earlier one if their voxel has many. Where the boundary has no trusted normals, cells are given up even earlier,
  // but none at the finest level.
  std::size_t giving_up = finest;
  for (double side = 1.0 / options.resolution; giving_up + 1 < c.levels.size() && side >= 1.0 / 4096; side /= 2) {
    ++giving_up;
  }
  const std::uint64_t left = c.levels[closed ? giving_up : finest + 1].kept;
  EXPECT_LE(c.undecided, left + result.certificate.rejected);
}

class CertifiedOnDevice : public testing::TestWithParam<Solid> {};

CertifiedExtraction expect_agreement_of_axis_aligned(Mesh solid, std::uint32_t resolution) {
  const PreparedMesh mesh = test::prepare(std::move(solid));
  ExtractionOptions options;
  options.resolution = resolution;
  Context& context = test::quick_device();
  CertifiedExtraction device = test::extract_on_device(context, mesh, options);
  const Extraction reference = from_reference(test::extract_with_reference(mesh, options));
  SCOPED_TRACE(test::describe(device));
  EXPECT_FALSE(device.extraction.spheres.empty());
  EXPECT_TRUE(test::passes_certificate(mesh, device.extraction, options));
  EXPECT_TRUE(test::passes_certificate(mesh, reference, options));
  EXPECT_EQ(device.extraction.grid.size, reference.grid.size);
  // Balls that the device accepted and double precision rejected are rare, since only rounding causes them.
  EXPECT_LE(device.certificate.rejected, device.extraction.spheres.size() / 100);

  const std::size_t points = reference.spheres.size();
  {
    SCOPED_TRACE("found by the reference only");
    expect_explained(missing_from(device.extraction, reference, options),
                     device.extraction.measurements.counters.undecided, points);
  }
  {
    SCOPED_TRACE("found by the device only");
    expect_explained(missing_from(reference, device.extraction, options), reference.measurements.counters.undecided,
                     points);
  }
  expect_consistent(device, options, mesh.report.closed);
  return device;
}

// Turned so that nothing lies along the axes.
CertifiedExtraction expect_agreement(Mesh solid, std::uint32_t resolution) {
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  return expect_agreement_of_axis_aligned(std::move(solid), resolution);
}

TEST_P(CertifiedOnDevice, AgreesWithTheReference) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_agreement(GetParam().make(), 33);  // odd: the centre of symmetric solids is the middle of a voxel
}

INSTANTIATE_TEST_SUITE_P(Solids, CertifiedOnDevice, testing::ValuesIn(kSolids),
                         [](const auto& solid) { return std::string(solid.param.name); });

// Triangles so small that the lists of large cells hold clusters.
TEST(CertifiedClusters, AgreesWithTheReferenceWhereListsHoldClusters) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const CertifiedExtraction result = expect_agreement(test::make_torus(1.0, 0.4, 80, 160, 0.5), 65);
  EXPECT_GT(result.extraction.measurements.counters.levels[0].cluster_tests, 0u);
  EXPECT_GT(result.extraction.measurements.counters.levels[1].triangle_tests, 0u);
  // Rounding leaves no more voxels undecided than the reference does, in double: none (docs/theory.md, "Rounding").
  EXPECT_LE(result.extraction.measurements.counters.undecided, 1u);
}

// The middle sheet of this box lies in faces of voxels; the others run along diagonals, and touch the voxels beside
// these along edges. docs/theory.md, "How far to narrow": both voxels beside a face get their point, without cells as
// small as epsilon. Sheets at 45 degrees may be salient by their radius only.
TEST(CertifiedFaces, HoldSheetsThatAreFoundAtOnce) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = test::prepare(test::make_box({2, 1, 0.5}));
  Context& context = test::quick_device();
  struct Case {
    double angle, radius;
    std::size_t levels;  // below the finest that are visited, at most
  };
  for (const Case& c : {Case{0.15, 0, 1}, Case{0.3, 0, 1}, Case{0.6, 0, 1}, Case{1.0, 0.05, 2}}) {
    ExtractionOptions options;
    options.resolution = 32;
    options.object_angle = c.angle;
    options.radius = c.radius;
    const CertifiedExtraction device = test::extract_on_device(context, mesh, options);
    const Extraction reference = from_reference(test::extract_with_reference(mesh, options));
    SCOPED_TRACE(test::describe(device));
    EXPECT_EQ(missing_from(reference, device.extraction, options).firm, 0u);
    EXPECT_EQ(missing_from(device.extraction, reference, options).firm, 0u);
    const ExtractionCounters& counters = device.extraction.measurements.counters;
    EXPECT_EQ(counters.undecided, 0u);
    EXPECT_EQ(counters.found, reference.spheres.size());
    const std::size_t finest = counters.levels.size() - 1 - options.extra_levels;
    EXPECT_EQ(counters.levels[finest + 1 + c.levels].visited, 0u);
    EXPECT_TRUE(test::passes_certificate(mesh, device.extraction, options));
    // The middle sheet is at the height of 4 voxels: as many points below as above.
    const auto in_layer = [&](std::uint32_t z) {
      return std::ranges::count_if(device.extraction.spheres, [z](const MedialSphere& s) { return s.voxel[2] == z; });
    };
    EXPECT_GT(in_layer(3), 200);
    EXPECT_EQ(in_layer(3), in_layer(4));
  }
}

// A tenth of its triangles are missing, in three regions: sides follow from open edges.
Mesh torus_with_holes() {
  Mesh torus = test::make_torus(1.0, 0.4, 16, 32, 0.5);
  std::erase_if(torus.triangles, [i = 0](const Triangle&) mutable { return ++i % 341 < 34; });
  return torus;
}

TEST(CertifiedOpen, AgreesWithTheReference) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_agreement(torus_with_holes(), 17);
}

// Two boxes that cross, without two of their triangles.
TEST(CertifiedOpen, CrossingBoxesAgreeWithTheReference) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh mess = test::make_box({1, 0.6, 0.5}), other = test::make_box({0.4, 0.5, 1});
  test::rotate(other, {0.5, 0.2, -0.3}, 0.6);
  test::append(mess, other);
  std::erase_if(mess.triangles, [i = 0](const Triangle&) mutable { return ++i % 12 == 7; });
  expect_agreement(mess, 24);
}

void expect_points_inside(Mesh open, std::uint32_t resolution) {
  const PreparedMesh mesh = test::prepare(std::move(open));
  ASSERT_FALSE(mesh.report.closed);
  ExtractionOptions options;
  options.resolution = resolution;
  Context& context = test::quick_device();
  const CertifiedExtraction result = test::extract_on_device(context, mesh, options);
  EXPECT_GT(result.extraction.spheres.size(), 50u);
  for (const MedialSphere& s : result.extraction.spheres) EXPECT_GE(exact_winding_number(mesh.mesh, s.centre), 0.5);
}

TEST(CertifiedOpen, PointsHaveWindingNumbersOfAHalfOrMore) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_points_inside(torus_with_holes(), 24);
}

// The plane of a rim passes through centres of cells, and so do the triangles that close it.
TEST(CertifiedOpen, ARimInThePlaneOfCellCentres) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh box = test::make_box({1, 1, 0.5});
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return box.vertices[v][2] == 0.5; });
  });
  ASSERT_EQ(box.triangles.size(), 10u);
  expect_points_inside(box, 33);
  expect_agreement_of_axis_aligned(box, 33);
}

// A quarter of its triangles are missing, one by one: too many open edges to list.
TEST(CertifiedOpen, MoreOpenEdgesThanAreListed) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh torus = test::make_torus(1.0, 0.4, 80, 160, 0.5);
  std::erase_if(torus.triangles, [i = 0](const Triangle&) mutable { return ++i % 4 == 0; });
  expect_points_inside(std::move(torus), 16);
}

// A radius threshold keeps deep points of smaller object angle too.
TEST(CertifiedRadius, DeepPointsPassTheCertificate) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_l_shape(1, 0.35, 0.4);
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(std::move(solid));
  ExtractionOptions options;
  options.resolution = 24;
  options.object_angle = 1.2;  // above the bisectors of right angles: those come in by their radius only
  Context& context = test::quick_device();
  const CertifiedExtraction by_angle = test::extract_on_device(context, mesh, options);
  options.radius = 0.05;
  const CertifiedExtraction by_both = test::extract_on_device(context, mesh, options);
  EXPECT_TRUE(test::passes_certificate(mesh, by_both.extraction, options));
  const double least = options.radius * mesh.report.longest_side();
  std::size_t deep = 0;
  for (const MedialSphere& s : by_both.extraction.spheres) {
    if (static_cast<double>(s.object_angle) >= options.object_angle) continue;
    ++deep;
    EXPECT_GE(s.radius, least * (1 - 1e-9));
  }
  EXPECT_GT(deep, 50u);
  EXPECT_GT(by_angle.extraction.spheres.size(), 50u);
}

}  // namespace
}  // namespace medial_vk
