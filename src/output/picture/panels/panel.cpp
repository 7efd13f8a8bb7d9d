// The lighting of a picture, on the CPU. shaders/compose.frag does the same: change both; the tests compare them.
#include "output/picture/panels/panel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "output/colours/colour_map.h"
#include "output/picture/panels/rasteriser.h"

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

const Vector3f kKeyLight = Vector3f(-0.45f, 0.65f, 0.62f).normalized();  // View space, towards the light.
const Vector3f kHalfway = (kKeyLight + Vector3f::UnitZ()).normalized();
// Linear light, not encoded values of a file.
const Vector3f kGlass(0.22f, 0.33f, 0.48f);
const Vector3f kWarmGlass(0.62f, 0.33f, 0.05f);
const Vector3f kColdGlass(0.05f, 0.30f, 0.70f);
const Vector3f kInk(0.04f, 0.055f, 0.08f);
const Vector3f kHaze(0.85f, 0.88f, 0.91f);
constexpr float kSurfaceCover = 0.95f;  // Of a painted surface in glass.
const Vector3f kLow(0.80f, 0.84f, 0.885f);

Vector3f mix(const Vector3f& a, const Vector3f& b, float share) { return a + share * (b - a); }

const Vector3f& glass_of(Tint tint) {
  return tint == Tint::kNone ? kGlass : tint == Tint::kWarm ? kWarmGlass : kColdGlass;
}

/// White with some grey at the bottom, as a ground for the shape.
Vector3f background(float height_share) { return mix(Vector3f::Ones(), kLow, height_share * height_share); }

float diffuse(const Vector3f& normal) { return std::max(normal.dot(kKeyLight), 0.0f); }
float highlight(const Vector3f& normal, float sharpness) {
  return std::pow(std::max(normal.dot(kHalfway), 0.0f), sharpness);
}

/// All layers of a panel, at the resolution of the samples.
struct Layers {
  Layers(std::uint32_t width, std::uint32_t height) : front(width, height), back(width, height), marks(width, height) {}
  SurfaceLayer front;
  SurfaceLayer back;
  MarkLayer marks;
};

class Composer {
 public:
  Composer(const Scene& scene, const Panel& panel, const Camera& camera, const Layers& layers)
      : balls_(panel.balls || panel.in_glass || panel.painted),
        in_glass_(panel.in_glass),
        painted_(panel.painted),
        camera_(camera),
        layers_(layers) {
    for (const Vector3f& colour : scene.palette) palette_.push_back(to_light(colour));
  }

  Vector3f sample(std::uint32_t x, std::uint32_t y, float height_share) const {
    const std::size_t pixel = std::size_t{y} * layers_.front.width + x;
    Vector3f colour = background(height_share);
    if (in_glass_) return mark_in_glass(colour, x, y, pixel);
    if (layers_.back.nearness[pixel] > 0)
      colour = over_back_wall(colour, layers_.back.normal[pixel], layers_.back.tint[pixel]);
    if (layers_.marks.surface.nearness[pixel] > 0) colour = mark(x, y, pixel);
    // A disc reaches in front of the wall only by its own size, so the wall is drawn in front of it.
    if (!painted_ && layers_.front.nearness[pixel] > 0)
      colour = over_front_wall(colour, layers_.front.normal[pixel], layers_.front.tint[pixel]);
    return on_line(x, y) ? mix(colour, kInk, 0.60f) : colour;
  }

 private:
  /// A ball or a painted surface may lie before both walls, between them or behind them. A surface shows a little of
  /// what is behind it, which it would hide altogether.
  Vector3f mark_in_glass(Vector3f colour, std::uint32_t x, std::uint32_t y, std::size_t pixel) const {
    const float back = layers_.back.nearness[pixel], front = layers_.front.nearness[pixel];
    const float nearness = layers_.marks.surface.nearness[pixel];
    const auto draw_mark = [&](bool is_next) {
      if (nearness > 0 && is_next) colour = mix(colour, mark(x, y, pixel), painted_ ? kSurfaceCover : 1.0f);
    };
    draw_mark(nearness <= back);
    if (back > 0) colour = over_back_wall(colour, layers_.back.normal[pixel], layers_.back.tint[pixel]);
    draw_mark(nearness > back && nearness <= front);
    if (front > 0) colour = over_front_wall(colour, layers_.front.normal[pixel], layers_.front.tint[pixel]);
    if (on_line(x, y)) colour = mix(colour, kInk, 0.60f);
    draw_mark(nearness > std::max(back, front));
    return colour;
  }

  Vector3f palette_colour(float value) const {
    const std::size_t below = std::min(static_cast<std::size_t>(value), palette_.size() - 1);
    const std::size_t above = std::min(below + 1, palette_.size() - 1);
    return mix(palette_[below], palette_[above], value - static_cast<float>(below));
  }

  /// The far wall of the glass, seen from inside.
  static Vector3f over_back_wall(const Vector3f& below, const Vector3f& normal, Tint tint) {
    const float facing = std::min(std::abs(normal.z()), 1.0f);
    const float light = 0.62f + 0.55f * diffuse(-normal);
    return mix(below, glass_of(tint) * light, 0.12f + 0.30f * (1.0f - facing));
  }

  /// A disc or a ball, lit by the sky, which nearby marks occlude, and by a lamp. Discs are darker at the rim, which
  /// distinguishes them, and paler farther away.
  Vector3f mark(std::uint32_t x, std::uint32_t y, std::size_t pixel) const {
    const Vector3f& normal = layers_.marks.surface.normal[pixel];
    const Vector3f colour = painted_ ? layers_.marks.paint[pixel] : palette_colour(layers_.marks.value[pixel]);
    const float open = openness(x, y, pixel);
    const float sky = 0.50f + 0.14f * normal.y();
    const float rim = layers_.marks.rim[pixel];
    const float edge = 1.0f - 0.22f * rim * rim * rim;
    const Vector3f lit = colour * (open * edge * (sky + 0.62f * diffuse(normal)));
    if (balls_) return lit + Vector3f::Constant(0.10f * open * highlight(normal, 40.0f));
    const float depth = (Camera::greatest_nearness() - layers_.marks.surface.nearness[pixel]) /
                        (Camera::greatest_nearness() - Camera::least_nearness());
    return mix(lit, kHaze, 0.05f * std::clamp(depth, 0.0f, 1.0f));
  }

  /// The part of the sky that neighbours leave visible: 1 on an open plain. Eight positions around the sample are
  /// tested, different ones for each sample of a pixel, on one spiral.
  float openness(std::uint32_t x, std::uint32_t y, std::size_t pixel) const {
    constexpr int kPositions = 8;
    const SurfaceLayer& surface = layers_.marks.surface;
    const float nearness = surface.nearness[pixel];
    const float unit = camera_.scale_at(nearness);
    const float reach = std::min(kReach * unit, kGreatestReach * kCpuSamples);
    const std::uint32_t number = y % kCpuSamples * kCpuSamples + x % kCpuSamples;
    constexpr float kAll = kPositions * kCpuSamples * kCpuSamples;
    float taken = 0;
    for (int i = 0; i < kPositions; ++i) {
      const float index = static_cast<float>(i) * kCpuSamples * kCpuSamples + static_cast<float>(number) + 0.5f;
      const float angle = 2.39996323f * index, radius = reach * std::sqrt(index / kAll);
      const int dx = static_cast<int>(std::lround(radius * std::cos(angle)));
      const int dy = static_cast<int>(std::lround(radius * std::sin(angle)));
      taken += taken_by(x, y, dx, dy, nearness, unit, reach, surface.normal[pixel]);
    }
    return 1.0f - 0.85f * std::min(1.6f * taken / kPositions, 1.0f);
  }

  float taken_by(std::uint32_t x, std::uint32_t y, int dx, int dy, float nearness, float unit, float reach,
                 const Vector3f& normal) const {
    const SurfaceLayer& surface = layers_.marks.surface;
    const std::int64_t there_x = std::int64_t{x} + dx, there_y = std::int64_t{y} + dy;
    if (there_x < 0 || there_y < 0 || there_x >= surface.width || there_y >= surface.height) return 0;
    const float there = surface.nearness[static_cast<std::size_t>(there_y * surface.width + there_x)];
    if (there == 0) return 0;
    const Vector3f to(static_cast<float>(dx) / unit, static_cast<float>(-dy) / unit, 1.0f / nearness - 1.0f / there);
    const float length = to.norm();
    if (!(length > 0)) return 0;
    const float share = length * unit / reach;
    return std::max(normal.dot(to) / length - 0.08f, 0.0f) / (1.0f + share * share);
  }

  /// The near wall: clear where it faces the viewer, denser towards the outline (Schlick's curve), with a highlight.
  static Vector3f over_front_wall(const Vector3f& below, const Vector3f& normal, Tint tint) {
    const Vector3f outward = normal.z() < 0 ? (-normal).eval() : normal;
    const float grazing = 1.0f - std::min(outward.z(), 1.0f);
    const float cover = 0.02f + 0.72f * grazing * grazing * grazing;
    const float light = 0.62f + 0.62f * diffuse(outward);
    const Vector3f glass = mix(below, (glass_of(tint) * light).cwiseMin(1.0f), cover);
    return mix(glass, Vector3f::Ones(), 0.30f * highlight(outward, 48.0f));
  }

  /// True if the near wall ends, bends sharply or becomes that of another solid within half a pixel to the right or
  /// below. Drawn as a thin line, this shows the outline and the creases of the shape.
  bool on_line(std::uint32_t x, std::uint32_t y) const {
    constexpr float kCrease = 0.80f;
    constexpr std::uint32_t kStep = kCpuSamples / 2;
    const SurfaceLayer& wall = layers_.front;
    const std::size_t pixel = std::size_t{y} * wall.width + x;
    const bool here = wall.nearness[pixel] > 0;
    const auto ends_before = [&](std::size_t step) {
      const bool there = wall.nearness[pixel + step] > 0;
      if (here != there || wall.tint[pixel] != wall.tint[pixel + step]) return true;
      return here && wall.normal[pixel].dot(wall.normal[pixel + step]) < kCrease;
    };
    return (x + kStep < wall.width && ends_before(kStep)) ||
           (y + kStep < wall.height && ends_before(std::size_t{kStep} * wall.width));
  }

  bool balls_, in_glass_, painted_;
  const Camera& camera_;
  const Layers& layers_;
  std::vector<Vector3f> palette_;
};

/// Rows of a picture.
struct Band {
  std::uint32_t top = 0, height = 0;
};

/// The balls that are visible in the band, with the part in which each is visible.
std::vector<Mark> balls_in(const std::vector<Mark>& balls, const Band& band) {
  const auto top = static_cast<float>(band.top), height = static_cast<float>(band.height);
  std::vector<Mark> out;
  for (Mark ball : balls) {
    ball.seen.top = std::max(ball.seen.top - top, 0.0f);
    ball.seen.bottom = std::min(ball.seen.bottom - top, height);
    if (ball.seen.top < ball.seen.bottom) out.push_back(ball);
  }
  return out;
}

/// The layers of a band.
void draw_layers(const Scene& scene, const Panel& panel, const Camera& camera, const std::vector<Mark>& balls,
                 const Band& band, Layers& layers) {
  if (panel.painted && !panel.in_glass) {
    draw_mesh(scene.mesh, camera, Keep::kNearest, layers.front);
    draw_painted(scene.painted, camera, layers.marks);
  } else if (panel.balls) {
    draw_balls(balls_in(balls, band), camera, kCpuSamples, layers.marks);
  } else {
    draw_mesh(scene.mesh, camera, Keep::kNearest, layers.front);
    draw_mesh(scene.mesh, camera, Keep::kFarthest, layers.back);
    if (panel.painted) {
      draw_painted(scene.painted, camera, layers.marks);
    } else if (panel.in_glass) {
      draw_balls(balls_in(balls, band), camera, kCpuSamples, layers.marks);
    } else {
      draw_discs(scene.discs, camera, kLeastDiscRadius * kCpuSamples, layers.marks);
    }
  }
}

/// Draws with rows above and below that may shade the band: kGreatestReach, and one for lines.
void draw_band(const Scene& scene, const Panel& panel, const Camera& camera, const std::vector<Mark>& balls,
               const Band& band, Picture& picture) {
  constexpr std::uint32_t kBorder = static_cast<std::uint32_t>(kGreatestReach) + 1;
  const std::uint32_t top = band.top - std::min(band.top, kBorder);
  const std::uint32_t bottom = std::min(band.top + band.height + kBorder, picture.height);
  const Camera below = camera.below(static_cast<float>(top * kCpuSamples));
  Layers layers(panel.width * kCpuSamples, (bottom - top) * kCpuSamples);
  draw_layers(scene, panel, below, balls, {top, bottom - top}, layers);
  const Composer composer(scene, panel, below, layers);
  constexpr float kShare = 1.0f / (kCpuSamples * kCpuSamples);
  for (std::uint32_t y = band.top; y < band.top + band.height; ++y) {
    const float height_share = (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.height);
    for (std::uint32_t x = 0; x < panel.width; ++x) {
      Vector3f sum = Vector3f::Zero();
      for (std::uint32_t i = 0; i < kCpuSamples * kCpuSamples; ++i) {
        sum +=
            composer.sample(x * kCpuSamples + i % kCpuSamples, (y - top) * kCpuSamples + i / kCpuSamples, height_share)
                .cwiseMin(1.0f);
      }
      const Vector3f colour = to_srgb(sum * kShare);
      std::uint8_t* out = &picture.rgb[(std::size_t{y} * picture.width + panel.left + x) * 3];
      for (Eigen::Index channel = 0; channel < 3; ++channel) out[channel] = byte_of(colour[channel]);
    }
  }
}

/// A disc with a dark rim and a white one around it, which are visible on every colour.
void draw_on_top(const Mark& mark, const Scene& scene, const Panel& panel, const Camera& camera, Picture& picture) {
  const ScreenPoint at = camera.project(mark.centre);
  const float middle_x = at.x / kCpuSamples, middle_y = at.y / kCpuSamples;
  // Two rims around a small mark are as wide as the mark, and those around a large one as wide as letters are thick.
  const float radius = std::max(mark.radius * camera.scale_at(at.nearness) / kCpuSamples, 1.5f);
  const float rim = std::min(1.5f * static_cast<float>(text_scale(picture)), 0.5f * radius);
  const Vector3f& fill = scene.palette[static_cast<std::size_t>(mark.value)];
  const auto width = static_cast<float>(panel.width), height = static_cast<float>(picture.height);
  const float reach = radius + 2 * rim + 1;
  const auto begin = [&](float middle) { return static_cast<std::uint32_t>(std::max(middle - reach, 0.0f)); };
  const auto end = [&](float middle, float size) {
    return static_cast<std::uint32_t>(std::clamp(middle + reach, 0.0f, size));
  };
  for (std::uint32_t y = begin(middle_y); y < end(middle_y, height); ++y) {
    for (std::uint32_t x = begin(middle_x); x < end(middle_x, width); ++x) {
      const float away = std::hypot(static_cast<float>(x) + 0.5f - middle_x, static_cast<float>(y) + 0.5f - middle_y);
      std::uint8_t* out = &picture.rgb[(std::size_t{y} * picture.width + panel.left + x) * 3];
      Vector3f colour = Vector3f(out[0], out[1], out[2]) / 255.0f;
      const auto disc = [&](float to, const Vector3f& of_disc) {
        colour = mix(colour, of_disc, std::clamp(to - away + 0.5f, 0.0f, 1.0f));
      };
      disc(radius + 2 * rim, Vector3f::Ones());
      disc(radius + rim, to_srgb(kInk));
      disc(radius, fill);
      for (Eigen::Index channel = 0; channel < 3; ++channel) out[channel] = byte_of(colour[channel]);
    }
  }
}

}  // namespace

Picture blank(const PictureOptions& options) {
  Picture out;
  const std::uint32_t usual_width = options.show == PictureShow::kBoth ? 1800 : 1200;
  out.width = options.size[0] != 0 ? options.size[0] : usual_width;
  out.height = options.size[1] != 0 ? options.size[1] : 900;
  out.rgb.assign(std::size_t{out.width} * out.height * 3, 255);
  return out;
}

std::vector<Panel> panels_of(PictureShow show, std::uint32_t width) {
  if (show != PictureShow::kBoth) return {{0, width, show == PictureShow::kBalls, false}};
  return {{0, width / 2, false, false}, {width / 2, width - width / 2, true, false}};
}

std::vector<Mark> panel_balls(const Scene& scene, const Panel& panel, const PictureView& view, const Picture& picture) {
  const Camera camera(scene.in_frame(), view, frame_of(panel, picture, 1));
  return seen_balls(scene.balls, camera, panel.width, picture.height);
}

void draw_panel(const Scene& scene, const Panel& panel, const PictureView& view, Picture& picture,
                std::uint64_t samples_at_once) {
  const Camera camera(scene.in_frame(), view, frame_of(panel, picture, kCpuSamples));
  const bool has_balls = panel.balls || panel.in_glass;
  const std::vector<Mark> balls = has_balls ? panel_balls(scene, panel, view, picture) : std::vector<Mark>();
  const std::uint64_t samples_of_row = std::uint64_t{kCpuSamples} * kCpuSamples * panel.width;
  const auto rows = static_cast<std::uint32_t>(std::max<std::uint64_t>(samples_at_once / samples_of_row, 1));
  for (std::uint32_t top = 0; top < picture.height; top += std::min(rows, picture.height - top)) {
    draw_band(scene, panel, camera, balls, {top, std::min(rows, picture.height - top)}, picture);
  }
  for (const Mark& mark : scene.on_top) draw_on_top(mark, scene, panel, camera, picture);
}

}  // namespace medial_vk::picture
