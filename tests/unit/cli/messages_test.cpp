// The messages and exit codes of the command line for errors of the library.
#include "cli/terminal/messages.h"
#include "cli/help/help_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/clearance_options.h"
#include "cli/options/distance_options.h"
#include "cli/options/doctor_options.h"
#include "cli/options/options.h"
#include "cli/options/spheres_options.h"
#include "common/tool_errors.h"
#include "support/source_folder.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

/// The text of all sources in a folder, each file with its name.
std::vector<std::pair<std::string, std::string>> sources_in(const char* folder) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(test::source_folder() / folder)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
    std::ifstream file(entry.path());
    out.emplace_back(entry.path().string(), std::string(std::istreambuf_iterator<char>(file), {}));
  }
  return out;
}

/// The string literals of a source, adjacent ones joined; comments, characters and names of headers are left out.
std::vector<std::string> literals_in(const std::string& source) {
  std::vector<std::string> out;
  bool joins = false;  // the last token was a literal
  const auto end_of = [&](std::size_t from, char quote) {
    std::size_t i = from + 1;
    while (i < source.size() && source[i] != quote) i += source[i] == '\\' ? 2 : 1;
    return std::min(i, source.size());
  };
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i];
    const bool is_comment = c == '/' && i + 1 < source.size() && source[i + 1] == '/';
    if (is_comment || c == '#') {
      i = std::min(source.find('\n', i), source.size());
    } else if (c == '"') {
      const std::size_t end = end_of(i, '"');
      if (!joins) out.emplace_back();
      out.back() += source.substr(i + 1, end - i - 1);
      joins = true;
      i = end;
    } else if (c == '\'') {
      // Between digits it separates thousands.
      if (i == 0 || std::isalnum(static_cast<unsigned char>(source[i - 1])) == 0) i = end_of(i, '\'');
      joins = false;
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      joins = false;
    }
  }
  return out;
}

/// Those of the library.
std::vector<std::string> library_literals() {
  std::vector<std::string> out;
  for (const auto& [name, source] : sources_in("runtime/src")) {
    for (std::string& literal : literals_in(source)) out.push_back(std::move(literal));
  }
  return out;
}

/// All matches of a group in a text.
std::set<std::string> matches(const std::string& text, const char* pattern) {
  std::set<std::string> out;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) out.insert((*it)[1]);
  return out;
}

// A contract with scripts (docs/command-line.md).
TEST(Messages, ExitCodes) {
  EXPECT_EQ(exit_code(ErrorCode::kInternal), 1);
  EXPECT_EQ(exit_code(ErrorCode::kUsage), 2);
  EXPECT_EQ(exit_code(ErrorCode::kInvalidMesh), 3);
  EXPECT_EQ(exit_code(ErrorCode::kNoDevice), 4);
  EXPECT_EQ(exit_code(ErrorCode::kOutOfMemory), 5);
  EXPECT_EQ(exit_code(kCannotWrite), 6);
  EXPECT_EQ(exit_code(kDiskFails), 6);
  EXPECT_EQ(exit_code(kCheckFailed), 7);
  EXPECT_EQ(exit_code(ErrorCode::kInterrupted), 130);
}

TEST(Messages, ParametersBecomeOptions) {
  EXPECT_EQ(in_words_of_options("raise `memory_budget` or `resolution`; `memory_budget`", Command::kExtract),
            "raise --memory or --resolution; --memory");
  EXPECT_EQ(in_words_of_options("raise `memory_budget` or `resolution`", Command::kSpheres),
            "raise the memory budget or --resolution");
  EXPECT_EQ(in_words_of_options("try a lower `count`", Command::kSpheres), "try a lower --count");
  EXPECT_EQ(in_words_of_options("try a lower `count`", Command::kRobotSpheres),
            "try a lower --count-per-link or --total");
  EXPECT_EQ(in_words_of_options("link `arm`", Command::kRobotSpheres), "link `arm`");
  EXPECT_EQ(in_words_of_options("`tolerance` and `limit`", Command::kDistance), "--tolerance and --limit");
  testing::internal::CaptureStderr();
  EXPECT_EQ(report_error({ErrorCode::kOutOfMemory, "lower `resolution`"}, Command::kExtract), 5);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "medial-vk: lower --resolution\n");
}

TEST(Messages, AUsageErrorPointsAtTheHelpOfItsCommand) {
  const auto printed = [](Command command) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(report_error({ErrorCode::kUsage, "no"}, command), 2);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(printed(Command::kExtract), "medial-vk: no\nTry medial-vk --help.\n");
  EXPECT_EQ(printed(Command::kBatch), "medial-vk: no\nTry medial-vk batch --help.\n");
  EXPECT_EQ(printed(Command::kSpheres), "medial-vk: no\nTry medial-vk spheres --help.\n");
  EXPECT_EQ(printed(Command::kRobotSpheres), "medial-vk: no\nTry medial-vk spheres --help.\n");
  EXPECT_EQ(printed(Command::kDistance), "medial-vk: no\nTry medial-vk distance --help.\n");
  EXPECT_EQ(printed(Command::kClearance), "medial-vk: no\nTry medial-vk clearance --help.\n");
  EXPECT_EQ(printed(Command::kCurvature), "medial-vk: no\nTry medial-vk curvature --help.\n");
  EXPECT_EQ(printed(Command::kPlane), "medial-vk: no\nTry medial-vk plane --help.\n");
  EXPECT_EQ(printed(Command::kFit), "medial-vk: no\nTry medial-vk fit --help.\n");
  EXPECT_EQ(printed(Command::kVoronoi), "medial-vk: no\nTry medial-vk voronoi --help.\n");
  EXPECT_EQ(printed(Command::kDoctor), "medial-vk: no\nTry medial-vk doctor --help.\n");
}

TEST(Messages, LiteralsOfASource) {
  EXPECT_THAT(literals_in("#include \"a.h\"\nf(\"a `b\"\n  \"c` d\"); // \"no\"\ng('\"', 1'000, \"\\\"e\", \"f\");"),
              testing::ElementsAre("a `bc` d", "\\\"e", "f"));
}

TEST(Messages, EveryParameterInAMessageOfTheLibraryHasWords) {
  std::set<std::string> named, known;
  for (const std::string& literal : library_literals()) named.merge(matches(literal, "`([^`]*)`"));
  for (const ParameterWords& parameter : parameter_words()) {
    EXPECT_TRUE(known.emplace(parameter.parameter).second) << parameter.parameter << " is listed twice";
  }
  EXPECT_THAT(named, testing::ContainerEq(known));
  EXPECT_TRUE(named.contains("resolution"));
}

TEST(Messages, ParametersAreThoseOfPublicHeaders) {
  std::string headers;
  for (const auto& [name, source] : sources_in("runtime/include/medial_vk")) headers += source;
  const std::set<std::string> identifiers = matches(headers, "\\b([a-z_]+)\\b(?= = |,|\\)|;)");
  for (const ParameterWords& parameter : parameter_words()) {
    EXPECT_TRUE(identifiers.contains(std::string(parameter.parameter))) << parameter.parameter;
  }
}

TEST(Messages, WordsNameOptionsOfTheirCommand) {
  const auto options_in = [](const std::string& text) { return matches(text, "(--[a-z-]+)"); };
  const std::set<std::string> of_extract = options_in(help_text()), of_spheres = options_in(spheres_help_text());
  const std::set<std::string> of_doctor = options_in(doctor_help_text());
  const std::set<std::string> of_distance = options_in(distance_help_text());
  const std::set<std::string> of_clearance = options_in(clearance_help_text());
  const std::set<std::string> of_follow = options_in(follow_help_text());
  const std::set<std::string> of_plane = options_in(plane_help_text());
  for (const ParameterWords& parameter : parameter_words()) {
    EXPECT_THAT(of_extract, testing::IsSupersetOf(options_in(std::string(parameter.extract))));
    EXPECT_THAT(of_spheres, testing::IsSupersetOf(options_in(std::string(parameter.spheres))));
    EXPECT_THAT(of_spheres, testing::IsSupersetOf(options_in(std::string(parameter.robot_spheres))));
    EXPECT_THAT(of_doctor, testing::IsSupersetOf(options_in(std::string(parameter.doctor))));
    EXPECT_THAT(of_distance, testing::IsSupersetOf(options_in(std::string(parameter.distance))));
    EXPECT_THAT(of_clearance, testing::IsSupersetOf(options_in(std::string(parameter.distance))));
    EXPECT_THAT(of_follow, testing::IsSupersetOf(options_in(std::string(parameter.follow))));
    EXPECT_THAT(of_plane, testing::IsSupersetOf(options_in(std::string(parameter.plane))));
    EXPECT_THAT(of_clearance, testing::IsSupersetOf(options_in(std::string(parameter.clearance))));
  }
}

// The library knows neither the options of the tool nor its files.
TEST(Messages, TheLibraryDoesNotSpeakOfTheTool) {
  for (const std::string& literal : library_literals()) {
    EXPECT_THAT(matches(literal, "(?:^|[^-])(--[a-z])"), testing::IsEmpty()) << literal;
    EXPECT_THAT(literal, testing::Not(testing::HasSubstr("was written")));
  }
}

}  // namespace
}  // namespace medial_vk::cli
