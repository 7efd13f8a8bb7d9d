#include "support/plane_axis/ring_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace medial_vk::test {
namespace {

constexpr double kPi = std::numbers::pi;

class RingMaker {
 public:
  explicit RingMaker(std::uint64_t seed) : random_(seed) {}

  std::vector<PlaneRing> make(std::uint64_t kind) {
    switch (kind % 7) {
      case 0:
        return {crossing()};
      case 1:
        return {star()};
      case 2:
        return overlapping();
      case 3:
        return lattice();
      case 4:
        return touching_holes();
      case 5:
        return {spiral()};
      default:
        return {comb()};
    }
  }

  double share() { return std::uniform_real_distribution<>(0, 1)(random_); }
  std::uint64_t below(std::uint64_t n) { return random_() % n; }

  static PlaneRing regular(int corners, PlanePoint centre, double radius, double turn) {
    PlaneRing ring;
    for (int i = 0; i < corners; ++i) {
      const double a = turn + 2 * kPi * i / corners;
      ring.push_back({centre[0] + radius * std::cos(a), centre[1] + radius * std::sin(a)});
    }
    return ring;
  }

 private:
  PlanePoint anywhere() {
    const double x = 2 * share() - 1;
    return {x, 2 * share() - 1};
  }

  PlaneRing crossing() {
    PlaneRing ring;
    for (int i = 0; i < 11; ++i) ring.push_back(anywhere());
    return ring;
  }

  PlaneRing star() {
    PlaneRing ring;
    for (int i = 0; i < 24; ++i) {
      const double r = 0.3 + 0.7 * share(), a = 2 * kPi * i / 24;
      ring.push_back({r * std::cos(a), r * std::sin(a)});
    }
    return ring;
  }

  std::vector<PlaneRing> overlapping() {
    std::vector<PlaneRing> rings;
    for (int k = 0; k < 5; ++k) {
      const int corners = 3 + static_cast<int>(below(6));
      const double radius = 0.05 + 0.5 * share();
      rings.push_back(regular(corners, anywhere(), radius, 0));
    }
    return rings;
  }

  std::vector<PlaneRing> lattice() {
    std::vector<PlaneRing> rings = {{{0, 0}, {1, 0}, {1, 1}}};  // something is enclosed
    for (int k = 0; k < 4; ++k) {
      PlaneRing ring;
      for (std::uint64_t i = 0, corners = 3 + below(5); i < corners; ++i) {
        const auto x = static_cast<double>(below(6));
        ring.push_back({x, static_cast<double>(below(6))});
      }
      rings.push_back(ring);
    }
    return rings;
  }

  std::vector<PlaneRing> touching_holes() {
    std::vector<PlaneRing> rings = {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}};
    for (int k = 0; k < 6; ++k) {
      const auto x = static_cast<double>(below(6)), y = static_cast<double>(below(6));
      rings.push_back({{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}});
    }
    return rings;
  }

  PlaneRing spiral() {
    PlaneRing ring;
    const double turn = 6 * share();
    const auto point = [&](int i, double width) {
      const double a = turn + 0.25 * i, r = 0.1 + width + 0.02 * i;
      return PlanePoint{r * std::cos(a), r * std::sin(a)};
    };
    for (int i = 0; i < 40; ++i) ring.push_back(point(i, 0));
    for (int i = 39; i >= 0; --i) ring.push_back(point(i, 0.03));
    return ring;
  }

  PlaneRing comb() {
    PlaneRing ring;
    const double turn = share();
    const auto add = [&](double x, double y) {
      ring.push_back({x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn)});
    };
    for (int i = 0; i < 12; ++i) {
      add(i, 0);
      add(i, 5);
      add(i + 0.3, 5);
      add(i + 0.3, 0);
    }
    add(11.3, -1);
    add(0, -1);
    return ring;
  }

  std::mt19937_64 random_;
};

}  // namespace

std::vector<PlaneRing> rings_of_seed(std::uint64_t seed, double scale, PlanePoint shift) {
  std::vector<PlaneRing> rings = RingMaker(seed).make(seed);
  for (PlaneRing& ring : rings) {
    for (PlanePoint& p : ring) p = {shift[0] + scale * p[0], shift[1] + scale * p[1]};
  }
  return rings;
}

std::vector<PlaneRing> square_with_holes(int count, std::uint64_t seed) {
  RingMaker maker(seed);
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<PlaneRing> rings = {{{0, 0}, {1.0 * side, 0}, {1.0 * side, 1.0 * side}, {0, 1.0 * side}}};
  for (int i = 0; i < count; ++i) {
    const double x = i % side + 0.45 + 0.1 * maker.share(), y = i / side + 0.45 + 0.1 * maker.share();
    const double turn = 6 * maker.share();
    rings.push_back(RingMaker::regular(4, {x, y}, 0.3, turn));
  }
  return rings;
}

PreparedShape prepared(const std::vector<PlaneRing>& rings, FillRule rule) {
  Result<PreparedShape> shape = prepare_shape(rings, rule, 1);
  EXPECT_TRUE(shape.ok()) << (shape.ok() ? "" : shape.error().message);
  return shape.ok() ? std::move(shape.value()) : PreparedShape();
}

}  // namespace medial_vk::test
