// Solids whose sheets are known: each sheet is named by the two parts of the boundary that its balls touch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "medial_vk/medial_mesh.h"
#include "medial_vk/sheets.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Part {
  std::string name;
  std::function<double(const Vector3d&)> distance;
};

struct KnownSolid {
  std::string name;
  Mesh mesh;
  std::vector<Part> parts;
  std::set<std::string> sheets;  ///< "part part", names ascending.
  BettiNumbers betti;
};

std::function<double(const Vector3d&)> wall(int axis, double at) {
  return [=](const Vector3d& p) { return std::abs(p[axis] - at); };
}

/// The six walls of [0, x] x [0, y] x [0, z].
std::vector<Part> walls_of_box(double x, double y, double z) {
  return {{"left", wall(0, 0)}, {"right", wall(0, x)},  {"front", wall(1, 0)},
          {"back", wall(1, y)}, {"bottom", wall(2, 0)}, {"top", wall(2, z)}};
}

/// z < x, y: the middle between bottom and top, and a bisector for each of the twelve edges.
std::set<std::string> sheets_of_box() {
  return {"bottom top", "bottom left", "bottom right", "bottom front", "back bottom", "left top",  "right top",
          "front top",  "back top",    "front left",   "back left",    "front right", "back right"};
}

KnownSolid box() {
  return {"box", test::make_box({1, 0.75, 0.5}), walls_of_box(1, 0.75, 0.5), sheets_of_box(), {1, 0, 0}};
}

/// Arms 0.35 thick and 1 long, 0.5 high: nowhere does a ball touch bottom and top, as the largest, at the corner, has
/// the radius 0.35 (2 - sqrt(2)) = 0.205. Each arm has a middle sheet; they meet that of the outer corner where a ball
/// touches both outer walls and the reflex edge. The two inner walls and the reflex edge between them are one part:
/// spokes turn from one wall to the other without a jump. Both ends have a bisector with each adjacent wall, and bottom
/// and top have one with every other part.
KnownSolid l_shape() {
  const auto inner = [](const Vector3d& p) {
    const Vector3d q(std::max(p.x(), 0.35), std::max(p.y(), 0.35), 0);
    return std::min(std::hypot(p.x() - 0.35, p.y() - q.y()), std::hypot(p.x() - q.x(), p.y() - 0.35));
  };
  return {"l_shape",
          test::make_l_shape(1, 0.35, 0.5),
          {{"left", wall(0, 0)},
           {"front", wall(1, 0)},
           {"inner", inner},
           {"end_x", wall(0, 1)},
           {"end_y", wall(1, 1)},
           {"bottom", wall(2, 0)},
           {"top", wall(2, 0.5)}},
          {"inner left", "front inner", "front left", "end_x front", "end_x inner", "end_y left", "end_y inner",
           "bottom left", "bottom front", "bottom inner", "bottom end_x", "bottom end_y", "left top", "front top",
           "inner top", "end_x top", "end_y top"},
          {1, 0, 0}};
}

/// The sides of a square with its lower left corner at (x, y), from bottom to top.
std::function<double(const Vector3d&)> hole(double x, double y, double side) {
  return [=](const Vector3d& p) {
    return std::abs(std::max(std::abs(p.x() - x - side / 2), std::abs(p.y() - y - side / 2)) - side / 2);
  };
}

/// The middle, a ring; bisectors of the four outer walls with each other, with bottom and with top; and one bisector of
/// each of these with the four walls of the hole, whose edges are reflex: spokes turn around them without a jump.
KnownSolid plate_with_hole() {
  KnownSolid plate = {"plate_with_hole",
                      test::make_plate_with_hole(1, 0.15, 0.4),
                      walls_of_box(1, 1, 0.15),
                      sheets_of_box(),
                      {1, 1, 0}};
  plate.parts.push_back({"hole", hole(0.3, 0.3, 0.4)});
  plate.sheets.insert({"bottom hole", "hole top"});
  return plate;
}

/// Two holes, with bars around and between them that are twice as wide as they are thick: one middle around both.
KnownSolid plate_with_two_holes() {
  KnownSolid plate = {"plate_with_two_holes",
                      test::make_plate_with_two_holes(0.4, 0.2),
                      walls_of_box(2, 1.2, 0.2),
                      sheets_of_box(),
                      {1, 2, 0}};
  plate.parts.push_back({"hole_1", hole(0.4, 0.4, 0.4)});
  plate.parts.push_back({"hole_2", hole(1.2, 0.4, 0.4)});
  plate.sheets.insert({"bottom hole_1", "bottom hole_2", "hole_1 top", "hole_2 top"});
  return plate;
}

std::string part_at(const KnownSolid& solid, const Vector3d& p) {
  return std::ranges::min_element(solid.parts, {}, [&](const Part& part) { return part.distance(p); })->name;
}

std::string name_of(const KnownSolid& solid, const MedialSphere& s, const Matrix3d& to_body) {
  const Vector3d centre = test::to_eigen(s.centre);
  const auto contact = [&](const std::array<float, 3>& spoke) {
    return part_at(solid, to_body * (centre + s.radius * Vector3d(spoke[0], spoke[1], spoke[2])));
  };
  const auto [a, b] = std::minmax({contact(s.spoke_a), contact(s.spoke_b)});
  return a + " " + b;
}

MedialTopology topology_of_mesh(const Extraction& extraction, const Sheets& sheets, const ExtractionOptions& options) {
  const double voxel = extraction.grid.voxel_size;
  return make_medial_mesh(extraction.spheres, sheets, {voxel, options.epsilon * voxel, 0}).value().topology;
}

class KnownSheets : public testing::TestWithParam<KnownSolid (*)()> {};

// Turned, so that no sheet lies along the voxels.
TEST_P(KnownSheets, EachIsFoundOnceAndNothingElse) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  KnownSolid solid = GetParam()();
  const Vector3d axis(0.3, 0.5, 0.8);
  const double angle = 0.7;
  test::rotate(solid.mesh, {axis.x(), axis.y(), axis.z()}, angle);
  const Matrix3d to_body = Eigen::AngleAxisd(-angle, axis.normalized()).toRotationMatrix();
  Context& context = test::quick_device();
  ExtractionOptions options;
  options.resolution = 80;
  const Extraction extraction = test::extract_on_device(context, test::prepare(solid.mesh), options).extraction;
  const Sheets sheets = find_sheets(extraction.spheres, extraction.grid, options, SheetOptions()).value();

  std::vector<std::map<std::string, std::uint64_t>> names(sheets.sheets.size());
  for (std::size_t i = 0; i < extraction.spheres.size(); ++i) {
    ++names[static_cast<std::size_t>(sheets.of_point[i])][name_of(solid, extraction.spheres[i], to_body)];
  }
  std::multiset<std::string> found;
  for (std::size_t sheet = 0; sheet < names.size(); ++sheet) {
    const auto most = std::ranges::max_element(names[sheet], {}, [](const auto& entry) { return entry.second; });
    // Where three sheets meet, a point may touch the parts of either.
    EXPECT_GT(static_cast<double>(most->second), 0.95 * static_cast<double>(sheets.sheets[sheet].points))
        << "sheet " << sheet << ", " << most->first;
    found.insert(most->first);
  }
  EXPECT_EQ(found, std::multiset<std::string>(solid.sheets.begin(), solid.sheets.end()));
  const MedialTopology topology = topology_of_mesh(extraction, sheets, options);
  EXPECT_EQ(topology.betti, solid.betti);
  EXPECT_EQ(topology.bare_edges, 0u);
}

INSTANTIATE_TEST_SUITE_P(Solids, KnownSheets, testing::Values(&box, &l_shape, &plate_with_hole, &plate_with_two_holes),
                         [](const auto& solid) { return solid.param().name; });

// The bisector of an edge of length l in a box of least side a ends where the balls have the radius a/2: a trapezium of
// area (l - a/2) a / sqrt(2). The middle sheet is the remainder of the rectangle between.
TEST(KnownAreas, OfABox) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_box({1, 0.75, 0.5});
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  Context& context = test::quick_device();
  ExtractionOptions options;
  options.resolution = 80;
  const Extraction extraction = test::extract_on_device(context, test::prepare(solid), options).extraction;
  const Sheets sheets = find_sheets(extraction.spheres, extraction.grid, options, SheetOptions()).value();
  double area = 0, exact = (1 - 0.5) * (0.75 - 0.5);
  for (const Sheet& sheet : sheets.sheets) area += sheet.area;
  for (const double edge : {1.0, 0.75, 0.5}) exact += 4 * (edge - 0.25) * 0.5 / std::sqrt(2.0);
  // Half of a voxel at a rim counts, which is right on average. A voxel at a seam counts for one of three sheets, each
  // of which has half of it on average, so that up to half a voxel is missing along the seams: from the eight corners
  // to the middle, and around the middle.
  const double seams = 8 * 0.25 * std::sqrt(3.0) + 2 * (1 - 0.5) + 2 * (0.75 - 0.5);
  EXPECT_LT(area, exact);
  EXPECT_GT(area, exact - 0.5 * extraction.grid.voxel_size * seams);
}

// A torus whose tube is an ellipse with semi-axes 0.4 and 0.2: one sheet in its plane, a ring, although a mesh of flat
// facets represents it.
TEST(KnownSheetsOfATorus, OneRing) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_torus(1, 0.4, 40, 80, 0.5);
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  Context& context = test::quick_device();
  ExtractionOptions options;
  options.resolution = 80;
  const Extraction extraction = test::extract_on_device(context, test::prepare(solid), options).extraction;
  const Sheets sheets = find_sheets(extraction.spheres, extraction.grid, options, SheetOptions()).value();
  ASSERT_EQ(sheets.sheets.size(), 1u);
  const MedialTopology topology = topology_of_mesh(extraction, sheets, options);
  EXPECT_EQ(topology.betti, (BettiNumbers{1, 1, 0}));
}

}  // namespace
}  // namespace medial_vk
