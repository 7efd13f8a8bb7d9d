#include "plane/diagram/needed_sites.h"

#include <algorithm>

namespace medial_vk::plane {
namespace {

/// The sine of the least turn of a convex corner that is left out. At joints that are straighter than that, which of
/// three sites is nearest is left to rounding, and the point is one of them (can_touch()).
constexpr double kLeastBend = 0x1p-12;

/// Whether the wanted side takes less than half a turn in each sector around a point in which it lies.
bool is_convex_corner(const SiteSet& sites, Wanted wanted, std::uint32_t point) {
  const std::span<const std::uint32_t> fan = sites.segments_of(point);
  if (fan.size() < 2) return false;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const std::uint32_t right = fan[i], left = fan[(i + 1) % fan.size()];
    const Side towards = sites.segment(right).ends[0] == point ? Side::kLeft : Side::kRight;
    if (allows(wanted, towards) && !(cross(sites.leaving(point, right), sites.leaving(point, left)) > kLeastBend)) {
      return false;
    }
  }
  return true;
}

}  // namespace

NeededSites::NeededSites(const SiteSet& sites, Wanted wanted) : stands_for(sites.size() - sites.points()) {
  const bool has_one_side = wanted == Wanted::kLeft || wanted == Wanted::kRight;
  list.reserve(sites.size());
  for (std::uint32_t p = 0; p < sites.points(); ++p) {
    if (!has_one_side || !is_convex_corner(sites, wanted, p)) {
      list.push_back(p);
      continue;
    }
    const std::uint32_t segment = sites.segments_of(p).front();
    std::uint8_t& ends = stands_for[segment - sites.points()];
    ends = static_cast<std::uint8_t>(ends | (sites.segment(segment).ends[0] == p ? 1 : 2));
  }
  for (std::uint32_t s = sites.points(); s < sites.size(); ++s) list.push_back(s);
}

}  // namespace medial_vk::plane
