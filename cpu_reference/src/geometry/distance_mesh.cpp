#include "cpu_reference/distance_mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;
using Hull = DistanceMesh::Around;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Corners triangle_of(const Mesh& mesh, const Eigen::Vector3i& triangle) {
  return {mesh.vertices[static_cast<std::size_t>(triangle[0])], mesh.vertices[static_cast<std::size_t>(triangle[1])],
          mesh.vertices[static_cast<std::size_t>(triangle[2])]};
}

Hull ball_around(const Corners& corners) {
  Hull ball = {(corners[0] + corners[1] + corners[2]) / 3, 0};
  for (const Vector3d& corner : corners) ball.radius = std::max(ball.radius, (corner - ball.centre).norm());
  return ball;
}

/// Around the middle of the box of the centres.
Hull ball_around(const Hull* first, const Hull* last) {
  Vector3d lower = first->centre, upper = first->centre;
  for (const Hull* ball = first; ball != last; ++ball) {
    lower = lower.cwiseMin(ball->centre);
    upper = upper.cwiseMax(ball->centre);
  }
  Hull around = {(lower + upper) / 2, 0};
  for (const Hull* ball = first; ball != last; ++ball) {
    around.radius = std::max(around.radius, (ball->centre - around.centre).norm() + ball->radius);
  }
  return around;
}

std::vector<Vector3d> one_of_each_component(const Mesh& mesh) {
  std::vector<std::size_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (const int k : {1, 2}) parent[root(static_cast<std::size_t>(t[0]))] = root(static_cast<std::size_t>(t[k]));
  }
  std::vector<Vector3d> corners;
  std::vector<bool> seen(mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const std::size_t component = root(static_cast<std::size_t>(t[0]));
    if (!seen[component]) corners.push_back(mesh.vertices[static_cast<std::size_t>(t[0])]);
    seen[component] = true;
  }
  return corners;
}

class NearestSearch {
 public:
  NearestSearch(const DistanceMesh& a, const DistanceMesh& b, const Motion& motion) : a_(a), b_(b), motion_(motion) {
    for (const Hull& ball : b.balls()) balls_b_.push_back(moved(ball));
    for (const Hull& run : b.runs()) runs_b_.push_back(moved(run));
    // A centre has an error of less than 2^-50 of the coordinates, from each mesh, and a distance as much again; a
    // rotation that is one to within 1e-12 stretches a radius by less than the share 1e-11 of the reach.
    slack_ = (0x1p-47 + 1e-11) * (a.reach() + b.reach()) + 0x1p-47 * motion.shift.norm();
  }

  NearestPair run() {
    // Any two points bound the distance: those of two runs, and the centroids of two triangles.
    for (const Hull& x : a_.runs()) {
      for (const Hull& y : runs_b_) {
        limit_ = std::min(limit_, (x.centre - y.centre).norm() + x.radius + y.radius + slack_);
      }
    }
    for_pairs([&](std::size_t i, std::size_t j) {
      limit_ = std::min(limit_, (a_.balls()[i].centre - balls_b_[j].centre).norm() + slack_);
    });
    for_pairs([&](std::size_t i, std::size_t j) { open(i, j); });
    return best_;
  }

 private:
  Hull moved(const Hull& ball) const { return {motion_.rotation * ball.centre + motion_.shift, ball.radius}; }

  bool may_be_within_limit(const Hull& x, const Hull& y) const {
    const double reach = limit_ + slack_ + x.radius + y.radius;
    return (x.centre - y.centre).squaredNorm() <= reach * reach * (1 + 1e-12);
  }

  template <class Visit>
  void for_pairs(const Visit& visit) {
    constexpr std::size_t kRun = DistanceMesh::kRun;
    for (std::size_t r = 0; r < a_.runs().size(); ++r) {
      for (std::size_t s = 0; s < runs_b_.size(); ++s) {
        if (!may_be_within_limit(a_.runs()[r], runs_b_[s])) continue;
        const std::size_t last_i = std::min(a_.balls().size(), kRun * (r + 1)),
                          last_j = std::min(balls_b_.size(), kRun * (s + 1));
        for (std::size_t i = kRun * r; i < last_i; ++i) {
          for (std::size_t j = kRun * s; j < last_j; ++j) visit(i, j);
        }
      }
    }
  }

  void open(std::size_t i, std::size_t j) {
    if (best_.distance == 0 || !may_be_within_limit(a_.balls()[i], balls_b_[j])) return;
    Corners corners = b_.triangles()[j];
    for (Vector3d& corner : corners) corner = motion_.rotation * corner + motion_.shift;
    const NearestPair pair = nearest_of_triangles(a_.triangles()[i], corners);
    if (pair.distance >= best_.distance) return;
    best_ = pair;
    limit_ = std::min(limit_, best_.distance);
  }

  const DistanceMesh& a_;
  const DistanceMesh& b_;
  const Motion& motion_;
  std::vector<Hull> balls_b_, runs_b_;
  double slack_, limit_ = kUnbounded;  // no pair of triangles that is farther apart than the limit is the nearest
  NearestPair best_ = {Vector3d::Zero(), Vector3d::Zero(), kUnbounded};
};

}  // namespace

DistanceMesh::DistanceMesh(const Mesh& mesh) : components_(one_of_each_component(mesh)), closed_(mesh.closed) {
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    triangles_.push_back(triangle_of(mesh, triangle));
    balls_.push_back(ball_around(triangles_.back()));
    for (const Vector3d& corner : triangles_.back()) reach_ = std::max(reach_, corner.norm());
  }
  for (std::size_t i = 0; i < balls_.size(); i += kRun) {
    runs_.push_back(ball_around(balls_.data() + i, balls_.data() + std::min(balls_.size(), i + kRun)));
  }
  if (!runs_.empty()) whole_ = ball_around(runs_.data(), runs_.data() + runs_.size());
}

NearestPair nearest_of_meshes(const DistanceMesh& a, const DistanceMesh& b, const Motion& motion) {
  return NearestSearch(a, b, motion).run();
}

}  // namespace medial_vk::reference
