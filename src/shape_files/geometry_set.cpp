#include <algorithm>

#include "shape_files/shape_readers.h"

namespace medial_vk {
namespace {

/// Whether there are three different points.
bool has_three_points(const PlaneRing& ring) {
  if (ring.empty()) return false;
  const auto second = std::ranges::find_if(ring, [&](const PlanePoint& p) { return p != ring.front(); });
  if (second == ring.end()) return false;
  return std::ranges::any_of(ring, [&](const PlanePoint& p) { return p != ring.front() && p != *second; });
}

/// Removes a last point that is the first again. True if there was none, and the straight segment is new.
bool close_ring(PlaneRing& ring) {
  if (ring.front() != ring.back()) return true;
  ring.pop_back();
  return false;
}

}  // namespace

void GeometrySet::add_polygon(std::vector<PlaneRing> rings) {
  for (PlaneRing& ring : rings) {
    if (ring.size() > 1 && close_ring(ring) && has_three_points(ring)) ++closed_;
  }
  if (!rings.empty()) polygons_.push_back({std::move(rings), FillRule::kEvenOdd});
}

void GeometrySet::add_line(PlaneRing line) {
  if (!has_three_points(line)) {
    ++short_lines_;
    return;
  }
  ++lines_count_;
  if (close_ring(line)) ++closed_;
  lines_.rings.push_back(std::move(line));
}

std::vector<ShapeArea> GeometrySet::take_areas() {
  if (!lines_.rings.empty()) polygons_.push_back(std::move(lines_));
  return std::move(polygons_);
}

std::vector<std::string> GeometrySet::assumptions() const {
  std::vector<std::string> s;
  add_sentence(s, closed_, "open line is closed by a straight segment.",
               "open lines are closed by a straight segment.");
  if (lines_count_ > 1) {
    add_sentence(s, lines_count_, "", "lines are outlines together: a line within another one is a hole.");
  }
  add_sentence(s, short_lines_, "line of fewer than three different points is left out.",
               "lines of fewer than three different points are left out.");
  add_sentence(s, points_, "geometry of points is left out.", "geometries of points are left out.");
  return s;
}

}  // namespace medial_vk
