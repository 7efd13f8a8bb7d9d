#include "output/picture/body_picture.h"

#include <fmt/format.h>

#include <vector>

#include "medial_vk/medial_spheres.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"

namespace medial_vk {
namespace {

// Colours of sheets, by number.
constexpr int kOfInside = 0, kOfCover = 1;

/// The mesh with one set of balls in one colour.
picture::Scene scene_of(const Mesh& mesh, std::span<const Ball> balls, int colour, const PictureView& view) {
  std::vector<MedialSphere> marks;
  for (const Ball& ball : balls) {
    MedialSphere mark{};
    mark.centre = ball.centre;
    mark.radius = ball.radius;
    mark.sheet = colour;
    marks.push_back(mark);
  }
  PictureOptions options;
  options.view = view;
  options.show = PictureShow::kBalls;
  options.colour = PictureColour::kSheet;
  return picture::make_scene(mesh, marks, 0, options);
}

}  // namespace

Picture draw_body(const Mesh& mesh, std::span<const Ball> inside, std::span<const Ball> cover,
                  const PictureView& view) {
  Picture out;
  out.width = 1800;
  out.height = 900;
  out.rgb.assign(std::size_t{out.width} * out.height * 3, 255);
  const std::uint32_t half = out.width / 2;
  picture::draw_panel(scene_of(mesh, inside, kOfInside, view), {0, half, false, true}, view, out);
  picture::Scene scene = scene_of(mesh, cover, kOfCover, view);
  picture::draw_panel(scene, {half, half, true, false}, view, out);
  scene.legend.title = "spheres";
  scene.legend.swatches = {{picture::sheet_colour_index(kOfInside), fmt::format("{} inside", inside.size())},
                           {picture::sheet_colour_index(kOfCover), fmt::format("{} that cover", cover.size())}};
  picture::draw_legend(scene, out);
  return out;
}

}  // namespace medial_vk
