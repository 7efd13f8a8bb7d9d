// The smallest program that uses the library: certified medial spheres of a box. README.md shows the part between the
// marks, and tests/package builds it against an installed tree.
#include <iostream>
#include <utility>

// [README]
#include <medial_vk/medial_vk.h>

// Writes one line per medial sphere of `mesh`: centre and radius, in the units of the mesh. Every ball is proved, in
// double precision, to lie inside the solid and to touch its surface.
medial_vk::Status print_medial_spheres(medial_vk::Mesh mesh, medial_vk::Context& context) {
  auto prepared = medial_vk::prepare_mesh(std::move(mesh));  // cleaned, oriented, inspected
  if (!prepared) return prepared.error();
  auto indexed = medial_vk::IndexedMesh::build(std::move(prepared).value());
  if (!indexed) return indexed.error();
  medial_vk::AnalysisOptions options;
  options.extraction.resolution = 40;  // voxels along the longest side
  const auto analysis = medial_vk::analyse(indexed.value(), options, context);
  if (!analysis) return analysis.error();
  for (const medial_vk::MedialSphere& sphere : analysis.value().spheres) {
    std::cout << sphere.centre[0] << ' ' << sphere.centre[1] << ' ' << sphere.centre[2] << ' ' << sphere.radius << '\n';
  }
  return {};
}
// [README]

int main() {
  auto context = medial_vk::Context::create();  // the best device, or the one that MEDIAL_VK_DEVICE names
  if (!context) {
    std::cerr << context.error().message << '\n';
    return 4;
  }
  // A box of 3 x 2 x 1. Triangles are counter-clockwise seen from outside.
  medial_vk::Mesh box;
  box.vertices = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};
  box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                   {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const medial_vk::Status status = print_medial_spheres(std::move(box), context.value());
  if (!status) std::cerr << status.error().message << '\n';
  return status ? 0 : 1;
}
