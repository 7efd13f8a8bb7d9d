#include "ball_unions/triangulation/regular_triangulation.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

using Tetrahedron = RegularTriangulation::Tetrahedron;
constexpr std::uint32_t kNone = RegularTriangulation::kNone;

/// Bounds of a coordinate difference and of one more number.
struct Row {
  Point d;
  double lift, size, lift_size;
};

double largest_of(const Point& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

/// The faces of a cavity meet in edges, two in each: an edge is inserted here at its first face, and found at its
/// second.
class CavityEdges {
 public:
  struct Side {
    std::uint32_t tetrahedron, face;
  };

  void start(std::size_t edges) {
    const std::size_t size = std::bit_ceil(2 * edges);
    if (size > slots_.size()) slots_.assign(size, {});
    if (++stamp_ == 0) slots_.assign(slots_.size(), {}), stamp_ = 1;
  }
  /// The side that was inserted for this edge; if there is none, inserts `side`.
  const Side* meet(std::uint32_t a, std::uint32_t b, Side side) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t k = (key * 0x9e3779b97f4a7c15u) >> 32 & mask;; k = (k + 1) & mask) {
      Slot& slot = slots_[k];
      if (slot.stamp != stamp_) {
        slot = {key, side, stamp_};
        return nullptr;
      }
      if (slot.key == key) return &slot.side;
    }
  }

 private:
  struct Slot {
    std::uint64_t key;
    Side side;
    std::uint32_t stamp;
  };
  std::vector<Slot> slots_;
  std::uint32_t stamp_ = 0;
};

/// Adds ball after ball: the tetrahedra whose orthogonal sphere is too near to the new ball are removed, and the cavity
/// is filled with tetrahedra from its faces to the new ball (A. Bowyer; D. F. Watson, 1981; with weights: H.
/// Edelsbrunner, N. R. Shah, "Incremental Topological Flipping Works for Regular Triangulations", 1996).
class Inserting {
 public:
  explicit Inserting(std::span<const Ball> balls) : balls_(balls), exact_(balls, no_walls_) {}

  /// One tetrahedron that holds all later centres.
  void start(const std::array<std::uint32_t, 4>& corners) {
    tetrahedra_.reserve(8 * balls_.size());
    tetrahedra_.push_back({corners, {kNone, kNone, kNone, kNone}});
    marks_.push_back(0);
  }

  std::size_t size() const { return tetrahedra_.size() - free_.size(); }

  void insert(std::uint32_t ball) {
    const std::uint32_t t = locate(ball);
    // The lower hull of the lifted balls is convex: a point above it over its own centre is above all of it.
    if (!conflicts(t, ball)) return;
    find_cavity(t, ball);
    fill_cavity();
  }

  /// Without removed tetrahedra.
  std::vector<Tetrahedron> take() {
    std::vector<std::uint32_t> name(tetrahedra_.size(), 0);
    for (const std::uint32_t t : free_) name[t] = kNone;
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < tetrahedra_.size(); ++t) {
      if (name[t] == kNone) continue;
      name[t] = count;
      tetrahedra_[count++] = tetrahedra_[t];
    }
    tetrahedra_.resize(count);
    for (Tetrahedron& t : tetrahedra_) {
      for (std::uint32_t& neighbour : t.neighbours) {
        if (neighbour != kNone) neighbour = name[neighbour];
      }
    }
    return std::move(tetrahedra_);
  }

 private:
  /// A face of the cavity, as the tetrahedron from it to the new ball.
  struct Face {
    std::array<std::uint32_t, 4> balls;
    std::uint32_t own;      // which of them is the new one
    std::uint32_t outside;  // the tetrahedron on the other side,
    std::uint32_t back;     // and which of its neighbours is on this one
  };

  Row row(const Ball& ball, const Ball& from) const {
    const Point d = ball.centre - from.centre;
    const double square = dot(d, d), radii = (ball.radius - from.radius) * (ball.radius + from.radius);
    return {d, square - radii, largest_of(d), square + std::fabs(radii)};
  }

  /// The side of the face without balls[k] of t on which the centre of the ball lies; below 0: outside.
  int side_of_face(const Tetrahedron& t, std::size_t k, std::uint32_t ball) {
    const std::array<std::size_t, 3> others = RegularTriangulation::kOthers[k];
    const Point& at = balls_[ball].centre;
    const Point a = balls_[t.balls[others[0]]].centre - at, b = balls_[t.balls[others[1]]].centre - at,
                c = balls_[t.balls[others[2]]].centre - at;
    const double volume = dot(a, cross(b, c));
    // Six products of three differences, fewer than 16 roundings of half a unit in each.
    if (std::fabs(volume) > 64 * DBL_EPSILON * largest_of(a) * largest_of(b) * largest_of(c))
      return volume > 0 ? 1 : -1;
    return exact_.orientation(ball, t.balls[others[0]], t.balls[others[1]], t.balls[others[2]]);
  }

  /// Walks towards the centre of the ball, from the last tetrahedron made. That ends in regular triangulations (H.
  /// Edelsbrunner, "An Acyclicity Theorem for Cell Complexes in d Dimensions", 1990).
  std::uint32_t locate(std::uint32_t ball) {
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
  bool conflicts(std::uint32_t t, std::uint32_t ball) {
    const auto& names = tetrahedra_[t].balls;
    const Ball& own = balls_[ball];
    const Row p = row(balls_[names[0]], own), q = row(balls_[names[1]], own), r = row(balls_[names[2]], own),
              s = row(balls_[names[3]], own);
    const Point pq = cross(p.d, q.d), rs = cross(r.d, s.d);
    const double power =
        (q.lift * dot(p.d, rs) - p.lift * dot(q.d, rs)) + (s.lift * dot(r.d, pq) - r.lift * dot(s.d, pq));
    // 24 products of three differences and a lift, fewer than 20 roundings of half a unit in each.
    const double pq_size = p.size * q.size, rs_size = r.size * s.size;
    const double size = (p.lift_size * q.size + q.lift_size * p.size) * rs_size +
                        (r.lift_size * s.size + s.lift_size * r.size) * pq_size;
    if (std::fabs(power) > 128 * DBL_EPSILON * size) return power < 0;
    const auto name = [&](std::size_t k) { return static_cast<std::int32_t>(names[k]); };
    return !exact_.keeps(names[0], name(1), name(2), name(3), static_cast<std::int32_t>(ball));
  }

  bool is_marked(std::uint32_t t) const { return marks_[t] / 2 == stamp_; }
  void mark(std::uint32_t t, bool in_cavity) { marks_[t] = 2 * stamp_ + (in_cavity ? 1 : 0); }
  bool is_in_cavity(std::uint32_t t) const { return marks_[t] == 2 * stamp_ + 1; }

  void find_cavity(std::uint32_t first, std::uint32_t ball) {
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

  void add_face(std::uint32_t t, std::uint32_t k, std::uint32_t ball) {
    Face face{tetrahedra_[t].balls, k, tetrahedra_[t].neighbours[k], 0};
    face.balls[k] = ball;
    if (face.outside != kNone) {
      const auto& back = tetrahedra_[face.outside].neighbours;
      face.back = static_cast<std::uint32_t>(std::find(back.begin(), back.end(), t) - back.begin());
    }
    faces_.push_back(face);
  }

  std::uint32_t room_for(std::size_t n) {
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
  void fill_cavity() {
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
  void join(std::uint32_t t, std::uint32_t k, const Face& face) {
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

  std::span<const Ball> balls_;
  std::vector<Wall> no_walls_;
  ExactSide exact_;
  std::vector<Tetrahedron> tetrahedra_;
  // by tetrahedron: twice the number of the last insertion that tested it; 1 more: in its cavity
  std::vector<std::uint32_t> marks_;
  std::vector<std::uint32_t> free_;
  std::uint32_t last_ = 0, stamp_ = 0;

  // State of the current insertion.
  std::vector<std::uint32_t> cavity_;
  std::vector<Face> faces_;
  CavityEdges edges_;
};

/// Random rounds, each half as large as the next, with neighbours after each other in each: few tetrahedra are created
/// in vain, and the next position is never far (N. Amenta, S. Choi, G. Rote, "Incremental Constructions con BRIO",
/// 2003).
std::vector<std::uint32_t> in_rounds(std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> result(order.begin(), order.end());
  const auto round = [](std::uint32_t i) {
    std::uint64_t bits = (i + 1) * 0x9e3779b97f4a7c15u;
    bits = (bits ^ bits >> 32) * 0xd6e8feb86659fd93u;
    return std::countr_zero(bits >> 32 | std::uint64_t{1} << 32);
  };
  std::stable_sort(result.begin(), result.end(), [&](std::uint32_t a, std::uint32_t b) { return round(a) > round(b); });
  return result;
}

constexpr std::size_t kMostPerBall = 24, kMostAnyway = 4096;  // tetrahedra

}  // namespace

std::optional<RegularTriangulation> RegularTriangulation::build(std::span<const Ball> balls,
                                                                std::span<const std::uint32_t> order,
                                                                unsigned threads) {
  RegularTriangulation made(balls);
  const auto far = static_cast<std::uint32_t>(balls.size());
  Inserting inserting(made.balls_);
  inserting.start({far, far + 1, far + 2, far + 3});
  // One more ball adds at most twice as many as there are balls: names never run out.
  const std::size_t most = std::min<std::size_t>(kMostPerBall * balls.size() + kMostAnyway, 1u << 31);
  for (const std::uint32_t ball : in_rounds(order)) {
    inserting.insert(ball);
    if (inserting.size() > most) return std::nullopt;
  }
  made.tetrahedra_ = inserting.take();
  made.list_stars();
  made.place_corners(threads);
  return made;
}

RegularTriangulation::RegularTriangulation(std::span<const Ball> balls) {
  balls_.reserve(balls.size() + kFarPoints);
  balls_.assign(balls.begin(), balls.end());
  add_far_points();
}

/// Four corners of a cube around the middle, 16 times as large as a cube around all balls: the tetrahedron between them
/// holds a ball of 9 times that size.
void RegularTriangulation::add_far_points() {
  Point low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Ball& ball : balls_) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], ball.centre[k] - ball.radius);
      high[k] = std::max(high[k], ball.centre[k] + ball.radius);
    }
  }
  if (balls_.empty()) low = high = {};
  const Point middle = 0.5 * (low + high);
  // Large enough that the rounding of the middle, 2^-53, and of radii next to it does not matter.
  const double far = 16 * std::max(0.5 * largest_of(high - low), 0x1p-40);
  for (const Point& sign : {Point{-1, -1, -1}, Point{1, 1, -1}, Point{-1, 1, 1}, Point{1, -1, 1}}) {
    balls_.push_back({middle + far * sign, 0});
  }
}

void RegularTriangulation::list_stars() {
  first_.assign(balls_.size() + 1, 0);
  for (const Tetrahedron& t : tetrahedra_) {
    for (const std::uint32_t ball : t.balls) ++first_[ball + 1];
  }
  for (std::size_t i = 0; i < balls_.size(); ++i) first_[i + 1] += first_[i];
  around_.resize(first_.back());
  positions_.resize(tetrahedra_.size());
  std::vector<std::uint32_t> count(balls_.size(), 0);
  for (std::uint32_t t = 0; t < tetrahedra_.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t ball = tetrahedra_[t].balls[k];
      positions_[t][k] = count[ball]++;
      around_[first_[ball] + positions_[t][k]] = t;
    }
  }
}

// Computed once here, not in each of the four cells.
void RegularTriangulation::place_corners(unsigned threads) {
  corners_.resize(tetrahedra_.size());
  parallel_blocks(tetrahedra_.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    const std::vector<Wall> no_walls{};
    ExactSide exact(balls_, no_walls);
    for (std::size_t t = begin; t < end; ++t) corners_[t] = place_corner(tetrahedra_[t], exact);
  });
}

RegularTriangulation::Corner RegularTriangulation::place_corner(const Tetrahedron& t, ExactSide& exact) const {
  const auto& [i, p, q, s] = t.balls;
  const auto [at, slack] = meeting_point(bisector(balls_, i, p), bisector(balls_, i, q), bisector(balls_, i, s));
  // Each cell tests whether it is in its box (PowerCell::sharpen).
  const double distance = length(at), radius = balls_[i].radius;
  const bool may_be_in_box = distance <= 2 * radius + slack;
  double smallest = HUGE_VAL;  // of those that have a part of the union
  for (const std::uint32_t ball : t.balls) {
    if (balls_[ball].radius > 0) smallest = std::min(smallest, balls_[ball].radius);
  }
  const bool is_good = slack <= (may_be_in_box ? kSharpCorner * smallest : kRoughCorner * std::max(radius, distance));
  if (is_good) return {at, slack};
  const auto [exact_at, exact_slack] =
      exact.meet(i, static_cast<std::int32_t>(p), static_cast<std::int32_t>(q), static_cast<std::int32_t>(s));
  return {exact_at, exact_slack};
}

}  // namespace medial_vk
