// The spokes of balls from the parts of their spheres that no other ball covers (Section 5.5 of the source).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "curvature/exposed_regions.h"
#include "curvature/sheet_links.h"

namespace medial_vk {

/// The spokes that exposed regions tell.
struct ExposedSpokes {
  std::size_t count = 0;               ///< Of those that are known: 0, 1 or 2.
  std::array<Point, 2> spokes = {};    ///< Unit vectors: the mean directions of the regions, the greater one first.
  std::array<double, 2> reaches = {};  ///< No point of the region is farther away from its spoke, radians.
};

/// Regions that one direction may belong to count as one. Of those that remain, the two of the greatest areas, which
/// need not be the ones that hold the contacts; or the only one, if it is too small for two contacts.
ExposedSpokes spokes_of(std::span<const ExposedRegion> regions);

/// Of the balls with these numbers, among all balls. Where there are not two, those nearby do not count, within two
/// spacings and then within four: a ball whose centre lies off its sheet touches one side of the boundary only, and
/// others nearby all but touch the other one. Nothing is known of those that follow a stop.
std::vector<ExposedSpokes> exposed_spokes(const SheetLinks& links, std::span<const std::uint32_t> numbers,
                                          unsigned threads, const std::stop_token& stop);

}  // namespace medial_vk
