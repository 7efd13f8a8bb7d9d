#include "shape_files/areas/shape_area.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/host_memory.h"

namespace medial_vk {
namespace {

/// Rings of the segments of a shape. As many segments end in a point as begin there, so every way on ends where it
/// began.
void add_rings(const PreparedShape& shape, std::vector<PlaneRing>& rings) {
  const std::size_t points = shape.points.size();
  std::vector<std::uint32_t> first(points + 1, 0);
  for (const auto& segment : shape.segments) ++first[segment[0] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next = first, ends(shape.segments.size());
  for (const auto& [begin, end] : shape.segments) ends[next[begin]++] = end;
  std::copy(first.begin(), first.end() - 1, next.begin());
  for (std::uint32_t start = 0; start < points; ++start) {
    while (next[start] < first[start + 1]) {
      PlaneRing ring;
      for (std::uint32_t at = start; next[at] < first[at + 1]; at = ends[next[at]++]) ring.push_back(shape.points[at]);
      rings.push_back(std::move(ring));
    }
  }
}

/// 1 where all corners turn left, and once around in total; -1 where all turn right; 0 for other rings, and where
/// rounding leaves a doubt. Such a ring is convex and does not meet itself, and by either rule its inside is the same.
int sense_of_convex(const PlaneRing& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return 0;
  int sense = 0, reversals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint &a = ring[i], &b = ring[(i + 1) % n], &c = ring[(i + 2) % n];
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
    // Three roundings in each product and that of their difference, in units of 2^-53; a fifth covers their products.
    const double left = ux * vy, right = uy * vx, bound = 5 * 0x1p-53 * (std::fabs(left) + std::fabs(right));
    if (!(std::fabs(left - right) > bound)) return 0;
    const int turn = left > right ? 1 : -1;
    if (sense != 0 && turn != sense) return 0;
    sense = turn;
    const bool forward = ux > 0 || (ux == 0 && uy > 0), forward_next = vx > 0 || (vx == 0 && vy > 0);
    if (forward != forward_next) ++reversals;
  }
  return reversals == 2 ? sense : 0;
}

/// Adds the ring of an area that needs no preparation. False if it does.
bool add_convex(ShapeArea& area, std::vector<PlaneRing>& rings) {
  if (area.rings.size() != 1) return false;
  PlaneRing& ring = area.rings.front();
  const int sense = sense_of_convex(ring);
  if (sense == 0) return false;
  if (sense < 0) std::ranges::reverse(ring);
  rings.push_back(std::move(ring));
  return true;
}

Error no_inside() { return {ErrorCode::kInvalidMesh, "no area of it encloses anything"}; }

Result<UnitedAreas> unite(std::vector<ShapeArea> areas, unsigned threads, const std::stop_token& stop) {
  UnitedAreas united;
  if (areas.size() == 1) {
    united.rings = std::move(areas.front().rings);
    united.rule = areas.front().rule;
    united.areas = 1;
    if (std::ranges::none_of(united.rings, [](const PlaneRing& ring) { return ring.size() > 2; })) return no_inside();
    return united;
  }
  united.rule = FillRule::kNonZero;
  constexpr std::size_t kPointsForThreads = 10'000;  // fewer points take less time than threads to start
  for (ShapeArea& area : areas) {
    if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "uniting the areas of a shape was interrupted"};
    if (add_convex(area, united.rings)) {
      ++united.areas;
      continue;
    }
    const std::size_t points = std::accumulate(area.rings.begin(), area.rings.end(), std::size_t{0},
                                               [](std::size_t n, const PlaneRing& ring) { return n + ring.size(); });
    const Result<PreparedShape> shape =
        prepare_shape(area.rings, area.rule, points < kPointsForThreads ? 1 : threads, stop);
    area.rings = {};
    if (!shape) {
      if (shape.error().code != ErrorCode::kInvalidMesh) return shape.error();
      ++united.empty;
      continue;
    }
    ++united.areas;
    united.crossings += shape.value().report.crossings;
    add_rings(shape.value(), united.rings);
  }
  if (united.areas == 0) return no_inside();
  return united;
}

}  // namespace

Result<UnitedAreas> unite_areas(std::vector<ShapeArea> areas, unsigned threads, const std::stop_token& stop) {
  return catch_out_of_memory("uniting the areas of a shape", [&] { return unite(std::move(areas), threads, stop); });
}

void add_sentence(std::vector<std::string>& sentences, std::uint64_t count, const char* one, const char* many) {
  if (count > 0) sentences.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
}

}  // namespace medial_vk
