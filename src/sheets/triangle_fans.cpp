#include "sheets/triangle_fans.h"

#include <algorithm>
#include <numbers>

namespace medial_vk {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// Far above the rounding of an angle, far below one that a triangle of three points in different voxels can have and be
// of use.
constexpr double kTolerance = 1e-9;
constexpr double kLeastExtent = 1e-6;

double wrap(double angle) { return angle < 0 ? angle + kTurn : angle; }

}  // namespace

TriangleFans::TriangleFans(const VoxelGraph& graph) : graph_(graph), sectors_(graph.size()) {
  frames_.reserve(graph.size());
  for (std::uint32_t place = 0; place < graph.size(); ++place) {
    frames_.emplace_back(sheet_normal(graph.sphere(place)));
  }
}

TriangleFans::Sector TriangleFans::sector(std::uint32_t at, std::uint32_t a, std::uint32_t b) const {
  const Point& centre = graph_.sphere(at).centre;
  const double to_a = frames_[at].angle(graph_.sphere(a).centre - centre);
  const double to_b = frames_[at].angle(graph_.sphere(b).centre - centre);
  const double turn = wrap(to_b - to_a);
  return turn < std::numbers::pi ? Sector{to_a, turn} : Sector{to_b, kTurn - turn};
}

bool TriangleFans::has_room(std::uint32_t at, std::uint32_t a, std::uint32_t b) const {
  const Sector wanted = sector(at, a, b);
  if (wanted.extent < kLeastExtent || wanted.extent > std::numbers::pi - kLeastExtent) return false;
  return std::ranges::none_of(sectors_[at], [&](const Sector& taken) {
    const double ahead = wrap(taken.start - wanted.start);
    return ahead < wanted.extent - kTolerance || kTurn - ahead < taken.extent - kTolerance;
  });
}

void TriangleFans::add(std::uint32_t at, std::uint32_t a, std::uint32_t b) { sectors_[at].push_back(sector(at, a, b)); }

}  // namespace medial_vk
