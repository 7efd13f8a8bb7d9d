// Directions from a point, divided by the contacts that bound balls there (docs/theory.md, "Thickness").
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "thickness/balls_near.h"
#include "thickness/direction_polytope.h"

namespace medial_vk {

/// Encloses the centres in question by a polytope: each contact cuts off the half-space beyond it, until no vertex is
/// farther from p than the target.
class FacetSearch {
 public:
  explicit FacetSearch(BallsNear& balls) : balls_(balls) {}

  /// Computes distances at vertices that are too far. `frame`: with the likely direction of the ball as third axis.
  void run(const CubeFrame& frame);

  /// Directions in which there may be larger balls than the target, as triangles of directions, with a reach in each.
  struct OpenTriangle {
    std::array<Point, 3> corners;
    double reach;
  };
  const std::vector<OpenTriangle>& open() const { return open_; }

 private:
  using Vertex = DirectionPolytope::Vertex;

  /// Shows something of the directions in its cone: a contact, or a ball on the other side; if neither, nothing.
  struct Face {
    enum class Kind : std::uint8_t { kNothing, kContact, kOtherSide } kind = Kind::kNothing;
    std::uint32_t contact = 0;
    Ball other = {};
    double least_product = 0;  // of a direction to a corner with the contact, or the centre of the ball
    std::uint32_t first = 0;   // a vertex, and its place among the faces of this vertex
    std::uint32_t place = 0;
    bool is_present = false;
  };

  void build(const CubeFrame& frame);
  void refine(const CubeFrame& frame);
  bool is_within_contacts(const Vertex& vertex);
  void probe(const Vertex& vertex, const Point& direction);
  bool cut_by_known(const Vertex& vertex, const Point& direction);
  bool cut_by_contact(const Vertex& vertex, const Point& direction);
  bool cut_by_other_side(const Vertex& vertex, const Point& direction);
  bool cut(const Point& normal, double offset, const Face& face);
  void collect_open();
  void measure_faces();
  double reach_of(const Face& face) const;
  bool is_closed(const Face& face, double reach);
  bool is_on_other_side(const Face& face) const;
  bool is_within_contact(const Face& face, double reach);
  void collect_corners(const Face& face, std::uint32_t number);

  BallsNear& balls_;
  DirectionPolytope polytope_;
  std::vector<Face> faces_;  // by number
  std::vector<OpenTriangle> open_;
  std::vector<Point> corners_;  // directions
  double built_for_ = 0;
};

}  // namespace medial_vk
