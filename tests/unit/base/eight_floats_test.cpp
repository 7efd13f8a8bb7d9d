// Operations on eight numbers at a time, against loops.
#include "base/eight_floats.h"

#include <gtest/gtest.h>

#include <limits>

namespace medial_vk {
namespace {

TEST(EightFloats, BitsAreThoseOfEveryMask) {
  for (std::uint32_t mask = 0; mask < 256; ++mask) {
    EightInts where{};
    for (std::uint32_t k = 0; k < 8; ++k) where[k] = (mask >> k & 1) != 0 ? -1 : 0;
    EXPECT_EQ(bits_of(where), mask);
  }
}

TEST(EightFloats, BytesAreThoseOfEachElement) {
  const EightInts bits = {1, 2, 4, 8, 16, 32, 64, 128};
  EXPECT_EQ(bytes_of(bits), 0x8040201008040201u);
}

TEST(EightFloats, GreatestIntegerIsFoundInEveryPlace) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  for (std::uint32_t place = 0; place < 8; ++place) {
    for (const std::int32_t greatest : {kLeast + 9, 0, 7, std::numeric_limits<std::int32_t>::max()}) {
      EightInts ints{};
      for (std::uint32_t k = 0; k < 8; ++k) ints[k] = kLeast + static_cast<std::int32_t>(k);
      ints[place] = greatest;
      EXPECT_EQ(greatest_of(ints), greatest) << place;
    }
  }
}

TEST(EightFloats, LeastIntegerIsFoundInEveryPlace) {
  constexpr std::int32_t kGreatest = std::numeric_limits<std::int32_t>::max();
  for (std::uint32_t place = 0; place < 8; ++place) {
    for (const std::int32_t least : {kGreatest - 9, 0, -7, std::numeric_limits<std::int32_t>::min()}) {
      EightInts ints{};
      for (std::uint32_t k = 0; k < 8; ++k) ints[k] = kGreatest - static_cast<std::int32_t>(k);
      ints[place] = least;
      EXPECT_EQ(least_of(ints), least) << place;
    }
  }
}

}  // namespace
}  // namespace medial_vk
