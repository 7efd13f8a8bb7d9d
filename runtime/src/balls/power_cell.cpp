#include "balls/power_cell.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <tuple>

#include "point_math.h"

namespace medial_vk {
namespace {

// Room between the ball and the box: corners on walls must lie outside the ball, whatever rounding does.
constexpr double kRoom = 1 + 0x1p-20;
// Corners that rounding may have moved by more, in radii, are found with more digits: where planes nearly have a line
// in common, anything may happen along it, and volumes and simplices must not depend on which.
constexpr double kSharp = 0x1p-40;
// The same at once, while the cell is being cut: beyond this, more would be asked of the tree and decided exactly.
constexpr double kRough = 0x1p-20;

/// Where three planes meet, and how far rounding may have moved it. With unit normals, |p x q| <= 1, so every product
/// in the numerator is at most |offset|, and the determinant carries an error of at most 32 roundings (6 products of 3
/// factors with 4 roundings each, the factors' own 4 among them); the point then moves by numerator and denominator.
std::pair<Point, double> meet(const Bisector& p, const Bisector& q, const Bisector& s) {
  const Point qs = cross(q.normal, s.normal);
  const double determinant = dot(p.normal, qs);
  if (std::fabs(determinant) < 64 * DBL_EPSILON) return {{}, HUGE_VAL};
  const Point sum = p.offset * qs + q.offset * cross(s.normal, p.normal) + s.offset * cross(p.normal, q.normal);
  const double scale = 1 / determinant;
  const Point at = scale * sum;
  const double offsets = std::fabs(p.offset) + std::fabs(q.offset) + std::fabs(s.offset);
  const double error = 32 * DBL_EPSILON * (offsets + length(at)) + p.slack + q.slack + s.slack;
  return {at, 2 * std::fabs(scale) * error};
}

}  // namespace

void PowerCell::start(std::uint32_t i) {
  ball_ = i;
  planes_.clear();
  corners_.clear();
  walls_.assign(6, {});
  const double side = balls_[i].radius * kRoom;
  for (std::size_t k = 0; k < 6; ++k) {
    Wall& wall = walls_[k];
    wall.normal[k / 2] = k % 2 == 0 ? -1 : 1;
    wall.offset = side;
    planes_.push_back({.normal = wall.normal, .offset = side, .ball = -1 - static_cast<std::int32_t>(k)});
  }
  for (std::uint32_t c = 0; c < 8; ++c) {
    Corner corner{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t up = c >> k & 1;
      corner.at[k] = up ? side : -side;
      corner.planes[k] = 2 * k + up;
      corner.neighbours[k] = c ^ (1u << k);
    }
    const bool odd = (c == 0) || (c == 3) || (c == 5) || (c == 6);  // an odd number of normals point downwards
    if (odd) {
      std::swap(corner.planes[1], corner.planes[2]);
      std::swap(corner.neighbours[1], corner.neighbours[2]);
    }
    corners_.push_back(corner);
  }
}

void PowerCell::keep(Kept& kept) const {
  kept.ball = ball_;
  kept.walls = walls_;
  kept.planes = planes_;
  kept.corners = corners_;
}

void PowerCell::restore(const Kept& kept) {
  ball_ = kept.ball;
  walls_ = kept.walls;
  planes_ = kept.planes;
  corners_ = kept.corners;
}

bool PowerCell::cuts(const Corner& corner, const Bisector& plane, double height) const {
  const double doubt = corner.slack + plane.slack + 8 * DBL_EPSILON * (length(corner.at) + std::fabs(plane.offset));
  if (std::fabs(height) > doubt) return height > 0;
  const auto name = [&](std::size_t k) { return planes_[corner.planes[k]].ball; };
  return !exact_.keeps(ball_, name(0), name(1), name(2), plane.ball);
}

/// False if there are none.
bool PowerCell::find_cut_corners(const Bisector& plane) {
  heights_.resize(corners_.size());
  double greatest = -HUGE_VAL;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Corner& corner = corners_[c];
    heights_[c] = dot(plane.normal, corner.at) - plane.offset;
    greatest = std::max(greatest, heights_[c] + corner.slack);
  }
  // |at| <= 2 r: no corner is farther away than those of the box.
  const double doubt = plane.slack + 8 * DBL_EPSILON * (2 * balls_[ball_].radius + std::fabs(plane.offset));
  if (greatest < -doubt) return false;
  cut_.clear();
  is_cut_.resize(corners_.size());
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    is_cut_[c] = cuts(corners_[c], plane, heights_[c]);
    if (is_cut_[c]) cut_.push_back(c);
  }
  return !cut_.empty();
}

/// The corner where the edge that ends in a cut corner, opposite its plane `slot`, meets the new plane.
PowerCell::Corner PowerCell::corner_on_edge(const Corner& cut, std::size_t slot, std::uint32_t plane) const {
  Corner corner = cut;
  corner.planes[slot] = plane;
  const auto [at, slack] = meet(planes_[corner.planes[0]], planes_[corner.planes[1]], planes_[corner.planes[2]]);
  corner.at = at;
  corner.slack = slack;
  if (!(slack <= kRough * balls_[ball_].radius)) place_exactly(corner);
  return corner;
}

void PowerCell::place_exactly(Corner& corner) const {
  const auto name = [&](std::size_t k) { return planes_[corner.planes[k]].ball; };
  std::tie(corner.at, corner.slack) = exact_.meet(ball_, name(0), name(1), name(2));
}

void PowerCell::sharpen() {
  for (Corner& corner : corners_) {
    if (corner.slack > kSharp * balls_[ball_].radius) place_exactly(corner);
  }
}

void PowerCell::add_corners(std::uint32_t plane) {
  added_.clear();
  for (const std::uint32_t c : cut_) {
    for (std::size_t slot = 0; slot < 3; ++slot) {
      const std::uint32_t kept = corners_[c].neighbours[slot];
      if (kept >= is_cut_.size() || is_cut_[kept]) continue;
      const auto name = static_cast<std::uint32_t>(corners_.size());
      Corner corner = corner_on_edge(corners_[c], slot, plane);
      corner.neighbours[slot] = kept;
      for (std::size_t k = 0; k < 3; ++k) {
        if (corners_[kept].neighbours[k] != c) continue;
        // Two corners share one edge only, unless the polyhedron is a dihedron, which bounded cells are not.
        corners_[kept].neighbours[k] = name;
        break;
      }
      corners_.push_back(corner);
      added_.push_back(name);
    }
  }
}

void PowerCell::link_new_corners() {
  const auto plane = static_cast<std::uint32_t>(planes_.size() - 1);
  leaving_.resize(planes_.size());
  arriving_.resize(planes_.size());
  const auto slot_of = [&](const Corner& corner) {
    return corner.planes[0] == plane ? 0u : corner.planes[1] == plane ? 1u : 2u;
  };
  for (const std::uint32_t c : added_) {
    const unsigned slot = slot_of(corners_[c]);
    leaving_[corners_[c].planes[(slot + 1) % 3]] = c;
    arriving_[corners_[c].planes[(slot + 2) % 3]] = c;
  }
  for (const std::uint32_t c : added_) {
    Corner& corner = corners_[c];
    const unsigned slot = slot_of(corner), next = (slot + 1) % 3, after = (slot + 2) % 3;
    corner.neighbours[next] = leaving_[corner.planes[after]];
    corner.neighbours[after] = arriving_[corner.planes[next]];
  }
}

/// Closes the gaps with the last corners.
void PowerCell::remove_cut_corners() {
  is_cut_.resize(corners_.size(), 0);
  for (std::size_t k = cut_.size(); k-- > 0;) {
    const std::uint32_t gap = cut_[k];
    const auto last = static_cast<std::uint32_t>(corners_.size() - 1);
    if (gap != last) {
      corners_[gap] = corners_[last];
      for (const std::uint32_t neighbour : corners_[gap].neighbours) {
        for (std::uint32_t& back : corners_[neighbour].neighbours) {
          if (back == last) back = gap;
        }
      }
    }
    corners_.pop_back();
  }
}

bool PowerCell::was_cut_by(std::uint32_t j) const {
  const auto name = static_cast<std::int32_t>(j);
  return std::any_of(planes_.begin(), planes_.end(), [&](const Bisector& plane) { return plane.ball == name; });
}

bool PowerCell::clip(std::uint32_t j) {
  const Bisector plane = bisector(balls_, ball_, j);
  if (plane.normal == Point{}) {
    if (exact_.keeps_concentric(ball_, j)) return false;
    corners_.clear();
    return true;
  }
  if (!find_cut_corners(plane)) return false;
  if (cut_.size() == corners_.size()) {
    corners_.clear();
    return true;
  }
  planes_.push_back(plane);
  add_corners(static_cast<std::uint32_t>(planes_.size() - 1));
  link_new_corners();
  remove_cut_corners();
  return true;
}

}  // namespace medial_vk
