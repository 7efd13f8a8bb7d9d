#include "least_wall/wall_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Of products of corners with a unit vector, relative to their greatest coordinate.
constexpr double kHeightRounding = 0x1p-48;

// Balls are also taken whose object angle is smaller by this: where the angle changes along a sheet, no other ball may
// be found at the place where it is exactly that.
constexpr double kAngleSlack = 0x1p-10;

// With more triangles within reach a cell is divided at once: they would take more time than its parts.
constexpr std::size_t kMostTriangles = 400;

// In cells with up to this many triangles within reach, pairs of contacts are examined; their number grows with its
// square. The parts of small cells do not have fewer where they are near the apex of a fan.
constexpr std::size_t kMostPaired = 32, kMostPairedInSmall = 256;

/// Otherwise a cell is too large for directions from its centres to the boundary to be known.
bool has_directions(double distance, double h) { return h < 0.5 * distance; }

}  // namespace

WallCell WallCell::part(std::size_t index) const {
  WallCell part = *this;
  part.half = 0.5 * half;
  for (std::size_t axis = 0; axis < 3; ++axis) part.centre[axis] += (index >> axis & 1u) != 0 ? part.half : -part.half;
  return part;
}

std::vector<SpokeCone> normals_of(const Solid& solid) {
  const Bvh& bvh = solid.bvh();
  const std::vector<std::uint8_t>& flags = solid.mesh().flags;
  std::vector<SpokeCone> normals;
  normals.reserve(bvh.corners().size());
  for (std::size_t i = 0; i < bvh.corners().size(); ++i) {
    const std::array<Point, 3>& corners = bvh.corners()[i];
    const bool is_trusted = !flags.empty() && (flags[bvh.order()[i]] & kTrustedNormal) != 0;
    double shorter = 0;
    const Point area = double_area(corners[0], corners[1], corners[2], shorter);
    const double size = length(area), error = kAreaRounding * shorter;
    const bool is_known = is_trusted && size > 2 * error;
    normals.push_back(is_known ? SpokeCone{(1 / size) * area, std::asin(error / size)} : SpokeCone{});
  }
  return normals;
}

WallCells::WallCells(const WallField& field)
    : field_(field), toward_(field.options.side == ThicknessSide::kWalls ? 1 : -1), rounding_(field.rounding) {}

/// Where the search for a ball begins, if one is of interest.
std::optional<WallCells::Start> WallCells::bound(WallCell& cell, double best) {
  const double theta = field_.options.object_angle;
  const double h = std::numbers::sqrt3 * cell.half * (1 + kBoundShare) + rounding_;
  const BvhHit hit = field_.tree.closest(field_.solid.bvh(), cell.centre);
  const double d = std::sqrt(hit.squared_distance);
  cell.least = std::max(cell.least, least_radius_around(d - rounding_, h, theta));
  if (cell.least >= best) return std::nullopt;
  if (d > h + rounding_ && is_on_other_side(cell.centre, d)) {
    cell.least = kInfinite;
    return std::nullopt;
  }
  // A contact of a ball around m is no farther from c than d(m) + h <= d + 2 h, and of a ball below the best radius no
  // farther than that and h. Beside the apex of a fan all cells are near all of its triangles.
  reach_ = std::min(d + 2 * h, best + h) + rounding_;
  const std::size_t most = cell.half <= field_.small ? near_.max_size() : kMostTriangles;
  gather(cell.centre, reach_, hit.triangle, most);
  if (near_.size() > most) return std::nullopt;
  if (near_.empty()) {
    cell.least = kInfinite;
    return std::nullopt;
  }
  const Known by_directions = pairs_by_directions(d, h);
  const Known by_normals = by_directions.are_possible ? pairs_by_normals() : by_directions;
  if (!by_normals.are_possible) {
    cell.least = kInfinite;
    return std::nullopt;
  }
  cell.vertex = common_vertex();
  const double angle = std::max(by_normals.object_angle, by_directions.object_angle);
  cell.least = std::max({cell.least, by_normals.least_radius, least_radius_around(d - rounding_, h, angle)});
  if (cell.least >= best) return std::nullopt;
  cell.least = std::max(cell.least, radius_by_pairs(cell, d, h, cell.least));
  if (cell.least >= best) return std::nullopt;
  return Start{hit.point, d, h, angle};
}

std::optional<WallBall> WallCells::examine(WallCell& cell, double best) {
  const std::optional<Start> start = bound(cell, best);
  if (!start) return std::nullopt;
  // By the rounded contact: the distance is more accurate than its coordinates.
  const Point away = cell.centre - start->contact;
  if (!(length(away) > 0)) return std::nullopt;
  const Point direction = (1 / length(away)) * away;
  const std::optional<double> step = step_to_middle(direction, start->distance);
  if (!step || *step > start->h) return std::nullopt;
  const Point middle = cell.centre + *step * direction;
  const double at_middle = std::sqrt(field_.tree.closest(field_.solid.bvh(), middle).squared_distance);
  const double around = least_radius_around(at_middle - rounding_, start->h + *step, start->object_angle);
  cell.least = std::max(cell.least, around);
  const double radius = length(away) + *step;
  return radius < 2 * best ? touch(start->contact, direction, radius) : std::nullopt;
}

bool WallCells::is_on_other_side(const Point& centre, double distance) const {
  const SolidSide side = field_.solid.side_around(centre, distance - rounding_);
  return side == (toward_ > 0 ? SolidSide::kOutside : SolidSide::kInside);
}

void WallCells::gather(const Point& centre, double radius, std::uint32_t nearest_triangle, std::size_t most) {
  const Bvh& bvh = field_.solid.bvh();
  gather_within(bvh, centre, radius, nearby_);
  near_.clear();
  nearest_ = 0;
  const double squared = radius * radius * (1 + kBoundShare);
  for (const std::uint32_t position : nearby_) {
    if (near_.size() > most) return;
    if (clearly_beyond(centre, bvh.corners()[position], squared)) continue;
    const NearestOffset offset = nearest_on_triangle(centre, bvh.corners()[position]);
    if (offset.squared_distance > squared) continue;
    if (bvh.order()[position] == nearest_triangle) nearest_ = near_.size();
    near_.push_back({position, offset});
  }
}

/// A ball touches a triangle along its normal, or at an edge or a vertex along a sum of the normals that meet there,
/// with weights that are not negative.
WallCells::Known WallCells::pairs_by_normals() {
  cones_.clear();
  for (const Near& near : near_) cones_.push_back(field_.normals[near.position]);
  const PairsOfContacts pairs = groups_.divide(cones_, nearest_, field_.options.object_angle);
  Known known = {pairs.are_possible, pairs.object_angle, 0};
  if (pairs.are_possible && pairs.are_apart) bound_by_heights(known);
  // At an edge of both groups a spoke is a sum of normals of both; groups that are apart in height share none.
  if (!(known.least_radius > 0)) known.object_angle = field_.options.object_angle;
  return known;
}

/// For contacts x, y with outward normals u, v of a ball of radius r inside: x - y = r (u - v). Along the axis e of the
/// difference of the axes of both caps, the right side is positive and at most 2 r. Outside, signs change.
void WallCells::bound_by_heights(Known& known) const {
  const Point difference = groups_.cap(0).axis - groups_.cap(1).axis;
  const Point e = (toward_ / length(difference)) * difference;
  std::array<double, 2> least = {kInfinite, kInfinite}, greatest = {-kInfinite, -kInfinite};
  double size = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const std::size_t g = groups_.group_of(i);
    for (const Point& corner : field_.solid.bvh().corners()[near_[i].position]) {
      const double height = dot(corner, e);
      least[g] = std::min(least[g], height);
      greatest[g] = std::max(greatest[g], height);
      size = std::max({size, std::fabs(corner[0]), std::fabs(corner[1]), std::fabs(corner[2])});
    }
  }
  const double rounding = kHeightRounding * size;
  known.least_radius = std::max(0.0, 0.5 * (least[0] - greatest[1]) - rounding);
  known.are_possible = greatest[0] + rounding >= least[1];
}

/// A point x of a triangle within the reach R of c is within sqrt(R^2 - |q - c|^2) of its point q that is nearest to c,
/// as the angle at q is right or greater, and so is one of an edge. From a centre m, |m - c| <= h, the direction to x
/// differs by up to asin(h / d).
SpokeCone WallCells::direction_to(const NearestOffset& offset, double distance, double h) const {
  const double reach = reach_ * (1 + kBoundShare), by_centre = std::asin(h / distance);
  const double size = std::sqrt(offset.squared_distance);
  const double squared = offset.squared_distance * (1 - kBoundShare);
  // The foot on a thin triangle may be off by the square root of the product of its rounding and its length.
  const double beside = std::sqrt(std::max(0.0, reach * reach - squared)) + 2 * std::sqrt(rounding_ * size) + rounding_;
  return {(1 / size) * offset.offset, std::atan(beside / size) * (1 + kBoundShare) + by_centre};
}

WallCells::Known WallCells::pairs_by_directions(double distance, double h) {
  const double theta = field_.options.object_angle;
  if (!has_directions(distance, h)) return {true, theta, 0};
  cones_.clear();
  cones_.reserve(near_.size());
  for (const Near& near : near_) cones_.push_back(direction_to(near.offset, distance, h));
  const PairsOfContacts pairs = groups_.divide(cones_, nearest_, theta);
  return {pairs.are_possible, pairs.object_angle, 0};
}

/// A bound of the radius of balls around centres in the cell; `known` if it is no greater.
double WallCells::radius_by_pairs(const WallCell& cell, double distance, double h, double known) {
  const Point& c = cell.centre;
  const std::size_t most = cell.half <= field_.small ? kMostPairedInSmall : kMostPaired;
  if (near_.size() > most || !has_directions(distance, h)) return known;
  facing_.clear();
  facing_.reserve(near_.size());
  for (const Near& near : near_) {
    const SpokeCone& outward = field_.normals[near.position];
    facing_.push_back({field_.solid.bvh().corners()[near.position], {toward_ * outward.axis, outward.angle}});
  }
  spokes_by_normals(facing_, rounding_, meeting_, cones_);
  contacts_.clear();
  edges_.clear();
  const auto add = [&](const NearestOffset& offset, const SpokeCone& by_normals, const std::array<Point, 3>& corners) {
    const double size = std::sqrt(offset.squared_distance) - rounding_;
    contacts_.push_back({direction_to(offset, distance, h), by_normals, std::max(0.0, size), corners});
  };
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const std::array<Point, 3>& corners = facing_[i].corners;
    add(near_[i].offset, facing_[i].normal, {corners[0] - c, corners[1] - c, corners[2] - c});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(corners[k], corners[(k + 1) % 3]);
      const NearestOffset offset = nearest_on_segment(a - c, b - a);
      if (std::sqrt(offset.squared_distance) - rounding_ > reach_) continue;
      if (std::ranges::find(edges_, std::pair(a, b)) != edges_.end()) continue;
      edges_.emplace_back(a, b);
      add(offset, cones_[i], {a - c, b - c, b - c});
    }
  }
  return least_radius_of_pairs(contacts_, h, field_.options.object_angle, known, rounding_);
}

std::optional<Point> WallCells::common_vertex() const {
  const auto& corners = field_.solid.bvh().corners();
  for (const Point& corner : corners[near_.front().position]) {
    const auto has_it = [&](const Near& near) {
      return std::ranges::find(corners[near.position], corner) != corners[near.position].end();
    };
    if (std::ranges::all_of(near_, has_it)) return corner;
  }
  return std::nullopt;
}

/// Up to this distance from the vertex, the boundary is a cone with this apex.
double WallCells::cone_radius(const Point& vertex) {
  const Bvh& bvh = field_.solid.bvh();
  double radius = kInfinite;
  gather_within(bvh, vertex, 0, nearby_);
  for (const std::uint32_t position : nearby_) {
    const std::array<Point, 3>& corners = bvh.corners()[position];
    const auto at = std::ranges::find(corners, vertex);
    if (at == corners.end()) continue;
    const auto i = static_cast<std::size_t>(at - corners.begin());
    const Point &b = corners[(i + 1) % 3], &c = corners[(i + 2) % 3];
    radius = std::min(radius, std::sqrt(nearest_on_segment(b - vertex, c - b).squared_distance));
  }
  if (!std::isfinite(radius)) return 0;
  gather_within(bvh, vertex, radius, nearby_);
  for (const std::uint32_t position : nearby_) {
    const std::array<Point, 3>& corners = bvh.corners()[position];
    if (std::ranges::find(corners, vertex) != corners.end()) continue;
    radius = std::min(radius, std::sqrt(nearest_on_triangle(vertex, corners).squared_distance));
  }
  return radius - rounding_;
}

/// A medial ball around a centre in the cube touches within 2 sqrt(3) of half its side from the vertex, where the
/// boundary is a cone. Scaled by any factor, it is a medial ball of the cone again. So if there is none between the
/// cube and its half, there is none in it.
double WallCells::free_around(const Point& vertex) {
  const double half = cone_radius(vertex) / 8;
  if (!(half > 0)) return 0;
  constexpr int kAcross = 4;  // cells
  const double part = half / kAcross;
  for (int i = 0; i < kAcross * kAcross * kAcross; ++i) {
    const std::array<int, 3> place = {i % kAcross, i / kAcross % kAcross, i / (kAcross * kAcross)};
    const auto is_inner = [](int k) { return k == 1 || k == 2; };
    if (std::ranges::all_of(place, is_inner)) continue;
    WallCell cell = {.centre = vertex, .half = part};
    for (std::size_t axis = 0; axis < 3; ++axis) cell.centre[axis] += (2 * place[axis] + 1 - kAcross) * part;
    if (!is_free(cell)) return 0;
  }
  return half;
}

/// True if it is shown that there is no medial ball with the object angle around a centre in the cell.
bool WallCells::is_free(WallCell cell) {
  constexpr std::size_t kMostCells = 4000;
  constexpr double kLeastShare = 0x1p-12;
  const double least = kLeastShare * cell.half;
  std::vector<WallCell> open = {cell};
  for (std::size_t done = 0; done < open.size(); ++done) {
    WallCell next = open[done];
    next.least = 0;
    bound(next, kInfinite);
    if (next.least == kInfinite) continue;
    if (!(next.half > least) || open.size() > kMostCells) return false;
    for (std::size_t i = 0; i < 8; ++i) open.push_back(next.part(i));
  }
  return true;
}

/// How far to go from c, away from the nearest point, until a triangle of the other group is equally near.
std::optional<double> WallCells::step_to_middle(const Point& direction, double distance) const {
  double least = kInfinite;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (groups_.group_of(i) == 0) continue;
    // |t w - v|^2 = (d + t)^2 for the offset v
    const NearestOffset& other = near_[i].offset;
    const double t = (other.squared_distance - distance * distance) / (2 * (distance + dot(direction, other.offset)));
    if (t >= 0) least = std::min(least, t);
  }
  return std::isfinite(least) ? std::optional(least) : std::nullopt;
}

/// The ball that touches at a contact and is tangent to the plane across the direction there: it shrinks until it holds
/// no other point of the boundary. None if it never holds one, or if the object angle is too small then.
std::optional<WallBall> WallCells::touch(const Point& contact, const Point& direction, double radius) const {
  constexpr int kMostSteps = 30;
  std::optional<Point> other;
  // A radius that is exact already would show one contact alone.
  constexpr double kEnlargement = 1 + 0x1p-10;
  radius *= kEnlargement;
  for (int step = 0; step < kMostSteps; ++step) {
    const Point centre = contact + radius * direction;
    const BvhHit hit = field_.tree.closest(field_.solid.bvh(), centre);
    const double distance = std::sqrt(hit.squared_distance);
    if (distance >= radius - rounding_) {
      if (!other) return std::nullopt;
      const Point a = (1 / radius) * (contact - centre), b = (1 / radius) * (*other - centre);
      const double angle = 0.5 * std::acos(std::clamp(dot(a, b), -1.0, 1.0));
      if (angle < field_.options.object_angle - kAngleSlack || is_on_other_side(centre, distance)) return std::nullopt;
      return WallBall{{centre, radius}, contact, *other, angle};
    }
    const Point chord = hit.point - contact;
    const double along = dot(chord, direction), smaller = dot(chord, chord) / (2 * along);
    if (!(along > 0) || !(smaller < radius)) return std::nullopt;
    other = hit.point;
    radius = smaller;
  }
  return std::nullopt;
}

}  // namespace medial_vk
