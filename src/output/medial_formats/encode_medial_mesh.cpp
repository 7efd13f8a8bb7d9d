#include "output/medial_formats/encode_medial_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/file_extension.h"
#include "output/atomic_files/little_endian.h"

namespace medial_vk {
namespace {

std::string ply_header(const MedialHeader& header, std::size_t points, const MedialMesh& mesh, bool ascii) {
  return fmt::format(
      "ply\nformat {} 1.0\n{}"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nproperty double radius\n"
      "property int sheet\nproperty uchar seam\nproperty uchar rim\n"
      "element face {}\nproperty list uchar int vertex_indices\n"
      "element edge {}\nproperty int vertex1\nproperty int vertex2\nproperty uchar seam\nproperty uchar rim\n"
      "end_header\n",
      ascii ? "ascii" : "binary_little_endian", ply_comments(header), points, mesh.triangles.size(), mesh.edges.size());
}

std::uint8_t flag(std::uint8_t marks, PointMark mark) { return (marks & mark) != 0 ? 1 : 0; }

void append_binary(std::string& out, std::span<const MedialSphere> spheres, const Sheets& sheets,
                   const MedialMesh& mesh) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (const double x : spheres[i].centre) append_little_endian(out, x);
    append_little_endian(out, spheres[i].radius);
    append_little_endian(out, sheets.of_point[i]);
    for (const PointMark mark : {kSeam, kRim}) append_little_endian(out, flag(sheets.marks[i], mark));
  }
  for (const Triangle& t : mesh.triangles) {
    append_little_endian(out, std::uint8_t{3});
    for (const std::uint32_t corner : t) append_little_endian(out, corner);
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    for (const std::uint32_t end : mesh.edges[i]) append_little_endian(out, end);
    for (const PointMark mark : {kSeam, kRim}) append_little_endian(out, flag(mesh.edge_marks[i], mark));
  }
}

void append_text(std::string& out, std::span<const MedialSphere> spheres, const Sheets& sheets,
                 const MedialMesh& mesh) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Point& c = spheres[i].centre;
    out += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {} {} {}\n", c[0], c[1], c[2], spheres[i].radius,
                       sheets.of_point[i], flag(sheets.marks[i], kSeam), flag(sheets.marks[i], kRim));
  }
  for (const Triangle& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    out += fmt::format("{} {} {} {}\n", mesh.edges[i][0], mesh.edges[i][1], flag(mesh.edge_marks[i], kSeam),
                       flag(mesh.edge_marks[i], kRim));
  }
}

}  // namespace

std::string encode_medial_mesh_ply(const MedialHeader& header, std::span<const MedialSphere> spheres,
                                   const Sheets& sheets, const MedialMesh& mesh, bool ascii) {
  std::string out = ply_header(header, spheres.size(), mesh, ascii);
  if (ascii) {
    append_text(out, spheres, sheets, mesh);
  } else {
    append_binary(out, spheres, sheets, mesh);
  }
  return out;
}

std::string encode_medial_mesh_ma(std::span<const MedialSphere> spheres, const MedialMesh& mesh) {
  std::string out = fmt::format("{} {} {}\n", spheres.size(), mesh.edges.size(), mesh.triangles.size());
  for (const MedialSphere& s : spheres) {
    out += fmt::format("v {} {} {} {}\n", s.centre[0], s.centre[1], s.centre[2], s.radius);
  }
  for (const MeshEdge& e : mesh.edges) out += fmt::format("e {} {}\n", e[0], e[1]);
  for (const Triangle& t : mesh.triangles) out += fmt::format("f {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

std::string encode_medial_mesh(const std::string& path, const MedialHeader& header,
                               std::span<const MedialSphere> spheres, const Sheets& sheets, const MedialMesh& mesh,
                               bool ascii) {
  if (file_extension(path) == ".ma") return encode_medial_mesh_ma(spheres, mesh);
  return encode_medial_mesh_ply(header, spheres, sheets, mesh, ascii);
}

}  // namespace medial_vk
