// Options about what is measured on the boundary, and what each output needs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/options/measures.h"
#include "medial_vk/thickness.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

Options run_with(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "a.obj");
  return value_of(parse_options(arguments), arguments);
}

std::string refusal_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "a.obj");
  return message_of(parse_options(arguments), arguments);
}

/// "t": thickness by area, "v": also at vertices, "c": curvature.
std::string measures(const std::vector<std::string>& arguments) {
  const MeasuresOfBoundary needed = measures_of(run_with(arguments));
  std::string letters;
  if (needed.thickness) letters += "t";
  if (needed.thickness_at_vertices) letters += "v";
  if (needed.curvature) letters += "c";
  return letters;
}

TEST(BoundaryOptions, OnlyWhatAnOutputNeedsIsMeasured) {
  EXPECT_EQ(measures({}), "");
  EXPECT_EQ(measures({"--html", "a.html", "--report", "r.json", "--picture", "p.png"}), "");
  EXPECT_EQ(measures({"--thickness"}), "t");
  EXPECT_EQ(measures({"--thickness-histogram", "h.svg"}), "t");
  EXPECT_EQ(measures({"--thickness-points", "p.csv"}), "t");
  EXPECT_EQ(measures({"--curvature"}), "c");
  EXPECT_EQ(measures({"--boundary", "b.ply"}), "tvc");
  EXPECT_EQ(measures({"--boundary", "b.ply", "--thickness"}), "tv");
  EXPECT_EQ(measures({"--boundary", "b.ply", "--curvature"}), "c");
  EXPECT_EQ(measures({"--boundary", "b.ply", "--curvature", "--thickness"}), "tvc");
  EXPECT_EQ(measures({"--boundary", "b.ply", "--curvature", "--thickness-histogram", "h.svg"}), "tc");
  EXPECT_EQ(measures({"--html", "a.html", "--thickness"}), "tv");
  EXPECT_EQ(measures({"--picture", "p.png", "--show", "boundary"}), "tv");
  EXPECT_EQ(measures({"--picture", "p.png", "--show", "boundary", "--colour", "kappa2"}), "c");
  EXPECT_EQ(measures({"--picture", "p.png", "--show", "boundary", "--strokes"}), "tvc");
  EXPECT_EQ(measures({"--boundary", "b.glb", "--thickness", "--colour", "shape"}), "tvc");
}

TEST(BoundaryOptions, TheColourIsThatOfWhatIsMeasured) {
  EXPECT_EQ(boundary_colour_of(run_with({"--boundary", "b.glb"})), BoundaryColour::kThickness);
  EXPECT_EQ(boundary_colour_of(run_with({"--boundary", "b.glb", "--curvature"})), BoundaryColour::kShape);
  EXPECT_EQ(boundary_colour_of(run_with({"--boundary", "b.GLB", "--colour", "kappa1"})), BoundaryColour::kKappa1);
  const Options both = run_with({"--boundary", "b.glb", "--picture", "p.png", "--colour", "kappa2"});
  EXPECT_EQ(both.look.colour, PictureColour::kAngle);
  EXPECT_EQ(boundary_colour_of(both), BoundaryColour::kKappa2);
}

TEST(BoundaryOptions, HaveTheDefaultsOfTheLibrary) {
  const ThicknessOptions usual;
  EXPECT_EQ(Options().thickness_width, usual.width);
  EXPECT_EQ(Options().wall_angle, usual.wall_angle);
  EXPECT_EQ(usual.width, 0.02);
  EXPECT_EQ(usual.patience, 50u);
  EXPECT_EQ(usual.queries, 1000u);
}

TEST(BoundaryOptions, HaveRanges) {
  const Options options = run_with({"--thickness", "--thickness-delta", "0.002", "--thickness-width", "0.1",
                                    "--curvature", "--boundary-edge", "0.05"});
  EXPECT_EQ(options.thickness_delta, 0.002);
  EXPECT_EQ(options.thickness_width, 0.1);
  EXPECT_EQ(options.boundary_edge, 0.05);
  for (const char* value : {"0", "0.1", "-1", "nan"}) {
    EXPECT_THAT(refusal_of({"--thickness", "--thickness-delta", value}), HasSubstr("of the longest side")) << value;
  }
  for (const char* value : {"0", "1.5", "inf"}) {
    EXPECT_THAT(refusal_of({"--thickness", "--thickness-width", value}), HasSubstr("of the lower end")) << value;
  }
  EXPECT_THAT(refusal_of({"--curvature", "--boundary-edge", "0.0001"}), HasSubstr("of the longest side"));
}

TEST(BoundaryOptions, WithoutTheirSubjectAreUsageErrors) {
  EXPECT_THAT(refusal_of({"--boundary", "b.obj"}),
              HasSubstr("'b.obj' ends in none of .ply, .glb, .vtp, .npz and .json"));
  EXPECT_THAT(refusal_of({"--thickness-histogram", "h.png"}), HasSubstr("ends in neither .svg nor .csv"));
  EXPECT_THAT(refusal_of({"--thickness-points", "p.ply"}), HasSubstr("ends in none of .npz, .json and .csv"));
  EXPECT_THAT(refusal_of({"--thickness-delta", "0.01"}), HasSubstr("--thickness-delta is about thickness"));
  EXPECT_THAT(refusal_of({"--curvature", "--thickness-width", "0.1"}),
              HasSubstr("--thickness-width is about thickness"));
  EXPECT_THAT(refusal_of({"--boundary-edge", "0.1"}), HasSubstr("--boundary-edge is about vertices"));
  EXPECT_THAT(refusal_of({"--thickness", "--boundary-edge", "0.1"}), HasSubstr("--boundary-edge is about vertices"));
  const std::vector<std::string> no_command = {"thickness", "plate.obj"};
  EXPECT_THAT(message_of(parse_options(no_command), no_command),
              HasSubstr("; thickness is an option: medial-vk plate.obj --thickness"));
  EXPECT_THAT(refusal_of({"b.obj"}), Not(HasSubstr("is an option")));
  EXPECT_THAT(refusal_of({"--wall-angle", "1.3"}), HasSubstr("use it with --thickness, --least-wall"));
  EXPECT_EQ(run_with({"--thickness", "--wall-angle", "1.3"}).wall_angle, 1.3);
  for (const char* measure : {"--least-wall", "--least-gap"}) {
    EXPECT_TRUE(run_with({measure, "--wall-angle", "1.3"}).needs_walls());
  }
  EXPECT_THAT(refusal_of({"--strokes"}), HasSubstr("use it with --picture FILE.png"));
  EXPECT_THAT(refusal_of({"--picture", "p.png", "--strokes"}), HasSubstr("use it with --show boundary"));
  EXPECT_THAT(refusal_of({"--colour", "angle"}), HasSubstr("use them with --picture FILE.png"));
  EXPECT_THAT(refusal_of({"--picture", "p.png", "--show", "boundary", "--colour", "radius"}),
              HasSubstr("not with --show boundary"));
  EXPECT_THAT(refusal_of({"--picture", "p.png", "--colour", "shape"}), HasSubstr("--boundary FILE.glb"));
  EXPECT_THAT(refusal_of({"--boundary", "b.ply", "--colour", "shape"}), HasSubstr("--boundary FILE.glb"));
  EXPECT_THAT(refusal_of({"--boundary", "b.ply", "--thickness-histogram", "./b.ply"}),
              HasSubstr("ends in neither .svg nor .csv"));
  EXPECT_THAT(refusal_of({"--boundary", "b.ply", "--report", "./b.ply"}), HasSubstr("are the same file"));
}

}  // namespace
}  // namespace medial_vk::cli
