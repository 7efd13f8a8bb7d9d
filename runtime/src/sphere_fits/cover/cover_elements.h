// The elements that balls must hold to cover a solid: small parts of its boundary and cells of its inside, each in one
// ball.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/probes.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// Convex hulls of a few points each: a ball holds an element if it holds its points. Triangles have three.
class CoverElements {
 public:
  /// About `elements` elements of the boundary (no fewer than it has triangles) and cells of a grid inside.
  CoverElements(const Solid& solid, std::size_t elements, const Threads& threads);

  std::size_t size() const { return first_.size() - 1; }
  std::span<const Point> points(std::uint32_t element) const {
    return {points_.data() + first_[element], first_[element + 1] - first_[element]};
  }
  const Point& middle(std::uint32_t element) const { return middle_[element]; }
  /// The area of a triangle, or what a probe counts for; zero for other elements.
  double area(std::uint32_t element) const { return area_[element]; }
  /// The outward unit normal of a triangle, or the direction of a probe; zero for other elements and for triangles
  /// without area.
  const Point& normal(std::uint32_t element) const { return normal_[element]; }
  /// From a probe to its point outside; zero for other elements.
  double distance(std::uint32_t element) const { return distance_[element]; }
  /// True if the ball holds the element.
  bool is_in(const Ball& ball, std::uint32_t element) const;
  /// The least radius around a centre that holds the element.
  double needed(const Point& centre, std::uint32_t element) const;
  /// The least radius around a centre that holds all these elements; 0 of none.
  double needed(const Point& centre, std::span<const std::uint32_t> elements) const;
  /// Indices of all elements whose middles are in the ball; a ball that holds an element holds its middle.
  void gather(const Ball& ball, std::vector<std::uint32_t>& found) const;

  void add(std::span<const Point> points);
  /// Adds elements of one point each, which count for `area` together. Precondition: there is a probe.
  void add(std::span<const Probe> probes, double area);
  /// Of all triangles.
  double whole_area() const { return whole_area_; }
  /// Divides these triangles in four; cells are unchanged. Other elements may change their indices.
  void refine(const std::vector<bool>& which);

 private:
  void add_triangle(const Point& a, const Point& b, const Point& c, double longest, int depth);
  void add_cells(const Solid& solid, const Threads& threads);
  /// Builds a tree of boxes of neighbours, so that few boxes exclude most elements for a ball, and orders the elements
  /// by its leaves.
  void arrange();
  void arrange(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order);
  void reorder(const std::vector<std::uint32_t>& order);

  std::vector<Point> points_;
  std::vector<std::uint32_t> first_ = {0};
  struct Box {
    Point lower, upper;          // of the middles
    std::uint32_t first, count;  // of its elements; 0 elements: not a leaf
    std::uint32_t next;          // the box after this one and its descendants
  };
  std::vector<Point> middle_;
  std::vector<double> extent_;  // the distance from the middle to the farthest point
  std::vector<double> area_;
  std::vector<Point> normal_;
  std::vector<double> distance_;
  double whole_area_ = 0;
  std::vector<Box> boxes_;    // each before those within it
  std::size_t arranged_ = 0;  // the number of elements in boxes; elements added later are in none
};

}  // namespace medial_vk
