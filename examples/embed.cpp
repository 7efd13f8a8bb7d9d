// The smallest program that uses the library: medial spheres of a box. README.md shows the part between the marks, and
// tests/package builds it against an installed tree.
#include <iostream>
#include <vector>

// [README]
#include <medial_vk/context.h>
#include <medial_vk/extraction.h>

// One line per medial sphere of `mesh`: centre and radius, in the units of the mesh.
int print_medial_spheres(const medial_vk::MeshView& mesh) {
  auto context = medial_vk::Context::create();  // the best device, or the one that MEDIAL_VK_DEVICE names
  if (!context) {
    std::cerr << context.error().message << '\n';
    return static_cast<int>(context.error().code);
  }
  medial_vk::ExtractionOptions parameters;
  parameters.resolution = 40;  // voxels along the longest side
  const auto extraction = medial_vk::extract_medial_spheres(context.value(), mesh, parameters);
  if (!extraction) {
    std::cerr << extraction.error().message << '\n';
    return static_cast<int>(extraction.error().code);
  }
  for (const medial_vk::MedialSphere& sphere : extraction.value().spheres) {
    std::cout << sphere.centre[0] << ' ' << sphere.centre[1] << ' ' << sphere.centre[2] << ' ' << sphere.radius << '\n';
  }
  return 0;
}
// [README]

int main() {
  // A box of 3 x 2 x 1. Triangles are counter-clockwise seen from outside.
  const std::vector<medial_vk::Point> vertices = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0},
                                                  {0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};
  const std::vector<medial_vk::Triangle> triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  // All normals may be trusted: the box is closed, without self-intersections, and rightly oriented.
  const std::vector<std::uint8_t> flags(triangles.size(), medial_vk::kTrustedNormal);
  return print_medial_spheres({.vertices = vertices, .triangles = triangles, .flags = flags, .closed = true});
}
