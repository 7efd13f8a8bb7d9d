// Patterns of file names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "motion_files/frame_patterns.h"
#include "support/device/device.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class FramePatterns : public testing::Test {
 protected:
  void make(const std::vector<std::string>& names) const {
    for (const std::string& name : names) std::ofstream(folder_ / name) << "x";
  }

  Result<std::vector<std::string>> files(const std::string& pattern) const {
    return files_of_pattern((folder_ / pattern).generic_string());
  }

  /// The names of the files, without their folder.
  std::vector<std::string> names(const std::string& pattern) const {
    const Result<std::vector<std::string>> found = files(pattern);
    EXPECT_TRUE(found.ok()) << found.error().message;
    std::vector<std::string> short_names;
    if (!found.ok()) return short_names;
    for (const std::string& file : found.value()) {
      EXPECT_TRUE(fs::exists(file)) << file;
      short_names.push_back(fs::path(file).filename().string());
    }
    return short_names;
  }

  std::string message(const std::string& pattern, ErrorCode code) const {
    const Result<std::vector<std::string>> found = files(pattern);
    EXPECT_FALSE(found.ok());
    if (found.ok()) return {};
    EXPECT_EQ(found.error().code, code);
    return found.error().message;
  }

  const test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path().generic_string();
};

TEST_F(FramePatterns, NumbersWithLeadingZeros) {
  make({"w_0008.obj", "w_0009.obj", "w_0010.obj", "w_9.obj", "w_00011.obj", "w_0011.ply", "x_0011.obj", "w_00x1.obj"});
  EXPECT_THAT(names("w_%04d.obj"), ElementsAre("w_0008.obj", "w_0009.obj", "w_0010.obj"));
  EXPECT_THAT(names("w_####.obj"), ElementsAre("w_0008.obj", "w_0009.obj", "w_0010.obj"));
}

TEST_F(FramePatterns, NumbersWithoutLeadingZerosAndLongerOnes) {
  make({"98", "99", "100", "101", "007"});
  EXPECT_THAT(names("%d"), ElementsAre("98", "99", "100", "101"));
  EXPECT_THAT(names("##"), ElementsAre("98", "99", "100", "101"));
  make({"a%1"});
  EXPECT_THAT(names("a%%%d"), ElementsAre("a%1"));
}

TEST_F(FramePatterns, TheFirstMissingFileIsNamed) {
  make({"w_03.obj", "w_04.obj", "w_06.obj", "w_08.obj"});
  EXPECT_THAT(message("w_%02d.obj", ErrorCode::kInvalidMesh),
              testing::StartsWith((folder_ / "w_05.obj").generic_string() +
                                  ": is missing, between the first and the last file of"));
  EXPECT_THAT(names("w_*.obj"), ElementsAre("w_03.obj", "w_04.obj", "w_06.obj", "w_08.obj"));
}

TEST_F(FramePatterns, WildcardsAreInNaturalOrder) {
  make({"w10.obj", "w9.obj", "w1.obj", "w1.ply", ".w2.obj", "w.obj", "w[1].obj"});
  EXPECT_THAT(names("w?.obj"), ElementsAre("w1.obj", "w9.obj"));
  EXPECT_THAT(names("w*.obj"), ElementsAre("w.obj", "w1.obj", "w9.obj", "w10.obj", "w[1].obj"));
  EXPECT_THAT(names("w[0-9].obj"), ElementsAre("w1.obj", "w9.obj"));
  EXPECT_THAT(names("w[!1].obj"), ElementsAre("w9.obj"));
  EXPECT_THAT(names("w[1-9]*.obj"), ElementsAre("w1.obj", "w9.obj", "w10.obj"));
  message("*2.obj", ErrorCode::kInvalidMesh);  // .w2.obj is hidden, as in a shell
}

TEST_F(FramePatterns, BracketsBesideANumberAreAPartOfTheName) {
  make({"w[1]_1.obj", "w[1]_2.obj", "w1_1.obj"});
  EXPECT_THAT(names("w[1]_%d.obj"), ElementsAre("w[1]_1.obj", "w[1]_2.obj"));
  EXPECT_THAT(names("w[1]_#.obj"), ElementsAre("w[1]_1.obj", "w[1]_2.obj"));
}

TEST_F(FramePatterns, NoFileIsAnError) {
  for (const char* pattern : {"w_%04d.obj", "w_##.obj"}) {
    EXPECT_THAT(message(pattern, ErrorCode::kInvalidMesh), HasSubstr(std::string(pattern) + ": there is no such file"));
  }
  EXPECT_THAT(message("none/w_%d.obj", ErrorCode::kInvalidMesh), HasSubstr("its folder cannot be read: No such file"));
}

TEST_F(FramePatterns, OthersAreRefused) {
  for (const char* pattern : {"w%s", "w%", "w%4d", "w%0d", "w%099d", "w%04", "w_##_##", "w%d#", "w*#", "w", "w%%",
                              "w####################.obj", "w*/a.obj"}) {
    EXPECT_THAT(message(pattern, ErrorCode::kUsage), HasSubstr("\"")) << pattern;
  }
}

TEST_F(FramePatterns, AFileOfJustThisNameIsNoPattern) {
  make({"a#1.obj"});
  EXPECT_FALSE(is_frame_pattern((folder_ / "a#1.obj").generic_string()));
  EXPECT_TRUE(is_frame_pattern((folder_ / "a#2.obj").generic_string()));
  EXPECT_TRUE(is_frame_pattern("walk_%04d.obj"));
  EXPECT_TRUE(is_frame_pattern("a/walk_*.obj"));
  EXPECT_TRUE(is_frame_pattern("a/walk_[1-3].obj"));
  EXPECT_FALSE(is_frame_pattern("a[1]/walk_1.obj"));
  EXPECT_FALSE(is_frame_pattern("walk_1.obj"));
  EXPECT_FALSE(is_frame_pattern("#1/walk_1.obj"));
}

TEST(NaturalOrder, DigitsAreNumbersOfAnyLength) {
  const std::vector<std::string> sorted = {
      "",   "001", "01", "1",    "2", "10",  "99999999999999999999", "100000000000000000000", "a",
      "a1", "a1b", "a2", "a02b", "b", "\xff"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      const int order = compare_naturally(sorted[i], sorted[j]);
      EXPECT_EQ((order > 0) - (order < 0), (i > j) - (i < j)) << sorted[i] << " and " << sorted[j];
    }
  }
}

}  // namespace
}  // namespace medial_vk
