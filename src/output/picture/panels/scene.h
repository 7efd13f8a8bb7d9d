// The objects of a picture, in the units of the camera: the mesh around the origin in a ball of radius 1. Both ways of
// drawing start from it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh.h"
#include "output/picture/panels/camera.h"
#include "output/picture/panels/options.h"

namespace medial_vk::picture {

/// The colour of glass, which distinguishes solids.
enum class Tint : std::uint8_t { kNone, kWarm, kCold };

/// Corners of triangles with unit normals, three in a row for each triangle.
struct Surface {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Tint> tints;  // Of triangles; empty: none has one. The CPU alone draws them.
};

/// A medial point, as a disc in its sheet or as its ball.
struct Mark {
  Eigen::Vector3f centre;
  float radius = 0;        // Of the disc or of the ball.
  Eigen::Vector3f normal;  // Of the sheet; unit length, either side. Not used for balls.
  float value = 0;         // Position of its colour in the palette: 2.5 is half way from the third to the fourth.
  Frame seen = {};         // The part of the panel outside of which a ball is hidden, pixels. Not used for discs.
};
static_assert(sizeof(Mark) == 48);  // The layout that the shaders read.

struct Legend {
  std::string title;
  std::string least, greatest;                                // At the ends of the bar of all colours.
  std::vector<std::pair<std::size_t, std::string>> swatches;  // Of single colours, instead of the bar.
  std::string note = {};                                      // A line below; empty: none.
};

/// A surface with a colour for each corner, in linear light.
struct Painted {
  Surface surface;
  std::vector<Eigen::Vector3f> light;
  bool two_sided = false;  // It is lit on the side that is seen; otherwise its normals point outwards.
};

struct Scene {
  Surface mesh;
  Painted painted = {};  // The mesh in colours, opaque, and what is drawn on it. The CPU alone draws it.
  std::vector<Mark> discs, balls;
  std::vector<Eigen::Vector3f> framed = {};  // What fills the picture; empty: the mesh.
  std::vector<Mark> on_top = {};             // Points that show through everything. The CPU alone draws them.
  std::vector<Eigen::Vector3f> palette;      // sRGB.
  Legend legend;

  std::span<const Eigen::Vector3f> in_frame() const { return framed.empty() ? mesh.positions : framed; }
};

Eigen::AlignedBox3d box_of(const Mesh& mesh);

/// A ball of `colour`, by its index in the palette, in the units of the camera that make_scene() has for the mesh.
Mark make_mark(const Mesh& mesh, const Point& centre, double radius, std::size_t colour);

/// Another mesh, in the units of the camera that make_scene() has for `framed`.
Surface make_surface(const Mesh& framed, const Mesh& mesh);

/// `voxel_size` is in units of the mesh. Discs and balls are made only if they are shown.
Scene make_scene(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                 const PictureOptions& options);

}  // namespace medial_vk::picture
