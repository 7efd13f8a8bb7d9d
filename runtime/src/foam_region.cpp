#include "foam_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "point_math.h"

namespace medial_vk {

namespace {

// Cosines are wrong by a few units in the last place; sines that come from them by the root of that. Both are moved
// the safe way by this much (u = 2^-53; 16 u).
constexpr double kCosineError = 0x1p-49;
constexpr double kFinestPatch = 0.04;        // side of its square, about radians
constexpr double kAboutAsWide = 0.95;        // as a share of the widest
constexpr std::size_t kMostPatches = 400;    // of a division, per site
constexpr std::uint32_t kFirstDivision = 2;  // of a side of the cube

/// A cone of directions: a square of a face of the cube [-1, 1]^3, seen from the origin.
struct Patch {
  std::uint32_t face = 0;         // axis, and 3 for its negative side
  double u = 0, v = 0, half = 0;  // middle and half side of the square
  Point direction;                // unit, through the middle
  double cosine = 1, sine = 0;    // of the largest angle between the direction and one of the patch, rounded outwards
  double reach = 0;               // no point of the region in the cone is further from A
  std::vector<std::uint32_t> empty;  // balls that may still matter
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

/// Where a ray from A with dot(v, direction) = along leaves the ball around v with radius |v| + slack.
double leaves_at(double along, double distance, double slack) {
  const double power = 2 * distance * slack + slack * slack;
  return along + std::sqrt(along * along + power);
}

/// The patch's reach: from the full foam's reach inwards through the balls of the empty foam that every ray of the
/// patch crosses. On a ray with dot(e, direction) = d, ball (e, r) hides d -+ sqrt(d^2 - (|e|^2 - r^2)); the least d
/// hides least, because both ends move outwards as d grows.
void find_reach(const FoamRegion& region, Patch& patch) {
  double reach = 0;
  for (const Point& v : region.centres)
    reach = std::max(reach, leaves_at(along_patch(patch, v).most, length(v), region.slack));
  std::vector<std::pair<double, double>> hidden;  // to, from
  std::vector<std::uint32_t> still_matter;
  for (const std::uint32_t k : patch.empty) {
    const Point& e = region.empty[k].centre;
    const double r = region.empty[k].radius, power = dot(e, e) - r * r;
    const Along along = along_patch(patch, e);
    if (r <= 0 || along.most <= 0 || along.most * along.most <= power) continue;
    still_matter.push_back(k);
    if (along.least <= 0 || along.least * along.least <= power) continue;
    const double half = std::sqrt(along.least * along.least - power);
    hidden.emplace_back(along.least + half, power / (along.least + half));
  }
  patch.empty = std::move(still_matter);
  std::sort(hidden.begin(), hidden.end(), std::greater<>());
  for (const auto& [to, from] : hidden) {
    if (to <= reach) break;
    reach = std::min(reach, from);
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

  /// Divides the coarser patch of every pair that is about as wide as the widest; false if that is no use any more.
  bool divide() {
    std::vector<std::uint8_t> chosen(patches_.size(), 0);
    for_each_pair(kAboutAsWide * width_, [&](std::size_t i, std::size_t j, double width) {
      if (width > kAboutAsWide * width_) chosen[patches_[i].half < patches_[j].half ? j : i] = 1;
    });
    std::vector<Patch> old = std::exchange(patches_, {});
    bool divided = false;
    for (std::size_t i = 0; i < old.size(); ++i) {
      const bool divides = chosen[i] != 0 && old[i].half > kFinestPatch / 2 && patches_.size() < kMostPatches;
      divided = divided || divides;
      if (divides) {
        add_parts(old[i]);
      } else {
        patches_.push_back(std::move(old[i]));
      }
    }
    find_width();
    return divided;
  }

 private:
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
    for_each_pair(0, [&](std::size_t, std::size_t, double width) { width_ = std::max(width_, width); });
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
};

}  // namespace

double width_of_region(const FoamRegion& region, double enough) {
  if (region.centres.empty()) return 0;
  Division division(region);
  while (division.width() > enough && division.divide()) {
  }
  return division.width();
}

}  // namespace medial_vk
