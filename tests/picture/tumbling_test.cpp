// examples/tumbling: two boxes bounce, the page has a distance within its bounds for every frame, and errors are told.
#ifdef MEDIAL_VK_TUMBLING
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

// The boxes overlap at first, and have parted after some 40 frames, as the balls that give them their mass decide.
constexpr std::size_t kFrames = 80;

class TumblingExample : public testing::Test {
 protected:
  TumblingExample() : folder_(testing::TempDir() + "/medial_vk_tumbling_" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ + "/box.obj") << test::to_obj(test::make_box({1, 0.8, 0.6}));
  }
  ~TumblingExample() override { std::filesystem::remove_all(folder_); }

  /// The exit code; what it prints is in `printed_`.
  int run(const std::string& arguments) {
    printed_.clear();
    FILE* tumbling = popen(("cd " + folder_ + " && " MEDIAL_VK_TUMBLING " " + arguments + " 2>&1").c_str(), "r");
    if (tumbling == nullptr) return -1;
    for (int c = std::fgetc(tumbling); c != EOF; c = std::fgetc(tumbling)) printed_ += static_cast<char>(c);
    const int status = pclose(tumbling);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string page() const {
    std::ifstream file(folder_ + "/page.html", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string folder_, printed_;
};

/// The numbers of an array of the page's data.
std::vector<double> numbers_of(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find("\"" + name + "\":[");
  if (begin == std::string::npos) return {};
  std::istringstream text(page.substr(begin + name.size() + 4, page.find(']', begin) - begin - name.size() - 4));
  std::vector<double> numbers;
  for (std::string word; std::getline(text, word, ',');) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

TEST_F(TumblingExample, ThePageHasADistanceWithinItsBoundsForEveryFrame) {
  ASSERT_EQ(run("box.obj page.html " + std::to_string(kFrames)), 0) << printed_;
  EXPECT_EQ(printed_, "");
  const std::string text = page();
  EXPECT_THAT(text, testing::StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("<!--data-->")));
  EXPECT_EQ(numbers_of(text, "vertices").size(), 3 * 8u);
  EXPECT_EQ(numbers_of(text, "triangles").size(), 3 * 12u);
  EXPECT_EQ(numbers_of(text, "poses").size(), kFrames * 2 * 12);
  EXPECT_EQ(numbers_of(text, "points").size(), kFrames * 2 * 3);
  const std::vector<double> distances = numbers_of(text, "distances");
  ASSERT_EQ(distances.size(), kFrames * 3);
  // Six digits are printed.
  constexpr double kPrinted = 1e-5;
  bool have_moved = false;
  for (std::size_t i = 0; i < distances.size(); i += 3) {
    EXPECT_LE(distances[i], distances[i + 1] * (1 + kPrinted)) << "frame " << i / 3;
    EXPECT_GE(distances[i + 2], distances[i + 1] * (1 - kPrinted)) << "frame " << i / 3;
    have_moved = have_moved || distances[i + 1] != distances[1];
  }
  EXPECT_TRUE(have_moved);
}

TEST_F(TumblingExample, ErrorsAreTold) {
  EXPECT_EQ(run("box.obj"), 2);
  EXPECT_THAT(printed_, testing::StartsWith("usage: tumbling "));
  EXPECT_EQ(run("box.obj page.html 0"), 2);
  EXPECT_EQ(run("none.obj page.html"), 1);
  EXPECT_THAT(printed_, testing::StartsWith("tumbling: "));
  EXPECT_EQ(page(), "");
}

}  // namespace
}  // namespace medial_vk
#endif
