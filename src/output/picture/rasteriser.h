// Triangles and discs into layers of pixels with a depth each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/extraction.h"
#include "mesh/mesh.h"
#include "output/picture/camera.h"

namespace medial_vk::picture {

/// A surface as it appears in every pixel. Normals are in view space.
struct SurfaceLayer {
  SurfaceLayer(std::uint32_t w, std::uint32_t h)
      : width(w), height(h), nearness(std::size_t{w} * h, 0.0f), normal(std::size_t{w} * h, Eigen::Vector3f::Zero()) {}

  std::uint32_t width;
  std::uint32_t height;
  std::vector<float> nearness;          // 0: nothing here.
  std::vector<Eigen::Vector3f> normal;  // Unit vectors.
};

/// Discs: a surface with a value per pixel (the object angle) and the distance from the disc's centre.
struct DiscLayer {
  DiscLayer(std::uint32_t w, std::uint32_t h) : surface(w, h), value(surface.nearness.size(), 0.0f), rim(value) {}

  SurfaceLayer surface;
  std::vector<float> value;
  std::vector<float> rim;  // 0 at the centre of a disc, 1 at its rim.
};

/// A unit normal for each corner of each triangle: the mean over the faces at that vertex, except those beyond a sharp
/// edge, so that round shapes look round and boxes look like boxes.
std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const Mesh& mesh);

enum class Keep { kNearest, kFarthest };

void draw_mesh(const Mesh& mesh, std::span<const std::array<Eigen::Vector3f, 3>> normals, const Camera& camera,
               Keep keep, SurfaceLayer& layer);

/// Each medial point as a disc of `radius` (mesh units; at most that of its ball) that lies in its medial sheet, whose
/// normal is along the difference of the spokes. Discs seen from the edge are kept thick enough to be seen.
void draw_discs(std::span<const MedialSphere> spheres, double radius, const Camera& camera, DiscLayer& layer);

}  // namespace medial_vk::picture
