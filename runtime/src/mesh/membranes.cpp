#include "mesh/membranes.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "mesh/mesh_topology.h"
#include "mesh/winding/part_field.h"

namespace medial_vk {
namespace {

/// The winding number of an open, flat surface is between -1/2 and 1/2, and 0 beside its triangles, without the
/// triangle itself. This is the greatest absolute value for a surface that counts as flat.
constexpr double kFlat = 0.1;
/// Surfaces that face each other may enclose something together, as the sides of a box do that have gaps between them:
/// beside them their numbers then are about 1/2.
constexpr double kTogether = 0.25;
/// The number of the rest is 0 or 1 where it is closed. A lid beside its box lies between.
constexpr double kRestOutside = 0.25, kRestInside = 0.75;
/// Where all flat parts are near each other, each number evaluates all of their triangles: more than these stay.
constexpr std::size_t kMostFlat = 20000;

/// By component: whether it is open and has a triangle that crosses others.
std::vector<char> find_candidates(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                  const std::vector<bool>& crossed, std::size_t components) {
  const MeshTopology topology(mesh);
  std::vector<char> is_open(components, 0), crosses(components, 0);
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    if (balance_at(mesh, topology, edge) != 0) is_open[component_of[topology.triangles_of(edge).front()]] = 1;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) crosses[component_of[t]] |= char{crossed[t]};
  for (std::size_t i = 0; i < components; ++i) is_open[i] &= crosses[i];
  return is_open;
}

/// True if these are at most kMostFlat and their winding number beside each of them is at most kFlat. Begins with a few
/// of them, which suffice for most surfaces that are not flat.
bool is_flat(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, unsigned threads) {
  if (triangles.size() > kMostFlat) return false;
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

Point middle_of(const Mesh& mesh, std::uint32_t t) {
  const Triangle& corners = mesh.triangles[t];
  return (1.0 / 3) * (mesh.vertices[corners[0]] + mesh.vertices[corners[1]] + mesh.vertices[corners[2]]);
}

/// Leaves only those flat components that bound nothing, alone or with others.
void keep_those_that_bound_nothing(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                   std::vector<char>& is_membrane, unsigned threads) {
  std::vector<std::uint32_t> flat, others;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    (is_membrane[component_of[t]] != 0 ? flat : others).push_back(t);
  if (flat.empty()) return;
  if (flat.size() > kMostFlat || others.empty()) {
    is_membrane.assign(is_membrane.size(), 0);
    return;
  }
  const PartField of_flat(mesh, flat), of_others(mesh, others);
  std::vector<char> bounds(flat.size(), 0);
  parallel_for(flat.size(), 64, threads, [&](std::size_t i) {
    const double number = of_others.at(middle_of(mesh, flat[i]));
    const bool encloses = std::fabs(of_flat.beside(static_cast<std::uint32_t>(i))) > kTogether;
    bounds[i] = encloses || (number > kRestOutside && number < kRestInside);
  });
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (bounds[i] != 0) is_membrane[component_of[flat[i]]] = 0;
  }
}

}  // namespace

std::vector<char> find_membranes(const Mesh& mesh, const std::vector<std::uint32_t>& component_of,
                                 const std::vector<bool>& crossed, unsigned threads) {
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    members.resize(std::max<std::size_t>(members.size(), component_of[t] + std::size_t{1}));
    members[component_of[t]].push_back(t);
  }
  std::vector<char> is_membrane = find_candidates(mesh, component_of, crossed, members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (is_membrane[i] != 0 && !is_flat(mesh, members[i], threads)) is_membrane[i] = 0;
  }
  keep_those_that_bound_nothing(mesh, component_of, is_membrane, threads);
  return is_membrane;
}

}  // namespace medial_vk
