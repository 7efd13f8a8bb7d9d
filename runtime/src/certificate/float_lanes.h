// Vectors of four floats, and of four points in space, by an extension of GCC and Clang.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace medial_vk {

using Floats = float __attribute__((vector_size(16)));
using Vectors = std::array<Floats, 3>;

constexpr Floats kZero = {}, kOne = {1, 1, 1, 1}, kTiny = {1e-30f, 1e-30f, 1e-30f, 1e-30f};

/// From values[first] on.
inline Floats four(const std::vector<float>& values, std::size_t first) {
  Floats out;
  std::memcpy(&out, values.data() + first, sizeof(out));
  return out;
}

inline Floats min(Floats a, Floats b) { return b < a ? b : a; }
inline Floats max(Floats a, Floats b) { return a < b ? b : a; }
inline Floats least(Floats a, Floats b, Floats c) { return min(min(a, b), c); }

inline Vectors operator+(const Vectors& a, const Vectors& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vectors operator-(const Vectors& a, const Vectors& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vectors operator*(Floats t, const Vectors& a) { return {t * a[0], t * a[1], t * a[2]}; }
inline Floats dot(const Vectors& a, const Vectors& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vectors cross(const Vectors& a, const Vectors& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Selection by the result of a comparison: a in lanes where it is true, b elsewhere.
Vectors choose(const auto& is_so, const Vectors& a, const Vectors& b) {
  return {is_so ? a[0] : b[0], is_so ? a[1] : b[1], is_so ? a[2] : b[2]};
}
inline Vectors shorter(const Vectors& a, const Vectors& b) { return choose(dot(a, a) < dot(b, b), a, b); }

/// A bit for each lane where it is true.
unsigned bits(const auto& is_so) {
  return static_cast<unsigned>((is_so[0] & 1) | (is_so[1] & 2) | (is_so[2] & 4) | (is_so[3] & 8));
}

}  // namespace medial_vk
