#include "output/site_picture/site_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "medial_vk/medial_spheres.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"
#include "output/site_shapes/site_shapes.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;

constexpr double kPathShare = 0.004;  // of the diagonal of the box: the radius of the path
constexpr std::size_t kMostPairsNamed = 6;
constexpr std::size_t kMostLetters = 64;  // of their names, which are in one row
constexpr std::size_t kMostLettersOfAName = 16;

Vector3d vector_of(const Point& p) { return Vector3d(p.data()); }
Point point_of(const Vector3d& v) { return {v[0], v[1], v[2]}; }

/// Points as the discs of sheets that are numbered by pair.
std::vector<MedialSphere> discs_of(const SiteRecord& record) {
  std::map<std::array<std::uint32_t, 2>, std::int32_t> numbers;
  for (const SitePair& pair : pairs_of(record.voronoi)) {
    numbers.try_emplace(pair.sites, static_cast<std::int32_t>(numbers.size()));
  }
  std::vector<MedialSphere> discs;
  discs.reserve(record.voronoi.points.size());
  for (const SitePoint& p : record.voronoi.points) {
    MedialSphere disc{};
    disc.centre = p.point;
    disc.radius = p.distance;
    const Point a = spoke_of(p, 0), b = spoke_of(p, 1);
    for (std::size_t k = 0; k < 3; ++k) {
      disc.spoke_a[k] = static_cast<float>(a[k]);
      disc.spoke_b[k] = static_cast<float>(b[k]);
    }
    disc.object_angle = static_cast<float>(p.object_angle);
    const auto number = numbers.find({p.sites[0], p.sites[1]});
    disc.sheet = number == numbers.end() ? -1 : number->second;
    disc.voxel = p.voxel;
    discs.push_back(disc);
  }
  return discs;
}

std::string short_name(const std::string& name) {
  return name.size() <= kMostLettersOfAName ? name : name.substr(0, kMostLettersOfAName - 2) + "..";
}

/// The pairs with the largest areas, in one row.
void name_pairs(const SiteRecord& record, picture::Legend& legend) {
  legend = {};
  legend.title = fmt::format("{} points between {} sites", record.voronoi.points.size(), record.sites.size());
  const std::vector<SitePair> pairs = pairs_of(record.voronoi);
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return pairs[a].area > pairs[b].area; });
  std::size_t letters = 0;
  for (const std::size_t i : order) {
    const std::string text = fmt::format("{} and {}", short_name(record.sites[pairs[i].sites[0]].name),
                                         short_name(record.sites[pairs[i].sites[1]].name));
    letters += text.size();
    const std::size_t named = legend.swatches.size();
    if (named == kMostPairsNamed || (named > 0 && letters > kMostLetters)) {
      // Without a colour.
      legend.swatches.emplace_back(std::numeric_limits<std::size_t>::max(),
                                   fmt::format("and {} more", pairs.size() - named));
      break;
    }
    legend.swatches.emplace_back(picture::sheet_colour_index(static_cast<std::int32_t>(i)), text);
  }
  if (record.path) legend.note = fmt::format("path: a ball of radius {:.4g} passes", record.path->width);
}

/// On top of everything, since it is what the picture is for.
void add_path(const SitePath& path, const Mesh& mesh, double radius, picture::Scene& scene) {
  const std::size_t colour = scene.palette.size();
  scene.palette.emplace_back(0.85f, 0.1f, 0.1f);
  for (std::size_t i = 1; i < path.line.size(); ++i) {
    const Vector3d a = vector_of(path.line[i - 1]), b = vector_of(path.line[i]);
    const int count = static_cast<int>(std::clamp(std::ceil((b - a).norm() / (5 * radius)), 1.0, 2000.0));
    for (int k = 0; k <= count; ++k) {
      scene.on_top.push_back(picture::make_mark(mesh, point_of(a + (b - a) * k / count), radius, colour));
    }
  }
}

}  // namespace

Picture draw_sites(const SiteRecord& record, std::span<const VoronoiSite> sites, const PictureOptions& options) {
  // The picture shows the whole box.
  const Mesh shapes = mesh_of_sites(record.voronoi.grid, sites, BoxCorners::kMarked);
  PictureOptions how = options;
  how.show = PictureShow::kPoints;
  how.colour = PictureColour::kSheet;
  picture::Scene scene = picture::make_scene(shapes, discs_of(record), record.voronoi.grid.side, how);
  name_pairs(record, scene.legend);
  if (record.path) add_path(*record.path, shapes, kPathShare * diagonal_of(record.voronoi.grid), scene);
  Picture picture = picture::blank(how);
  for (const picture::Panel& panel : picture::panels_of(how.show, picture.width)) {
    picture::draw_panel(scene, panel, how.view, picture);
  }
  picture::draw_legend(scene, picture);
  return picture;
}

}  // namespace medial_vk
