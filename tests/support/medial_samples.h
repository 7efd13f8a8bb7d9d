// Independent medial samples of a solid: the method of shrinking balls, by distances only. For recall tests.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include "cpu_reference/extract.h"
#include "cpu_reference/queries.h"

namespace medial_vk::test {

struct MedialSample {
  Eigen::Vector3d point;
  double radius, object_angle;
};

/// Moves from a point inside away from its nearest boundary point for as long as that remains the nearest. Nothing if
/// the sample point is outside.
inline std::optional<MedialSample> medial_sample(const reference::Tree& tree, const Eigen::Vector3d& start) {
  if (!reference::is_inside(tree, start)) return std::nullopt;
  const reference::Closest nearest = tree.closest(start);
  const Eigen::Vector3d away = -reference::direction_to(start, nearest);
  const double size = tree.longest_side();
  double low = 0, high = size;
  for (int i = 0; i < 60; ++i) {
    const double s = (low + high) / 2;
    (tree.closest(start + s * away).distance < nearest.distance + s - 1e-12 * size ? high : low) = s;
  }
  MedialSample sample = {start + low * away, 0, 0};
  sample.radius = tree.closest(sample.point).distance;
  for (int t : tree.gather(sample.point, sample.radius + 1e-9 * size)) {
    const Eigen::Vector3d spoke = (tree.closest_on(t, sample.point).point - sample.point).normalized();
    sample.object_angle = std::max(sample.object_angle, reference::half_angle(spoke, -away));
  }
  return sample;
}

struct Recall {
  int samples = 0, found = 0;
  Eigen::Vector3d first_missed = Eigen::Vector3d::Zero();
  double share() const { return samples == 0 ? 0 : static_cast<double>(found) / samples; }
};

/// The share of `wanted` salient samples whose voxel holds a point. Samples within 5 % of a voxel from its faces are
/// left out: there a sheet may miss the voxel within rounding and epsilon. `salient` selects the samples that count.
template <typename Salient>
Recall recall_of(const reference::Tree& tree, const reference::Result& result, int wanted, const Salient& salient) {
  std::set<std::tuple<int, int, int>> found;
  for (const reference::Sphere& s : result.spheres) found.insert({s.voxel.x(), s.voxel.y(), s.voxel.z()});
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> share(0, 1);
  Recall recall;
  for (int tries = 0; tries < 1000 * wanted && recall.samples < wanted; ++tries) {
    const Eigen::Vector3d where(share(engine), share(engine), share(engine));
    const auto sample = medial_sample(tree, tree.lower() + where.cwiseProduct(tree.upper() - tree.lower()));
    if (!sample || !salient(*sample)) continue;
    const Eigen::Vector3d scaled = (sample->point - result.grid_origin) / result.voxel_size;
    const Eigen::Vector3d voxel = scaled.array().floor();
    const Eigen::Vector3d inside = scaled - voxel;
    if (inside.minCoeff() < 0.05 || inside.maxCoeff() > 0.95) continue;
    ++recall.samples;
    const auto key = voxel.cast<int>().eval();
    if (found.count({key.x(), key.y(), key.z()}) != 0) {
      ++recall.found;
    } else if (recall.samples - recall.found == 1) {
      recall.first_missed = sample->point;
    }
  }
  return recall;
}

}  // namespace medial_vk::test
