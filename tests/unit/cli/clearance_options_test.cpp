// The command line of `medial-vk clearance`: defaults, ranges, files that collide, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "cli/options/clearance_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ClearanceOptions parsed_clearance(const std::vector<std::string>& arguments) {
  return value_of(parse_clearance_options(arguments), arguments);
}

std::string clearance_message(const std::vector<std::string>& arguments) {
  return message_of(parse_clearance_options(arguments), arguments);
}

TEST(ClearanceOptions, Defaults) {
  ClearanceOptions expected;
  expected.robot = "r.urdf";
  expected.joints = "q.csv";
  expected.output = "-";
  const ClearanceOptions options = parsed_clearance({"r.urdf", "--joints", "q.csv"});
  EXPECT_EQ(options, expected);
  const GroupOptions of_library = group_options(options);
  EXPECT_TRUE(of_library.exact);
  EXPECT_EQ(of_library.tolerance, 0);
  EXPECT_EQ(of_library.limit, std::numeric_limits<double>::infinity());
}

TEST(ClearanceOptions, AllAtOnce) {
  const ClearanceOptions options = parsed_clearance({"--scene",
                                                     "a.obj",
                                                     "r.URDF",
                                                     "--scene",
                                                     "b.stl",
                                                     "--joints",
                                                     "-",
                                                     "--package",
                                                     "p=/x",
                                                     "--package",
                                                     "q=/y",
                                                     "--srdf",
                                                     "r.srdf",
                                                     "--write-srdf",
                                                     "w.srdf",
                                                     "-o",
                                                     "c.csv",
                                                     "--tolerance",
                                                     "0.5",
                                                     "--limit",
                                                     "2",
                                                     "--visual",
                                                     "--keep-inner-faces",
                                                     "--check",
                                                     "--threads",
                                                     "3",
                                                     "-v"});
  ClearanceOptions expected;
  expected.robot = "r.URDF";
  expected.scenes = {"a.obj", "b.stl"};
  expected.packages = {"p=/x", "q=/y"};
  expected.joints = "-";
  expected.srdf = "r.srdf";
  expected.write_srdf = "w.srdf";
  expected.output = "c.csv";
  expected.tolerance = 0.5;
  expected.limit = 2;
  expected.visual = expected.keep_inner_faces = expected.check = expected.verbose = true;
  expected.threads = 3;
  EXPECT_EQ(options, expected);
  EXPECT_EQ(group_options(options).limit, 2);
  EXPECT_EQ(group_options(options).tolerance, 0.5);
  EXPECT_THAT(inputs_of(options), ElementsAre("a.obj", "b.stl", "r.URDF", "-", "r.srdf"));
  EXPECT_TRUE(parsed_clearance({"--help"}).help);
}

TEST(ClearanceOptions, BallsOfLinks) {
  const auto with = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"r.urdf", "--joints", "q.csv"});
    return options;
  };
  const ClearanceOptions options =
      parsed_clearance(with({"--balls", "64", "--backend", "cpu", "--limit", "2", "--resolution", "9"}));
  EXPECT_EQ(options.balls, 64u);
  EXPECT_EQ(options.resolution, 9u);
  EXPECT_EQ(options.backend, Backend::kCpu);
  EXPECT_FALSE(group_options(options).exact);
  EXPECT_EQ(group_options(options).limit, 2);
  const ClearanceOptions collisions = parsed_clearance(with({"--balls", "64", "--decide", "--limit", "0"}));
  EXPECT_EQ(group_options(collisions).limit, 0);
  EXPECT_EQ(triangle_options(collisions).limit, 0);
  EXPECT_EQ(parsed_clearance(with({"--balls", "9", "--device", "1"})).device, "1");
  EXPECT_THAT(clearance_message(with({"--balls", "0"})), HasSubstr("not between 1 and"));
  EXPECT_THAT(clearance_message(with({"--balls", "9", "--tolerance", "0.1"})), HasSubstr("it has no --tolerance"));
  const ClearanceOptions kept = parsed_clearance(with({"--balls", "9", "--bodies", "kept", "--decide"}));
  EXPECT_EQ(kept.bodies, "kept");
  EXPECT_TRUE(kept.decide);
  EXPECT_FALSE(group_options(kept).exact);
  EXPECT_TRUE(triangle_options(kept).exact);
  const ClearanceOptions wide = parsed_clearance(with({"--balls", "9", "--decide", "--tolerance", "0.1"}));
  EXPECT_EQ(triangle_options(wide).tolerance, 0.1);
  EXPECT_THAT(clearance_message(with({"--bodies", "kept"})), HasSubstr("--bodies is about the balls"));
  EXPECT_THAT(clearance_message(with({"--decide"})), HasSubstr("use it with --balls N"));
  EXPECT_THAT(clearance_message(with({"--balls", "9", "--bodies", "-"})), HasSubstr("'-' is no folder"));
  EXPECT_THAT(clearance_message(with({"--balls", "9", "--bodies", ""})), HasSubstr("the name of the folder is empty"));
  EXPECT_THAT(clearance_message(with({"--backend", "cpu"})), HasSubstr("use them with --balls N"));
  EXPECT_THAT(clearance_message(with({"--resolution", "9"})), HasSubstr("use them with --balls N"));
  EXPECT_THAT(clearance_message(with({"--device", "1"})), HasSubstr("use them with --balls N"));
  EXPECT_THAT(clearance_message(with({"--balls", "9", "--device", "1", "--backend", "cpu"})), HasSubstr("--device"));
}

TEST(ClearanceOptions, Views) {
  const ClearanceOptions options = parsed_clearance(
      {"r.urdf", "--joints", "q.csv", "--picture", "p.png", "--html", "p.html", "--up", "z", "--view", "front"});
  EXPECT_EQ(options.picture, "p.png");
  EXPECT_EQ(options.html, "p.html");
  EXPECT_EQ(options.view.up, UpAxis::kZ);
  EXPECT_EQ(options.view.towards, (std::array<double, 3>{0, -1, 0}));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--up", "z"}),
              HasSubstr("--picture FILE.png or --html"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--picture", "p.jpg"}), HasSubstr(".png"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--html", "p"}), HasSubstr(".html"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--picture", "p.png", "--html", "p.png"}),
              HasSubstr(".html"));
}

TEST(ClearanceOptions, RowsAreThoseOfAPictureOrAPage) {
  const auto with = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"r.urdf", "--joints", "q.csv", "--row"});
    return options;
  };
  EXPECT_EQ(parsed_clearance(with({"3", "--picture", "p.png"})).row, 3u);
  EXPECT_EQ(parsed_clearance(with({"3", "--html", "p.html"})).row, 3u);
  EXPECT_THAT(clearance_message(with({"0", "--picture", "p.png"})), HasSubstr("--row: 0 is not between 1 and"));
  EXPECT_THAT(clearance_message(with({"1.5", "--picture", "p.png"})), HasSubstr("--row"));
  EXPECT_THAT(clearance_message(with({"1"})), HasSubstr("use it with --picture FILE.png or --html"));
}

TEST(ClearanceOptions, Messages) {
  EXPECT_THAT(clearance_message({}), HasSubstr("ROBOT.urdf"));
  EXPECT_THAT(clearance_message({"r.obj", "--joints", "q.csv"}), HasSubstr("'r.obj' does not end in .urdf"));
  EXPECT_THAT(clearance_message({"r.urdf"}), HasSubstr("--joints FILE.csv"));
  EXPECT_THAT(clearance_message({"r.urdf", "s.urdf", "--joints", "q.csv"}), HasSubstr("one robot at a time"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "-", "--scene", "-"}), HasSubstr("standard input"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--srdf", "-"}), HasSubstr("--srdf"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--limit", "-1"}),
              HasSubstr("--limit: -1 is not between 0 and 1e+30"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--tolerance", "-1"}), HasSubstr("--tolerance"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "-o", "c.json"}), HasSubstr(".csv"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--write-srdf", "c.xml"}), HasSubstr(".srdf"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "-o", "q.csv"}), HasSubstr("overwrite the input"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--srdf", "r.srdf", "--write-srdf", "r.srdf"}),
              HasSubstr("overwrite the input"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "--write-srdf", "-"}), HasSubstr("same file"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joints", "q.csv", "-q", "-v"}), HasSubstr("-q and -v"));
  EXPECT_THAT(clearance_message({"r.urdf", "--joint", "q.csv"}), HasSubstr("did you mean --joints?"));
}

}  // namespace
}  // namespace medial_vk::cli
