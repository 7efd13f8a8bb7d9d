#include "sphere_fits/steps/boundary_samples.h"

#include <cmath>
#include <cstdint>

#include "base/point_ops.h"

namespace medial_vk {

std::vector<BoundarySample> sample_boundary(const Mesh& mesh, std::size_t count) {
  std::vector<double> areas;
  std::vector<Point> inward(mesh.triangles.size()), at_corner(mesh.vertices.size());
  double total = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& t = mesh.triangles[k];
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Point across = cross(c - a, b - a);
    const double twice = length(across);
    if (twice > 0) inward[k] = (1 / twice) * across;
    for (const std::uint32_t v : t) at_corner[v] = at_corner[v] + inward[k];
    areas.push_back(0.5 * twice);
    total += areas.back();
  }
  std::vector<BoundarySample> samples;
  // For very fine meshes a part of the corners suffices.
  const std::size_t stride = mesh.vertices.size() / count + 1;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += stride) {
    const double size = length(at_corner[v]);
    samples.push_back({mesh.vertices[v], size > 0 ? (1 / size) * at_corner[v] : Point{}});
  }
  double due = 0, s = 0.5, t = 0.5;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& triangle = mesh.triangles[k];
    const Point& a = mesh.vertices[triangle[0]];
    const Point ab = mesh.vertices[triangle[1]] - a, ac = mesh.vertices[triangle[2]] - a;
    due += static_cast<double>(count) * areas[k] / total;
    while (due >= 1) {
      --due;
      s = std::fmod(s + 0.7548776662466927, 1);
      t = std::fmod(t + 0.5698402909980532, 1);
      const bool folded = s + t > 1;
      samples.push_back({a + (folded ? 1 - s : s) * ab + (folded ? 1 - t : t) * ac, inward[k]});
    }
  }
  return samples;
}

}  // namespace medial_vk
