#include "mesh/mesh_topology.h"

#include <algorithm>

namespace medial_vk {
namespace {

/// One side of one triangle: the far end and the corner it starts from.
struct Side {
  std::uint32_t high;
  std::uint32_t corner;  // 3 * triangle + k
};

}  // namespace

MeshTopology::MeshTopology(const Mesh& mesh) {
  // Sides by their smaller vertex (counting sort), then by the other one within these few.
  const std::size_t vertices = mesh.vertices.size();
  std::vector<std::uint32_t> bucket(vertices + 1, 0);
  const auto for_each_side = [&](auto visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        visit(std::min(a, b), std::max(a, b), 3 * t + k);
      }
    }
  };
  for_each_side([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++bucket[low + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) bucket[v + 1] += bucket[v];
  std::vector<Side> sides(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(bucket.begin(), bucket.end() - 1);
  for_each_side([&](std::uint32_t low, std::uint32_t high, std::uint32_t corner) {
    sides[next[low]++] = {high, corner};
  });

  edge_of_.resize(sides.size());
  incident_.resize(sides.size());
  ends_.reserve(sides.size() / 2 + 1);
  starts_.reserve(sides.size() / 2 + 2);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    std::sort(sides.begin() + bucket[v], sides.begin() + bucket[v + 1],
              [](const Side& a, const Side& b) { return a.high != b.high ? a.high < b.high : a.corner < b.corner; });
    for (std::uint32_t i = bucket[v]; i < bucket[v + 1]; ++i) {
      if (i == bucket[v] || sides[i].high != sides[i - 1].high) {
        starts_.push_back(i);
        ends_.push_back({v, sides[i].high});
      }
      incident_[i] = sides[i].corner / 3;
      edge_of_[sides[i].corner] = static_cast<std::uint32_t>(ends_.size() - 1);
    }
  }
  starts_.push_back(static_cast<std::uint32_t>(sides.size()));
}

VertexTriangles::VertexTriangles(const Mesh& mesh) : starts_(mesh.vertices.size() + 1, 0) {
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++starts_[v + 1];
  }
  for (std::size_t v = 0; v + 1 < starts_.size(); ++v) starts_[v + 1] += starts_[v];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  incident_.resize(starts_.back());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) incident_[next[v]++] = t;
  }
}

}  // namespace medial_vk
