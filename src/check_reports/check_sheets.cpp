#include "check_reports/check_sheets.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

namespace medial_vk {
namespace {

using Voxel = std::array<std::uint32_t, 3>;

/// Fills the part of a sheet that holds a given voxel, voxel by voxel.
class Flood {
 public:
  explicit Flood(std::span<const MedialSphere> spheres) {
    for (const MedialSphere& s : spheres) left_.emplace(s.voxel, s.sheet);
  }

  /// The number of parts of each sheet.
  std::map<std::int32_t, std::uint64_t> count_parts() {
    std::map<std::int32_t, std::uint64_t> parts;
    while (!left_.empty()) {
      const auto [voxel, sheet] = *left_.begin();
      ++parts[sheet];
      fill(voxel, sheet);
    }
    return parts;
  }

 private:
  void fill(const Voxel& start, std::int32_t sheet) {
    std::vector<Voxel> open = {start};
    left_.erase(start);
    while (!open.empty()) {
      const Voxel at = open.back();
      open.pop_back();
      for (std::uint32_t n = 0; n < 27; ++n) {
        // An index of 0 minus 1 wraps to a voxel that no grid has.
        const auto found = left_.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
        if (found == left_.end() || found->second != sheet) continue;
        open.push_back(found->first);
        left_.erase(found);
      }
    }
  }

  std::map<Voxel, std::int32_t> left_;
};

void fail(CheckLine& line, std::string message) {
  if (line.failed++ == 0) line.first_failure = std::move(message);
}

}  // namespace

std::vector<CheckLine> check_sheets(std::span<const MedialSphere> spheres, bool all_kept) {
  CheckLine connected, ordered;
  connected.condition = "sheet connected by voxels that touch";
  ordered.condition = "sheets numbered by decreasing number of points";
  for (const auto& [sheet, parts] : Flood(spheres).count_parts()) {
    ++connected.tested;
    if (parts > 1) fail(connected, fmt::format("sheet {} has {} parts", sheet, parts));
  }
  std::map<std::int32_t, std::uint64_t> points;
  for (const MedialSphere& s : spheres) ++points[s.sheet];
  std::int32_t expected = 0;
  std::uint64_t before = spheres.size();
  for (const auto& [sheet, count] : points) {
    ++ordered.tested;
    if (all_kept && sheet != expected)
      fail(ordered, fmt::format("sheet {} comes where sheet {} is expected", sheet, expected));
    if (count > before) fail(ordered, fmt::format("sheet {} has {} points, the one before {}", sheet, count, before));
    expected = sheet + 1;
    before = count;
  }
  return {connected, ordered};
}

}  // namespace medial_vk
