#include "plane/thesis/cover.h"

#include <array>
#include <cstdint>
#include <numbers>

#include "base/parallel.h"

namespace medial_vk::plane {
namespace {

constexpr std::size_t kBlock = 256;

enum class SquareState : std::uint8_t { kOutside, kCovered, kDivided };

SquareState state_of(const SiteSet& sites, const BoundaryTree& tree, const Disc& disc, double largest) {
  const Foot foot = tree.nearest(disc.centre);
  const bool is_inside = sites.side_of(foot.site, disc.centre) == Side::kLeft;
  if (is_inside && disc.radius <= largest && foot.distance >= kClearance * disc.radius) return SquareState::kCovered;
  if (!is_inside && foot.distance >= disc.radius / kOverlap) return SquareState::kOutside;
  return SquareState::kDivided;
}

}  // namespace

Cover cover_inside(const SiteSet& sites, const BoundaryTree& tree, double largest, double least, unsigned threads,
                   const LoopWatch& watch) {
  Cover cover;
  double half = 0.5;  // of the side of a square
  std::vector<Vec2> squares = {{0, 0}};
  while (!squares.empty()) {
    watch.check();
    const double radius = kOverlap * std::numbers::sqrt2 * half;
    std::vector<SquareState> states(squares.size());
    parallel_for(squares.size(), kBlock, threads, [&](std::size_t i) {
      states[i] = state_of(sites, tree, {squares[i], radius}, largest);
    });
    std::vector<Vec2> parts;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      if (states[i] == SquareState::kCovered) cover.discs.push_back({squares[i], radius});
      if (states[i] != SquareState::kDivided) continue;
      for (const Vec2 sign : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
        parts.push_back(squares[i] + (half / 2) * sign);
      }
    }
    // A point of a square without a disc is within radius / kOverlap of its centre.
    cover.missed_radius = (kClearance + 1 / kOverlap) * radius;
    if (radius <= least) break;
    squares = std::move(parts);
    half /= 2;
  }
  return cover;
}

}  // namespace medial_vk::plane
