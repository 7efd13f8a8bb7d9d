#include "query_workload.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "base/spiral.h"
#include "medial_vk/scene.h"
#include "support/solids/solids.h"

namespace medial_vk::bench {
namespace {

/// Translates and scales so that the box starts at the origin and its longest side is 1. Returns the sides of the box.
Point normalise(Mesh& mesh) {
  Point lower = mesh.vertices[0], upper = mesh.vertices[0];
  for (const Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  const double longest = std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
  test::translate(mesh, {-lower[0], -lower[1], -lower[2]});
  test::scale(mesh, 1 / longest);
  return {(upper[0] - lower[0]) / longest, (upper[1] - lower[1]) / longest, (upper[2] - lower[2]) / longest};
}

constexpr std::uint32_t kBlock = 4;

/// Centres of a block's voxels along a Z-order curve.
std::array<Point, kBlock * kBlock * kBlock> voxel_centres(const std::array<std::uint32_t, 3>& block) {
  std::array<Point, kBlock * kBlock * kBlock> centres;
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t low = (i >> k) & 1u, high = (i >> (3 + k)) & 1u;
      centres[i][k] = (kBlock * block[k] + 2 * high + low + 0.5) / kResolution;
    }
  }
  return centres;
}

std::vector<std::array<std::uint32_t, 3>> shuffled_blocks(const Point& sides, std::mt19937& random) {
  std::array<std::uint32_t, 3> size;
  for (int k = 0; k < 3; ++k) size[k] = static_cast<std::uint32_t>(std::ceil(sides[k] * kResolution / kBlock));
  std::vector<std::array<std::uint32_t, 3>> blocks;
  for (std::uint32_t z = 0; z < size[2]; ++z)
    for (std::uint32_t y = 0; y < size[1]; ++y)
      for (std::uint32_t x = 0; x < size[0]; ++x) blocks.push_back({x, y, z});
  std::shuffle(blocks.begin(), blocks.end(), random);
  return blocks;
}

}  // namespace

Mesh make_blob(std::uint32_t triangles) {
  Mesh mesh = test::make_sphere(1, triangles);
  constexpr std::array<double, 5> kFrequencies = {2, 4.7, 9.3, 21, 43};
  for (Point& p : mesh.vertices) {
    double height = 1;
    for (const double f : kFrequencies) {
      height +=
          0.3 / f * (std::sin(f * p[0] + 1.3 * f) * std::sin(f * p[1] + 0.7) + std::sin(f * p[2] + 2.1 * f * p[0]));
    }
    p = {height * p[0], height * p[1], height * p[2]};
  }
  return mesh;
}

Result<Workload> make_workload(Context& context, std::string name, Mesh mesh, std::uint64_t queries) {
  Workload w;
  w.name = std::move(name);
  const Point sides = normalise(mesh);
  w.mesh = std::move(mesh);
  const Result<IndexedMesh> indexed = IndexedMesh::build(MeshView{w.mesh.vertices, w.mesh.triangles, {}, true});
  if (!indexed.ok()) return indexed.error();
  Result<Scene> scene = Scene::create(context, indexed.value());
  if (!scene.ok()) return scene.error();
  std::mt19937 random(1);
  const std::vector<Point> directions = spiral_points(kSamples);
  for (const auto& block : shuffled_blocks(sides, random)) {
    if (w.spheres.size() >= queries) break;
    const auto centres = voxel_centres(block);
    Result<std::vector<double>> numbers = scene.value().winding_numbers(centres, 0.25);
    if (!numbers.ok()) return numbers.error();
    for (std::size_t i = 0; i < centres.size(); ++i) {
      if (numbers.value()[i] < 0.5) continue;
      const Point& c = centres[i];
      w.spheres.push_back(c);
      for (const Point& d : directions) {
        w.spheres.push_back({c[0] + d[0] / kResolution, c[1] + d[1] / kResolution, c[2] + d[2] / kResolution});
      }
    }
  }
  w.shuffled = w.spheres;
  std::shuffle(w.shuffled.begin(), w.shuffled.end(), random);
  return w;
}

std::vector<Point> scattered_points(const Workload& workload, std::size_t count) {
  Point upper = {0, 0, 0};
  for (const Point& p : workload.mesh.vertices) {
    for (int k = 0; k < 3; ++k) upper[k] = std::max(upper[k], p[k]);
  }
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Point> points(count);
  for (Point& p : points) {
    for (int k = 0; k < 3; ++k) p[k] = upper[k] * share(random);
  }
  return points;
}

}  // namespace medial_vk::bench
