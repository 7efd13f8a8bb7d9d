// Balls that cover a solid and follow its boundary as the vertices of the mesh move (docs/theory.md, "Covers that
// follow a surface").
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What the balls of the present frame are proved to hold.
enum class CoverState : std::uint8_t {
  kSolid,  ///< Every point whose winding number is not 0, and every triangle.
  /// Every triangle. Of a mesh that is not closed, with CoverFollowerOptions::surface_only, and where the longest side
  /// is below 1e-18 or a ball reaches beyond 1e18.
  kSurface,
};

struct CoverFollowerOptions {
  /// Only the triangles are covered, and the solid where no cavity opens between the balls. A frame then takes a small
  /// share of the time.
  bool surface_only = false;
  /// The number of steps that all balls take towards a smaller volume of the union in every frame. Each takes the time
  /// of one measure_ball_union() and some more.
  std::uint32_t steps = 0;
  /// Of the host, 0: one per core; of those, a follower keeps as many as its balls give work to. The result does not
  /// depend on it.
  unsigned threads = 0;

  bool operator==(const CoverFollowerOptions&) const = default;
};

/// Volumes of a frame, in cubed mesh units.
struct CoverFollowMeasures {
  /// Of the mesh, by its triangles: that of the solid if no triangles cross. In a mirrored frame, too, it is positive.
  /// NaN if it is known not to be that of the solid: the mesh is not closed, or the frame is flat, or parts overlap
  /// such that they count more volume than the balls, which hold the solid, have.
  double solid_volume = 0;
  double ball_volume = 0;  ///< Of the union of the balls; exact.

  /// The volume of the balls outside of the solid, if that is covered; NaN where solid_volume is.
  double added() const { return ball_volume - solid_volume; }
};

/// A set of balls that covers every frame of a motion. Each part of a triangle is held by one ball, which moves with
/// its parts and has the radius that they need. Frames do not depend on each other. Objects are independent of each
/// other.
class CoverFollower {
 public:
  /// The balls are meant to cover the rest pose closely, as fits with contract `cover` do; balls that leave points out
  /// grow until they hold them. Balls of radius 0 hold no triangle. Errors: kUsage (the mesh is that of the outside; no
  /// ball with a positive radius; more than 2^24 balls; names a ball with a number that is out of range), kInvalidMesh
  /// (a longest side below 1e-60, a coordinate above 1e60), kOutOfMemory.
  static Result<CoverFollower> create(const IndexedMesh& rest, std::span<const Ball> balls,
                                      const CoverFollowerOptions& options = {});
  CoverFollower(CoverFollower&&) noexcept;
  CoverFollower& operator=(CoverFollower&&) noexcept;
  ~CoverFollower();

  /// A frame: the positions of the vertices of IndexedMesh::view(). Triangles may cross, lose their area or turn over;
  /// what is covered then are the points with a winding number other than 0. Errors: kInvalidMesh (another number of
  /// vertices, a coordinate of a triangle that is not finite, a size beyond the limits of create(): nothing has
  /// changed), kOutOfMemory (balls() are those of the frame before; the next update() or reset() continues, and must
  /// come before measure() or tighten()).
  Status update(std::span<const Point> vertices);
  /// Returns to the rest pose, and to the division of its boundary among the balls that create() has made. Error:
  /// kOutOfMemory.
  Status reset();
  /// Divides the boundary of the present frame among the balls anew, so that they become smaller, and lets later frames
  /// be computed from it instead of from the rest pose. It begins with the balls of this frame or, if their union is
  /// smaller, with those that the division of create() gives them here. So the cover is no larger than it was, nor
  /// than that of a follower without any tighten(), whatever the frames before were; it is larger only where otherwise
  /// the solid would not be proved to be covered. The division of a frame that is flat or where parts cross makes later
  /// covers large, until the next tighten() or reset(). Takes the time of some twenty frames. Error: kOutOfMemory
  /// (nothing has changed).
  Status tighten();

  /// The balls of the present frame, in the order in which they were given; those that are not needed have the radius
  /// 0. The span stays valid, and update(), reset() and tighten() change its elements.
  std::span<const Ball> balls() const;
  CoverState state() const;
  /// Of the present frame; takes the time of measure_ball_union(). Errors: those of that call.
  Result<CoverFollowMeasures> measure() const;

 private:
  friend struct Internals;
  class Impl;
  explicit CoverFollower(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
