#include "output/picture/rasteriser.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

constexpr double kCreaseCosine = 0.76;  // Faces more than about 40 degrees apart do not share a normal.

/// Twice the area times the unit normal.
Eigen::Vector3d area_normal(const Mesh& mesh, const Triangle& triangle) {
  const auto corner = [&](std::size_t i) { return Eigen::Vector3d(mesh.vertices[triangle[i]].data()); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

/// Faces by vertex, as offsets into one array.
struct VertexFaces {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> faces;
};

VertexFaces faces_by_vertex(const Mesh& mesh) {
  VertexFaces out;
  out.first.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) ++out.first[vertex + 1];
  }
  for (std::size_t i = 1; i < out.first.size(); ++i) out.first[i] += out.first[i - 1];
  out.faces.resize(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
    for (const std::uint32_t vertex : mesh.triangles[face]) out.faces[next[vertex]++] = face;
  }
  return out;
}

/// Whole pixels whose centres lie within [least, greatest], clamped to the picture.
struct PixelRange {
  std::uint32_t begin = 0, end = 0;
};

PixelRange pixels_between(float least, float greatest, std::uint32_t size) {
  const float limit = static_cast<float>(size);
  const float begin = std::clamp(std::ceil(least - 0.5f), 0.0f, limit);
  const float end = std::clamp(std::floor(greatest - 0.5f) + 1.0f, begin, limit);
  return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

/// Barycentric coordinates of pixels in a triangle on the screen.
class ScreenTriangle {
 public:
  explicit ScreenTriangle(const std::array<ScreenPoint, 3>& corners) : p_(corners) {
    const float area = (p_[1].x - p_[0].x) * (p_[2].y - p_[0].y) - (p_[1].y - p_[0].y) * (p_[2].x - p_[0].x);
    inverse_area_ = std::abs(area) > 1e-12f ? 1.0f / area : 0.0f;
  }

  bool visible() const { return inverse_area_ != 0.0f; }
  PixelRange columns(std::uint32_t width) const {
    const auto [least, greatest] = std::minmax({p_[0].x, p_[1].x, p_[2].x});
    return pixels_between(least, greatest, width);
  }
  PixelRange rows(std::uint32_t height) const {
    const auto [least, greatest] = std::minmax({p_[0].y, p_[1].y, p_[2].y});
    return pixels_between(least, greatest, height);
  }
  /// Each weight is at least 0 exactly if the point is inside.
  Vector3f weights(float x, float y) const {
    const float b = ((x - p_[0].x) * (p_[2].y - p_[0].y) - (y - p_[0].y) * (p_[2].x - p_[0].x)) * inverse_area_;
    const float c = ((p_[1].x - p_[0].x) * (y - p_[0].y) - (p_[1].y - p_[0].y) * (x - p_[0].x)) * inverse_area_;
    return {1.0f - b - c, b, c};
  }
  float nearness(const Vector3f& weights) const {
    return weights[0] * p_[0].nearness + weights[1] * p_[1].nearness + weights[2] * p_[2].nearness;
  }

 private:
  std::array<ScreenPoint, 3> p_;
  float inverse_area_ = 0;
};

void draw_triangle(const ScreenTriangle& triangle, const std::array<Vector3f, 3>& normals, Keep keep,
                   SurfaceLayer& layer) {
  const PixelRange columns = triangle.columns(layer.width);
  const PixelRange rows = triangle.rows(layer.height);
  for (std::uint32_t y = rows.begin; y < rows.end; ++y) {
    for (std::uint32_t x = columns.begin; x < columns.end; ++x) {
      const Vector3f weights = triangle.weights(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      if (weights.minCoeff() < 0) continue;
      const float nearness = triangle.nearness(weights);
      const std::size_t pixel = std::size_t{y} * layer.width + x;
      float& held = layer.nearness[pixel];
      const bool better = held == 0.0f || (keep == Keep::kNearest ? nearness > held : nearness < held);
      if (!better) continue;
      held = nearness;
      layer.normal[pixel] = (weights[0] * normals[0] + weights[1] * normals[1] + weights[2] * normals[2]).normalized();
    }
  }
}

/// A disc on the screen: an ellipse whose short axis lies along the tilt of its normal.
struct ScreenDisc {
  ScreenPoint centre;
  Vector3f normal;               // View space, towards the viewer.
  float radius = 0;              // Pixels.
  float flattening = 0;          // Short axis over long axis.
  float tilt_x = 0, tilt_y = 0;  // Unit direction of the short axis on the screen.
};

ScreenDisc place_disc(const MedialSphere& sphere, double radius, const Camera& camera) {
  constexpr float kLeastPixels = 1.6f;       // Supersampled pixels: a disc never vanishes.
  constexpr float kLeastFlattening = 0.35f;  // Nor does one that is seen from its edge.
  ScreenDisc disc;
  disc.centre = camera.project(sphere.centre);
  // No larger than its ball: where a sheet ends near the boundary, balls are much smaller than voxels.
  disc.radius = std::max(static_cast<float>(std::min(radius, sphere.radius)) * camera.scale_at(disc.centre.nearness),
                         kLeastPixels);
  disc.normal = camera.turn(Vector3f(sphere.spoke_a.data()) - Vector3f(sphere.spoke_b.data()));
  const float length = disc.normal.norm();
  disc.normal = length > 1e-6f ? (disc.normal / length).eval() : Vector3f::UnitZ().eval();
  if (disc.normal.z() < 0) disc.normal = -disc.normal;
  disc.flattening = std::max(disc.normal.z(), kLeastFlattening);
  const float tilt = std::hypot(disc.normal.x(), disc.normal.y());
  disc.tilt_x = tilt > 1e-6f ? disc.normal.x() / tilt : 1.0f;
  disc.tilt_y = tilt > 1e-6f ? -disc.normal.y() / tilt : 0.0f;  // The screen's y points down.
  return disc;
}

void draw_disc(const ScreenDisc& disc, float value, float nearness_per_pixel, DiscLayer& layer) {
  const PixelRange columns =
      pixels_between(disc.centre.x - disc.radius, disc.centre.x + disc.radius, layer.surface.width);
  const PixelRange rows =
      pixels_between(disc.centre.y - disc.radius, disc.centre.y + disc.radius, layer.surface.height);
  const float tangent = std::sqrt(1.0f - disc.flattening * disc.flattening) / disc.flattening;
  for (std::uint32_t y = rows.begin; y < rows.end; ++y) {
    for (std::uint32_t x = columns.begin; x < columns.end; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - disc.centre.x;
      const float dy = static_cast<float>(y) + 0.5f - disc.centre.y;
      const float across = dx * disc.tilt_x + dy * disc.tilt_y;
      const float along = dx * disc.tilt_y - dy * disc.tilt_x;
      const float rim = std::hypot(across / disc.flattening, along) / disc.radius;
      if (!(rim <= 1.0f)) continue;
      // The side towards which the normal leans is farther from the viewer.
      const float nearness = disc.centre.nearness - across * tangent * nearness_per_pixel;
      const std::size_t pixel = std::size_t{y} * layer.surface.width + x;
      if (nearness <= layer.surface.nearness[pixel]) continue;
      layer.surface.nearness[pixel] = nearness;
      layer.surface.normal[pixel] = disc.normal;
      layer.value[pixel] = value;
      layer.rim[pixel] = rim;
    }
  }
}

}  // namespace

std::vector<std::array<Vector3f, 3>> corner_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> faces;
  faces.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) faces.push_back(area_normal(mesh, triangle));
  const VertexFaces around = faces_by_vertex(mesh);
  std::vector<std::array<Vector3f, 3>> out(mesh.triangles.size());
  for (std::size_t face = 0; face < out.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[face][corner];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::uint32_t i = around.first[vertex]; i < around.first[vertex + 1]; ++i) {
        const Eigen::Vector3d& other = faces[around.faces[i]];
        if (other.dot(faces[face]) >= kCreaseCosine * other.norm() * faces[face].norm()) sum += other;
      }
      out[face][corner] = sum.normalized().cast<float>();
    }
  }
  return out;
}

void draw_mesh(const Mesh& mesh, std::span<const std::array<Vector3f, 3>> normals, const Camera& camera, Keep keep,
               SurfaceLayer& layer) {
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    std::array<ScreenPoint, 3> corners;
    std::array<Vector3f, 3> turned;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = camera.project(mesh.vertices[mesh.triangles[face][i]]);
      turned[i] = camera.turn(normals[face][i]);
    }
    const ScreenTriangle triangle(corners);
    if (triangle.visible()) draw_triangle(triangle, turned, keep, layer);
  }
}

void draw_discs(std::span<const MedialSphere> spheres, double radius, const Camera& camera, DiscLayer& layer) {
  for (const MedialSphere& sphere : spheres) {
    const ScreenDisc disc = place_disc(sphere, radius, camera);
    draw_disc(disc, sphere.object_angle, camera.nearness_per_pixel(disc.centre.nearness), layer);
  }
}

}  // namespace medial_vk::picture
