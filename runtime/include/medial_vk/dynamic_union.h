// A union of balls that are added, removed and moved, remeasured only where it changes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The part of a ball's sphere on the envelope of the union. It gives the change of the volume: if the centre moves by
/// d and the radius grows by e, the volume grows by vector . d + area * e, to first order.
struct Exposure {
  double area = 0;           ///< Of the sphere on the envelope.
  Point vector = {0, 0, 0};  ///< The integral of the outward unit normals there, by area.
};

/// For hundreds or thousands of balls: a change takes the time of the power cells that it alters, and a few nanoseconds
/// for every other ball. Volumes are those of measure_ball_union(), under the same conditions for balls.
class DynamicUnion {
 public:
  /// For at most `capacity` balls at a time, none with a coordinate or a radius beyond `largest`. `threads`: of the
  /// host in gains(), at most 16, 0: one per core; no result depends on it. Errors: kUsage (capacity of 2^30 and more;
  /// largest not positive and finite), kOutOfMemory.
  static Result<DynamicUnion> build(std::uint32_t capacity, double largest, unsigned threads = 1);
  DynamicUnion(DynamicUnion&&) noexcept;
  DynamicUnion& operator=(DynamicUnion&&) noexcept;
  ~DynamicUnion();

  /// Each ball occupies a slot in [0, slots()); some slots may be empty.
  std::uint32_t slots() const;
  bool holds(std::uint32_t slot) const;
  std::uint32_t size() const;
  const Ball& ball(std::uint32_t slot) const;
  double volume() const;
  Exposure exposure(std::uint32_t slot) const;
  /// The points of the envelope where the ball's sphere meets two others, as BallUnion::vertices. Errors: kUsage (an
  /// empty slot), kOutOfMemory.
  Result<std::vector<Point>> vertices(std::uint32_t slot) const;

  /// The three changes; add() returns the slot of the ball. Errors: kUsage (an empty slot, no free slot, a ball beyond
  /// `largest`), kOutOfMemory; after an error nothing has changed.
  Result<std::uint32_t> add(const Ball& ball);
  Status remove(std::uint32_t slot);
  Status move(std::uint32_t slot, const Ball& to);
  /// Reverts the last change, but none before it.
  void undo();
  /// The slots of the balls whose power cells have been altered by the last change.
  std::span<const std::uint32_t> changed() const;

  /// For several moves of which only the end counts: shift() is move(), but leaves the power cells that it alters to
  /// settle(), which computes each of them once, on all threads. Until then, only the functions of this group and
  /// slots(), holds(), size() and ball() may be called. Nothing of it can be undone; after settle(), changed() names
  /// every slot whose cell they have altered. Errors: shift(): kUsage as for move(), nothing has changed; settle():
  /// kOutOfMemory, it can be repeated.
  Status shift(std::uint32_t slot, const Ball& to);
  Status settle();
  /// The exposure that the ball would have after this move, or has where it is, in the time of one power cell. Errors:
  /// those of move().
  Result<Exposure> exposure_at(std::uint32_t slot, const Ball& to);

  /// Removes all balls, whose memory serves later ones; `largest` as in build(). Allocates nothing. Error: kUsage
  /// (`largest`: nothing has changed).
  Status clear(double largest);
  /// Later changes, and gain() and loss(), allocate nothing as long as the power cells of all balls together have at
  /// most twice as many faces and corners as now, no more than 1,024 balls touch one, and exact arithmetic needs no
  /// more than usual. Error: kOutOfMemory.
  Status make_room();

  /// The increase of the volume of the union by add(). Errors: those of add().
  Result<double> gain(const Ball& ball);
  /// The increases by each one of these balls alone, in their order. Errors: those of gain().
  Result<std::vector<double>> gains(std::span<const Ball> balls);
  /// The decrease of the volume of the union by remove(). Errors: those of remove().
  Result<double> loss(std::uint32_t slot);

 private:
  class Impl;
  explicit DynamicUnion(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
