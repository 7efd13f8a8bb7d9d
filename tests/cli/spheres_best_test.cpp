// The method best from outside: every contract is kept, checked and measured. Without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "solid/solid.h"
#include "sphere_fits/quality/sphere_certificate.h"
#include "spheres_command.h"
#include "support/indexed.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::read_file;
using test::SpheresCommand;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST_F(SpheresCommand, BestBallsInsideAreProvedCheckedAndMeasured) {
  const ToolResult result = best({"part.obj", "--count", "12", "--check", "-v"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("certified 12 spheres with centre inside and radius at most the exact distance"));
  EXPECT_THAT(result.err, HasSubstr("max_uncovered_gap"));
  EXPECT_THAT(result.out, StartsWith("condition"));
  EXPECT_EQ(report()["method"], "best");
  EXPECT_EQ(report()["parts"][0]["check"], "passed");
  const json all = measures();
  EXPECT_EQ(all["certificate"]["inside"]["proved"], true);
  EXPECT_EQ(all["certificate"]["inside"]["balls"], 12);
  const double error = all["volume"]["error"];
  EXPECT_EQ(all["volume"]["standard_error"], 0);
  EXPECT_EQ(all["volume"]["outside"], 0);
  EXPECT_DOUBLE_EQ(report()["volume_error"], error);
  EXPECT_NEAR(all["metrics"]["coverage"], 1 - error, 1e-12);
  EXPECT_EQ(all["metrics"]["protrusion"], 0);
  EXPECT_EQ(all["metrics"]["max_uncovered_gap"], all["distances"]["boundary_to_balls"]["upper"]);
  EXPECT_EQ(all["distances"]["balls_to_solid"]["upper"], 0);
}

TEST_F(SpheresCommand, CoversAreProvedCheckedAndMeasured) {
  const ToolResult result = best({"part.obj", "--count", "4", "--contract", "cover", "--check"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("20 triangles covered piece by piece, no hole within"));
  EXPECT_THAT(result.out, HasSubstr("the balls cover every triangle"));
  EXPECT_EQ(report()["parts"][0]["check"], "passed");
  EXPECT_TRUE(report()["volume_error"].is_null());
  EXPECT_GT(report()["parts"][0]["reach_out"]["worst"], 0);
  const json all = measures();
  EXPECT_EQ(all["certificate"]["cover"]["proved"], true);
  EXPECT_EQ(all["certificate"]["cover"]["triangles"], 20);
  EXPECT_EQ(all["volume"]["uncovered"], 0);
  EXPECT_EQ(all["volume"]["standard_error"], 0);
  EXPECT_GT(all["volume"]["outside"], 0);
  EXPECT_EQ(all["metrics"]["coverage"], 1);
}

TEST_F(SpheresCommand, BalancedBallsSayHowFarTheyReachOut) {
  const ToolResult result = best({"part.obj", "--count", "12", "--contract", "balanced"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no sphere reaches out by more than "));
  EXPECT_GT(measures()["volume"]["standard_error"], 0);
  EXPECT_EQ(best({"part.obj", "--count", "12", "--contract", "balanced", "--check"}).exit_code, 2);
}

TEST_F(SpheresCommand, ErrorAndGapAreMetTogether) {
  ASSERT_EQ(best({"part.obj", "--error", "0.4", "-q"}).exit_code, 0);
  const int by_error = report()["num_spheres"];
  EXPECT_LE(report()["volume_error"], 0.4);
  ASSERT_EQ(best({"part.obj", "--error", "0.4", "--max-gap", "0.25", "-q"}).exit_code, 0);
  EXPECT_LE(report()["volume_error"], 0.4);
  EXPECT_LE(measures()["distances"]["boundary_to_balls"]["lower"], 0.25);
  EXPECT_LE(measures()["distances"]["boundary_to_balls"]["upper"], 0.25 * 1.01);
  EXPECT_GE(report()["num_spheres"], by_error);
  EXPECT_EQ(best({"part.obj", "--error", "0.01", "--count", "4", "-q"}).exit_code, 2);
}

TEST_F(SpheresCommand, CoversAndBalancedSetsMeetGoals) {
  ASSERT_EQ(best({"part.obj", "--contract", "cover", "--error", "1", "-q"}).exit_code, 2);  // a share below 1
  ASSERT_EQ(best({"part.obj", "--contract", "cover", "--error", "0.9", "-q"}).exit_code, 0);
  const int covering = report()["num_spheres"];
  const auto solid = measures()["volume"]["solid"].get<double>();
  EXPECT_LE(measures()["volume"]["outside"], 0.9 * solid);
  EXPECT_EQ(measures()["volume"]["standard_error"], 0);
  ASSERT_EQ(best({"part.obj", "--contract", "cover", "--error", "0.6", "-q"}).exit_code, 0);
  EXPECT_LE(measures()["volume"]["outside"], 0.6 * solid);
  EXPECT_GT(report()["num_spheres"], covering);
  EXPECT_EQ(best({"part.obj", "--contract", "cover", "--error", "0.1", "--count", "4"}).exit_code, 2);

  ASSERT_EQ(best({"part.obj", "--contract", "balanced", "--error", "0.25", "-q"}).exit_code, 0);
  const int balanced = report()["num_spheres"];
  ASSERT_EQ(best({"part.obj", "--contract", "balanced", "--error", "0.25", "--max-gap", "0.1", "-q"}).exit_code, 0);
  EXPECT_GE(report()["num_spheres"], balanced);
  EXPECT_LE(measures()["distances"]["boundary_to_balls"]["lower"], 0.1);
}

TEST_F(SpheresCommand, ThinPartsAreSpreadOverCoveredAndAdvisedOn) {
  test::write_file(path("plate.obj"), test::to_obj(test::make_box({2, 1.2, 0.04})));
  const ToolResult volume = best({"plate.obj", "--count", "20"});
  ASSERT_EQ(volume.exit_code, 0) << volume.err;
  const json by_volume = report()["parts"][0];
  EXPECT_EQ(by_volume["by"], "volume");
  // 20 balls of radius 0.02 hold 20 / 2865 of the volume, as they are apart.
  const json advice = by_volume["advice"];
  EXPECT_NEAR(advice["uncovered"], 1 - 20 / 2864.8, 1e-4);
  EXPECT_NEAR(advice["inside_for_a_quarter"], 2865, 2);
  EXPECT_TRUE(advice["by_distance"]);
  EXPECT_EQ(advice["cover"]["reach"], by_volume["measures"]["distances"]["solid_to_balls"]["upper"]);
  EXPECT_THAT(volume.err, HasSubstr("advice    99.3 % uncovered; about 2,86"));
  EXPECT_THAT(volume.err, HasSubstr("--by distance to spread those inside evenly"));

  const ToolResult distance = best({"plate.obj", "--count", "20", "--by", "auto", "--check"});
  ASSERT_EQ(distance.exit_code, 0) << distance.err;
  const json by_distance = report()["parts"][0];
  EXPECT_EQ(by_distance["by"], "distance");
  EXPECT_FALSE(by_distance["advice"]["by_distance"]);
  EXPECT_LT(by_distance["advice"]["cover"]["reach"], advice["cover"]["reach"]);
  EXPECT_THAT(distance.err, Not(HasSubstr("--by distance")));

  // As many spheres cover the plate with the reach that the advice gives, or fewer, and add no more.
  const auto reach = by_distance["advice"]["cover"]["reach"].get<double>();
  const std::string reach_text = std::to_string(reach + 1e-6);
  const ToolResult cover = best({"plate.obj", "--contract", "cover", "--max-reach", reach_text, "--check"});
  ASSERT_EQ(cover.exit_code, 0) << cover.err;
  EXPECT_LE(report()["num_spheres"], 24);
  EXPECT_LE(report()["parts"][0]["reach_out"]["worst"], std::stod(reach_text));
  EXPECT_TRUE(report()["parts"][0]["advice"].is_null());
  EXPECT_EQ(report()["goals"]["max_reach"], std::stod(reach_text));

  const ToolResult few = best({"plate.obj", "--contract", "cover", "--max-reach", "0.1", "--count", "5"});
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_THAT(few.err, testing::ContainsRegex("no 5 balls are found that keep to --max-reach, but [0-9]+ are; raise "
                                              "--count or --max-reach"));
  ASSERT_EQ(best({"part.obj", "--count", "60", "-q"}).exit_code, 0);
  EXPECT_TRUE(report()["parts"][0]["advice"].is_null());  // a thick part
}

TEST_F(SpheresCommand, GoalsThatMeanNothingAreRefused) {
  const ToolResult gap = best({"part.obj", "--contract", "cover", "--max-gap", "0.3"});
  EXPECT_EQ(gap.exit_code, 2);
  EXPECT_THAT(gap.err, HasSubstr("cover leave no gap"));
  for (const char* contract : {"cover", "balanced"}) {
    const ToolResult result = best({"part.obj", "--method", "source", "--contract", contract, "--error", "0.3"});
    EXPECT_EQ(result.exit_code, 2) << contract;
    EXPECT_THAT(result.err, HasSubstr("with --method source for --contract inside only"));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("part.obj", "two.urdf"));
}

TEST_F(SpheresCommand, MoreBallsAreNeverWorse) {
  double before = 1;
  for (const char* count : {"1", "2", "5", "16", "20", "40"}) {
    ASSERT_EQ(best({"part.obj", "--count", count, "-q"}).exit_code, 0);
    const double error = report()["volume_error"];
    EXPECT_LE(error, before) << count;
    before = error;
  }
}

TEST_F(SpheresCommand, BestGivesTheSameBytesOnAnyNumberOfThreads) {
  for (const auto& each : {std::pair{"inside", "20"}, {"cover", "2"}, {"balanced", "20"}}) {
    const char *contract = each.first, *count = each.second;
    const auto bytes = [&](const char* threads) {
      const ToolResult result =
          best({"part.obj", "--count", count, "--contract", contract, "--threads", threads, "-q", "-o", "a.json"});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      return read_file(path("a.json"));
    };
    const std::string first = bytes("2");
    EXPECT_EQ(bytes("2"), first) << contract;
    EXPECT_EQ(bytes("1"), first) << contract;
  }
}

TEST_F(SpheresCommand, EveryLevelKeepsItsContract) {
  const PreparedMesh mesh = part();
  const Solid solid = std::move(Solid::build(test::indexed(mesh))).value();
  // A cover takes seconds: few of them.
  for (const auto& [contract, count] : {std::pair{"inside", "8"}, {"cover", "2"}}) {
    ASSERT_EQ(best({"part.obj", "--count", count, "--contract", contract, "--levels", "-q", "-o", "a.json"}).exit_code,
              0);
    const json levels = json::parse(read_file(path("a.json")))["levels"];
    ASSERT_EQ(levels.size(), contract == std::string("cover") ? 2u : 4u);
    json before = json::array();
    for (const json& level : levels) {
      std::vector<Ball> balls;
      for (const json& sphere : level["spheres"]) {
        const json& c = sphere["centre"];
        balls.push_back({{c[0], c[1], c[2]}, sphere["radius"]});
      }
      SCOPED_TRACE(std::string(contract) + " " + std::to_string(balls.size()));
      if (contract == std::string("cover")) {
        EXPECT_TRUE(prove_cover(solid, balls).value().proved());
        continue;
      }
      EXPECT_TRUE(prove_inside(solid, balls).proved());
      // All of the smaller level are in the larger one.
      ASSERT_GE(level["spheres"].size(), before.size());
      for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(level["spheres"][i], before[i]);
      before = level["spheres"];
    }
  }
}

TEST_F(SpheresCommand, HistogramsAsDrawingAndTable) {
  ASSERT_EQ(best({"part.obj", "--count", "6", "-q", "--histogram", "h.svg"}).exit_code, 0);
  EXPECT_THAT(read_file(path("h.svg")), StartsWith("<svg"));
  ASSERT_EQ(best({"part.obj", "--count", "6", "-q", "--histogram", "h.csv"}).exit_code, 0);
  std::istringstream table(read_file(path("h.csv")));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "surface,lower,upper,share");
  std::map<std::string, double> sums;
  while (std::getline(table, line)) sums[line.substr(0, line.find(','))] += std::stod(line.substr(line.rfind(',') + 1));
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_NEAR(sums["boundary"], 1, 1e-9);
  EXPECT_NEAR(sums["envelope"], 1, 1e-9);
  EXPECT_EQ(best({"part.obj", "--count", "6", "--histogram", "h.png"}).exit_code, 2);
  EXPECT_EQ(best({"two.urdf", "--total", "6", "--histogram", "h.svg"}).exit_code, 2);
}

TEST_F(SpheresCommand, RobotsKeepEveryContract) {
  for (const char* contract : {"inside", "cover"}) {
    std::vector<std::string> arguments = robot_arguments("--total", "5");
    for (const char* word : {"--contract", contract, "--check", "-o", "a.json"}) arguments.emplace_back(word);
    const ToolResult result = best(arguments);
    ASSERT_EQ(result.exit_code, 0) << contract << result.err;
    EXPECT_EQ(report()["num_spheres"], 5);
    const json written = report();
    for (const json& part : written["parts"]) {
      if (part["geometry"] == "primitive1") {
        EXPECT_TRUE(part["measures"].is_null());
        continue;
      }
      EXPECT_EQ(part["check"], "passed");
      EXPECT_EQ(part["measures"]["certificate"][contract]["proved"], true);
    }
  }
}

TEST_F(SpheresCommand, ABodyFileHasAReportOfBothSets) {
  const ToolResult result =
      best({"part.obj", "--contract", "both", "--count", "5", "--check", "--picture", "p.png", "--view", "1,2,3"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(result.err, HasSubstr("part.body.npz ("));
  EXPECT_THAT(result.err, HasSubstr("r.json ("));
  EXPECT_THAT(result.err, HasSubstr("p.png ("));
  EXPECT_THAT(read_file(path("p.png")), StartsWith("\x89PNG"));
  const json of_run = report();
  EXPECT_EQ(of_run["contract"], "both");
  EXPECT_EQ(of_run["output"], "part.body.npz");
  EXPECT_EQ(of_run["output_format"], "body");
  EXPECT_EQ(of_run["goals"]["count"], 5);
  EXPECT_TRUE(of_run["volume_error"].is_null());
  ASSERT_EQ(of_run["parts"].size(), 2u);
  const json &inside = of_run["parts"][0], &cover = of_run["parts"][1];
  EXPECT_EQ(inside["contract"], "inside");
  EXPECT_EQ(cover["contract"], "cover");
  for (const json& set : of_run["parts"]) {
    EXPECT_EQ(set["check"], "passed");
    EXPECT_EQ(set["num_spheres"], 5);
    EXPECT_EQ(set["geometry"], "part");
  }
  EXPECT_EQ(of_run["num_spheres"], 10);
  EXPECT_TRUE(inside["measures"]["certificate"]["inside"]["proved"].get<bool>());
  EXPECT_TRUE(cover["measures"]["certificate"]["cover"]["proved"].get<bool>());
  EXPECT_LT(inside["spheres_volume"], cover["spheres_volume"]);
  EXPECT_TRUE(inside["volume_error"].is_number());
  // The file is what the library makes of it: a body at distance 0 from itself.
  const ToolResult distance = run({"distance", "part.body.npz", "part.body.npz", "--balls", "-q"});
  EXPECT_EQ(distance.exit_code, 0) << distance.err;
  EXPECT_THAT(distance.out, testing::StartsWith("lower,upper,state,ax,ay,az,bx,by,bz\n0,0,hit,"));
}

}  // namespace
}  // namespace medial_vk
