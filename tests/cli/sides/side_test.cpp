// --side and --margin of the main command: files, report, check and picture of the outside and of both sides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/tool_test.h"
#include "output/medial_ply/medial_file.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ToolResult;
using testing::HasSubstr;

class SidesOfATool : public test::ToolTest {
 protected:
  SidesOfATool() {
    Mesh boxes = test::make_box({1, 1, 0.5});
    test::append(boxes, test::moved(test::make_box({1, 1, 0.5}), {0, 0, 0.8}));  // a gap of 0.3
    test::write_file(path("boxes.obj"), test::to_obj(boxes));
    test::write_file(path("box.obj"), test::to_obj(test::make_box({1, 0.7, 0.5})));
  }

  ToolResult run_at(const char* resolution, std::vector<std::string> arguments) const {
    for (const char* argument : {"--backend", "cpu", "--resolution", resolution}) arguments.push_back(argument);
    return run(std::move(arguments));
  }
  nlohmann::json report() const { return nlohmann::json::parse(read_file(path("r.json"))); }
  MedialFile points() const { return decode_ply(read_file(path("boxes.medial.ply")), "boxes.medial.ply").value(); }
};

TEST_F(SidesOfATool, TheOutsideIsWrittenCheckedAndReported) {
  const ToolResult result = run_at("13", {"boxes.obj", "--side", "outside", "--margin", "0.37", "--check", "--report",
                                          "r.json", "--picture", "p.png", "--size", "64"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("  side      outside, up to 0.37 beyond the bounding box"));
  EXPECT_THAT(result.out, HasSubstr("centre outside"));
  const MedialFile file = points();
  EXPECT_EQ(file.header.inside_count, std::optional<std::size_t>(0));
  ASSERT_FALSE(file.spheres.empty());
  std::size_t in_the_gap = 0;
  for (const MedialSphere& s : file.spheres) {
    const bool is_between = s.centre[0] > 0.2 && s.centre[0] < 0.8 && s.centre[1] > 0.2 && s.centre[1] < 0.8;
    in_the_gap += is_between && s.centre[2] > 0.6 && s.centre[2] < 0.7 ? 1 : 0;
    if (is_between) {
      EXPECT_NEAR(s.radius, 0.15, 0.01);
    }
  }
  EXPECT_GT(in_the_gap, 8u);
  const nlohmann::json json = report();
  EXPECT_EQ(json["parameters"]["side"], "outside");
  EXPECT_EQ(json["region"]["margin"], 0.37);
  // The longest side is 1.3, and the shift that of docs/theory.md, "The complement".
  const double lower = json["region"]["lower"][0];
  EXPECT_NEAR(lower, -0.37 - 1.3 * (std::sqrt(5.0) - 1) / 86, 1e-12);
  EXPECT_EQ(json["region"]["inside_points"], 0);
  EXPECT_EQ(json["region"]["outside_points"], file.spheres.size());
  EXPECT_EQ(json["sheets"][0]["side"], "outside");
  EXPECT_EQ(json["sheets"][0]["rank"], 1);
  EXPECT_FALSE(json["union"].is_null());
  EXPECT_TRUE(json["outside_union"].is_null());
  EXPECT_TRUE(json["fatness"].is_null());
  EXPECT_EQ(read_file(path("p.png")).substr(1, 3), "PNG");
}

TEST_F(SidesOfATool, BothSidesAreMarkedAndHaveSheetsOfTheirOwn) {
  const ToolResult result = run_at(
      "13", {"boxes.obj", "--side", "both", "--margin", "30%", "--check", "--report", "r.json", "-o", "both.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("  side      inside and outside, up to 0.39 beyond the bounding box"));
  EXPECT_THAT(result.out, HasSubstr("inside: centre inside"));
  EXPECT_THAT(result.out, HasSubstr("outside: centre outside"));
  const nlohmann::json json = report(), written = nlohmann::json::parse(read_file(path("both.json")))["points"];
  const std::size_t inside = json["region"]["inside_points"], outside = json["region"]["outside_points"];
  EXPECT_GT(inside, 0u);
  EXPECT_GT(outside, 0u);
  ASSERT_EQ(written.size(), inside + outside);
  double shares[2] = {0, 0};
  for (const nlohmann::json& sheet : json["sheets"]) {
    shares[sheet["side"] == "outside" ? 1 : 0] += sheet["significance"].get<double>();
  }
  EXPECT_NEAR(shares[0], 1, 1e-9);
  EXPECT_NEAR(shares[1], 1, 1e-9);
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(written[i]["side"], i < inside ? "inside" : "outside");
    const std::size_t sheet = written[i]["sheet"];
    ASSERT_LT(sheet, json["sheets"].size());
    EXPECT_EQ(json["sheets"][sheet]["side"], written[i]["side"]);
  }
  EXPECT_FALSE(json["union"].is_null());
  EXPECT_FALSE(json["outside_union"].is_null());
  ASSERT_EQ(json["sides"].size(), 2u);
  std::size_t sheets = 0, undecided = 0;
  for (const std::size_t s : {0, 1}) {
    const nlohmann::json& side = json["sides"][s];
    EXPECT_EQ(side["side"], s == 0 ? "inside" : "outside");
    EXPECT_EQ(side["points"], s == 0 ? inside : outside);
    EXPECT_EQ(side["union_volume"], json[s == 0 ? "union" : "outside_union"]["volume"]);
    double area = 0, greatest = 0;
    for (const nlohmann::json& sheet : json["sheets"])
      area += sheet["side"] == side["side"] ? sheet["area"].get<double>() : 0;
    for (const nlohmann::json& point : written) {
      if (point["side"] == side["side"]) greatest = std::max(greatest, point["radius"].get<double>());
    }
    EXPECT_NEAR(side["area"].get<double>(), area, 1e-12 * area);
    EXPECT_EQ(side["radius"]["greatest"], greatest);
    sheets += side["sheets"].get<std::size_t>();
    undecided += side["undecided"].get<std::size_t>();
  }
  EXPECT_EQ(sheets, json["sheets"].size());
  EXPECT_EQ(undecided, json["voxels"]["undecided"]);
}

TEST_F(SidesOfATool, EveryFormatNamesTheSide) {
  for (const char* file : {"p.csv", "p.npz", "p.glb", "p.ply"}) {
    const ToolResult result = run_at("9", {"boxes.obj", "--side", "both", "--margin", "0.37", "-o", file, "--ascii"});
    ASSERT_EQ(result.exit_code, 0) << file << result.err;
    EXPECT_THAT(read_file(path(file)), HasSubstr("side")) << file;
  }
  EXPECT_THAT(read_file(path("p.csv")), HasSubstr(",outside\n"));
  EXPECT_EQ(run_at("9", {"boxes.obj", "-o", "p.csv"}).exit_code, 0);
  EXPECT_THAT(read_file(path("p.csv")), testing::Not(HasSubstr("side"))) << "the usual files are as they were";
}

TEST_F(SidesOfATool, AConvexSolidHasNoPointOutside) {
  const ToolResult result = run_at("8", {"box.obj", "--side", "outside"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("  points    0 (none above the thresholds: a convex solid has none outside)"));
}

// The narrowest gap outside with its ball, beside the points.
TEST_F(SidesOfATool, TheLeastGapIsFoundWithTheOutside) {
  const ToolResult result =
      run_at("9", {"boxes.obj", "--side", "outside", "--margin", "0.37", "--least-gap", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json gap = report()["boundary"]["walls"][0];
  EXPECT_EQ(gap["side"], "gaps");
  EXPECT_NEAR(gap["thinnest"]["radius"], 0.15, 0.002);
}

TEST_F(SidesOfATool, MarginsThatAreTooLargeAreErrorsOfUsage) {
  const ToolResult result = run_at("8", {"boxes.obj", "--side", "outside", "--margin", "14"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--margin must be above 0 and at most 10 times the longest side"));
}

}  // namespace
}  // namespace medial_vk
