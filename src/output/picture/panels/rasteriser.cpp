#include "output/picture/panels/rasteriser.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

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
  /// All weights are at least 0 exactly if the point is inside.
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

/// Calls `put(pixel, nearness, weights)` for the pixels of a triangle in a layer of this size.
template <class Put>
void for_pixels(const ScreenTriangle& triangle, std::uint32_t width, std::uint32_t height, const Put& put) {
  const PixelRange columns = triangle.columns(width);
  const PixelRange rows = triangle.rows(height);
  for (std::uint32_t y = rows.begin; y < rows.end; ++y) {
    for (std::uint32_t x = columns.begin; x < columns.end; ++x) {
      const Vector3f weights = triangle.weights(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      if (weights.minCoeff() < 0) continue;
      put(std::size_t{y} * width + x, triangle.nearness(weights), weights);
    }
  }
}

Vector3f mean(const std::array<Vector3f, 3>& corners, const Vector3f& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

/// Three corners of a surface, from `first`, on the screen, and their normals there.
struct SeenCorners {
  SeenCorners(const Surface& mesh, std::size_t first, const Camera& camera) {
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = camera.project(mesh.positions[first + i]);
      normals[i] = camera.turn(mesh.normals[first + i]);
    }
  }

  std::array<ScreenPoint, 3> corners;
  std::array<Vector3f, 3> normals;
};

void draw_triangle(const ScreenTriangle& triangle, const std::array<Vector3f, 3>& normals, Tint tint, Keep keep,
                   SurfaceLayer& layer) {
  for_pixels(triangle, layer.width, layer.height, [&](std::size_t pixel, float nearness, const Vector3f& weights) {
    float& held = layer.nearness[pixel];
    const bool better = held == 0.0f || (keep == Keep::kNearest ? nearness > held : nearness < held);
    if (!better) return;
    held = nearness;
    layer.tint[pixel] = tint;
    layer.normal[pixel] = mean(normals, weights).normalized();
  });
}

/// A disc on the screen: an ellipse whose short axis lies along the tilt of its normal.
struct ScreenDisc {
  ScreenPoint centre;
  Vector3f normal;               // View space, towards the viewer.
  float radius = 0;              // Pixels.
  float flattening = 0;          // Short axis over long axis.
  float tilt_x = 0, tilt_y = 0;  // Unit direction of the short axis on the screen.
};

ScreenDisc place_disc(const Mark& mark, const Camera& camera, float least_radius) {
  constexpr float kLeastFlattening = 0.35f;  // A disc seen from its rim does not vanish.
  ScreenDisc disc;
  disc.centre = camera.project(mark.centre);
  disc.radius = std::max(mark.radius * camera.scale_at(disc.centre.nearness), least_radius);
  disc.normal = camera.turn(mark.normal);
  if (disc.normal.z() < 0) disc.normal = -disc.normal;
  disc.flattening = std::max(disc.normal.z(), kLeastFlattening);
  const float tilt = std::hypot(disc.normal.x(), disc.normal.y());
  disc.tilt_x = tilt > 1e-6f ? disc.normal.x() / tilt : 1.0f;
  disc.tilt_y = tilt > 1e-6f ? -disc.normal.y() / tilt : 0.0f;  // The y axis of the screen points down.
  return disc;
}

void draw_disc(const ScreenDisc& disc, float value, float nearness_per_pixel, MarkLayer& layer) {
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
      layer.put(x, y, nearness, disc.normal, value, rim);
    }
  }
}

/// The interval in which the shadow of a ball meets a line at a distance of 1 from the eye: the tangents in a plane
/// through the eye. `across` and `away` are coordinates of its centre in that plane, away > radius.
std::pair<float, float> shadow(float across, float away, float radius) {
  const float square = away * away - radius * radius;
  const float root = radius * std::sqrt(std::max(across * across + square, 0.0f));
  return {(across * away - root) / square, (across * away + root) / square};
}

/// Calls `put(x, y, nearness, normal)` for the pixels of a ball within `part`, unless `hides(x, y, nearness)` reports
/// that even the nearest point of the ball is hidden at that pixel.
template <class Hides, class Put>
void draw_ball(const Mark& ball, const Camera& camera, const Frame& part, const Hides& hides, const Put& put) {
  const Vector3f seen = camera.turn(ball.centre);
  const Vector3f centre(seen.x(), -seen.y(), Camera::kDistance - seen.z());  // From the eye; y down, z away.
  if (!(centre.z() > 1.01f * ball.radius)) return;
  const auto [left, right] = shadow(centre.x(), centre.z(), ball.radius);
  const auto [top, bottom] = shadow(centre.y(), centre.z(), ball.radius);
  const float pixels = camera.pixels(), greatest_nearness = 1.0f / (centre.z() - ball.radius);
  const PixelRange columns =
      pixels_between(std::max(camera.offset_x() + pixels * left, part.left),
                     std::min(camera.offset_x() + pixels * right, part.right), static_cast<std::uint32_t>(part.right));
  const PixelRange rows = pixels_between(std::max(camera.offset_y() + pixels * top, part.top),
                                         std::min(camera.offset_y() + pixels * bottom, part.bottom),
                                         static_cast<std::uint32_t>(part.bottom));
  for (std::uint32_t y = rows.begin; y < rows.end; ++y) {
    for (std::uint32_t x = columns.begin; x < columns.end; ++x) {
      if (hides(x, y, greatest_nearness)) continue;
      // The ray through the sample is t * d. With w from its point at the depth of the centre to the centre, nothing
      // large cancels: the distance of the ray from the centre is |d x w| / |d|.
      const Vector3f d((static_cast<float>(x) + 0.5f - camera.offset_x()) / pixels,
                       (static_cast<float>(y) + 0.5f - camera.offset_y()) / pixels, 1.0f);
      const Vector3f w(centre.x() - centre.z() * d.x(), centre.y() - centre.z() * d.y(), 0.0f);
      const float root = ball.radius * ball.radius * d.squaredNorm() - d.cross(w).squaredNorm();
      if (!(root > 0)) continue;
      const float step = (d.dot(w) - std::sqrt(root)) / d.squaredNorm();
      const Vector3f out = (step * d - w) / ball.radius;
      put(x, y, 1.0f / (centre.z() + step), Vector3f(out.x(), -out.y(), -out.z()));
    }
  }
}

}  // namespace

void MarkLayer::put(std::uint32_t x, std::uint32_t y, float nearness, const Vector3f& normal, float mark_value,
                    float mark_rim) {
  const std::size_t pixel = std::size_t{y} * surface.width + x;
  if (nearness <= surface.nearness[pixel]) return;
  surface.nearness[pixel] = nearness;
  surface.normal[pixel] = normal;
  value[pixel] = mark_value;
  rim[pixel] = mark_rim;
}

void draw_mesh(const Surface& mesh, const Camera& camera, Keep keep, SurfaceLayer& layer) {
  for (std::size_t first = 0; first < mesh.positions.size(); first += 3) {
    const SeenCorners seen(mesh, first, camera);
    const ScreenTriangle triangle(seen.corners);
    const Tint tint = mesh.tints.empty() ? Tint::kNone : mesh.tints[first / 3];
    if (triangle.visible()) draw_triangle(triangle, seen.normals, tint, keep, layer);
  }
}

void draw_painted(const Painted& painted, const Camera& camera, MarkLayer& layer) {
  SurfaceLayer& surface = layer.surface;
  layer.paint.assign(surface.nearness.size(), Vector3f::Zero());
  for (std::size_t first = 0; first < painted.surface.positions.size(); first += 3) {
    const SeenCorners seen(painted.surface, first, camera);
    const ScreenTriangle triangle(seen.corners);
    if (!triangle.visible()) continue;
    const std::array<Vector3f, 3> light = {painted.light[first], painted.light[first + 1], painted.light[first + 2]};
    for_pixels(triangle, surface.width, surface.height,
               [&](std::size_t pixel, float nearness, const Vector3f& weights) {
                 if (nearness <= surface.nearness[pixel]) return;
                 surface.nearness[pixel] = nearness;
                 const Vector3f normal = mean(seen.normals, weights).normalized();
                 surface.normal[pixel] = painted.two_sided && normal.z() < 0 ? Vector3f(-normal) : normal;
                 layer.paint[pixel] = mean(light, weights);
               });
  }
}

void draw_discs(std::span<const Mark> discs, const Camera& camera, float least_radius, MarkLayer& layer) {
  for (const Mark& mark : discs) {
    const ScreenDisc disc = place_disc(mark, camera, least_radius);
    draw_disc(disc, mark.value, camera.nearness_per_pixel(disc.centre.nearness), layer);
  }
}

void draw_balls(std::span<const Mark> balls, const Camera& camera, float samples, MarkLayer& layer) {
  const std::vector<float>& nearest = layer.surface.nearness;
  const std::uint32_t width = layer.surface.width;
  for (const Mark& ball : balls) {
    const Frame part = {samples * ball.seen.left, samples * ball.seen.top, samples * ball.seen.right,
                        samples * ball.seen.bottom};
    draw_ball(
        ball, camera, part,
        [&](std::uint32_t x, std::uint32_t y, float nearness) {
          return nearness <= nearest[std::size_t{y} * width + x];
        },
        [&](std::uint32_t x, std::uint32_t y, float nearness, const Vector3f& normal) {
          layer.put(x, y, nearness, normal.normalized(), ball.value, 0.0f);
        });
  }
}

std::vector<Mark> seen_balls(std::span<const Mark> balls, const Camera& camera, std::uint32_t width,
                             std::uint32_t height) {
  // The nearest come first, so that hidden ones are skipped quickly.
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<float> front(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) front[i] = camera.turn(balls[i].centre).z() + balls[i].radius;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return front[a] > front[b]; });

  std::vector<float> nearest(std::size_t{width} * height, 0.0f);
  std::vector<std::size_t> owner(nearest.size());
  const Frame whole = {0, 0, static_cast<float>(width), static_cast<float>(height)};
  for (const std::size_t i : order) {
    draw_ball(
        balls[i], camera, whole,
        [&](std::uint32_t x, std::uint32_t y, float nearness) {
          return nearness <= nearest[std::size_t{y} * width + x];
        },
        [&](std::uint32_t x, std::uint32_t y, float nearness, const Vector3f&) {
          const std::size_t pixel = std::size_t{y} * width + x;
          if (nearness <= nearest[pixel]) return;
          nearest[pixel] = nearness;
          owner[pixel] = i;
        });
  }
  std::vector<Frame> parts(balls.size(), {whole.right, whole.bottom, 0, 0});
  for (std::size_t pixel = 0; pixel < owner.size(); ++pixel) {
    if (nearest[pixel] == 0) continue;
    const std::size_t column = pixel % width, row = pixel / width;
    const auto x = static_cast<float>(column), y = static_cast<float>(row);
    Frame& part = parts[owner[pixel]];  // with a margin of one pixel, where it may hide half of a neighbour's
    part = {std::min(part.left, std::max(x - 1, 0.0f)), std::min(part.top, std::max(y - 1, 0.0f)),
            std::max(part.right, std::min(x + 2, whole.right)), std::max(part.bottom, std::min(y + 2, whole.bottom))};
  }
  std::vector<Mark> seen;
  for (const std::size_t i : order) {
    if (parts[i].right == 0) continue;
    seen.push_back(balls[i]);
    seen.back().seen = parts[i];
  }
  return seen;
}

}  // namespace medial_vk::picture
