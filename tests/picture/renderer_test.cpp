// examples/renderer: its frames show a mesh that deforms with its spheres, without messages of Vulkan's validation.
// host.renderer checks the same numbers; this test checks the pictures.
#ifdef MEDIAL_VK_RENDERER
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include "picture/perceptual.h"
#include "picture/tolerance.h"

namespace medial_vk {
namespace {

/// Shares of the pixels of a frame.
struct Shares {
  double shape = 0;  ///< Not the background.
  double beads = 0;  ///< Of the left half, the coloured pixels: the spheres, since glass is grey.
};

Shares shares_of(const Picture& frame) {
  Shares out;
  const std::uint8_t* background = frame.rgb.data();
  for (std::size_t i = 0; i < frame.rgb.size(); i += 3) {
    const std::uint8_t* pixel = &frame.rgb[i];
    const auto [least, greatest] = std::minmax({pixel[0], pixel[1], pixel[2]});
    const bool is_left = i / 3 % frame.width < frame.width / 2;
    if (!std::equal(pixel, pixel + 3, background)) out.shape += 3.0 / static_cast<double>(frame.rgb.size());
    if (is_left && greatest - least > 40) out.beads += 6.0 / static_cast<double>(frame.rgb.size());
  }
  return out;
}

TEST(Renderer, DrawsTheSpheresOfAMeshThatDeforms) {
  const std::string folder = testing::TempDir() + "/medial_vk_renderer_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  FILE* renderer = popen((MEDIAL_VK_RENDERER " " + folder + " 2 2>&1").c_str(), "r");
  ASSERT_NE(renderer, nullptr);
  std::string output;
  for (int c = fgetc(renderer); c != EOF; c = fgetc(renderer)) output += static_cast<char>(c);
  const int status = pclose(renderer);
  std::array<Result<Picture>, 2> frames = {test::read_png(folder + "/frame-0.png"),
                                           test::read_png(folder + "/frame-1.png")};
  std::filesystem::remove_all(folder);
  if (output.find("no device that draws") != std::string::npos) GTEST_SKIP() << output;
  ASSERT_EQ(status, 0) << output;
  for (const Result<Picture>& frame : frames) {
    ASSERT_TRUE(frame.ok()) << frame.error().message;
    const Shares shares = shares_of(frame.value());
    EXPECT_GT(shares.shape, 0.2);
    EXPECT_LT(shares.shape, 0.6);
    EXPECT_GT(shares.beads, 0.1);
  }
  EXPECT_TRUE(test::kOtherSamples.exceeded_by(test::look_difference(frames[0].value(), frames[1].value())));
}

}  // namespace
}  // namespace medial_vk
#endif
