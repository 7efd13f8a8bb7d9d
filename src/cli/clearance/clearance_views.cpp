#include "cli/clearance/clearance_views.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/point_ops.h"
#include "cli/shared/pair_views.h"

namespace medial_vk::cli {
namespace {

/// Leads from the second frame to the first; both poses lead to a common one.
Pose relative(const Pose& first, const Pose& second) {
  Pose inverse;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) inverse.rotation[row][column] = first.rotation[column][row];
  }
  inverse.shift = -1.0 * (Pose{inverse.rotation, {0, 0, 0}} * first.shift);
  return inverse * second;
}

/// The solids of the two owners, links or files, come first, then all others.
void append_solids(const RobotAndScene& all, std::span<const Pose> poses, std::uint32_t nearest_a,
                   std::uint32_t nearest_b, PairPicture& picture) {
  const auto append = [&](const auto& is_wanted) {
    const std::size_t before = picture.mesh.triangles.size();
    for (std::size_t i = 0; i < all.solids.around.size(); ++i) {
      const LinkSolid& solid = all.solids.around[i];
      if (is_wanted(all.owner_of(i)))
        append_mesh(solid.mesh.prepared().mesh, poses[solid.link] * solid.pose, picture.mesh);
    }
    return picture.mesh.triangles.size() - before;
  };
  picture.triangles_of_a = append([&](std::uint32_t owner) { return owner == nearest_a; });
  picture.triangles_of_b = append([&](std::uint32_t owner) { return owner == nearest_b; });
  append([&](std::uint32_t owner) { return owner != nearest_a && owner != nearest_b; });
}

Status add_points(bool by_balls, const PlacedBody& a, const PlacedBody& b, PairPicture& picture) {
  const Pose b_in_a = relative(a.pose, b.pose);
  add_balls(a, b, b_in_a, by_balls, picture);
  if (by_balls) return {};
  const Result<Distance> nearest = distance(a.body, b.body, b_in_a);
  if (!nearest) return nearest.error();
  picture.on_a = a.pose * nearest.value().on_a;
  picture.on_b = a.pose * nearest.value().on_b;
  // The rounding of the two products must not make two points of one.
  if (nearest.value().on_a == nearest.value().on_b) picture.on_b = picture.on_a;
  return {};
}

Result<PairPicture> picture_of(const ClearanceOptions& options, const ClearanceView& view, std::size_t shown,
                               const PoseInterval& interval) {
  std::vector<Pose> poses(view.all.links());
  if (Status status = view.place(shown, poses); !status) return status.error();
  const bool by_balls = !view.by_triangles[shown];
  const BodyGroup& group = by_balls ? *view.of_balls : *view.of_triangles;
  const Result<LeastDistance> least =
      least_distance(group, poses, by_balls ? group_options(options) : triangle_options(options));
  if (!least) return least.error();
  PartPair pair = least.value().upper_pair;
  if (pair.a == PartPair::kNone) pair = least.value().lower_pair;
  PairPicture picture;
  picture.title = title_of(interval);
  if (view.clearances.size() > 1) picture.title = fmt::format("configuration {}: {}", shown + 1, picture.title);
  picture.is_hit = interval.collision == Collision::kHit;
  // Nothing is compared, or all is beyond the limit: then the pair need not be the closest one.
  if (pair.a == PartPair::kNone || !(interval.upper <= options.limit)) {
    append_solids(view.all, poses, ~std::uint32_t{0}, ~std::uint32_t{0}, picture);
    picture.name_a = picture.name_b = "";
    return picture;
  }
  const std::span<const GroupPart> parts = group.parts();
  if (view.all.owner_of(pair.a) > view.all.owner_of(pair.b)) std::swap(pair.a, pair.b);
  const std::uint32_t owner_a = view.all.owner_of(pair.a), owner_b = view.all.owner_of(pair.b);
  const GroupPart &a = parts[pair.a], &b = parts[pair.b];
  append_solids(view.all, poses, owner_a, owner_b, picture);
  picture.name_a = view.all.names[owner_a];
  picture.name_b = view.all.names[owner_b];
  picture.has_points = std::isfinite(interval.upper);
  const Pose at_a = poses[a.link] * a.pose, at_b = poses[b.link] * b.pose;
  if (Status status = add_points(by_balls, {a.body, at_a}, {b.body, at_b}, picture); !status) return status.error();
  return picture;
}

}  // namespace

Status append_clearance_views(const ClearanceOptions& options, const ClearanceView& view,
                              std::vector<OutputFile>& files) {
  if (options.picture.empty() && options.html.empty()) return {};
  std::vector<PoseInterval> intervals;
  for (const Clearance& c : view.clearances) intervals.push_back({c.lower, c.upper, c.collision()});
  const std::size_t shown = shown_of(intervals, options.row);
  const Result<PairPicture> picture = picture_of(options, view, shown, intervals[shown]);
  if (!picture) return picture.error();
  DistancePage page;
  page.title = fmt::format("Clearances of {}", name_of_file(options.robot));
  page.intervals = intervals;
  page.shown = shown;
  page.is_chosen = options.row > 0;
  page.pose = "configuration";
  page.unit = "metres";
  page.picture = "The robot and the scene as glass";
  if (!picture.value().name_a.empty()) page.picture += ", with the two closest links in colours";
  page.by_balls = options.balls > 0 && !options.decide;
  return append_views(picture.value(), options.view, options.picture, options.html, std::move(page), files);
}

}  // namespace medial_vk::cli
