// The command line of `medial-vk spheres`: defaults, goals, formats, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cli/help/help_texts.h"
#include "cli/options/spheres_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

SpheresOptions parsed_spheres(const std::vector<std::string>& arguments) {
  return value_of(parse_spheres_options(arguments), arguments);
}

std::string spheres_message(const std::vector<std::string>& arguments) {
  return message_of(parse_spheres_options(arguments), arguments);
}

TEST(SpheresOptions, Defaults) {
  const SpheresOptions mesh = parsed_spheres({"models/part.stl", "--count", "64"});
  EXPECT_FALSE(mesh.is_robot);
  EXPECT_EQ(mesh.output, "part.spheres.csv");
  EXPECT_EQ(mesh.format, SphereFormat::kCsv);
  EXPECT_EQ(mesh.spheres.count, 64u);
  EXPECT_EQ(mesh.spheres.method, SphereMethod::kBest);
  EXPECT_EQ(mesh.spheres.contract, SphereContract::kInside);
  EXPECT_EQ(mesh.spheres.object_angle, 0.6);
  const SpheresOptions robot = parsed_spheres({"a/Arm.URDF", "--count-per-link", "8"});
  EXPECT_TRUE(robot.is_robot);
  EXPECT_EQ(robot.output, "Arm.spheres.urdf");
  EXPECT_FALSE(robot.visual);
  EXPECT_EQ(parsed_spheres({"arm.urdf", "--total", "8", "--levels"}).output, "arm.spheres.json");
  EXPECT_EQ(parsed_spheres({"-", "--count", "8"}).output, "stdin.spheres.csv");
  EXPECT_EQ(parsed_spheres({"a.obj", "--error", "0.1", "--format", "foam"}).output, "a.spheres.foam.json");
  EXPECT_EQ(parsed_spheres({"a.obj", "--max-gap", "0.1", "--format", "curobo"}).output, "a.spheres.yml");
}

TEST(SpheresOptions, TheExtensionOrTheFormatDecides) {
  const auto format = [](const std::string& file) {
    return parsed_spheres({"a.obj", "--count", "9", "-o", file}).format;
  };
  EXPECT_EQ(format("b.csv"), SphereFormat::kCsv);
  EXPECT_EQ(format("b.json"), SphereFormat::kJson);
  EXPECT_EQ(format("b.yml"), SphereFormat::kCurobo);
  EXPECT_EQ(format("b.YAML"), SphereFormat::kCurobo);
  EXPECT_EQ(format("b.xrdf"), SphereFormat::kXrdf);
  EXPECT_EQ(format("b.urdf"), SphereFormat::kUrdf);
  EXPECT_EQ(parsed_spheres({"a.obj", "--count", "9", "-o", "b.json", "--format", "foam"}).format, SphereFormat::kFoam);
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "-o", "b.ply"}), HasSubstr("choose one with --format"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--format", "ply"}), HasSubstr("'ply' is unknown"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--levels", "-o", "b.yml"}),
              HasSubstr("one set of spheres only"));
}

TEST(SpheresOptions, AGoalIsNeeded) {
  EXPECT_THAT(spheres_message({"a.obj"}), HasSubstr("--count N"));
  EXPECT_THAT(spheres_message({"a.urdf"}), HasSubstr("--count-per-link N"));
  EXPECT_THAT(spheres_message({"a.obj", "--resolution", "40"}), HasSubstr("no goal is given: use --count N"));
  EXPECT_EQ(parsed_spheres({"a.obj", "--resolution", "40", "--method", "source"}).spheres.resolution, 40u);
  EXPECT_THAT(spheres_message({"a.urdf", "--count", "9"}), HasSubstr("--count-per-link N or --total N"));
  EXPECT_THAT(spheres_message({"a.urdf", "--total", "9", "--count-per-link", "3"}),
              HasSubstr("cannot be used together"));
  EXPECT_THAT(spheres_message({"a.obj", "--total", "9"}), HasSubstr("'a.obj' is no .urdf"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "0"}), HasSubstr("not between 1 and"));
  EXPECT_THAT(spheres_message({"a.obj", "--error", "1"}), HasSubstr("strictly between 0 and 1"));
  EXPECT_THAT(spheres_message({"a.obj", "--max-gap", "-1"}), HasSubstr("strictly between"));
}

TEST(SpheresOptions, DistancesAsGoals) {
  EXPECT_EQ(parsed_spheres({"a.obj", "--count", "9"}).spheres.aim, SphereAim::kVolume);
  EXPECT_EQ(parsed_spheres({"a.obj", "--count", "9", "--by", "distance"}).spheres.aim, SphereAim::kDistance);
  EXPECT_EQ(parsed_spheres({"a.urdf", "--total", "9", "--by", "auto"}).spheres.aim, SphereAim::kAuto);
  EXPECT_EQ(parsed_spheres({"a.obj", "--max-reach", "0.5", "--contract", "cover"}).spheres.max_reach, 0.5);
  EXPECT_THAT(spheres_message({"a.obj", "--contract", "cover"}), HasSubstr("--error E or --max-reach R"));
  EXPECT_THAT(spheres_message({"a.obj", "--max-reach", "0.5"}), HasSubstr("use it with --contract cover"));
  for (const std::vector<std::string>& without : {std::vector<std::string>{"--error", "0.1"}, {"--levels"}}) {
    std::vector<std::string> words = {"a.obj", "--max-reach", "0.5", "--contract", "cover"};
    words.insert(words.end(), without.begin(), without.end());
    EXPECT_THAT(spheres_message(words), HasSubstr("without --error and --levels"));
  }
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--by", "distance", "--contract", "cover"}),
              HasSubstr("use it with --contract inside"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--by", "distance", "--method", "source"}),
              HasSubstr("--method best"));
  EXPECT_THAT(spheres_message({"a.obj", "--error", "0.1", "--by", "distance"}),
              HasSubstr("--error is about the volume"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--contract", "both", "--max-reach", "1"}),
              HasSubstr("use it with --contract cover"));
}

TEST(SpheresOptions, MistakesAreNamed) {
  EXPECT_EQ(spheres_message({}), "no MESH or ROBOT.urdf given");
  EXPECT_THAT(spheres_message({"a.obj", "--cuont", "9"}), HasSubstr("did you mean --count?"));
  EXPECT_THAT(spheres_message({"a.obj", "b.obj", "--count", "9"}), HasSubstr("one mesh or robot at a time"));
  EXPECT_THAT(spheres_message({"a.urdf.xacro", "--count", "9"}), HasSubstr("expand it first"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--up", "z"}), HasSubstr("--picture"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--picture", "p.jpg"}), HasSubstr(".png"));
  EXPECT_THAT(spheres_message({"a.csv", "--count", "9", "-o", "a.csv"}), HasSubstr("overwrite"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "-o", "a.json", "--report", "a.json"}), HasSubstr("same file"));
  EXPECT_THAT(spheres_message({"a.urdf", "--total", "9", "--visual", "--collision"}), HasSubstr("together"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--object-angle", "0.4"}), HasSubstr("--method source"));
  EXPECT_EQ(
      parsed_spheres({"a.obj", "--count", "9", "--object-angle", "0.4", "--method", "source"}).spheres.object_angle,
      0.4);
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "-q", "-v"}), HasSubstr("-q and -v"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--backend", "cpu", "--device", "1"}), HasSubstr("--device"));
}

TEST(SpheresOptions, ABodyFileHasTwoSets) {
  const SpheresOptions body =
      parsed_spheres({"models/part.stl", "--contract", "both", "--count", "9", "--report", "r"});
  EXPECT_TRUE(body.both);
  EXPECT_EQ(body.output, "part.body.npz");
  EXPECT_EQ(body.report, "r");
  const auto message = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"a.obj", "--contract", "both", "--count", "9"});
    return spheres_message(options);
  };
  EXPECT_EQ(parsed_spheres({"a.obj", "--contract", "both", "--count", "9", "--picture", "p.png", "--up", "z"}).view.up,
            UpAxis::kZ);
  for (const auto& [option, value] : {std::pair("--view", "top"), {"--up", "z"}}) {
    EXPECT_THAT(message({option, value}), HasSubstr("use them with --picture FILE.png"));
  }
  EXPECT_THAT(message({"--picture", "p.jpg"}), HasSubstr("does not end in .png"));
  EXPECT_THAT(message({"--picture", "a.body.npz"}), HasSubstr("does not end in .png"));
  EXPECT_THAT(message({"--histogram", "h.svg"}), HasSubstr("--contract inside, cover or balanced"));
  EXPECT_THAT(message({"-o", "a.csv"}), HasSubstr("does not end in .npz"));
  EXPECT_THAT(spheres_message({"a.urdf", "--contract", "both", "--count", "9"}),
              HasSubstr("medial-vk clearance ROBOT.urdf --joints FILE.csv --balls N --bodies FOLDER"));
  EXPECT_THAT(message({"-o", "a.npz", "--report", "a.npz"}), HasSubstr("same file"));
}

TEST(SpheresOptions, FramesAreOfOneSetInsideAMesh) {
  const SpheresOptions two = parsed_spheres({"a.obj", "--count", "9", "--frames", "b.obj", "c.obj", "-q"});
  EXPECT_EQ(two.frames, (std::vector<std::string>{"b.obj", "c.obj"}));
  EXPECT_EQ(parsed_spheres({"--frames", "b.obj", "--count", "9", "a.obj"}).input, "a.obj");
  EXPECT_EQ(parsed_spheres({"a.glb", "--count", "9", "--frames", "a.glb", "--animation", "w"}).animation, "w");
  const auto message = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"a.obj", "--count", "9", "--frames", "b.obj"});
    return spheres_message(options);
  };
  for (const char* contract : {"cover", "balanced", "both"}) {
    EXPECT_THAT(message({"--contract", contract}), HasSubstr("--contract inside"));
  }
  for (const char* flag : {"--each", "--levels", "--keep-inner-faces"}) EXPECT_THAT(message({flag}), HasSubstr(flag));
  for (const auto& [option, value] : {std::pair("--error", "0.1"),
                                      {"--max-gap", "1"},
                                      {"--by", "distance"},
                                      {"--method", "source"},
                                      {"--picture", "p.png"},
                                      {"--histogram", "h.svg"},
                                      {"--report", "r.json"}}) {
    EXPECT_THAT(message({option, value}), HasSubstr(std::string(option)));
  }
  EXPECT_THAT(message({"--animation", "w"}), HasSubstr("use --frames a.obj"));
  EXPECT_THAT(message({"-o", "b.csv", "--frames", "b.csv"}), HasSubstr("overwrite"));
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--animation", "w"}), HasSubstr("use it with --frames"));
  EXPECT_THAT(spheres_message({"a.obj", "--error", "0.1", "--frames", "b.obj"}), HasSubstr("leave out --frames"));
  EXPECT_THAT(spheres_message({"a.obj", "--frames", "b.obj"}), HasSubstr("--count N"));
  EXPECT_THAT(spheres_message({"a.urdf", "--total", "9", "--frames", "b.obj"}), HasSubstr("do not deform"));
}

TEST(SpheresOptions, FramesAreFilesOrMeshAlone) {
  const auto parse = [](const std::string& mesh, std::vector<std::string> frames) {
    frames.insert(frames.begin(), {mesh, "--count", "9", "--frames"});
    return frames;
  };
  EXPECT_TRUE(frames_are_animation(parsed_spheres(parse("a.glb", {"a.glb"}))));
  EXPECT_TRUE(frames_are_animation(parsed_spheres(parse("a.glb", {"./a.glb"})))) << "by any path";
  EXPECT_TRUE(frames_are_animation(parsed_spheres(parse("b/../a.glb", {"./a.glb", "--animation", "w"}))));
  EXPECT_TRUE(frames_are_animation(parsed_spheres(parse("-", {"-"}))));
  EXPECT_FALSE(frames_are_animation(parsed_spheres(parse("a.glb", {"b/a.glb"}))));
  EXPECT_FALSE(frames_are_animation(parsed_spheres(parse("-", {"a.obj"}))));
  EXPECT_THAT(spheres_message(parse("a.glb", {"b.glb", "./a.glb"})), HasSubstr("./a.glb is MESH itself"));
  EXPECT_THAT(spheres_message(parse("a.obj", {"-"})), HasSubstr("standard input"));
  EXPECT_THAT(spheres_message(parse("a.obj", {"b.obj", "-"})), HasSubstr("standard input"));
  EXPECT_THAT(spheres_message(parse("-", {"-", "-"})), HasSubstr("standard input"));
  EXPECT_EQ(spheres_message({"--frames", "a.obj", "b.obj", "part.obj", "--count", "5"}),
            "no MESH or ROBOT.urdf given (--frames takes all files that follow it: give MESH first)");
}

TEST(SpheresOptions, FramesWithoutAFileAreTheAnimation) {
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{"a.glb", "--count", "9", "--frames"}, Words{"a.GLTF", "--frames", "--count", "9"},
        Words{"--frames", "--count", "9", "a.glb"}, Words{"a.glb", "--count", "9", "--frames="},
        Words{"a.glb", "--count", "9", "--frames", "-q"}, Words{"-", "--frames", "--count", "9"}}) {
    const SpheresOptions options = parsed_spheres(words);
    EXPECT_EQ(options.frames, Words{options.input});
    EXPECT_TRUE(frames_are_animation(options));
  }
  EXPECT_TRUE(parsed_spheres({"a.glb", "--count", "9", "--frames", "-q"}).quiet) << "an option, and no file";
  EXPECT_THAT(spheres_message({"a.obj", "--count", "9", "--frames"}), HasSubstr("a.obj is no .gltf or .glb"));
  EXPECT_THAT(spheres_message({"a.urdf", "--total", "9", "--frames"}), HasSubstr("do not deform"));
  EXPECT_THAT(spheres_message({"--count", "9", "--frames"}), HasSubstr("no MESH or ROBOT.urdf given"));
}

TEST(SpheresOptions, FramesAreNoOptions) {
  const auto message = [](std::vector<std::string> frames) {
    frames.insert(frames.begin(), {"a.glb", "--count", "9"});
    return spheres_message(frames);
  };
  EXPECT_THAT(message({"--frames", "-x"}), HasSubstr("unknown option -x"));
  EXPECT_THAT(message({"--frames", "b.obj", "--quite"}), HasSubstr("did you mean --quiet?"));
  EXPECT_THAT(message({"--frames", "-5"}), HasSubstr("'-5' begins like an option; a file of this name is ./-5"));
  EXPECT_THAT(message({"--frames=-b.obj"}), HasSubstr("'-b.obj' begins like an option"));
  EXPECT_THAT(message({"--frames", "b.obj", ""}), HasSubstr("the name of a file is empty"));
  EXPECT_EQ(parsed_spheres({"a.obj", "--count", "9", "--frames", "./-b.obj"}).frames.front(), "./-b.obj");
}

TEST(SpheresOptions, PackagesAddUp) {
  const SpheresOptions options = parsed_spheres({"a.urdf", "--total", "9", "--package", "a=b", "--package", "c=d"});
  EXPECT_EQ(options.packages, (std::vector<std::string>{"a=b", "c=d"}));
  EXPECT_EQ(options.input, "a.urdf");
  EXPECT_EQ(parsed_spheres({"--package", "a=b", "a.urdf", "--total", "9"}).input, "a.urdf");
}

TEST(SpheresOptions, HelpNeedsNothingElse) {
  EXPECT_TRUE(parsed_spheres({"--help"}).help);
  EXPECT_THAT(spheres_help_text(), HasSubstr("ROBOT.urdf"));
}

}  // namespace
}  // namespace medial_vk::cli
