// A motion keeps its balls: those of every frame, to the last bit, against a file in tests/golden. Only +, -, *, / and
// square roots, which are rounded exactly, lead from the vertices to the balls, so that every compiler and every number
// of threads gives these numbers. The file is written anew if MEDIAL_VK_UPDATE_GOLDEN
// is set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "support/solids/motions.h"
#include "support/source_folder.h"
#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

constexpr int kGoldenFrames = 4;

/// Coordinates with 20 bits after the point: sines of the mesh and of the motion may differ in their last bits.
Frame rounded(Frame vertices) {
  for (Point& p : vertices) {
    for (double& x : p) x = std::round(x * 0x1p20) * 0x1p-20;
  }
  return vertices;
}

std::string followed_table() {
  Mesh torus = test::make_torus(2, 0.75, 24, 16);
  torus.vertices = rounded(torus.vertices);
  Example solid(std::move(torus), 0);
  solid.balls = {
      {{2, 0, 0}, 0.25}, {{0.25, 1.9375, 0.125}, 0.25}, {{-1.5, 1.25, 0}, 0.5}, {{-1.25, -1.5, -0.125}, 0.25}};
  Follower follower = solid.follower({.steps = 0});
  std::string table = "frame,ball,x,y,z,radius\n";
  for (int frame = 0; frame <= kGoldenFrames; ++frame) {
    if (frame > 0) {
      const double time = static_cast<double>(frame) / kGoldenFrames;
      EXPECT_TRUE(follower.update(rounded(test::moved_vertices(solid.rest(), test::Motion::kTwist, time))));
    }
    for (std::size_t i = 0; i < follower.balls().size(); ++i) {
      const Ball& ball = follower.balls()[i];
      table +=
          fmt::format("{},{},{},{},{},{}\n", frame, i, ball.centre[0], ball.centre[1], ball.centre[2], ball.radius);
    }
  }
  return table;
}

TEST(GoldenMotion, KeepsEveryBallOfEveryFrame) {
  const std::string path = test::source_folder() / "tests" / "golden" / "torus_twist.csv";
  const std::string table = followed_table();
  if (std::getenv("MEDIAL_VK_UPDATE_GOLDEN") != nullptr) std::ofstream(path, std::ios::binary) << table;
  std::ifstream file(path, std::ios::binary);
  const std::string golden((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(table, golden);
}

}  // namespace
}  // namespace medial_vk
