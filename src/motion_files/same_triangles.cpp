#include "motion_files/same_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

#include "input/text_scanner.h"

namespace medial_vk {
namespace {

/// A run of triangles in which two meshes differ. It is one or more polygons that are cut in two ways if both ways have
/// the same boundary, with its direction, and no vertex lies inside of it: n triangles without a vertex inside have at
/// least n + 2 vertices (exactly as many where they are one polygon, by Euler's formula).
class DifferentRun {
 public:
  void add(const Triangle& rest, const Triangle& frame) {
    ++size_;
    for (std::size_t k = 0; k < 3; ++k) {
      count_edge(rest[k], rest[(k + 1) % 3], 1);
      count_edge(frame[k], frame[(k + 1) % 3], -1);
      vertices_.insert(rest[k]);
    }
  }

  bool is_polygons() const { return edges_.empty() && vertices_.size() >= size_ + 2; }

  void clear() {
    size_ = 0;
    edges_.clear();
    vertices_.clear();
  }

 private:
  /// Edges of the boundary at rest less those in the frame; an edge in the other direction counts as its negative.
  void count_edge(std::uint32_t from, std::uint32_t to, std::int64_t sign) {
    if (from == to) return;
    const bool is_forward = from < to;
    const std::uint64_t key = std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
    const auto at = edges_.try_emplace(key, 0).first;
    at->second += is_forward ? sign : -sign;
    if (at->second == 0) edges_.erase(at);
  }

  std::uint64_t size_ = 0;
  std::unordered_map<std::uint64_t, std::int64_t> edges_;
  std::unordered_set<std::uint32_t> vertices_;
};

std::string text_of(const Triangle& t) { return fmt::format("{} {} {}", t[0] + 1, t[1] + 1, t[2] + 1); }

}  // namespace

Status compare_faces(const Mesh& rest, const std::string& rest_name, const Mesh& frame, const std::string& name) {
  if (frame.vertices.size() != rest.vertices.size()) {
    return file_error(
        name, fmt::format("has {} vertices where {} has {}", frame.vertices.size(), rest_name, rest.vertices.size()));
  }
  if (frame.triangles.size() != rest.triangles.size()) {
    return file_error(name, fmt::format("has {} triangles where {} has {}", frame.triangles.size(), rest_name,
                                        rest.triangles.size()));
  }
  DifferentRun run;
  bool is_open = false;
  std::size_t first = 0;
  for (std::size_t i = 0; i < rest.triangles.size(); ++i) {
    if (!is_open && rest.triangles[i] == frame.triangles[i]) continue;
    if (!is_open) first = i;
    run.add(rest.triangles[i], frame.triangles[i]);
    is_open = !run.is_polygons();
    if (!is_open) run.clear();
  }
  if (!is_open) return {};
  return file_error(name, fmt::format("triangle {} has the vertices {} where that of {} has {}", first + 1,
                                      text_of(frame.triangles[first]), rest_name, text_of(rest.triangles[first])));
}

}  // namespace medial_vk
