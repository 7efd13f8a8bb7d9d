// Motions keep their balls: those of every frame against files in tests/golden. Without steps only +, -, *, / and
// square roots, which are rounded exactly, lead from the vertices to the balls, so that every compiler and every number
// of threads gives these numbers to the last bit. Areas of unions, which steps take, are sums of arc tangents, and
// covers solve linear equations: these may differ in their last bits from machine to machine. The files are written
// anew if MEDIAL_VK_UPDATE_GOLDEN is set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/solids/motions.h"
#include "support/source_folder.h"
#include "unit/cover_following/cover_example.h"
#include "unit/following/followed_example.h"

namespace medial_vk {
namespace {

constexpr int kGoldenFrames = 4;

/// 20 bits after the point: sines of the mesh and of the motion may differ in their last bits.
double rounded(double x) { return std::round(x * 0x1p20) * 0x1p-20; }

Frame rounded(Frame vertices) {
  for (Point& p : vertices) {
    for (double& x : p) x = rounded(x);
  }
  return vertices;
}

Mesh golden_torus() {
  Mesh torus = test::make_torus(2, 0.75, 24, 16);
  torus.vertices = rounded(torus.vertices);
  return torus;
}

/// Three unequal sides, so that no ball has a choice between contacts as near as each other.
Mesh golden_corner() {
  Mesh corner = test::make_l_shape(2, 0.6, 0.8);
  test::rotate(corner, {1, 2, 3}, 0.4);
  corner.vertices = rounded(corner.vertices);
  return corner;
}

/// The rest pose, and frames of a twist.
std::vector<Frame> golden_frames(const Frame& rest) {
  std::vector<Frame> frames = {rest};
  for (int frame = 1; frame <= kGoldenFrames; ++frame) {
    frames.push_back(
        rounded(test::moved_vertices(rest, test::Motion::kTwist, static_cast<double>(frame) / kGoldenFrames)));
  }
  return frames;
}

using Tracks = std::vector<std::vector<Ball>>;  // the balls, by frame

Example torus_with_balls() {
  Example solid(golden_torus(), 0);
  solid.balls = {
      {{2, 0, 0}, 0.25}, {{0.25, 1.9375, 0.125}, 0.25}, {{-1.5, 1.25, 0}, 0.5}, {{-1.25, -1.5, -0.125}, 0.25}};
  return solid;
}

Tracks inside_tracks(const Example& solid, const FollowerOptions& options, const std::vector<Frame>& frames) {
  Follower follower = solid.follower(options);
  Tracks tracks = {copy_of(follower.balls())};
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_TRUE(follower.update(frames[i]));
    tracks.push_back(copy_of(follower.balls()));
  }
  return tracks;
}

Tracks step_tracks(const std::vector<Frame>& frames) {
  constexpr int kBallsInside = 24;
  const Example solid(golden_corner(), kBallsInside);
  return inside_tracks(solid, {}, frames);
}

Tracks cover_tracks(const std::vector<Frame>& frames) {
  const CoverExample solid(golden_corner(), 0.7);
  CoverFollower follower = CoverFollower::create(solid.mesh, solid.balls, {.steps = 1}).value();
  Tracks tracks = {copy_of(follower.balls())};
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_TRUE(follower.update(frames[i]));
    EXPECT_EQ(follower.state(), CoverState::kSolid);
    tracks.push_back(copy_of(follower.balls()));
  }
  return tracks;
}

std::string table_of(const Tracks& tracks) {
  std::string table = "frame,ball,x,y,z,radius\n";
  for (std::size_t frame = 0; frame < tracks.size(); ++frame) {
    for (std::size_t i = 0; i < tracks[frame].size(); ++i) {
      const auto& [centre, radius] = tracks[frame][i];
      table += fmt::format("{},{},{},{},{},{}\n", frame, i, centre[0], centre[1], centre[2], radius);
    }
  }
  return table;
}

Tracks tracks_of(const std::string& table) {
  Tracks tracks;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::size_t frame = 0, ball = 0;
    Ball read;
    words >> frame >> ball >> read.centre[0] >> read.centre[1] >> read.centre[2] >> read.radius;
    if (frame == tracks.size()) tracks.emplace_back();
    tracks.at(frame).push_back(read);
  }
  return tracks;
}

double greatest_difference_of(const Tracks& a, const Tracks& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, greatest_difference(a[i], b[i]));
  return greatest;
}

std::string golden_table(const std::string& name, const Tracks& tracks) {
  const std::string path = test::source_folder() / "tests" / "golden" / name;
  if (std::getenv("MEDIAL_VK_UPDATE_GOLDEN") != nullptr) std::ofstream(path, std::ios::binary) << table_of(tracks);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// How much the balls change where every coordinate of every frame but the first does in its last bits.
double sensitivity(const std::vector<Frame>& frames, const std::function<Tracks(const std::vector<Frame>&)>& follow) {
  const Tracks exact = follow(frames);
  double greatest = 0;
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 4; ++trial) {
    std::vector<Frame> changed = frames;
    for (std::size_t i = 1; i < changed.size(); ++i) {
      for (Point& p : changed[i]) {
        for (double& x : p) x *= 1 + 0x1p-52 * static_cast<double>(random() % 5) - 0x1p-51;
      }
    }
    greatest = std::max(greatest, greatest_difference_of(exact, follow(changed)));
  }
  return greatest;
}

void expect_close(const std::string& name, const std::function<Tracks(const std::vector<Frame>&)>& follow) {
  const std::vector<Frame> frames = golden_frames(golden_corner().vertices);
  const Tracks tracks = follow(frames), golden = tracks_of(golden_table(name, tracks));
  ASSERT_EQ(golden.size(), tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) ASSERT_EQ(golden[i].size(), tracks[i].size());
  const double rounding = sensitivity(frames, follow);
  ASSERT_GT(rounding, 0);
  ASSERT_LT(rounding, 1e-9) << "a file of balls that rounding alone moves far tells nothing";
  EXPECT_LE(greatest_difference_of(tracks, golden), 8 * rounding);
}

TEST(GoldenMotion, WithoutStepsEveryBallStays) {
  const Tracks tracks = inside_tracks(torus_with_balls(), {.steps = 0}, golden_frames(golden_torus().vertices));
  EXPECT_EQ(table_of(tracks), golden_table("torus_twist.csv", tracks));
}

TEST(GoldenMotion, AsPublishedEveryBallStays) {
  FollowerOptions options;
  options.rule = FollowRule::kPublished;
  const Tracks tracks = inside_tracks(torus_with_balls(), options, golden_frames(golden_torus().vertices));
  EXPECT_EQ(table_of(tracks), golden_table("torus_twist_published.csv", tracks));
}

TEST(GoldenMotion, WithAStepEveryBallStaysUpToRounding) { expect_close("corner_twist_step.csv", step_tracks); }

TEST(GoldenMotion, EveryBallOfACoverStaysUpToRounding) { expect_close("corner_twist_cover.csv", cover_tracks); }

}  // namespace
}  // namespace medial_vk
