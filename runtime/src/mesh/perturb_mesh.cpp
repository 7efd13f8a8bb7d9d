// Seeded noise on the vertices, against degenerate positions (Stolpner 2011, 2.4.4).
#include <cmath>

#include "medial_vk/prepare.h"

namespace medial_vk {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine, unlike the distributions of <random>.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [-1, 1).
  double symmetric() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

void perturb_mesh(Mesh& mesh, double amplitude, std::uint64_t seed) {
  if (mesh.vertices.empty()) return;
  Point lower = mesh.vertices[0], upper = mesh.vertices[0];
  for (const Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, upper[k] - lower[k]);
  SplitMix random(seed);
  for (Point& p : mesh.vertices) {
    Point offset;  // uniform in the unit ball, by rejection
    do {
      for (double& x : offset) x = random.symmetric();
    } while (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2] > 1);
    for (int k = 0; k < 3; ++k) p[k] += amplitude * longest * offset[k];
  }
}

}  // namespace medial_vk
