#include "search/lines.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMostPairLines = 8;
constexpr std::size_t kTieContacts = 64;  // contacts from which the tie is computed
constexpr int kTieSteps = 3;

struct PairLine {
  Line line;
  double distance;  // of the pair's sheet from the boundary where the line crosses it: the nearest sheets are medial
};

// The sheet between carriers a and b is crossed at right angles by lines along g_b - g_a (equation 2.11), about where
// D_a - g_a . x = D_b - g_b . x; where that plane misses the box, from the corner nearest to it.
bool line_of_pair(const Box& box, const CarrierPair& pair, PairLine& out) {
  const Carrier &a = *pair.a, &b = *pair.b;
  const Vector3d across = b.direction - a.direction;
  const double turn = across.norm(), gap = b.distance - a.distance, most = box.support(across);
  if (turn < 0.1 || std::abs(gap) > 1.2 * most) return false;  // directions too close for a line, or far outside
  Vector3d base = gap / (turn * turn) * across;
  if ((base.cwiseAbs().array() > box.half.array()).any()) {
    const double share = std::clamp(gap / most, -1.0, 1.0);
    for (int k = 0; k < 3; ++k) base[k] = share * std::copysign(box.half[k], across[k]);
  }
  out.line = {base, across / turn};
  out.distance = std::max(a.distance - a.direction.dot(base), b.distance - b.direction.dot(base));
  return true;
}

bool is_similar(const Box& box, const Line& a, const Line& b) {
  const bool parallel = std::abs(a.direction.dot(b.direction)) > 0.98;
  return parallel && (a.base - b.base).norm() < 0.4 * box.half.minCoeff();
}

void add_pair_lines(const Box& box, std::span<const CarrierPair> pairs, std::vector<Line>& lines) {
  std::vector<PairLine> order;
  for (const CarrierPair& pair : pairs) {
    PairLine line;
    if (line_of_pair(box, pair, line)) order.push_back(line);
  }
  const auto nearer = [](const PairLine& a, const PairLine& b) { return a.distance < b.distance; };
  std::stable_sort(order.begin(), order.end(), nearer);
  for (const PairLine& next : order) {
    if (lines.size() == kMostPairLines) return;
    const auto similar = [&](const Line& line) { return is_similar(box, line, next.line); };
    if (std::none_of(lines.begin(), lines.end(), similar)) lines.push_back(next.line);
  }
}

// From the centre to the point equally far from all contacts that are about as near as the nearest, in the sense of
// least squares: D_j - g_j . x = t for all j, by Gauss-Newton. Curves of the medial surface, such as the axis of a
// round tube, are thinner than any set of lines between two contacts. If the directions leave a degree of freedom,
// along a sheet or a curve, the small multiple of the identity keeps the step out of it.
Vector3d step_to_tie(const Tree& tree, const Box& box, double nearest_distance, std::span<const Contact> contacts) {
  const double radius = box.reach();
  const std::size_t stride = 1 + contacts.size() / kTieContacts;
  Vector3d x = Vector3d::Zero();
  for (int step = 0; step < kTieSteps; ++step) {
    double weights = 0, distances = 0, least = std::numeric_limits<double>::infinity();
    Vector3d directions = Vector3d::Zero(), mixed = Vector3d::Zero();
    Matrix3d squares = Matrix3d::Zero();
    for (std::size_t i = 0; i < contacts.size(); i += stride) {
      const Vector3d v = tree.closest_on(contacts[i].triangle, box.centre + x).point - box.centre - x;
      const double d = v.norm(), w = std::clamp(1 - 0.5 * (d - nearest_distance) / radius, 0.0, 1.0);
      const Vector3d g = v / std::max(d, 1e-300);
      least = std::min(least, d);
      weights += w;
      distances += w * d;
      directions += w * g;
      mixed += w * d * g;
      squares += w * g * g.transpose();
    }
    if (weights == 0) return x;
    const Matrix3d spread = squares - directions * directions.transpose() / weights;
    const Matrix3d system = spread + (1e-4 * spread.trace() + 1e-12) * Matrix3d::Identity();
    x += system.inverse() * (mixed - distances / weights * directions);
    x *= std::min(1.0, radius / std::max(x.norm(), 1e-300));
    nearest_distance = least;
  }
  return x;
}

// The direction across the sheet between the two contacts whose directions differ (nearly) most among those that tie at
// a point within epsilon: the one farthest from the first direction, and the one farthest from that.
Vector3d widest_turn(const Tree& tree, const Vector3d& point, double epsilon, std::span<const Contact> contacts) {
  const std::size_t stride = 1 + contacts.size() / kTieContacts;
  std::vector<Vector3d> spokes;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < contacts.size(); i += stride) {
    spokes.emplace_back(tree.closest_on(contacts[i].triangle, point).point - point);
    least = std::min(least, spokes.back().norm());
  }
  std::erase_if(spokes, [&](const Vector3d& spoke) { return spoke.norm() > least + epsilon || spoke.norm() == 0; });
  if (spokes.empty()) return Vector3d::Zero();
  for (Vector3d& spoke : spokes) spoke.normalize();
  const auto opposite = [&](const Vector3d& g) {
    return *std::min_element(spokes.begin(), spokes.end(),
                             [&](const Vector3d& a, const Vector3d& b) { return a.dot(g) < b.dot(g); });
  };
  const Vector3d b = opposite(spokes.front()), across = opposite(b) - b;
  return across.norm() > 0 ? across.normalized().eval() : Vector3d::Zero().eval();
}

}  // namespace

// The last lines pass through the tie, along g_0 and across the sheet there; and through the centre along g_0, where
// the deep samples of Section 3.2 lie.
std::vector<Line> aimed_lines(const Tree& tree, const Box& box, double epsilon, const Closest& nearest,
                              std::span<const Contact> contacts, std::span<const CarrierPair> pairs) {
  std::vector<Line> lines;
  add_pair_lines(box, pairs, lines);
  if (nearest.distance <= 0) return lines;
  const Vector3d inwards = -direction_to(box.centre, nearest);
  const Vector3d tie = step_to_tie(tree, box, nearest.distance, contacts);
  const Vector3d across = widest_turn(tree, box.centre + tie, epsilon, contacts);
  lines.push_back({tie, inwards});
  if (!across.isZero()) lines.push_back({tie, across});
  lines.push_back({Vector3d::Zero(), inwards});
  return lines;
}

}  // namespace medial_vk::reference
