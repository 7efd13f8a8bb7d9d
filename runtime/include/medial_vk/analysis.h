// The whole analysis of a mesh as one call: medial spheres with their certificate and, on request, sheets, volumes, the
// removal of sheets and the medial mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "medial_vk/certify.h"
#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/measurements.h"
#include "medial_vk/medial_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sheets.h"
#include "medial_vk/significance.h"

namespace medial_vk {

class Context;

/// The parts of an analysis; only those requested are computed.
struct AnalysisOptions {
  ExtractionOptions extraction;
  /// Group the spheres into sheets, with these options. `volumes`, `keep_volume`, `removal_orders` and `medial_mesh`
  /// require sheets: without a value here they cause the error kUsage.
  std::optional<SheetOptions> sheets;
  /// Leave out spheres whose centre lies within epsilon of the centre of another sphere (2.4.2).
  bool simplify = false;
  /// Measure the union of the balls, and with it the significance of sheets (6.1).
  bool volumes = false;
  /// Share of the volume, 0 to 1: sheets are removed, the least significant first, as long as the others hold at least
  /// this share (6.3). 0: no sheet is removed.
  double keep_volume = 0;
  /// With `keep_volume`: keep every sheet whose removal would change the topology of the union (6.4.1).
  bool keep_topology = false;
  bool removal_orders = false;  ///< Find the complete orders of removal by both rules.
  bool medial_mesh = false;     ///< Join the points to a surface with the topology of the union.
  /// Of the host, for every step; 0: one per core, and for work on a context as many as that has. No result depends on
  /// it. `threads` of the options above is 0, or the same number; another one is the error kUsage.
  unsigned threads = 0;
};

/// The results of analyse(), in the units of the mesh.
struct Analysis {
  VoxelGrid grid;
  std::vector<MedialSphere> spheres;      ///< Certified, in voxel order.
  std::vector<UndecidedVoxel> undecided;  ///< Mode certified, in voxel order.
  CertificateReport certificate;
  std::uint64_t simplified = 0;  ///< Spheres left out by `simplify`.

  /// The sheets of `spheres`, on request; removed sheets keep their numbers and have no spheres.
  std::optional<Sheets> sheets;
  /// The significance of balls and sheets in the union before any removal; `of_ball` and `areas` are by index into
  /// `spheres`.
  std::optional<Significance> significance;
  /// The order of removal in which the least significant sheet goes first (6.3).
  std::optional<SheetRemoval> by_significance;
  /// The order in which the least significant sheet goes first, among those without which the union has as many
  /// components, tunnels and cavities as the whole (6.4.1).
  std::optional<SheetRemoval> keeping_topology;
  std::optional<SheetRemoval> removal;  ///< The first part of one of these orders: the sheets removed by `keep_volume`.
  std::optional<MedialMesh> medial_mesh;
  std::optional<std::int64_t> euler_characteristic;  ///< Of the solid, with a medial mesh, if the mesh is closed.

  ExtractionMeasurements measurements;
};

/// Analyses a mesh with the medial spheres that `extractor` finds. `progress` is called with the stages "extract",
/// "certify", "sheets" (simplification and grouping), "volumes" (with the orders of removal) and "medial mesh", as far
/// as they run, and the finished share of each; a request to `stop`, from any thread, the callback included, ends the
/// call within the stages "extract" and "volumes", and at the end of any other. Does not throw. Errors:
/// kUsage (an option out of range), kInvalidMesh, kOutOfMemory, kInterrupted, kInternal.
Result<Analysis> analyse(const IndexedMesh& mesh, const AnalysisOptions& options, const Extractor& extractor,
                         const StageProgress& progress = {}, const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<Analysis> analyse(const IndexedMesh& mesh, const AnalysisOptions& options, Context& context,
                         const StageProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
