#include "cli/distance/distance_summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/shared/states_text.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "output/distance_files/distances_csv.h"

namespace medial_vk::cli {
namespace {

template <class Interval>
std::string distance_text(const Interval& distance) {
  if (distance.upper == 0) return "0: the solids have a common point";
  return interval_text(distance.lower, distance.upper);
}

std::string point_text(const Point& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

std::string one_pose(const Distance& distance) {
  std::string text = labelled("state", name_of(distance.collision()));
  text += labelled("distance", distance_text(distance));
  if (distance.upper == 0) return text + labelled("point", point_text(distance.on_a));
  return text +
         labelled("points", fmt::format("{} of A, {} of B", point_text(distance.on_a), point_text(distance.on_b)));
}

/// The balls that give an end of the interval, by their indices in the file.
std::string pair_text(const char* set, const BallPair& pair) {
  return pair.a == BallPair::kNone ? "" : fmt::format("{} {} of A and {} of B", set, pair.a, pair.b);
}

std::string one_pose(const DistanceBounds& bounds) {
  std::string text = labelled("state", name_of(bounds.collision())) + labelled("distance", distance_text(bounds));
  const std::string lower = pair_text("lower end by cover", bounds.cover_pair);
  const std::string upper = pair_text("upper end by inside", bounds.inside_pair);
  if (lower.empty() && upper.empty()) return text;
  return text + labelled("by", lower + (lower.empty() || upper.empty() ? "" : ", ") + upper);
}

template <class Interval>
std::string many_poses(std::span<const Interval> distances) {
  std::string text = labelled("poses", grouped(distances.size()));
  text += labelled("states", states_text(distances));
  const auto least = std::ranges::min_element(distances, {}, &Interval::upper);
  return text + labelled("least", fmt::format("{} (pose {})", distance_text(*least), least - distances.begin() + 1));
}

template <class Interval>
std::string summary_of(const DistanceCommandOptions& options, std::span<const Interval> distances,
                       const std::vector<StageTime>& times, std::span<const OutputFile> files) {
  std::string text = distances.size() == 1 ? one_pose(distances.front()) : many_poses(distances);
  const auto time = std::ranges::find(times, "distances", &StageTime::stage);
  const double each = time->seconds / static_cast<double>(distances.size());
  if (distances.size() > 1) text += labelled("each", microseconds(each) + " microseconds a pose");
  text += labelled("time", times_text(times, options.verbose));
  return text + written_text(files, false);
}

}  // namespace

std::string distance_opening(const std::string& path, const MeshReport& report, bool verbose) {
  std::string text =
      fmt::format("{}: {} triangles, {}\n", path == "-" ? "standard input" : path, grouped(report.triangles),
                  report.closed ? "closed" : "not closed: a surface that encloses nothing");
  if (!verbose) return text;
  for (const std::string& assumption : report.assumptions) text += labelled("note", assumption);
  return text;
}

std::string body_file_opening(const std::string& path, const LoadedBody& body, bool verbose) {
  return distance_opening(path, body.mesh.prepared().report, verbose) +
         labelled("balls", fmt::format("{} inside and {} that cover it, proved again", grouped(body.inside.size()),
                                       grouped(body.cover.size())));
}

std::string distance_summary(const DistanceCommandOptions& options, std::span<const Distance> distances,
                             const std::vector<StageTime>& times, std::span<const OutputFile> files) {
  return summary_of(options, distances, times, files);
}

std::string bounds_summary(const DistanceCommandOptions& options, std::span<const DistanceBounds> bounds,
                           const std::vector<StageTime>& times, std::span<const OutputFile> files) {
  return summary_of(options, bounds, times, files);
}

}  // namespace medial_vk::cli
