// Balls that leave their places for gaps between the surface and a union of balls (docs/theory.md, "Balls chosen
// anew").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "following/gap_samples.h"
#include "following/surface/moving_surface.h"
#include "following/tracked_ball.h"
#include "following/watched_points.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/dynamic_union.h"
#include "medial_vk/result.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// A ball that leaves its place.
struct BallExchange {
  std::uint32_t ball;
  TrackedBall by;                           ///< Inside the surface.
  std::size_t first_other = 0, others = 0;  ///< Renewal::others_of().
};

/// Where balls may come to.
struct ExchangeRegions {
  const GapSamples& samples;
  std::span<const std::uint8_t> chosen;  ///< By region: 1 if they may.
};

/// The exchanges of one frame after the other, in the same memory.
class Renewal {
 public:
  /// Of frames of this surface, with these samples: up to `most` exchanges in each. `balls` are those of the rest pose;
  /// memory is allocated for twice of what their power cells need. Errors: kUsage (as DynamicUnion::add()). Throws
  /// std::bad_alloc.
  static Result<Renewal> build(const MovingSurface& surface, std::span<const Ball> balls, const GapSamples& samples,
                               std::uint32_t most);

  /// Up to `most` exchanges, in their order, until the next call: each of them enlarges the union of all balls, and
  /// none makes the greatest distance to them larger, of the samples and of the middles of triangles (of very fine
  /// meshes, of a part of these). `measured` is the union of `balls`, as many as at rest, with its vertices; balls of
  /// radius 0 are lost. The result does not depend on the number of threads. Errors: kOutOfMemory, kUsage (as
  /// DynamicUnion::add()).
  Result<std::span<const BallExchange>> find(const MovingSurface& surface, std::span<const Ball> balls,
                                             const BallUnion& measured, const ExchangeRegions& regions,
                                             WorkerPool& pool);
  /// Balls next to which it was or is.
  std::span<const std::uint32_t> others_of(const BallExchange& exchange) const {
    return std::span(others_).subspan(exchange.first_other, exchange.others);
  }

 private:
  using Valued = std::pair<double, std::uint32_t>;  // a volume, and a candidate or a ball

  /// The places in decreasing order of their widths, and else as they were found.
  struct GapPlace {
    Point at;
    double width;
    std::uint32_t triangle;  // of a point of the surface
    std::uint32_t number;
  };

  /// What is fixed during a frame.
  struct FrameInput {
    const MovingSurface& surface;
    std::span<const Ball> balls;
    const BallUnion& measured;
    const ExchangeRegions& regions;
    WorkerPool& pool;

    bool is_chosen(std::uint32_t triangle) const { return regions.chosen[regions.samples.region_of(triangle)] != 0; }
  };

  Renewal(DynamicUnion all, WatchedPoints watched, std::size_t balls, std::uint32_t most);

  bool is_lost(std::uint32_t ball) const;
  Status add_balls(std::span<const Ball> balls);
  Status add(std::uint32_t i, const Ball& ball);
  void find_pockets(const FrameInput& in);
  void find_uncovered_points(const FrameInput& in);
  void sort_places();
  void grow(const MovingSurface& surface, std::size_t most);
  bool is_next_to_candidate(const GapPlace& place) const;
  Status value_candidates();
  Status value_leaving(const FrameInput& in);
  Result<Valued> pop_best();
  Result<Valued> pop_weakest();
  Result<bool> add_exchange(const MovingSurface& surface);
  Result<bool> make_exchange(const MovingSurface& surface, std::uint32_t ball, const TrackedBall& by);
  void note_others(BallExchange& exchange);
  Status slide(const MovingSurface& surface, BallExchange& exchange);

  std::size_t most_;
  DynamicUnion union_;
  WatchedPoints watched_;
  std::vector<std::uint32_t> slot_of_, ball_at_;  // by ball, by slot
  std::vector<GapPlace> places_;
  std::vector<TrackedBall> candidates_;
  std::vector<Valued> gains_;   // a heap, the greatest first
  std::vector<Valued> losses_;  // a heap, the least first
  std::vector<Valued> by_estimate_;
  std::vector<BallExchange> exchanges_;
  std::vector<std::uint32_t> others_;    // of all exchanges
  std::vector<std::uint32_t> noted_in_;  // by ball: the number of the last exchange that noted it
};

}  // namespace medial_vk
