// What is known about the balls that come close to a point: contacts, the largest ball, balls on the other side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bvh/wide_tree.h"
#include "medial_vk/ball.h"
#include "medial_vk/thickness.h"
#include "solid/solid.h"
#include "thickness/ball_kind.h"
#include "thickness/contact_lists.h"
#include "thickness/contact_pool.h"

namespace medial_vk {

/// A solid and what all searches on it share.
struct ThicknessField {
  const Solid& solid;
  const WideTree& tree;
  ThicknessOptions options;  ///< With all values set.
};

/// Computes distances of centres, and keeps what they say. All coordinates are relative to the point.
class BallsNear {
 public:
  explicit BallsNear(const ThicknessField& field);

  /// For another point. Contacts that were of use at the last one are kept.
  void start(const Point& p);
  /// Finds the farthest centre on a ray whose ball comes within delta of p, up to a share of the width, or contacts
  /// that show that the centres of such balls are no farther away than the target, or one that makes this reach
  /// shorter.
  void probe(const Point& direction, double reach);
  /// Computes the distance of a centre, keeps its contact, and keeps its ball if it comes within delta of p.
  struct Probe {
    bool is_near;   ///< A ball around the centre comes within delta of p.
    double along;   ///< Of the contact, in the direction of the centre.
    double radius;  ///< Of that ball.
  };
  Probe probe_at(const Point& direction, double distance);
  /// Takes the contact from the last points that has the least reach in a direction, if that is less than `reach`, and
  /// returns its reach; else returns `reach`, as always in a long search.
  double recall(const Point& direction, double reach);
  void add_mixture(const Contact& contact) { add(contact, {0, 0, 0}); }

  /// The greatest distance of centres that is in question at all.
  double most_reach() const { return limit_ + delta_; }
  /// Balls that are not larger need not be found. Above all balls that were found; it is raised by the relative width
  /// above a ball that is larger.
  double target() const { return target_; }
  /// The ball around a centre that is no farther from p is not larger than the target.
  double least_reach() const { return target() - off_; }
  /// Less than the target by the rounding of distances from contacts.
  double target_of_contacts() const { return target() / kBoundRounding - rounding_; }
  /// No further distances are of use, as no ball counts as larger than the best one, or may be computed.
  bool is_exhausted() const { return best_.radius >= limit_ || queries_ >= field_.options.queries; }
  /// The same after so many cells of directions: a point in the solid may have more of them than memory holds, in whose
  /// middles no distance is needed.
  bool is_exhausted(std::uint64_t cells) const {
    return is_exhausted() || cells / kMostCells >= field_.options.queries;
  }

  ContactLists& contacts() { return contacts_; }
  void mark_used(std::size_t contact) { used_[contact] = true; }
  const Slack& slack() const { return slack_; }
  double delta() const { return delta_; }
  double off() const { return off_; }
  double limit() const { return limit_; }
  const Ball& best() const { return best_; }

  /// Balls on the other side, the last ones.
  const std::vector<Ball>& others() const { return others_; }
  /// Lessened by the rounding of distances.
  double radius_of_other(const Ball& other) const { return other.radius - rounding_; }
  /// In a closed mesh: true if no ball that is larger than the target has its centre in a direction whose product with
  /// the centre of `other` is at least this.
  bool are_on_other_side(const Ball& other, double least_product) const;
  /// In a closed mesh, the open ball around a centre and all points in it are on one side.
  bool is_closed_mesh() const { return field_.solid.mesh().report.closed; }

  void keep_used();
  /// Meets the point of the boundary that is nearest to the best ball on the side opposite to a direction.
  void look_across(const Point& direction);
  /// The points of the boundary, relative to p, that are within `beyond` of the best ball, and the normals there, away
  /// from its centre.
  void collect_contacts(double beyond, std::vector<BallContact>& found) const;

 private:
  static constexpr std::uint64_t kMostCells = 64;  // for each distance that may be computed
  void go_back(const Point& direction, double distance, Probe found);
  void add(const Contact& contact, const Point& normal);
  void record(const Point& offset, double radius);
  double gap_above(double radius) const;
  void raise_target(double radius);
  bool is_point(std::size_t contact) const { return normals_[contact] != Point{0, 0, 0}; }
  SolidSide side_of(const Point& centre, double radius) const;

  const ThicknessField& field_;
  double delta_, limit_;
  Point p_ = {0, 0, 0};
  double rounding_ = 0;  // of distances and products
  Slack slack_;
  double off_ = 0;  // at least the distance of p from the boundary
  ContactLists contacts_;
  ContactPool pool_;
  std::vector<bool> used_;      // by contact: it has shown something
  std::vector<Point> normals_;  // by contact: away from the centre that it was met from; zero: a mixture
  std::vector<Ball> others_;
  std::vector<BallContact> kept_;  // contacts that were of use at the last point, with coordinates of the mesh
  BallContact at_p_;               // the point of the boundary nearest to p, and the normal of its triangle
  Ball best_;
  double target_ = 0;
  double doubtful_ = 0;  // the radius of a ball on an unknown side, which counts for the upper bound alone
  std::size_t queries_ = 0;
};

}  // namespace medial_vk
