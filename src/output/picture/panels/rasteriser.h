// Rasterises triangles, discs and balls into layers of pixels with a depth each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "output/picture/panels/camera.h"
#include "output/picture/panels/scene.h"

namespace medial_vk::picture {

/// A surface sampled in every pixel. Normals are in view space.
struct SurfaceLayer {
  SurfaceLayer(std::uint32_t w, std::uint32_t h)
      : width(w),
        height(h),
        nearness(std::size_t{w} * h, 0.0f),
        normal(nearness.size(), Eigen::Vector3f::Zero()),
        tint(nearness.size(), Tint::kNone) {}

  std::uint32_t width;
  std::uint32_t height;
  std::vector<float> nearness;          // 0: the pixel is empty.
  std::vector<Eigen::Vector3f> normal;  // Unit vectors.
  std::vector<Tint> tint;
};

/// Marks: a surface with a position in the palette per pixel, and the distance from the centre of the disc.
struct MarkLayer {
  MarkLayer(std::uint32_t w, std::uint32_t h) : surface(w, h), value(surface.nearness.size(), 0.0f), rim(value) {}

  /// Writes the pixel unless something nearer is present.
  void put(std::uint32_t x, std::uint32_t y, float nearness, const Eigen::Vector3f& normal, float mark_value,
           float mark_rim);

  SurfaceLayer surface;
  std::vector<float> value;
  std::vector<float> rim;                   // 0 at the centre of a disc, 1 at its rim; 0 on a ball.
  std::vector<Eigen::Vector3f> paint = {};  // Instead of `value`, of a painted surface: linear light. Else empty.
};

enum class Keep { kNearest, kFarthest };

void draw_mesh(const Surface& mesh, const Camera& camera, Keep keep, SurfaceLayer& layer);

void draw_painted(const Painted& painted, const Camera& camera, MarkLayer& layer);

/// Draws discs of at least `least_radius` pixels. Discs seen from the rim are kept thick enough to be visible.
void draw_discs(std::span<const Mark> discs, const Camera& camera, float least_radius, MarkLayer& layer);

/// Draws each ball within the part where it is visible; `samples` per pixel and side.
void draw_balls(std::span<const Mark> balls, const Camera& camera, float samples, MarkLayer& layer);

/// The balls that are nearest at the centre of some pixel, the nearest first, each with the part of the picture where
/// it is visible.
std::vector<Mark> seen_balls(std::span<const Mark> balls, const Camera& camera, std::uint32_t width,
                             std::uint32_t height);

}  // namespace medial_vk::picture
