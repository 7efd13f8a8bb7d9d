// A union of balls that come, go and move, measured again only where it changes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What a ball shows on the surface of its union, which says how the volume changes with it: if its centre moves by d
/// and its radius grows by e, by vector . d + area * e, to first order.
struct Exposure {
  double area = 0;           ///< Of its sphere on the surface.
  Point vector = {0, 0, 0};  ///< The outward unit normals there, summed up by area.
};

/// For hundreds or thousands of balls: a change takes the time of the power cells that it changes, and a few
/// nanoseconds for every other ball. Volumes are those of measure_ball_union(), with its conditions for balls.
class DynamicUnion {
 public:
  /// For at most `capacity` balls at a time, none with a coordinate or a radius beyond `largest`. Errors: kUsage
  /// (capacity of 2^30 and more; largest not positive and finite), kOutOfMemory.
  static Result<DynamicUnion> build(std::uint32_t capacity, double largest);
  DynamicUnion(DynamicUnion&&) noexcept;
  DynamicUnion& operator=(DynamicUnion&&) noexcept;
  ~DynamicUnion();

  /// Balls have places in [0, places()), not all of which need be taken.
  std::uint32_t places() const;
  bool holds(std::uint32_t place) const;
  std::uint32_t size() const;
  const Ball& ball(std::uint32_t place) const;
  double volume() const;
  Exposure exposure(std::uint32_t place) const;
  /// Where its sphere meets two others on the surface, as BallUnion::vertices. Errors: kUsage (no ball there),
  /// kOutOfMemory.
  Result<std::vector<Point>> vertices(std::uint32_t place) const;

  /// The three changes. Errors: kUsage (no ball there, no room, a ball beyond `largest`), kOutOfMemory; then nothing
  /// has changed. add() says where the ball is now.
  Result<std::uint32_t> add(const Ball& ball);
  Status remove(std::uint32_t place);
  Status move(std::uint32_t place, const Ball& to);
  /// Takes back the last change; once.
  void undo();
  /// Places of balls whose power cells the last change has changed.
  std::span<const std::uint32_t> changed() const;

  /// What add() would add to the volume. Errors: as add().
  Result<double> gain(const Ball& ball);
  /// What remove() would take from the volume. Errors: as remove().
  Result<double> loss(std::uint32_t place);

 private:
  class Impl;
  explicit DynamicUnion(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
