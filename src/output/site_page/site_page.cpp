#include "output/site_page/site_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/page/page_parts.h"
#include "output/site_page/embedded_sites.h"
#include "output/site_shapes/site_shapes.h"

namespace medial_vk {
namespace {

using SitesOfPage = nlohmann::ordered_json;
using page::Block;

/// The geometry of the page lies around 0 and has size 1, in single precision, for any position and size of the sites.
/// `origin` and `scale` give the inverse map.
class BoxOfPage {
 public:
  explicit BoxOfPage(const SiteGrid& grid) : lower_(grid.origin), upper_(grid.corner(grid.size)) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      middle_[k] = lower_[k] + (upper_[k] - lower_[k]) / 2;
      longest = std::max(longest, upper_[k] - lower_[k]);
    }
    if (longest > 0) scale_ = longest;
  }

  float length(double value) const { return static_cast<float>(value / scale_); }
  void add(Block& block, const Point& point) const {
    for (std::size_t k = 0; k < 3; ++k) block.add(length(point[k] - middle_[k]));
  }

  SitesOfPage json() const { return {{"origin", middle_}, {"scale", scale_}, {"lower", lower_}, {"upper", upper_}}; }

 private:
  Point lower_, upper_, middle_ = {};
  double scale_ = 1;
};

SitesOfPage numbers_of_surface(const SiteRecord& record) {
  const SiteVoronoi& voronoi = record.voronoi;
  const SiteCounts counts = counts_of(voronoi);
  SitesOfPage numbers = SitesOfPage::array();
  const auto add = [&](const char* name, const SitesOfPage& value) {
    numbers.push_back(SitesOfPage::array({name, value}));
  };
  add("points", counts.points);
  add("of three sites", counts.on_curves);
  add("of four sites", counts.meetings);
  add("faces", voronoi.faces.size());
  add("pieces", voronoi.pieces.size());
  add("area", counts.area);
  add("least distance", counts.least_clearance);
  add("greatest distance", counts.greatest_clearance);
  add("greatest error", counts.greatest_error);
  add("side of a voxel", voronoi.grid.side);
  add("voxels undecided", voronoi.undecided.size());
  add("voxels tied", voronoi.tied.size());
  add("voxels overlapping", voronoi.overlapping.size());
  if (record.roadmap) {
    add("links of the roadmap", record.roadmap->links().size());
    add("components of the roadmap", record.roadmap->components());
  }
  return numbers;
}

SitesOfPage path_of(const SiteRecord& record) {
  if (!record.path) return nullptr;
  return {{"width", record.path->width}, {"length", record.path->length}, {"points", record.path->line.size()}};
}

std::string surface_json(const SiteRecord& record, const BoxOfPage& box, UpAxis up) {
  SitesOfPage sites = SitesOfPage::array(), pairs = SitesOfPage::array();
  for (const NamedSite& site : record.sites) sites.push_back({{"name", site.name}, {"kind", site.kind}});
  for (const SitePair& pair : pairs_of(record.voronoi)) {
    pairs.push_back({{"sites", pair.sites},
                     {"pieces", pair.pieces},
                     {"area", pair.area},
                     {"least", pair.least_clearance},
                     {"greatest", pair.greatest_clearance}});
  }
  SitesOfPage json = {{"version", version()}, {"sites", sites}, {"pairs", pairs}};
  json.update(box.json());
  json["up"] = axis_name(up);
  json["points"] = record.voronoi.points.size();
  json["faces"] = record.voronoi.faces.size();
  json["numbers"] = numbers_of_surface(record);
  json["assumptions"] = record.assumptions;
  json["has_roadmap"] = record.roadmap.has_value();
  json["path_was_sought"] = record.path_was_sought;
  json["path"] = path_of(record);
  return json.dump(-1, ' ', false, SitesOfPage::error_handler_t::replace);
}

void write_shapes(std::string& out, const Mesh& mesh, const BoxOfPage& box) {
  Block vertices("vertices", mesh.vertices.size() * 12), triangles("triangles", mesh.triangles.size() * 12);
  for (const Point& vertex : mesh.vertices) box.add(vertices, vertex);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) triangles.add(corner);
  }
  for (const Block* block : {&vertices, &triangles}) block->write(out);
}

/// Directions in sixteen bits per coordinate, as the spokes of the page of a run.
void write_points(std::string& out, const SiteVoronoi& voronoi, const BoxOfPage& box) {
  const std::size_t count = voronoi.points.size();
  Block places("points", count * 12), distances("distances", count * 4);
  Block sites("sites-of-points", count * 16), directions("directions", count * 24);
  for (const SitePoint& p : voronoi.points) {
    box.add(places, p.point);
    distances.add(box.length(p.distance));
    for (std::size_t i = 0; i < p.sites.size(); ++i) {
      sites.add(p.sites[i]);
      const Point direction = i < p.count ? spoke_of(p, i) : Point{0, 0, 0};
      for (const double x : direction) directions.add(static_cast<std::int16_t>(std::lround(32767 * x)));
    }
  }
  for (const Block* block : {&places, &distances, &sites, &directions}) block->write(out);
}

/// Two triangles for each face, one where two of its corners are the same point, with the number of its pair.
void write_faces(std::string& out, const SiteVoronoi& voronoi) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> number_of;
  for (const SitePair& pair : pairs_of(voronoi)) {
    number_of.try_emplace(pair.sites, static_cast<std::uint32_t>(number_of.size()));
  }
  Block corners("faces", voronoi.faces.size() * 24), pairs("pairs-of-faces", voronoi.faces.size() * 8);
  Block pieces("pieces-of-faces", voronoi.faces.size() * 8);
  for (const SiteFace& face : voronoi.faces) {
    const std::vector<std::uint32_t> ring = corners_of(face);
    for (std::size_t i = 2; i < ring.size(); ++i) {
      for (const std::uint32_t corner : {ring[0], ring[i - 1], ring[i]}) corners.add(corner);
      pairs.add(number_of.at(face.sites));
      pieces.add(face.piece);
    }
  }
  for (const Block* block : {&corners, &pairs, &pieces}) block->write(out);
}

void write_roadmap(std::string& out, const SiteRecord& record, const BoxOfPage& box) {
  if (record.roadmap) {
    const std::vector<RoadmapLink>& links = record.roadmap->links();
    Block ends("links", links.size() * 8), widths("widths", links.size() * 4);
    for (const RoadmapLink& link : links) {
      for (const std::uint32_t end : link.points) ends.add(end);
      widths.add(box.length(link.width));
    }
    for (const Block* block : {&ends, &widths}) block->write(out);
  }
  if (!record.path) return;
  Block line("path", record.path->line.size() * 12);
  for (const Point& p : record.path->line) box.add(line, p);
  line.write(out);
}

std::string name_of(const SiteRecord& record) {
  std::string name;
  constexpr std::size_t kMostNamed = 3;
  for (std::size_t i = 0; i < std::min(record.sites.size(), kMostNamed); ++i) {
    name += (i > 0 ? ", " : "") + record.sites[i].name;
  }
  return record.sites.size() > kMostNamed ? name + " ..." : name;
}

}  // namespace

std::string encode_site_page(const SiteRecord& record, std::span<const VoronoiSite> sites, UpAxis up) {
  const page::Template page = page::split(page::embedded_sites());
  const BoxOfPage box(record.voronoi.grid);
  std::string out;
  out.append(page.before_title).append(page::text_in_html(name_of(record))).append(page.before_data);
  page::write_json(out, "surface", surface_json(record, box, up));
  write_shapes(out, mesh_of_sites(record.voronoi.grid, sites, BoxCorners::kUnmarked), box);
  write_points(out, record.voronoi, box);
  write_faces(out, record.voronoi);
  write_roadmap(out, record, box);
  out.append(page.after_data);
  return out;
}

}  // namespace medial_vk
