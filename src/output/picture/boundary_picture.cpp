#include "output/picture/boundary_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "output/boundary_colours/boundary_colours.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"

namespace medial_vk {
namespace {

using Eigen::Vector3f;

// In radii of the shape.
constexpr float kStrokeSpacing = 0.055f, kLongStroke = 0.046f, kShortStroke = 0.022f, kStrokeWidth = 0.005f;
constexpr float kHalo = 0.0025f;  // Of white around a stroke, which shows it on every colour.
/// How far strokes lie before the surface: it bends away below them, and depths have the digits of floats.
constexpr float kHaloLift = 0.004f, kStrokeLift = 0.005f;

const Vector3f kStrokeInk(0.08f, 0.08f, 0.10f);

Vector3f vector_at(const BoundaryField& field, std::size_t i) {
  const double* v = &field.values[3 * i];
  return Eigen::Vector3d(v[0], v[1], v[2]).cast<float>();
}

/// Strokes on vertices of a mesh that are at least a spacing apart.
class Strokes {
 public:
  Strokes(const picture::Surface& corners, const Mesh& mesh, const BoundaryFields& fields) {
    for (std::size_t corner = 0; corner < corners.positions.size(); ++corner) {
      const std::uint32_t vertex = mesh.triangles[corner / 3][corner % 3];
      const Vector3f along = vector_at(*fields.find(field_names::kDirection1), vertex);
      const Vector3f across = vector_at(*fields.find(field_names::kDirection2), vertex);
      const Vector3f& at = corners.positions[corner];
      if ((along.hasNaN() && across.hasNaN()) || !take(at)) continue;
      const Vector3f& normal = corners.normals[corner];
      add(at, normal, along, kLongStroke);
      add(at, normal, across, kShortStroke);
    }
  }

  void append_to(picture::Painted& painted) const {
    painted.surface.positions.insert(painted.surface.positions.end(), positions_.begin(), positions_.end());
    painted.surface.normals.insert(painted.surface.normals.end(), normals_.begin(), normals_.end());
    painted.light.insert(painted.light.end(), light_.begin(), light_.end());
  }

 private:
  using Cell = std::array<int, 3>;

  /// False: a stroke is too near. Cells are as large as the spacing, so that it is in this cell or in one beside it.
  bool take(const Vector3f& at) {
    const Eigen::Array3i own = (at / kStrokeSpacing).array().floor().cast<int>();
    for (int i = 0; i < 27; ++i) {
      const Cell cell = {own[0] + i % 3 - 1, own[1] + i / 3 % 3 - 1, own[2] + i / 9 - 1};
      const auto [begin, end] = taken_.equal_range(cell);
      const auto is_near = [&](const auto& other) { return (other.second - at).norm() < kStrokeSpacing; };
      if (std::any_of(begin, end, is_near)) return false;
    }
    taken_.emplace(Cell{own[0], own[1], own[2]}, at);
    return true;
  }

  /// Nothing if the direction is not known.
  void add(const Vector3f& at, const Vector3f& normal, Vector3f direction, float length) {
    direction -= direction.dot(normal) * normal;
    if (!(direction.norm() > 0.1f)) return;
    direction.normalize();
    rectangle(at + kHaloLift * normal, normal, direction, length + 2 * kHalo, kStrokeWidth + 2 * kHalo,
              Vector3f::Ones());
    rectangle(at + kStrokeLift * normal, normal, direction, length, kStrokeWidth, kStrokeInk);
  }

  /// Two triangles in the tangent plane.
  void rectangle(const Vector3f& middle, const Vector3f& normal, const Vector3f& direction, float length, float width,
                 const Vector3f& colour) {
    const Vector3f along = 0.5f * length * direction, across = 0.5f * width * normal.cross(direction);
    const std::array<Vector3f, 4> corners = {middle - along - across, middle + along - across, middle + along + across,
                                             middle - along + across};
    for (const std::size_t i : {0, 1, 2, 0, 2, 3}) {
      positions_.push_back(corners[i]);
      normals_.push_back(normal);
      light_.push_back(picture::to_light(colour));
    }
  }

  std::multimap<Cell, Vector3f> taken_;
  std::vector<Vector3f> positions_, normals_, light_;
};

picture::Legend legend_of(const BoundaryColours& colours, std::vector<Vector3f>& palette) {
  picture::Legend legend = {colours.title, colours.least, colours.greatest, {}};
  palette = colours.bar;
  for (const auto& [colour, name] : colours.swatches) {
    legend.swatches.emplace_back(palette.size(), name);
    palette.push_back(colour);
  }
  return legend;
}

}  // namespace

Picture draw_boundary(const Mesh& mesh, const BoundaryFields& fields, BoundaryColour colour, bool strokes,
                      const PictureOptions& options) {
  const Eigen::AlignedBox3d box = picture::box_of(mesh);
  const double longest_side = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  const BoundaryColours colours = colour_boundary(fields, colour, longest_side);
  picture::Scene scene = picture::make_scene(mesh, {}, 0, options);
  scene.painted.surface = scene.mesh;
  scene.painted.light.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      scene.painted.light.push_back(picture::to_light(colours.of_vertices[corner]));
    }
  }
  if (strokes) Strokes(scene.mesh, mesh, fields).append_to(scene.painted);
  scene.legend = legend_of(colours, scene.palette);
  if (strokes) scene.legend.note = "strokes: long along kappa 1, short along kappa 2";
  Picture out = picture::blank(options);
  picture::draw_panel(scene, {.width = out.width, .painted = true}, options.view, out);
  picture::draw_legend(scene, out);
  return out;
}

}  // namespace medial_vk
