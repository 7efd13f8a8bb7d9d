// The legend: a bar of the colours with numbers at its ends, or the colours of sheets with their numbers.
#include <algorithm>
#include <cmath>

#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/text.h"

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

const Vector3f kLetters(0.22f, 0.25f, 0.30f);

class Pen {
 public:
  explicit Pen(Picture& picture) : picture_(picture), scale_(text_scale(picture)) {}

  std::uint32_t scale() const { return scale_; }
  std::uint32_t line() const { return (kGlyphHeight + 3) * scale_; }
  std::uint32_t width_of(const std::string& text) const { return text_width(text) * scale_; }

  void fill(std::uint32_t left, std::uint32_t top, std::uint32_t width, std::uint32_t height, const Vector3f& colour) {
    for (std::uint32_t i = 0; i < width * height; ++i) set(left + i % width, top + i / width, colour);
  }

  void write(std::uint32_t left, std::uint32_t top, const std::string& text) {
    draw_text(text, [&](std::uint32_t x, std::uint32_t y) {
      fill(left + x * scale_, top + y * scale_, scale_, scale_, kLetters);
    });
  }

 private:
  void set(std::uint32_t x, std::uint32_t y, const Vector3f& colour) {
    if (x >= picture_.width || y >= picture_.height) return;
    for (Eigen::Index channel = 0; channel < 3; ++channel) {
      picture_.rgb[(std::size_t{y} * picture_.width + x) * 3 + static_cast<std::size_t>(channel)] =
          byte_of(colour[channel]);
    }
  }

  Picture& picture_;
  std::uint32_t scale_;
};

Vector3f palette_colour(const std::vector<Vector3f>& palette, float share) {
  const float position = share * static_cast<float>(palette.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), palette.size() - 2);
  return palette[below] + (position - static_cast<float>(below)) * (palette[below + 1] - palette[below]);
}

void draw_bar(const Scene& scene, Pen& pen, std::uint32_t left, std::uint32_t top, std::uint32_t width) {
  const std::uint32_t height = 7 * pen.scale();
  for (std::uint32_t x = 0; x < width; ++x) {
    const float share = static_cast<float>(x) / static_cast<float>(width - 1);
    pen.fill(left + x, top, 1, height, palette_colour(scene.palette, share));
  }
  const std::uint32_t below = top + height + 3 * pen.scale();
  pen.write(left, below, scene.legend.least);
  pen.write(left + width - pen.width_of(scene.legend.greatest) + pen.scale(), below, scene.legend.greatest);
}

/// What swatches take up, in pixels and in rows.
struct Extent {
  std::uint32_t width = 0, rows = 1;
};

/// Calls `visit(swatch, left, row)` for each swatch. A row ends before it would be wider than `most`.
template <typename Visit>
Extent lay_out_swatches(const Scene& scene, const Pen& pen, std::uint32_t most, const Visit& visit) {
  Extent whole;
  std::uint32_t left = 0;
  for (const auto& swatch : scene.legend.swatches) {
    const bool has_colour = swatch.first < scene.palette.size();
    const std::uint32_t width = pen.width_of(swatch.second) + (has_colour ? 15 : 5) * pen.scale();
    if (left > 0 && left + width > most) {
      left = 0;
      ++whole.rows;
    }
    visit(swatch, left, whole.rows - 1);
    left += width;
    whole.width = std::max(whole.width, left);
  }
  return whole;
}

void draw_swatches(const Scene& scene, Pen& pen, std::uint32_t left, std::uint32_t top, std::uint32_t most) {
  const std::uint32_t side = 7 * pen.scale();
  lay_out_swatches(scene, pen, most, [&](const auto& swatch, std::uint32_t x, std::uint32_t row) {
    const auto& [colour, text] = swatch;
    std::uint32_t at = left + x;
    if (colour < scene.palette.size()) {
      pen.fill(at, top + row * pen.line(), side, side, scene.palette[colour]);
      at += side + 3 * pen.scale();
    }
    pen.write(at, top + row * pen.line(), text);
  });
}

}  // namespace

void draw_legend(const Scene& scene, Picture& picture, LegendCorner corner) {
  Pen pen(picture);
  const bool has_bar = scene.legend.swatches.empty();
  const std::uint32_t margin = 16 * pen.scale();
  if (picture.width <= 2 * margin) return;
  const std::uint32_t most = picture.width - 2 * margin;
  const Extent swatches = lay_out_swatches(scene, pen, most, [](const auto&, std::uint32_t, std::uint32_t) {});
  const std::uint32_t without_note =
      std::max(has_bar ? 130 * pen.scale() : swatches.width, pen.width_of(scene.legend.title));
  const std::uint32_t width = std::max(without_note, pen.width_of(scene.legend.note));
  const std::uint32_t lines = 1 + swatches.rows + (scene.legend.note.empty() ? 0 : 1);
  const std::uint32_t height = lines * pen.line() + 10 * pen.scale();
  // Several rows may cover a part of the shape, but no more than a quarter of the picture.
  const bool is_too_high = swatches.rows > 1 && 4 * (height + margin / 2) > picture.height;
  if (width > most || picture.height < height + 2 * margin || is_too_high) return;  // no room
  const std::uint32_t left = corner == LegendCorner::kLowerLeft ? margin : picture.width - margin - width;
  const std::uint32_t top = picture.height - margin / 2 - height;
  pen.write(left, top, scene.legend.title);
  if (has_bar) {
    draw_bar(scene, pen, left, top + pen.line(), without_note);
    pen.write(left, top + 2 * pen.line() + 10 * pen.scale(), scene.legend.note);
  } else {
    draw_swatches(scene, pen, left, top + pen.line(), most);
    pen.write(left, top + (1 + swatches.rows) * pen.line(), scene.legend.note);
  }
}

}  // namespace medial_vk::picture
