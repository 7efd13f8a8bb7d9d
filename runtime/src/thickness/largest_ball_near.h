// The largest ball in a solid, or outside it, that comes close to a point (docs/theory.md, "Thickness").
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bvh/wide_tree.h"
#include "medial_vk/ball.h"
#include "medial_vk/thickness.h"
#include "solid/solid.h"
#include "thickness/contact_lists.h"
#include "thickness/direction_cell.h"

namespace medial_vk {

/// A solid and what all searches on it share.
struct ThicknessField {
  const Solid& solid;
  const WideTree& tree;
  ThicknessOptions options;  ///< With all values set.
};

/// Searches for one point after another in the same memory. Contacts that were of use at one point are tried first at
/// the next, which had better be near.
class LargestBallNear {
 public:
  explicit LargestBallNear(const ThicknessField& field);

  /// `inward`: a unit vector that is likely to lead to the ball.
  Thickness find(const Point& p, const Point& inward);

 private:
  /// Directions in which there may be larger balls than the target.
  struct Open {
    DirectionCell cell;
    double reach;                  // no centre of a ball is farther from p
    ContactLists::List list = {};  // contacts that may bound balls in a part of the cell
    std::uint32_t number = 0;      // for one order of equals
  };
  struct Probe {
    bool is_near;   // a ball around the centre comes within delta of p
    double along;   // of the contact, in the direction of the centre
    double radius;  // of that ball
  };

  void start(const Point& p, const Point& inward);
  double target() const;
  double least_reach() const;
  void divide(const CubeFrame& frame);
  void push(Open open);
  double reach_along_middle(const Open& open) const;
  void evaluate(Open& open);
  bool is_closed(const Open& open);
  bool is_on_other_side(const Open& open) const;
  double shown_up_to(const FourDirections& directions, double bulge, const Open& open);
  Probe probe_at(const Point& direction, double distance);
  void probe(const Point& direction, double reach);
  void go_back(const Point& direction, double distance, Probe found);
  void show_along(Open& open);
  void mix_along(Open& open);
  void add(const Contact& contact, bool is_point);
  void record(const Point& offset, double radius);
  SolidSide side_of(const Point& centre, double radius) const;
  void keep_used();
  double object_angle() const;

  const ThicknessField& field_;
  double delta_, limit_;
  Point p_ = {0, 0, 0};
  double rounding_ = 0;  // of distances and products
  Slack slack_;
  double off_ = 0;  // at least the distance of p from the boundary
  ContactLists contacts_;
  std::vector<bool> used_;      // by contact: it has closed a cell
  std::vector<bool> is_point_;  // by contact: a point of the boundary, and no mixture
  std::vector<Open> open_;      // a heap by reach
  std::vector<Ball> others_;    // balls on the other side, with centres relative to p
  std::vector<ContactLists::Interval> intervals_;
  std::vector<Point> kept_;  // contacts that were of use at the last point
  Ball best_;                // its centre is relative to p
  double doubtful_ = 0;      // the radius of a ball on an unknown side, which counts for the upper bound alone
  std::uint32_t number_ = 0;
  std::size_t queries_ = 0;
};

}  // namespace medial_vk
