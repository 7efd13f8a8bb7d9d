// Lists of simplices as sorted arrays.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

inline void append(DualComplex& all, const DualComplex& more) {
  append(all.vertices, more.vertices);
  append(all.edges, more.edges);
  append(all.triangles, more.triangles);
  append(all.tetrahedra, more.tetrahedra);
}

/// Without giving memory back.
inline void clear(DualComplex& complex) {
  complex.vertices.clear();
  complex.edges.clear();
  complex.triangles.clear();
  complex.tetrahedra.clear();
}

/// A simplex without its vertex k.
template <std::size_t N>
std::array<std::uint32_t, N - 1> face(const std::array<std::uint32_t, N>& simplex, std::size_t k) {
  std::array<std::uint32_t, N - 1> result;
  for (std::size_t i = 0, n = 0; i < N; ++i) {
    if (i != k) result[n++] = simplex[i];
  }
  return result;
}

/// The index of a simplex in a sorted list that holds it.
template <class T>
std::size_t index_in(const std::vector<T>& list, const T& simplex) {
  return static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), simplex) - list.begin());
}

std::uint64_t count_components(const DualComplex& complex);
/// By vertex, numbered in the order of their first vertices.
std::vector<std::uint32_t> number_components(const DualComplex& complex);

/// Sorts all lists and adds missing faces. Faces are missing by rounding only: if a simplex barely meets its ball, its
/// faces may have been found to miss theirs.
void make_complete(DualComplex& complex, std::vector<EnvelopeVertex>& vertices);

}  // namespace medial_vk
