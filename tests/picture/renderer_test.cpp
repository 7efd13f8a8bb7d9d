// examples/renderer: its frames show a mesh that deforms with its balls, without messages of Vulkan's validation.
// host.renderer checks the same numbers; this test checks the pictures.
#ifdef MEDIAL_VK_RENDERER
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "picture/perceptual.h"
#include "picture/tolerance.h"

namespace medial_vk {
namespace {

/// Shares of the pixels of a panel.
struct Shares {
  double shape = 0;  ///< Not the background.
  double beads = 0;  ///< Of the left half, the coloured pixels: the balls, since glass is grey.
};

Shares shares_of(const Picture& panel) {
  Shares out;
  const std::uint8_t* background = panel.rgb.data();
  for (std::size_t i = 0; i < panel.rgb.size(); i += 3) {
    const std::uint8_t* pixel = &panel.rgb[i];
    const auto [least, greatest] = std::minmax({pixel[0], pixel[1], pixel[2]});
    const bool is_left = i / 3 % panel.width < panel.width / 2;
    if (!std::equal(pixel, pixel + 3, background)) out.shape += 3.0 / static_cast<double>(panel.rgb.size());
    if (is_left && greatest - least > 40) out.beads += 6.0 / static_cast<double>(panel.rgb.size());
  }
  return out;
}

Picture half_of(const Picture& both, bool right) {
  Picture half;
  half.width = both.width / 2;
  half.height = both.height;
  for (std::size_t row = 0; row < both.height; ++row) {
    const auto from = both.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (row * both.width + (right ? half.width : 0)));
    half.rgb.insert(half.rgb.end(), from, from + static_cast<std::ptrdiff_t>(3 * half.width));
  }
  return half;
}

/// What the example prints, and its first two frames.
struct Drawn {
  int status = -1;
  std::string output;
  std::vector<Picture> frames;
};

Drawn draw(const std::string& way) {
  const std::string folder = testing::TempDir() + "/medial_vk_renderer_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  Drawn drawn;
  FILE* renderer = popen((MEDIAL_VK_RENDERER " " + folder + " 2 " + way + " 2>&1").c_str(), "r");
  if (renderer == nullptr) return drawn;
  for (int c = fgetc(renderer); c != EOF; c = fgetc(renderer)) drawn.output += static_cast<char>(c);
  drawn.status = pclose(renderer);
  for (const char* name : {"/frame-0.png", "/frame-1.png"}) {
    Result<Picture> frame = test::read_png(folder + name);
    if (frame.ok()) drawn.frames.push_back(std::move(frame).value());
  }
  std::filesystem::remove_all(folder);
  return drawn;
}

// Before any device is opened.
TEST(Renderer, ANumberOfFramesThatIsNoneIsRefused) {
  for (const char* number : {"abc", "1", "-3", "4x", "99999999999", "''"}) {
    FILE* renderer = popen((std::string(MEDIAL_VK_RENDERER " /no/such/folder ") + number + " 2>&1").c_str(), "r");
    ASSERT_NE(renderer, nullptr);
    std::string output;
    for (int c = fgetc(renderer); c != EOF; c = fgetc(renderer)) output += static_cast<char>(c);
    const int status = pclose(renderer);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << number << ": " << output;
    EXPECT_EQ(output.rfind("usage: ", 0), 0u) << output;
  }
}

TEST(Renderer, DrawsBallsOfAMeshThatDeformsSearchedAndFollowed) {
  const Drawn both = draw("both");
  if (both.output.find("no device that draws") != std::string::npos) GTEST_SKIP() << both.output;
  ASSERT_EQ(both.status, 0) << both.output;
  ASSERT_EQ(both.frames.size(), 2u);
  std::vector<Picture> panels;  // searched at rest, followed at rest, searched later, followed later
  for (const Picture& frame : both.frames) {
    for (const bool right : {false, true}) panels.push_back(half_of(frame, right));
  }
  for (const Picture& panel : panels) {
    const Shares shares = shares_of(panel);
    EXPECT_GT(shares.shape, 0.2);
    EXPECT_LT(shares.shape, 0.6);
    EXPECT_GT(shares.beads, 0.1);
  }
  EXPECT_TRUE(test::kOtherSamples.exceeded_by(test::look_difference(panels[0], panels[2])));
  EXPECT_TRUE(test::kOtherSamples.exceeded_by(test::look_difference(panels[1], panels[3])));
  // At rest the balls that follow are those of the search.
  const test::LookDifference at_rest = test::look_difference(panels[0], panels[1]);
  EXPECT_FALSE(test::kOtherSamples.exceeded_by(at_rest)) << at_rest.mean << ' ' << at_rest.worst;
  // Later they are others, but in the same solid.
  const test::LookDifference later = test::look_difference(panels[2], panels[3]);
  EXPECT_TRUE(test::kOtherSamples.exceeded_by(later)) << later.mean << ' ' << later.worst;
  EXPECT_NEAR(shares_of(panels[2]).shape, shares_of(panels[3]).shape, 0.001);

  // Without a choice they follow, as they do beside the search, except that edges are rounded elsewhere.
  const Drawn followed = draw("");
  ASSERT_EQ(followed.status, 0) << followed.output;
  ASSERT_EQ(followed.frames.size(), 2u);
  test::expect_same_look(followed.frames[0], panels[1], test::kSameSamples);
  test::expect_same_look(followed.frames[1], panels[3], test::kSameSamples);
}

}  // namespace
}  // namespace medial_vk
#endif
