#include "cli/clearance/clearance_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cli/shared/states_text.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "output/distance_files/distances_csv.h"

namespace medial_vk::cli {
namespace {

std::string least_text(std::span<const Clearance> clearances) {
  const auto is_less = [](const Clearance& a, const Clearance& b) {
    return a.upper < b.upper || (a.upper == b.upper && a.lower < b.lower);
  };
  const auto least = std::ranges::min_element(clearances, is_less);
  const std::string links = least->first.empty() ? "" : fmt::format(", {} and {}", least->first, least->second);
  return fmt::format("{} (configuration {}{})", interval_text(least->lower, least->upper),
                     least - clearances.begin() + 1, links);
}

}  // namespace

std::string clearance_opening(const ClearanceOptions& options, const RobotAndScene& all, std::size_t joints) {
  std::string text = fmt::format("{}: {}, {}, {}\n", options.robot, counted(all.robot.links.size(), "link", "links"),
                                 counted(joints, "free joint", "free joints"),
                                 counted(all.solids.around.size() - options.scenes.size(), "solid", "solids"));
  if (!options.scenes.empty()) {
    std::string scene = counted(options.scenes.size(), "mesh", "meshes");
    if (!all.balls_of_files.empty()) {
      scene += fmt::format("; {}, proved again",
                           counted(all.balls_of_files.size(), "is from a body file", "are from body files"));
    }
    text += labelled("scene", scene);
  }
  std::string pairs = fmt::format("{} compared", grouped(all.pairs.size()));
  if (options.srdf.empty()) {
    pairs += fmt::format("; {} joined and {} that always touch are not", grouped(all.joined.size()),
                         grouped(all.touching.size()));
  } else {
    pairs += fmt::format("; {} of {} are not", grouped(all.from_srdf.size()), options.srdf);
  }
  text += labelled("pairs", pairs);
  const auto open = std::ranges::count_if(all.solids.around,
                                          [](const LinkSolid& solid) { return !solid.mesh.prepared().report.closed; });
  if (open > 0) {
    text += labelled("open",
                     counted(static_cast<std::uint64_t>(open), "mesh is not closed: a surface that encloses nothing",
                             "meshes are not closed: surfaces that enclose nothing"));
  }
  if (all.solids.facet_share > 0) {
    text +=
        labelled("note", fmt::format("cylinders, capsules and spheres are between facets within {:.2g} of their radius",
                                     all.solids.facet_share));
  }
  if (!options.verbose) return text;
  for (const LinkPair& pair : all.touching) {
    text += labelled("touch", fmt::format("{} and {}", all.names[pair.a], all.names[pair.b]));
  }
  return text;
}

std::string balls_opening(const ClearanceOptions& options, const BallsOfSolids& balls) {
  std::size_t inside = 0, cover = 0;
  for (const std::optional<SolidBalls>& of_solid : balls.balls) {
    inside += of_solid->inside.size();
    cover += of_solid->cover.size();
  }
  std::string text =
      labelled("balls", fmt::format("{} inside and {} that cover, proved", grouped(inside), grouped(cover)));
  if (options.bodies.empty()) return text;
  const std::string read = counted(balls.read, "body read", "bodies read");
  const std::string fitted = balls.fitted == 0 ? "none fitted" : grouped(balls.fitted) + " fitted and kept there";
  return text + labelled("bodies", fmt::format("{} from {}, {}", read, options.bodies, fitted));
}

BeyondLimits find_beyond_limits(std::span<const FreeJoint> joints, std::span<const std::vector<double>> values) {
  BeyondLimits beyond;
  for (std::size_t row = 0; row < values.size(); ++row) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const FreeJoint& joint = joints[i];
      const double position = values[row][i];
      if (!(position < joint.lower || position > joint.upper)) continue;
      if (++beyond.configurations > 1) break;
      beyond.first = row + 1;
      beyond.joint = joint.name;
      beyond.position = position;
      beyond.limit = position < joint.lower ? joint.lower : joint.upper;
      break;
    }
  }
  return beyond;
}

std::string clearance_summary(const ClearanceOptions& options, std::span<const Clearance> clearances,
                              std::size_t by_triangles, const BeyondLimits& beyond, const std::vector<StageTime>& times,
                              std::span<const OutputFile> files) {
  std::string text = labelled("states", states_text(clearances)) + labelled("least", least_text(clearances));
  if (options.decide) {
    text += labelled("decided", fmt::format("{} by triangles, which balls left undecided",
                                            counted(by_triangles, "configuration", "configurations")));
  }
  if (beyond.configurations > 0) {
    text += labelled("limits", fmt::format("beyond them in {}, first in configuration {}: {} is at {:.9g}, {} {:.9g}",
                                           counted(beyond.configurations, "configuration", "configurations"),
                                           beyond.first, beyond.joint, beyond.position,
                                           beyond.position < beyond.limit ? "below" : "above", beyond.limit));
  }
  const auto time = std::ranges::find(times, "distances", &StageTime::stage);
  const double each = time->seconds / static_cast<double>(clearances.size());
  text += labelled("each", microseconds(each) + " microseconds a configuration");
  text += labelled("time", times_text(times, options.verbose));
  return text + written_text(files, false);
}

}  // namespace medial_vk::cli
