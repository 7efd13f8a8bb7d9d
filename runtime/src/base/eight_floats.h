// Eight floats at a time, by the vector types of gcc and clang: one instruction where the processor has one for eight
// floats, and several elsewhere.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

// Functions that return such vectors are inlined, so the calls on which compilers differ do not exist.
#pragma GCC diagnostic ignored "-Wpsabi"

// Inlined into a function for processors with AVX2, a function is compiled for these.
#define MEDIAL_VK_INLINE inline __attribute__((always_inline))

namespace medial_vk {

using EightFloats = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));  // of a comparison: -1 for true, 0 for false

MEDIAL_VK_INLINE EightFloats load(const std::array<float, 8>& values) {
  EightFloats floats;
  std::memcpy(&floats, values.data(), sizeof floats);
  return floats;
}

MEDIAL_VK_INLINE std::array<float, 8> stored(const EightFloats& floats) {
  std::array<float, 8> values;
  std::memcpy(values.data(), &floats, sizeof floats);
  return values;
}

MEDIAL_VK_INLINE EightFloats square_root(const EightFloats& floats) {
  std::array<float, 8> values = stored(floats);
  for (float& value : values) value = std::sqrt(value);
  return load(values);
}

MEDIAL_VK_INLINE EightFloats select(const EightInts& where, const EightFloats& yes, const EightFloats& no) {
  return reinterpret_cast<EightFloats>((where & reinterpret_cast<EightInts>(yes)) |
                                       (~where & reinterpret_cast<EightInts>(no)));
}

MEDIAL_VK_INLINE EightFloats greater(const EightFloats& a, const EightFloats& b) { return select(a > b, a, b); }
MEDIAL_VK_INLINE EightFloats lesser(const EightFloats& a, const EightFloats& b) { return select(a < b, a, b); }

MEDIAL_VK_INLINE EightInts greater(const EightInts& a, const EightInts& b) {
  const EightInts is_greater = a > b;
  return (is_greater & a) | (~is_greater & b);
}

MEDIAL_VK_INLINE EightInts lesser(const EightInts& a, const EightInts& b) {
  const EightInts is_less = a < b;
  return (is_less & a) | (~is_less & b);
}

MEDIAL_VK_INLINE EightFloats absolute(const EightFloats& floats) {
  return reinterpret_cast<EightFloats>(reinterpret_cast<EightInts>(floats) & std::int32_t{0x7fffffff});
}

MEDIAL_VK_INLINE float greatest_of(const EightFloats& floats) {
  const std::array<float, 8> values = stored(floats);
  float greatest = values[0];
  for (const float value : values) greatest = value > greatest ? value : greatest;
  return greatest;
}

MEDIAL_VK_INLINE std::int32_t greatest_of(const EightInts& ints) {
  EightInts all = greater(ints, __builtin_shufflevector(ints, ints, 4, 5, 6, 7, 0, 1, 2, 3));
  all = greater(all, __builtin_shufflevector(all, all, 2, 3, 0, 1, 6, 7, 4, 5));
  all = greater(all, __builtin_shufflevector(all, all, 1, 0, 3, 2, 5, 4, 7, 6));
  return all[0];
}

MEDIAL_VK_INLINE std::int32_t least_of(const EightInts& ints) {
  EightInts all = lesser(ints, __builtin_shufflevector(ints, ints, 4, 5, 6, 7, 0, 1, 2, 3));
  all = lesser(all, __builtin_shufflevector(all, all, 2, 3, 0, 1, 6, 7, 4, 5));
  all = lesser(all, __builtin_shufflevector(all, all, 1, 0, 3, 2, 5, 4, 7, 6));
  return all[0];
}

/// Bits 8 k to 8 k + 7 are the lowest eight of element k, which has no others.
MEDIAL_VK_INLINE std::uint64_t bytes_of(const EightInts& bits) {
  using EightBytes = std::uint8_t __attribute__((vector_size(8)));
  const EightBytes bytes = __builtin_convertvector(bits, EightBytes);
  std::uint64_t all;
  std::memcpy(&all, &bytes, sizeof all);
  if constexpr (std::endian::native == std::endian::big) all = __builtin_bswap64(all);
  return all;
}

/// Bit k is set if element k is true.
MEDIAL_VK_INLINE std::uint32_t bits_of(const EightInts& where) {
#if defined(__SSE__) && defined(__GNUC__)
  using FourFloats = float __attribute__((vector_size(16)));
  std::array<FourFloats, 2> halves;
  std::memcpy(halves.data(), &where, sizeof where);
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(halves[0]) | __builtin_ia32_movmskps(halves[1]) << 4);
#else
  const EightInts bits = where & EightInts{1, 2, 4, 8, 16, 32, 64, 128};
  std::array<std::uint64_t, 4> pairs;
  std::memcpy(pairs.data(), &bits, sizeof bits);
  const std::uint64_t all = (pairs[0] | pairs[1]) | (pairs[2] | pairs[3]);
  return static_cast<std::uint32_t>(all | all >> 32);
#endif
}

/// Calls work() compiled for processors with AVX2 where there is one. `Work` is a function object whose call is
/// inlined.
#if defined(__x86_64__) && defined(__GNUC__)
template <class Work>
__attribute__((target("avx2"))) auto run_with_avx2(Work& work) {
  return work();
}
#endif

template <class Work>
auto run_on_this_processor(Work& work) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2")) return run_with_avx2(work);
#endif
  return work();
}

}  // namespace medial_vk
