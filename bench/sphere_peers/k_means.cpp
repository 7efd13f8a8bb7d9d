#include "k_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "base/split_mix.h"
#include "polygon.h"
#include "samples.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "voronoi_vertices.h"

namespace medial_vk::bench {
namespace {

constexpr std::size_t kSamplesOfCluster = 100, kLeastToCluster = 20'000;
/// Share of the diagonal by which balls around parts are enlarged.
constexpr double kMargin = 1e-7;

double squared_distance(const Point& a, const Point& b) {
  const Point d = a - b;
  return dot(d, d);
}

NearestBallTree tree_of(std::span<const Point> centres) {
  std::vector<Ball> balls;
  balls.reserve(centres.size());
  for (const Point& centre : centres) balls.push_back({centre, 0});
  return NearestBallTree(balls);
}

/// Each next centre is a point by chance, in proportion to its squared distance from the nearest centre before.
std::vector<Point> first_centres(const std::vector<Point>& points, std::size_t count, SplitMix& random) {
  std::vector<Point> centres = {points.front()};  // the points are in random order
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  while (centres.size() < count) {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      distances[i] = std::min(distances[i], squared_distance(points[i], centres.back()));
      sum += distances[i];
    }
    double rest = 0.5 * (random.symmetric() + 1) * sum;
    std::size_t next = 0;
    while (next + 1 < points.size() && rest >= distances[next]) rest -= distances[next++];
    centres.push_back(points[next]);
  }
  return centres;
}

/// The means of the points by cluster; an empty cluster takes the point farthest from its centre.
std::vector<Point> means_of(const std::vector<Point>& points, const std::vector<std::uint32_t>& clusters,
                            const std::vector<Point>& centres) {
  std::vector<Point> means(centres.size(), Point{0, 0, 0});
  std::vector<std::size_t> sizes(centres.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    means[clusters[i]] = means[clusters[i]] + points[i];
    ++sizes[clusters[i]];
  }
  std::vector<std::uint8_t> is_taken(points.size(), 0);
  for (std::size_t c = 0; c < means.size(); ++c) {
    if (sizes[c] > 0) {
      means[c] = (1 / static_cast<double>(sizes[c])) * means[c];
      continue;
    }
    std::size_t farthest = 0;
    double greatest_distance = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = squared_distance(points[i], centres[clusters[i]]);
      if (is_taken[i] == 0 && distance > greatest_distance) farthest = i, greatest_distance = distance;
    }
    is_taken[farthest] = 1;
    means[c] = points[farthest];
  }
  return means;
}

/// Adds the corners of a triangle's parts to the cells in which they lie. For a point x of the triangle, within r of
/// its middle m, the nearest centre c has |c - m| <= |c - x| + r <= min |c' - x| + r <= min |c' - m| + 2 r: no others
/// need be considered.
void divide_triangle(const std::array<Point, 3>& triangle, std::span<const Point> centres, const NearestBallTree& tree,
                     std::vector<std::vector<Point>>& corners) {
  const Point middle = (1.0 / 3) * (triangle[0] + triangle[1] + triangle[2]);
  double radius = 0;
  for (const Point& corner : triangle) radius = std::max(radius, length(corner - middle));
  const double nearest = tree.nearest(middle).distance;
  std::vector<std::uint32_t> near;
  tree.gather(middle, (nearest + 2 * radius) * (1 + 1e-9), near);
  for (const std::uint32_t cell : near) {
    Polygon part(triangle.begin(), triangle.end());
    for (const std::uint32_t other : near) {
      if (other == cell || part.empty()) continue;
      const Point across = centres[other] - centres[cell];
      cut_off(part, across, 0.5 * dot(across, centres[other] + centres[cell]));
    }
    corners[cell].insert(corners[cell].end(), part.begin(), part.end());
  }
}

}  // namespace

std::vector<Point> k_means(const Solid& solid, const KMeansOptions& options) {
  const std::size_t samples =
      options.samples > 0 ? options.samples : std::max(kLeastToCluster, kSamplesOfCluster * options.count);
  const std::vector<Point> points = points_inside(solid, samples, options.seed, options.threads);
  SplitMix random(options.seed + 1);
  std::vector<Point> centres = first_centres(points, std::min(options.count, points.size()), random);
  std::vector<std::uint32_t> clusters(points.size(), 0), last;
  for (unsigned iteration = 0; iteration < options.iterations && clusters != last; ++iteration) {
    last = clusters;
    const NearestBallTree tree = tree_of(centres);
    parallel_for(points.size(), 256, options.threads,
                 [&](std::size_t i) { clusters[i] = tree.nearest(points[i]).ball; });
    centres = means_of(points, clusters, centres);
  }
  return centres;
}

std::vector<Ball> smallest_around_cells(const Solid& solid, std::span<const Point> centres, unsigned threads) {
  const Mesh& mesh = solid.mesh().mesh;
  const NearestBallTree tree = tree_of(centres);
  std::vector<std::vector<Point>> corners(centres.size());
  for (const Triangle& t : mesh.triangles) {
    divide_triangle({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, centres, tree, corners);
  }
  for (const VoronoiVertex& vertex : voronoi_vertices(centres, threads)) {
    if (!solid.contains(vertex.at)) continue;
    for (const std::uint32_t cell : vertex.points) corners[cell].push_back(vertex.at);
  }
  std::vector<Ball> all(centres.size());
  parallel_for(centres.size(), 1, threads, [&](std::size_t i) {
    if (corners[i].empty()) return;
    all[i] = smallest_ball(corners[i]);
    all[i].radius += kMargin * solid.diagonal();
  });
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!corners[i].empty()) balls.push_back(all[i]);
  }
  return balls;
}

}  // namespace medial_vk::bench
