// Balls around or inside the clusters of k-means.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"

namespace medial_vk::bench {

struct KMeansOptions {
  std::size_t count = 0;      ///< Of clusters.
  std::size_t samples = 0;    ///< Points inside the solid; 0: 100 a cluster, and at least 20,000.
  unsigned iterations = 100;  ///< At most; fewer if no point changes its cluster.
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

/// The means of clusters of points inside the solid: Lloyd's iteration (1982), started by k-means++ (D. Arthur,
/// S. Vassilvitskii, 2007). No cluster is empty.
std::vector<Point> k_means(const Solid& solid, const KMeansOptions& options);

/// For each centre the smallest ball around that part of the solid that is nearer to it than to the others, so that all
/// balls together cover the solid; none where there is no such part. The part is a polyhedron, and a ball holds it if
/// it holds its corners: those of the mesh's triangles, cut by the faces of the centre's Voronoi cell, and the vertices
/// of that cell inside the solid. Radii are enlarged by 1e-7 of the diagonal, far more than the rounding of these
/// corners.
std::vector<Ball> smallest_around_cells(const Solid& solid, std::span<const Point> centres, unsigned threads);

}  // namespace medial_vk::bench
