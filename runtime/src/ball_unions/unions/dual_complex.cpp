#include <algorithm>
#include <numeric>
#include <utility>

#include "ball_unions/unions/simplex_lists.h"
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

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count), sets_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// True if they were in different sets.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    --sets_;
    return true;
  }
  std::size_t sets() const { return sets_; }

 private:
  std::vector<std::size_t> parent_;
  std::size_t sets_;
};

DisjointSets join_vertices(const DualComplex& complex) {
  DisjointSets sets(complex.vertices.size());
  for (const auto& [a, b] : complex.edges) sets.join(index_in(complex.vertices, a), index_in(complex.vertices, b));
  return sets;
}

}  // namespace

std::uint64_t count_components(const DualComplex& complex) { return join_vertices(complex).sets(); }

std::vector<std::uint32_t> number_components(const DualComplex& complex) {
  DisjointSets sets = join_vertices(complex);
  std::vector<std::uint32_t> number(complex.vertices.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const std::size_t first = sets.find(i);  // the smallest index of the set
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
