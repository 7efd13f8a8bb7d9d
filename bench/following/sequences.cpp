#include "sequences.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>

#include "surface_nets.h"

namespace medial_vk::bench {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// A cone with round ends, from a joint at `head` to `tail`. It turns with its parent.
struct Bone {
  Vector3d head, tail;
  double head_radius, tail_radius;
  int parent;  // -1: none

  double distance(const Vector3d& p) const {
    const Vector3d along = tail - head;
    const double t = std::clamp((p - head).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - head - t * along).norm() - (1 - t) * head_radius - t * tail_radius;
  }
};
using Bones = std::vector<Bone>;

/// How a bone turns at its head.
struct Turn {
  int bone;
  Vector3d axis;
  double degrees;
};

/// The distances to the bones with blends of that width where two are near.
double blended_distance(const Bones& bones, const Vector3d& p, double blend) {
  double sum = 0;
  for (const Bone& bone : bones) sum += std::exp(-bone.distance(p) / blend);
  return sum > 0 ? -blend * std::log(sum) : std::numeric_limits<double>::max();
}

Mesh skin(const Bones& bones, double blend, double spacing) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Bone& bone : bones) {
    const double margin = std::max(bone.head_radius, bone.tail_radius) + 4 * blend + 2 * spacing;
    low = low.cwiseMin(bone.head.cwiseMin(bone.tail).array().matrix() - Vector3d::Constant(margin));
    high = high.cwiseMax(bone.head.cwiseMax(bone.tail).array().matrix() + Vector3d::Constant(margin));
  }
  return surface_nets([&](const Vector3d& p) { return blended_distance(bones, p, blend); }, low, high, spacing);
}

std::vector<Isometry3d> turned(const Bones& bones, const std::vector<Turn>& turns) {
  std::vector<Isometry3d> motions;
  motions.reserve(bones.size());
  for (std::size_t i = 0; i < bones.size(); ++i) {
    Isometry3d motion =
        bones[i].parent < 0 ? Isometry3d::Identity() : motions[static_cast<std::size_t>(bones[i].parent)];
    for (const Turn& turn : turns) {
      if (turn.bone != static_cast<int>(i)) continue;
      motion.translate(bones[i].head);
      motion.rotate(AngleAxisd(turn.degrees * kDegree, turn.axis.normalized()));
      motion.translate(-bones[i].head);
    }
    motions.push_back(motion);
  }
  return motions;
}

/// Every vertex moves with the bones, by weights that fall with the fourth power of its distance to their axes.
std::vector<Point> posed(const Mesh& rest, const Bones& bones, const std::vector<Turn>& turns) {
  const std::vector<Isometry3d> motions = turned(bones, turns);
  std::vector<Point> vertices;
  vertices.reserve(rest.vertices.size());
  for (const Point& vertex : rest.vertices) {
    const Vector3d p(vertex[0], vertex[1], vertex[2]);
    Vector3d sum = Vector3d::Zero();
    double total = 0;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const double radius = std::min(bones[i].head_radius, bones[i].tail_radius);
      const double weight = std::pow(1 + std::max(0.0, bones[i].distance(p)) / (0.3 * radius), -4);
      sum += weight * (motions[i] * p);
      total += weight;
    }
    sum /= total;
    vertices.push_back({sum.x(), sum.y(), sum.z()});
  }
  return vertices;
}

/// A map of space for every vertex.
std::vector<Point> mapped(const std::vector<Point>& vertices, const std::function<Vector3d(const Vector3d&)>& map) {
  std::vector<Point> result;
  result.reserve(vertices.size());
  for (const Point& p : vertices) {
    const Vector3d q = map({p[0], p[1], p[2]});
    result.push_back({q.x(), q.y(), q.z()});
  }
  return result;
}

/// By a factor along axis z; the volume stays.
Vector3d squashed(const Vector3d& p, double factor) {
  const double wider = 1 / std::sqrt(factor);
  return {wider * p.x(), wider * p.y(), factor * p.z()};
}

Vector3d twisted(const Vector3d& p, double degrees_per_length) {
  return AngleAxisd(degrees_per_length * kDegree * p.x(), Vector3d::UnitX()) * p;
}

/// Bones 0 and 1 are the trunk, 2 the neck, 3 the head, 4 the tail; then two for each leg, the hind legs first.
Bones bones_of_horse() {
  Bones bones = {{{0, 0, 0}, {1.2, 0, 0}, 0.42, 0.38, -1},
                 {{0, 0, 0}, {-1.1, 0, 0.05}, 0.42, 0.4, -1},
                 {{1.3, 0, 0.15}, {2.05, 0, 1.05}, 0.28, 0.17, 0},
                 {{2.05, 0, 1.05}, {2.6, 0, 0.75}, 0.2, 0.12, 2},
                 {{-1.4, 0, 0.15}, {-1.95, 0, -0.7}, 0.11, 0.06, 1}};
  for (const double x : {-1.15, 1.15}) {
    for (const double y : {-0.27, 0.27}) {
      bones.push_back({{x, y, -0.2}, {x - 0.05, y, -0.95}, 0.2, 0.12, x < 0 ? 1 : 0});
      bones.push_back({{x - 0.05, y, -0.95}, {x, y, -1.75}, 0.12, 0.09, static_cast<int>(bones.size()) - 1});
    }
  }
  return bones;
}

constexpr int kArms = 8, kBonesOfArm = 6;

Vector3d direction_of_arm(int arm) {
  const double angle = 2 * std::numbers::pi * arm / kArms;
  return {std::cos(angle), std::sin(angle), 0};
}

/// Bone 0 is the head, bone 1 + 6 a + i the i-th of arm a.
Bones bones_of_octopus() {
  Bones bones = {{{0, 0, 0.3}, {0, 0, 0.9}, 0.5, 0.6, -1}};
  for (int arm = 0; arm < kArms; ++arm) {
    for (int i = 0; i < kBonesOfArm; ++i) {
      const auto joint = [&](int k) -> Vector3d {
        return (0.35 + 0.4 * k) * direction_of_arm(arm) + Vector3d(0, 0, 0.05 - 0.03 * k);
      };
      bones.push_back({joint(i), joint(i + 1), 0.2 - 0.022 * i, 0.2 - 0.022 * (i + 1),
                       i == 0 ? 0 : static_cast<int>(bones.size()) - 1});
    }
  }
  return bones;
}

/// Every bone of an arm turns by as many degrees against the one before, upward if positive.
std::vector<Turn> curled(const std::function<double(int arm)>& degrees) {
  std::vector<Turn> turns;
  for (int arm = 0; arm < kArms; ++arm) {
    const Vector3d axis = direction_of_arm(arm).cross(Vector3d::UnitZ());
    for (int i = 0; i < kBonesOfArm; ++i) turns.push_back({1 + kBonesOfArm * arm + i, axis, degrees(arm)});
  }
  return turns;
}

/// A closed tube around a curve of the parameter t in [0, 1), by the curve's normal planes.
Mesh tube(const std::function<Vector3d(double)>& curve, double radius, std::uint32_t along, std::uint32_t around) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < along; ++i) {
    const double t = static_cast<double>(i) / along, step = 1e-3;
    const Vector3d at = curve(t), tangent = (curve(t + step) - curve(t - step)).normalized();
    const Vector3d u = tangent.cross(Vector3d::UnitZ()).normalized(), v = tangent.cross(u);
    for (std::uint32_t k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      const Vector3d p = at + radius * (std::cos(angle) * u + std::sin(angle) * v);
      mesh.vertices.push_back({p.x(), p.y(), p.z()});
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around;
      const std::uint32_t c = (i + 1) % along * around + k, d = (i + 1) % along * around + (k + 1) % around;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
  return mesh;
}

}  // namespace

Sequence horse() {
  const Bones bones = bones_of_horse();
  Sequence result{"horse", skin(bones, 0.05, 0.05), {}};
  // Hip and knee of the hind and of the fore legs, neck and tail, degrees.
  constexpr std::array<std::array<double, 6>, 3> kMoments = {
      {{20, -25, -25, 15, 10, 10}, {-20, 10, 15, -15, 12, 8}, {15, -20, 12, -18, 10, 10}}};
  const Vector3d side = Vector3d::UnitY();
  for (const auto& [hip, knee, shoulder, elbow, neck, tail] : kMoments) {
    std::vector<Turn> turns = {{2, side, neck}, {3, side, -neck}, {4, side, tail}};
    for (const int leg : {0, 1}) {  // the left ones follow the right ones
      const double late = 1 - 0.25 * leg;
      turns.insert(turns.end(), {{5 + 2 * leg, side, late * hip},
                                 {6 + 2 * leg, side, late * knee},
                                 {9 + 2 * leg, side, late * shoulder},
                                 {10 + 2 * leg, side, late * elbow}});
    }
    result.poses.push_back(posed(result.rest, bones, turns));
  }
  return result;
}

Sequence knot() {
  const auto trefoil = [](double t) -> Vector3d {
    const double a = 2 * std::numbers::pi * t, r = 2 + std::cos(3 * a);
    return {r * std::cos(2 * a), r * std::sin(2 * a), 1.2 * std::sin(3 * a)};
  };
  Sequence result{"knot", tube(trefoil, 0.45, 480, 24), {}};
  const auto add = [&](const auto& map) { result.poses.push_back(mapped(result.rest.vertices, map)); };
  add([](const Vector3d& p) { return squashed(p, 0.8); });
  add([](const Vector3d& p) { return twisted(p, 12); });
  add([](const Vector3d& p) { return twisted(squashed(p, 1.25), -12); });
  return result;
}

Sequence octopus() {
  const Bones bones = bones_of_octopus();
  Sequence result{"octopus", skin(bones, 0.05, 0.05), {}};
  const auto add = [&](const auto& degrees, double factor) {
    result.poses.push_back(mapped(posed(result.rest, bones, curled(degrees)),
                                  [factor](const Vector3d& p) { return squashed(p, factor); }));
  };
  add([](int) { return -12.0; }, 1);
  add([](int) { return 15.0; }, 1.1);
  add([](int arm) { return arm % 2 == 0 ? 14.0 : -11.0; }, 0.85);
  return result;
}

}  // namespace medial_vk::bench
