// The record of a run of `medial-vk follow`: balls that followed a mesh through frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/follower.h"
#include "medial_vk/mesh.h"
#include "medial_vk/sphere_measures.h"
#include "outside_samples/outside_samples.h"

namespace medial_vk {

/// What files say of a ball that is part of a cover.
enum class CoverBallState : std::uint8_t {
  kSteady,  ///< None of the others.
  kGrown,   ///< Its radius is more than a given multiple of that in the rest pose.
  kUnused,  ///< The cover of this frame does without it: radius 0.
};

/// What a frame of a cover has in the place of the numbers of balls inside.
struct CoveredFrame {
  CoverState proved = CoverState::kSurface;
  std::vector<CoverBallState> states;
  CoverFollowMeasures measures;
  std::optional<double> reach_out_bound;  ///< No ball reaches out of the solid by more; empty: not measured.

  /// Per cent of the solid's volume: that of the balls outside of it; NaN if that is not known.
  double added_percent() const;
};

/// Balls and numbers of one frame, in mesh units.
struct FollowedFrame {
  std::string name;                   ///< "rest", a file, or the time in seconds.
  std::string short_name;             ///< The same, but a file without its folder and its extension.
  double time = 0;                    ///< Seconds since the rest pose.
  std::vector<Ball> balls;            ///< Radius 0: lost in this frame, or of a cover that does without it.
  std::optional<CoveredFrame> cover;  ///< With MotionRecord::covers, instead of the next five.
  std::vector<FollowState> states;
  std::vector<FollowOrigin> origins;  ///< Empty unless balls may be chosen anew (MotionRecord::renews).
  FollowMeasures measures;
  /// Of the balls' volume outside the solid, which FollowMeasures::outside_bound limits; empty: not estimated.
  std::optional<OutsideEstimate> outside;
  std::optional<Bounds> gap;  ///< The greatest distance from points of the boundary to the balls.
  bool is_mirrored = false;   ///< The mesh is closed, and its signed volume is negative.
  /// Of the vertices of the prepared mesh, if a picture or a page shows the frame; else empty.
  std::vector<std::array<float, 3>> vertices;

  /// Per cent of the solid's volume that no ball holds (FollowMeasures::uncovered()); NaN if the volume is not known.
  double uncovered_percent() const;
  /// The same, or of a cover CoveredFrame::added_percent().
  double error_percent() const { return cover ? cover->added_percent() : uncovered_percent(); }
  /// The volume of the solid; NaN if it is not known.
  double solid_volume() const { return cover ? cover->measures.solid_volume : measures.solid_volume; }
  void forget_solid_volume();
  /// The number of balls that were chosen anew in this frame.
  std::size_t renewed() const;
};

struct MotionRecord {
  std::string version;  ///< Of the program.
  std::string name;     ///< Of the rest mesh.
  std::string rule;     ///< "tangent" or "published", of balls inside; "cover".
  bool covers = false;  ///< The balls cover each frame.
  double frames_per_second = 0;
  /// The mesh at rest is closed, and no faces cross or lie inside: its signed volume is that of the solid. Otherwise no
  /// volume of a solid is written, nor of a frame whose solid_volume() is NaN.
  bool has_volume = false;
  bool estimates_outside = false;     ///< Balls may reach out of the solid: files say how much does, by samples.
  bool renews = false;                ///< Balls may be chosen anew in a frame: files say where.
  std::vector<Triangle> triangles;    ///< Of the prepared mesh.
  std::vector<FollowedFrame> frames;  ///< The rest pose first. All have the same number of balls.
};

/// The states that balls of the record can have, as in files, by their numbers there. Balls of the last one are not
/// there: their radius is 0.
std::span<const char* const> state_names(const MotionRecord& record);
/// The number of the state of each ball.
std::vector<std::uint8_t> state_numbers(const FollowedFrame& frame);
/// The number of balls in each state.
std::vector<std::size_t> state_counts(const MotionRecord& record, const FollowedFrame& frame);

}  // namespace medial_vk
