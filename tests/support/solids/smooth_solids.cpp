#include "support/solids/smooth_solids.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "support/eigen_points.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// Angle between unit vectors, accurate when small.
double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

class Torus : public SmoothSolid {
 public:
  Torus(double major, double minor) : major_(major), minor_(minor) {}

  Mesh mesh(std::uint32_t triangles) const override {
    // Two triangles per quad, twice as many quads along the circle as around the tube.
    const auto around = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
    return make_torus(major_, minor_, around, 2 * around);
  }

  SurfacePoint nearest(const Vector3d& p) const override {
    const Vector3d centre = on_circle(p), out = (p - centre).normalized();
    return {centre + minor_ * out, out};
  }

  std::vector<SmoothMedialPoint> medial_points(double spacing) const override {
    std::vector<SmoothMedialPoint> points;
    const int count = static_cast<int>(std::ceil(2 * kPi * major_ / spacing));
    for (int i = 0; i < count; ++i) {
      const double phi = 2 * kPi * i / count;
      const Vector3d radial(std::cos(phi), std::sin(phi), 0);
      points.push_back({major_ * radial, minor_, radial, Vector3d(-radial.y(), radial.x(), 0), true});
    }
    return points;
  }

  double distance_to_medial_surface(const Vector3d& p) const override { return (p - on_circle(p)).norm(); }

 private:
  Vector3d on_circle(const Vector3d& p) const { return major_ * Vector3d(p.x(), p.y(), 0).normalized(); }

  double major_, minor_;
};

// Proof that the segment is the whole medial surface: balls of radius r(z) centred on the axis have an envelope with
// one ring per z, at height z - r r' and distance r sqrt(1 - r'^2) from the axis, if |r'| < 1. The height grows with z
// if 1 - r'^2 - r r'' > 0, so that the envelope is a graph over the axis, does not cross itself, and is the boundary of
// the union. Each of its points touches the ball of its own z, which lies in the union. A smooth boundary point touches
// only one largest ball: there are no others.
class Pear : public SmoothSolid {
 public:
  Pear(double low, double high, double length) : low_(low), high_(high), length_(length) {}

  Mesh mesh(std::uint32_t triangles) const override {
    const double middle = (low_ + high_) / 2;
    std::uint32_t segments = 8;
    while (make_capsule(middle, length_, segments).triangles.size() < triangles) segments += 2;
    Mesh mesh = make_capsule(middle, length_, segments);
    for (Point& p : mesh.vertices) p = to_point(from_capsule(to_eigen(p), middle));
    return mesh;
  }

  SurfacePoint nearest(const Vector3d& p) const override {
    const Vector3d centre(0, 0, nearest_ball(p)), out = (p - centre).normalized();
    return {centre + radius(centre.z()) * out, out};
  }

  std::vector<SmoothMedialPoint> medial_points(double spacing) const override {
    std::vector<SmoothMedialPoint> points;
    const int steps = static_cast<int>(std::ceil(length_ / spacing));
    for (int i = 0; i <= steps; ++i) {
      const double z = length_ * (double(i) / steps - 0.5);
      points.push_back({Vector3d(0, 0, z), radius(z), spoke(z), Vector3d::UnitZ(), true});
    }
    return points;
  }

  double distance_to_medial_surface(const Vector3d& p) const override {
    return (p - Vector3d(0, 0, std::clamp(p.z(), -length_ / 2, length_ / 2))).norm();
  }

 private:
  double phase(double z) const { return kPi * (z / length_ + 0.5); }
  double radius(double z) const { return (low_ + high_) / 2 + (low_ - high_) / 2 * std::cos(phase(z)); }
  double slope(double z) const { return -(low_ - high_) / 2 * kPi / length_ * std::sin(phase(z)); }
  /// The spoke of the ball at z, in the x-z plane. Its angle with the axis has the cosine -r'.
  Vector3d spoke(double z) const { return {std::sqrt(1 - slope(z) * slope(z)), 0, -slope(z)}; }

  /// Cylinder and caps of a capsule to the envelope and its caps, ring by ring.
  Vector3d from_capsule(const Vector3d& p, double capsule_radius) const {
    const double half = length_ / 2, z = std::clamp(p.z(), -half, half);
    const Vector3d out = (p - Vector3d(0, 0, z)) / capsule_radius;
    if (std::abs(p.z()) > half) return Vector3d(0, 0, z) + radius(z) * out;
    const Vector3d s = spoke(z);
    return Vector3d(0, 0, z) + radius(z) * Vector3d(s.x() * out.x(), s.x() * out.y(), s.z());
  }

  /// Height of the ball that p is deepest in: coarse steps, then golden sections.
  double nearest_ball(const Vector3d& p) const {
    const auto depth = [&](double z) { return radius(z) - std::hypot(p.x(), p.y(), p.z() - z); };
    constexpr int kSteps = 32;
    const double half = length_ / 2, step = length_ / kSteps;
    double best = -half;
    for (int i = 1; i <= kSteps; ++i) {
      if (depth(i * step - half) > depth(best)) best = i * step - half;
    }
    double from = std::max(best - step, -half), to = std::min(best + step, half);
    const double golden = (std::sqrt(5.0) - 1) / 2;
    while (to - from > 1e-10 * length_) {  // where depths no longer differ in double
      const double left = to - golden * (to - from), right = from + golden * (to - from);
      (depth(left) < depth(right) ? from : to) = depth(left) < depth(right) ? left : right;
    }
    return (from + to) / 2;
  }

  double low_, high_, length_;
};

/// The point of x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 nearest to p: semi_i^2 p_i / (t + semi_i^2) for the t that puts it
/// there. p lies outside, or nearer to the surface than half of its smallest radius of curvature, c^2/a: then
/// t > -c^2/2.
Vector3d nearest_on_ellipsoid(const Vector3d& semi, const Vector3d& p) {
  const Eigen::Array3d squares = semi.array().square();
  double low = -squares.minCoeff() / 2, high = semi.maxCoeff() * p.norm();
  for (int i = 0; i < 100; ++i) {
    const double t = (low + high) / 2;
    ((semi.array() * p.array() / (t + squares)).square().sum() > 1 ? low : high) = t;
  }
  return squares * p.array() / ((low + high) / 2 + squares);
}

class Ellipsoid : public SmoothSolid {
 public:
  explicit Ellipsoid(const Vector3d& semi) : semi_(semi) {
    const double c = semi.z();
    focal_ = Vector3d(semi.x() - c * c / semi.x(), semi.y() - c * c / semi.y(), 0);
    is_prolate_ = semi.y() == c;
  }

  Mesh mesh(std::uint32_t triangles) const override {
    // 20 n^2 faces, so that n doubles where `triangles` grows fourfold.
    const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 20.0)));
    Mesh mesh = make_sphere(1, 20 * n * n);
    for (Point& p : mesh.vertices) p = to_point(to_eigen(p).cwiseProduct(semi_));
    return mesh;
  }

  SurfacePoint nearest(const Vector3d& p) const override {
    const Vector3d q = nearest_on_ellipsoid(semi_, p);
    return {q, (q.array() / semi_.array().square()).matrix().normalized()};
  }

  std::vector<SmoothMedialPoint> medial_points(double spacing) const override {
    std::vector<SmoothMedialPoint> points;
    const int x_steps = static_cast<int>(std::floor(focal_.x() / spacing));
    const int y_steps = is_prolate_ ? 0 : static_cast<int>(std::floor(focal_.y() / spacing));
    for (int i = -x_steps; i <= x_steps; ++i) {
      for (int j = -y_steps; j <= y_steps; ++j) add_point(points, i * spacing, j * spacing);
    }
    return points;
  }

  double distance_to_medial_surface(const Vector3d& p) const override {
    if (is_prolate_) return (p - Vector3d(std::clamp(p.x(), -focal_.x(), focal_.x()), 0, 0)).norm();
    const Vector3d flat(p.x(), p.y(), 0);
    if (std::hypot(p.x() / focal_.x(), p.y() / focal_.y()) <= 1) return std::abs(p.z());
    const Vector3d rim = nearest_on_ellipsoid({focal_.x(), focal_.y(), focal_.x()}, flat);
    return (p - rim).norm();
  }

 private:
  void add_point(std::vector<SmoothMedialPoint>& points, double x, double y) const {
    const double c = semi_.z();
    // The normal at a foot f meets z = 0 in f (1 - c^2/a^2).
    const double foot_x = x / (1 - std::pow(c / semi_.x(), 2));
    const double foot_y = is_prolate_ ? 0 : y / (1 - std::pow(c / semi_.y(), 2));
    const double rest = 1 - std::pow(foot_x / semi_.x(), 2) - std::pow(foot_y / semi_.y(), 2);
    if (rest <= 0) return;
    const Vector3d to_foot(foot_x - x, foot_y - y, c * std::sqrt(rest));
    const Vector3d axis = is_prolate_ ? Vector3d::UnitX() : Vector3d::UnitZ();
    points.push_back({Vector3d(x, y, 0), to_foot.norm(), to_foot.normalized(), axis, is_prolate_});
  }

  Vector3d semi_, focal_;
  bool is_prolate_;
};

/// For each vertex the length of its shortest edge.
std::vector<double> shortest_edges(const Mesh& mesh) {
  std::vector<double> shortest(mesh.vertices.size(), std::numeric_limits<double>::max());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const double length = (to_eigen(mesh.vertices[a]) - to_eigen(mesh.vertices[b])).norm();
      shortest[a] = std::min(shortest[a], length);
      shortest[b] = std::min(shortest[b], length);
    }
  }
  return shortest;
}

Vector3d random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vector3d(x, y, z).normalized();
}

void jitter(const SmoothSolid& solid, Mesh& mesh, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 0.3);
  const std::vector<double> shortest = shortest_edges(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double length = share(random) * shortest[i];
    const Vector3d moved = to_eigen(mesh.vertices[i]) + length * random_direction(random);
    mesh.vertices[i] = to_point(solid.nearest(moved).point);
  }
}

/// Largest angle between the normal of a face and the solid's at its corners.
double turn_of(const SmoothSolid& solid, const Mesh& mesh, const Triangle& t) {
  const std::array<Vector3d, 3> p = {to_eigen(mesh.vertices[t[0]]), to_eigen(mesh.vertices[t[1]]),
                                     to_eigen(mesh.vertices[t[2]])};
  const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
  double turn = 0;
  for (const Vector3d& corner : p) turn = std::max(turn, angle_between(normal, solid.nearest(corner).normal));
  return turn;
}

struct Side {
  std::size_t triangle;
  int corner;  // The one that faces the edge.
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::map<Edge, std::vector<Side>> sides_of_edges(const Mesh& mesh) {
  std::map<Edge, std::vector<Side>> sides;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) sides[std::minmax(t[(k + 1) % 3], t[(k + 2) % 3])].push_back({i, k});
  }
  return sides;
}

/// Every triangle takes part in at most one flip: the table of edges stays valid for the others. A flip must not turn
/// faces farther from the surface than the worst face is already, which prevents folds.
void flip_edges(const SmoothSolid& solid, Mesh& mesh, std::mt19937_64& random) {
  const double worst = normal_deviation(solid, mesh);
  const auto sides = sides_of_edges(mesh);
  std::vector<char> used(mesh.triangles.size(), 0);
  std::bernoulli_distribution wanted(0.3);
  for (const auto& [edge, both] : sides) {
    const Side s = both[0], o = both[1];
    if (!wanted(random) || used[s.triangle] || used[o.triangle]) continue;
    const Triangle t = mesh.triangles[s.triangle];
    const std::uint32_t tip = t[s.corner], from = t[(s.corner + 1) % 3], to = t[(s.corner + 2) % 3];
    const std::uint32_t other_tip = mesh.triangles[o.triangle][o.corner];
    if (sides.contains(std::minmax(tip, other_tip))) continue;
    const Triangle first = {tip, from, other_tip}, second = {tip, other_tip, to};
    if (std::max(turn_of(solid, mesh, first), turn_of(solid, mesh, second)) > worst) continue;
    mesh.triangles[s.triangle] = first;
    mesh.triangles[o.triangle] = second;
    used[s.triangle] = used[o.triangle] = 1;
  }
}

}  // namespace

double SmoothMedialPoint::object_angle() const {
  const double from_axis = angle_between(spoke, axis);
  return on_curve ? std::min(from_axis, kPi - from_axis) : std::abs(kPi / 2 - from_axis);
}

std::unique_ptr<SmoothSolid> smooth_torus(double major, double minor) { return std::make_unique<Torus>(major, minor); }

std::unique_ptr<SmoothSolid> smooth_pear(double low, double high, double length) {
  return std::make_unique<Pear>(low, high, length);
}

std::unique_ptr<SmoothSolid> smooth_ellipsoid(double a, double b, double c) {
  return std::make_unique<Ellipsoid>(Vector3d(a, b, c));
}

void make_irregular(const SmoothSolid& solid, Mesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  jitter(solid, mesh, random);
  flip_edges(solid, mesh, random);
}

void add_noise(Mesh& mesh, double length, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (Point& p : mesh.vertices) p = to_point(to_eigen(p) + length * random_direction(random));
}

double longest_side(const Mesh& mesh) {
  Vector3d lower = to_eigen(mesh.vertices[0]), upper = lower;
  for (const Point& p : mesh.vertices) {
    lower = lower.cwiseMin(to_eigen(p));
    upper = upper.cwiseMax(to_eigen(p));
  }
  return (upper - lower).maxCoeff();
}

double deviation(const SmoothSolid& solid, const Mesh& mesh) {
  double largest = 0;
  const auto measure_at = [&](const Vector3d& p) { largest = std::max(largest, (p - solid.nearest(p).point).norm()); };
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = to_eigen(mesh.vertices[t[0]]), b = to_eigen(mesh.vertices[t[1]]),
                   c = to_eigen(mesh.vertices[t[2]]);
    for (const Vector3d& p : {a, b, c}) measure_at(p);
    for (const Vector3d& p : {Vector3d(a + b), Vector3d(b + c), Vector3d(c + a)}) measure_at(p / 2);
    measure_at((a + b + c) / 3);
  }
  return largest;
}

double normal_deviation(const SmoothSolid& solid, const Mesh& mesh) {
  double largest = 0;
  for (const Triangle& t : mesh.triangles) largest = std::max(largest, turn_of(solid, mesh, t));
  return largest;
}

}  // namespace medial_vk::test
