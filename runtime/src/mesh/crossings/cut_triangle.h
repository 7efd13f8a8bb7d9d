// The triangulation of one triangle with points and segments in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "mesh/crossings/exact_points.h"

namespace medial_vk {

/// Points are named by their order of insertion; the corners are 0, 1 and 2. The first step that returns false has met
/// a degenerate position, and the object is then of no further use.
class CutTriangle {
 public:
  CutTriangle(ExactGeometry& geometry, const GridTriangle& corners);

  /// A point in the triangle, on its edges included.
  bool insert(const ExactPoint& point);
  /// A segment between two points. It meets other segments in points that have been inserted only; these divide it.
  bool add_segment(std::uint32_t from, std::uint32_t to);
  /// Flips edges that are no segments where that makes the sum of the angles opposite to them smaller (Lawson's
  /// criterion, in double): fewer needles.
  void improve();

  /// Of the same orientation as the corners.
  std::vector<std::array<std::uint32_t, 3>> triangles() const;

 private:
  using Corners = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return sign_ * geometry_.orientation(points_[a], points_[b], points_[c], axis_);
  }
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }
  static std::uint64_t undirected(std::uint32_t a, std::uint32_t b) { return a < b ? key(a, b) : key(b, a); }

  /// The triangle to the left of the directed edge, or kNone.
  std::uint32_t left_of(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t apex(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const;
  void put(std::uint32_t triangle, const Corners& corners);
  void add(const Corners& corners);
  void remove_edges(std::uint32_t triangle);
  bool split(std::uint32_t triangle, std::uint32_t point);
  void split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t point);
  bool flip(std::uint32_t a, std::uint32_t b, std::array<std::uint32_t, 2>& made);
  bool collect_crossed(std::uint32_t from, std::uint32_t to, std::vector<std::array<std::uint32_t, 2>>& edges,
                       std::uint32_t& on_the_way);
  bool should_flip(std::uint32_t a, std::uint32_t b) const;
  double cotangent(std::uint32_t at, std::uint32_t a, std::uint32_t b) const;

  ExactGeometry& geometry_;
  int axis_, sign_;
  std::vector<ExactPoint> points_;
  std::vector<Corners> triangles_;
  std::unordered_map<std::uint64_t, std::uint32_t> left_;  // by directed edge
  std::unordered_set<std::uint64_t> segments_;             // undirected
};

}  // namespace medial_vk
