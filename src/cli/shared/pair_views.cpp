#include "cli/shared/pair_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "cli/shared/ball_points.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

Ball moved(const PlacedBody& body, const Ball& ball) { return {body.pose * ball.centre, ball.radius}; }

}  // namespace

void append_mesh(const Mesh& mesh, const Pose& pose, Mesh& all) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const Point& p : mesh.vertices) all.vertices.push_back(pose * p);
  for (const Triangle& t : mesh.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

Status check_row_exists(std::size_t row, std::size_t rows, const char* what) {
  if (row <= rows) return {};
  return Error{ErrorCode::kUsage, fmt::format("--row {}: there {} only {} {}{}", row, rows == 1 ? "is" : "are", rows,
                                              what, rows == 1 ? "" : "s")};
}

std::size_t shown_of(std::span<const PoseInterval> intervals, std::size_t row) {
  if (row > 0) return row - 1;
  const auto least = std::ranges::min_element(intervals, {}, &PoseInterval::upper);
  return static_cast<std::size_t>(least - intervals.begin());
}

void add_balls(const PlacedBody& a, const PlacedBody& b, const Pose& b_in_a, bool decide, PairPicture& picture) {
  picture.balls_decide = decide;
  const DistanceBounds bounds = distance_bounds(a.body, b.body, b_in_a);
  if (bounds.inside_pair.a != BallPair::kNone) {
    picture.inside_a = {moved(a, a.body.inside()[bounds.inside_pair.a])};
    picture.inside_b = {moved(b, b.body.inside()[bounds.inside_pair.b])};
    if (decide) {
      const PointsOfBalls points = nearest_of_balls(picture.inside_a[0], picture.inside_b[0]);
      picture.on_a = points.on_a;
      picture.on_b = points.on_b;
    }
  }
  if (bounds.cover_pair.a != BallPair::kNone) {
    picture.cover_a = {moved(a, a.body.cover()[bounds.cover_pair.a])};
    picture.cover_b = {moved(b, b.body.cover()[bounds.cover_pair.b])};
  }
}

std::string title_of(const PoseInterval& interval) {
  // A limit of 0 asks for this alone.
  if (interval.lower > 0 && interval.lower <= std::numeric_limits<double>::min()) return "no common point";
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

std::string name_of_file(const std::string& path) { return path == "-" ? "stdin" : platform::file_name_of(path); }

Status append_views(const PairPicture& picture, const PictureView& view, const std::string& file_of_picture,
                    const std::string& file_of_page, DistancePage page, std::vector<OutputFile>& files) {
  Result<std::string> png = encode_png(draw_pair(picture, view));
  if (!png) return png.error();
  if (!file_of_page.empty()) {
    page.png = png.value();
    files.push_back({file_of_page, encode_distance_page(page)});
  }
  if (!file_of_picture.empty()) files.push_back({file_of_picture, std::move(png).value()});
  return {};
}

}  // namespace medial_vk::cli
