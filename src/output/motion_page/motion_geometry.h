// Meshes and balls of a motion as the page stores them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "output/motion_files/motion_record.h"

namespace medial_vk::page {

/// The box around all vertices of a motion, and the units of the page: the box lies around 0, and its longest side
/// is 1.
struct MotionBox {
  Point lower = {0, 0, 0};
  Point upper = {0, 0, 0};
  Point origin = {0, 0, 0};  ///< Its middle.
  double scale = 1;          ///< Its longest side; 1 if that is 0.
};

MotionBox box_of(std::span<const FollowedFrame> frames);

/// Each coordinate as one of 65,536 places in the box.
std::vector<std::uint16_t> places_in(const MotionBox& box, std::span<const std::array<float, 3>> vertices);

/// Numbers of 16 bits, frame after frame, in fewer bytes: a frame begins with the number of frames (0, 1 or 2) from
/// which each of its numbers is predicted, as 0, as the number before, or as twice that less the one before it. Without
/// a prediction each number has two bytes, the lower one first. Otherwise the difference from the prediction, modulo
/// 2^16, is -32768 to 32767; it is stored as 0, 1, 2, 3 ... for 0, -1, 1, -2 ..., in groups of seven bits, the lowest
/// first; the eighth bit of a byte is set if another group follows. Of the three ways the shortest is taken, so that no
/// frame needs more than a byte in addition to its numbers.
class FrameCoder {
 public:
  /// The bytes of the next frame. All frames have the same number of numbers.
  std::vector<std::uint8_t> next(std::vector<std::uint16_t> numbers);

 private:
  std::vector<std::uint8_t> predicted(std::span<const std::uint16_t> numbers, std::uint8_t from) const;

  std::vector<std::uint16_t> before_, before_that_;
};

/// Centre and radius in the units of the page. Computed exactly from these floats, the ball lies inside the given one;
/// radius 0 if that cannot be had.
std::array<float, 4> ball_inside(const Ball& ball, const MotionBox& box);

/// The same around the given ball, of a cover; of radius 0 if that has radius 0.
std::array<float, 4> ball_around(const Ball& ball, const MotionBox& box);

}  // namespace medial_vk::page
