// The experiment of the source's Section 8.5: two copies of a solid tumble in a box, and in every frame their distance
// is computed by several methods. Rows of a table.
//   bench_tumbling [--frames N] [--repeats N] MESH SOURCE.csv INSIDE.csv COVER.csv
// SOURCE.csv: medial spheres as the source chooses them (medial-vk spheres --method source), which are grown here.
// Frames in which the solids meet are left out. Every query starts from the answer for the frame before. Times are
// medians of the repeats, per frame, on one thread; FCL answers every tenth frame.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "../distances/fcl_peer.h"
#include "../distances/measuring.h"
#include "../trees/binary_tree.h"
#include "../unions/ball_files.h"
#include "grown_balls.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"
#include "tumble.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;

struct Frames {
  std::vector<Pose> poses;        // those in which the solids are apart
  std::vector<double> distances;  // exact
  std::size_t meeting = 0;
};

Frames frames_of(const Body& body, const std::vector<Pose>& poses) {
  Frames frames;
  Distance last;
  for (const Pose& pose : poses) {
    last = or_exit(distance(body, body, pose, {}, last));
    if (last.collision() != Collision::kFree) {
      ++frames.meeting;
      continue;
    }
    frames.poses.push_back(pose);
    frames.distances.push_back(last.upper);
  }
  return frames;
}

/// Prints rows of the table about one mesh.
class Table {
 public:
  Table(std::string mesh, const Frames& frames, double side, int repeats)
      : mesh_(std::move(mesh)), frames_(frames), unit_(side / 10), repeats_(repeats) {}

  /// `answers(visit)` calls visit(i, distance) for each frame. `tests`: pairs of volumes in all frames, 0: not counted.
  void row(const std::string& what, const std::string& tree, const std::function<double()>& run,
           const std::vector<double>& answers, std::uint64_t tests = 0) const {
    double mean = 0, greatest = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const double error = std::abs(answers[i] - frames_.distances[i]) / unit_;
      mean += error / static_cast<double>(answers.size());
      greatest = std::max(greatest, error);
    }
    fmt::print(
        "| {} | {} | {:.3f} / {:.3f} | {} | {:.1f} | {} |\n", mesh_, what, mean, greatest, tree, time_of(run),
        tests > 0 ? fmt::format("{:.0f}", static_cast<double>(tests) / static_cast<double>(answers.size())) : "");
  }

 private:
  double time_of(const std::function<double()>& run) const {
    std::vector<double> times;
    for (int i = 0; i < repeats_; ++i) times.push_back(run());
    return median(times);
  }

  std::string mesh_;
  const Frames& frames_;
  double unit_;
  int repeats_;
};

template <class Volume>
void measure_tree(const Table& table, const Frames& frames, const std::vector<Ball>& balls, const Pairing& pairing,
                  const std::string& name) {
  const BinaryTree<Volume> tree(balls, pairing);
  std::vector<double> answers(frames.poses.size());
  std::uint64_t tests = 0;
  const auto run = [&] {
    tests = 0;
    ClosestPair last;
    return microseconds_each(frames.poses.size(), [&] {
      for (std::size_t i = 0; i < frames.poses.size(); ++i) {
        last = closest_pair(tree, tree, frames.poses[i], last.balls);
        answers[i] = std::max(0.0, last.separation);
        tests += last.tests;
      }
    });
  };
  run();
  table.row(fmt::format("{} grown", balls.size()), name, run, answers, tests);
}

/// The library's tree: `middle` of both bounds, or the upper one.
void measure_bounds(const Table& table, const Frames& frames, const Body& body, const std::string& what, bool middle) {
  std::vector<double> answers(frames.poses.size());
  const auto run = [&] {
    DistanceBounds last;
    return microseconds_each(frames.poses.size(), [&] {
      for (std::size_t i = 0; i < frames.poses.size(); ++i) {
        last = distance_bounds(body, body, frames.poses[i], last);
        answers[i] = middle ? (last.lower + last.upper) / 2 : last.upper;
      }
    });
  };
  run();
  table.row(what, middle ? "8-wide, both bounds" : "8-wide", run, answers);
}

void measure_exact(const Table& table, const Frames& frames, const Body& body, const Mesh& mesh) {
  const std::string what = fmt::format("{} triangles", mesh.triangles.size());
  std::vector<double> answers(frames.poses.size());
  const auto run = [&] {
    Distance last;
    return microseconds_each(frames.poses.size(), [&] {
      for (std::size_t i = 0; i < frames.poses.size(); ++i) {
        last = or_exit(distance(body, body, frames.poses[i], {}, last));
        answers[i] = last.upper;
      }
    });
  };
  run();
  table.row(what, "exact", run, answers);
  if (!FclPeer::is_there()) return;
  const FclPeer peer(mesh);
  Frames few;
  for (std::size_t i = 0; i < frames.poses.size(); i += 10) {
    few.poses.push_back(frames.poses[i]);
    answers[few.poses.size() - 1] = 0;
  }
  answers.resize(few.poses.size());
  const auto run_peer = [&] {
    return microseconds_each(few.poses.size(), [&] {
      for (std::size_t i = 0; i < few.poses.size(); ++i) answers[i] = peer.distance(few.poses[i]);
    });
  };
  const double time = run_peer();
  double greatest = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    greatest = std::max(greatest, std::abs(answers[i] - frames.distances[10 * i]));
  }
  fmt::print("| | {} | differs by at most {:.0e} | FCL, exact | {:.0f} | |\n", what, greatest, time);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t count = 10000;
  int repeats = 3;
  std::string mesh_file, source_file, inside_file, cover_file;
  CLI::App app("Distances of two copies of a solid that tumble in a box.");
  app.add_option("--frames", count, "frames of a sixtieth of a second")->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  app.add_option("mesh", mesh_file)->required();
  app.add_option("source", source_file)->required();
  app.add_option("inside", inside_file)->required();
  app.add_option("cover", cover_file)->required();
  CLI11_PARSE(app, argc, argv);

  const Mesh mesh = or_exit(read_mesh(mesh_file));
  const std::size_t slash = mesh_file.rfind('/') + 1;
  const std::string name = mesh_file.substr(slash, mesh_file.rfind('.') - slash);
  const IndexedMesh indexed = or_exit(IndexedMesh::build(or_exit(prepare_mesh(mesh))));
  const std::vector<Ball> inside = read_balls(inside_file), cover = read_balls(cover_file);
  const std::vector<Ball> grown = or_exit(grown_balls(indexed, read_balls(source_file)));
  const Body body = or_exit(Body::create(indexed, inside, cover));

  const auto& box = indexed.prepared().report;
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (box.lower[k] + box.upper[k]) / 2;
  const double side = longest_side(mesh);
  const Frames frames = frames_of(body, tumble(inside, middle, side, count));
  if (frames.poses.empty()) or_exit(Result<int>(Error{ErrorCode::kInternal, "the solids meet in every frame"}));
  const Table table(name, frames, side, repeats);
  const Pairing down = pair_top_down(grown), up = pair_bottom_up(grown);
  measure_tree<BoundingBall>(table, frames, grown, down, "balls, top-down");
  measure_tree<SweptRectangle>(table, frames, grown, down, "swept rectangles, top-down");
  measure_tree<BoundingBall>(table, frames, grown, up, "balls, bottom-up");
  measure_tree<SweptRectangle>(table, frames, grown, up, "swept rectangles, bottom-up");
  const Body grown_body = or_exit(Body::create(grown, {}));
  measure_bounds(table, frames, grown_body, fmt::format("{} grown", grown.size()), false);
  measure_bounds(table, frames, body, fmt::format("{} inside, {} cover", inside.size(), cover.size()), true);
  measure_exact(table, frames, body, mesh);
  double nearest = side, farthest = 0;
  for (const double d : frames.distances) nearest = std::min(nearest, d), farthest = std::max(farthest, d);
  fmt::print(stderr, "{}: {} frames; in {} the solids meet; distances from {:.3f} to {:.3f} of a side\n", name, count,
             frames.meeting, nearest / side, farthest / side);
}
