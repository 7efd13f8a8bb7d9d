#include "contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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

// Lemma 1. Let x = m - centre, |x| <= reach. Distance to a convex set is convex with gradient -g_t, so
// dist(m, t) >= D_t - g_t . x. On the other hand dist(m, P0) = sqrt(D0^2 - 2 D0 g0 . x + |x|^2), which is at most
// D0 - g0 . x + |x|^2 / (2 D0) and at most D0 + |x|. If t is nearest to m, then D_t - D0 is at most
// reach |g_t - g0| + reach^2 / (2 D0), and at most 2 reach. Four roundings of a distance are on the keeping side.
bool ContactList::can_touch(const Contact& contact, double reach) const {
  const double behind = contact.distance - nearest_.distance - 4 * tree_->rounding();
  if (behind > 2 * reach) return false;
  if (nearest_.distance <= 0) return true;
  const double spread = (contact.direction - nearest_direction_).norm();
  return behind <= reach * (spread + 1e-12) + reach * reach / (2 * nearest_.distance);
}

// Lemma A for a cube: dist(x, t) >= D_t - g_t . x, dist(x, t0) is convex, so their difference is greatest at a corner.
std::vector<Contact> ContactList::within_cube(double half) const {
  const int first = nearest_.triangle;
  std::array<Vector3d, 8> corner;
  std::array<double, 8> bound;
  for (int k = 0; k < 8; ++k) {
    corner[k] = half * Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    bound[k] = std::sqrt(tree_->closest_on(first, centre_ + corner[k]).squared_distance) + 8 * tree_->rounding();
  }
  std::vector<Contact> touching;
  for (const Contact& contact : contacts_) {
    for (int k = 0; k < 8; ++k) {
      if (contact.distance - contact.direction.dot(corner[k]) > bound[k]) continue;
      touching.push_back(contact);
      break;
    }
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

// The convexity bound D_t - g_t . x of Lemma 1 saves most triangle tests: first the triangle where it is least, then
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

/// A contact's two ways to fit into a cone: `dot(normal, axis) > normal_cosine` or the same by direction. A cosine of 2
/// says that the way is closed.
struct Fit {
  Vector3d normal, direction;
  double normal_cosine = 2, direction_cosine = 2;
};

constexpr double kCosineSlack = 1e-9;  // covers the rounding of dots and cosines (below 1e-14) many times over

std::vector<Fit> fits(const Tree& tree, std::span<const Contact> contacts, double reach, double angle) {
  std::vector<Fit> all;
  all.reserve(contacts.size());
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (const Contact& contact : contacts) {
    Fit fit;
    fit.normal = tree.normal(contact.triangle);
    fit.direction = contact.direction;
    if (contact.trusted) fit.normal_cosine = cosine + kCosineSlack;
    // cos(angle - asin(reach / D)), open while asin(reach / D) < angle
    const double ratio = contact.distance > 0 ? reach / contact.distance : 1;
    if (ratio < sine) fit.direction_cosine = cosine * std::sqrt(1 - ratio * ratio) + sine * ratio + kCosineSlack;
    all.push_back(fit);
  }
  return all;
}

/// Moves the axis towards the contact that fits worst, a little less each time (Badoiu and Clarkson 2003).
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

/// Lemma 3: all pairs of spokes by directions.
bool pairs_are_close(std::span<const Contact> contacts, double reach, double angle) {
  constexpr std::size_t kMost = 400;  // the test is quadratic
  if (contacts.size() > kMost) return false;
  std::vector<double> wander;
  wander.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    if (contact.distance <= reach) return false;
    wander.push_back(std::asin(reach / contact.distance));
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double left = 2 * angle - wander[i] - wander[j] - kCosineSlack;
      if (left <= 0 || contacts[i].direction.dot(contacts[j].direction) <= std::cos(left)) return false;
    }
  }
  return true;
}

bool has_vertex_behind(const Tree& tree, int t, int u, double slack) {
  for (int k = 0; k < 3; ++k)
    if (tree.normal(t).dot(tree.corner(u, k) - tree.corner(t, 0)) < -slack) return true;
  return false;
}

}  // namespace

// No two contacts can hold the two spokes of a salient point.
bool no_pair_is_salient(const Tree& tree, std::span<const Contact> contacts, double reach, double angle) {
  if (contacts.size() > 400) return false;
  const double slack = 8 * tree.rounding();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Contact &a = contacts[i], &b = contacts[j];
      if (a.distance > reach && b.distance > reach) {
        const double left = 2 * angle - std::asin(reach / a.distance) - std::asin(reach / b.distance) - kCosineSlack;
        if (left > 0 && a.direction.dot(b.direction) > std::cos(left)) continue;
      }
      if (a.trusted && !has_vertex_behind(tree, a.triangle, b.triangle, slack)) continue;
      if (b.trusted && !has_vertex_behind(tree, b.triangle, a.triangle, slack)) continue;
      return false;
    }
  return true;
}

// Sharpened dismissal. Let an axis a be such that every contact t satisfies
//   (N) t is trusted and angle(n_t, a) < theta, or
//   (G) D_t > reach and angle(g_t, a) + asin(reach / D_t) < theta.
// Claim: every spoke s of a medial point m in the ball is within theta of a, so no object angle reaches theta.
// Let s point to A, nearest to m. All triangles that hold A are contacts (Lemma 1), and A is the point of each that is
// nearest to m. If one of them satisfies (G): x -> x - P_t(x) does not expand distances, so the vector from m to A
// differs from D_t g_t by at most reach, s from g_t by at most asin(reach / D_t), and s is within theta of a.
// Otherwise all satisfy (N) and Lemma 2 applies at A: trusted triangles close up to an embedded fan, which is a graph
// of slope < tan theta over the plane across a; the plane at A across s supports it, so s is within theta of a. QED
bool spokes_are_close(const Tree& tree, std::span<const Contact> contacts, double reach, double angle) {
  if (contacts.empty()) return false;
  const std::vector<Fit> all = fits(tree, contacts, reach, angle);
  Vector3d mean = Vector3d::Zero();
  for (const Fit& fit : all) {
    mean += fit.normal_cosine < 1.5 ? fit.normal : fit.direction;
  }
  if (mean.squaredNorm() > 0 && cone_exists(all, mean.normalized())) return true;
  return pairs_are_close(contacts, reach, angle);
}

}  // namespace medial_vk::reference
