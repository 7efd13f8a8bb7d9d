// Pairs of solids in poses, by seed, and whether all intervals and verdicts of the library agree with the reference.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/pose.h"
#include "support/distances/distance_solids.h"

namespace medial_vk::test {

enum class PoseKind : std::uint8_t {
  kFar,          ///< By 10 to 10^6 sizes.
  kApart,        ///< By up to three sizes; some overlap.
  kOverlapping,  ///< The middles are within half a size.
  kTouching,     ///< At a random contact, up to rounding or a gap or an overlap of any size.
  kNested,       ///< The middle of a small solid is somewhere in the box of a larger one.
  kEqual,        ///< A solid and itself, turned onto itself, nearly so, or not at all.
  kAligned,      ///< Turned by right angles, with faces of the boxes in common planes.
  kUneven,       ///< With a rotation that is one only to within 1e-12.
  kDegenerate,   ///< One mesh is open, has slivers or faults; any of the poses above.
};
constexpr std::size_t kPoseKinds = 9;
constexpr std::array<const char*, kPoseKinds> kPoseKindNames = {
    "far", "apart", "overlapping", "touching", "nested", "equal", "aligned", "uneven rotation", "degenerate mesh"};

struct DistanceCase {
  PoseKind kind;
  const DistanceSolid* a;
  const DistanceSolid* b;
  Pose pose;
};

/// Seeds select all kinds in turn.
DistanceCase make_distance_case(std::span<const DistanceSolid> solids, std::uint64_t seed);

struct CaseOutcome {
  std::vector<std::string> faults;              ///< Sentences; empty without a fault.
  Collision collision = Collision::kUndecided;  ///< By the reference; undecided: it may be a touch.
  Collision found = Collision::kUndecided;      ///< By distance().
  /// How far the reference's distance lies out of an interval of distance(), at most, and the width of the interval
  /// without a tolerance, in units of the rounding error of positions: 2^-53 of the sum of both reaches and the shift.
  double excess = 0, width = 0;
};

/// Asks for everything that the library says about the distance of two bodies: distance() without and with a start, a
/// tolerance, a limit and of surfaces; bounds by balls, at once, from a start and in steps; and the verdicts.
CaseOutcome check_distance_case(const DistanceCase& distance_case, std::uint64_t seed);

}  // namespace medial_vk::test
