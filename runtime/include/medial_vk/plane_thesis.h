// The medial axis in the plane as Chapter 4 publishes it: Algorithm 4 (DECIDEMA) on circles, and on overlapping discs
// of varying radii (Section 4.4). What it can miss: docs/theory.md, "What finitely many samples of a circle can miss".
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "medial_vk/plane_shape.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What is nearest to a point of the plane on the boundary of a shape.
struct NearestBoundary {
  PlanePoint foot = {};
  /// Unit, from the point to the foot: the gradient of the signed distance, or its opposite.
  PlanePoint direction = {};
  double distance = 0;
  bool is_inside = false;
};

/// The boundary of a shape, ready for queries. Immutable; copies share the data, and threads may.
class PlaneBoundary {
 public:
  struct Impl;
  /// Time: proportional to n log n. Errors: kInvalidMesh (no segments), kOutOfMemory.
  static Result<PlaneBoundary> build(const PreparedShape& shape);
  NearestBoundary nearest(PlanePoint p) const;
  /// Two feet at most this far apart count as one, in input units: 2^-44 of the size.
  double tolerance() const;
  const Impl& impl() const { return *impl_; }

 private:
  explicit PlaneBoundary(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

struct PlaneCircle {
  PlanePoint centre = {};
  double radius = 0;
};

enum class MedialDecision : std::uint8_t {
  kTrue,         ///< The circle contains a medial point.
  kUndetermined  ///< No such conclusion can be drawn.
};

/// Why Algorithm 4 returns 'True': the line at which it does.
enum class DecisionReason : std::uint8_t {
  kNone = 0,
  kOppositeDiffers = 3,  ///< A sample and its opposite have different gradients (Lemma 2.3).
  kDifferentSides = 8,   ///< Gradients of neighbours are to different sides of their line (Corollary 4.2).
  kPointsBetween = 13    ///< A point of Theta lies between the opposites of neighbours (Lemma 4.2).
};

/// A point of Theta: a sample of the circle, or the opposite of one.
struct CirclePoint {
  PlanePoint point = {};
  NearestBoundary nearest = {};
  std::uint32_t opposite = 0;  ///< Its number in CircleDecision::points.
};

struct CircleDecision {
  MedialDecision decision = MedialDecision::kUndetermined;
  DecisionReason reason = DecisionReason::kNone;
  std::array<std::uint32_t, 2> found = {};  ///< Two points of Theta with a medial point on the segment between them.
  std::vector<CirclePoint> points;          ///< Theta, counter-clockwise, each once.
};

/// Algorithm 4. `angles`: of the samples, radians. Errors: kUsage (the circle is not inside the shape, fewer than three
/// samples, a number that is not finite), kOutOfMemory.
Result<CircleDecision> decide_medial_axis(const PlaneBoundary& boundary, const PlaneCircle& circle,
                                          std::span<const double> angles);
/// With so many samples at equal distances.
Result<CircleDecision> decide_medial_axis(const PlaneBoundary& boundary, const PlaneCircle& circle, unsigned samples);

struct PlaneThesisOptions {
  /// As in PlaneAxisOptions.
  double object_angle = 0.6;
  double radius = 0;
  /// Of each circle; at least 6, or 0: as many as are proved to miss no medial point of that object angle in a disc.
  unsigned samples = 0;
  double largest_disc = 0;  ///< Its radius, in input units; 0: a 50th of the longest side.
  double least_disc = 0;    ///< No disc is smaller than half of it; 0: a 16th of the largest.
  double epsilon = 0;       ///< Points are this close to the medial axis, in input units; 0: 2^-30 of the longest side.
  unsigned threads = 0;     ///< Of the host, 0: one per core. The result does not depend on it.
};

struct PublishedPoint {
  PlanePoint point = {};
  double radius = 0;
  std::array<PlanePoint, 2> feet = {};  ///< The ends of its spokes: of the second, an estimate (Lemma 2.4).
  double object_angle = 0;
};

struct PublishedAxis {
  std::vector<PublishedPoint> points;
  std::uint64_t discs = 0;
  std::uint64_t undetermined = 0;
  std::array<std::uint64_t, 3> decided = {};  ///< Discs, by the reasons of lines 3, 8 and 13.
  unsigned samples = 0;
  /// Every medial point with a larger object angle than this, and at least that radius, lies in a disc that is decided.
  double missed_angle = 0;
  double missed_radius = 0;
};

/// Section 4.4: discs inside the shape are decided, and in each that holds a medial point, points of the axis are found
/// by bisection. Errors: kUsage (an option out of range), kOutOfMemory, kInterrupted.
Result<PublishedAxis> find_plane_axis_as_published(const PreparedShape& shape, const PlaneThesisOptions& options = {},
                                                   const ProgressCallback& progress = {},
                                                   const std::stop_token& stop = {});

}  // namespace medial_vk
