#include "device_mesh/clusters.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {
namespace {

// Triangles on the device are rounded to float, 6e-8 in the unit box, and so are these bounds.
constexpr double kRoundingOfLength = 4e-7;
// Normals are rounded in the same way: kernels compare them with a slack of their own (axis_test.glsl).
constexpr double kRoundingOfAngle = 2e-6;

Point unit_or_zero(const Point& v) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : Point{0, 0, 0};
}

struct Run {
  std::uint32_t first = 0, count = 0;
};

// The largest subtrees of at most `most` triangles, in leaf order.
std::vector<Run> make_runs(const Bvh& bvh, std::uint32_t most) {
  const std::vector<BvhNode>& nodes = bvh.nodes();
  std::vector<std::uint32_t> sizes(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    sizes[i] = nodes[i].count != 0 ? nodes[i].count : sizes[nodes[i].first] + sizes[nodes[i].first + 1];
  }
  std::vector<Run> runs;
  std::vector<std::uint32_t> pending = {0};
  std::uint32_t position = 0;
  while (!pending.empty()) {
    const std::uint32_t i = pending.back();
    pending.pop_back();
    if (nodes[i].count == 0 && sizes[i] > most) {
      pending.push_back(nodes[i].first + 1);
      pending.push_back(nodes[i].first);
      continue;
    }
    runs.push_back({position, sizes[i]});
    position += sizes[i];
  }
  return runs;
}

// The leaf order cut into `count` runs of equal length, independently of the tree.
std::vector<Run> make_equal_runs(std::uint32_t triangles, std::uint32_t count) {
  const std::uint32_t length = (triangles + count - 1) / count;
  std::vector<Run> runs;
  for (std::uint32_t first = 0; first < triangles; first += length)
    runs.push_back({first, std::min(length, triangles - first)});
  return runs;
}

// Subtrees twice as large, or four times, and so on, until there are few enough.
std::vector<Run> make_few_runs(const Bvh& bvh, std::uint32_t most_triangles, std::uint32_t most_clusters) {
  constexpr std::uint32_t kTooLarge = 4096;  // triangles: 8 of them an iteration (expand_clusters.comp)
  for (std::uint32_t most = most_triangles; most <= kTooLarge; most *= 2) {
    std::vector<Run> runs = make_runs(bvh, most);
    if (runs.size() <= most_clusters) return runs;
  }
  return make_equal_runs(static_cast<std::uint32_t>(bvh.corners().size()), most_clusters);
}

BvhBox box_of(const Run& run, const Bvh& bvh) {
  BvhBox box{bvh.corners()[run.first][0], bvh.corners()[run.first][0]};
  for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
    for (const Point& p : bvh.corners()[i]) box = {least(box.lower, p), greatest(box.upper, p)};
  }
  return box;
}

// Of the triangles of one run, in double.
struct Facets {
  std::vector<std::array<Point, 3>> corners;
  std::vector<Point> normals;  // unit, or 0 where a triangle has no area
  bool trusted = true;
};

Facets facets_of(const Run& run, const Bvh& bvh, const UnitTransform& to_unit, std::span<const std::uint8_t> flags) {
  Facets facets;
  for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
    std::array<Point, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = to_unit(bvh.corners()[i][k]);
    facets.corners.push_back(corners);
    facets.normals.push_back(unit_or_zero(cross(corners[1] - corners[0], corners[2] - corners[0])));
    facets.trusted &= !flags.empty() && (flags[bvh.order()[i]] & kTrustedNormal) != 0;
  }
  return facets;
}

// The mean of the normals, weighted by area.
Point mean_normal(const Facets& facets) {
  Point sum{};
  for (const auto& c : facets.corners) sum = sum + cross(c[1] - c[0], c[2] - c[0]);
  const Point mean = unit_or_zero(sum);
  return dot(mean, mean) > 0 ? mean : Point{0, 0, 1};
}

// The axis as rounded for the device, to which all bounds refer.
Point as_float(const Point& p) {
  return {double{static_cast<float>(p[0])}, double{static_cast<float>(p[1])}, double{static_cast<float>(p[2])}};
}

// The cylinder around all corners whose axis is `axis`, through the middle of their extents.
void put_cylinder(const Facets& facets, const Point& axis, gpu::Cluster& cluster) {
  Point lower{1e30, 1e30, 1e30}, upper{-1e30, -1e30, -1e30};
  double least = 1e30, greatest = -1e30;
  for (const auto& triangle : facets.corners) {
    for (const Point& p : triangle) {
      for (int k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], p[k]);
        upper[k] = std::max(upper[k], p[k]);
      }
      least = std::min(least, dot(p, axis));
      greatest = std::max(greatest, dot(p, axis));
    }
  }
  const Point middle = 0.5 * (lower + upper);
  const Point centre = as_float(middle + (0.5 * (least + greatest) - dot(middle, axis)) * axis);
  double radius = 0, half_height = 0;
  for (const auto& triangle : facets.corners) {
    for (const Point& p : triangle) {
      const double along = dot(p - centre, axis);
      half_height = std::max(half_height, std::abs(along));
      radius = std::max(radius, length(p - centre - along * axis));
    }
  }
  cluster.centre = to_vec4(centre, radius + kRoundingOfLength);
  cluster.half_height = static_cast<float>(half_height + kRoundingOfLength);
}

// The cone of normals around `axis`; untrusted ones, and those that turn too far, fit no cone.
void put_cone(const Facets& facets, const Point& axis, gpu::Cluster& cluster) {
  double tilt = 0;
  for (const Point& n : facets.normals) tilt = std::max(tilt, std::atan2(length(cross(n, axis)), dot(n, axis)));
  tilt += kRoundingOfAngle;
  const bool fits = facets.trusted && tilt < std::acos(0.0);
  cluster.axis = to_vec4(axis, fits ? std::cos(tilt) : gpu::kNoCone);
  cluster.sin_tilt = static_cast<float>(fits ? std::sin(tilt) : 1);
}

// The centroid of the triangle that is nearest to the middle.
Point point_on_boundary(const Facets& facets, const Point& middle) {
  Point best{};
  double least = 1e30;
  for (const auto& c : facets.corners) {
    const Point centroid = (1.0 / 3) * (c[0] + c[1] + c[2]);
    if (length(centroid - middle) >= least) continue;
    least = length(centroid - middle);
    best = centroid;
  }
  return best;
}

gpu::Cluster make_cluster(const Run& run, const Bvh& bvh, const UnitTransform& to_unit,
                          std::span<const std::uint8_t> flags) {
  const Facets facets = facets_of(run, bvh, to_unit, flags);
  const Point axis = as_float(mean_normal(facets));
  gpu::Cluster cluster{};
  const FloatBox box = float_box(box_of(run, bvh), to_unit);
  cluster.lower = {box.lower[0], box.lower[1], box.lower[2], 0};
  cluster.upper = {box.upper[0], box.upper[1], box.upper[2], 0};
  put_cylinder(facets, axis, cluster);
  put_cone(facets, axis, cluster);
  const auto& c = cluster.centre;
  cluster.point = to_vec4(point_on_boundary(facets, {double{c.x}, double{c.y}, double{c.z}}), run.count);
  cluster.first = run.first;
  cluster.count = run.count;
  return cluster;
}

}  // namespace

std::vector<gpu::Cluster> make_clusters(const Bvh& bvh, const UnitTransform& to_unit,
                                        std::span<const std::uint8_t> flags, std::uint32_t most_triangles,
                                        std::uint32_t most_clusters, unsigned threads) {
  const std::vector<Run> runs = make_few_runs(bvh, most_triangles, most_clusters);
  std::vector<gpu::Cluster> clusters(runs.size());
  parallel_blocks(runs.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) clusters[i] = make_cluster(runs[i], bvh, to_unit, flags);
  });
  return clusters;
}

float median_radius(std::span<const gpu::Cluster> clusters) {
  if (clusters.empty()) return 0;
  std::vector<float> radii;
  for (const gpu::Cluster& c : clusters) radii.push_back(c.centre.w);
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

}  // namespace medial_vk
