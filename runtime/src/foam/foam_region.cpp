#include "foam/foam_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {

namespace {

// Cosines have errors of a few units in the last place; sines computed from them have the root of that. Both are moved
// in the safe direction by this amount (u = 2^-53; 16 u).
constexpr double kCosineError = 0x1p-49;
constexpr double kFinestPatch = 0.04;        // side of its square, about radians
constexpr double kAboutAsWide = 0.95;        // as a share of the widest
constexpr std::size_t kMostPatches = 1000;   // of a division, per site
constexpr double kSmallestBall = 1.0 / 64;   // radius over distance of its centre; foam.cpp, kRounding
constexpr std::uint32_t kFirstDivision = 2;  // of a side of the cube

/// A cone of directions: a square of a face of the cube [-1, 1]^3, seen from the origin.
struct Patch {
  std::uint32_t face = 0;         // axis, and 3 for its negative side
  double u = 0, v = 0, half = 0;  // middle and half side of the square
  Point direction;                // unit, through the middle
  double cosine = 1, sine = 0;    // of the largest angle between the direction and one of the patch, rounded outwards
  double reach = 0;               // no point of the region in the cone is further from A
  std::vector<std::uint32_t> empty;  // balls that may still hide points
};

Point unit_direction(std::uint32_t face, double u, double v) {
  const std::uint32_t axis = face % 3;
  Point d{};
  d[axis] = face < 3 ? 1 : -1;
  d[(axis + 1) % 3] = u;
  d[(axis + 2) % 3] = v;
  return (1 / length(d)) * d;
}

double sine_of(double cosine) { return std::min(1.0, std::sqrt(std::max(0.0, 1 - cosine * cosine) + kCosineError)); }

Patch make_patch(std::uint32_t face, double u, double v, double half) {
  Patch patch;
  patch.face = face;
  patch.u = u, patch.v = v, patch.half = half;
  patch.direction = unit_direction(face, u, v);
  // The angle to the middle has no maximum inside a convex spherical polygon: a corner is furthest.
  for (const double du : {-half, half}) {
    for (const double dv : {-half, half})
      patch.cosine = std::min(patch.cosine, dot(patch.direction, unit_direction(face, u + du, v + dv)));
  }
  patch.sine = sine_of(patch.cosine);
  return patch;
}

/// Bounds of dot(w, d) over the directions d of the patch.
struct Along {
  double least, most;
};

Along along_patch(const Patch& patch, const Point& w) {
  const double size = length(w);
  if (size == 0) return {0, 0};
  const double cosine = dot(w, patch.direction) / size, sine = sine_of(cosine);
  const double error = kCosineError * size;
  const double most = cosine >= patch.cosine ? size : size * (cosine * patch.cosine + sine * patch.sine) + error;
  const double least = -cosine >= patch.cosine ? -size : size * (cosine * patch.cosine - sine * patch.sine) - error;
  return {least, most};
}

/// The distance at which a ray from A with dot(v, direction) = along leaves the ball around v with radius |v| + slack.
double leaves_at(double along, double distance, double slack) {
  const double power = 2 * distance * slack + slack * slack;
  return along + std::sqrt(along * along + power);
}

/// The part of the rays of a patch that a ball of the empty foam hides, as distances from A. On a ray with dot(e,
/// direction) = d, ball (e, r) hides d -+ sqrt(d^2 - (|e|^2 - r^2)), and both ends move outwards as d grows: the least
/// d gives the part hidden on every ray of the patch, the largest d the part hidden on any.
struct Hidden {
  std::uint32_t ball;
  double from = 0, to = 0;                 // on every ray; nothing if to == 0
  double lowest_from = 0, highest_to = 0;  // on some ray

  double middle = 0, power = 0;  // dot(e, direction) on the middle ray, |e|^2 - r^2

  double length() const { return to - from; }
  /// True if this one hides everything that the other hides, on every ray of the patch and of any part of it.
  bool covers(const Hidden& other) const { return from <= other.lowest_from && to >= other.highest_to; }
};

/// False if the ball hides nothing on any ray, or is so small compared with its distance that rounding could hide too
/// much.
bool find_hidden(const Patch& patch, const Ball& ball, Hidden& hidden) {
  const Along along = along_patch(patch, ball.centre);
  const double power = dot(ball.centre, ball.centre) - ball.radius * ball.radius;
  if (ball.radius < kSmallestBall * length(ball.centre) || along.most <= 0 || along.most * along.most <= power)
    return false;
  hidden.middle = dot(ball.centre, patch.direction);
  hidden.power = power;
  hidden.highest_to = along.most + std::sqrt(along.most * along.most - power);
  hidden.lowest_from = power / hidden.highest_to;
  if (along.least > 0 && along.least * along.least > power) {
    hidden.to = along.least + std::sqrt(along.least * along.least - power);
    hidden.from = power / hidden.to;
  }
  return true;
}

/// True if on every ray of the patch the end of the full ball around v lies in the empty ball p. Where dot(v,
/// direction) = a > 0, the ray leaves the full ball at L <= 2 a + g, g = power / 2 a; L lies in p if L^2 - 2 L dot(p,
/// direction)
/// + |p|^2 - r^2 < 0, that is, if 2 a (2 dot(p - v, direction) - g) > |p|^2 - r^2. Two bounds of dot(p, .) and dot(v,
/// .) apart would need much smaller patches, for p - v is much shorter than p or v.
bool hides_end(const Patch& patch, const FoamRegion& region, const Point& v, const Ball& ball) {
  const double a = along_patch(patch, v).least;
  if (a <= 0) return false;
  const double grown = (2 * length(v) * region.slack + region.slack * region.slack) / (2 * a);
  const double power = dot(ball.centre, ball.centre) - ball.radius * ball.radius;
  return 2 * a * (2 * along_patch(patch, ball.centre - v).least - grown) > power;
}

/// The ball that hides the end of the full ball around v best on the middle ray; nullptr if none does.
const Hidden* best_hider(const Patch& patch, const FoamRegion& region, const Point& v,
                         const std::vector<Hidden>& hidden) {
  const Hidden* best = nullptr;
  double most = 0;
  const double a = dot(v, patch.direction);
  for (const Hidden& h : hidden) {
    const double margin = 4 * a * (h.middle - a) - h.power;
    if (h.to <= 0 || margin <= most) continue;
    most = margin;
    best = &h;
  }
  return best != nullptr && hides_end(patch, region, v, region.empty[best->ball]) ? best : nullptr;
}

/// The reach of the full foam on the rays of the patch, except for ends of its balls that single balls hide.
double end_of_full_foam(const Patch& patch, const FoamRegion& region, const std::vector<Hidden>& hidden) {
  double reach = 0;
  for (const Point& v : region.centres) {
    const double end = leaves_at(along_patch(patch, v).most, length(v), region.slack);
    if (end <= reach) continue;
    const Hidden* hider = best_hider(patch, region, v, hidden);
    reach = std::max(reach, hider != nullptr ? hider->from : end);
  }
  return reach;
}

/// The patch's reach: from the full foam's reach inwards through the parts that the empty foam hides.
void find_reach(const FoamRegion& region, Patch& patch) {
  std::vector<Hidden> hidden;
  hidden.reserve(patch.empty.size());
  Hidden longest = {};
  for (const std::uint32_t k : patch.empty) {
    Hidden here = {.ball = k};
    if (!find_hidden(patch, region.empty[k], here)) continue;
    hidden.push_back(here);
    if (here.length() > longest.length()) longest = here;
  }
  std::erase_if(hidden, [&](const Hidden& h) { return h.ball != longest.ball && longest.covers(h); });
  patch.empty.clear();
  for (const Hidden& h : hidden) patch.empty.push_back(h.ball);
  double reach = end_of_full_foam(patch, region, hidden);
  std::erase_if(hidden, [](const Hidden& h) { return h.to <= 0; });
  std::sort(hidden.begin(), hidden.end(), [](const Hidden& a, const Hidden& b) { return a.to > b.to; });
  for (const Hidden& h : hidden) {
    if (h.to <= reach) break;
    reach = std::min(reach, h.from);
  }
  patch.reach = std::max(0.0, reach);
}

/// A bound on the distance of two points of the region in the cones of two patches. For X, Y at distances s <= a and
/// t <= b from A, an angle of at most phi apart, |X - Y|^2 <= s^2 + t^2 - 2 s t cos(phi). That is convex in (s, t): a
/// corner of [0, a] x [0, b] is largest.
double width_between(const Patch& p, const Patch& q) {
  // Of the largest angle between a direction of p and one of q: three angles added up, pi at most.
  const double spread_cosine = p.cosine * q.cosine - p.sine * q.sine;
  const double spread_sine = p.sine * q.cosine + p.cosine * q.sine;
  const double middle = dot(p.direction, q.direction);
  const double cosine = middle <= kCosineError - spread_cosine
                            ? -1
                            : middle * spread_cosine - sine_of(middle) * spread_sine - kCosineError;
  const double a = p.reach, b = q.reach;
  return std::max({a, b, std::sqrt(std::max(0.0, a * a + b * b - 2 * a * b * std::max(-1.0, cosine)))});
}

/// The directions around A, divided further where two points of the region may be furthest apart.
class Division {
 public:
  explicit Division(const FoamRegion& region) : region_(region) {
    std::vector<std::uint32_t> all(region.empty.size());
    std::iota(all.begin(), all.end(), 0u);
    const double half = 1.0 / kFirstDivision;
    for (std::uint32_t k = 0; k < 6 * kFirstDivision * kFirstDivision; ++k) {
      const std::uint32_t u = k / 6 % kFirstDivision, v = k / 6 / kFirstDivision;
      add(make_patch(k % 6, (2 * u + 1) * half - 1, (2 * v + 1) * half - 1, half), all);
    }
    find_width();
  }

  double width() const { return width_; }

  /// The distance of two points of the region (up to rounding), on the middle rays of the two patches that bound it.
  double distance_of_two_points() const {
    const Patch p = middle_ray(patches_[widest_.first]), q = middle_ray(patches_[widest_.second]);
    return std::max({p.reach, q.reach, length(p.reach * p.direction - q.reach * q.direction)});
  }

  /// Divides the coarser patch of every pair that is about as wide as the widest; false if that cannot improve the
  /// bound any more.
  bool divide() {
    std::vector<std::uint8_t> chosen(patches_.size(), 0);
    for_each_pair(kAboutAsWide * width_, [&](std::size_t i, std::size_t j, double width) {
      if (width > kAboutAsWide * width_) chosen[patches_[i].half < patches_[j].half ? j : i] = 1;
    });
    std::vector<Patch> old = std::exchange(patches_, {});
    std::size_t divided = 0;
    for (std::size_t i = 0; i < old.size(); ++i) {
      const bool divides = chosen[i] != 0 && old[i].half > kFinestPatch / 2 && old.size() + 3 * divided < kMostPatches;
      divided += divides;
      if (divides) {
        add_parts(old[i]);
      } else {
        patches_.push_back(std::move(old[i]));
      }
    }
    find_width();
    return divided != 0;
  }

 private:
  Patch middle_ray(const Patch& patch) const {
    Patch ray = make_patch(patch.face, patch.u, patch.v, 0);
    ray.empty = patch.empty;
    find_reach(region_, ray);
    return ray;
  }

  void add(Patch patch, const std::vector<std::uint32_t>& candidates) {
    patch.empty = candidates;
    find_reach(region_, patch);
    patches_.push_back(std::move(patch));
  }

  void add_parts(const Patch& patch) {
    const double half = patch.half / 2;
    for (const double du : {-half, half}) {
      for (const double dv : {-half, half}) add(make_patch(patch.face, patch.u + du, patch.v + dv, half), patch.empty);
    }
  }

  void find_width() {
    std::sort(patches_.begin(), patches_.end(), [](const Patch& a, const Patch& b) { return a.reach > b.reach; });
    width_ = 0;
    for_each_pair(0, [&](std::size_t i, std::size_t j, double width) {
      if (width <= width_) return;
      width_ = width;
      widest_ = {i, j};
    });
  }

  /// All pairs that may be wider than `least` and than width_ is at that moment.
  template <class Visit>
  void for_each_pair(double least, const Visit& visit) {
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      for (std::size_t j = i; j < patches_.size(); ++j) {
        if (patches_[i].reach + patches_[j].reach <= std::max(least, kAboutAsWide * width_)) break;
        visit(i, j, width_between(patches_[i], patches_[j]));
      }
    }
  }

  const FoamRegion& region_;
  std::vector<Patch> patches_;  // those that reach furthest first
  double width_ = 0;
  std::pair<std::size_t, std::size_t> widest_ = {0, 0};
};

}  // namespace

double width_of_region(const FoamRegion& region, double enough, double too_much) {
  if (region.centres.empty()) return 0;
  Division division(region);
  while (division.width() > enough) {
    const double certain = division.distance_of_two_points();
    if (certain > too_much || certain > kAboutAsWide * division.width() || !division.divide()) break;
  }
  return division.width();
}

}  // namespace medial_vk
