// Counts and times of extractions and fits, for measurements; results do not depend on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace medial_vk {

struct MeasurementOptions {
  /// Certified: ExtractionMeasurements::device_times by kernel and level ("mark_contacts@2"; a number after a slash
  /// distinguishes variants of a kernel, "/second" the tasks of one that has two) instead of by stage. In that case
  /// every dispatch ends with a timestamp.
  bool kernel_times = false;

  bool operator==(const MeasurementOptions&) const = default;
};

/// The numbers of voxels by outcome, and the amounts of work. Counts do not depend on the machine.
struct ExtractionCounters {
  struct Level {
    double cell_size = 0;        ///< As a fraction of the longest side.
    std::uint64_t visited = 0;   ///< Cells examined.
    std::uint64_t kept = 0;      ///< Cells that could not be dismissed.
    std::uint64_t contacts = 0;  ///< Total length of the contact lists of the kept cells.
    std::uint64_t found = 0;     ///< Voxels whose point was found at this level (finest level and below).
    std::uint64_t lines = 0;     ///< Certified on a device: lines narrowed, by narrowing_steps steps each.
    /// On a device: distances evaluated between points and triangles of contact lists, for dismissal, lines and flux
    /// (without the features of pairs), plus the triangles in the leaves that walks of the tree reach (for winding
    /// numbers, the solid angles evaluated).
    std::uint64_t triangle_tests = 0;
    /// Certified on a device: distances evaluated between points and clusters of triangles, at levels with large cells;
    /// `contacts` counts clusters there.
    std::uint64_t cluster_tests = 0;
    /// On a device: boxes, or moments, of the tree that walks have tested. A packet counts a box once for the test
    /// against the ball around its points and, if the two meet, once more for the tests against the points. Empty slots
    /// of wide nodes count, too.
    std::uint64_t node_tests = 0;
  };
  std::vector<Level> levels;
  std::uint64_t found = 0;            ///< Finest voxels with a point.
  std::uint64_t undecided = 0;        ///< Finest voxels with neither a point nor a proof after the last level.
  std::uint64_t proved_empty = 0;     ///< Finest voxels visited and dismissed, as a whole or in all their parts.
  std::uint64_t queries = 0;          ///< Closest-point queries (contact lists and trees).
  std::uint32_t narrowing_steps = 0;  ///< Certified on a device: of every line, nine parts a step.
  std::uint64_t retries = 0;  ///< Chunks run again: in smaller chunks since a buffer was full, or for longer lists.
};

/// Seconds of one stage.
struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// Measurements of one extraction, and of a call that processes its result.
struct ExtractionMeasurements {
  ExtractionCounters counters;
  std::vector<StageTime> device_times;  ///< By timestamps on the device, empty if it has none.
  /// Wall-clock seconds of the steps of a call with several, in their order: extract_and_certify() has "extract" and
  /// "certify", analyse() also "sheets", "volumes" and "medial mesh", as far as they ran. Empty for an extraction
  /// alone.
  std::vector<StageTime> host_times;
};

/// Measurements of the fit of one part.
struct FitMeasurements {
  /// Wall-clock time, without the distribution of balls among parts. Parts that are fitted side by side share the
  /// cores, and wait for each other's extractions.
  double seconds = 0;
};

}  // namespace medial_vk
