// The reference's own mesh from the product's, for tests on clean solids.
#pragma once

#include "cpu_reference/mesh.h"
#include "medial_vk/mesh.h"

namespace medial_vk::test {

/// A closed, oriented, embedded solid: every normal is trusted.
inline reference::Mesh to_reference(const Mesh& mesh) {
  reference::Mesh out;
  out.vertices.reserve(mesh.vertices.size());
  for (const Point& v : mesh.vertices) out.vertices.emplace_back(v[0], v[1], v[2]);
  out.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    out.triangles.emplace_back(static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]));
  }
  out.trusted.assign(mesh.triangles.size(), 1);
  out.closed = true;
  return out;
}

/// The same with the flags and the closedness of PreparedMesh.
inline reference::Mesh to_reference(const PreparedMesh& prepared) {
  reference::Mesh out = to_reference(prepared.mesh);
  for (std::size_t t = 0; t < out.trusted.size(); ++t) {
    out.trusted[t] = t < prepared.flags.size() && (prepared.flags[t] & kTrustedNormal) != 0;
  }
  out.closed = prepared.report.closed;
  return out;
}

}  // namespace medial_vk::test
