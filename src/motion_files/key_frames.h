// The keys of an animated property, and its values between them (glTF 2.0, 3.11 and Appendix C).
#pragma once

#include <cstdint>

#include "motion_files/gltf_accessors.h"

namespace medial_vk {

enum class Interpolation : std::uint8_t {
  kStep,    ///< The value of the key before.
  kLinear,  ///< Along the line; of rotations along the great circle, the shorter way.
  kCubic,   ///< A Hermite spline: each key has a tangent before it, its value, and a tangent behind it.
};

/// A property of `width` numbers, such as 3 of a translation.
struct KeyFrames {
  GltfArray times;   ///< At least one, and none is less than the one before.
  GltfArray values;  ///< By key `width` numbers; kCubic: three times as many, whatever the width of the array.
  std::uint64_t width = 0;
  Interpolation interpolation = Interpolation::kLinear;
  bool is_rotation = false;  ///< A quaternion, x, y, z, w, whose length is made 1.

  double first_time() const { return *times[0]; }
  double last_time() const { return *times[times.count - 1]; }
};

/// The values at a time: `width` numbers. Before the first key they are those of that key, behind the last those of it.
void evaluate(const KeyFrames& keys, double time, double* values);

/// False if the property has the same value at all times.
bool changes(const KeyFrames& keys);

}  // namespace medial_vk
