#include "support/plane_thesis/random_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace medial_vk::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

PlanePoint polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

std::vector<double> sorted_angles(SplitMix& random, unsigned count) {
  std::vector<double> angles;
  for (unsigned i = 0; i < count; ++i) angles.push_back(uniform(random, 0, kTurn));
  std::ranges::sort(angles);
  return angles;
}

PlaneRing convex(SplitMix& random) {
  PlaneRing ring;
  const double flat = uniform(random, 0.2, 1);
  for (const double a : sorted_angles(random, 5 + choice(random, 30)))
    ring.push_back({std::cos(a), flat * std::sin(a)});
  return ring;
}

PlaneRing star(SplitMix& random) {
  PlaneRing ring;
  const double least = uniform(random, 0.1, 0.9);
  for (const double a : sorted_angles(random, 8 + choice(random, 50)))
    ring.push_back(polar(uniform(random, least, 1), a));
  return ring;
}

PlaneRing comb(SplitMix& random) {
  const unsigned teeth = 2 + choice(random, 10);
  PlaneRing ring = {{1, 0}, {1, uniform(random, 0.1, 0.4)}};
  for (unsigned i = teeth; i > 0; --i) {
    const double right = 2.0 * i / teeth - 1, width = 2.0 / teeth;
    const double gap = width * uniform(random, 0.05, 0.9), base = uniform(random, 0.1, 0.4);
    const double height = uniform(random, 0.5, 1);
    ring.push_back({right, height});
    ring.push_back({right - width + gap, height});
    ring.push_back({right - width + gap, base});
    ring.push_back({right - width, base});
  }
  ring.push_back({-1, 0});
  return ring;
}

PlaneRing spikes(SplitMix& random) {
  PlaneRing ring;
  const unsigned count = 4 + choice(random, 16);
  const double thickness = uniform(random, 1e-4, 0.05);
  for (const double a : sorted_angles(random, count)) {
    ring.push_back(polar(1, a - thickness));
    ring.push_back(polar(uniform(random, 0.05, 0.95), a));
    ring.push_back(polar(1, a + thickness));
  }
  return ring;
}

std::vector<PlaneRing> with_holes(SplitMix& random, double least, double most) {
  std::vector<PlaneRing> rings = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const unsigned holes = 2 + choice(random, 12);
  const bool is_close = choice(random, 2) == 0;  // most of them on one line nearly
  for (unsigned h = 0; h < holes; ++h) {
    const PlanePoint at = {uniform(random, -0.8, 0.8),
                           is_close ? uniform(random, -0.05, 0.05) : uniform(random, -0.8, 0.8)};
    const double size = least * std::pow(most / least, uniform(random, 0, 1));
    PlaneRing hole;
    for (const double a : sorted_angles(random, 3 + choice(random, 4))) {
      const PlanePoint p = polar(size, a);
      hole.push_back({at[0] + p[0], at[1] + p[1]});
    }
    rings.push_back(hole);
  }
  return rings;
}

/// The axis of the three has a point towards the lonely speck, which reaches into circles that it touches from there.
std::vector<PlaneRing> triad(SplitMix& random) {
  std::vector<PlaneRing> rings = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  const double apart = std::exp2(uniform(random, -8, 0.5));
  for (const double a : {-kTurn / 4, kTurn / 4 - apart, kTurn / 4 + apart}) {
    const PlanePoint at = polar(uniform(random, 0.999, 1.001), a);
    PlaneRing speck;
    for (const double b : sorted_angles(random, 3)) {
      const PlanePoint p = polar(1e-7, b);
      speck.push_back({at[0] + p[0], at[1] + p[1]});
    }
    rings.push_back(speck);
  }
  return rings;
}

}  // namespace

std::string family_name(unsigned family) {
  const std::array<const char*, kShapeFamilies> names = {"convex", "star",   "comb",  "holes",
                                                         "spikes", "specks", "triads"};
  return names.at(family);
}

std::vector<PlaneRing> random_shape(unsigned family, std::uint64_t seed) {
  SplitMix random(seed * kShapeFamilies + family);
  for (int i = 0; i < 4; ++i) random.symmetric();
  std::vector<PlaneRing> rings;
  switch (family) {
    case 0:
      rings = {convex(random)};
      break;
    case 1:
      rings = {star(random)};
      break;
    case 2:
      rings = {comb(random)};
      break;
    case 3:
      rings = with_holes(random, 0.02, 0.3);
      break;
    case 4:
      rings = {spikes(random)};
      break;
    case 5:
      rings = with_holes(random, 1e-6, 1e-3);
      break;
    default:
      rings = triad(random);
  }
  const double turn = uniform(random, 0, kTurn), c = std::cos(turn), s = std::sin(turn);
  for (PlaneRing& ring : rings) {
    for (PlanePoint& p : ring) p = {c * p[0] - s * p[1], s * p[0] + c * p[1]};
  }
  return rings;
}

}  // namespace medial_vk::test
