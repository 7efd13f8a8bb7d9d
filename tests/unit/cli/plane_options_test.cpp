// The command line of `medial-vk plane`: defaults, lengths with and without percent, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "cli/help/help_texts.h"
#include "cli/options/plane/plane_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

PlaneCommandOptions parsed_plane(const std::vector<std::string>& arguments) {
  return value_of(parse_plane_options(arguments), arguments);
}

std::string plane_message(const std::vector<std::string>& arguments) {
  return message_of(parse_plane_options(arguments), arguments);
}

TEST(PlaneOptions, Defaults) {
  PlaneCommandOptions expected;
  expected.shape = "folder/letter.svg";
  expected.output = "letter.axis.json";
  const PlaneCommandOptions options = parsed_plane({"folder/letter.svg"});
  EXPECT_EQ(options, expected);
  EXPECT_EQ(options.format(), PlaneFormat::kJson);
  EXPECT_EQ(options.object_angle, 0.6);
  EXPECT_EQ(options.step, (PlaneLength{1e-4, true}));
  EXPECT_EQ(parsed_plane({"-"}).output, "stdin.axis.json");
  EXPECT_TRUE(parsed_plane({"--help"}).help);
}

TEST(PlaneOptions, AllAtOnce) {
  const PlaneCommandOptions options = parsed_plane({"a.wkt",
                                                    "-o",
                                                    "a.GeoJSON",
                                                    "--picture",
                                                    "a.png",
                                                    "--html",
                                                    "a.html",
                                                    "--report",
                                                    "-",
                                                    "--radius",
                                                    "2",
                                                    "--side",
                                                    "both",
                                                    "--margin",
                                                    "150%",
                                                    "--fill",
                                                    "evenodd",
                                                    "--flatness",
                                                    "0.1",
                                                    "--prune-length",
                                                    "3%",
                                                    "--prune-significance",
                                                    "0.5",
                                                    "--longest-path",
                                                    "--smooth",
                                                    "1%",
                                                    "--step",
                                                    "1e-3",
                                                    "--colour",
                                                    "angle",
                                                    "--check",
                                                    "--threads",
                                                    "7",
                                                    "-v",
                                                    "--object-angle",
                                                    "0.25",
                                                    "--mode",
                                                    "certified"});
  PlaneCommandOptions expected;
  expected.shape = "a.wkt";
  expected.output = "a.GeoJSON";
  expected.picture = "a.png";
  expected.html = "a.html";
  expected.report = "-";
  expected.radius = {2, false};
  expected.side = PlaneSide::kBoth;
  expected.margin = {1.5, true};
  expected.fill = FillRule::kEvenOdd;
  expected.flatness = {0.1, false};
  expected.prune_length = {0.03, true};
  expected.prune_significance = {0.5, false};
  expected.smooth = {0.01, true};
  expected.step = {1e-3, false};
  expected.colour = PlaneColour::kAngle;
  expected.longest_path = expected.check = expected.verbose = true;
  expected.threads = 7;
  expected.object_angle = 0.25;
  EXPECT_EQ(options, expected);
  EXPECT_EQ(options.format(), PlaneFormat::kGeoJson);
  EXPECT_EQ(options.prune_length.of(200), 6);
  EXPECT_EQ(options.prune_significance.of(200), 0.5);
  EXPECT_EQ(outputs_of(options).size(), 4u);
}

TEST(PlaneOptions, FormatsByExtension) {
  EXPECT_EQ(parsed_plane({"a.svg", "-o", "b.svg"}).format(), PlaneFormat::kSvg);
  EXPECT_EQ(parsed_plane({"a.svg", "-o", "b.csv"}).format(), PlaneFormat::kCsv);
  EXPECT_EQ(parsed_plane({"a.svg", "-o", "-"}).format(), PlaneFormat::kJson);
  EXPECT_THAT(plane_message({"a.svg", "-o", "b.ply"}), HasSubstr("'b.ply' ends in none of .json, .geojson"));
}

TEST(PlaneOptions, SaysWhatIsWrong) {
  EXPECT_THAT(plane_message({}), HasSubstr("give a file with a shape"));
  EXPECT_THAT(plane_message({"a.svg", "b.svg"}), HasSubstr("one shape at a time"));
  EXPECT_THAT(plane_message({"a.svg", "--margin", "3"}), HasSubstr("--side outside"));
  EXPECT_THAT(plane_message({"a.svg", "--prune-length", "x"}), HasSubstr("--prune-length: 'x' is not a number"));
  EXPECT_THAT(plane_message({"a.svg", "--prune-length", "-1"}), HasSubstr("--prune-length: -1 is not between 0 and"));
  EXPECT_THAT(plane_message({"a.svg", "--smooth", "1001%"}), HasSubstr("% of the longest side"));
  EXPECT_THAT(plane_message({"a.svg", "--step", "0"}), HasSubstr("--step is less than"));
  EXPECT_THAT(plane_message({"a.svg", "--flatness", "1%"}), HasSubstr("without %"));
  EXPECT_THAT(plane_message({"a.svg", "--flatness", "0"}), HasSubstr("--flatness must be more than 0"));
  EXPECT_THAT(plane_message({"a.obj", "--slice", "z=1", "--flatness", "1"}), HasSubstr("a slice has none"));
  EXPECT_THAT(plane_message({"a.svg", "--object-angle", "2"}), HasSubstr("strictly between 0 and 1.5708 radians"));
  EXPECT_THAT(plane_message({"a.svg", "--mode", "rough"}), HasSubstr("use certified"));
  EXPECT_THAT(plane_message({"a.svg", "-o", "a.svg"}), HasSubstr("would overwrite the input"));
  EXPECT_THAT(plane_message({"a.svg", "--report", "-", "-o", "-"}), HasSubstr("are the same file"));
  EXPECT_THAT(plane_message({"a.svg", "--prune-lenght", "3"}), HasSubstr("did you mean --prune-length?"));
  EXPECT_THAT(plane_message({"a.svg", "-q", "-v"}), HasSubstr("cannot be used together"));
}

TEST(PlaneOptions, AsPublishedThereArePointsInsideAlone) {
  const auto options = parse_plane_options({"a.svg", "--mode", "thesis"});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options.value().mode, PlaneMode::kThesis);
  EXPECT_THAT(plane_message({"a.svg", "--mode", "thesis", "--side", "both"}), HasSubstr("the inside only"));
  EXPECT_THAT(plane_message({"a.svg", "--mode", "thesis", "--longest-path"}), HasSubstr("are about branches"));
  EXPECT_THAT(plane_message({"a.svg", "--mode", "thesis", "--prune-length", "1"}), HasSubstr("are about branches"));
  EXPECT_THAT(plane_message({"a.svg", "--mode", "thesis", "--check"}), HasSubstr("can miss points"));
}

TEST(PlaneOptions, HelpIsNarrowAndNamesEveryOption) {
  std::istringstream lines(plane_help_text());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  for (const char* option : {"--slice", "--side", "--margin", "--prune-length", "--prune-significance",
                             "--longest-path", "--smooth", "--step", "--fill", "--flatness", "--check", "--mode"}) {
    EXPECT_THAT(plane_help_text(), HasSubstr(option));
  }
}

}  // namespace
}  // namespace medial_vk::cli
