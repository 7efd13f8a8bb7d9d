// Random points of the surface between sites, found without the search of the library.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "medial_vk/bvh.h"
#include "medial_vk/site_voronoi.h"
#include "solid/solid.h"

namespace medial_vk::test {

struct SiteSample {
  Point point = {0, 0, 0};
  double distance = 0;      ///< To the nearest site.
  double object_angle = 0;  ///< Between the contacts on the two nearest sites.
  bool is_inside = false;   ///< Of a solid.
};

/// Bisects chords of the box of the grid whose ends have different nearest sites, with closest-point queries to a tree
/// for each site.
class SiteSampler {
 public:
  SiteSampler(std::span<const VoronoiSite> sites, const SiteGrid& grid, std::uint32_t seed);

  /// None: both ends of the chord have the same nearest site.
  std::optional<SiteSample> next();

 private:
  struct Nearest {
    std::uint32_t site = 0;
    double distance = 0, second = 0;
    Point contact = {0, 0, 0}, second_contact = {0, 0, 0};
  };
  Nearest nearest(const Point& p) const;

  std::vector<Bvh> trees_;
  std::vector<Solid> solids_;
  SiteGrid grid_;
  std::mt19937_64 random_;
};

/// Left out: the sample is inside of a solid, and none of the surface. Lost: its voxel has no point and is not
/// undecided.
enum class SampleState : std::uint8_t { kLost, kFound, kUndecided, kLeftOut };

/// By the voxel that holds the sample.
class SampledVoxels {
 public:
  explicit SampledVoxels(const SiteVoronoi& voronoi);

  SampleState state_of(const SiteSample& sample) const;

 private:
  const SiteGrid grid_;
  std::vector<SampleState> states_;
};

}  // namespace medial_vk::test
