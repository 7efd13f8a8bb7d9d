// The closest balls of a set and of its copy in random poses, where the search visits first the closer part of a node
// or the likelier one, in binary trees of several kinds: rows of a table.
//   bench_likelihood BALLS.csv ...
// BALLS.csv: as medial-vk spheres writes them. Poses in which balls overlap are left out. Every query begins anew, or
// with the answer for the pose before. Times are medians of five runs, on one thread.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../trees/binary_tree.h"
#include "../trees/likelihood.h"
#include "../unions/ball_files.h"
#include "base/point_ops.h"
#include "measuring.h"
#include "support/random_poses.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;

/// Steps of a walk of the copy around the set, so that poses differ little from those before them.
std::vector<Pose> poses_apart(const BinaryTree<BoundingBall>& tree, std::size_t count, std::vector<double>& distances) {
  const Point middle = tree.node(tree.root()).volume.centre;
  const double size = tree.node(tree.root()).volume.radius;
  test::Random random(1);
  std::vector<Pose> poses;
  while (poses.size() < count) {
    // A turn, and a way past the set.
    const Pose from = test::any_pose(random, {0, 0, 0});
    const Point start = test::point_in_cube(random, 2.5 * size), axis = test::point_in_cube(random, 1);
    for (int step = 0; step < 20; ++step) {
      Pose pose = make_pose({0, 0, 0}, (0.01 * step) * axis) * from;
      pose.shift = {0, 0, 0};
      pose.shift = middle + start + (0.01 * step * size) * axis - pose * middle;
      const double separation = closest_pair(tree, tree, pose).separation;
      if (separation <= 0) continue;
      poses.push_back(pose);
      distances.push_back(separation);
    }
  }
  return poses;
}

template <class Volume>
void measure(const std::string& name, const BinaryTree<Volume>& tree, const std::vector<Pose>& poses, PartOrder order,
             const std::vector<double>& distances) {
  std::string cells;
  for (const bool from_last : {false, true}) {
    std::uint64_t tests = 0;
    std::vector<double> times;
    for (int repeat = 0; repeat < 5; ++repeat) {
      ClosestPair last;
      tests = 0;
      times.push_back(microseconds_each(poses.size(), [&] {
        for (std::size_t i = 0; i < poses.size(); ++i) {
          last = closest_pair(tree, tree, poses[i], from_last ? last.balls : BallPair{}, order);
          tests += last.tests;
          if (std::fabs(last.separation - distances[i]) > 1e-9 * distances[i] + 1e-12) fmt::print("wrong\n");
        }
      }));
    }
    cells += fmt::format(" {:.0f} | {:.1f} |", static_cast<double>(tests) / static_cast<double>(poses.size()),
                         median(times));
  }
  fmt::print("| {} | {} |{}\n", name, order == PartOrder::kCloser ? "closer" : "likelier", cells);
}

template <class Volume>
void measure_both(const std::string& name, const std::vector<Ball>& balls, const Pairing& pairing,
                  const std::vector<double>& likelihoods, const std::vector<Pose>& poses,
                  const std::vector<double>& distances) {
  const BinaryTree<Volume> tree(balls, pairing, likelihoods);
  for (const PartOrder order : {PartOrder::kCloser, PartOrder::kLikelier}) {
    measure(name, tree, poses, order, distances);
  }
}

void measure_file(const std::string& file) {
  const std::vector<Ball> balls = read_balls(file);
  const Pairing down = pair_top_down(balls), up = pair_bottom_up(balls);
  std::vector<double> distances;
  const std::vector<Pose> poses = poses_apart(BinaryTree<BoundingBall>(balls, up), 2000, distances);
  const std::vector<double> likelihoods = likelihoods_of(balls, median(distances));
  const Pairing likely = pair_by_likelihood(balls, likelihoods);
  fmt::print("\n{}: {} balls, {} poses, median distance {:.3g}\n\n", file.substr(file.rfind('/') + 1), balls.size(),
             poses.size(), median(distances));
  fmt::print(
      "| hierarchy | first | pairs tested | us | from the last answer: pairs tested | us "
      "|\n|---|---|---|---|---|---|\n");
  measure_both<BoundingBall>("balls, top-down", balls, down, likelihoods, poses, distances);
  measure_both<BoundingBall>("balls, bottom-up", balls, up, likelihoods, poses, distances);
  measure_both<BoundingBall>("balls, by likelihood", balls, likely, likelihoods, poses, distances);
  measure_both<SweptRectangle>("swept rectangles, top-down", balls, down, likelihoods, poses, distances);
  measure_both<SweptRectangle>("swept rectangles, by likelihood", balls, likely, likelihoods, poses, distances);
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) measure_file(argv[i]);
  return argc > 1 ? 0 : 2;
}
