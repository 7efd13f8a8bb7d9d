#include <algorithm>
#include <utility>

#include "ball_unions/unions/simplex_lists.h"
#include "base/disjoint_sets.h"
#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

template <std::size_t N>
void add_faces(const std::vector<std::array<std::uint32_t, N>>& simplices,
               std::vector<std::array<std::uint32_t, N - 1>>& faces) {
  const std::size_t known = faces.size();
  for (const auto& simplex : simplices) {
    for (std::size_t k = 0; k < N; ++k) {
      const auto side = face(simplex, k);
      const auto end = faces.begin() + static_cast<std::ptrdiff_t>(known);
      if (!std::binary_search(faces.begin(), end, side)) faces.push_back(side);
    }
  }
  if (faces.size() > known) sort_unique(faces);
}

/// Joins the vertices that edges connect. Returns the number of sets.
std::size_t join_vertices(const DualComplex& complex, DisjointSets& sets) {
  std::size_t count = complex.vertices.size();
  sets.reset(count);
  const auto place = [&](std::uint32_t vertex) {
    return static_cast<std::uint32_t>(index_in(complex.vertices, vertex));
  };
  for (const auto& [a, b] : complex.edges) {
    if (sets.join(place(a), place(b))) --count;
  }
  return count;
}

}  // namespace

std::uint64_t count_components(const DualComplex& complex) {
  DisjointSets sets;
  return join_vertices(complex, sets);
}

std::vector<std::uint32_t> number_components(const DualComplex& complex) {
  DisjointSets sets;
  join_vertices(complex, sets);
  std::vector<std::uint32_t> number(complex.vertices.size());
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    const std::uint32_t first = sets.of(i);  // the smallest index of the set
    number[i] = first == i ? next++ : number[first];
  }
  return number;
}

void make_complete(DualComplex& complex, std::vector<EnvelopeVertex>& vertices) {
  sort_unique(complex.vertices);
  sort_unique(complex.edges);
  sort_unique(complex.triangles);
  sort_unique(complex.tetrahedra);
  add_faces(complex.tetrahedra, complex.triangles);
  add_faces(complex.triangles, complex.edges);
  for (const auto& edge : complex.edges) complex.vertices.insert(complex.vertices.end(), edge.begin(), edge.end());
  sort_unique(complex.vertices);
  std::sort(vertices.begin(), vertices.end(), [](const EnvelopeVertex& a, const EnvelopeVertex& b) {
    return std::pair(a.balls, a.at) < std::pair(b.balls, b.at);
  });
}

}  // namespace medial_vk
