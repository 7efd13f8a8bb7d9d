#include "common/digest.h"

#include <fmt/format.h>

#include <bit>
#include <cstddef>

namespace medial_vk {
namespace {

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;
/// Any two points of the field: digits of the golden ratio and of pi.
constexpr std::array<std::uint64_t, 2> kPlaces = {0x1e3779b97f4a7c15, 0x043f6a8885a308d3};

/// Of numbers below 2^61, modulo 2^61 - 1, by halves of 32 bits: the product is h 2^64 + m 2^32 + l with h < 2^58 and
/// m < 2^62, and 2^61 counts as 1, so that 2^64 counts as 8, and the upper bits of m 2^32, from 2^61 on, as m / 2^29.
std::uint64_t product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kHalf = 0xffffffff, kBelow29 = (std::uint64_t{1} << 29) - 1;
  const std::uint64_t high = (a >> 32) * (b >> 32);
  const std::uint64_t middle = (a >> 32) * (b & kHalf) + (a & kHalf) * (b >> 32);
  const std::uint64_t low = (a & kHalf) * (b & kHalf);
  const std::uint64_t sum =
      8 * high + (middle >> 29) + ((middle & kBelow29) << 32) + (low >> 61) + (low & kPrime);  // below 2^63
  return sum % kPrime;
}

}  // namespace

/// Horner's rule.
void Digest::add(std::uint32_t word) {
  for (std::size_t i = 0; i < kPlaces.size(); ++i) values_[i] = (product(values_[i], kPlaces[i]) + word) % kPrime;
}

void Digest::add(std::uint64_t number) {
  add(static_cast<std::uint32_t>(number));
  add(static_cast<std::uint32_t>(number >> 32));
}

void Digest::add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

void Digest::add(const Mesh& mesh) {
  add(static_cast<std::uint64_t>(mesh.vertices.size()));
  add(static_cast<std::uint64_t>(mesh.triangles.size()));
  for (const Point& vertex : mesh.vertices) {
    for (const double coordinate : vertex) add(coordinate);
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) add(corner);
  }
}

std::string Digest::text() const { return fmt::format("{:016x}{:016x}", values_[0], values_[1]); }

}  // namespace medial_vk
