#include "output/motion_page/motion_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace medial_vk::page {
namespace {

constexpr double kPlaces = 65535;

/// The bytes of a difference (FrameCoder).
void append_difference(std::vector<std::uint8_t>& bytes, std::uint16_t difference) {
  const auto value = static_cast<std::int16_t>(difference);
  // 0, 1, 2, 3 ... for 0, -1, 1, -2 ...
  unsigned rest = value < 0 ? 2u * static_cast<unsigned>(-(value + 1)) + 1u : 2u * static_cast<unsigned>(value);
  for (; rest >= 128; rest >>= 7) bytes.push_back(static_cast<std::uint8_t>((rest & 127u) | 128u));
  bytes.push_back(static_cast<std::uint8_t>(rest));
}

/// Centre in the units of the page, and a bound of how far it moves, in them: with u = 2^-53, x = fl(fl(c - o) / s)
/// differs from (c - o) / s by at most 2.1 u |x|, and the difference of x and the nearest float is exact (Sterbenz's
/// lemma). So the centre moves by at most the sum over its coordinates of this difference and 2.1 u |x|. The terms with
/// 2^-50 = 8 u are larger than these errors and those of the sums, of the quotient r / s and of the two operations on
/// it, and 1e-300 than what an underflow can add.
struct PlacedCentre {
  std::array<float, 3> centre = {};
  double moved = 1e-300;
};
constexpr double kPlaceRounding = 0x1p-50;

PlacedCentre placed_centre(const Ball& ball, const MotionBox& box) {
  PlacedCentre placed;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = (ball.centre[k] - box.origin[k]) / box.scale;
    placed.centre[k] = static_cast<float>(x);
    placed.moved += std::fabs(double{placed.centre[k]} - x) + kPlaceRounding * std::fabs(x);
  }
  return placed;
}

float rounded_down(double x) {
  const auto rounded = static_cast<float>(x);
  return double{rounded} > x ? std::nextafter(rounded, 0.0f) : rounded;
}

float rounded_up(double x) {
  const auto rounded = static_cast<float>(x);
  return double{rounded} < x ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace

MotionBox box_of(std::span<const FollowedFrame> frames) {
  MotionBox box;
  bool any = false;
  for (const FollowedFrame& frame : frames) {
    for (const std::array<float, 3>& vertex : frame.vertices) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.lower[k] = any ? std::min<double>(box.lower[k], vertex[k]) : vertex[k];
        box.upper[k] = any ? std::max<double>(box.upper[k], vertex[k]) : vertex[k];
      }
      any = true;
    }
  }
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    box.origin[k] = box.lower[k] + (box.upper[k] - box.lower[k]) / 2;
    longest = std::max(longest, box.upper[k] - box.lower[k]);
  }
  if (longest > 0) box.scale = longest;
  return box;
}

std::vector<std::uint16_t> places_in(const MotionBox& box, std::span<const std::array<float, 3>> vertices) {
  std::vector<std::uint16_t> places;
  places.reserve(3 * vertices.size());
  for (const std::array<float, 3>& vertex : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = box.upper[k] - box.lower[k];
      const double place = side > 0 ? (vertex[k] - box.lower[k]) / side * kPlaces : 0;
      places.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(place, 0.0, kPlaces))));
    }
  }
  return places;
}

std::vector<std::uint8_t> FrameCoder::predicted(std::span<const std::uint16_t> numbers, std::uint8_t from) const {
  std::vector<std::uint8_t> bytes = {from};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const unsigned prediction = from == 1 ? before_[i] : 2u * before_[i] - before_that_[i];
    append_difference(bytes, static_cast<std::uint16_t>(numbers[i] - prediction));
  }
  return bytes;
}

std::vector<std::uint8_t> FrameCoder::next(std::vector<std::uint16_t> numbers) {
  std::vector<std::uint8_t> shortest = {0};
  for (const std::uint16_t number : numbers) {
    shortest.push_back(static_cast<std::uint8_t>(number & 255u));
    shortest.push_back(static_cast<std::uint8_t>(number >> 8));
  }
  const auto consider = [&](std::vector<std::uint8_t> bytes) {
    if (bytes.size() < shortest.size()) shortest = std::move(bytes);
  };
  if (!before_.empty()) consider(predicted(numbers, 1));
  if (!before_that_.empty()) consider(predicted(numbers, 2));
  before_that_ = std::move(before_);
  before_ = std::move(numbers);
  return shortest;
}

std::array<float, 4> ball_inside(const Ball& ball, const MotionBox& box) {
  const auto [centre, moved] = placed_centre(ball, box);
  const double radius = ball.radius / box.scale * (1 - kPlaceRounding) - moved;
  return {centre[0], centre[1], centre[2], radius > 0 ? rounded_down(radius) : 0.0f};
}

std::array<float, 4> ball_around(const Ball& ball, const MotionBox& box) {
  const auto [centre, moved] = placed_centre(ball, box);
  const double radius = (ball.radius / box.scale + moved) * (1 + kPlaceRounding);
  return {centre[0], centre[1], centre[2], ball.radius > 0 ? rounded_up(radius) : 0.0f};
}

}  // namespace medial_vk::page
