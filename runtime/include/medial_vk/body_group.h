// The least distance among the links of an assembly, such as a robot and its surroundings: of many pairs of bodies at
// once, with proof (docs/theory.md, "Many bodies").
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>

#include "medial_vk/pose.h"
#include "medial_vk/proximity.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A body that is fixed to a link.
struct GroupPart {
  Body body;
  std::uint32_t link = 0;  ///< Index of the link. The parts of a link move together.
  Pose pose = {};          ///< From the frame of the body to that of the link.
};

/// Two links, by their indices, whose parts are compared.
struct LinkPair {
  std::uint32_t a = 0, b = 0;

  bool operator==(const LinkPair&) const = default;
};

/// Two parts, by their indices.
struct PartPair {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t a = kNone, b = kNone;

  bool operator==(const PartPair&) const = default;
};

/// Bodies on links that move relative to one another, and the pairs of links that are compared. Immutable: any number
/// of threads may query it.
class BodyGroup {
 public:
  /// `links` is the number of links; a link may have no part. Bodies are shared, not copied. Errors: kUsage (a link of
  /// `parts` or `pairs` that is not below `links`, a pair of a link and itself, a body with neither a mesh nor a cover,
  /// a pose whose rows have products farther than 3e-13 from 0 and 1, a part that reaches beyond 1e18), kOutOfMemory.
  static Result<BodyGroup> create(std::span<const GroupPart> parts, std::size_t links, std::span<const LinkPair> pairs);

  std::size_t links() const;
  std::span<const GroupPart> parts() const;
  std::span<const LinkPair> pairs() const;

 private:
  friend struct Internals;
  struct Impl;
  explicit BodyGroup(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

  std::shared_ptr<const Impl> impl_;
};

struct GroupOptions {
  /// Triangles decide, where balls do not; all bodies have meshes. Otherwise balls alone.
  bool exact = false;
  /// Of `exact`: the interval may be as wide as this, in the units of the meshes. 0: as narrow as rounding allows.
  double tolerance = 0;
  /// Where the least distance is greater, only that is proved: `lower` is then at least the limit and above 0, and
  /// `upper` may be infinite. With 0, only collisions are decided, which is fastest.
  double limit = std::numeric_limits<double>::infinity();
};

/// An interval that contains the least distance of all compared parts, 0 if two of them have a point in common.
struct LeastDistance {
  double lower = 0;
  double upper = std::numeric_limits<double>::infinity();
  /// The parts that give the two ends, in any order; of a hit, two parts with a common point. No pair where all are
  /// beyond the limit.
  PartPair lower_pair, upper_pair;
  /// Of the closest parts, for the next query: balls, and triangles.
  DistanceBounds balls;
  std::uint32_t triangle_a = Distance::kNone, triangle_b = Distance::kNone;

  /// Free: all compared parts are proved to be. Hit: two of them are.
  Collision collision() const {
    return lower > 0 ? Collision::kFree : upper == 0 ? Collision::kHit : Collision::kUndecided;
  }
};

/// The least distance of the compared parts where each link's frame is mapped to a common one by its pose. As for
/// distance_bounds() and distance(), all rounding errors are included, also those of the relative poses: the interval
/// contains the least distance for the poses as they are. A proved hit ends the search: the least distance is then 0.
/// `start` may be the result of an earlier query of the same group: the search then begins with its parts, and is
/// faster if the poses have changed little. Allocates nothing, unless stopped. A group without compared parts is free,
/// at infinity. Precondition: the rows of the rotations are perpendicular unit vectors to within 1e-13. Where a
/// coordinate of a shift is beyond 1e18, or no number, the interval may be 0 and infinity. A request to `stop` ends the
/// search before its next part, or within two parts at the next comparison of triangles. Errors: kUsage (not one pose
/// for each link, an option that is negative or no number, `exact` for a body without a mesh), kInterrupted.
Result<LeastDistance> least_distance(const BodyGroup& group, std::span<const Pose> poses,
                                     const GroupOptions& options = {}, const LeastDistance& start = {},
                                     const std::stop_token& stop = {});

/// The same for many configurations, each of which has a pose for each link; configuration i begins at `poses`[i
/// times the number of links]. Most searches start from the result before them; the intervals do not depend on the
/// number of threads. Further error: kUsage (`poses` has not so many poses for each of the `results`). After
/// kInterrupted some results are those of their configurations, and the others are as before.
Status least_distances(const BodyGroup& group, std::span<const Pose> poses, std::span<LeastDistance> results,
                       const GroupOptions& options = {}, const BatchOptions& batch = {},
                       const std::stop_token& stop = {});

}  // namespace medial_vk
