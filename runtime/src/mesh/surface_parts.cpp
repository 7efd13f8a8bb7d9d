#include "mesh/surface_parts.h"

#include <utility>

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Numbers the sets of triangles that are connected over the edges for which `passes`, in the order of their first
/// triangle.
template <class Passes>
std::uint32_t number_parts(const Mesh& mesh, const MeshTopology& topology, Passes passes,
                           std::vector<std::uint32_t>& part_of) {
  part_of.assign(mesh.triangles.size(), kNone);
  std::vector<std::uint32_t> stack;
  std::vector<bool> crossed(topology.edge_count(), false);  // once: thousands of triangles may share one
  std::uint32_t count = 0;
  for (std::uint32_t start = 0; start < part_of.size(); ++start) {
    if (part_of[start] != kNone) continue;
    part_of[start] = count;
    stack.assign(1, start);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t edge = topology.edge_of(t, k);
        if (crossed[edge] || !passes(edge)) continue;
        crossed[edge] = true;
        for (const std::uint32_t other : topology.triangles_of(edge)) {
          if (part_of[other] != kNone) continue;
          part_of[other] = count;
          stack.push_back(other);
        }
      }
    }
    ++count;
  }
  return count;
}

}  // namespace

SurfaceParts find_parts(const Mesh& mesh, const MeshTopology& topology) {
  SurfaceParts parts;
  parts.components = number_parts(
      mesh, topology, [](std::uint32_t) { return true; }, parts.component_of);
  const auto is_plain = [&](std::uint32_t edge) { return topology.triangles_of(edge).size() <= 2; };
  bool all_plain = true;
  for (std::uint32_t edge = 0; all_plain && edge < topology.edge_count(); ++edge) all_plain = is_plain(edge);
  if (all_plain) {  // the usual case; patches are then the components
    parts.patches = parts.components;
    parts.patch_of = parts.component_of;
  } else {
    parts.patches = number_parts(mesh, topology, is_plain, parts.patch_of);
  }
  return parts;
}

void turn_triangle(Mesh& mesh, MeshTopology& topology, std::uint32_t triangle) {
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
  topology.flip_triangle(triangle);
}

std::uint64_t make_patches_consistent(Mesh& mesh, MeshTopology& topology) {
  constexpr std::uint8_t kUnseen = 2;
  std::vector<std::uint8_t> turn(mesh.triangles.size(), kUnseen);
  std::vector<std::uint32_t> patch;
  std::uint64_t turned = 0;
  for (std::uint32_t start = 0; start < turn.size(); ++start) {
    if (turn[start] != kUnseen) continue;
    turn[start] = 0;
    patch.assign(1, start);
    std::uint64_t wrong_before = 0, wrong_after = 0, minority = 0;  // edges, each counted from both sides
    for (std::size_t at = 0; at < patch.size(); ++at) {
      const std::uint32_t t = patch[at];
      minority += turn[t];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t edge = topology.edge_of(t, k);
        const auto beside = topology.triangles_of(edge);
        if (beside.size() != 2) continue;
        const std::uint32_t other = beside[0] == t ? beside[1] : beside[0];
        const bool agrees = runs_upwards(mesh.triangles[t], topology.ends(edge)) !=
                            runs_upwards(mesh.triangles[other], topology.ends(edge));
        if (turn[other] == kUnseen) {
          turn[other] = static_cast<std::uint8_t>(agrees ? turn[t] : 1 - turn[t]);
          patch.push_back(other);
        }
        if (!agrees) ++wrong_before;
        if (agrees != (turn[t] == turn[other])) ++wrong_after;
      }
    }
    if (wrong_after >= wrong_before) continue;
    const std::uint8_t majority = 2 * minority > patch.size() ? 1 : 0;
    for (const std::uint32_t t : patch) {
      if (turn[t] == majority) continue;
      turn_triangle(mesh, topology, t);
      ++turned;
    }
  }
  return turned;
}

}  // namespace medial_vk
