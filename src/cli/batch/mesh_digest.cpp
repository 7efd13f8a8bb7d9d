#include "cli/batch/mesh_digest.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>

namespace medial_vk::cli {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;
/// Any two points of the field: digits of the golden ratio and of pi.
constexpr std::array<std::uint64_t, 2> kPlaces = {0x1e3779b97f4a7c15, 0x043f6a8885a308d3};

class Polynomial {
 public:
  /// Horner's rule.
  void add(std::uint32_t word) {
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
      values_[i] = static_cast<std::uint64_t>((static_cast<Wide>(values_[i]) * kPlaces[i] + word) % kPrime);
    }
  }
  void add(std::uint64_t number) {
    add(static_cast<std::uint32_t>(number));
    add(static_cast<std::uint32_t>(number >> 32));
  }
  std::string text() const { return fmt::format("{:016x}{:016x}", values_[0], values_[1]); }

 private:
  std::array<std::uint64_t, 2> values_ = {1, 1};
};

}  // namespace

std::string mesh_digest(const Mesh& mesh) {
  Polynomial out;
  for (const std::uint64_t count :
       {static_cast<std::uint64_t>(mesh.vertices.size()), static_cast<std::uint64_t>(mesh.triangles.size()),
        mesh.short_polygons, mesh.fallback_polygons}) {
    out.add(count);
  }
  for (const Point& vertex : mesh.vertices) {
    for (const double coordinate : vertex) out.add(std::bit_cast<std::uint64_t>(coordinate));
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) out.add(corner);
  }
  return out.text();
}

}  // namespace medial_vk::cli
