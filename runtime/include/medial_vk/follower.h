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
  /// Balls keep two contacts, and are inside in every frame.
  kTangent,
  /// As in Section 7.4.1: one contact, interpolated normals, and balls that reach out a little (Algorithm 5).
  kPublished,
};

struct FollowerOptions {
  FollowRule rule = FollowRule::kTangent;
  /// kTangent: the number of steps that every ball takes towards a greater volume of the union in every frame. Each
  /// step takes the time of one measure_ball_union() and about two queries per ball.
  std::uint32_t steps = 0;
  /// kPublished: the distance (xi) by which a ball may reach out, as a share of the longest side in the rest pose;
  /// positive. The source has 0.25 %.
  double protrusion = 0.0025;
  /// A ball whose radius is below this share of its radius in the rest pose counts as shrunk.
  double shrunk = 0.5;
  /// A ball whose object angle, in radians, is below this counts as no longer medial.
  double object_angle = 0.5;
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

enum class FollowState : std::uint8_t {
  kMedial,   ///< Tangent on two sides of the medial surface.
  kFlat,     ///< Its object angle is small.
  kShrunk,   ///< Its radius is a small share of that in the rest pose.
  kOutside,  ///< Lost in this frame, with radius 0: no ball at its contacts lies inside. It may return in a later
             ///< frame.
};

/// Numbers of a frame, in mesh units.
struct FollowMeasures {
  /// Of the mesh, by its triangles: that of the solid if they do not cross. In a mirrored frame, too, it is positive.
  double solid_volume = 0;
  double ball_volume = 0;  ///< Of the union of the balls; exact.
  /// An upper bound of the volume of the balls outside the solid: vol(U) - vol(U^xi) of Lemma 7.3; kTangent: 0.
  double outside_bound = 0;

  /// kTangent: the volume of the solid in no ball. kPublished: an estimate, by which Lemma 7.3 bounds the error:
  /// uncovered() + 2 outside_bound.
  double uncovered() const { return solid_volume - ball_volume; }
};

/// A set of balls that is updated for every frame of a motion. Objects are independent of each other.
class Follower {
 public:
  /// The balls lie inside the solid in the rest pose, as medial spheres and fits with contract `inside` do. kTangent:
  /// each of them grows along its spoke until it touches the boundary a second time, so that the result holds the given
  /// balls. Errors: kUsage (no ball; an option out of range; names a ball that is not inside), kInvalidMesh (no
  /// extent), kOutOfMemory.
  static Result<Follower> create(const IndexedMesh& rest, std::span<const Ball> balls,
                                 const FollowerOptions& options = {});
  Follower(Follower&&) noexcept;
  Follower& operator=(Follower&&) noexcept;
  ~Follower();

  /// The next frame: the positions of the vertices of IndexedMesh::view(), in any number and order of frames; the
  /// result depends on the frames before. kTangent: the interior of every ball lies inside the boundary of the frame,
  /// in exact arithmetic. A frame whose signed volume is negative counts as mirrored, with the inside on the other side
  /// of every triangle; triangles without an area and triangles that cross are permitted, where the inside of a closed
  /// mesh is the set of points with a positive winding number. A mesh that is not closed takes several times as long.
  /// Errors: kInvalidMesh (another number of vertices, a coordinate that is not finite, no extent: nothing has
  /// changed), kOutOfMemory.
  Status update(std::span<const Point> vertices);
  /// Returns to the rest pose, as if no frame had been seen: update() then does not depend on earlier frames. Error:
  /// kOutOfMemory.
  Status reset();

  /// The balls of the present frame, in the order in which they were given.
  std::span<const Ball> balls() const;
  std::span<const FollowState> states() const;
  /// Of the present frame; takes the time of measure_ball_union(), or of two. Errors: those of that call.
  Result<FollowMeasures> measure() const;

 private:
  friend struct Internals;
  class Impl;
  explicit Follower(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
