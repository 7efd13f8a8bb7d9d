// Medial spheres of boundaries that are no meshes: any_boundary torus|helix|rounded-box [RESOLUTION]
// Writes a line for each sphere, centre and radius, and a summary to the error stream.
#include <medial_vk/any_boundary.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

#include "boundaries.h"

namespace {

int usage() {
  std::cerr << "any_boundary torus|helix|rounded-box [RESOLUTION]\n"
               "Writes centre and radius of the medial spheres. RESOLUTION: 4 to 200, 24 by default\n";
  return 2;
}

void summarise(const medial_vk::BoundaryExtraction& result) {
  const medial_vk::Extraction& extraction = result.extraction;
  const auto farthest = std::max_element(result.axis_distance.begin(), result.axis_distance.end());
  std::cerr << extraction.spheres.size() << " spheres, each within "
            << (result.axis_distance.empty() ? 0.0 : *farthest / extraction.grid.voxel_size)
            << " voxels of the medial axis; " << extraction.measurements.counters.proved_empty
            << " voxels proved empty, " << extraction.undecided.size() << " undecided; "
            << extraction.measurements.counters.queries << " queries\n";
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2 || count > 3) return usage();
  medial_vk::ExtractionOptions options;
  options.resolution = 24;
  options.extra_levels = 3;  // cells of an eighth of a voxel are dismissed at a depth of one
  if (count == 3) {
    const int resolution = std::atoi(arguments[2]);
    if (resolution < 4 || resolution > 200) return usage();
    options.resolution = static_cast<std::uint32_t>(resolution);
  }
  const std::string name = arguments[1];
  medial_vk::BoundaryFunctions boundary;
  if (name == "torus") {
    boundary = any_boundary::torus();
  } else if (name == "helix") {
    boundary = any_boundary::helix_of_points();
  } else if (name == "rounded-box") {
    boundary = any_boundary::rounded_box();
  } else {
    return usage();
  }
  const auto result = medial_vk::extract_medial_spheres(boundary, options);
  if (!result) {
    std::cerr << result.error().message << '\n';
    return 1;
  }
  for (const medial_vk::MedialSphere& sphere : result.value().extraction.spheres) {
    std::cout << sphere.centre[0] << ' ' << sphere.centre[1] << ' ' << sphere.centre[2] << ' ' << sphere.radius << '\n';
  }
  summarise(result.value());
  return 0;
}
