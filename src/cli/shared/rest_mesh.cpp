#include "cli/shared/rest_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "medial_vk/prepare.h"
#include "motion_files/frame_patterns.h"

namespace medial_vk::cli {
namespace {

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Of the cones from the first vertex, in exact arithmetic that of any point if the mesh is closed.
double signed_volume(std::span<const Triangle> triangles, std::span<const Point> vertices) {
  const Point& o = vertices.front();
  const auto from_o = [&](std::uint32_t i) {
    const Point& p = vertices[i];
    return Point{p[0] - o[0], p[1] - o[1], p[2] - o[2]};
  };
  double six_times = 0;
  for (const Triangle& t : triangles) {
    const Point a = from_o(t[0]), b = from_o(t[1]), c = from_o(t[2]);
    six_times +=
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six_times / 6;
}

}  // namespace

VertexMap::VertexMap(const PreparedMesh& mesh)
    : vertex_of_input_(mesh.vertex_of_input), first_input_(mesh.mesh.vertices.size(), PreparedMesh::kDropped) {
  for (std::size_t i = vertex_of_input_.size(); i-- > 0;) {
    if (vertex_of_input_[i] != PreparedMesh::kDropped) {
      first_input_[vertex_of_input_[i]] = static_cast<std::uint32_t>(i);
    }
  }
}

void VertexMap::map(std::span<const Point> positions, std::vector<Point>& vertices) {
  vertices.resize(first_input_.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = positions[first_input_[v]];
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::uint32_t vertex = vertex_of_input_[i];
    if (vertex == PreparedMesh::kDropped || positions[i] == vertices[vertex]) continue;
    ++count;
    parted_.distance = std::max(parted_.distance, distance(positions[i], vertices[vertex]));
  }
  parted_.count = std::max(parted_.count, count);
}

Result<std::vector<std::string>> files_of_frames(std::span<const std::string> frames) {
  std::vector<std::string> files;
  for (const std::string& frame : frames) {
    if (!is_frame_pattern(frame)) {
      files.push_back(frame);
      continue;
    }
    const Result<std::vector<std::string>> found = files_of_pattern(frame);
    if (!found) return found.error();
    files.insert(files.end(), found.value().begin(), found.value().end());
  }
  return files;
}

Status check_size(std::span<const Point> vertices, const std::string& name) {
  constexpr double kLargest = 1e18;
  for (const Point& p : vertices) {
    for (const double x : p) {
      if (std::fabs(x) <= kLargest) continue;
      return Error{ErrorCode::kInvalidMesh, fmt::format("{}: a coordinate is beyond {:g}", name, kLargest)};
    }
  }
  return {};
}

bool encloses_volume(const MeshReport& report) {
  return report.closed && report.intersecting_faces == 0 && report.intersections_known && report.faces_within == 0 &&
         report.faces_without == 0;
}

Result<bool> encloses_volume(const PreparedMesh& rest, std::span<const Point> vertices, unsigned threads) {
  const PrepareOptions options = {.keep_inner_faces = true, .threads = threads, .keep_outer_faces = true};
  const Result<PreparedMesh> frame = prepare_mesh(moved(rest, vertices).mesh, options);
  if (frame) return encloses_volume(frame.value().report) && frame.value().report.reoriented_faces == 0;
  if (frame.error().code == ErrorCode::kOutOfMemory) return frame.error();
  return false;
}

bool is_mirrored(const PreparedMesh& rest, std::span<const Point> vertices) {
  return rest.report.closed && signed_volume(rest.mesh.triangles, vertices) < 0;
}

PreparedMesh moved(const PreparedMesh& rest, std::span<const Point> vertices) {
  PreparedMesh mesh = rest;
  mesh.mesh.vertices.assign(vertices.begin(), vertices.end());
  MeshReport& report = mesh.report;
  report.lower = report.upper = vertices.front();
  for (const Point& p : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      report.lower[k] = std::min(report.lower[k], p[k]);
      report.upper[k] = std::max(report.upper[k], p[k]);
    }
  }
  report.signed_volume = signed_volume(mesh.mesh.triangles, mesh.mesh.vertices);
  if (report.closed && report.signed_volume < 0) {
    for (Triangle& t : mesh.mesh.triangles) std::swap(t[1], t[2]);
    report.signed_volume = -report.signed_volume;
  }
  return mesh;
}

}  // namespace medial_vk::cli
