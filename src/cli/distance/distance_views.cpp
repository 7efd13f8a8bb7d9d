#include "cli/distance/distance_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/point_ops.h"
#include "output/distance_page/distance_page.h"
#include "output/picture/pair_picture.h"

namespace medial_vk::cli {
namespace {

std::vector<PoseInterval> intervals_of(const DistanceView& view) {
  std::vector<PoseInterval> intervals;
  for (const Distance& d : view.distances) intervals.push_back({d.lower, d.upper, d.collision()});
  for (const DistanceBounds& b : view.bounds) intervals.push_back({b.lower, b.upper, b.collision()});
  return intervals;
}

void append_mesh(const Mesh& mesh, const Pose& pose, Mesh& all) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const Point& p : mesh.vertices) all.vertices.push_back(pose * p);
  for (const Triangle& t : mesh.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// The points of two balls that are nearest to the other one; where they overlap, a common point.
void nearest_of_balls(const Ball& a, const Ball& b, PairPicture& picture) {
  const Point away = b.centre - a.centre;
  const double between = length(away);
  const Point towards = between > 0 ? (1 / between) * away : Point{1, 0, 0};
  picture.on_a = a.centre + a.radius * towards;
  picture.on_b = b.centre - b.radius * towards;
  if (between > a.radius + b.radius) return;
  const double step = std::clamp(between - b.radius, 0.0, a.radius);
  picture.on_a = picture.on_b = a.centre + step * towards;
}

/// The balls that give both ends of the interval of the balls, where the bodies have balls.
void add_balls(const DistanceView& view, const Pose& pose, PairPicture& picture) {
  const auto moved = [&](const Ball& ball) { return Ball{pose * ball.centre, ball.radius}; };
  const DistanceBounds bounds = distance_bounds(view.body_a, view.body_b, pose);
  if (bounds.inside_pair.a != BallPair::kNone) {
    picture.inside_a = {view.side_a.inside[bounds.inside_pair.a]};
    picture.inside_b = {moved(view.side_b.inside[bounds.inside_pair.b])};
  }
  if (bounds.cover_pair.a != BallPair::kNone) {
    picture.cover_a = {view.side_a.cover[bounds.cover_pair.a]};
    picture.cover_b = {moved(view.side_b.cover[bounds.cover_pair.b])};
  }
}

std::string title_of(const PoseInterval& interval) {
  if (!std::isfinite(interval.upper)) {
    return interval.lower > 0 ? fmt::format("distance at least {:.6g}", interval.lower) : "undecided";
  }
  switch (interval.collision) {
    case Collision::kFree:
      return fmt::format("distance {:.6g} to {:.6g}", interval.lower, interval.upper);
    case Collision::kHit:
      return "a common point";
    case Collision::kUndecided:
      break;
  }
  return fmt::format("undecided, {:.6g} to {:.6g}", interval.lower, interval.upper);
}

std::string name_of_file(const std::string& path) {
  return path == "-" ? "stdin" : std::filesystem::path(path).filename().string();
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
  add_balls(view, pose, picture);
  picture.title = title_of(interval);
  if (coincide(picture.mesh, picture.triangles_of_a)) picture.title += " (A and B are the same, in the same place)";
  picture.has_points = std::isfinite(interval.upper);
  picture.is_hit = interval.collision == Collision::kHit;
  if (view.distances.empty()) {
    if (!picture.inside_a.empty()) nearest_of_balls(picture.inside_a[0], picture.inside_b[0], picture);
  } else {
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
  const auto least = std::ranges::min_element(intervals, {}, &PoseInterval::upper);
  const auto shown = static_cast<std::size_t>(least - intervals.begin());
  Result<std::string> png = encode_png(draw_pair(picture_of(options, view, shown, *least), options.view));
  if (!png) return png.error();
  if (!options.html.empty()) {
    files.push_back({options.html, encode_distance_page({name_of_file(options.a), name_of_file(options.b), intervals,
                                                         shown, png.value(), options.balls})});
  }
  if (!options.picture.empty()) files.push_back({options.picture, std::move(png).value()});
  return {};
}

}  // namespace medial_vk::cli
