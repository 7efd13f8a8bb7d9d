#include "cli/distance/distance_summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/terminal/numbers.h"
#include "output/distance_files/distances_csv.h"

namespace medial_vk::cli {
namespace {

std::string line(const char* label, const std::string& text) { return fmt::format("  {:<9} {}\n", label, text); }

std::string states_text(std::span<const Distance> distances) {
  std::string text;
  for (const Collision state : {Collision::kFree, Collision::kHit, Collision::kUndecided}) {
    const auto count = std::ranges::count(distances, state, &Distance::collision);
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(static_cast<std::uint64_t>(count)), name_of(state));
  }
  return text;
}

std::string interval_text(const Distance& distance) {
  if (distance.upper == 0) return "0: the solids have a common point";
  return fmt::format("{:.9g} to {:.9g}", distance.lower, distance.upper);
}

std::string point_text(const Point& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

std::string one_pose(const Distance& distance) {
  std::string text = line("state", name_of(distance.collision()));
  text += line("distance", interval_text(distance));
  if (distance.upper == 0) return text + line("point", point_text(distance.on_a));
  return text + line("points", fmt::format("{} of A, {} of B", point_text(distance.on_a), point_text(distance.on_b)));
}

std::string many_poses(std::span<const Distance> distances) {
  std::string text = line("poses", grouped(distances.size()));
  text += line("states", states_text(distances));
  const auto least = std::ranges::min_element(distances, {}, &Distance::upper);
  return text + line("least", fmt::format("{} (pose {})", interval_text(*least), least - distances.begin() + 1));
}

/// Both meshes have the same stages, which are summed.
std::string times_text(const std::vector<StageTime>& times, bool verbose) {
  double all = 0;
  std::vector<StageTime> sums;
  for (const StageTime& time : times) {
    all += time.seconds;
    const auto sum = std::ranges::find(sums, time.stage, &StageTime::stage);
    if (sum == sums.end()) {
      sums.push_back(time);
    } else {
      sum->seconds += time.seconds;
    }
  }
  if (!verbose) return duration(all);
  std::string steps;
  for (const StageTime& sum : sums) {
    steps += fmt::format("{}{} {}", steps.empty() ? "" : ", ", sum.stage, duration(sum.seconds));
  }
  return fmt::format("{} ({})", duration(all), steps);
}

}  // namespace

std::string distance_opening(const std::string& path, const MeshReport& report, bool verbose) {
  std::string text =
      fmt::format("{}: {} triangles, {}\n", path == "-" ? "standard input" : path, grouped(report.triangles),
                  report.closed ? "closed" : "not closed: a surface that encloses nothing");
  if (!verbose) return text;
  for (const std::string& assumption : report.assumptions) text += line("note", assumption);
  return text;
}

std::string distance_summary(const DistanceCommandOptions& options, std::span<const Distance> distances,
                             const std::vector<StageTime>& times, std::size_t bytes) {
  std::string text = distances.size() == 1 ? one_pose(distances.front()) : many_poses(distances);
  const double each = 1e6 * times.back().seconds / static_cast<double>(distances.size());
  if (distances.size() > 1) text += line("each", fmt::format("{:.3g} microseconds a pose", each));
  text += line("time", times_text(times, options.verbose));
  if (options.output != "-") text += line("written", fmt::format("{} ({})", options.output, byte_size(bytes)));
  return text;
}

}  // namespace medial_vk::cli
