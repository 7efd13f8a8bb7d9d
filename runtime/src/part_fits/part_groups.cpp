#include "part_fits/part_groups.h"

#include <cmath>
#include <map>
#include <string>

#include "base/format_text.h"
#include "base/point_ops.h"
#include "base/quoted.h"
#include "part_fits/place_ball.h"

namespace medial_vk {
namespace {

bool is_positive(double x) { return std::isfinite(x) && x > 0; }

bool is_shared(const PartFitOptions& options) { return options.total > 0 || options.count_per_link > 0; }

}  // namespace

std::vector<PartGroup> groups_of(std::span<const Part> parts, const PartFitOptions& options) {
  std::vector<PartGroup> groups;
  std::map<std::string, std::size_t> of_link;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string key = options.total > 0 ? std::string() : is_shared(options) ? parts[i].link : std::to_string(i);
    const auto [group, is_new] = of_link.emplace(key, groups.size());
    if (is_new) {
      groups.emplace_back();
      groups.back().balls = options.total > 0    ? options.total
                            : is_shared(options) ? options.count_per_link
                                                 : options.spheres.count;
    }
    groups[group->second].parts.push_back(i);
    if (parts[i].ball) ++groups[group->second].exact;
  }
  return groups;
}

Status check_part(const Part& part) {
  if (!part.mesh && !part.ball) return Error{ErrorCode::kUsage, "it has neither `mesh` nor `ball`"};
  if (part.mesh && part.ball) return Error{ErrorCode::kUsage, "it has both `mesh` and `ball`"};
  if (!is_rigid(part.pose)) return Error{ErrorCode::kUsage, "its `pose` is no rigid motion"};
  if (part.ball && (!is_positive(part.ball->radius) || !std::isfinite(length(part.ball->centre)))) {
    return Error{ErrorCode::kUsage, "its `ball` has no finite centre and positive radius"};
  }
  if (!part.ball && part.volume && !is_positive(*part.volume)) {
    return Error{ErrorCode::kUsage, "its `volume` is not positive"};
  }
  return {};
}

Status check_group(const PartGroup& group, std::span<const Part> parts, const PartFitOptions& options) {
  const std::size_t size = group.parts.size();
  if (!is_shared(options) || group.balls >= size) return {};
  if (options.total > 0) {
    return Error{ErrorCode::kUsage, format_text("{} parts need a ball each; raise `total` from {}", size, group.balls)};
  }
  const std::string link = medial_vk::quoted(parts[group.parts.front()].link);
  return Error{ErrorCode::kUsage,
               format_text("link {} has {} parts, which need a ball each; raise `count_per_link` from {}", link, size,
                           group.balls)};
}

Status check_needed(const PartGroup& group, std::span<const PartFit> fits, std::span<const Part> parts,
                    const PartFitOptions& options) {
  if (!is_shared(options) || options.spheres.max_reach == 0) return {};
  std::size_t needed = 0;
  for (const std::size_t part : group.parts) needed += fits[part].levels.back().size();
  if (needed <= group.balls) return {};
  if (options.total > 0) {
    return Error{
        ErrorCode::kUsage,
        format_text("{} balls are found that keep to `max_reach`; raise it, or `total` from {}", needed, group.balls)};
  }
  const std::string link = medial_vk::quoted(parts[group.parts.front()].link);
  return Error{
      ErrorCode::kUsage,
      format_text("of link {}, {} balls are found that keep to `max_reach`; raise it, or `count_per_link` from {}",
                  link, needed, group.balls)};
}

Status check_position(const Part& part) {
  constexpr double kMost = 1e-6;  // of the diagonal
  const MeshReport& report = part.mesh->prepared().report;
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    reach = std::max({reach, std::fabs(report.lower[k]), std::fabs(report.upper[k])});
  }
  if (placement_rounding(part.pose, 2 * reach) <= kMost * length(report.upper - report.lower)) return {};
  return Error{ErrorCode::kInvalidMesh,
               "it lies so far from the origin of its link that its balls can hardly be placed there (double "
               "precision); move it closer"};
}

}  // namespace medial_vk
