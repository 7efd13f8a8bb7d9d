// Balls inside a solid that follow its boundary as the vertices of the mesh move (S. Stolpner, "Medial Spheres for
// Shape Representation", 2011, Section 7.4; docs/theory.md, "Balls that follow a surface").
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

enum class FollowRule : std::uint8_t {
  /// Balls keep two contacts, and are inside in every frame, or lost.
  kTangent,
  /// As in Section 7.4.1: one contact, interpolated normals, and balls that reach out a little (Algorithm 5).
  /// Each frame is computed from the rest pose.
  kPublished,
};

struct FollowerOptions {
  FollowRule rule = FollowRule::kTangent;
  /// kTangent: the number of steps that every ball takes towards a greater volume of the union in every frame. Each
  /// step takes the time of one measure_ball_union() and about two queries per ball. With 0, frames are several times
  /// faster, and errors add up: after a twist by 60 degrees a third more is uncovered than with 1, of a tube twice as
  /// much.
  std::uint32_t steps = 1;
  /// kPublished: the distance (xi) by which a ball may reach out, as a share of the longest side in the rest pose;
  /// positive. The source has 0.25 %.
  double protrusion = 0.0025;
  /// A ball whose radius is below this share of its radius in the rest pose, or in the frame in which it was chosen
  /// anew, counts as shrunk.
  double shrunk = 0.5;
  /// A ball whose object angle, in radians, is below this counts as no longer medial.
  double object_angle = 0.5;
  /// kTangent, for closed meshes: the greatest number of balls that are chosen anew in a frame. Such a ball leaves its
  /// place for one at a gap between the surface and the balls, if the union grows by that and the widest gap does not.
  /// A frame in which this is tried takes the time of some fifteen measure_ball_union(); any other frame takes next to
  /// no time for it with a step, and that of one measure_ball_union() without.
  std::uint32_t renewed = 0;
  /// It is tried in the regions of the surface whose uncovered share of the solid's volume, by an estimate, is more
  /// than this many times that in the rest pose, once they have grown by a twentieth of all that is uncovered there;
  /// and everywhere, where that of the whole solid is (by FollowMeasures); from 1 up.
  double renewal_factor = 1.5;
  /// Of the host, 0: one per core; of those, a follower keeps as many as its balls give work to. The result does not
  /// depend on it.
  unsigned threads = 0;

  bool operator==(const FollowerOptions&) const = default;
};

enum class FollowState : std::uint8_t {
  kMedial,  ///< None of the others.
  kFlat,    ///< The two contacts that are followed have a small object angle. kTangent only.
  kShrunk,  ///< Its radius is a small share of that in the rest pose, or of that with which it was chosen anew.
  /// Lost in this frame, with radius 0: no ball of 2^-30 of the longest side or more is known to be inside at its
  /// contacts. It may return in a later frame.
  kLost,
};

/// Where a ball of the present frame comes from.
enum class FollowOrigin : std::uint8_t {
  kFollowed,  ///< From the ball of the frame before, or from that of the rest pose.
  kRenewed,   ///< It was chosen anew in this frame (FollowerOptions::renewed).
  kReturned,  ///< It was chosen anew in an earlier frame, and is at its place of the rest pose again.
};

/// Numbers of a frame, in mesh units.
struct FollowMeasures {
  /// Of the mesh, by its triangles: that of the solid if no triangles cross. In a mirrored frame, too, it is positive.
  /// NaN if it is known not to be that of the solid: the mesh is not closed, or the frame is flat, or folded or turned
  /// over in parts such that less volume remains than the balls inside have.
  double solid_volume = 0;
  double ball_volume = 0;  ///< Of the union of the balls; exact.
  /// An upper bound of the volume of the balls outside the solid: vol(U) - vol(U^xi) of Lemma 7.3; kTangent: 0.
  double outside_bound = 0;

  /// NaN where solid_volume is. kTangent: the volume of the solid in no ball. kPublished: less than that, by the volume
  /// of the balls outside; Lemma 7.3 bounds the volume error by uncovered() + 2 outside_bound.
  double uncovered() const { return solid_volume - ball_volume; }
};

/// A set of balls that is updated for every frame of a motion. Objects are independent of each other.
class Follower {
 public:
  /// The balls lie inside the solid in the rest pose, up to a millionth of the longest side, as medial spheres and fits
  /// with contract `inside` do. kTangent: each of them grows along its spoke until it touches the boundary a second
  /// time; the result holds the given ball up to 1e-10 of the longest side, if that was inside. Errors: kUsage (the
  /// outside; no ball; an option out of range; `renewed` of a mesh that is not closed or by kPublished; names a ball
  /// that is not inside), kInvalidMesh (a longest side below 1e-60, a coordinate above 1e60), kOutOfMemory.
  static Result<Follower> create(const IndexedMesh& rest, std::span<const Ball> balls,
                                 const FollowerOptions& options = {});
  Follower(Follower&&) noexcept;
  Follower& operator=(Follower&&) noexcept;
  ~Follower();

  /// The next frame: the positions of the vertices of IndexedMesh::view(), in any number and order of frames. kTangent:
  /// the result depends on the frames before, and the interior of every ball lies inside the boundary of the frame, in
  /// exact arithmetic. Triangles without an area and triangles that cross are permitted; the inside of a closed mesh is
  /// the set of points with a positive winding number. A frame of a closed mesh whose signed volume is negative counts
  /// as mirrored: its inside has negative winding numbers. The inside of a mesh that is not closed has winding numbers
  /// of 1/2 and more; it takes several times as long, and its balls are lost in mirrored frames. Errors: kInvalidMesh
  /// (another number of vertices, a coordinate of a triangle that is not finite, a size beyond the limits of create():
  /// nothing has changed), kOutOfMemory (balls() are those of the frame before; the next update() or reset()
  /// continues).
  Status update(std::span<const Point> vertices);
  /// Returns to the rest pose, as if no frame had been seen: update() then does not depend on earlier frames. Error:
  /// kOutOfMemory.
  Status reset();

  /// The balls of the present frame, in the order in which they were given. The spans stay valid, and update() and
  /// reset() change their elements.
  std::span<const Ball> balls() const;
  std::span<const FollowState> states() const;
  std::span<const FollowOrigin> origins() const;
  /// Of the present frame; takes the time of measure_ball_union(), or of two. Errors: those of that call.
  Result<FollowMeasures> measure() const;

 private:
  friend struct Internals;
  class Impl;
  explicit Follower(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
