#include "fuzz/require.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace medial_vk::fuzz {

void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "Violated property: %s\n", property);
  std::abort();
}

void require_clear(const Error& error, ErrorCode code) {
  require(error.code == code, "an error has the code of its kind");
  const auto is_printable = [](char c) { return c >= 0x20 && c < 0x7f; };
  require(!error.message.empty() && error.message.size() <= 300, "a message is of readable length");
  require(std::all_of(error.message.begin(), error.message.end(), is_printable), "a message is one printable line");
}

void require_mesh_or_message(const Result<Mesh>& mesh, std::string_view bytes) {
  if (!mesh.ok()) {
    require_clear(mesh.error(), ErrorCode::kInvalidMesh);
    require(mesh.error().message.starts_with(kName + ":"), "a message begins with the name of the file");
    return;
  }
  const Mesh& read = mesh.value();
  // The shortest vertex is three bytes of a binary PLY; a corner of a face takes a byte or more, and a polygon has
  // fewer triangles than corners.
  require(read.vertices.size() <= bytes.size() / 3, "vertices take bytes");
  require(read.triangles.size() + read.short_polygons <= bytes.size(), "faces take bytes");
  for (const Point& p : read.vertices) {
    for (const double x : p) require(std::isfinite(x), "coordinates are finite");
  }
  for (const Triangle& t : read.triangles) {
    for (const std::uint32_t v : t) require(v < read.vertices.size(), "faces use existing vertices");
  }
}

}  // namespace medial_vk::fuzz
