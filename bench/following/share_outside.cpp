#include "share_outside.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "../helpers.h"
#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "solid/solid.h"

namespace medial_vk::bench {
namespace {

constexpr int kSamples = 100'000;

double cube(double x) { return x * x * x; }

double within_by(const Ball& ball, double protrusion) { return std::max(0.0, ball.radius - protrusion); }

class Layers {
 public:
  Layers(std::span<const Ball> balls, double protrusion) : balls_(balls), protrusion_(protrusion) {
    for (const Ball& ball : balls) {
      volumes_.push_back(4 * std::numbers::pi / 3 * (cube(ball.radius) - cube(within_by(ball, protrusion))));
    }
    choose_ = std::discrete_distribution<std::size_t>(volumes_.begin(), volumes_.end());
  }

  double volume() const {
    double sum = 0;
    for (const double volume : volumes_) sum += volume;
    return sum;
  }

  /// A point of all layers, by volume.
  Point sample(std::mt19937_64& random) {
    const Ball& ball = balls_[choose_(random)];
    Point direction;
    for (double& x : direction) x = normal_(random);
    const double inner = cube(within_by(ball, protrusion_));
    const double radius = std::cbrt(inner + unit_(random) * (cube(ball.radius) - inner));
    return ball.centre + (radius / length(direction)) * direction;
  }

  /// 1 over the number of layers at a point of one; 0: a smaller ball holds it, so that it is not outside the solid.
  double weight(const Point& p) const {
    std::size_t layers = 0;
    for (const Ball& ball : balls_) {
      const double distance = length(p - ball.centre);
      if (distance < within_by(ball, protrusion_)) return 0;
      layers += distance <= ball.radius ? 1 : 0;
    }
    return 1 / static_cast<double>(std::max<std::size_t>(1, layers));
  }

 private:
  std::span<const Ball> balls_;
  double protrusion_;
  std::vector<double> volumes_;
  std::discrete_distribution<std::size_t> choose_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_;
};

Solid solid_at(const IndexedMesh& mesh, const std::vector<Point>& frame) {
  Mesh moved;
  moved.vertices = frame;
  moved.triangles.assign(mesh.view().triangles.begin(), mesh.view().triangles.end());
  return or_exit(Solid::build(or_exit(IndexedMesh::build(or_exit(prepare_mesh(std::move(moved)))))));
}

}  // namespace

ShareOutside share_outside(const IndexedMesh& mesh, const std::vector<Point>& frame, std::span<const Ball> balls,
                           double protrusion) {
  if (std::ranges::none_of(balls, [](const Ball& ball) { return ball.radius > 0; })) return {0, 0};
  const Solid solid = solid_at(mesh, frame);
  Layers layers(balls, protrusion);
  std::mt19937_64 random(7);
  double sum = 0, squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Point p = layers.sample(random);
    const double weight = solid.contains(p) ? 0 : layers.weight(p);
    sum += weight;
    squares += weight * weight;
  }
  const double percent = 100 * layers.volume() / solid.volume();
  if (!(sum > 0)) return {0, 3 * percent / kSamples};
  const double mean = sum / kSamples, variance = std::max(0.0, squares / kSamples - mean * mean);
  return {percent * mean, percent * std::sqrt(variance / kSamples)};
}

}  // namespace medial_vk::bench
