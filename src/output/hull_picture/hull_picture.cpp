#include "output/hull_picture/hull_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "medial_vk/mesh.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"

namespace medial_vk {
namespace {

constexpr double kDrawnShare = 0.004;  // of the greatest radius: how far drawn triangles are from their hull

std::string title_of(const HullRecord& record) {
  const char* one[] = {"ball", "capsule", "cone-sphere", "slab"};
  const char* many[] = {"balls", "capsules", "cone-spheres", "slabs"};
  const std::array<std::size_t, 4> kinds = kinds_of(record.fit.hulls);
  std::string title;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (kinds[k] == 0) continue;
    title += fmt::format("{}{} {}", title.empty() ? "" : ", ", kinds[k], kinds[k] == 1 ? one[k] : many[k]);
  }
  return title;
}

/// The hull with radii that are smaller, by a share of their size that grows with its number but stays invisible: of
/// faces in one plane, as in a plate, the one of the first hull is seen, instead of a mixture.
BallHull set_back(BallHull hull, std::size_t number, std::size_t count) {
  constexpr double kMost = 0.02;
  const double share = kMost * static_cast<double>(number) / static_cast<double>(std::max<std::size_t>(count, 64));
  for (std::uint32_t i = 0; i < hull.count; ++i) hull.corners[i].radius *= 1 - share;
  return hull;
}

/// Colours only tell hulls apart: a text without one stands in the place of their bar.
picture::Legend legend_of(const HullRecord& record) {
  picture::Legend legend;
  legend.title = title_of(record);
  const std::optional<Bounds> share = uncovered_share(record);
  legend.swatches.emplace_back(std::numeric_limits<std::size_t>::max(),
                               share ? fmt::format("{:.3g} % of the volume uncovered", 100 * share->upper) : "inside");
  return legend;
}

}  // namespace

Result<Picture> draw_hulls(const HullRecord& record, const MeshView& solid, const PictureOptions& options) {
  Mesh shape;
  shape.vertices.assign(solid.vertices.begin(), solid.vertices.end());
  shape.triangles.assign(solid.triangles.begin(), solid.triangles.end());
  PictureOptions how = options;
  how.show = PictureShow::kPoints;
  how.colour = PictureColour::kSheet;
  picture::Scene scene = picture::make_scene(shape, {}, 0, how);
  picture::Surface& surface = scene.painted.surface;
  const std::vector<BallHull>& hulls = record.fit.hulls;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    double greatest = 0;
    for (const Ball& ball : hulls[i].balls()) greatest = std::max(greatest, ball.radius);
    if (!(greatest > 0)) continue;  // nothing to be seen
    const Result<Mesh> mesh = mesh_of(set_back(hulls[i], i, hulls.size()), kDrawnShare * greatest);
    if (!mesh) return mesh.error();
    const picture::Surface part = picture::make_surface(shape, mesh.value());
    surface.positions.insert(surface.positions.end(), part.positions.begin(), part.positions.end());
    surface.normals.insert(surface.normals.end(), part.normals.begin(), part.normals.end());
    const std::size_t colour = picture::sheet_colour_index(static_cast<std::int32_t>(i));
    scene.painted.light.resize(surface.positions.size(), picture::to_light(picture::sheet_colours()[colour]));
  }
  scene.legend = legend_of(record);
  Picture picture = picture::blank(how);
  const picture::Panel panel = {.width = picture.width, .in_glass = true, .painted = true};
  picture::draw_panel(scene, panel, how.view, picture);
  picture::draw_legend(scene, picture);
  return picture;
}

}  // namespace medial_vk
