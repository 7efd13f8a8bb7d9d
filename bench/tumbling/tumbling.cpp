// The experiment of the source's Section 8.5: two copies of a solid tumble in a box, and in every frame their distance
// is computed by several methods. Rows of a table.
//   bench_tumbling [--frames N] [--repeats N] [--hierarchy TEXT] NAME.body.npz SOURCE.csv
// SOURCE.csv: medial spheres as the source chooses them (medial-vk spheres --method source), which are grown here.
// --hierarchy: only rows of hierarchies whose name contains the text.
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
#include "body_files/body_file.h"
#include "grown_balls.h"
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
  Table(std::string mesh, const Frames& frames, double side, int repeats, std::string chosen)
      : mesh_(std::move(mesh)), frames_(frames), unit_(side / 10), repeats_(repeats), chosen_(std::move(chosen)) {}

  /// Whether there is to be a row for a hierarchy.
  bool wants(const std::string& tree) const { return tree.find(chosen_) != std::string::npos; }

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
  std::string chosen_;
};

template <class Volume>
void measure_tree(const Table& table, const Frames& frames, const std::vector<Ball>& balls, const Pairing& pairing,
                  const std::string& name) {
  if (!table.wants(name)) return;
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

/// The library's tree, and the number that `answer_of` takes from both bounds.
void measure_bounds(const Table& table, const Frames& frames, const Body& body, const std::string& what,
                    const std::string& tree, double (*answer_of)(const Body&, const Body&, const DistanceBounds&)) {
  if (!table.wants(tree)) return;
  std::vector<double> answers(frames.poses.size());
  const auto run = [&] {
    DistanceBounds last;
    return microseconds_each(frames.poses.size(), [&] {
      for (std::size_t i = 0; i < frames.poses.size(); ++i) {
        last = distance_bounds(body, body, frames.poses[i], last);
        answers[i] = answer_of(body, body, last);
      }
    });
  };
  run();
  table.row(what, tree, run, answers);
}

void measure_exact(const Table& table, const Frames& frames, const Body& body, const Mesh& mesh) {
  if (!table.wants("exact")) return;
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
  std::string body_file, source_file, hierarchy;
  CLI::App app("Distances of two copies of a solid that tumble in a box.");
  app.add_option("--frames", count, "frames of a sixtieth of a second")->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  app.add_option("--hierarchy", hierarchy, "only those whose name contains the text");
  app.add_option("body", body_file)->required();
  app.add_option("source", source_file)->required();
  CLI11_PARSE(app, argc, argv);

  const BodyFile file = or_exit(read_body_file(body_file));
  const std::size_t slash = body_file.rfind('/') + 1;
  const std::string name = body_file.substr(slash, body_file.find('.', slash) - slash);
  const IndexedMesh indexed = or_exit(IndexedMesh::build(or_exit(prepare_mesh(Mesh(file.mesh)))));
  const std::vector<Ball> grown = or_exit(grown_balls(indexed, read_balls(source_file)));
  const Body body = or_exit(Body::create(indexed, file.inside, file.cover));

  const auto& box = indexed.prepared().report;
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (box.lower[k] + box.upper[k]) / 2;
  const double side = longest_side(file.mesh);
  const Frames frames = frames_of(body, tumble(file.inside, middle, side, count));
  if (frames.poses.empty()) or_exit(Result<int>(Error{ErrorCode::kInternal, "the solids meet in every frame"}));
  const Table table(name, frames, side, repeats, hierarchy);
  const Pairing down = pair_top_down(grown), up = pair_bottom_up(grown);
  measure_tree<BoundingBall>(table, frames, grown, down, "balls, top-down");
  measure_tree<SweptRectangle>(table, frames, grown, down, "swept rectangles, top-down");
  measure_tree<BoundingBall>(table, frames, grown, up, "balls, bottom-up");
  measure_tree<SweptRectangle>(table, frames, grown, up, "swept rectangles, bottom-up");
  const Body grown_body = or_exit(Body::create(grown, {}));
  const std::string both = fmt::format("{} inside, {} cover", file.inside.size(), file.cover.size());
  measure_bounds(table, frames, grown_body, fmt::format("{} grown", grown.size()), "8-wide",
                 [](const Body&, const Body&, const DistanceBounds& bounds) { return bounds.upper; });
  measure_bounds(
      table, frames, body, both, "8-wide, both bounds",
      [](const Body&, const Body&, const DistanceBounds& bounds) { return (bounds.lower + bounds.upper) / 2; });
  measure_bounds(table, frames, body, both, "8-wide, estimate", estimated_distance);
  measure_exact(table, frames, body, file.mesh);
  double nearest = side, farthest = 0;
  for (const double d : frames.distances) nearest = std::min(nearest, d), farthest = std::max(farthest, d);
  fmt::print(stderr, "{}: {} frames; in {} the solids meet; distances from {:.3f} to {:.3f} of a side\n", name, count,
             frames.meeting, nearest / side, farthest / side);
}
