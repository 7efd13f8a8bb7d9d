#include "mesh/membranes.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "mesh/mesh_topology.h"
#include "mesh/winding/part_field.h"

namespace medial_vk {
namespace {

/// Membranes that face each other may enclose something together, as the sides of a box do that have gaps between them:
/// beside them their numbers then are about 1/2.
constexpr double kTogether = 0.25;

std::vector<char> open_components(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  std::size_t components) {
  const MeshTopology topology(mesh);
  std::vector<char> is_open(components, 0);
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    if (balance_at(mesh, topology, edge) != 0) is_open[component_of[topology.triangles_of(edge).front()]] = 1;
  }
  return is_open;
}

/// True if the winding number of these triangles beside each of them is at most kFlat. Begins with a few of them, which
/// suffice for most surfaces that are not flat.
bool is_flat(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, unsigned threads) {
  constexpr std::size_t kFew = 32;
  const PartField field(mesh, triangles);
  const auto bends = [&](std::uint32_t number) { return std::fabs(field.beside(number)) > kFlat; };
  const std::size_t step = triangles.size() / kFew + 1;
  for (std::size_t i = 0; i < triangles.size(); i += step) {
    if (bends(static_cast<std::uint32_t>(i))) return false;
  }
  std::vector<char> bent(triangles.size(), 0);
  parallel_for(triangles.size(), 64, threads, [&](std::size_t i) { bent[i] = bends(static_cast<std::uint32_t>(i)); });
  return std::ranges::count(bent, 1) == 0;
}

}  // namespace

std::vector<char> find_membranes(const Mesh& mesh, const std::vector<std::uint32_t>& component_of, unsigned threads) {
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    members.resize(std::max<std::size_t>(members.size(), component_of[t] + std::size_t{1}));
    members[component_of[t]].push_back(t);
  }
  std::vector<char> is_membrane = open_components(mesh, component_of, members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (is_membrane[i] != 0 && !is_flat(mesh, members[i], threads)) is_membrane[i] = 0;
  }
  std::vector<std::uint32_t> flat;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_membrane[component_of[t]] != 0) flat.push_back(t);
  }
  if (flat.empty()) return is_membrane;
  if (flat.size() == mesh.triangles.size()) return std::vector<char>(members.size(), 0);
  const PartField field(mesh, flat);
  std::vector<char> encloses(flat.size(), 0);
  parallel_for(flat.size(), 64, threads, [&](std::size_t i) {
    encloses[i] = std::fabs(field.beside(static_cast<std::uint32_t>(i))) > kTogether;
  });
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (encloses[i] != 0) is_membrane[component_of[flat[i]]] = 0;
  }
  return is_membrane;
}

}  // namespace medial_vk
