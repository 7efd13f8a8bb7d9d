#include "medial_vk/site_roadmap.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/voxel_order.h"
#include "site_voronoi/grid_rounding.h"
#include "site_voronoi/line_clearance.h"
#include "site_voronoi/widest_way.h"

namespace medial_vk {

struct SiteRoadmap::Impl {
  SiteForest forest;
  double rounding = 0;
  std::vector<ClearPlace> places;  // by point
  std::vector<RoadmapLink> links;
  std::vector<std::uint32_t> component_of_point;
  std::uint32_t components = 0;
};

namespace {

using Voxel = std::array<std::uint32_t, 3>;

constexpr std::size_t kPointsOfABlock = 256;

std::uint32_t point_in(const std::vector<SitePoint>& points, const Voxel& voxel) {
  const auto at = std::lower_bound(points.begin(), points.end(), voxel,
                                   [](const SitePoint& p, const Voxel& v) { return is_earlier_voxel(p.voxel, v); });
  const bool is_there = at != points.end() && at->voxel == voxel;
  return is_there ? static_cast<std::uint32_t>(at - points.begin()) : SitePath::kNoPoint;
}

/// The points in those of the 26 voxels around one that come after it, ascending.
std::vector<std::uint32_t> later_neighbours(const std::vector<SitePoint>& points, std::uint32_t of) {
  std::vector<std::uint32_t> neighbours;
  const Voxel& voxel = points[of].voxel;
  for (unsigned i = 14; i < 27; ++i) {  // in base 3, the offsets plus one, z first: 13 is no offset
    const std::array<unsigned, 3> digits = {i % 3, i / 3 % 3, i / 9};
    Voxel other = voxel;
    bool is_in_grid = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_in_grid = is_in_grid && other[k] + digits[k] >= 1;
      other[k] += digits[k] - 1;
    }
    if (!is_in_grid) continue;
    const std::uint32_t neighbour = point_in(points, other);
    if (neighbour != SitePath::kNoPoint) neighbours.push_back(neighbour);
  }
  return neighbours;
}

std::vector<RoadmapLink> find_links(const SiteForest& forest, double rounding, const std::vector<ClearPlace>& places,
                                    const std::vector<SitePoint>& points, unsigned threads, LoopWatch& watch) {
  const std::size_t blocks = (points.size() + kPointsOfABlock - 1) / kPointsOfABlock;
  std::vector<std::vector<RoadmapLink>> links(blocks);
  parallel_for(blocks, 1, threads, [&](std::size_t block) {
    watch.check();
    const auto begin = static_cast<std::uint32_t>(block * kPointsOfABlock);
    const auto end = static_cast<std::uint32_t>(std::min(points.size(), (block + 1) * kPointsOfABlock));
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const std::uint32_t k : later_neighbours(points, i)) {
        const double width = clearance_of_line(forest, rounding, places[i], places[k]);
        if (width > 0) links[block].push_back({{i, k}, length(places[k].at - places[i].at), width});
      }
    }
    watch.finish(1, blocks);
  });
  std::vector<RoadmapLink> all;
  for (const std::vector<RoadmapLink>& of_block : links) all.insert(all.end(), of_block.begin(), of_block.end());
  return all;
}

}  // namespace

Result<SiteRoadmap> SiteRoadmap::build(std::span<const VoronoiSite> sites, const SiteVoronoi& voronoi,
                                       const SiteRoadmapOptions& options, const ProgressCallback& progress,
                                       const std::stop_token& stop) {
  return catch_out_of_memory("making a roadmap", [&]() -> Result<SiteRoadmap> {
    Result<SiteForest> forest = SiteForest::build(sites, options.threads);
    if (!forest) return forest.error();
    auto impl = std::make_shared<Impl>(Impl{std::move(forest).value(), rounding_in(voronoi.grid), {}, {}, {}, 0});
    impl->places.reserve(voronoi.points.size());
    for (const SitePoint& p : voronoi.points) impl->places.push_back({p.point, p.distance - p.error});
    LoopWatch watch(progress, stop);
    try {
      impl->links = find_links(impl->forest, impl->rounding, impl->places, voronoi.points, options.threads, watch);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
    DisjointSets sets(impl->places.size());
    for (const RoadmapLink& link : impl->links) sets.join(link.points[0], link.points[1]);
    impl->component_of_point.resize(impl->places.size());
    for (std::uint32_t i = 0; i < impl->places.size(); ++i) {
      const std::uint32_t first = sets.of(i);
      impl->component_of_point[i] = first == i ? impl->components++ : impl->component_of_point[first];
    }
    return SiteRoadmap(std::move(impl));
  });
}

const std::vector<RoadmapLink>& SiteRoadmap::links() const { return impl_->links; }

const std::vector<std::uint32_t>& SiteRoadmap::component_of_point() const { return impl_->component_of_point; }

std::uint32_t SiteRoadmap::components() const { return impl_->components; }

Result<std::optional<SitePath>> SiteRoadmap::widest_path(const Point& from, const Point& to) const {
  return catch_out_of_memory("finding a path", [&]() -> Result<std::optional<SitePath>> {
    std::vector<PlaceJoin> joins;
    joins.reserve(impl_->links.size());
    for (const RoadmapLink& link : impl_->links) {
      joins.push_back({link.points[0], link.points[1], link.width, link.length});
    }
    const Result<std::optional<WidestWay>> found =
        find_widest_way(impl_->forest, impl_->rounding, impl_->places, std::move(joins), {from, to});
    if (!found) return found.error();
    if (!found.value()) return std::optional<SitePath>();
    const WidestWay& way = *found.value();
    SitePath path;
    path.width = way.width;
    const auto count = static_cast<std::uint32_t>(impl_->places.size());
    for (const WayStep& step : way.steps) {
      const bool is_beside = step.place >= count;
      path.line.push_back(is_beside ? way.beside[step.place - count].at : impl_->places[step.place].at);
      path.points.push_back(is_beside ? SitePath::kNoPoint : step.place);
      if (path.line.size() > 1) path.length += length(path.line.back() - path.line[path.line.size() - 2]);
    }
    return std::optional<SitePath>(std::move(path));
  });
}

Status check_path_ends(std::span<const VoronoiSite> sites, const Point& from, const Point& to, unsigned threads) {
  const auto tested = catch_out_of_memory("testing the ends of a path", [&]() -> Result<bool> {
    const Result<SiteForest> forest = SiteForest::build(sites, threads);
    if (!forest) return forest.error();
    const double rounding = 0x1p-47 * greatest_coordinate(forest.value().box());
    if (Status status = check_ends(forest.value(), rounding, {from, to}); !status) return status.error();
    return true;
  });
  if (!tested) return tested.error();
  return {};
}

}  // namespace medial_vk
