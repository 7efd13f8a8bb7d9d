// Rounding to single precision where the rest of a proof refers to the rounded number.
#pragma once

namespace medial_vk {

/// The float nearest to `x`. It goes through memory: gcc 12.2 with -O2 and -O3 takes double -> float -> double for
/// nothing where it computes two of them at a time (-ftree-slp-vectorize), so that numbers stay unrounded.
inline double rounded_to_float(double x) {
  const volatile float rounded = static_cast<float>(x);
  return double{rounded};
}

}  // namespace medial_vk
