#include "mesh/clean_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "base/point_ops.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffffu;

std::uint64_t mix(std::uint64_t h) {  // the finaliser of MurmurHash3
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdull;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ull;
  return h ^ (h >> 33);
}

/// For each of `count` items, the first item that equals it.
template <class Hash, class Equal>
std::vector<std::uint32_t> first_equal(std::size_t count, Hash hash, Equal equal) {
  const std::size_t mask = std::bit_ceil(count * 2 + 1) - 1;
  std::vector<std::uint32_t> table(mask + 1, kNoVertex), first(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::size_t slot = hash(i) & mask;
    while (table[slot] != kNoVertex && !equal(table[slot], i)) slot = (slot + 1) & mask;
    if (table[slot] == kNoVertex) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// True if it is an even permutation of its sorted corners.
bool is_even(const Triangle& t) {
  return (t[0] < t[1] && t[1] < t[2]) || (t[1] < t[2] && t[2] < t[0]) || (t[2] < t[0] && t[0] < t[1]);
}

bool has_repeated_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// True if the three corners lie on a line, up to rounding. Needles with sines down to 1e-15 do not count as such.
bool is_flat(const std::vector<Point>& vertices, const Triangle& t) {
  double shorter = 0;
  const Point area = double_area(vertices[t[0]], vertices[t[1]], vertices[t[2]], shorter);
  return !(length(area) > kAreaRounding * shorter);
}

/// Keeps the triangles for which keep[i], with their origins.
void keep_triangles(PreparedMesh& prepared, const std::vector<bool>& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    prepared.mesh.triangles[kept] = prepared.mesh.triangles[i];
    prepared.input_of_triangle[kept++] = prepared.input_of_triangle[i];
  }
  prepared.mesh.triangles.resize(kept);
  prepared.input_of_triangle.resize(kept);
}

/// A cap is a triangle whose corner b lies on its longest side (a, c). Dropping it alone would leave a crack of three
/// open edges; instead the neighbour (a, c, d) across that side becomes (a, b, d) and (b, c, d), which covers the same
/// points. One round handles caps whose neighbours are not changed twice.
std::uint64_t repair_caps_once(PreparedMesh& prepared) {
  std::vector<Triangle>& triangles = prepared.mesh.triangles;
  const std::vector<Point>& vertices = prepared.mesh.vertices;
  std::vector<std::uint32_t> caps;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (is_flat(vertices, triangles[i])) caps.push_back(i);
  }
  if (caps.empty()) return 0;
  const MeshTopology topology(prepared.mesh);
  std::vector<bool> changed(triangles.size(), false);
  std::uint64_t repaired = 0;
  for (const std::uint32_t cap : caps) {
    if (changed[cap]) continue;
    int longest = 0;
    std::array<double, 3> squared;
    for (int k = 0; k < 3; ++k) {
      const Point side = vertices[triangles[cap][(k + 1) % 3]] - vertices[triangles[cap][k]];
      squared[k] = dot(side, side);
      if (squared[k] > squared[longest]) longest = k;
    }
    const std::uint32_t middle = triangles[cap][(longest + 2) % 3];
    const std::uint32_t edge = topology.edge_of(cap, longest);
    const auto beside = topology.triangles_of(edge);
    if (beside.size() != 2) continue;
    const std::uint32_t neighbour = beside[0] == cap ? beside[1] : beside[0];
    if (changed[neighbour]) continue;
    Triangle t = triangles[neighbour];
    for (int k = 0; topology.edge_of(neighbour, k) != edge; ++k) t = {t[1], t[2], t[0]};
    if (t[2] == middle) continue;  // the neighbour is the back of the cap
    triangles[neighbour] = {t[0], middle, t[2]};
    changed[neighbour] = changed[cap] = true;
    triangles[cap] = {middle, t[1], t[2]};
    prepared.input_of_triangle[cap] = prepared.input_of_triangle[neighbour];
    ++repaired;
  }
  return repaired;
}

void drop_degenerate(PreparedMesh& prepared) {
  const std::vector<Point>& vertices = prepared.mesh.vertices;
  std::vector<bool> keep(prepared.mesh.triangles.size());
  const auto drop = [&](auto is_degenerate) {
    keep.assign(prepared.mesh.triangles.size(), true);
    std::uint64_t dropped = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (is_degenerate(prepared.mesh.triangles[i])) {
        keep[i] = false;
        ++dropped;
      }
    }
    if (dropped > 0) keep_triangles(prepared, keep);
    prepared.report.degenerates_dropped += dropped;
  };
  drop(has_repeated_corner);
  // Each repair removes one cap; the parts of a neighbour that was a cap too are shorter caps, hence the rounds.
  constexpr int kRounds = 16;
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t repaired = repair_caps_once(prepared);
    if (repaired == 0) break;
    prepared.report.caps_repaired += repaired;
  }
  prepared.report.degenerates_dropped += prepared.report.caps_repaired;
  drop([&](const Triangle& t) { return is_flat(vertices, t); });
}

/// Pairs of opposite faces between two solids that touch: removing both leaves the same points inside, and the mesh
/// closed. Such a wall is a connected set of pairs with an outline, at each edge of which there is an even number of
/// other faces, at least two. A sheet that is covered on both sides has an outline without other faces, a surface that
/// is doubled everywhere has no outline, and the outline of a surplus face on a closed surface has one other face: all
/// of these keep one face of each pair.
void mark_inner_walls(const PreparedMesh& prepared, const std::vector<std::uint32_t>& first,
                      std::vector<std::uint8_t>& copies, std::vector<bool>& is_wall) {
  const std::vector<Triangle>& triangles = prepared.mesh.triangles;
  const MeshTopology topology(prepared.mesh);
  const auto is_pair = [&](std::uint32_t t) { return copies[first[t]] == 2; };
  std::vector<bool> seen(triangles.size(), false);
  std::vector<bool> edge_seen(topology.edge_count(), false);  // all pairs at an edge are of one region
  std::vector<std::uint32_t> region;
  for (std::uint32_t start = 0; start < triangles.size(); ++start) {
    if (first[start] != start || !is_pair(start) || seen[start]) continue;
    region.assign(1, start);
    seen[start] = true;
    bool held = false, loose = false;
    for (std::size_t at = 0; at < region.size(); ++at) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t edge = topology.edge_of(region[at], k);
        if (edge_seen[edge]) continue;
        edge_seen[edge] = true;
        std::uint32_t pairs = 0, others = 0;
        for (const std::uint32_t t : topology.triangles_of(edge)) {
          if (first[t] != t) continue;
          if (!is_pair(t)) {
            ++others;
            continue;
          }
          ++pairs;
          if (!seen[t]) {
            seen[t] = true;
            region.push_back(t);
          }
        }
        const bool is_rim = pairs == 1;
        held = held || (is_rim && others > 0);
        loose = loose || (is_rim && (others == 0 || others % 2 != 0));
      }
    }
    if (held && !loose) {
      for (const std::uint32_t t : region) is_wall[t] = true;
    }
  }
}

void drop_duplicates(PreparedMesh& prepared) {
  const std::vector<Triangle>& triangles = prepared.mesh.triangles;
  const auto hash = [&](std::uint32_t i) {
    const Triangle t = sorted(triangles[i]);
    return mix(mix(std::uint64_t{t[0]} << 32 | t[1]) + t[2]);
  };
  const std::vector<std::uint32_t> first = first_equal(triangles.size(), hash, [&](std::uint32_t i, std::uint32_t j) {
    return sorted(triangles[i]) == sorted(triangles[j]);
  });
  // Per distinct face: 1 alone, 2 two opposite ones, 3 anything else.
  std::vector<std::uint8_t> copies(triangles.size(), 0);
  std::vector<bool> keep(triangles.size(), true);
  bool any = false, any_pair = false;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    std::uint8_t& count = copies[first[i]];
    if (count == 0) {
      count = 1;
      continue;
    }
    count = count == 1 && is_even(triangles[i]) != is_even(triangles[first[i]]) ? 2 : 3;
    keep[i] = false;
    any = true;
    any_pair = any_pair || count == 2;
  }
  if (!any) return;
  std::vector<bool> is_wall(triangles.size(), false);
  if (any_pair) mark_inner_walls(prepared, first, copies, is_wall);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (is_wall[first[i]]) {
      keep[i] = false;
      ++prepared.report.inner_walls_dropped;
    }
    if (!keep[i]) ++prepared.report.duplicates_dropped;
  }
  keep_triangles(prepared, keep);
}

void drop_unused_vertices(PreparedMesh& prepared) {
  Mesh& mesh = prepared.mesh;
  std::vector<std::uint32_t> renamed(mesh.vertices.size(), kNoVertex);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) renamed[v] = 0;
  }
  std::uint32_t used = 0;
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] == kNoVertex) continue;
    mesh.vertices[used] = mesh.vertices[v];
    renamed[v] = used++;
  }
  prepared.report.unused_vertices = mesh.vertices.size() - used;
  if (prepared.report.unused_vertices == 0) return;
  mesh.vertices.resize(used);
  for (Triangle& t : mesh.triangles) t = {renamed[t[0]], renamed[t[1]], renamed[t[2]]};
  for (std::uint32_t& v : prepared.vertex_of_input) v = renamed[v];
}

}  // namespace

std::vector<std::uint32_t> merge_equal_vertices(Mesh& mesh) {
  const auto bits = [&](std::uint32_t i, int k) {  // adding 0 makes -0 to 0
    return std::bit_cast<std::uint64_t>(mesh.vertices[i][k] + 0.0);
  };
  std::vector<std::uint32_t> merged = first_equal(
      mesh.vertices.size(), [&](std::uint32_t i) { return mix(mix(mix(bits(i, 0)) + bits(i, 1)) + bits(i, 2)); },
      [&](std::uint32_t i, std::uint32_t j) { return mesh.vertices[i] == mesh.vertices[j]; });
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < merged.size(); ++i) {
    if (merged[i] == i) {
      mesh.vertices[kept] = mesh.vertices[i];
      merged[i] = kept++;
    } else {
      merged[i] = merged[merged[i]];  // the first one comes earlier: already renamed
    }
  }
  if (kept == mesh.vertices.size()) return merged;
  mesh.vertices.resize(kept);
  for (Triangle& t : mesh.triangles) t = {merged[t[0]], merged[t[1]], merged[t[2]]};
  return merged;
}

void clean_mesh(PreparedMesh& prepared) {
  Mesh& mesh = prepared.mesh;
  const std::size_t vertices_before = mesh.vertices.size();
  prepared.vertex_of_input = merge_equal_vertices(mesh);
  prepared.report.merged_vertices = vertices_before - mesh.vertices.size();
  prepared.input_of_triangle.resize(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) prepared.input_of_triangle[i] = i;
  prepared.report.degenerates_dropped = mesh.short_polygons;
  prepared.report.fallback_polygons = mesh.fallback_polygons;
  drop_degenerate(prepared);
  drop_duplicates(prepared);
  drop_unused_vertices(prepared);
}

}  // namespace medial_vk
