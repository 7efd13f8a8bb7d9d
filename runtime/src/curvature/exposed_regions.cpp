#include "curvature/exposed_regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ball_unions/cells/cell_edge.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

double angle_apart(const Point& a, const Point& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// The circle in which a plane meets the sphere of radius 1.
struct CapCircle {
  Point normal;
  double height = 0;

  double radius() const { return std::sqrt(std::max(0.0, (1 - height) * (1 + height))); }
  Point middle() const { return height * normal; }
  /// Counterclockwise around the normal from one point to another one, in (-pi, pi].
  double turn(const Point& from, const Point& to) const {
    const Point a = from - middle(), b = to - middle();
    return std::atan2(dot(normal, cross(a, b)), dot(a, b) - dot(normal, a) * dot(normal, b));
  }
};

CapCircle circle_of(const PowerCell& cell, std::uint32_t plane, double radius) {
  const Bisector& bisector = cell.planes()[plane];
  return {bisector.normal, bisector.offset / radius};
}

std::size_t place_in(const PowerCell::Corner& corner, std::uint32_t plane) {
  return static_cast<std::size_t>(std::ranges::find(corner.planes, plane) - corner.planes.begin());
}

/// The half-edge that leaves a corner counterclockwise around a face: with det(normals) > 0, along the edge that is not
/// in the next plane.
std::uint32_t half_edge_at(const PowerCell& cell, std::uint32_t corner, std::uint32_t plane) {
  const std::size_t slot = (place_in(cell.corners()[corner], plane) + 1) % 3;
  return 3 * corner + static_cast<std::uint32_t>(slot);
}

std::uint32_t end_of(const PowerCell& cell, std::uint32_t half_edge) {
  return cell.corners()[half_edge / 3].neighbours[half_edge % 3];
}

/// The face that a half-edge goes around.
std::uint32_t face_of(const PowerCell& cell, std::uint32_t half_edge) {
  return cell.corners()[half_edge / 3].planes[(half_edge % 3 + 2) % 3];
}

/// The greatest angle between a direction and the points of an arc.
double farthest_on_arc(const CapCircle& circle, const Point& from, const Point& to, double sweep,
                       const Point& direction) {
  const double farthest = std::max(angle_apart(direction, from), angle_apart(direction, to));
  const Point along = direction - dot(direction, circle.normal) * circle.normal;
  const double size = length(along);
  if (!(size > 0)) return farthest;
  const Point opposite = circle.middle() - circle.radius() / size * along;
  double on_the_way = -circle.turn(from, opposite);  // clockwise
  if (on_the_way < 0) on_the_way += 2 * std::numbers::pi;
  return on_the_way <= sweep ? std::max(farthest, angle_apart(direction, opposite)) : farthest;
}

}  // namespace

std::uint32_t RegionFinder::piece_of(std::uint32_t plane) {
  while (pieces_[plane] != plane) {
    pieces_[plane] = pieces_[pieces_[plane]];
    plane = pieces_[plane];
  }
  return plane;
}

void RegionFinder::find_crossings(const PowerCell& cell, double radius) {
  crossings_.clear();
  half_edges_.assign(3 * cell.corners().size(), HalfEdge{});
  pieces_.resize(cell.planes().size());
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) pieces_[i] = i;
  const auto is_inside = [&](std::uint32_t corner) {
    const Point& at = cell.corners()[corner].at;
    return dot(at, at) < radius * radius;
  };
  const auto add = [&](const Point& at, std::uint32_t plane) {
    crossings_.push_back({at, plane});
    return static_cast<std::uint32_t>(crossings_.size() - 1);
  };
  for_each_edge(cell, radius, [&](const CellEdge& edge) {
    const bool from_inside = is_inside(edge.other), to_inside = is_inside(edge.corner);
    const bool passes = !from_inside && !to_inside && edge.half_chord_squared > 0 && edge.from < 0 && edge.to > 0;
    if (!from_inside && !to_inside && !passes) return;
    // Balls whose faces have a common edge in the ball cover caps that overlap.
    pieces_[piece_of(edge.planes[0])] = piece_of(edge.planes[1]);
    if (from_inside && to_inside) return;
    // Along the edge's direction, which goes counterclockwise around the first face and clockwise around the second.
    const double half = std::sqrt(std::max(0.0, edge.half_chord_squared));
    const auto& slots = cell.corners()[edge.corner].neighbours;
    const auto back = static_cast<std::uint32_t>(std::ranges::find(slots, edge.other) - slots.begin());
    HalfEdge& along = half_edges_[half_edge_at(cell, edge.other, edge.planes[0])];
    HalfEdge& against = half_edges_[3 * edge.corner + back];
    if (!from_inside) along.enter = against.leave = add(edge.foot + edge.enter(half) * edge.direction, edge.planes[0]);
    if (!to_inside) along.leave = against.enter = add(edge.foot + edge.leave(half) * edge.direction, edge.planes[1]);
  });
}

/// Links the crossings of a face, from a half-edge of it: around its part in the ball, an arc begins where the border
/// leaves the ball and ends where it enters it again. The border between them goes around the arc's circle outside of
/// it, by the angle of the arc; unlike the ends of the arc, it tells none from a whole turn.
void RegionFinder::walk_face(const PowerCell& cell, double radius, std::uint32_t first) {
  const std::uint32_t plane = face_of(cell, first);
  const CapCircle circle = circle_of(cell, plane, radius);
  const auto next_of = [&](std::uint32_t half_edge) { return half_edge_at(cell, end_of(cell, half_edge), plane); };
  std::uint32_t begin = kNone, at = first;
  do {
    half_edges_[at].was_walked = true;
    if (half_edges_[at].leave != kNone) begin = at;
    at = next_of(at);
  } while (at != first);
  if (begin == kNone) return;  // the circle or the face lies in the other, or apart from it
  std::uint32_t left = half_edges_[begin].leave;
  Point place = crossings_[left].at;
  double sweep = 0;
  const auto go_to = [&](const Point& to) {
    sweep += circle.turn(place, to);
    place = to;
  };
  at = begin;
  do {
    if (left != kNone) go_to(1 / radius * cell.corners()[end_of(cell, at)].at);
    at = next_of(at);
    const HalfEdge& edge = half_edges_[at];
    if (edge.enter != kNone) {
      Crossing& entered = crossings_[edge.enter];
      go_to(entered.at);
      entered.next = left;
      entered.sweep = std::max(0.0, sweep);
      left = kNone;
    }
    if (edge.leave != kNone) {
      left = edge.leave;
      place = crossings_[left].at;
      sweep = 0;
    }
  } while (at != begin);
}

/// Of pieces with equally many closed curves, the one with the most crossings; kNone if there is no crossing.
std::uint32_t RegionFinder::widest_piece() {
  borders_.assign(pieces_.size(), 0);
  lengths_.assign(pieces_.size(), 0);
  for (const std::uint32_t first : firsts_) ++borders_[piece_of(crossings_[first].plane)];
  for (const Crossing& crossing : crossings_) ++lengths_[piece_of(crossing.plane)];
  std::uint32_t best = kNone;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    if (borders_[i] == 0) continue;
    if (best == kNone || std::pair(borders_[best], lengths_[best]) < std::pair(borders_[i], lengths_[i])) best = i;
  }
  return best;
}

/// By the theorem of Gauss and Bonnet, the area is 2 pi less the integral of the geodesic curvature along the border
/// and less its turns at the crossings. The integral of normals over any surface with this border is half that of x
/// cross dx.
void RegionFinder::add_region(const PowerCell& cell, double radius, std::uint32_t first) {
  ExposedRegion region = {2 * std::numbers::pi, {}, {}, 0};
  const auto tangent = [&](const CapCircle& circle, const Point& at) {
    return cross(at - circle.middle(), circle.normal);
  };
  std::uint32_t at = first;
  do {
    const Crossing& begin = crossings_[at];
    const Crossing& end = crossings_[begin.next];
    const CapCircle circle = circle_of(cell, begin.plane, radius);
    const double size = circle.radius();
    region.vector =
        region.vector + 0.5 * (cross(circle.middle(), end.at - begin.at) - (size * size * begin.sweep) * circle.normal);
    const Point arriving = tangent(circle, end.at);
    const Point leaving = tangent(circle_of(cell, end.plane, radius), end.at);
    const double turn = std::atan2(dot(end.at, cross(arriving, leaving)), dot(arriving, leaving));
    region.area += circle.height * begin.sweep - std::max(0.0, turn);
    at = begin.next;
  } while (at != first);
  const double size = length(region.vector);
  if (!(region.area > 0) || !(size > 0)) return;
  region.direction = 1 / size * region.vector;
  do {
    const Crossing& begin = crossings_[at];
    const CapCircle circle = circle_of(cell, begin.plane, radius);
    region.reach = std::max(
        region.reach, farthest_on_arc(circle, begin.at, crossings_[begin.next].at, begin.sweep, region.direction));
    at = begin.next;
  } while (at != first);
  // A border in a half-sphere bounds a region in it, or one that contains the other half-sphere.
  if (region.reach >= std::numbers::pi / 2 || region.area >= 2 * std::numbers::pi) region.reach = std::numbers::pi;
  regions_.push_back(region);
}

std::span<const ExposedRegion> RegionFinder::find(const PowerCell& cell, double radius) {
  regions_.clear();
  if (cell.empty()) return regions_;
  find_crossings(cell, radius);
  for (std::uint32_t i = 0; i < half_edges_.size(); ++i) {
    if (!half_edges_[i].was_walked) walk_face(cell, radius, i);
  }
  firsts_.clear();
  was_seen_.assign(crossings_.size(), 0);
  for (std::uint32_t i = 0; i < crossings_.size(); ++i) {
    if (was_seen_[i] != 0) continue;
    firsts_.push_back(i);
    for (std::uint32_t at = i; was_seen_[at] == 0; at = crossings_[at].next) was_seen_[at] = 1;
  }
  const std::uint32_t piece = widest_piece();
  if (piece == kNone) return regions_;
  for (const std::uint32_t first : firsts_) {
    if (piece_of(crossings_[first].plane) == piece) add_region(cell, radius, first);
  }
  return regions_;
}

}  // namespace medial_vk
