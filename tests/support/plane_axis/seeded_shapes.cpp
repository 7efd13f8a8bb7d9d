#include "support/plane_axis/seeded_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace medial_vk::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p20;

using Outline = std::vector<std::vector<std::array<double, 2>>>;

/// Letters on a grid of 8 by 10.
std::vector<Outline> letter_outlines() {
  return {
      {{{0, 0}, {8, 0}, {8, 2}, {2, 2}, {2, 4}, {6, 4}, {6, 6}, {2, 6}, {2, 8}, {8, 8}, {8, 10}, {0, 10}}},    // E
      {{{0, 0}, {2, 0}, {2, 4}, {6, 4}, {6, 0}, {8, 0}, {8, 10}, {6, 10}, {6, 6}, {2, 6}, {2, 10}, {0, 10}}},  // H
      {{{3, 0}, {5, 0}, {5, 8}, {8, 8}, {8, 10}, {0, 10}, {0, 8}, {3, 8}}},                                    // T
      {{{0, 0}, {2, 0}, {3, 3}, {5, 3}, {6, 0}, {8, 0}, {5, 10}, {3, 10}}, {{3.5, 5}, {4.5, 5}, {4, 7}}},      // A
      {{{0, 0}, {6, 0}, {8, 2}, {8, 4}, {7, 5}, {8, 6}, {8, 8}, {6, 10}, {0, 10}},
       {{2, 2}, {5, 2}, {6, 3}, {5, 4}, {2, 4}},
       {{2, 6}, {5, 6}, {6, 7}, {5, 8}, {2, 8}}},  // B
      {{{3, 0}, {5, 0}, {8, 3}, {8, 7}, {5, 10}, {3, 10}, {0, 7}, {0, 3}},
       {{2, 4}, {3, 3}, {5, 3}, {6, 4}, {6, 6}, {5, 7}, {3, 7}, {2, 6}}},                    // O
      {{{0, 0}, {8, 0}, {8, 2}, {3, 2}, {8, 8}, {8, 10}, {0, 10}, {0, 8}, {5, 8}, {0, 2}}},  // Z
      {{{3, 0}, {5, 0}, {8, 10}, {6, 10}, {4, 3}, {2, 10}, {0, 10}}}                         // V
  };
}

class SeededRings {
 public:
  explicit SeededRings(std::uint64_t seed) : random_(seed) {}

  std::vector<PlaneRing> make(std::uint64_t family) {
    switch (family) {
      case 0:
        return holes();
      case 1:
        return {comb()};
      case 2:
        return {spiral()};
      case 3:
        return letters();
      case 4:
        return nearly_touching();
      case 5:
        return touching();
      default:
        return {star()};
    }
  }

 private:
  double share() { return std::uniform_real_distribution<>(0, 1)(random_); }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }

  static PlaneRing regular(int corners, double x, double y, double radius, double turn) {
    PlaneRing ring;
    for (int i = 0; i < corners; ++i) {
      const double a = turn + 2 * kPi * i / corners;
      ring.push_back({x + radius * std::cos(a), y + radius * std::sin(a)});
    }
    return ring;
  }
  static PlaneRing rectangle(double x, double y, double width, double height) {
    return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  }

  std::vector<PlaneRing> holes() {
    const int side = 2 + below(2);
    std::vector<PlaneRing> rings = {rectangle(0, 0, side * kUnit, side * kUnit)};
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const int corners = 3 + below(6);
        const double turn = 6 * share(), radius = (0.1 + 0.38 * share()) * kUnit;
        rings.push_back(regular(corners, (column + 0.5) * kUnit, (row + 0.5) * kUnit, radius, turn));
      }
    }
    return rings;
  }

  PlaneRing comb() {
    PlaneRing ring;
    const int teeth = 4 + below(8);
    const double turn = below(3) == 0 ? 0 : 6 * share(), width = 0.05 + 0.9 * share();
    const auto add = [&](double x, double y) {
      ring.push_back(
          {kUnit * (x * std::cos(turn) - y * std::sin(turn)), kUnit * (x * std::sin(turn) + y * std::cos(turn))});
    };
    for (int i = 0; i < teeth; ++i) {
      const double height = below(2) == 0 ? 5 : 5 * share() + 0.1;
      add(i, 0);
      add(i, height);
      add(i + width, height);
      add(i + width, 0);
    }
    add(teeth - 1 + width, -1);
    add(0, -1);
    return ring;
  }

  PlaneRing spiral() {
    PlaneRing ring;
    const double turn = 6 * share(), step = 0.1 + 0.3 * share(), width = 0.2 + 0.5 * share();
    const int half = 20 + below(20);
    const auto add = [&](int i, double out) {
      const double a = turn + step * i, radius = kUnit * (0.5 + out + step * i / (2 * kPi));
      ring.push_back({radius * std::cos(a), radius * std::sin(a)});
    };
    for (int i = 0; i < half; ++i) add(i, 0);
    for (int i = half - 1; i >= 0; --i) add(i, width);
    return ring;
  }

  std::vector<PlaneRing> letters() {
    const std::vector<Outline> outlines = letter_outlines();
    std::vector<PlaneRing> rings;
    const bool is_upright = below(3) == 0;
    const double a = kUnit * (0.1 + 0.1 * share()), b = is_upright ? 0 : a * (share() - 0.5);
    const double c = is_upright ? 0 : a * (share() - 0.5), d = kUnit * (0.1 + 0.1 * share());
    const int count = 1 + below(3);
    for (int i = 0; i < count; ++i) {
      for (const auto& outline : outlines[static_cast<std::size_t>(below(static_cast<int>(outlines.size())))]) {
        PlaneRing ring;
        for (const auto& [x, y] : outline) {
          // Integers are multiplied, so that parallel sides of upright letters stay parallel.
          ring.push_back({std::round(a) * (x + 9 * i) * 2 + std::round(b) * y * 2,
                          std::round(c) * (x + 9 * i) * 2 + std::round(d) * y * 2});
        }
        rings.push_back(ring);
      }
    }
    return rings;
  }

  /// Gaps of 1 to 8 of some million steps.
  std::vector<PlaneRing> nearly_touching() {
    const double gap = 1 + below(8);
    std::vector<PlaneRing> rings = {rectangle(0, 0, 4 * kUnit, 4 * kUnit)};
    const double x = std::round((1 + share()) * kUnit), y = std::round((1 + share()) * kUnit);
    const double width = std::round((0.3 + share()) * kUnit), height = std::round((0.3 + share()) * kUnit);
    rings.push_back(rectangle(x, y, width, height));
    rings.push_back(rectangle(x + width + gap, y + (below(2) == 0 ? 0 : below(1000)), 0.5 * kUnit, height));
    const double tip = x + std::round(share() * width);  // above a side
    rings.push_back({{tip, y + height + gap}, {tip + 0.3 * kUnit, 3.6 * kUnit}, {tip - 0.2 * kUnit, 3.7 * kUnit}});
    rings.push_back({{gap, gap}, {0.6 * kUnit, gap + below(5)}, {0.5 * kUnit, 0.5 * kUnit}});
    return rings;
  }

  /// Squares on a lattice with common sides, corners, and corners on sides.
  std::vector<PlaneRing> touching() {
    const int side = 6;
    std::vector<PlaneRing> rings = {rectangle(0, 0, side * kUnit, side * kUnit)};
    const int count = 2 + below(8);
    for (int k = 0; k < count; ++k) {
      const double x = below(2 * side - 1) / 2.0 * kUnit;
      rings.push_back(rectangle(x, below(2 * side - 1) / 2.0 * kUnit, kUnit / 2, kUnit / 2));
    }
    const double x =
        (1 + below(4)) * kUnit;  // a triangle outside with a corner on a side, and one that ends in a corner
    rings.push_back({{x + kUnit / 4, 6 * kUnit}, {x + kUnit, 7 * kUnit}, {x, 7 * kUnit}});
    rings.push_back({{6 * kUnit, 0}, {7 * kUnit, -kUnit}, {7 * kUnit, kUnit / 2}});
    return rings;
  }

  PlaneRing star() {
    PlaneRing ring;
    const int corners = 8 + below(40);
    for (int i = 0; i < corners; ++i) {
      const double radius = (0.3 + 0.7 * share()) * 4 * kUnit, a = 2 * kPi * i / corners;
      ring.push_back({radius * std::cos(a), radius * std::sin(a)});
    }
    return ring;
  }

  std::mt19937_64 random_;
};

}  // namespace

const char* seeded_family(std::uint64_t seed) {
  constexpr std::array<const char*, kSeededFamilies> kNames = {
      "holes", "combs", "spirals", "letters", "nearly touching", "touching parts", "stars"};
  return kNames[seed % kSeededFamilies];
}

std::vector<PlaneRing> seeded_rings(std::uint64_t seed) {
  std::vector<PlaneRing> rings = SeededRings(seed).make(seed % kSeededFamilies);
  for (PlaneRing& ring : rings) {
    for (PlanePoint& p : ring) p = {std::round(p[0]), std::round(p[1])};
  }
  return rings;
}

std::optional<SeededShape> seeded_shape(std::uint64_t seed) {
  std::vector<PlaneRing> rings = seeded_rings(seed);
  double longest = 0;
  for (const PlaneRing& ring : rings) {
    for (const PlanePoint& p : ring) longest = std::max({longest, std::fabs(p[0]), std::fabs(p[1])});
  }
  SeededShape result;
  result.scale = std::pow(10, static_cast<double>(seed / kSeededFamilies % 19) - 9) / longest;
  for (PlaneRing& ring : rings) {
    for (PlanePoint& p : ring) p = {result.scale * p[0], result.scale * p[1]};
  }
  const auto shape = prepare_shape(rings, FillRule::kEvenOdd, 1);
  if (!shape || shape.value().report.crossings > 0) return {};
  result.scaled = result.integral = shape.value();
  for (PlanePoint& p : result.integral.points) {
    for (double& x : p) x = std::round(x / result.scale);
  }
  return result;
}

}  // namespace medial_vk::test
