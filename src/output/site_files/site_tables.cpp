// The surface and the roadmap as JSON and as arrays.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/numpy_files/npz_writer.h"
#include "output/site_files/site_files.h"

namespace medial_vk {
namespace {

using SiteJson = nlohmann::ordered_json;

/// Written row by row: a document in memory would be many times the file.
class SiteJsonText {
 public:
  explicit SiteJsonText(const SiteJson& head) : out_(head.dump(2, ' ', false, SiteJson::error_handler_t::replace)) {
    out_.resize(out_.size() - 2);  // without the end of the object
  }

  /// `write(i)` gives row i.
  template <class Write>
  void rows(const char* name, std::size_t count, const Write& write) {
    out_ += fmt::format(",\n  \"{}\": [", name);
    for (std::size_t i = 0; i < count; ++i) {
      out_ += i > 0 ? ",\n    " : "\n    ";
      out_ += write(i);
    }
    out_ += count > 0 ? "\n  ]" : "]";
  }

  std::string finish() { return std::move(out_) + "\n}\n"; }

 private:
  std::string out_;
};

SiteJson sites_json(const SiteRecord& record) {
  SiteJson sites = SiteJson::array();
  for (const NamedSite& site : record.sites) {
    sites.push_back({{"name", site.name}, {"kind", site.kind}, {"elements", site.elements}});
  }
  return sites;
}

SiteJson head_of(const SiteRecord& record) {
  const SiteGrid& grid = record.voronoi.grid;
  return {{"version", version()},
          {"sites", sites_json(record)},
          {"assumptions", record.assumptions},
          {"grid", {{"origin", grid.origin}, {"voxel_side", grid.side}, {"size", grid.size}}}};
}

std::string list_of(const Point& p) { return fmt::format("[{}, {}, {}]", p[0], p[1], p[2]); }

std::string point_row(const SitePoint& p, std::int32_t piece) {
  std::string contacts, sites;
  for (std::size_t s = 0; s < p.count; ++s) {
    contacts += (s > 0 ? ", " : "") + list_of(p.contacts[s]);
    sites += fmt::format("{}{}", s > 0 ? ", " : "", p.sites[s]);
  }
  return fmt::format(R"({{"point": {}, "distance": {}, "error": {}, "object_angle": {}, "sites": [{}], )",
                     list_of(p.point), p.distance, p.error, p.object_angle, sites) +
         fmt::format(R"("contacts": [{}], "piece": {}}})", contacts, piece);
}

std::vector<std::uint32_t> sites_in_order(const std::vector<SitePoint>& points) {
  std::vector<std::uint32_t> sites;
  sites.reserve(4 * points.size());
  for (const SitePoint& p : points) sites.insert(sites.end(), p.sites.begin(), p.sites.end());
  return sites;
}

}  // namespace

std::string encode_sites_json(const SiteRecord& record) {
  const SiteVoronoi& voronoi = record.voronoi;
  SiteJsonText json(head_of(record));
  const std::vector<std::int32_t> pieces = piece_of_points(voronoi);
  json.rows("points", voronoi.points.size(), [&](std::size_t i) { return point_row(voronoi.points[i], pieces[i]); });
  json.rows("faces", voronoi.faces.size(), [&](std::size_t i) {
    const SiteFace& face = voronoi.faces[i];
    return fmt::format(R"({{"corners": [{}], "sites": [{}, {}], "piece": {}}})", fmt::join(corners_of(face), ", "),
                       face.sites[0], face.sites[1], face.piece);
  });
  json.rows("pieces", voronoi.pieces.size(), [&](std::size_t i) {
    const SitePiece& p = voronoi.pieces[i];
    return fmt::format(
        R"({{"sites": [{}, {}], "faces": {}, "area": {}, "least_clearance": {}, "greatest_clearance": {}}})",
        p.sites[0], p.sites[1], p.faces, p.area, p.least_clearance, p.greatest_clearance);
  });
  for (const VoxelsWithoutPoint& kind : voxels_without_point(voronoi)) {
    json.rows(kind.name, kind.voxels->size(), [&](std::size_t i) {
      const std::array<std::uint32_t, 3>& voxel = (*kind.voxels)[i];
      return fmt::format("[{}, {}, {}]", voxel[0], voxel[1], voxel[2]);
    });
  }
  return json.finish();
}

std::string encode_roadmap_json(const SiteRecord& record) {
  const SiteRoadmap& roadmap = *record.roadmap;
  SiteJson head = head_of(record);
  head["components"] = roadmap.components();
  if (record.path_was_sought) {
    head["path"] = nullptr;
    if (record.path) {
      SiteJson points = SiteJson::array();
      for (const std::uint32_t p : record.path->points) {
        points.push_back(p == SitePath::kNoPoint ? SiteJson() : SiteJson(p));
      }
      head["path"] = {{"width", record.path->width},
                      {"length", record.path->length},
                      {"line", record.path->line},
                      {"nodes", points}};
    }
  }
  SiteJsonText json(head);
  json.rows("nodes", record.voronoi.points.size(), [&](std::size_t i) {
    const SitePoint& p = record.voronoi.points[i];
    std::string sites;
    for (std::size_t s = 0; s < p.count; ++s) sites += fmt::format("{}{}", s > 0 ? ", " : "", p.sites[s]);
    return fmt::format(R"({{"point": {}, "clearance": {}, "sites": [{}], "component": {}}})", list_of(p.point),
                       p.distance - p.error, sites, roadmap.component_of_point()[i]);
  });
  json.rows("links", roadmap.links().size(), [&](std::size_t i) {
    const RoadmapLink& link = roadmap.links()[i];
    return fmt::format(R"({{"nodes": [{}, {}], "length": {}, "width": {}}})", link.points[0], link.points[1],
                       link.length, link.width);
  });
  return json.finish();
}

Result<std::string> encode_sites_npz(const SiteRecord& record) {
  const std::vector<SitePoint>& points = record.voronoi.points;
  const std::vector<SiteFace>& faces = record.voronoi.faces;
  const std::vector<SitePiece>& pieces = record.voronoi.pieces;
  NpzWriter npz;
  std::vector<double> point, distance, error, angle, contacts;
  std::vector<std::uint32_t> voxels;
  for (const SitePoint& p : points) {
    point.insert(point.end(), p.point.begin(), p.point.end());
    distance.push_back(p.distance);
    error.push_back(p.error);
    angle.push_back(p.object_angle);
    for (const Point& contact : p.contacts) contacts.insert(contacts.end(), contact.begin(), contact.end());
    voxels.insert(voxels.end(), p.voxel.begin(), p.voxel.end());
  }
  npz.numbers<double>("point", {points.size(), 3}, point);
  npz.numbers<double>("distance", {points.size()}, distance);
  npz.numbers<double>("error", {points.size()}, error);
  npz.numbers<double>("object_angle", {points.size()}, angle);
  npz.numbers<std::uint32_t>("sites", {points.size(), 4}, sites_in_order(points));
  npz.numbers<double>("contacts", {points.size(), 4, 3}, contacts);
  npz.numbers<std::uint32_t>("voxel", {points.size(), 3}, voxels);
  npz.numbers<std::int32_t>("piece", {points.size()}, piece_of_points(record.voronoi));
  std::vector<std::uint32_t> corners, face_sites, face_pieces, piece_sites;
  for (const SiteFace& face : faces) {
    corners.insert(corners.end(), face.corners.begin(), face.corners.end());
    face_sites.insert(face_sites.end(), face.sites.begin(), face.sites.end());
    face_pieces.push_back(face.piece);
  }
  npz.numbers<std::uint32_t>("faces", {faces.size(), 4}, corners);
  npz.numbers<std::uint32_t>("face_sites", {faces.size(), 2}, face_sites);
  npz.numbers<std::uint32_t>("face_piece", {faces.size()}, face_pieces);
  std::vector<double> areas, least_clearances, greatest_clearances;
  for (const SitePiece& piece : pieces) {
    piece_sites.insert(piece_sites.end(), piece.sites.begin(), piece.sites.end());
    areas.push_back(piece.area);
    least_clearances.push_back(piece.least_clearance);
    greatest_clearances.push_back(piece.greatest_clearance);
  }
  npz.numbers<std::uint32_t>("piece_sites", {pieces.size(), 2}, piece_sites);
  npz.numbers<double>("piece_area", {pieces.size()}, areas);
  npz.numbers<double>("piece_least_clearance", {pieces.size()}, least_clearances);
  npz.numbers<double>("piece_greatest_clearance", {pieces.size()}, greatest_clearances);
  for (const VoxelsWithoutPoint& kind : voxels_without_point(record.voronoi)) {
    std::vector<std::uint32_t> places;
    places.reserve(3 * kind.voxels->size());
    for (const auto& voxel : *kind.voxels) places.insert(places.end(), voxel.begin(), voxel.end());
    npz.numbers<std::uint32_t>(kind.name, {kind.voxels->size(), 3}, places);
  }
  npz.numbers<double>("grid_origin", {3}, record.voronoi.grid.origin);
  npz.number<double>("voxel_side", record.voronoi.grid.side);
  npz.numbers<std::uint32_t>("grid_size", {3}, record.voronoi.grid.size);
  return npz.finish();
}

}  // namespace medial_vk
