// The command line of `medial-vk distance`: defaults, ranges, files that collide, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "cli/help/help_texts.h"
#include "cli/options/distance_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

DistanceCommandOptions parsed_distance(const std::vector<std::string>& arguments) {
  return value_of(parse_distance_options(arguments), arguments);
}

std::string distance_message(const std::vector<std::string>& arguments) {
  return message_of(parse_distance_options(arguments), arguments);
}

TEST(DistanceOptions, Defaults) {
  DistanceCommandOptions expected;
  expected.a = "a.obj";
  expected.b = "b.stl";
  expected.output = "-";
  const DistanceCommandOptions options = parsed_distance({"a.obj", "b.stl"});
  EXPECT_EQ(options, expected);
  const DistanceOptions of_library = distance_options(options);
  EXPECT_EQ(of_library.tolerance, 0);
  EXPECT_EQ(of_library.limit, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(of_library.surfaces_only);
}

TEST(DistanceOptions, AllAtOnce) {
  const DistanceCommandOptions options =
      parsed_distance({"--poses", "p.csv", "a.obj", "-o", "d.CSV", "--tolerance", "0.5", "--limit", "2e3", "b.obj",
                       "--surfaces", "--keep-inner-faces", "--check", "--threads", "1024", "-v"});
  DistanceCommandOptions expected;
  expected.a = "a.obj";
  expected.b = "b.obj";
  expected.poses = "p.csv";
  expected.output = "d.CSV";
  expected.tolerance = 0.5;
  expected.limit = 2000;
  expected.surfaces = expected.keep_inner_faces = expected.check = expected.verbose = true;
  expected.threads = 1024;
  EXPECT_EQ(options, expected);
  const DistanceOptions of_library = distance_options(options);
  EXPECT_EQ(of_library.tolerance, 0.5);
  EXPECT_EQ(of_library.limit, 2000);
  EXPECT_TRUE(of_library.surfaces_only);
  ASSERT_EQ(outputs_of(options).size(), 3u);
  EXPECT_EQ(*outputs_of(options)[0].file, "d.CSV");
  EXPECT_EQ(distance_options(parsed_distance({"a.obj", "b.obj", "--limit", "0"})).limit, 0);
  EXPECT_TRUE(parsed_distance({"-q", "a.obj", "a.obj"}).quiet);
  EXPECT_TRUE(parsed_distance({"--help"}).help);
  EXPECT_TRUE(parsed_distance({"-h", "a.obj"}).help);
}

TEST(DistanceOptions, WrongOnesAreNamed) {
  EXPECT_EQ(distance_message({}), "give two meshes or body files, A and B");
  EXPECT_EQ(distance_message({"a.obj"}), "give two meshes or body files, A and B");
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "c.obj"}),
              HasSubstr("unexpected 'c.obj': two meshes or body files, A and B"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--surface"}), HasSubstr("did you mean --surfaces?"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--tolerance", "-1"}), HasSubstr("--tolerance: -1 is not between 0"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--tolerance", "nan"}), HasSubstr("--tolerance"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--tolerance", "1mm"}), HasSubstr("'1mm' is not a number"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--limit", "-1"}),
              HasSubstr("--limit: -1 is not between 0 and 1e+30"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--limit", "inf"}), HasSubstr("--limit"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--threads", "1025"}), HasSubstr("--threads: 1025"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--poses"}), HasSubstr("--poses"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "-q", "-v"}), HasSubstr("-q and -v"));
  EXPECT_EQ(distance_message({"a.obj", "b.obj", "-o", "d.json"}), "--output: 'd.json' does not end in .csv");
  EXPECT_EQ(parsed_distance({"a.obj", "b.obj", "--tolerance", "0"}).tolerance, 0);
}

TEST(DistanceOptions, NoInputIsOverwritten) {
  const std::string message = "--output would overwrite the input ";
  EXPECT_EQ(distance_message({"d.csv", "b.obj", "-o", "d.csv"}), message + "d.csv");
  EXPECT_EQ(distance_message({"a.obj", "d.csv", "-o", "./d.csv"}), message + "d.csv");
  EXPECT_EQ(distance_message({"a.obj", "b.obj", "--poses", "d.csv", "-o", "d.csv"}), message + "d.csv");
  EXPECT_EQ(parsed_distance({"a.obj", "b.obj", "--poses", "p.csv", "-o", "d.csv"}).output, "d.csv");
}

TEST(DistanceOptions, StandardInputIsOneFile) {
  const std::string message = "only one of A, B and --poses can be standard input";
  EXPECT_EQ(distance_message({"-", "-"}), message);
  EXPECT_EQ(distance_message({"-", "b.obj", "--poses", "-"}), message);
  EXPECT_EQ(distance_message({"a.obj", "-", "--poses", "-"}), message);
  EXPECT_EQ(parsed_distance({"-", "b.obj"}).a, "-");
  EXPECT_EQ(parsed_distance({"a.obj", "-"}).b, "-");
  // Standard output is another stream.
  EXPECT_EQ(parsed_distance({"a.obj", "b.obj", "--poses", "-", "-o", "-"}).poses, "-");
}

TEST(DistanceOptions, NoLineAffectsTheNext) {
  DistanceOptionParser parser;
  ASSERT_TRUE(parser.parse({"a.obj", "b.obj", "--poses", "p.csv", "--limit", "1", "--check", "-q"}).ok());
  ASSERT_FALSE(parser.parse({"a.obj", "--tolerance", "x"}).ok());
  ASSERT_FALSE(parser.parse({"a.obj"}).ok());
  EXPECT_EQ(parser.parse({"c.obj", "d.obj"}).value(), parsed_distance({"c.obj", "d.obj"}));
}

TEST(DistanceOptions, HelpNamesEveryOption) {
  const std::string help = distance_help_text();
  for (const char* option :
       {"--poses", "--tolerance", "--limit", "--surfaces", "--keep-inner-faces", "--check", "--output", "--row",
        "--threads", "--quiet", "--verbose", "--help", " -o", " -q", " -v", " -h"}) {
    EXPECT_THAT(help, HasSubstr(option));
  }
}

TEST(DistanceOptions, BallsNeedBodyFilesAndNoOptionOfTriangles) {
  EXPECT_TRUE(parsed_distance({"a.body.npz", "b.npz", "--balls"}).balls);
  EXPECT_THAT(distance_message({"a.npz", "b.obj", "--balls"}), HasSubstr("'b.obj' is no body file"));
  EXPECT_THAT(distance_message({"a.npz", "b.npz", "--balls", "--surfaces"}), HasSubstr("--surfaces"));
  EXPECT_THAT(distance_message({"a.npz", "b.npz", "--balls", "--limit", "1"}), HasSubstr("--limit"));
  EXPECT_THAT(distance_message({"a.npz", "b.npz", "--balls", "--limit", "0"}), HasSubstr("--limit"));
}

TEST(DistanceOptions, PicturesAndPages) {
  const DistanceCommandOptions options =
      parsed_distance({"a.obj", "b.obj", "--picture", "p.png", "--html", "p.html", "--up", "z"});
  EXPECT_EQ(options.picture, "p.png");
  EXPECT_EQ(options.html, "p.html");
  EXPECT_EQ(options.view.up, UpAxis::kZ);
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--picture", "p.jpg"}), HasSubstr("does not end in .png"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--html", "p.htm"}), HasSubstr("does not end in .html"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--up", "z"}), HasSubstr("--view and --up"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--html", "-"}), HasSubstr("are the same file"));
  EXPECT_EQ(options.row, 0u);
  EXPECT_EQ(parsed_distance({"a.obj", "b.obj", "--picture", "p.png", "--row", "12"}).row, 12u);
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--html", "p.html", "--row", "0"}),
              HasSubstr("--row: 0 is not between 1 and"));
  EXPECT_THAT(distance_message({"a.obj", "b.obj", "--row", "1"}),
              HasSubstr("use it with --picture FILE.png or --html FILE.html"));
}

}  // namespace
}  // namespace medial_vk::cli
