#include "dismissal/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk::reference {

using Eigen::Vector3d;

ContactList::ContactList(const Tree& tree, const Mesh& mesh, const Vector3d& centre, double reach)
    : tree_(&tree), mesh_(&mesh), centre_(centre), nearest_(tree.closest(centre)) {
  nearest_direction_ = direction_to(centre, nearest_);
  for (int t : tree.gather(centre, nearest_.distance + 2 * reach + 4 * tree.rounding())) {
    measure(t, centre, reach);
  }
}

ContactList::ContactList(const ContactList& parent, const Vector3d& centre, double reach)
    : tree_(parent.tree_), mesh_(parent.mesh_), centre_(centre), nearest_(parent.closest(centre)) {
  nearest_direction_ = direction_to(centre, nearest_);
  const double farthest = nearest_.distance + 2 * reach + 4 * tree_->rounding();
  const Vector3d moved = centre - parent.centre_;
  contacts_.reserve(parent.contacts_.size());
  for (const Contact& contact : parent.contacts_) {
    if (contact.distance - contact.direction.dot(moved) <= farthest) measure(contact.triangle, centre, reach);
  }
}

void ContactList::measure(int triangle, const Vector3d& centre, double reach) {
  const TrianglePoint here = tree_->closest_on(triangle, centre);
  const double distance = std::sqrt(here.squared_distance);
  const Vector3d direction = distance > 0 ? Vector3d((here.point - centre) / distance) : Vector3d::Zero();
  const bool trusted = !mesh_->trusted.empty() && mesh_->trusted[triangle] != 0;
  const Contact contact = {direction, distance, triangle, trusted};
  if (can_touch(contact, reach)) contacts_.push_back(contact);
}

// Lemma A. Let x = m - centre, |x| <= reach. Distance to a convex set is convex with gradient -g_t, so
// dist(m, t) >= D_t - g_t . x. On the other hand dist(m, P0) = sqrt(D0^2 - 2 D0 g0 . x + |x|^2), which is at most
// D0 - g0 . x + |x|^2 / (2 D0) and at most D0 + |x|. If t is nearest to m, then D_t - D0 is at most
// reach |g_t - g0| + reach^2 / (2 D0), and at most 2 reach. The test allows four roundings of a distance in favour of
// keeping.
bool ContactList::can_touch(const Contact& contact, double reach) const {
  const double behind = contact.distance - nearest_.distance - 4 * tree_->rounding();
  if (behind > 2 * reach) return false;
  if (nearest_.distance <= 0) return true;
  const double spread = (contact.direction - nearest_direction_).norm();
  return behind <= reach * (spread + 1e-12) + reach * reach / (2 * nearest_.distance);
}

// Two computed distances: 2 rounding() each way; the test allows eight of them in favour of keeping.
BoxReach::BoxReach(const Tree& tree, const Box& box, int nearest_triangle) {
  for (int k = 0; k < 8; ++k) {
    corners_[k] = box.corner(k);
    const double squared = tree.closest_on(nearest_triangle, box.centre + corners_[k]).squared_distance;
    distances_[k] = std::sqrt(squared) + 8 * tree.rounding();
  }
}

bool BoxReach::touches(double distance, const Vector3d& direction) const {
  for (int k = 0; k < 8; ++k) {
    if (distance - direction.dot(corners_[k]) <= distances_[k]) return true;
  }
  return false;
}

std::vector<Contact> ContactList::within(const Box& box) const {
  const BoxReach reach(*tree_, box, nearest_.triangle);
  std::vector<Contact> touching;
  for (const Contact& contact : contacts_) {
    if (reach.touches(contact.distance, contact.direction)) touching.push_back(contact);
  }
  return touching;
}

std::vector<Contact> ContactList::within(double reach) const {
  std::vector<Contact> touching;
  touching.reserve(contacts_.size());
  for (const Contact& contact : contacts_) {
    if (can_touch(contact, reach)) touching.push_back(contact);
  }
  return touching;
}

// The convexity bound D_t - g_t . x of Lemma A saves most triangle tests: first the triangle where it is least, then
// those where it is below the distance found.
Closest ContactList::closest(const Vector3d& p) const {
  const Vector3d x = p - centre_;
  thread_local std::vector<double> bounds;
  bounds.resize(contacts_.size());
  double least = std::numeric_limits<double>::infinity();
  std::size_t first = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    bounds[i] = contacts_[i].distance - contacts_[i].direction.dot(x);
    if (bounds[i] < least) {
      least = bounds[i];
      first = i;
    }
  }
  TrianglePoint best = tree_->closest_on(contacts_[first].triangle, p);
  int triangle = contacts_[first].triangle;
  double limit = std::sqrt(best.squared_distance) + 4 * tree_->rounding();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (bounds[i] > limit || i == first) continue;
    const TrianglePoint here = tree_->closest_on(contacts_[i].triangle, p);
    if (here.squared_distance >= best.squared_distance) continue;
    best = here;
    triangle = contacts_[i].triangle;
    limit = std::sqrt(best.squared_distance) + 4 * tree_->rounding();
  }
  return {best.point, std::sqrt(best.squared_distance), triangle, best.feature};
}

namespace {

/// The two conditions by which a contact fits into a cone: `dot(normal, axis) > normal_cosine`, or the same for the
/// direction. A cosine of 2 excludes a condition.
struct Fit {
  Vector3d normal, direction;
  double normal_cosine = 2, direction_cosine = 2;
};

constexpr double kFitSlack = 1e-9;  // covers the rounding of dots and cosines (below 1e-14) many times over

std::vector<Fit> fits(const Tree& tree, std::span<const Contact> contacts, double reach, double angle) {
  std::vector<Fit> all;
  all.reserve(contacts.size());
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (const Contact& contact : contacts) {
    Fit fit;
    fit.normal = tree.normal(contact.triangle);
    fit.direction = contact.direction;
    if (contact.trusted) fit.normal_cosine = cosine + kFitSlack;
    // cos(angle - asin(reach / D)), open while asin(reach / D) < angle
    const double ratio = contact.distance > 0 ? reach / contact.distance : 1;
    if (ratio < sine) fit.direction_cosine = cosine * std::sqrt(1 - ratio * ratio) + sine * ratio + kFitSlack;
    all.push_back(fit);
  }
  return all;
}

/// Moves the axis towards the contact with the worst fit, by decreasing steps (Badoiu and Clarkson 2003).
bool cone_exists(const std::vector<Fit>& all, Vector3d axis) {
  constexpr int kSteps = 12;
  for (int step = 0; step < kSteps; ++step) {
    double worst = 0;
    Vector3d towards = axis;
    for (const Fit& fit : all) {
      const double by_normal = fit.normal_cosine - fit.normal.dot(axis);
      const double by_direction = fit.direction_cosine - fit.direction.dot(axis);
      const double deficit = std::min(by_normal, by_direction);
      if (deficit < worst) continue;
      worst = deficit;
      towards = by_normal < by_direction ? fit.normal : fit.direction;
    }
    if (worst == 0) return true;
    axis = (axis + (towards - axis) / (step + 2.5)).normalized();
  }
  return false;
}

}  // namespace

// Sharpened dismissal. Let an axis a be such that every contact t satisfies
//   (N) t is trusted and angle(n_t, a) < theta, or
//   (G) D_t > reach and angle(g_t, a) + asin(reach / D_t) < theta.
// Claim: every spoke s of a medial point m in the ball is within theta of a, so no object angle reaches theta.
// Let s point to A, nearest to m. All triangles that hold A are contacts (Lemma A), and A is the point of each that is
// nearest to m. If one of them satisfies (G): x -> x - P_t(x) does not expand distances, so the vector from m to A
// differs from D_t g_t by at most reach, s from g_t by at most asin(reach / D_t), and s is within theta of a.
// Otherwise all satisfy (N) and Lemma B applies at A: trusted triangles close up to an embedded fan, which is a graph
// of slope < tan theta over the plane across a; the plane at A across s supports it, so s is within theta of a. QED
bool spokes_are_close(const Tree& tree, std::span<const Contact> contacts, double reach, double angle) {
  if (contacts.empty()) return false;
  const std::vector<Fit> all = fits(tree, contacts, reach, angle);
  Vector3d mean = Vector3d::Zero();
  for (const Fit& fit : all) {
    mean += fit.normal_cosine < 1.5 ? fit.normal : fit.direction;
  }
  return mean.squaredNorm() > 0 && cone_exists(all, mean.normalized());
}

}  // namespace medial_vk::reference
