// The envelope of a union of balls as parts of spheres, arcs and points, and distances to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/unions/union_measurer.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/result.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// A point of the envelope, and its distance from another point.
struct EnvelopePoint {
  double distance;
  Point at;
};

/// The envelope E of balls is the set f = 0 of f(p) = min |p - c_i| - r_i. (docs/theory.md, "Tight spheres")
class Envelope {
 public:
  /// At least one ball. Errors: those of measure_ball_union().
  static Result<Envelope> build(std::span<const Ball> balls, unsigned threads = 0);
  /// Of no ball.
  Envelope() : tree_({}) {}
  /// The same as build() on the threads of a pool, in the memory that it and the measurer have.
  Status rebuild(std::span<const Ball> balls, UnionMeasurer& measurer, WorkerPool& pool);

  const NearestBallTree& tree() const { return tree_; }
  const BallUnion& measured() const { return union_; }
  /// Common points of three spheres, computed, that lie in no ball by more than tolerance() or by more than error_of()
  /// them. Where more than three spheres meet there may be several of them.
  const std::vector<EnvelopeVertex>& vertices() const { return vertices_; }
  /// Bound of the distance of a computed vertex from the common point of its three spheres. Where the centres are
  /// nearly on one line, no more than the diameter of the smallest sphere.
  double error_of(const EnvelopeVertex& vertex) const;
  /// The greatest depth in a ball at which a point still counts as one of the envelope.
  double tolerance() const { return tolerance_; }

  /// Bound of the error of distance(): 4 tolerance(), or more where a vertex is less well known.
  double distance_error() const { return distance_error_; }

  /// From a point to the envelope, on either side of it, within distance_error(). If the exact answer is at most
  /// `enough`, the result may be any number between it and `enough`.
  double distance(const Point& p, double enough = 0) const { return nearest(p, enough).distance; }
  /// The same with a point of the envelope at that distance.
  EnvelopePoint nearest(const Point& p, double enough = 0) const;
  /// From a point in the balls to where the half-line along a unit direction first leaves them, unless that is farther
  /// than `most`: then infinity. The point there is in no ball by more than tolerance().
  double distance_along(const Point& p, const Point& direction, double most) const;
  /// The same as distance(), negative in the balls (Figure 8-2 has the opposite sign for the boundary).
  double signed_distance(const Point& p) const;

 private:
  /// Of the balls of the tree and their union.
  void find_vertices();
  void improve(std::uint32_t ball, const Point& p, EnvelopePoint& best) const;
  void improve_on_arc(std::uint32_t ball, std::uint32_t other, const Point& p, EnvelopePoint& best) const;
  bool is_exposed(const Point& p) const { return !tree_.holds(p, tolerance_); }
  void add_vertices(const std::array<std::uint32_t, 3>& balls);

  NearestBallTree tree_;
  BallUnion union_;
  double tolerance_ = 0;
  double distance_error_ = 0;
  std::vector<EnvelopeVertex> vertices_;
  // Of ball i: arcs with greater balls and vertices of greater balls, [first[i], first[i + 1]).
  std::vector<std::uint32_t> first_arc_, first_vertex_;
};

/// The common points of three spheres, up to two; one where they only touch, within `tolerance` of their radii.
std::size_t meet(const Ball& a, const Ball& b, const Ball& c, double tolerance, std::array<Point, 2>& points);

}  // namespace medial_vk
