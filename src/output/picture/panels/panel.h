// A part of a picture that shows one subject, and the common part of both ways to draw it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "output/picture/panels/camera.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/scene.h"

namespace medial_vk::picture {

struct Panel {
  std::uint32_t left = 0;  // In the picture, pixels; panels are as high as the picture.
  std::uint32_t width = 0;
  bool balls = false;     // Otherwise the mesh with the discs.
  bool in_glass = false;  // The mesh with balls, inside and outside of it, instead of discs. The CPU alone draws this.
  // The painted surface alone or, in glass, inside and outside of the mesh instead of balls. The CPU alone draws this.
  bool painted = false;
};

/// A white picture of the size that the options choose.
Picture blank(const PictureOptions& options);

std::vector<Panel> panels_of(PictureShow show, std::uint32_t width);

/// Pixels of the picture per pixel of the letters, so that text is as legible in a large picture as in a small one.
inline std::uint32_t text_scale(const Picture& picture) {
  return std::max(1u, (std::min(picture.width, picture.height) + 225) / 450);
}

/// Margins around the shape, in samples, above the legend.
inline Frame frame_of(const Panel& panel, const Picture& picture, std::uint32_t samples) {
  const float w = static_cast<float>(panel.width * samples), h = static_cast<float>(picture.height * samples);
  const float legend =
      std::max(0.125f * h, std::min(46.0f * static_cast<float>(text_scale(picture) * samples), 0.3f * h));
  return {0.06f * w, 0.06f * h, 0.94f * w, h - legend};
}

/// The greatest distance, in pixels, at which a mark shades another mark.
constexpr float kGreatestReach = 32;
/// The same distance as a part of the radius of the shape.
constexpr float kReach = 0.12f;
/// The least radius of discs, in pixels.
constexpr float kLeastDiscRadius = 0.8f;

/// The visible balls, at most one for each pixel.
std::vector<Mark> panel_balls(const Scene& scene, const Panel& panel, const PictureView& view, const Picture& picture);

constexpr std::uint32_t kCpuSamples = 2;  // Per side.
/// 475 MiB of layers. The default picture is drawn in one band.
constexpr std::uint64_t kCpuSamplesAtOnce = 1u << 23;

/// Draws on the CPU, with 2 x 2 samples per pixel, into the panel's part of the picture. Bands of rows of
/// `samples_at_once` samples, with a few extra rows, keep memory independent of the size of the picture.
void draw_panel(const Scene& scene, const Panel& panel, const PictureView& view, Picture& picture,
                std::uint64_t samples_at_once = kCpuSamplesAtOnce);

enum class LegendCorner : std::uint8_t { kLowerRight, kLowerLeft };
void draw_legend(const Scene& scene, Picture& picture, LegendCorner corner = LegendCorner::kLowerRight);

}  // namespace medial_vk::picture
