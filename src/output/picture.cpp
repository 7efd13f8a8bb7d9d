#include "output/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "output/picture/camera.h"
#include "output/picture/colour_map.h"
#include "output/picture/rasteriser.h"
#include "output/picture/text.h"

namespace medial_vk {
namespace {

using Eigen::Vector3f;
using picture::Camera;
using picture::DiscLayer;
using picture::SurfaceLayer;

constexpr std::uint32_t kSupersampling = 2;  // Per side: four samples per pixel.
constexpr float kDiscRadius = 0.75f;         // In voxels: the discs of neighbouring voxels overlap into a sheet.

const Vector3f kKeyLight = Vector3f(-0.45f, 0.65f, 0.62f).normalized();  // View space, towards the light.
const Vector3f kGlass(0.58f, 0.67f, 0.77f);
const Vector3f kInk(0.22f, 0.25f, 0.30f);

Vector3f mix(const Vector3f& a, const Vector3f& b, float share) { return a + share * (b - a); }

/// White with a little grey at the bottom: the shape stands on something.
Vector3f background(float height_share) {
  return mix(Vector3f(1.0f, 1.0f, 1.0f), Vector3f(0.90f, 0.92f, 0.945f), height_share * height_share);
}

float diffuse(const Vector3f& normal) { return std::max(normal.dot(kKeyLight), 0.0f); }

/// Everything in the picture, at the resolution of the samples.
struct Layers {
  Layers(std::uint32_t width, std::uint32_t height) : front(width, height), back(width, height), discs(width, height) {}
  SurfaceLayer front;
  SurfaceLayer back;
  DiscLayer discs;
};

struct ColourScale {
  float least = 0, greatest = 1;
  Vector3f colour(float value) const { return picture::viridis((value - least) / (greatest - least)); }
};

/// The far wall of the glass, seen from inside.
Vector3f over_back_wall(const Vector3f& below, const Vector3f& normal) {
  const float facing = std::min(std::abs(normal.z()), 1.0f);
  const float light = 0.62f + 0.38f * diffuse(-normal);
  return mix(below, kGlass * light, 0.16f + 0.30f * (1.0f - facing));
}

/// A disc: its colour, lit from both sides, darker at the rim so that discs can be told apart and farther away paler.
Vector3f disc_colour(const Vector3f& colour, const Vector3f& normal, float rim, float depth_share) {
  const float light = 0.68f + 0.46f * std::abs(normal.dot(kKeyLight));
  const float edge = 1.0f - 0.16f * rim * rim * rim;
  const Vector3f lit = (colour * (light * edge)).cwiseMin(1.0f);
  return mix(lit, Vector3f(0.93f, 0.945f, 0.96f), 0.30f * depth_share);
}

/// The near wall: clear where it faces the viewer, denser towards the outline (Schlick's curve), with a highlight.
Vector3f over_front_wall(const Vector3f& below, const Vector3f& normal) {
  const Vector3f outward = normal.z() < 0 ? (-normal).eval() : normal;
  const float facing = std::min(outward.z(), 1.0f);
  const float grazing = 1.0f - facing;
  const float cover = 0.07f + 0.62f * grazing * grazing * grazing;
  const float light = 0.70f + 0.42f * diffuse(outward);
  const Vector3f glass = mix(below, (kGlass * light).cwiseMin(1.0f), cover);
  const Vector3f halfway = (kKeyLight + Vector3f::UnitZ()).normalized();
  const float highlight = std::pow(std::max(outward.dot(halfway), 0.0f), 48.0f);
  return mix(glass, Vector3f::Ones(), 0.35f * highlight);
}

/// Does the near wall end or bend sharply between this sample and the next to the right or below? Drawn as a thin
/// line, this shows the outline and the creases of the shape.
bool on_line(const SurfaceLayer& layer, std::size_t pixel) {
  constexpr float kCrease = 0.80f;
  const bool here = layer.nearness[pixel] > 0;
  const auto ends_before = [&](std::size_t step) {
    if (pixel + step >= layer.nearness.size()) return false;
    const bool there = layer.nearness[pixel + step] > 0;
    return here != there || (here && layer.normal[pixel].dot(layer.normal[pixel + step]) < kCrease);
  };
  return ends_before(1) || ends_before(layer.width);
}

Vector3f sample_colour(const Layers& layers, std::size_t pixel, const Camera& camera, const ColourScale& scale,
                       float height_share) {
  Vector3f colour = background(height_share);
  if (layers.back.nearness[pixel] > 0) colour = over_back_wall(colour, layers.back.normal[pixel]);
  const float nearness = layers.discs.surface.nearness[pixel];
  if (nearness > 0) {
    const float depth =
        (camera.greatest_nearness() - nearness) / (camera.greatest_nearness() - camera.least_nearness());
    colour = disc_colour(scale.colour(layers.discs.value[pixel]), layers.discs.surface.normal[pixel],
                         layers.discs.rim[pixel], std::clamp(depth, 0.0f, 1.0f));
  }
  // A disc in front of the wall can only be a disc that sticks out by its own size: the wall stays in front of it.
  if (layers.front.nearness[pixel] > 0) colour = over_front_wall(colour, layers.front.normal[pixel]);
  return on_line(layers.front, pixel) ? mix(colour, kInk, 0.42f) : colour;
}

void set_pixel(Picture& picture, std::uint32_t x, std::uint32_t y, const Vector3f& colour) {
  if (x >= picture.width || y >= picture.height) return;
  for (Eigen::Index channel = 0; channel < 3; ++channel) {
    const float value = std::clamp(colour[channel], 0.0f, 1.0f) * 255.0f + 0.5f;
    picture.rgb[(std::size_t{y} * picture.width + x) * 3 + static_cast<std::size_t>(channel)] =
        static_cast<std::uint8_t>(value);
  }
}

void resolve_samples(const Layers& layers, const Camera& camera, const ColourScale& scale, Picture& picture) {
  constexpr float kShare = 1.0f / (kSupersampling * kSupersampling);
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    const float height_share = static_cast<float>(y) / static_cast<float>(picture.height);
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      Vector3f sum = Vector3f::Zero();
      for (std::uint32_t sample = 0; sample < kSupersampling * kSupersampling; ++sample) {
        const std::uint32_t sample_x = x * kSupersampling + sample % kSupersampling;
        const std::uint32_t sample_y = y * kSupersampling + sample / kSupersampling;
        const std::size_t pixel = std::size_t{sample_y} * layers.front.width + sample_x;
        sum += sample_colour(layers, pixel, camera, scale, height_share);
      }
      set_pixel(picture, x, y, sum * kShare);
    }
  }
}

constexpr std::uint32_t kTextScale = 2;

void write_text(Picture& picture, std::uint32_t left, std::uint32_t top, const std::string& text) {
  picture::draw_text(text, [&](std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t i = 0; i < kTextScale * kTextScale; ++i) {
      set_pixel(picture, left + x * kTextScale + i % kTextScale, top + y * kTextScale + i / kTextScale, kInk);
    }
  });
}

std::uint32_t text_width(const std::string& text) {
  return static_cast<std::uint32_t>(text.size()) * picture::kGlyphWidth * kTextScale;
}

/// A bar of the colours at the lower right, its ends labelled, and what it shows above it.
void draw_legend(Picture& picture, const ColourScale& scale) {
  constexpr std::uint32_t kWidth = 260, kHeight = 14, kMargin = 32;
  constexpr std::uint32_t kLine = picture::kGlyphHeight * kTextScale + 6;
  if (picture.width < kWidth + 2 * kMargin || picture.height < kHeight + 2 * kLine + 2 * kMargin) return;
  const std::uint32_t left = picture.width - kMargin - kWidth;
  const std::uint32_t top = picture.height - kMargin - kLine - kHeight;
  for (std::uint32_t x = 0; x < kWidth; ++x) {
    const Vector3f colour = picture::viridis(static_cast<float>(x) / static_cast<float>(kWidth - 1));
    for (std::uint32_t y = 0; y < kHeight; ++y) set_pixel(picture, left + x, top + y, colour);
  }
  write_text(picture, left, top - kLine, "object angle (rad)");
  write_text(picture, left, top + kHeight + 6, fmt::format("{:.2f}", scale.least));
  const std::string greatest = fmt::format("{:.2f}", scale.greatest);
  write_text(picture, left + kWidth - text_width(greatest) + kTextScale, top + kHeight + 6, greatest);
}

}  // namespace

Picture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                     const PictureOptions& options) {
  Picture out;
  out.width = options.width;
  out.height = options.height;
  out.rgb.resize(std::size_t{out.width} * out.height * 3);

  const float width = static_cast<float>(options.width * kSupersampling);
  const float height = static_cast<float>(options.height * kSupersampling);
  const picture::Frame frame = {0.07f * width, 0.06f * height, 0.93f * width, 0.875f * height};
  const Camera camera(mesh.vertices, frame);

  Layers layers(options.width * kSupersampling, options.height * kSupersampling);
  const auto normals = picture::corner_normals(mesh);
  picture::draw_mesh(mesh, normals, camera, picture::Keep::kNearest, layers.front);
  picture::draw_mesh(mesh, normals, camera, picture::Keep::kFarthest, layers.back);
  picture::draw_discs(spheres, static_cast<double>(kDiscRadius) * voxel_size, camera, layers.discs);

  const ColourScale scale = {static_cast<float>(options.least_angle), std::numbers::pi_v<float> / 2};
  resolve_samples(layers, camera, scale, out);
  draw_legend(out, scale);
  return out;
}

}  // namespace medial_vk
