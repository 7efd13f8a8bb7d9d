#include "output/picture/panels/surface.h"

#include <Eigen/Geometry>
#include <cstdint>

namespace medial_vk::picture {
namespace {

constexpr double kCreaseCosine = 0.76;  // Faces more than about 40 degrees apart do not share a normal.

/// Twice the area times the unit normal.
Eigen::Vector3d area_normal(const Mesh& mesh, const Triangle& triangle) {
  const auto corner = [&](std::size_t i) { return Eigen::Vector3d(mesh.vertices[triangle[i]].data()); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

/// Faces by vertex, as offsets into one array.
struct VertexFaces {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> faces;
};

VertexFaces faces_by_vertex(const Mesh& mesh) {
  VertexFaces out;
  out.first.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) ++out.first[vertex + 1];
  }
  for (std::size_t i = 1; i < out.first.size(); ++i) out.first[i] += out.first[i - 1];
  out.faces.resize(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
    for (const std::uint32_t vertex : mesh.triangles[face]) out.faces[next[vertex]++] = face;
  }
  return out;
}

}  // namespace

std::vector<Eigen::Vector3f> corner_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> faces;
  faces.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) faces.push_back(area_normal(mesh, triangle));
  const VertexFaces around = faces_by_vertex(mesh);
  std::vector<Eigen::Vector3f> out(3 * mesh.triangles.size());
  for (std::size_t face = 0; face < faces.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[face][corner];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::uint32_t i = around.first[vertex]; i < around.first[vertex + 1]; ++i) {
        const Eigen::Vector3d& other = faces[around.faces[i]];
        if (other.dot(faces[face]) >= kCreaseCosine * other.norm() * faces[face].norm()) sum += other;
      }
      out[3 * face + corner] = sum.normalized().cast<float>();
    }
  }
  return out;
}

}  // namespace medial_vk::picture
