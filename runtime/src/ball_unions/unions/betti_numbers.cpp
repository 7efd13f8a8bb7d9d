// Homology of a complex in space, by collapses first and by elimination for the rest.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "ball_unions/unions/simplex_lists.h"
#include "base/host_memory.h"
#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Cofaces, not yet collapsed, of the faces of one dimension: their number, and the sum of their indices, which is the
/// index of the coface where there is only one.
struct Cofaces {
  std::vector<std::uint32_t> count;
  std::vector<std::uint64_t> sum;

  explicit Cofaces(std::size_t faces) : count(faces), sum(faces) {}
  void add(std::size_t face, std::size_t coface) {
    ++count[face];
    sum[face] += coface;
  }
  void remove(std::size_t face, std::size_t coface) {
    --count[face];
    sum[face] -= coface;
  }
};

template <std::size_t N>
std::vector<std::array<std::uint32_t, N>> faces_by_index(const std::vector<std::array<std::uint32_t, N>>& simplices,
                                                         const std::vector<std::array<std::uint32_t, N - 1>>& faces) {
  std::vector<std::array<std::uint32_t, N>> result(simplices.size());
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    for (std::size_t k = 0; k < N; ++k)
      result[s][k] = static_cast<std::uint32_t>(index_in(faces, face(simplices[s], k)));
  }
  return result;
}

/// Removes pairs of a simplex and a face of it that is in no other, as long as there are any, which preserves the
/// homotopy type. `gone_faces` marks all removed faces.
template <std::size_t N>
std::vector<bool> collapse(const std::vector<std::array<std::uint32_t, N>>& sides, std::vector<bool>& gone_faces,
                           std::vector<bool> gone) {
  Cofaces cofaces(gone_faces.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (gone[s]) continue;
    for (const std::uint32_t side : sides[s]) cofaces.add(side, s);
  }
  std::vector<std::uint32_t> free;
  for (std::uint32_t f = 0; f < gone_faces.size(); ++f) {
    if (cofaces.count[f] == 1) free.push_back(f);
  }
  while (!free.empty()) {
    const std::uint32_t f = free.back();
    free.pop_back();
    if (cofaces.count[f] != 1) continue;
    const auto s = static_cast<std::size_t>(cofaces.sum[f]);
    gone[s] = true;
    gone_faces[f] = true;
    for (const std::uint32_t side : sides[s]) {
      cofaces.remove(side, s);
      if (cofaces.count[side] == 1) free.push_back(side);
    }
  }
  return gone;
}

/// The rank over Z/2 of the boundary operator from the remaining triangles to edges: columns are added to each other
/// until no two have the same last edge.
std::uint64_t boundary_rank(const std::vector<std::array<std::uint32_t, 3>>& sides, const std::vector<bool>& gone,
                            std::size_t edges) {
  std::vector<std::vector<std::uint32_t>> columns;
  std::vector<std::uint32_t> owner(edges, kNone);  // by edge: the column that ends with it
  std::uint64_t rank = 0;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    if (gone[t]) continue;
    std::vector<std::uint32_t> column(sides[t].begin(), sides[t].end());
    std::sort(column.begin(), column.end());
    while (!column.empty() && owner[column.back()] != kNone) {
      std::vector<std::uint32_t> sum;
      const std::vector<std::uint32_t>& other = columns[owner[column.back()]];
      std::set_symmetric_difference(column.begin(), column.end(), other.begin(), other.end(), std::back_inserter(sum));
      column = std::move(sum);
    }
    if (column.empty()) continue;
    owner[column.back()] = static_cast<std::uint32_t>(columns.size());
    columns.push_back(std::move(column));
    ++rank;
  }
  return rank;
}

std::uint64_t left_over(const std::vector<bool>& gone) {
  return static_cast<std::uint64_t>(std::count(gone.begin(), gone.end(), false));
}

// A complex of finitely many tetrahedra in space has a triangle that is in one of them only, so all of them collapse.
// The number of cavities is the dimension of the cycles of remaining triangles: the number of these triangles less the
// rank of their boundary operator. Tunnels follow from the Euler characteristic, which collapses do not change.
BettiNumbers count_homology(const DualComplex& complex) {
  const auto tetrahedra = faces_by_index(complex.tetrahedra, complex.triangles);
  const auto triangles = faces_by_index(complex.triangles, complex.edges);
  std::vector<bool> gone_triangles(complex.triangles.size()), gone_edges(complex.edges.size());
  const std::vector<bool> gone = collapse(tetrahedra, gone_triangles, std::vector<bool>(tetrahedra.size()));
  gone_triangles = collapse(triangles, gone_edges, std::move(gone_triangles));

  BettiNumbers betti;
  betti.components = count_components(complex);
  // Remaining tetrahedra would fill cavities; a complex that lies in space has none.
  betti.cavities =
      left_over(gone_triangles) - boundary_rank(triangles, gone_triangles, complex.edges.size()) - left_over(gone);
  const auto size = [](const auto& list) { return static_cast<std::int64_t>(list.size()); };
  const std::int64_t euler =
      size(complex.vertices) - size(complex.edges) + size(complex.triangles) - size(complex.tetrahedra);
  betti.tunnels = static_cast<std::uint64_t>(static_cast<std::int64_t>(betti.components + betti.cavities) - euler);
  return betti;
}

}  // namespace

Result<BettiNumbers> betti_numbers(const DualComplex& complex) {
  return catch_out_of_memory("counting the holes of a union of balls",
                             [&]() -> Result<BettiNumbers> { return count_homology(complex); });
}

Result<std::vector<std::uint32_t>> component_of_vertices(const DualComplex& complex) {
  return catch_out_of_memory("numbering the components of a union of balls",
                             [&]() -> Result<std::vector<std::uint32_t>> { return number_components(complex); });
}

}  // namespace medial_vk
