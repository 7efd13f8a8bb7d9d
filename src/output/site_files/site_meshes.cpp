// The surface as PLY, OBJ and glTF, and its points as a table.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "medial_vk/version.h"
#include "output/atomic_files/little_endian.h"
#include "output/colours/colour_map.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/glb_container.h"
#include "output/site_files/site_files.h"

namespace medial_vk {
namespace {

/// Control characters and line ends would end a comment or a name.
std::string in_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

std::string ply_header(const SiteRecord& record, bool ascii) {
  const SiteGrid& grid = record.voronoi.grid;
  std::string header = fmt::format("ply\nformat {} 1.0\ncomment medial-vk {}: the surface between {} sites\n",
                                   ascii ? "ascii" : "binary_little_endian", version(), record.sites.size());
  for (std::size_t s = 0; s < record.sites.size(); ++s) {
    header += fmt::format("comment site {} {} {}\n", s, record.sites[s].kind, in_one_line(record.sites[s].name));
  }
  header += fmt::format("comment grid origin {:.17g} {:.17g} {:.17g} voxel {:.17g} size {} {} {}\n", grid.origin[0],
                        grid.origin[1], grid.origin[2], grid.side, grid.size[0], grid.size[1], grid.size[2]);
  header += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                        record.voronoi.points.size());
  header +=
      "property double distance\nproperty double error\nproperty float object_angle\n"
      "property int site_a\nproperty int site_b\nproperty int site_c\nproperty int site_d\n"
      "property float spoke_a_x\nproperty float spoke_a_y\nproperty float spoke_a_z\n"
      "property float spoke_b_x\nproperty float spoke_b_y\nproperty float spoke_b_z\nproperty int piece\n";
  return header + fmt::format(
                      "element face {}\nproperty list uchar int vertex_indices\nproperty int site_a\n"
                      "property int site_b\nproperty int piece\nend_header\n",
                      record.voronoi.faces.size());
}

std::int32_t site_or_none(const SitePoint& point, std::size_t i) {
  return i < point.count ? static_cast<std::int32_t>(point.sites[i]) : -1;
}

void append_points(std::string& out, const SiteVoronoi& voronoi) {
  const std::vector<std::int32_t> pieces = piece_of_points(voronoi);
  for (std::size_t i = 0; i < voronoi.points.size(); ++i) {
    const SitePoint& p = voronoi.points[i];
    for (const double x : p.point) append_little_endian(out, x);
    append_little_endian(out, p.distance);
    append_little_endian(out, p.error);
    append_little_endian(out, static_cast<float>(p.object_angle));
    for (std::size_t s = 0; s < p.sites.size(); ++s) append_little_endian(out, site_or_none(p, s));
    for (std::size_t s = 0; s < 2; ++s) {
      for (const double x : spoke_of(p, s)) append_little_endian(out, static_cast<float>(x));
    }
    append_little_endian(out, pieces[i]);
  }
}

void append_points_as_text(std::string& out, const SiteVoronoi& voronoi) {
  const std::vector<std::int32_t> pieces = piece_of_points(voronoi);
  const auto write = std::back_inserter(out);
  for (std::size_t i = 0; i < voronoi.points.size(); ++i) {
    const SitePoint& p = voronoi.points[i];
    fmt::format_to(write, "{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.9g}", p.point[0], p.point[1], p.point[2],
                   p.distance, p.error, p.object_angle);
    for (std::size_t s = 0; s < p.sites.size(); ++s) fmt::format_to(write, " {}", site_or_none(p, s));
    for (std::size_t s = 0; s < 2; ++s) {
      for (const double x : spoke_of(p, s)) fmt::format_to(write, " {:.9g}", x);
    }
    fmt::format_to(write, " {}\n", pieces[i]);
  }
}

std::vector<std::uint32_t> triangles_of(std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> triangles(corners.begin(), corners.begin() + 3);
  if (corners.size() > 3) triangles.insert(triangles.end(), {corners[0], corners[2], corners[3]});
  return triangles;
}

/// Vertices of one piece, in float around the middle, and its triangles.
struct PieceMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> corners;
};

std::vector<PieceMesh> meshes_of_pieces(const SiteVoronoi& voronoi, const Point& middle) {
  std::vector<PieceMesh> meshes(voronoi.pieces.size());
  std::vector<std::map<std::uint32_t, std::uint32_t>> numbers(voronoi.pieces.size());
  for (const SiteFace& face : voronoi.faces) {
    PieceMesh& mesh = meshes[face.piece];
    for (const std::uint32_t corner : triangles_of(corners_of(face))) {
      const auto next = static_cast<std::uint32_t>(mesh.positions.size());
      const auto [at, is_new] = numbers[face.piece].try_emplace(corner, next);
      if (is_new) {
        std::array<float, 3> position = {};
        for (std::size_t k = 0; k < 3; ++k) {
          position[k] = static_cast<float>(voronoi.points[corner].point[k] - middle[k]);
        }
        mesh.positions.push_back(position);
      }
      mesh.corners.push_back(at->second);
    }
  }
  return meshes;
}

}  // namespace

std::string encode_sites_ply(const SiteRecord& record, bool ascii) {
  std::string out = ply_header(record, ascii);
  if (ascii) {
    append_points_as_text(out, record.voronoi);
  } else {
    append_points(out, record.voronoi);
  }
  for (const SiteFace& face : record.voronoi.faces) {
    const std::vector<std::uint32_t> corners = corners_of(face);
    if (ascii) {
      out += fmt::format("{} {} {} {} {}\n", corners.size(), fmt::join(corners, " "), face.sites[0], face.sites[1],
                         face.piece);
      continue;
    }
    append_little_endian(out, static_cast<std::uint8_t>(corners.size()));
    for (const std::uint32_t corner : corners) append_little_endian(out, corner);
    for (const std::uint32_t site : face.sites) append_little_endian(out, site);
    append_little_endian(out, face.piece);
  }
  return out;
}

std::string encode_sites_obj(const SiteRecord& record) {
  const SiteVoronoi& voronoi = record.voronoi;
  std::string out = fmt::format("# medial-vk {}: the surface between {} sites\n", version(), record.sites.size());
  const auto write = std::back_inserter(out);
  for (const SitePoint& p : voronoi.points) fmt::format_to(write, "v {} {} {}\n", p.point[0], p.point[1], p.point[2]);
  std::vector<const SiteFace*> order;
  order.reserve(voronoi.faces.size());
  for (const SiteFace& face : voronoi.faces) order.push_back(&face);
  std::ranges::stable_sort(order, {}, [](const SiteFace* face) { return face->piece; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const SiteFace& face = *order[i];
    if (i == 0 || order[i - 1]->piece != face.piece) {
      fmt::format_to(write, "g sites_{}_{}_piece_{}\n", face.sites[0], face.sites[1], face.piece);
    }
    out += 'f';
    for (const std::uint32_t corner : corners_of(face)) fmt::format_to(write, " {}", corner + 1);
    out += '\n';
  }
  return out;
}

std::string encode_sites_csv(const SiteRecord& record) {
  std::string out =
      "x,y,z,distance,error,object_angle,site_a,site_b,site_c,site_d,contact_a_x,contact_a_y,contact_a_z,contact_b_x,"
      "contact_b_y,contact_b_z,piece\n";
  const auto write = std::back_inserter(out);
  const std::vector<std::int32_t> pieces = piece_of_points(record.voronoi);
  for (std::size_t i = 0; i < record.voronoi.points.size(); ++i) {
    const SitePoint& p = record.voronoi.points[i];
    fmt::format_to(write, "{},{},{},{},{},{}", p.point[0], p.point[1], p.point[2], p.distance, p.error, p.object_angle);
    for (std::size_t s = 0; s < p.sites.size(); ++s) fmt::format_to(write, ",{}", site_or_none(p, s));
    for (std::size_t s = 0; s < 2; ++s) {
      for (const double x : p.contacts[s]) fmt::format_to(write, ",{}", x);
    }
    fmt::format_to(write, ",{}\n", pieces[i]);
  }
  return out;
}

Result<std::string> encode_sites_glb(const SiteRecord& record) {
  const SiteVoronoi& voronoi = record.voronoi;
  CentreBox box;
  for (const SitePoint& p : voronoi.points) box.add(p.point);
  const Point middle = voronoi.points.empty() ? Point{0, 0, 0} : box.middle();
  GlbContainer glb;
  const std::vector<SitePair> pairs = pairs_of(voronoi);
  GltfJson materials = GltfJson::array(), meshes = GltfJson::array(), children = GltfJson::array();
  std::map<std::array<std::uint32_t, 2>, std::size_t> material_of;
  for (const SitePair& pair : pairs) {
    const auto number = static_cast<std::int32_t>(materials.size());
    material_of[pair.sites] = materials.size();
    const Eigen::Vector3f light = picture::to_light(picture::sheet_colours()[picture::sheet_colour_index(number)]);
    materials.push_back(
        {{"name", fmt::format("sites {} and {}", pair.sites[0], pair.sites[1])},
         {"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {light[0], light[1], light[2], 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}});
  }
  std::string nodes = "[";
  const std::vector<PieceMesh> pieces = meshes_of_pieces(voronoi, middle);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const SitePiece& piece = voronoi.pieces[i];
    const GltfJson primitive = {
        {"attributes", {{"POSITION", glb.add_vectors(pieces[i].positions, GltfTarget::kVertices, true)}}},
        {"indices", glb.add_indices(pieces[i].corners, GltfComponent::kUnsignedInt)},
        {"material", material_of[piece.sites]}};
    const std::string name = fmt::format("sites {} and {}, piece {}", piece.sites[0], piece.sites[1], i);
    meshes.push_back({{"name", name}, {"primitives", {primitive}}});
    children.push_back(i);
    nodes += fmt::format(R"({}{{"mesh":{},"name":"{}","translation":[{},{},{}]}})", i > 0 ? "," : "", i, name,
                         middle[0], middle[1], middle[2]);
  }
  glb.document = {{"asset", {{"version", "2.0"}, {"generator", std::string("medial-vk ") + version()}}}, {"scene", 0}};
  if (pieces.empty()) {
    glb.document["scenes"] = {{{"name", "empty"}}};
    return glb.finish("[{\"name\":\"empty\"}]");
  }
  glb.document["scenes"] = {{{"nodes", children}}};
  glb.document["materials"] = materials;
  glb.document["meshes"] = meshes;
  return glb.finish(nodes + "]");
}

}  // namespace medial_vk
