// The whole analysis of a mesh as one call: medial spheres with their certificate, and whatever else is requested of
// sheets, volumes, removal of sheets and the medial mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "medial_vk/certify.h"
#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/medial_mesh.h"
#include "medial_vk/sheets.h"

namespace medial_vk {

/// What to find. What is not requested is not computed.
struct AnalysisOptions {
  ExtractionOptions extraction;
  /// Group the spheres into sheets; without options they are not grouped. `volumes`, `keep_volume`,
  /// `removal_orders` and `medial_mesh` need sheets: kUsage without.
  std::optional<SheetOptions> sheets = SheetOptions();
  bool simplify = false;  ///< Leave out spheres whose centre is within epsilon of another one's (2.4.2).
  /// Measure the union of the balls, and with it the significance of sheets (6.1).
  bool volumes = false;
  /// Sheets are removed, the least significant first, as long as the others hold at least this share of the volume
  /// (6.3); 0: none is removed.
  double keep_volume = 0;
  bool keep_topology = false;   ///< Of `keep_volume`: remove no sheet that changes the topology of the union (6.4.1).
  bool removal_orders = false;  ///< Find the orders of removal by both rules, to their ends.
  bool medial_mesh = false;     ///< Join the points to a surface with the topology of the union.
  /// Threads of the host for every step, 0: one per core; those of the options above are not read. No result depends
  /// on it.
  unsigned threads = 0;
};

/// What analyse() finds, in the units of the mesh.
struct Analysis {
  VoxelGrid grid;
  std::vector<MedialSphere> spheres;      ///< Certified, in voxel order, with their sheets.
  std::vector<UndecidedVoxel> undecided;  ///< Mode certified, in voxel order.
  CertificateReport certificate;
  std::uint64_t simplified = 0;  ///< Spheres left out by `simplify`.

  /// Of the spheres; sheets that were removed keep their numbers and have no sphere left.
  Sheets sheets;
  std::optional<Significance> significance;      ///< Of the union before removal; `of_ball` and `areas` of `spheres`.
  std::optional<SheetRemoval> by_significance;   ///< Order of removal by RemovalRule::kSignificance.
  std::optional<SheetRemoval> keeping_topology;  ///< By RemovalRule::kTopology.
  std::optional<SheetRemoval> removal;           ///< The beginning of one of them that `keep_volume` removed.
  std::optional<MedialMesh> medial_mesh;
  std::optional<std::int64_t> euler_characteristic;  ///< Of the solid, with a medial mesh, if the mesh is closed.

  std::vector<StageTime> host_times;  ///< "extract", "certify", "sheets", "volumes", "medial mesh": those that ran.
  ExtractionMeasurements measurements;
};

/// Analyses a mesh with the medial spheres that `extractor` finds. `progress` is called with the stages "extract",
/// "certify", "simplify", "volume", "sheets", "topology" and "medial mesh" and the share of each that is done; `stop`
/// ends the call soon, from any thread, the callback included. Does not throw. Errors: kUsage (an option out of range),
/// kInvalidMesh, kOutOfMemory, kInterrupted, kInternal.
Result<Analysis> analyse(const IndexedMesh& mesh, const AnalysisOptions& options, const Extractor& extractor,
                         const StageProgress& progress = {}, const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<Analysis> analyse(const IndexedMesh& mesh, const AnalysisOptions& options, Context& context,
                         const StageProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
