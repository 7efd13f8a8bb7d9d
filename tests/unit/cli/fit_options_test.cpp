// The command line of `medial-vk fit`: defaults, goals, formats, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cli/help/help_texts.h"
#include "cli/options/fit/fit_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

FitCommandOptions parsed_fit(const std::vector<std::string>& arguments) {
  return value_of(parse_fit_options(arguments), arguments);
}

std::string fit_message(const std::vector<std::string>& arguments) {
  return message_of(parse_fit_options(arguments), arguments);
}

TEST(FitOptions, Defaults) {
  const FitCommandOptions options = parsed_fit({"models/part.stl", "--count", "32"});
  EXPECT_EQ(options.input, "models/part.stl");
  EXPECT_EQ(options.output, "part.hulls.json");
  EXPECT_EQ(options.format, HullFormat::kJson);
  EXPECT_EQ(options.hulls.choice, HullChoice::kSlabs);
  EXPECT_EQ(options.hulls.count, 32u);
  EXPECT_EQ(options.hulls.width, 0);
  EXPECT_EQ(options.backend, Backend::kVulkan);
  EXPECT_EQ(options, parsed_fit({"--count=32", "models/part.stl", "--primitives", "slabs"}));
  EXPECT_EQ(parsed_fit({"-", "--count", "2", "--format", "usda"}).output, "stdin.hulls.usda");
}

TEST(FitOptions, GoalsAndTheirRanges) {
  const FitCommandOptions options = parsed_fit({"a.obj", "--parameters", "256", "--error", "0.1", "--max-gap", "0.5",
                                                "--width", "0.01", "--resolution", "40", "--primitives", "mix"});
  EXPECT_EQ(options.hulls.parameters, 256u);
  EXPECT_EQ(options.hulls.error, 0.1);
  EXPECT_EQ(options.hulls.max_gap, 0.5);
  EXPECT_EQ(options.hulls.width, 0.01);
  EXPECT_EQ(options.hulls.resolution, 40u);
  EXPECT_EQ(options.hulls.choice, HullChoice::kMix);
  EXPECT_THAT(fit_message({"a.obj"}), HasSubstr("use --count N, --parameters N, --error E or --max-gap G"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "0"}), HasSubstr("between 1 and 4096 hulls"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4097"}), HasSubstr("between 1 and 4096 hulls"));
  EXPECT_THAT(fit_message({"a.obj", "--parameters", "3"}), HasSubstr("between 4 and 49152 numbers"));
  EXPECT_THAT(fit_message({"a.obj", "--error", "1"}), HasSubstr("--error"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--width", "0"}), HasSubstr("--width"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--primitives", "boxes"}),
              HasSubstr("use balls or capsules or cones or slabs or mix"));
}

TEST(FitOptions, TheExtensionOrTheFormatDecides) {
  const std::pair<const char*, HullFormat> formats[] = {{"b.json", HullFormat::kJson}, {"b.csv", HullFormat::kCsv},
                                                        {"b.MA", HullFormat::kMa},     {"b.usda", HullFormat::kUsd},
                                                        {"b.glb", HullFormat::kGlb},   {"b.gltf", HullFormat::kGltf},
                                                        {"b.obj", HullFormat::kObj}};
  for (const auto& [file, format] : formats) {
    EXPECT_EQ(parsed_fit({"a.stl", "--count", "9", "-o", file}).format, format);
    EXPECT_EQ(parsed_fit({"a.stl", "--count", "9", "-o", "x.txt", "--format", name_of(format)}).format, format);
  }
  EXPECT_EQ(parsed_fit({"a.stl", "--count", "9", "-o", "-"}).format, HullFormat::kJson);
  EXPECT_THAT(fit_message({"a.stl", "--count", "9", "-o", "b.ply"}), HasSubstr("--output: 'b.ply' ends in none of"));
  EXPECT_THAT(fit_message({"a.stl", "--count", "9", "--format", "ply"}), HasSubstr("'ply' is unknown"));
}

TEST(FitOptions, MistakesHaveMessages) {
  EXPECT_THAT(fit_message({"--count", "4"}), HasSubstr("no MESH given"));
  EXPECT_THAT(fit_message({"a.obj", "b.obj", "--count", "4"}), HasSubstr("one mesh at a time"));
  EXPECT_THAT(fit_message({"a.urdf", "--count", "4"}), HasSubstr("is a robot"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "-q", "-v"}), HasSubstr("-q and -v"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--backend", "cpu", "--device", "0"}), HasSubstr("--device"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--picture", "p.jpg"}), HasSubstr("does not end in .png"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--view", "top"}), HasSubstr("--view and --up"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--size", "100"}), HasSubstr("--size"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "-o", "a.obj"}), HasSubstr("a.obj"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "-o", "b.json", "--report", "b.json"}), HasSubstr("--report"));
  EXPECT_THAT(fit_message({"a.obj", "--primitive", "slabs"}), HasSubstr("did you mean --primitives?"));
  EXPECT_THAT(fit_message({"a.obj", "--count", "4", "--contract", "cover"}), HasSubstr("unknown option --contract"));
}

TEST(FitOptions, SpheresWithPrimitivesFitsHulls) {
  EXPECT_TRUE(has_primitives({"spheres", "a.obj", "--primitives", "slabs"}));
  EXPECT_TRUE(has_primitives({"spheres", "--primitives=slabs", "a.obj"}));
  EXPECT_FALSE(has_primitives({"spheres", "a.obj", "--count", "4"}));
  EXPECT_FALSE(has_primitives({"spheres", "--", "--primitives"}));
}

TEST(FitOptions, HelpNamesEveryOption) {
  EXPECT_TRUE(parsed_fit({"--help"}).help);
  for (const char* option :
       {"--primitives", "--count",   "--parameters", "--error",   "--max-gap", "--width",  "--resolution",
        "--output",     "--format",  "--picture",    "--view",    "--up",      "--size",   "--report",
        "--check",      "--backend", "--device",     "--threads", "--quiet",   "--verbose"}) {
    EXPECT_THAT(fit_help_text(), HasSubstr(option));
  }
}

}  // namespace
}  // namespace medial_vk::cli
