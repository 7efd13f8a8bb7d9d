// The record of a run of `medial-vk follow`: balls that followed a mesh through frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/follower.h"
#include "medial_vk/mesh.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// Balls and numbers of one frame, in mesh units.
struct FollowedFrame {
  std::string name;         ///< "rest", a file, or the time in seconds.
  double time = 0;          ///< Seconds since the rest pose.
  std::vector<Ball> balls;  ///< Radius 0: lost in this frame.
  std::vector<FollowState> states;
  std::vector<FollowOrigin> origins;  ///< Empty unless balls may be chosen anew (MotionRecord::renews).
  FollowMeasures measures;
  std::optional<Bounds> gap;  ///< The greatest distance from points of the boundary to the balls.
  /// Of the vertices of the prepared mesh, if a picture or a page shows the frame; else empty.
  std::vector<std::array<float, 3>> vertices;

  /// Per cent of the solid's volume that no ball holds (FollowMeasures::uncovered()); NaN without a volume.
  double uncovered_percent() const;
  /// The number of balls that were chosen anew in this frame.
  std::size_t renewed() const;
};

struct MotionRecord {
  std::string version;  ///< Of the program.
  std::string name;     ///< Of the rest mesh.
  std::string rule;     ///< "tangent" or "published".
  double frames_per_second = 0;
  /// The mesh at rest is closed, and no faces cross or lie inside: its signed volume is that of the solid, also in each
  /// frame in which no faces come to cross. Otherwise no volume is written.
  bool has_volume = false;
  bool renews = false;                ///< Balls may be chosen anew in a frame: files say where.
  std::vector<Triangle> triangles;    ///< Of the prepared mesh.
  std::vector<FollowedFrame> frames;  ///< The rest pose first. All have the same number of balls.
};

/// "medial", "flat", "shrunk" or "lost", as in files.
const char* name_of(FollowState state);

}  // namespace medial_vk
