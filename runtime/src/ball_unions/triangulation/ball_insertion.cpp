#include "ball_unions/triangulation/ball_insertion.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Bounds of a coordinate difference and of one more number.
struct Row {
  Point d;
  double lift, size, lift_size;
};

double largest_of(const Point& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

Row row(const Ball& ball, const Ball& from) {
  const Point d = ball.centre - from.centre;
  const double square = dot(d, d), radii = (ball.radius - from.radius) * (ball.radius + from.radius);
  return {d, square - radii, largest_of(d), square + std::fabs(radii)};
}

std::size_t slots_for(std::size_t edges) { return std::bit_ceil(2 * edges); }

}  // namespace

void BallInsertion::CavityEdges::make_room(std::size_t edges) { slots_.reserve(slots_for(edges)); }

void BallInsertion::CavityEdges::start(std::size_t edges) {
  const std::size_t size = slots_for(edges);
  if (size > slots_.size()) slots_.resize(size);
  mask_ = size - 1;
  if (++stamp_ == 0) slots_.assign(slots_.size(), {}), stamp_ = 1;
}

auto BallInsertion::CavityEdges::meet(std::uint32_t a, std::uint32_t b, Side side) -> const Side* {
  const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  for (std::size_t k = (key * 0x9e3779b97f4a7c15u) >> 32 & mask_;; k = (k + 1) & mask_) {
    Slot& slot = slots_[k];
    if (slot.stamp != stamp_) {
      slot = {key, side, stamp_};
      return nullptr;
    }
    if (slot.key == key) return &slot.side;
  }
}

/// The surface of a cavity is a sphere with at most all other balls and the four corners as its vertices, n + 3 of
/// them: it has 2 (n + 3) - 4 faces. The last insertion of a triangulation that is given up adds no more.
void BallInsertion::make_room(std::size_t balls) {
  const std::size_t faces = 2 * balls + 2, tetrahedra = RegularTriangulation::most_tetrahedra(balls) + faces;
  tetrahedra_.reserve(tetrahedra);
  marks_.reserve(tetrahedra);
  free_.reserve(tetrahedra);
  cavity_.reserve(tetrahedra);
  faces_.reserve(faces);
  edges_.make_room(3 * faces / 2);
  exact_.make_room();
}

void BallInsertion::start(std::span<const Ball> balls, const std::array<std::uint32_t, 4>& corners) {
  balls_ = balls;
  exact_.use(balls);
  tetrahedra_.clear();
  marks_.clear();
  free_.clear();
  last_ = stamp_ = 0;
  const std::size_t others = balls_.size() - corners.size();
  const std::size_t usual = std::min(8 * balls_.size(), RegularTriangulation::most_tetrahedra(others));
  tetrahedra_.reserve(usual);
  marks_.reserve(usual);
  tetrahedra_.push_back({corners, {kNone, kNone, kNone, kNone}});
  marks_.push_back(0);
}

void BallInsertion::insert(std::uint32_t ball) {
  const std::uint32_t t = locate(ball);
  // The lower hull of the lifted balls is convex: a point above it over its own centre is above all of it.
  if (!conflicts(t, ball)) return;
  find_cavity(t, ball);
  fill_cavity();
}

void BallInsertion::take(std::vector<Tetrahedron>& result) {
  std::vector<std::uint32_t>& names = marks_;  // which are not used any more
  std::fill(names.begin(), names.end(), 0);
  for (const std::uint32_t t : free_) names[t] = kNone;
  std::uint32_t count = 0;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    if (names[t] == kNone) continue;
    names[t] = count;
    tetrahedra_[count++] = tetrahedra_[t];
  }
  tetrahedra_.resize(count);
  for (Tetrahedron& t : tetrahedra_) {
    for (std::uint32_t& neighbour : t.neighbours) {
      if (neighbour != kNone) neighbour = names[neighbour];
    }
  }
  result.swap(tetrahedra_);  // whose memory serves the next triangulation
}

/// The side of the face without balls[k] of t on which the centre of the ball lies; below 0: outside.
int BallInsertion::side_of_face(const Tetrahedron& t, std::size_t k, std::uint32_t ball) {
  const std::array<std::size_t, 3> others = RegularTriangulation::kOthers[k];
  const Point& at = balls_[ball].centre;
  const Point a = balls_[t.balls[others[0]]].centre - at, b = balls_[t.balls[others[1]]].centre - at,
              c = balls_[t.balls[others[2]]].centre - at;
  const double volume = dot(a, cross(b, c));
  // Six products of three differences, fewer than 16 roundings of half a unit in each.
  if (std::fabs(volume) > 64 * DBL_EPSILON * largest_of(a) * largest_of(b) * largest_of(c)) return volume > 0 ? 1 : -1;
  return exact_.orientation(ball, t.balls[others[0]], t.balls[others[1]], t.balls[others[2]]);
}

/// Walks towards the centre of the ball, from the last tetrahedron made. That ends in regular triangulations (H.
/// Edelsbrunner, "An Acyclicity Theorem for Cell Complexes in d Dimensions", 1990).
std::uint32_t BallInsertion::locate(std::uint32_t ball) {
  std::uint32_t t = last_, from = kNone;
  for (std::size_t k = 0; k < 4;) {
    const std::uint32_t next = tetrahedra_[t].neighbours[k];
    if (next == kNone || next == from || side_of_face(tetrahedra_[t], k, ball) >= 0) {
      ++k;
      continue;
    }
    from = t;
    t = next;
    k = 0;
  }
  return t;
}

/// True if the power of the ball's centre to the orthogonal sphere of t is below the ball's own r^2: the sign of a
/// determinant of rows (c_k - c, |c_k - c|^2 - r_k^2 + r^2).
bool BallInsertion::conflicts(std::uint32_t t, std::uint32_t ball) {
  const auto& names = tetrahedra_[t].balls;
  const Ball& own = balls_[ball];
  const Row p = row(balls_[names[0]], own), q = row(balls_[names[1]], own), r = row(balls_[names[2]], own),
            s = row(balls_[names[3]], own);
  const Point pq = cross(p.d, q.d), rs = cross(r.d, s.d);
  const double power =
      (q.lift * dot(p.d, rs) - p.lift * dot(q.d, rs)) + (s.lift * dot(r.d, pq) - r.lift * dot(s.d, pq));
  // 24 products of three differences and a lift, fewer than 20 roundings of half a unit in each.
  const double pq_size = p.size * q.size, rs_size = r.size * s.size;
  const double size =
      (p.lift_size * q.size + q.lift_size * p.size) * rs_size + (r.lift_size * s.size + s.lift_size * r.size) * pq_size;
  if (std::fabs(power) > 128 * DBL_EPSILON * size) return power < 0;
  const auto name = [&](std::size_t k) { return static_cast<std::int32_t>(names[k]); };
  return !exact_.keeps(names[0], name(1), name(2), name(3), static_cast<std::int32_t>(ball));
}

void BallInsertion::find_cavity(std::uint32_t first, std::uint32_t ball) {
  ++stamp_;
  mark(first, true);
  cavity_.assign(1, first);
  faces_.clear();
  for (std::size_t n = 0; n < cavity_.size(); ++n) {
    const std::uint32_t t = cavity_[n];
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = tetrahedra_[t].neighbours[k];
      if (next != kNone && !is_marked(next)) {
        mark(next, conflicts(next, ball));
        if (is_in_cavity(next)) cavity_.push_back(next);
      }
      if (next == kNone || !is_in_cavity(next)) add_face(t, k, ball);
    }
  }
}

void BallInsertion::add_face(std::uint32_t t, std::uint32_t k, std::uint32_t ball) {
  Face face{tetrahedra_[t].balls, k, tetrahedra_[t].neighbours[k], 0};
  face.balls[k] = ball;
  if (face.outside != kNone) {
    const auto& back = tetrahedra_[face.outside].neighbours;
    face.back = static_cast<std::uint32_t>(std::find(back.begin(), back.end(), t) - back.begin());
  }
  faces_.push_back(face);
}

std::uint32_t BallInsertion::room_for(std::size_t n) {
  if (n < cavity_.size()) return cavity_[n];
  if (!free_.empty()) {
    const std::uint32_t t = free_.back();
    free_.pop_back();
    return t;
  }
  tetrahedra_.emplace_back();
  marks_.push_back(0);
  return static_cast<std::uint32_t>(tetrahedra_.size() - 1);
}

/// A ball that is in no face any more is hidden: its cell is empty.
void BallInsertion::fill_cavity() {
  edges_.start(3 * faces_.size() / 2);
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const Face& face = faces_[n];
    const std::uint32_t t = room_for(n);
    Tetrahedron& made = tetrahedra_[t];
    made.balls = face.balls;
    made.neighbours[face.own] = face.outside;
    if (face.outside != kNone) tetrahedra_[face.outside].neighbours[face.back] = t;
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (k != face.own) join(t, k, face);
    }
    last_ = t;
  }
  for (std::size_t n = faces_.size(); n < cavity_.size(); ++n) free_.push_back(cavity_[n]);
}

/// Joins new tetrahedron t to the one that shares its face without balls[k].
void BallInsertion::join(std::uint32_t t, std::uint32_t k, const Face& face) {
  std::array<std::uint32_t, 2> edge{};
  std::size_t count = 0;
  for (std::uint32_t j = 0; j < 4; ++j) {
    if (j != k && j != face.own) edge[count++] = face.balls[j];
  }
  const CavityEdges::Side* other = edges_.meet(edge[0], edge[1], {t, k});
  if (other == nullptr) return;
  tetrahedra_[t].neighbours[k] = other->tetrahedron;
  tetrahedra_[other->tetrahedron].neighbours[other->face] = t;
}

}  // namespace medial_vk
