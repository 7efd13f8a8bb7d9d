#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "cpu_reference/ball_hulls.h"

namespace medial_vk::reference {
namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

/// n -> n v - c.
struct Affine {
  Vector v;
  Real c;
};

Real least_value(const std::vector<Affine>& functions, const Vector& n) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const Affine& f : functions) least = std::min(least, n.dot(f.v) - f.c);
  return least;
}

/// The vectors n for which all functions of a set are equal: n0 + all vectors that are perpendicular to `across`.
struct EqualFlat {
  Vector nearest = Vector::Zero();  // n0, the one nearest to the origin
  std::vector<Vector> across;       // orthonormal, spanned by the differences of the gradients
  bool exists = true;
};

Vector without(const std::vector<Vector>& across, Vector v) {
  for (int twice = 0; twice < 2; ++twice) {
    for (const Vector& q : across) v -= q.dot(v) * q;
  }
  return v;
}

/// By Gram-Schmidt, the longest difference first. A set whose differences depend on each other is no set of its own:
/// fewer functions determine the same vectors.
EqualFlat equal_flat(std::vector<Affine> set) {
  EqualFlat flat;
  const Affine first = set.front();
  set.erase(set.begin());
  for (Affine& f : set) f = {f.v - first.v, f.c - first.c};
  while (!set.empty()) {
    std::size_t longest = 0;
    Real length = -1;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const Real rest = without(flat.across, set[i].v).norm();
      if (rest > length) {
        length = rest;
        longest = i;
      }
    }
    const Affine difference = set[longest];
    set.erase(set.begin() + static_cast<std::ptrdiff_t>(longest));
    if (!(length > 4 * std::numeric_limits<Real>::epsilon() * difference.v.norm())) {
      flat.exists = false;
      return flat;
    }
    const Vector q = without(flat.across, difference.v) / length;
    flat.nearest += (difference.c - flat.nearest.dot(difference.v)) / length * q;
    flat.across.push_back(q);
  }
  return flat;
}

/// Improves `best` by the vectors where the functions of the set are equal and greatest.
void try_set(const std::vector<Affine>& functions, const std::vector<Affine>& set, Real& best) {
  const EqualFlat flat = equal_flat(set);
  if (!flat.exists) return;
  const Real squared = flat.nearest.squaredNorm();
  const auto try_vector = [&](const Vector& n) {
    best = std::max(best, least_value(functions, n / std::max(Real(1), n.norm())));
  };
  try_vector(flat.nearest);
  if (squared >= 1 || flat.across.size() == 3) return;
  const Vector ahead = without(flat.across, set.front().v);
  if (ahead.norm() > 0) try_vector(flat.nearest + std::sqrt(1 - squared) / ahead.norm() * ahead);
}

void try_sets(const std::vector<Affine>& functions, std::size_t from, std::vector<Affine>& set, Real& best) {
  for (std::size_t i = from; i < functions.size(); ++i) {
    set.push_back(functions[i]);
    try_set(functions, set, best);
    if (set.size() < 4) try_sets(functions, i + 1, set, best);
    set.pop_back();
  }
}

}  // namespace

double hull_distance(const std::vector<HullBall>& first, const std::vector<HullBall>& second) {
  std::vector<Affine> functions;
  for (const HullBall& a : first) {
    for (const HullBall& b : second) {
      functions.push_back({a.centre.cast<Real>() - b.centre.cast<Real>(), Real(a.radius) + Real(b.radius)});
    }
  }
  Real best = least_value(functions, Vector::Zero());
  std::vector<Affine> set;
  try_sets(functions, 0, set, best);
  return static_cast<double>(best);
}

}  // namespace medial_vk::reference
