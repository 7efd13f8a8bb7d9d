#include "solid/probes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parallel.h"

namespace medial_vk {
namespace {

double fraction(double x) { return x - std::floor(x); }

/// The k-th position in the unit cube of four dimensions: the generalised golden ratio (M. Roberts, 2018), powers of
/// the inverse of the root of x^5 = x + 1.
std::array<double, 4> position(std::size_t k) {
  const auto i = static_cast<double>(k) + 1;
  return {fraction(0.5 + 0.8566748838545029 * i), fraction(0.5 + 0.7338918566271260 * i),
          fraction(0.5 + 0.6287067210378087 * i), fraction(0.5 + 0.5385972572236101 * i)};
}

class Surroundings {
 public:
  explicit Surroundings(const Solid& solid) : solid_(solid), lower_(solid.mesh().report.lower) {
    const Point size = solid.mesh().report.upper - lower_;
    side_ = *std::max_element(size.begin(), size.end());
    lower_ = lower_ - Point{side_, side_, side_};
    size_ = size + 2 * Point{side_, side_, side_};
  }

  /// No value: the k-th point is in the solid, on its boundary or too far from it.
  std::optional<Probe> probe(std::size_t k) const {
    const auto [x, y, z, share] = position(k);
    const Point p = lower_ + Point{x * size_[0], y * size_[1], z * size_[2]};
    const BvhHit hit = solid_.closest(p);
    const double distance = std::sqrt(hit.squared_distance);
    if (!(distance > solid_.rounding()) || distance > side_ || solid_.contains(p)) return std::nullopt;
    return Probe{hit.point, (1 / distance) * (p - hit.point), (1 - share) * distance};
  }

 private:
  const Solid& solid_;
  Point lower_, size_ = {0, 0, 0};
  double side_ = 0;
};

}  // namespace

/// Fewer only where coordinates are so large for the size of the solid that rounding hides what is around it: otherwise
/// the solid's box has a volume of at most L^3, L being its longest side; the box of the points one of at most 27 L^3,
/// of which those at most L from one point of the solid take 4 pi / 3 L^3. So an eighth or more of the points count.
std::vector<Probe> probes_around(const Solid& solid, std::size_t count, unsigned threads,
                                 const std::function<void()>& check) {
  constexpr std::size_t kPeriod = 64, kMostTries = 64;  // of as many points
  const Surroundings around(solid);
  std::vector<Probe> probes;
  probes.reserve(count);
  std::vector<std::optional<Probe>> next(count);
  for (std::size_t first = 0; probes.size() < count && first < kMostTries * count; first += count) {
    parallel_for(count, kPeriod, threads, [&](std::size_t i) {
      if (check && i % kPeriod == 0) check();
      next[i] = around.probe(first + i);
    });
    for (const std::optional<Probe>& probe : next) {
      if (probe && probes.size() < count) probes.push_back(*probe);
    }
  }
  return probes;
}

}  // namespace medial_vk
