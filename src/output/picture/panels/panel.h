// A part of a picture that shows one thing, and what both ways of drawing it have in common.
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
  bool balls = false;  // Else the mesh with the discs.
};

std::vector<Panel> panels_of(PictureShow show, std::uint32_t width);

/// Pixels of the picture per pixel of the letters: text of a large picture is read as well as that of a small one.
inline std::uint32_t text_scale(const Picture& picture) {
  return std::max(1u, (std::min(picture.width, picture.height) + 225) / 450);
}

/// Margins around the shape, in samples; the legend is below it.
inline Frame frame_of(const Panel& panel, const Picture& picture, std::uint32_t samples) {
  const float w = static_cast<float>(panel.width * samples), h = static_cast<float>(picture.height * samples);
  const float legend =
      std::max(0.125f * h, std::min(46.0f * static_cast<float>(text_scale(picture) * samples), 0.3f * h));
  return {0.06f * w, 0.06f * h, 0.94f * w, h - legend};
}

/// The greatest distance, in pixels, at which something takes light from a mark.
constexpr float kGreatestReach = 32;
/// The same as a part of the shape's radius.
constexpr float kReach = 0.12f;
/// Discs are never smaller, pixels.
constexpr float kLeastDiscRadius = 0.8f;

/// The balls that are seen, at most one for each pixel.
std::vector<Mark> panel_balls(const Scene& scene, const Panel& panel, const PictureView& view, const Picture& picture);

constexpr std::uint32_t kCpuSamples = 2;  // Per side.
/// 450 MiB of layers. The usual picture is drawn at once.
constexpr std::uint64_t kCpuSamplesAtOnce = 1u << 23;

/// On the CPU, 2 x 2 samples per pixel, into the panel's part of the picture. In bands of rows of so many samples, and
/// some rows more, so that memory does not grow with the picture.
void draw_panel(const Scene& scene, const Panel& panel, const PictureView& view, Picture& picture,
                std::uint64_t samples_at_once = kCpuSamplesAtOnce);

/// Into the lower right corner.
void draw_legend(const Scene& scene, Picture& picture);

}  // namespace medial_vk::picture
