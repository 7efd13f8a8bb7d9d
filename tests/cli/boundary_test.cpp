// Thickness and curvature of the main command: report, summary and files. tests/formats reads the files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class BoundaryOfATool : public test::ToolTest {
 protected:
  /// 2 x 2 x 0.2: faces with 5 / 6 of the area are parallel.
  BoundaryOfATool() { test::write_file(path("plate.obj"), test::to_obj(test::make_box({2, 2, 0.2}))); }

  nlohmann::json report() const { return nlohmann::json::parse(read_file(path("r.json"))); }
};

TEST_F(BoundaryOfATool, TheThicknessOfAPlateIsInItsIntervals) {
  const ToolResult result = run_cpu({"plate.obj", "--thickness", "--thickness-delta", "0.0001", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json thickness = report()["boundary"]["thickness"];
  EXPECT_LE(thickness["median"]["lower"], 0.2);
  EXPECT_GE(thickness["median"]["upper"], 0.2);
  // Intervals are at most this wide at the end of their search; both ends are then rounded outwards, by some errors of
  // coordinates of up to 2, each 2e-16 or 1e-15 of a thickness of 0.2.
  EXPECT_LE(thickness["median"]["upper"], thickness["median"]["lower"].get<double>() * 1.02 * (1 + 1e-12));
  EXPECT_DOUBLE_EQ(thickness["delta"], 0.0002);
  // No ball is larger than the wall, and where a narrow interval takes long, one four times as wide is enough.
  EXPECT_LE(thickness["greatest"], 0.2 * 1.08 * (1 + 1e-12));
  const nlohmann::json least = thickness["least_in_a_wall"];
  ASSERT_FALSE(least.is_null());
  EXPECT_LE(least["lower"], 0.2);
  // No edge: of a ball in a wall, contacts on both sides are within delta and the width of the interval.
  const double width = least["upper"].get<double>() - least["lower"].get<double>();
  EXPECT_GE(least["upper"], 0.2 - 2 * 0.0002 - width);
  EXPECT_THAT(result.err, HasSubstr("  thickness median"));
  EXPECT_THAT(result.err, Not(HasSubstr("  curvature")));
  EXPECT_TRUE(report()["boundary"]["curvature"].is_null());
}

TEST_F(BoundaryOfATool, AWallBelowTheLeastOneIsAnErrorWithItsPlace) {
  const ToolResult result = run_cpu({"plate.obj", "--min-wall", "0.25", "--report", "r.json"});
  EXPECT_EQ(result.exit_code, 8);
  EXPECT_THAT(result.err, HasSubstr("  walls     the thinnest wall is 0.19"));
  EXPECT_THAT(result.out, HasSubstr("thin"));
  EXPECT_THAT(result.out, HasSubstr("\nwall  "));
  const nlohmann::json walls = report()["boundary"]["walls"][0];
  EXPECT_EQ(walls["side"], "walls");
  EXPECT_EQ(walls["verdict"], "too thin");
  EXPECT_NEAR(walls["thinnest"]["radius"], 0.1, 1e-12);
  EXPECT_LE(walls["proved"], 0.2);
  // Both faces are one place, without a border of some delta, and with points of the rims that its balls touch.
  ASSERT_EQ(walls["places"].size(), 1u);
  EXPECT_GT(walls["places"][0]["area"], 6);
  EXPECT_LE(walls["places"][0]["area"], 9.6 * (1 + 1e-12));
}

// Here balls at edges, which are as large as some deltas, are far smaller than the wall.
TEST_F(BoundaryOfATool, PlacesOfAWallThatIsFarThinnerThanDemandedAreInTheWall) {
  test::write_file(path("foil.obj"), test::to_obj(test::make_box({2, 2, 0.02})));
  EXPECT_EQ(run_cpu({"foil.obj", "--min-wall", "0.25", "--report", "r.json"}).exit_code, 8);
  const nlohmann::json places = report()["boundary"]["walls"][0]["places"];
  ASSERT_EQ(places.size(), 1u);
  EXPECT_GT(places[0]["area"], 7.5);
  EXPECT_GE(places[0]["lower"], 0.02 * 0.98);
  EXPECT_LE(places[0]["upper"], 0.02 * 1.02);
}

TEST_F(BoundaryOfATool, AWallAsThinAsTheLeastOneIsProved) {
  const ToolResult result = run_cpu({"plate.obj", "--min-wall", "0.2", "--min-gap", "0.5", "--report", "r.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("which is 0.2 to a hundredth: proved"));
  EXPECT_THAT(result.err, HasSubstr("which is 0.5 to a hundredth: proved"));
  const nlohmann::json walls = report()["boundary"]["walls"];
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_GE(walls[0]["proved"], 0.2 * 0.99);
  EXPECT_TRUE(walls[0]["thinnest"].is_null());
  EXPECT_EQ(walls[1]["side"], "gaps");
}

TEST_F(BoundaryOfATool, TheLeastWallAndGapAreMeasuredWithTheirContacts) {
  Mesh both = test::make_box({2, 2, 0.2});
  test::append(both, test::moved(test::make_box({2, 2, 0.5}), {0, 0, 0.3}));
  test::write_file(path("plates.obj"), test::to_obj(both));
  const ToolResult result = run_cpu({"plates.obj", "--least-wall", "--least-gap", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("  walls     the thinnest wall is 0.19"));
  EXPECT_THAT(result.err, HasSubstr("  gaps      the thinnest gap is 0.09"));
  EXPECT_THAT(result.out, IsEmpty());
  const nlohmann::json walls = report()["boundary"]["walls"];
  ASSERT_EQ(walls.size(), 2u);
  const std::array<double, 2> truths = {0.2, 0.1};
  for (std::size_t i = 0; i < 2; ++i) {
    const double truth = truths[i];
    EXPECT_EQ(walls[i]["verdict"], "measured");
    EXPECT_TRUE(walls[i]["demanded"].is_null());
    EXPECT_LE(walls[i]["proved"], truth * (1 + 1e-12));
    EXPECT_GE(walls[i]["proved"], truth * 0.98);
    const nlohmann::json& contacts = walls[i]["thinnest"]["contacts"];
    EXPECT_NEAR(std::abs(contacts[0][2].get<double>() - contacts[1][2].get<double>()), truth, 1e-9);
  }
}

TEST_F(BoundaryOfATool, LeastWallsNeedAClosedMeshAndAnglesALeastWall) {
  Mesh open = test::make_box({2, 2, 0.2});
  open.triangles.pop_back();
  test::write_file(path("open.obj"), test::to_obj(open));
  const ToolResult result = run_cpu({"open.obj", "--min-wall", "0.1"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("the least wall, or gap, is that of a closed one"));
  const ToolResult angle = run_cpu({"plate.obj", "--wall-angle", "1.3"});
  EXPECT_EQ(angle.exit_code, 2);
  EXPECT_THAT(angle.err, HasSubstr("use it with --thickness, --least-wall, --least-gap, --min-wall or --min-gap"));
}

TEST_F(BoundaryOfATool, AllOutputsAreWritten) {
  const ToolResult result =
      run_cpu({"plate.obj", "--boundary", "b.vtp", "--thickness-histogram", "h.csv", "--picture", "p.png", "--show",
               "boundary", "--strokes", "--size", "120x90", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(folder_.names(), ElementsAre("b.vtp", "h.csv", "p.png", "plate.medial.ply", "plate.obj", "r.json"));
  EXPECT_THAT(result.err, HasSubstr("  curvature kappa 1"));
  EXPECT_FALSE(report()["boundary"]["curvature"].is_null());
  EXPECT_THAT(read_file(path("h.csv")), HasSubstr("share_by_upper_ends"));
}

TEST_F(BoundaryOfATool, FinerVerticesShowTheMiddleOfLargeFaces) {
  const auto greatest_in = [&](const char* name) {
    double greatest = 0;
    const std::string bytes = read_file(path(name));
    std::istringstream lines(bytes.substr(bytes.find("end_header\n") + 11));
    for (std::string line; std::getline(lines, line) && line.substr(0, 2) != "3 ";) {
      double x = 0, y = 0, z = 0, lower = 0;
      std::istringstream(line) >> x >> y >> z >> lower;
      greatest = std::max(greatest, lower);
    }
    return greatest;
  };
  ASSERT_EQ(run_cpu({"plate.obj", "--thickness", "--boundary", "b.ply", "--ascii"}).exit_code, 0);
  ASSERT_EQ(
      run_cpu({"plate.obj", "--thickness", "--boundary", "f.ply", "--ascii", "--boundary-edge", "0.25"}).exit_code, 0);
  // At corners it is some deltas (a thousandth here); in the middle of the faces it is 0.2, to a hundredth.
  EXPECT_LT(greatest_in("b.ply"), 0.02);
  EXPECT_GT(greatest_in("f.ply"), 0.198 / 1.01);
}

TEST_F(BoundaryOfATool, StandardOutputHoldsTheMesh) {
  const ToolResult result = run_cpu({"plate.obj", "--thickness", "--boundary", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out.substr(0, 400), HasSubstr("property double thickness_upper"));
}

TEST_F(BoundaryOfATool, TheSameRunGivesTheSameBytesOnAnyThreads) {
  for (const char* threads : {"1", "3"}) {
    ASSERT_EQ(run_cpu({"plate.obj", "--boundary", std::string(threads) + ".ply", "--threads", threads}).exit_code, 0);
  }
  EXPECT_EQ(read_file(path("1.ply")), read_file(path("3.ply")));
}

}  // namespace
}  // namespace medial_vk
