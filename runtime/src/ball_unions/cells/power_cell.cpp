#include "ball_unions/cells/power_cell.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

// Margin between the ball and the box: corners on walls must lie outside the ball, for any rounding.
constexpr double kRoom = 1 + 0x1p-20;

std::size_t index_of(std::uint32_t ball, const std::array<std::uint32_t, 4>& balls) {
  return static_cast<std::size_t>(std::find(balls.begin(), balls.end(), ball) - balls.begin());
}

/// As resize(), which makes room for no more than `size` where a vector is short: cells that are each a little larger
/// than all before would allocate again and again.
template <class T>
void resize_amply(std::vector<T>& values, std::size_t size) {
  if (size > values.capacity()) values.reserve(std::max(size, 2 * values.capacity()));
  values.resize(size);
}

}  // namespace

void PowerCell::start_empty(std::uint32_t i) {
  ball_ = i;
  planes_.clear();
  corners_.clear();
  walls_.assign(kWalls, {});
  const double side = balls_[i].radius * kRoom;
  for (std::size_t k = 0; k < kWalls; ++k) {
    Wall& wall = walls_[k];
    wall.normal[k / 2] = k % 2 == 0 ? -1 : 1;
    wall.offset = side;
    planes_.push_back({.normal = wall.normal, .offset = side, .ball = -1 - static_cast<std::int32_t>(k)});
  }
  farthest_ = 2 * balls_[i].radius;
}

void PowerCell::start(std::uint32_t i) {
  start_empty(i);
  const double side = walls_[0].offset;
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

void PowerCell::start(std::uint32_t i, const RegularTriangulation& triangulation) {
  start_empty(i);
  const auto tetrahedra = triangulation.tetrahedra();
  for (const std::uint32_t t : triangulation.around(i)) {
    const auto& [balls, neighbours] = tetrahedra[t];
    const std::array<std::size_t, 3> others = RegularTriangulation::kOthers[index_of(i, balls)];
    const auto& [from_first, slack] = triangulation.corner(t);
    const Point to_first = balls_[balls[0]].centre - balls_[i].centre;
    Corner corner{from_first + to_first, slack + 2 * DBL_EPSILON * (length(from_first) + length(to_first)), {}, {}};
    for (std::size_t k = 0; k < 3; ++k) corner.planes[k] = plane_of(balls[others[k]]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t next = neighbours[others[k]];
      corner.neighbours[k] = triangulation.position_around(next, index_of(i, tetrahedra[next].balls));
    }
    farthest_ = std::max(farthest_, length(corner.at));
    corners_.push_back(corner);
  }
  cut_to_box();
}

/// The index of a ball's plane, which is created at its first use.
std::uint32_t PowerCell::plane_of(std::uint32_t j) {
  plane_of_.resize(balls_.size());
  const std::uint32_t known = plane_of_[j];
  if (known < planes_.size() && planes_[known].ball == static_cast<std::int32_t>(j)) return known;
  plane_of_[j] = static_cast<std::uint32_t>(planes_.size());
  planes_.push_back(bisector(balls_, ball_, j));
  return plane_of_[j];
}

void PowerCell::cut_to_box() {
  for (std::uint32_t wall = 0; wall < kWalls; ++wall) {
    if (find_cut_corners(planes_[wall])) cut_by(wall);
  }
  farthest_ = 2 * balls_[ball_].radius;
}

void PowerCell::make_room_of(const PowerCell& other) {
  const auto reserve = [&](auto... members) { ((this->*members).reserve((other.*members).capacity()), ...); };
  reserve(&PowerCell::walls_, &PowerCell::planes_, &PowerCell::corners_, &PowerCell::heights_, &PowerCell::is_cut_,
          &PowerCell::cut_, &PowerCell::added_, &PowerCell::leaving_, &PowerCell::arriving_, &PowerCell::plane_of_);
  exact_.make_room_of(other.exact_);
}

/// A polyhedron of n faces has at most 2 n - 4 corners, and those that a further face gets, at most n, are added before
/// those that it cuts off are removed.
void PowerCell::make_room(std::size_t planes, std::size_t balls) {
  const std::size_t all = planes + kWalls, corners = 3 * all;
  walls_.reserve(kWalls);
  planes_.reserve(all);
  corners_.reserve(corners);
  heights_.reserve(corners);
  is_cut_.reserve(corners);
  cut_.reserve(corners);
  added_.reserve(corners);
  leaving_.reserve(all);
  arriving_.reserve(all);
  plane_of_.reserve(balls);
  exact_.make_room();
}

void PowerCell::restore(std::uint32_t i, std::span<const Bisector> planes, std::span<const Corner> corners) {
  ball_ = i;
  planes_.assign(planes.begin(), planes.end());
  corners_.assign(corners.begin(), corners.end());
  walls_.clear();
  for (const Bisector& wall : planes.first(std::min<std::size_t>(planes.size(), kWalls)))
    walls_.push_back({wall.normal, wall.offset});
  farthest_ = 2 * balls_[ball_].radius;
}

bool PowerCell::cuts(const Corner& corner, const Bisector& plane, double height) const {
  const double doubt = corner.slack + plane.slack + 8 * DBL_EPSILON * (length(corner.at) + std::fabs(plane.offset));
  if (std::fabs(height) > doubt) return height > 0;
  const auto name = [&](std::size_t k) { return planes_[corner.planes[k]].ball; };
  return !exact_.keeps(ball_, name(0), name(1), name(2), plane.ball);
}

/// Returns false if there are none.
bool PowerCell::find_cut_corners(const Bisector& plane) {
  resize_amply(heights_, corners_.size());
  double greatest = -HUGE_VAL;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Corner& corner = corners_[c];
    heights_[c] = dot(plane.normal, corner.at) - plane.offset;
    greatest = std::max(greatest, heights_[c] + corner.slack);
  }
  const double doubt = plane.slack + 8 * DBL_EPSILON * (farthest_ + std::fabs(plane.offset));
  if (greatest < -doubt) return false;
  cut_.clear();
  resize_amply(is_cut_, corners_.size());
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    is_cut_[c] = cuts(corners_[c], plane, heights_[c]);
    if (is_cut_[c]) cut_.push_back(c);
  }
  return !cut_.empty();
}

/// The intersection of three planes.
PowerCell::Corner PowerCell::corner_of(const std::array<std::uint32_t, 3>& planes) const {
  const auto [at, slack] = meeting_point(planes_[planes[0]], planes_[planes[1]], planes_[planes[2]]);
  Corner corner{at, slack, planes, {}};
  if (!(slack <= kRoughCorner * std::max(balls_[ball_].radius, length(at)))) place_exactly(corner);
  return corner;
}

void PowerCell::place_exactly(Corner& corner) const {
  const auto name = [&](std::size_t k) { return planes_[corner.planes[k]].ball; };
  std::tie(corner.at, corner.slack) = exact_.meet(ball_, name(0), name(1), name(2));
}

void PowerCell::sharpen() {
  for (Corner& corner : corners_) {
    if (corner.slack > kSharpCorner * balls_[ball_].radius) place_exactly(corner);
  }
}

void PowerCell::add_corners(std::uint32_t plane) {
  added_.clear();
  for (const std::uint32_t c : cut_) {
    for (std::size_t slot = 0; slot < 3; ++slot) {
      const std::uint32_t kept = corners_[c].neighbours[slot];
      if (kept >= is_cut_.size() || is_cut_[kept]) continue;
      const auto name = static_cast<std::uint32_t>(corners_.size());
      auto planes = corners_[c].planes;
      planes[slot] = plane;
      Corner corner = corner_of(planes);
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

void PowerCell::link_new_corners(std::uint32_t plane) {
  resize_amply(leaving_, planes_.size());
  resize_amply(arriving_, planes_.size());
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
  resize_amply(is_cut_, corners_.size());  // the new ones are not cut
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
  planes_.push_back(plane);
  cut_by(static_cast<std::uint32_t>(planes_.size() - 1));
  return true;
}

/// Removes the corners that find_cut_corners() found.
void PowerCell::cut_by(std::uint32_t plane) {
  if (cut_.size() == corners_.size()) {
    corners_.clear();
    return;
  }
  add_corners(plane);
  link_new_corners(plane);
  remove_cut_corners();
}

}  // namespace medial_vk
