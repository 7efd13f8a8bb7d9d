#include "output/picture/panels/scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include "output/colours/colour_map.h"
#include "output/picture/panels/surface.h"

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

constexpr double kDiscRadius = 0.75;  // In voxels: the discs of neighbouring voxels overlap into a sheet.

Eigen::AlignedBox3d box_around(std::span<const Point> points) {
  Eigen::AlignedBox3d box;
  for (const Point& p : points) box.extend(Eigen::Vector3d(p.data()));
  return box;
}

/// Maps from units of the mesh to those of the camera. Differences are taken in double, so that a small shape far from
/// the origin keeps its digits.
class Placement {
 public:
  explicit Placement(std::span<const Point> points) {
    const Eigen::AlignedBox3d box = box_around(points);
    if (!box.isEmpty()) centre_ = box.center();
    double radius = 0;
    for (const Point& p : points) radius = std::max(radius, (Eigen::Vector3d(p.data()) - centre_).stableNorm());
    if (radius > 0) scale_ = 1 / radius;
  }

  Vector3f point(const Point& p) const { return ((Eigen::Vector3d(p.data()) - centre_) * scale_).cast<float>(); }
  float length(double units) const { return static_cast<float>(units * scale_); }

 private:
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double scale_ = 1;
};

Surface make_surface(const Mesh& mesh, const Placement& placement) {
  Surface surface;
  surface.positions.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) surface.positions.push_back(placement.point(mesh.vertices[vertex]));
  }
  surface.normals = corner_normals(mesh);
  return surface;
}

Vector3f sheet_normal(const MedialSphere& sphere) {
  const Vector3f across = Vector3f(sphere.spoke_a.data()) - Vector3f(sphere.spoke_b.data());
  const float length = across.norm();
  return length > 1e-6f ? (across / length).eval() : Vector3f::UnitZ().eval();
}

struct Interval {
  double least = 0, greatest = 1;
  /// 0 to 1; the middle if all values are equal.
  float share(double value) const {
    return greatest > least ? static_cast<float>(std::clamp((value - least) / (greatest - least), 0.0, 1.0)) : 0.5f;
  }
};

Interval radii_of(std::span<const MedialSphere> spheres) {
  if (spheres.empty()) return {};
  const auto [least, greatest] = std::minmax_element(
      spheres.begin(), spheres.end(), [](const MedialSphere& a, const MedialSphere& b) { return a.radius < b.radius; });
  return {least->radius, greatest->radius};
}

/// Assigns to a sphere the position of its colour in the palette.
class Scale {
 public:
  Scale(std::span<const MedialSphere> spheres, const PictureOptions& options) : colour_(options.colour) {
    if (colour_ == PictureColour::kAngle) interval_ = {options.least_angle, std::numbers::pi / 2};
    if (colour_ == PictureColour::kRadius) interval_ = radii_of(spheres);
  }

  float value(const MedialSphere& sphere) const {
    if (colour_ == PictureColour::kSheet) return static_cast<float>(sheet_colour_index(sphere.sheet));
    const float last = static_cast<float>(viridis_samples().size() - 1);
    return last * interval_.share(colour_ == PictureColour::kAngle ? double{sphere.object_angle} : sphere.radius);
  }

  std::vector<Vector3f> palette() const {
    const std::span<const Vector3f> colours = colour_ == PictureColour::kSheet ? sheet_colours() : viridis_samples();
    return {colours.begin(), colours.end()};
  }

  Legend legend(std::span<const MedialSphere> spheres) const {
    if (colour_ == PictureColour::kAngle) {
      return {
          "object angle (rad)", fmt::format("{:.2f}", interval_.least), fmt::format("{:.2f}", interval_.greatest), {}};
    }
    if (colour_ == PictureColour::kRadius) {
      if (spheres.empty()) return {"radius", "", "", {}};
      return {"radius", fmt::format("{:.3g}", interval_.least), fmt::format("{:.3g}", interval_.greatest), {}};
    }
    return {"sheet", "", "", swatches(spheres)};
  }

 private:
  /// The first sheets with their numbers; points without a sheet are grey.
  static std::vector<std::pair<std::size_t, std::string>> swatches(std::span<const MedialSphere> spheres) {
    constexpr std::size_t kMost = 8;
    std::set<std::int32_t> sheets;
    for (const MedialSphere& sphere : spheres) sheets.insert(std::max(sphere.sheet, -1));
    std::vector<std::pair<std::size_t, std::string>> out;
    for (const std::int32_t sheet : sheets) {
      if (out.size() == kMost) {
        out.emplace_back(sheet_colours().size(), fmt::format("and {} more", sheets.size() - kMost));
        break;
      }
      out.emplace_back(sheet_colour_index(sheet), sheet < 0 ? "none" : fmt::format("{}", sheet));
    }
    return out;
  }

  PictureColour colour_;
  Interval interval_;
};

/// The mesh, and with `frame_points` what is drawn of the spheres: balls with their ends to all sides of the view.
std::vector<Point> points_in_frame(const Mesh& mesh, std::span<const MedialSphere> spheres,
                                   const PictureOptions& options) {
  std::vector<Point> points = mesh.vertices;
  if (!options.frame_points) return points;
  const Eigen::Matrix3d axes = rotation_for(options.view).cast<double>();
  for (const MedialSphere& sphere : spheres) {
    points.push_back(sphere.centre);
    if (options.show == PictureShow::kPoints) continue;
    for (int k = 0; k < 3; ++k) {
      for (const double reach : {-sphere.radius, sphere.radius}) {
        const Eigen::Vector3d end = Eigen::Vector3d(sphere.centre.data()) + reach * axes.row(k).transpose();
        points.push_back({end.x(), end.y(), end.z()});
      }
    }
  }
  return points;
}

}  // namespace

Eigen::AlignedBox3d box_of(const Mesh& mesh) { return box_around(mesh.vertices); }

Mark make_mark(const Mesh& mesh, const Point& centre, double radius, std::size_t colour) {
  const Placement placement(mesh.vertices);
  return {placement.point(centre), placement.length(radius), Vector3f::UnitZ(), static_cast<float>(colour), {}};
}

Surface make_surface(const Mesh& framed, const Mesh& mesh) { return make_surface(mesh, Placement(framed.vertices)); }

Scene make_scene(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                 const PictureOptions& options) {
  const std::vector<Point> shown = points_in_frame(mesh, spheres, options);
  const Placement placement(shown);
  const Scale scale(spheres, options);
  Scene scene;
  scene.mesh = make_surface(mesh, placement);
  if (shown.size() > mesh.vertices.size()) {
    for (const Point& p : shown) scene.framed.push_back(placement.point(p));
  }
  for (const MedialSphere& sphere : spheres) {
    Mark mark = {
        placement.point(sphere.centre), placement.length(sphere.radius), sheet_normal(sphere), scale.value(sphere), {}};
    if (options.show != PictureShow::kPoints) scene.balls.push_back(mark);
    // No larger than its ball: where a sheet ends near the boundary, balls are much smaller than voxels.
    mark.radius = std::min(mark.radius, placement.length(kDiscRadius * voxel_size));
    if (options.show != PictureShow::kBalls) scene.discs.push_back(mark);
  }
  scene.palette = scale.palette();
  scene.legend = scale.legend(spheres);
  return scene;
}

}  // namespace medial_vk::picture
