#include "output/site_picture/site_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include "medial_vk/mesh.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"
#include "output/site_shapes/site_shapes.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;

constexpr double kPathShare = 0.004;   // of the diagonal of the box: the radius of the path
constexpr double kSplatRadius = 0.75;  // In voxels: those of neighbouring voxels overlap.
constexpr std::size_t kMostPairsNamed = 6;
constexpr std::size_t kMostLetters = 64;  // of their names, which are in one row
constexpr std::size_t kMostLettersOfAName = 16;

Vector3d vector_of(const Point& p) { return Vector3d(p.data()); }
Point point_of(const Vector3d& v) { return {v[0], v[1], v[2]}; }

/// The faces, and a splat in the plane between its first two contacts for each point without one; triangles with the
/// number of their pair, or -1 of a pair without faces.
class SurfaceMesh {
 public:
  explicit SurfaceMesh(const SiteVoronoi& voronoi) {
    for (const SitePair& pair : pairs_of(voronoi)) {
      numbers_.try_emplace(pair.sites, static_cast<std::int32_t>(numbers_.size()));
    }
    for (const SitePoint& p : voronoi.points) mesh_.vertices.push_back(p.point);
    for (const SiteFace& face : voronoi.faces) add_ring(corners_of(face), face.sites);
    const std::vector<std::int32_t> pieces = piece_of_points(voronoi);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i] < 0) add_splat(voronoi.points[i], kSplatRadius * voronoi.grid.side);
    }
  }

  const Mesh& mesh() const { return mesh_; }
  const std::vector<std::int32_t>& numbers() const { return number_of_triangle_; }

 private:
  void add_ring(const std::vector<std::uint32_t>& ring, const std::array<std::uint32_t, 2>& sites) {
    const auto number = numbers_.find(sites);
    for (std::size_t i = 2; i < ring.size(); ++i) {
      mesh_.triangles.push_back({ring[0], ring[i - 1], ring[i]});
      number_of_triangle_.push_back(number == numbers_.end() ? -1 : number->second);
    }
  }

  void add_splat(const SitePoint& p, double radius) {
    constexpr int kSides = 8;
    const Vector3d across = vector_of(spoke_of(p, 1)) - vector_of(spoke_of(p, 0));
    if (!(across.norm() > 0)) return;
    const Vector3d u = across.unitOrthogonal(), v = across.normalized().cross(u);
    std::vector<std::uint32_t> ring;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      ring.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
      mesh_.vertices.push_back(
          point_of(vector_of(p.point) + std::min(radius, p.distance) * (std::cos(angle) * u + std::sin(angle) * v)));
    }
    add_ring(ring, {p.sites[0], p.sites[1]});
  }

  std::map<std::array<std::uint32_t, 2>, std::int32_t> numbers_;
  Mesh mesh_;
  std::vector<std::int32_t> number_of_triangle_;
};

/// In the units of the camera that has `framed` in its frame.
picture::Painted paint_surface(const SiteVoronoi& voronoi, const Mesh& framed) {
  const SurfaceMesh surface(voronoi);
  picture::Painted painted;
  painted.surface = picture::make_surface(framed, surface.mesh());
  painted.two_sided = true;
  painted.light.reserve(painted.surface.positions.size());
  for (const std::int32_t number : surface.numbers()) {
    const Eigen::Vector3f light = picture::to_light(picture::sheet_colours()[picture::sheet_colour_index(number)]);
    painted.light.insert(painted.light.end(), 3, light);
  }
  return painted;
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
  picture::Scene scene = picture::make_scene(shapes, {}, 0, how);
  scene.painted = paint_surface(record.voronoi, shapes);
  name_pairs(record, scene.legend);
  if (record.path) add_path(*record.path, shapes, kPathShare * diagonal_of(record.voronoi.grid), scene);
  Picture picture = picture::blank(how);
  const picture::Panel panel = {.width = picture.width, .in_glass = true, .painted = true};
  picture::draw_panel(scene, panel, how.view, picture);
  picture::draw_legend(scene, picture);
  return picture;
}

}  // namespace medial_vk
