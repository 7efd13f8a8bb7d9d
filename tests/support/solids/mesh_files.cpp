#include "support/solids/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace medial_vk::test {

template <class T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}
template std::string bytes_of(std::uint8_t, bool);
template std::string bytes_of(std::int16_t, bool);
template std::string bytes_of(std::uint16_t, bool);
template std::string bytes_of(std::int32_t, bool);
template std::string bytes_of(std::uint32_t, bool);
template std::string bytes_of(std::uint64_t, bool);
template std::string bytes_of(float, bool);
template std::string bytes_of(double, bool);

// {} of a double is its shortest text that reads back as the same double.

std::string to_obj(const Mesh& mesh) {
  std::string text;
  for (const Point& p : mesh.vertices) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  for (const Triangle& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string to_off(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Point& p : mesh.vertices) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const Triangle& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

namespace {

std::string ply_header(const Mesh& mesh, const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment made by a test\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, mesh.vertices.size(), mesh.triangles.size());
}

}  // namespace

std::string to_ascii_ply(const Mesh& mesh) {
  std::string text = ply_header(mesh, "ascii");
  for (const Point& p : mesh.vertices) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const Triangle& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

std::string to_binary_ply(const Mesh& mesh, bool big_endian) {
  std::string bytes = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const Point& p : mesh.vertices) {
    for (const double x : p) bytes += bytes_of(x, big_endian);
  }
  for (const Triangle& t : mesh.triangles) {
    bytes += bytes_of(std::uint8_t{3}, big_endian);
    for (const std::uint32_t v : t) bytes += bytes_of(static_cast<std::int32_t>(v), big_endian);
  }
  return bytes;
}

std::string to_ascii_stl(const Mesh& mesh) {
  std::string text = "solid made by a test\n";
  for (const Triangle& t : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const std::uint32_t v : t) {
      const Point& p = mesh.vertices[v];
      text += fmt::format("   vertex {} {} {}\n", p[0], p[1], p[2]);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid made by a test\n";
}

std::string to_binary_stl(const Mesh& mesh) {
  std::string bytes(80, ' ');
  bytes += bytes_of(static_cast<std::uint32_t>(mesh.triangles.size()), false);
  for (const Triangle& t : mesh.triangles) {
    bytes.append(12, '\0');
    for (const std::uint32_t v : t) {
      for (const double x : mesh.vertices[v]) bytes += bytes_of(static_cast<float>(x), false);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace medial_vk::test
