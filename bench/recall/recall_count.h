// Compares one extraction with independent samples of the medial surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/certify.h"
#include "support/medial_sampler.h"

namespace medial_vk::bench {

/// A sample counts for recall if its object angle is this much above the threshold and its distance from the faces of
/// its voxel is at least this share of the voxel side.
inline constexpr double kClearAngle = 0.05, kClearOfFaces = 0.05;
/// For dismissal every salient sample counts: the device lowers the threshold by this much (docs/theory.md,
/// "Rounding").
inline constexpr double kAngleSlack = 1e-5;

/// The outcomes of the voxels that hold samples.
struct Tally {
  std::uint64_t samples = 0, found = 0, undecided = 0;

  std::uint64_t missed() const { return samples - found; }
  std::uint64_t lost() const { return samples - found - undecided; }  ///< Dismissed, although salient.
  Tally& operator+=(const Tally& other);
};

/// Object angles, in radians: from edge i to edge i + 1.
inline constexpr std::array<double, 5> kAngleEdges = {0.0, 0.65, 0.95, 1.25, 1.6};
inline constexpr std::size_t kAngleBins = kAngleEdges.size() - 1;
/// Radius below (1 + sqrt(3)/2) voxel sides, where the sphere around the voxel may meet the boundary (2.4.3); and
/// above.
enum RadiusClass : std::size_t { kNarrow, kWide, kRadiusClasses };

struct RecallRow {
  std::string mesh;
  Mode mode = Mode::kCertified;
  std::uint32_t resolution = 0;
  double angle = 0;
  std::array<std::array<Tally, kAngleBins>, kRadiusClasses> recall;
  Tally dismissal;
  std::uint64_t points = 0, undecided = 0, visited = 0;  ///< Finest voxels.
  std::array<std::uint64_t, kUndecidedKinds> undecided_by_kind = {};
  /// True if the extraction lists its undecided voxels. If not, a missed sample may be an undecided or a lost one.
  bool undecided_listed = false;
  std::vector<test::MedialSample> first_missed, first_lost;  ///< A few of each, for the log.

  Tally of(RadiusClass radius) const;
};

/// Computes all values that follow from samples and extraction.
RecallRow count_recall(const std::string& mesh, const std::vector<test::MedialSample>& samples,
                       const ExtractionOptions& options, const Extraction& extraction);

}  // namespace medial_vk::bench
