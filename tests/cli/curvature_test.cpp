// `medial-vk curvature` from outside: exit codes, streams, files. Everything here runs without a Vulkan device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::ScratchFolder;
using test::ToolResult;
using test::write_file;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInner = 1, kOuter = 1.2;

/// A table of the balls of a pipe's wall, around z; `spokes`: with their columns.
std::string wall_table(bool spokes) {
  std::string table =
      spokes ? "x,y,z,radius,spoke_a_x,spoke_a_y,spoke_a_z,spoke_b_x,spoke_b_y,spoke_b_z\n" : "radius,z,note,x,y\n";
  constexpr int kAround = 100, kAlong = 16;
  constexpr double kMiddle = (kInner + kOuter) / 2, kRadius = (kOuter - kInner) / 2;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / kAround, z = 0.06 * j;
      const double x = std::cos(angle), y = std::sin(angle);
      std::ostringstream line;
      line.precision(17);
      if (spokes) {
        line << kMiddle * x << ',' << kMiddle * y << ',' << z << ',' << kRadius << ',' << x << ',' << y << ",0," << -x
             << ',' << -y << ",0\n";
      } else {
        line << kRadius << ',' << z << ",7," << kMiddle * x << ',' << kMiddle * y << '\n';
      }
      table += line.str();
    }
  }
  return table;
}

class CurvatureCommand : public testing::Test {
 protected:
  ToolResult run(std::vector<std::string> arguments, const std::string& standard_input = {}) {
    arguments.insert(arguments.begin(), "curvature");
    return test::Tool({.arguments = arguments, .folder = scratch_.path(""), .standard_input = standard_input}).wait();
  }

  ScratchFolder scratch_;
};

/// The middle of the values of one curvature at the tips outside, or inside.
double median_of(const nlohmann::json& report, std::size_t k, bool outside) {
  std::vector<double> values;
  for (const auto& ball : report["balls"]) {
    for (const auto& tip : ball["tips"]) {
      if (tip["kappa"][k].is_null()) continue;
      const double along = tip["spoke"][0].get<double>() * ball["centre"][0].get<double>() +
                           tip["spoke"][1].get<double>() * ball["centre"][1].get<double>();
      if ((along > 0) == outside) values.push_back(tip["kappa"][k].get<double>());
    }
  }
  EXPECT_GT(values.size(), 500u);
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

/// A file of glTF in one piece, with attributes of its only primitive.
class GlbPoints {
 public:
  explicit GlbPoints(std::string bytes) : bytes_(std::move(bytes)) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes_.data() + kJsonLength, sizeof(length));
    document = nlohmann::json::parse(bytes_.substr(kJson, length));
    buffer_ = kJson + length + kChunkHeader;
  }

  std::size_t count(const char* name) const { return accessor(name)["count"]; }
  /// `components` numbers for each point.
  std::vector<float> values(const char* name, std::size_t components) const {
    const nlohmann::json& view = document["bufferViews"][accessor(name)["bufferView"].get<std::size_t>()];
    std::vector<float> values(components * count(name));
    std::memcpy(values.data(), bytes_.data() + buffer_ + view.value("byteOffset", std::size_t{0}),
                values.size() * sizeof(float));
    return values;
  }

  nlohmann::json document;

 private:
  static constexpr std::size_t kJsonLength = 12, kJson = 20, kChunkHeader = 8;

  const nlohmann::json& accessor(const char* name) const {
    const nlohmann::json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    return document["accessors"][attributes[name].get<std::size_t>()];
  }

  std::string bytes_;
  std::size_t buffer_ = 0;
};

// What the JSON says of each tip is in the attributes of its point, in float.
TEST_F(CurvatureCommand, WritesPointsWithAttributesAsGltf) {
  write_file(scratch_.path("wall.csv"), wall_table(false));
  ASSERT_EQ(run({"wall.csv", "-q", "-o", "wall.json"}).exit_code, 0);
  ASSERT_EQ(run({"wall.csv", "-q", "-o", "wall.glb"}).exit_code, 0);
  const auto wanted = nlohmann::json::parse(read_file(scratch_.path("wall.json")));
  const GlbPoints points(read_file(scratch_.path("wall.glb")));
  EXPECT_EQ(points.document["meshes"][0]["primitives"][0]["mode"], 0);
  EXPECT_EQ(points.document["asset"]["extras"]["curvature"], "fits");
  ASSERT_EQ(points.count("POSITION"), 3200u);
  const std::vector<float> kappa = points.values("_KAPPA_1", 1), spokes = points.values("_SPOKE", 3),
                           places = points.values("POSITION", 3), balls = points.values("_BALL", 1);
  const nlohmann::json& middle = points.document["nodes"][0]["translation"];
  const auto in_float = [](const nlohmann::json& x) {
    return x.is_null() ? 0.0f : static_cast<float>(x.get<double>());
  };
  for (std::size_t i = 0; i < 3200; ++i) {
    const nlohmann::json& ball = wanted["balls"][i / 2];
    const nlohmann::json& tip = ball["tips"][i % 2];
    ASSERT_EQ(kappa[i], in_float(tip["kappa"][0])) << i;
    ASSERT_EQ(balls[i], static_cast<float>(i / 2));
    if (tip["spoke"].is_null()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(spokes[3 * i + k], in_float(tip["spoke"][k])) << i;
      const double at = ball["centre"][k].get<double>() + ball["radius"].get<double>() * tip["spoke"][k].get<double>();
      ASSERT_NEAR(places[3 * i + k] + middle[k].get<double>(), at, 0x1p-23) << i;  // floats below 2
    }
  }
}

TEST_F(CurvatureCommand, MeasuresAnybodysBalls) {
  write_file(scratch_.path("wall.csv"), wall_table(false));
  const ToolResult result = run({"wall.csv", "-o", "wall.json", "--report", "report.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("wall.csv: 1,600 balls"));
  EXPECT_THAT(result.err, HasSubstr("kappa 1"));
  const auto values = nlohmann::json::parse(read_file(scratch_.path("wall.json")));
  ASSERT_EQ(values["balls"].size(), 1600u);
  // What a window does not see of a circle is of the fourth order, below a thousandth here.
  EXPECT_NEAR(median_of(values, 0, true), 1 / kOuter, 1e-3);
  EXPECT_NEAR(median_of(values, 1, true), 0, 1e-3);
  EXPECT_NEAR(median_of(values, 0, false), 0, 1e-3);
  EXPECT_NEAR(median_of(values, 1, false), -1 / kInner, 1e-3);
  const auto report = nlohmann::json::parse(read_file(scratch_.path("report.json")));
  EXPECT_EQ(report["balls"], 1600);
  std::uint64_t tips = 0;
  for (const auto& [state, count] : report["tips"].items()) tips += count.get<std::uint64_t>();
  EXPECT_EQ(tips, 3200u);
  EXPECT_EQ(report["kappa_1"]["median"].is_number(), true);
}

TEST_F(CurvatureCommand, WritesTablesAndNamesFiles) {
  const ToolResult table = run({"-", "-o", "-", "-q"}, wall_table(false));
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.err, IsEmpty());
  EXPECT_THAT(table.out, testing::StartsWith("ball,tip,state,x,y,z,radius,spoke_x,"));
  EXPECT_EQ(std::ranges::count(table.out, '\n'), 1 + 2 * 1600);
  write_file(scratch_.path("wall.medial.csv"), wall_table(false));
  ASSERT_EQ(run({"wall.medial.csv", "-q"}).exit_code, 0);
  ASSERT_EQ(run({"wall.medial.csv", "-q", "-o", "w.npz"}).exit_code, 0);
  EXPECT_THAT(scratch_.names(), ElementsAre("w.npz", "wall.curvature.ply", "wall.medial.csv"));
  const std::string ply = read_file(scratch_.path("wall.curvature.ply"));
  EXPECT_THAT(ply, HasSubstr("element vertex 3200\n"));
  // 8 doubles, 10 floats, an index and two bytes for each tip.
  const std::size_t end = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - end, 3200u * (8 * 8 + 10 * 4 + 4 + 2));
}

TEST_F(CurvatureCommand, TheMethodOfTheSourceNeedsSpokes) {
  write_file(scratch_.path("with.csv"), wall_table(true));
  write_file(scratch_.path("without.csv"), wall_table(false));
  const ToolResult with = run({"with.csv", "--method", "source", "-o", "s.json", "--spacing", "0.065"});
  ASSERT_EQ(with.exit_code, 0) << with.err;
  const auto values = nlohmann::json::parse(read_file(scratch_.path("s.json")));
  EXPECT_EQ(values["method"], "source");
  // Chords of six spacings: 1 - cos of 0.18 radians is 1.6 %.
  EXPECT_NEAR(median_of(values, 0, true), 1 / kOuter, 0.05);
  const ToolResult without = run({"without.csv", "--method", "source"});
  EXPECT_EQ(without.exit_code, 3);
  EXPECT_THAT(without.err, HasSubstr("without.csv: there are no spokes"));
  EXPECT_THAT(scratch_.names(), testing::Not(testing::Contains("without.curvature.ply")));
}

TEST_F(CurvatureCommand, SaysWhatIsWrong) {
  write_file(scratch_.path("bad.csv"), "x,y,z,radius\n0,0,0,1\n1,0,0,-1\n");
  const ToolResult bad = run({"bad.csv"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv:3: the radius -1 is not positive"));
  write_file(scratch_.path("none.csv"), "x,y,z,radius\n");
  const ToolResult none = run({"none.csv"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("there is no ball"));
  write_file(scratch_.path("turned.csv"),
             "x,y,z,radius,spoke_a_x,spoke_a_y,spoke_a_z,spoke_b_x,spoke_b_y,spoke_b_z\n0,0,0,1,2,0,0,0,1,0\n");
  EXPECT_THAT(run({"turned.csv"}).err, HasSubstr("turned.csv:2: a spoke is no unit vector"));
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{{},
                                                                                     {"bad.csv", "-o", "c.vtp"},
                                                                                     {"bad.csv", "--step", "4"},
                                                                                     {"bad.csv", "--smooth"},
                                                                                     {"bad.csv", "--method", "other"},
                                                                                     {"bad.csv", "-o", "bad.csv"},
                                                                                     {"bad.csv", "-q", "-v"}}) {
    const ToolResult result = run(wrong);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("Try medial-vk curvature --help."));
  }
}

/// The lines of a table after the first one, without the column `tip`, in the order of the balls and then of their
/// text: which tip is the first depends on whether the file had spokes.
std::vector<std::pair<int, std::string>> tips_of(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("ball,tip,state,x,y,z,radius,spoke_x,")) << line;
  std::vector<std::pair<int, std::string>> tips;
  while (std::getline(lines, line)) {
    const std::size_t ball = line.find(','), tip = line.find(',', ball + 1);
    tips.emplace_back(std::stoi(line.substr(0, ball)), line.substr(tip));
  }
  std::ranges::sort(tips);
  return tips;
}

TEST_F(CurvatureCommand, ReadsWhatTheProgramWrites) {
  write_file(scratch_.path("with.csv"), wall_table(true));
  ASSERT_EQ(run({"with.csv", "-q", "-o", "direct.csv"}).exit_code, 0);
  ASSERT_EQ(run({"with.csv", "-q", "-o", "arrays.npz"}).exit_code, 0);
  ASSERT_EQ(run({"with.csv", "-q", "-o", "list.json"}).exit_code, 0);
  const auto direct = tips_of(read_file(scratch_.path("direct.csv")));
  ASSERT_EQ(direct.size(), 3200u);
  for (const char* file : {"arrays.npz", "list.json"}) {
    const ToolResult result = run({file, "-o", "again.csv"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("1,600 balls"));
    EXPECT_TRUE(tips_of(read_file(scratch_.path("again.csv"))) == direct) << file;
  }
}

TEST_F(CurvatureCommand, ReadsMedialPointsOfEveryFormat) {
  write_file(scratch_.path("part.obj"), test::to_obj(test::make_l_shape(2.0, 0.6, 0.8)));
  const std::vector<std::string> files = {"part.ply", "part.npz", "part.json", "part.csv"};
  for (const std::string& points : files) {
    const ToolResult made = test::run_tool({.arguments = {"part.obj", "--backend", "cpu", "--resolution", "20", "-q",
                                                          "--object-angle", "0.3", "-o", points},
                                            .folder = scratch_.path("")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  for (const char* method : {"fits", "source"}) {
    std::vector<std::string> tables;
    tables.reserve(files.size());
    for (const std::string& points : files) {
      const ToolResult result = run({points, "--method", method, "-q", "-o", "-"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      tables.push_back(result.out);
    }
    for (std::size_t i = 1; i < tables.size(); ++i) EXPECT_TRUE(tables[i] == tables[0]) << method << ' ' << files[i];
    const bool has_values = tables[0].find(",known,") != std::string::npos;
    EXPECT_TRUE(has_values || std::string(method) == "fits");  // for fits there are too few points
  }
}

TEST_F(CurvatureCommand, NumbersThatAreTooGreatAreThoseOfTheFile) {
  write_file(scratch_.path("far.csv"), "x,y,z,radius\n0,0,0,1\n1e19,0,0,1\n");
  write_file(scratch_.path("far.json"), R"({"spheres":[{"centre":[0,0,0],"radius":1e19}]})");
  for (const auto& [file, place] : {std::pair("far.csv", "far.csv:3: "), std::pair("far.json", "far.json: ball 0: ")}) {
    const ToolResult result = run({file});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr(std::string(place) + "there is a number beyond 1e+18"));
  }
}

TEST_F(CurvatureCommand, ReadsMedialPointsAndFittedSpheresAsJson) {
  const std::string point = R"({"centre":[0,0,0],"radius":2,"spoke_a":[1,0,0],"spoke_b":[0,1,0]})";
  write_file(scratch_.path("points.json"), R"({"format":1,"points":[)" + point + "]}");
  EXPECT_EQ(run({"points.json", "-q", "--method", "source", "-o", "p.csv"}).exit_code, 0);
  write_file(scratch_.path("spheres.json"), R"({"spheres":[{"centre":[0,0,0],"radius":2}],"levels":[]})");
  const ToolResult spheres = run({"spheres.json", "-o", "-", "-q"});
  ASSERT_EQ(spheres.exit_code, 0) << spheres.err;
  EXPECT_THAT(spheres.out, HasSubstr("0,0,point,0,0,0,2,"));
  const auto message_of = [&](const std::string& text) {
    write_file(scratch_.path("wrong.json"), text);
    const ToolResult result = run({"wrong.json"});
    EXPECT_EQ(result.exit_code, 3);
    return result.err;
  };
  EXPECT_THAT(message_of("{"), HasSubstr("wrong.json: this is no JSON"));
  EXPECT_THAT(message_of("[]"), HasSubstr("wrong.json: there is no list points, spheres or balls"));
  EXPECT_THAT(message_of(R"({"links":{}})"), HasSubstr("the links of a robot"));
  EXPECT_THAT(message_of(R"({"spheres":[{"centre":[0,0],"radius":2}]})"), HasSubstr("ball 0: there must be a centre"));
  EXPECT_THAT(message_of(R"({"spheres":[{"centre":[0,0,0],"radius":0}]})"), HasSubstr("ball 0: the radius 0 is not"));
  EXPECT_THAT(message_of(R"({"spheres":[]})"), HasSubstr("there is no ball"));
  write_file(scratch_.path("balls.glb"), "glTF");
  EXPECT_THAT(run({"balls.glb"}).err, HasSubstr("balls.glb: glTF has balls as nodes or triangles"));
  write_file(scratch_.path("no.npz"), "PK");
  EXPECT_EQ(run({"no.npz"}).exit_code, 3);
}

class InterruptedCurvature : public CurvatureCommand, public testing::WithParamInterface<int> {};

TEST_P(InterruptedCurvature, NothingIsWritten) {
  std::string table = "x,y,z,radius\n";
  for (int i = 0; i < 150; ++i) {
    for (int j = 0; j < 150; ++j) table += std::to_string(i) + "," + std::to_string(j) + ",0,9\n";
  }
  write_file(scratch_.path("plate.csv"), table);
  test::Tool tool({.arguments = {"curvature", "plate.csv", "-o", "c.ply"}, .folder = scratch_.path("")});
  // More than reading takes, and less than the fits of 22,500 balls.
  while (tool.running() && tool.seconds_of_processor() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(tool.running());
  tool.send(GetParam());
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted; nothing was written"));
  EXPECT_THAT(scratch_.names(), ElementsAre("plate.csv"));
}

INSTANTIATE_TEST_SUITE_P(, InterruptedCurvature, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace medial_vk
