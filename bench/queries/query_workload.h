// Meshes and queries of bench/queries/queries.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/context.h"
#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::bench {

/// Samples on the sphere of radius l about an interior voxel centre, after the centre itself.
constexpr std::uint32_t kSamples = 50;
constexpr std::uint32_t kGroup = kSamples + 1;
constexpr std::uint32_t kResolution = 160;  // voxels along the longest side; l is the side of a voxel

struct Workload {
  std::string name;
  Mesh mesh;                    // longest side 1
  std::vector<Point> spheres;   // kGroup points for each sphere
  std::vector<Point> shuffled;  // the same points in random order
};

/// A sphere with bumps and dents of several sizes, at least `triangles` faces.
Mesh make_blob(std::uint32_t triangles);

/// Interior voxels in 4^3 blocks in random order, until there are at least `queries` queries. The result is
/// reproducible.
Result<Workload> make_workload(Context& context, std::string name, Mesh mesh, std::uint64_t queries);

/// Points anywhere in the box of the mesh; the result is reproducible.
std::vector<Point> scattered_points(const Workload& workload, std::size_t count);

}  // namespace medial_vk::bench
