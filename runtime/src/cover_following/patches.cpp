#include "cover_following/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/nearest_ball_tree.h"

namespace medial_vk {
namespace {

/// Greatest number of halvings of a triangle.
constexpr int kHalvings = 10;
constexpr std::int32_t kUnits = 1 << kHalvings;
/// A ball grows by this share of its radius for a part rather than that the part is divided.
constexpr double kGrowthForAPart = 1e-3;

/// A point of a triangle: multiples of 1 / kUnits of the second and third corner.
using Place = std::array<std::int32_t, 2>;
using Places = std::array<Place, 3>;

Weights weights_of(const Place& place) {
  const auto share = [](std::int32_t units) { return std::ldexp(static_cast<double>(units), -kHalvings); };
  return {share(kUnits - place[0] - place[1]), share(place[0]), share(place[1])};
}

Place between(const Place& a, const Place& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}; }

/// Twice the signed area, in squared units.
std::int64_t doubled_area(const Place& a, const Place& b, const Place& c) {
  return std::int64_t{b[0] - a[0]} * (c[1] - a[1]) - std::int64_t{b[1] - a[1]} * (c[0] - a[0]);
}

/// The corners of the convex hull replace the places. (Andrew's monotone chain)
void keep_hull(std::vector<Place>& places) {
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());  // clang 14 cannot read std::ranges::unique
  std::vector<Place> hull;
  const auto append = [&](const Place& place, std::size_t from) {
    while (hull.size() >= from + 2 && doubled_area(hull[hull.size() - 2], hull.back(), place) <= 0) hull.pop_back();
    hull.push_back(place);
  };
  for (const Place& place : places) append(place, 0);
  hull.pop_back();
  const std::size_t lower = hull.size();
  for (std::size_t i = places.size(); i-- > 0;) append(places[i], lower);
  hull.pop_back();
  places = std::move(hull);
}

/// The part of a triangle that one ball holds: the hull of its parts.
struct Share {
  std::uint32_t ball, triangle;
  std::int64_t area;  // doubled, of the parts
  std::vector<Place> corners;
};

/// Divides single triangles.
class TriangleDivision {
 public:
  TriangleDivision(const NearestBallTree& tree, std::span<const std::uint32_t> number) : tree_(tree), number_(number) {}

  void run(const std::array<Point, 3>& corners, std::uint32_t triangle, std::vector<Share>& shares) {
    corners_ = corners;
    triangle_ = triangle;
    const std::size_t before = shares.size();
    const Places whole = {{{0, 0}, {kUnits, 0}, {0, kUnits}}};
    const std::array<Point, 3> part = points_of(whole);
    const Point middle = middle_of(part);
    const std::uint32_t nearest = tree_.nearest(middle).ball;
    const double growth = growth_of(nearest, part);
    tree_.gather(middle, growth + farthest(part, middle), found_);
    found_.push_back(nearest);  // which the rounding of the limit may leave out
    std::ranges::sort(found_);
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    divide(whole, found_, 0, shares);
    for (std::size_t i = before; i < shares.size(); ++i) keep_hull(shares[i].corners);
  }

 private:
  static Point middle_of(const std::array<Point, 3>& p) { return (1.0 / 3) * (p[0] + (p[1] + p[2])); }
  static double farthest(const std::array<Point, 3>& p, const Point& from) {
    return std::max({length(p[0] - from), length(p[1] - from), length(p[2] - from)});
  }
  std::array<Point, 3> points_of(const Places& places) const {
    std::array<Point, 3> points;
    for (std::size_t k = 0; k < 3; ++k) points[k] = point_of(weights_of(places[k]), corners_);
    return points;
  }
  double growth_of(std::uint32_t ball, const std::array<Point, 3>& part) const {
    return farthest(part, tree_.balls()[ball].centre) - tree_.balls()[ball].radius;
  }

  /// No ball without |m - c| - r <= g + a can take a part, with m the middle and a the reach of this one, and g the
  /// least growth for it: parts reach at least as far from c as their middles, and need no more growth than the whole.
  void divide(const Places& places, const std::vector<std::uint32_t>& near, int depth, std::vector<Share>& shares) {
    const std::array<Point, 3> part = points_of(places);
    const Point middle = middle_of(part);
    std::uint32_t best = near.front();
    double least = std::numeric_limits<double>::infinity(), of_middle = least;
    for (const std::uint32_t ball : near) {
      of_middle = std::min(of_middle, length(middle - tree_.balls()[ball].centre) - tree_.balls()[ball].radius);
      const double growth = growth_of(ball, part);
      if (growth >= least) continue;
      least = growth;
      best = ball;
    }
    const bool is_held = least <= kGrowthForAPart * tree_.balls()[best].radius;
    // A ball must grow for some part of it at least by what its middle needs.
    if (depth == kHalvings || is_held || least <= 2 * of_middle) {
      give(number_[best], places, shares);
      return;
    }
    const double limit = least + farthest(part, middle);
    std::vector<std::uint32_t> nearer;
    for (const std::uint32_t ball : near) {
      const double of_ball = length(middle - tree_.balls()[ball].centre) - tree_.balls()[ball].radius;
      if (of_ball <= limit || ball == best) nearer.push_back(ball);
    }
    const auto& [a, b, c] = places;
    const Place ab = between(a, b), bc = between(b, c), ca = between(c, a);
    for (const Places& quarter : {Places{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{ab, bc, ca}}}) {
      divide(quarter, nearer, depth + 1, shares);
    }
  }

  void give(std::uint32_t ball, const Places& places, std::vector<Share>& shares) const {
    auto share = std::find_if(shares.rbegin(), shares.rend(),
                              [&](const Share& each) { return each.triangle != triangle_ || each.ball == ball; });
    if (share == shares.rend() || share->triangle != triangle_) {
      shares.push_back({ball, triangle_, 0, {}});
      share = shares.rbegin();
    }
    share->area += std::abs(doubled_area(places[0], places[1], places[2]));
    share->corners.insert(share->corners.end(), places.begin(), places.end());
  }

  const NearestBallTree& tree_;
  std::span<const std::uint32_t> number_;  // of the balls of the tree
  std::array<Point, 3> corners_{};
  std::uint32_t triangle_ = 0;
  std::vector<std::uint32_t> found_;
};

}  // namespace

Patches divide_boundary(std::span<const Point> vertices, std::span<const Triangle> triangles,
                        std::span<const Ball> balls, unsigned threads) {
  constexpr std::size_t kBlock = 64;  // triangles that one thread takes at a time
  constexpr std::size_t kMostCorners = 0xf0000000u;
  std::vector<Ball> holding;
  std::vector<std::uint32_t> number;
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (!(balls[i].radius > 0)) continue;
    holding.push_back(balls[i]);
    number.push_back(i);
  }
  const NearestBallTree tree(holding);
  std::vector<std::vector<Share>> by_block((triangles.size() + kBlock - 1) / kBlock);
  const auto corners_of = [&](std::size_t t) {
    return std::array<Point, 3>{vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]};
  };
  parallel_blocks(triangles.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
    TriangleDivision division(tree, number);
    for (std::size_t t = begin; t < end; ++t) {
      division.run(corners_of(t), static_cast<std::uint32_t>(t), by_block[begin / kBlock]);
    }
  });

  Patches result;
  result.first.assign(balls.size() + 1, 0);
  for (const auto& shares : by_block) {
    for (const Share& share : shares) ++result.first[share.ball + 1];
  }
  for (std::size_t i = 0; i < balls.size(); ++i) result.first[i + 1] += result.first[i];
  result.patches.resize(result.first.back());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (const auto& shares : by_block) {
    for (const Share& share : shares) {
      if (result.corners.size() > kMostCorners) throw std::length_error("corners of patches");
      const std::array<Point, 3> corner = corners_of(share.triangle);
      const double whole = 0.5 * length(cross(corner[1] - corner[0], corner[2] - corner[0]));
      const double part = static_cast<double>(share.area) / (static_cast<double>(kUnits) * kUnits);
      result.patches[next[share.ball]++] = {share.triangle, static_cast<std::uint32_t>(result.corners.size()),
                                            static_cast<std::uint32_t>(share.corners.size()), part * whole};
      for (const Place& place : share.corners) result.corners.push_back(weights_of(place));
    }
  }
  return result;
}

}  // namespace medial_vk
