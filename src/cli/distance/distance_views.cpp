#include "cli/distance/distance_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/shared/pair_views.h"

namespace medial_vk::cli {
namespace {

std::vector<PoseInterval> intervals_of(const DistanceView& view) {
  std::vector<PoseInterval> intervals;
  for (const Distance& d : view.distances) intervals.push_back({d.lower, d.upper, d.collision()});
  for (const DistanceBounds& b : view.bounds) intervals.push_back({b.lower, b.upper, b.collision()});
  return intervals;
}

/// Whether the triangles of the first solid are also those of the second one, at the same places.
bool coincide(const Mesh& mesh, std::size_t triangles_of_first) {
  if (mesh.triangles.size() != 2 * triangles_of_first) return false;
  const auto is_same_corner = [&](std::uint32_t a, std::uint32_t b) { return mesh.vertices[a] == mesh.vertices[b]; };
  for (std::size_t i = 0; i < triangles_of_first; ++i) {
    if (!std::ranges::equal(mesh.triangles[i], mesh.triangles[triangles_of_first + i], is_same_corner)) return false;
  }
  return true;
}

PairPicture picture_of(const DistanceCommandOptions& options, const DistanceView& view, std::size_t shown,
                       const PoseInterval& interval) {
  const Pose& pose = view.poses[shown];
  PairPicture picture;
  append_mesh(view.side_a.mesh.prepared().mesh, Pose(), picture.mesh);
  picture.triangles_of_a = picture.mesh.triangles.size();
  append_mesh(view.side_b.mesh.prepared().mesh, pose, picture.mesh);
  picture.triangles_of_b = picture.mesh.triangles.size() - picture.triangles_of_a;
  picture.name_a = "A: " + name_of_file(options.a);
  picture.name_b = "B: " + name_of_file(options.b);
  const Pose at_a;
  add_balls({view.body_a, at_a}, {view.body_b, pose}, pose, view.distances.empty(), picture);
  picture.title = title_of(interval);
  if (view.poses.size() > 1) picture.title = fmt::format("pose {}: {}", shown + 1, picture.title);
  if (coincide(picture.mesh, picture.triangles_of_a)) picture.title += " (A and B are the same, in the same place)";
  // Beyond the limit they are some two points, not the nearest ones.
  picture.has_points = std::isfinite(interval.upper) && interval.upper <= options.limit;
  picture.is_hit = interval.collision == Collision::kHit;
  if (!view.distances.empty()) {
    picture.on_a = view.distances[shown].on_a;
    picture.on_b = view.distances[shown].on_b;
  }
  return picture;
}

}  // namespace

Status append_distance_views(const DistanceCommandOptions& options, const DistanceView& view,
                             std::vector<OutputFile>& files) {
  if (options.picture.empty() && options.html.empty()) return {};
  const std::vector<PoseInterval> intervals = intervals_of(view);
  const std::size_t shown = shown_of(intervals, options.row);
  DistancePage page;
  page.title = fmt::format("Distances of {} and {}", name_of_file(options.a), name_of_file(options.b));
  page.intervals = intervals;
  page.shown = shown;
  page.is_chosen = options.row > 0;
  page.by_balls = options.balls;
  return append_views(picture_of(options, view, shown, intervals[shown]), options.view, options.picture, options.html,
                      std::move(page), files);
}

}  // namespace medial_vk::cli
