#include "output/picture/motion_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kCellWidth = 480, kCellHeight = 400;

std::vector<const FollowedFrame*> shown_frames(const MotionRecord& record) {
  std::vector<const FollowedFrame*> known, shown;
  for (const FollowedFrame& frame : record.frames) {
    if (!frame.vertices.empty()) known.push_back(&frame);
  }
  const std::size_t count = std::min(known.size(), kMostMotionPictures);
  for (std::size_t i = 0; i < count; ++i) shown.push_back(known[count == 1 ? 0 : i * (known.size() - 1) / (count - 1)]);
  return shown;
}

/// The corners of the box around all shown frames and their balls, which may reach out. Every cell has them, so that
/// the camera stays where it is.
std::vector<Point> common_corners(std::span<const FollowedFrame* const> frames) {
  const std::array<float, 3>& first = frames.front()->vertices.front();
  Point lower = {first[0], first[1], first[2]}, upper = lower;
  const auto extend = [&](std::size_t axis, double from, double to) {
    lower[axis] = std::min(lower[axis], from);
    upper[axis] = std::max(upper[axis], to);
  };
  for (const FollowedFrame* frame : frames) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const auto& vertex : frame->vertices) extend(k, vertex[k], vertex[k]);
      for (const Ball& ball : frame->balls) {
        if (ball.radius > 0) extend(k, ball.centre[k] - ball.radius, ball.centre[k] + ball.radius);
      }
    }
  }
  std::vector<Point> corners;
  for (unsigned i = 0; i < 8; ++i) {
    Point corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = i >> k & 1u ? upper[k] : lower[k];
    corners.push_back(corner);
  }
  return corners;
}

/// Of a sheet, by the number of the state in files. Steady balls of a cover have the colour of medial ones, grown ones
/// that of shrunk ones.
int colour_of_state(const MotionRecord& record, std::size_t state) {
  constexpr int kOfBallsInside[] = {1, 5, 4, 0}, kOfCovers[] = {1, 4, 0};
  return record.covers ? kOfCovers[state] : kOfBallsInside[state];
}

std::string title_of(const MotionRecord& record, const FollowedFrame& frame) {
  constexpr std::size_t kMost = 28;
  std::string name = frame.short_name;
  if (name.size() > kMost) name = ".." + name.substr(name.size() - kMost + 2);
  if (!record.has_volume) return name;
  const char* const word = frame.cover ? "added" : "uncovered";
  const double percent = frame.error_percent();
  if (!std::isfinite(percent)) return fmt::format("{}: {} % not known", name, word);
  return fmt::format("{}: {:.2f} % {}", name, percent, word);
}

Picture draw_cell(const MotionRecord& record, const FollowedFrame& frame, const std::vector<Point>& corners,
                  const PictureView& view) {
  Mesh mesh;
  mesh.triangles = record.triangles;
  for (const auto& v : frame.vertices) mesh.vertices.push_back({v[0], v[1], v[2]});
  for (const Point& corner : corners) {
    // The camera is fitted to triangles; one without an area is not seen.
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(corner);
    mesh.triangles.push_back({last, last, last});
  }
  const std::vector<std::uint8_t> states = state_numbers(frame);
  std::vector<MedialSphere> marks;
  for (std::size_t i = 0; i < frame.balls.size(); ++i) {
    if (!(frame.balls[i].radius > 0)) continue;
    MedialSphere mark{};
    mark.centre = frame.balls[i].centre;
    mark.radius = frame.balls[i].radius;
    mark.sheet = colour_of_state(record, states[i]);
    marks.push_back(mark);
  }
  PictureOptions options;
  options.view = view;
  options.show = PictureShow::kBalls;
  options.colour = PictureColour::kSheet;
  picture::Scene scene = picture::make_scene(mesh, marks, 0, options);
  scene.legend.title = title_of(record, frame);
  scene.legend.swatches.clear();
  const std::vector<std::size_t> counts = state_counts(record, frame);
  for (std::size_t state = 0; state + 1 < counts.size(); ++state) {
    if (counts[state] == 0) continue;
    scene.legend.swatches.emplace_back(picture::sheet_colour_index(colour_of_state(record, state)),
                                       fmt::format("{} {}", counts[state], state_names(record)[state]));
  }
  if (scene.legend.swatches.empty()) scene.legend.swatches.emplace_back(scene.palette.size(), "no ball");
  Picture cell;
  cell.width = kCellWidth;
  cell.height = kCellHeight;
  cell.rgb.assign(std::size_t{cell.width} * cell.height * 3, 255);
  picture::draw_panel(scene, {0, cell.width, false, true}, view, cell);
  picture::draw_legend(scene, cell, picture::LegendCorner::kLowerLeft);
  return cell;
}

}  // namespace

Picture draw_motion(const MotionRecord& record, const PictureView& view) {
  const std::vector<const FollowedFrame*> frames = shown_frames(record);
  const std::vector<Point> corners = common_corners(frames);
  // Four in a row, or as many rows as columns where there are fewer.
  const auto count = static_cast<std::uint32_t>(frames.size());
  const std::uint32_t columns = count > 6 ? 4 : count > 4 ? 3 : count > 1 ? 2 : 1;
  Picture sheet;
  sheet.width = columns * kCellWidth;
  sheet.height = (count + columns - 1) / columns * kCellHeight;
  sheet.rgb.assign(std::size_t{sheet.width} * sheet.height * 3, 255);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Picture cell = draw_cell(record, *frames[i], corners, view);
    for (std::uint32_t y = 0; y < kCellHeight; ++y) {
      const std::size_t row = std::size_t{i / columns * kCellHeight + y} * sheet.width + i % columns * kCellWidth;
      std::copy_n(cell.rgb.begin() + std::ptrdiff_t{3} * y * kCellWidth, 3 * kCellWidth,
                  sheet.rgb.begin() + static_cast<std::ptrdiff_t>(3 * row));
    }
  }
  return sheet;
}

}  // namespace medial_vk
