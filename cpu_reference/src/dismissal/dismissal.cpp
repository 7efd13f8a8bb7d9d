#include "dismissal/dismissal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPairsToAimAt = 64;
constexpr double kFaceShare = 1.0 / 64;      // of the voxel side: the definition of "near a face"
constexpr double kBoundaryRadius = 1.0 / 8;  // of the voxel side: the definition of "at the boundary"
constexpr double kNearAngle = 0.05;          // radians: the definition of "near the threshold"

/// The part of a cell that is not near a face of its voxel; empty if any half is not positive.
Box away_from_faces(const Box& cell, const Box& voxel) {
  const Vector3d half = (1 - 2 * kFaceShare) * voxel.half;
  const Vector3d lower = (cell.centre - cell.half).cwiseMax(voxel.centre - half);
  const Vector3d upper = (cell.centre + cell.half).cwiseMin(voxel.centre + half);
  return {(lower + upper) / 2, (upper - lower) / 2};
}

}  // namespace

BoxTest::BoxTest(const Tree& tree, const SpokeCones& cones, const Box& box, const ContactList& list)
    : tree_(tree), cones_(cones), box_(box), list_(list), contacts_(list.within(box)) {}

bool BoxTest::dismisses(double angle) {
  if (spokes_are_close(tree_, contacts_, box_.reach(), angle)) return true;
  search_ = salient_pairs(tree_, box_, carriers(), angle, kPairsToAimAt);
  return search_.proves_empty();
}

const std::vector<Carrier>& BoxTest::carriers() {
  if (!has_carriers_) carriers_ = carriers_of(tree_, cones_, box_, nearest(), contacts_);
  has_carriers_ = true;
  return carriers_;
}

double BoxTest::width(double angle) {
  const PairSearch all = salient_pairs(tree_, box_, carriers(), angle, std::numeric_limits<std::size_t>::max());
  if (!all.complete) return 2 * (nearest().distance + box_.reach());
  double widest = 0;
  for (const CarrierPair& pair : all.pairs) widest = std::max(widest, width_of(pair));
  return widest;
}

// Feet A and B of m with object angle alpha are 2 D(m) sin(alpha) apart, and D(m) <= D_0 + reach; alpha is at most half
// the angle between any two spokes of the two caps. A is the point of its carrier nearest to m, and the projection on a
// convex set does not expand distances: A is within reach of the point nearest to the centre.
double BoxTest::width_of(const CarrierPair& pair) const {
  const Carrier &a = *pair.a, &b = *pair.b;
  const double between = 2 * half_angle(a.spokes.axis, b.spokes.axis) + a.spokes.angle + b.spokes.angle;
  const double greatest = std::min(std::numbers::pi, between) / 2;
  const double by_angle = 2 * (nearest().distance + box_.reach()) * std::sin(greatest);
  const double by_place = (a.distance * a.direction - b.distance * b.direction).norm() + 2 * box_.reach();
  return std::min(by_angle, by_place);
}

UndecidedKind kind_of(const Tree& tree, const SpokeCones& cones, const Thresholds& thresholds, BoxTest& test,
                      const ContactList& list, const Box& voxel) {
  const Box inner = away_from_faces(test.box(), voxel);
  // A small tolerance, for cells that end where the region near a face begins.
  if (inner.half.minCoeff() <= 1e-9 * voxel.half.minCoeff()) return UndecidedKind::kNearFace;
  const ContactList inner_list(list, inner.centre, inner.reach());
  BoxTest inner_test(tree, cones, inner, inner_list);
  const double angle = thresholds.angle_at(inner_test.nearest().distance + inner.reach());
  if (inner_test.dismisses(angle)) return UndecidedKind::kNearFace;
  if (inner_test.dismisses(angle + kNearAngle)) return UndecidedKind::kNearAngle;
  const double greatest_radius = test.nearest().distance + test.box().reach();
  const bool at_boundary = greatest_radius <= 2 * kBoundaryRadius * voxel.half.minCoeff();
  return at_boundary ? UndecidedKind::kBoundary : UndecidedKind::kOther;
}

}  // namespace medial_vk::reference
