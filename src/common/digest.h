// A short text in the place of long data.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// The values of a polynomial at two points of the field of 2^61 - 1 elements. Its coefficients are a one and the n
/// words of 32 bits that were added, so two different sequences of at most n words have equal values at n points at
/// most each, hence for a share of at most (n / 2^61)^2 of all pairs of points: 2e-19 for 10^9 words. It does not
/// withstand someone who looks for such a sequence, and knows where one number ends only if the caller adds what tells
/// that.
class Digest {
 public:
  void add(std::uint32_t word);
  /// Two words.
  void add(std::uint64_t number);
  /// Its bits: -0 is not 0.
  void add(double number);
  /// The numbers of vertices and of triangles, then both lists.
  void add(const Mesh& mesh);
  /// 32 hexadecimal digits.
  std::string text() const;

 private:
  std::array<std::uint64_t, 2> values_ = {1, 1};
};

}  // namespace medial_vk
