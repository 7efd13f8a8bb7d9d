// Options for several meshes of one file: the names of the outputs, and what cannot be combined.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/options/options.h"
#include "cli/options/output_names.h"
#include "cli/options/spheres_options.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

TEST(EachOptions, TheNameComesBeforeTheExtension) {
  EXPECT_EQ(with_part("a.csv", "x"), "a.x.csv");
  EXPECT_EQ(with_part("b.c/a.b.json", "x"), "b.c/a.b.x.json");
  EXPECT_EQ(with_part("a.medial.ply", "x"), "a.x.medial.ply");
  EXPECT_EQ(with_part("../a.spheres.PLY", "x"), "../a.x.spheres.PLY");
  EXPECT_EQ(with_part("a.other.ply", "x"), "a.other.x.ply");
  EXPECT_EQ(with_part("a.medial.csv", "x"), "a.x.medial.csv");
  EXPECT_EQ(with_part("a.spheres.foam.json", "x"), "a.x.spheres.foam.json");
  EXPECT_EQ(with_part("report", "x"), "report.x");
}

TEST(EachOptions, EveryOutputGetsTheName) {
  const Result<Options> parsed = parse_options({"m.glb",
                                                "--each",
                                                "--report",
                                                "r",
                                                "--picture",
                                                "p.png",
                                                "--html",
                                                "h.html",
                                                "--medial-mesh",
                                                "m.ma",
                                                "--sheet-curve",
                                                "c.svg",
                                                "--ball-volumes",
                                                "v.csv",
                                                "--boundary",
                                                "b.vtp",
                                                "--thickness-histogram",
                                                "t.svg",
                                                "--thickness-points",
                                                "p.csv"});
  ASSERT_TRUE(parsed.ok()) << parsed.error().message;
  EXPECT_TRUE(parsed.value().each);
  const Options part = options_of_part(parsed.value(), "x");
  EXPECT_EQ(part.output, "m.x.medial.ply");
  EXPECT_EQ(part.report, "r.x");
  EXPECT_EQ(part.picture, "p.x.png");
  EXPECT_EQ(part.html, "h.x.html");
  EXPECT_EQ(part.medial_mesh, "m.x.ma");
  EXPECT_EQ(part.sheet_curve, "c.x.svg");
  EXPECT_EQ(part.ball_volumes, "v.x.csv");
  EXPECT_EQ(part.boundary, "b.x.vtp");
  EXPECT_EQ(part.thickness_histogram, "t.x.svg");
  EXPECT_EQ(part.thickness_points, "p.x.csv");
  EXPECT_EQ(outputs_of(part).size(), 10u);
  for (const NamedOutput& output : outputs_of(part)) EXPECT_THAT(*output.file, HasSubstr(".x")) << output.option;
  // What was not requested stays so.
  EXPECT_EQ(options_of_part(parse_options({"m.glb", "--each"}).value(), "x").report, "");
}

TEST(EachOptions, EveryOutputOfSpheresGetsTheName) {
  const Result<SpheresOptions> parsed = parse_spheres_options(
      {"m.glb", "--each", "--count", "3", "--report", "r.json", "--picture", "p.png", "--histogram", "h.svg"});
  ASSERT_TRUE(parsed.ok()) << parsed.error().message;
  const SpheresOptions part = options_of_part(parsed.value(), "x");
  EXPECT_EQ(part.output, "m.x.spheres.csv");
  EXPECT_EQ(part.report, "r.x.json");
  EXPECT_EQ(part.picture, "p.x.png");
  EXPECT_EQ(part.histogram, "h.x.svg");
  EXPECT_EQ(outputs_of(part).size(), 4u);
}

TEST(EachOptions, StandardOutputIsForOneResult) {
  for (const char* option : {"--output", "--report", "--picture", "--html", "--medial-mesh", "--sheet-curve",
                             "--ball-volumes", "--boundary", "--thickness-histogram", "--thickness-points"}) {
    const Result<Options> parsed = parse_options({"m.glb", "--each", option, "-"});
    ASSERT_FALSE(parsed.ok()) << option;
    EXPECT_EQ(parsed.error().code, ErrorCode::kUsage);
    EXPECT_EQ(parsed.error().message, std::string("--each writes a file for each mesh: ") + option + " cannot be -");
  }
  EXPECT_TRUE(parse_options({"-", "--each"}).ok());
  EXPECT_FALSE(parse_options({"m.glb"}).value().each);
}

}  // namespace
}  // namespace medial_vk::cli
