#include "support/site_voronoi/site_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/point_ops.h"
#include "support/site_voronoi/arrangements.h"

namespace medial_vk::test {
namespace {

Bvh tree_of_site(const VoronoiSite& site) {
  Mesh mesh;
  for (const auto& element : elements_of_site(site)) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), element.begin(), element.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  Result<Bvh> tree = Bvh::build({mesh.vertices, mesh.triangles, {}, false});
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::move(tree).value();
}

std::size_t index_of(const SiteGrid& grid, const std::array<std::uint32_t, 3>& voxel) {
  return (std::size_t{voxel[2]} * grid.size[1] + voxel[1]) * grid.size[0] + voxel[0];
}

}  // namespace

SiteSampler::SiteSampler(std::span<const VoronoiSite> sites, const SiteGrid& grid, std::uint32_t seed)
    : grid_(grid), random_(seed) {
  trees_.reserve(sites.size());
  for (const VoronoiSite& site : sites) {
    trees_.push_back(tree_of_site(site));
    if (!site.mesh || !site.mesh->view().closed) continue;
    Result<Solid> solid = Solid::build(*site.mesh);
    if (!solid) throw std::runtime_error(solid.error().message);
    solids_.push_back(std::move(solid).value());
  }
}

SiteSampler::Nearest SiteSampler::nearest(const Point& p) const {
  Nearest best;
  best.distance = best.second = std::numeric_limits<double>::infinity();
  for (std::uint32_t s = 0; s < trees_.size(); ++s) {
    const BvhHit hit = trees_[s].closest(p);
    const double d = std::sqrt(hit.squared_distance);
    if (d < best.distance) {
      best = {s, d, best.distance, hit.point, best.contact};
    } else if (d < best.second) {
      best.second = d;
      best.second_contact = hit.point;
    }
  }
  return best;
}

std::optional<SiteSample> SiteSampler::next() {
  std::array<Point, 2> ends;
  for (Point& end : ends) {
    for (std::size_t k = 0; k < 3; ++k) {
      end[k] = grid_.origin[k] + std::uniform_real_distribution<double>(0, grid_.size[k] * grid_.side)(random_);
    }
  }
  const std::uint32_t label = nearest(ends[0]).site;
  if (nearest(ends[1]).site == label) return std::nullopt;
  Point low = ends[0], high = ends[1];
  for (int i = 0; i < 60; ++i) {
    const Point middle = low + 0.5 * (high - low);
    if (middle == low || middle == high) break;
    (nearest(middle).site == label ? low : high) = middle;
  }
  const Nearest at = nearest(low);
  const Point a = at.contact - low, b = at.second_contact - low;
  const bool is_inside = std::ranges::any_of(solids_, [&](const Solid& solid) { return solid.contains(low); });
  return SiteSample{low, at.distance, 0.5 * std::atan2(length(cross(a, b)), dot(a, b)), is_inside};
}

SampledVoxels::SampledVoxels(const SiteVoronoi& voronoi)
    : grid_(voronoi.grid), states_(std::size_t{grid_.size[0]} * grid_.size[1] * grid_.size[2]) {
  for (const SitePoint& point : voronoi.points) states_[index_of(grid_, point.voxel)] = SampleState::kFound;
  for (const auto& voxel : voronoi.undecided) states_[index_of(grid_, voxel)] = SampleState::kUndecided;
}

SampleState SampledVoxels::state_of(const SiteSample& sample) const {
  if (sample.is_inside) return SampleState::kLeftOut;
  std::array<std::uint32_t, 3> voxel;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = std::floor((sample.point[k] - grid_.origin[k]) / grid_.side);
    voxel[k] = static_cast<std::uint32_t>(std::clamp(at, 0.0, grid_.size[k] - 1.0));
  }
  return states_[index_of(grid_, voxel)];
}

}  // namespace medial_vk::test
