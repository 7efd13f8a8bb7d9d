// The data of one finished run, for the summary and the report.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boundary_fields/summaries.h"
#include "check_reports/check_report.h"
#include "common/backend.h"
#include "medial_vk/analysis.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/fatness.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/medial_mesh.h"
#include "medial_vk/result.h"
#include "medial_vk/sheets.h"
#include "medial_vk/significance.h"

namespace medial_vk {

struct Range {
  double least = 0;
  double greatest = 0;
};

/// The range of the radii; none without spheres.
std::optional<Range> range_of_radii(std::span<const MedialSphere> spheres);
/// The range of the object angles, in radians; none without spheres.
std::optional<Range> range_of_object_angles(std::span<const MedialSphere> spheres);

/// The union of the balls, before sheets were removed.
struct UnionRecord {
  double volume = 0;
  double area = 0;
  BettiNumbers topology;
  std::uint64_t leading_components = 0;  ///< The fewest that hold kLeadingShare of the volume.
};

constexpr double kLeadingShare = 0.999;

/// For which voxels and object angles the solid is fat (Section 8.3).
struct FatnessRecord {
  std::vector<Fatness> of_angles;  ///< By the points that are written; the first angle is that of the extraction.
  /// No medial point with the object angle of the extraction has a lesser radius; 0: none is proved.
  double proved_radius = 0;
};

/// What was found on one side of the mesh.
struct SideRecord {
  MeshSide side = MeshSide::kInside;
  std::uint64_t points = 0;     ///< Written, as the sheets and their area (in squared units of the mesh).
  std::uint64_t undecided = 0;  ///< Voxels.
  std::size_t sheets = 0;
  double area = 0;
  std::optional<Range> radii = {};
  std::optional<Range> object_angles = {};
  std::optional<double> union_volume = {};  ///< Of its balls, before sheets were removed; none if not computed.
};

/// Of --side: where medial points were sought.
struct SearchRecord {
  bool inside = true, outside = false;
  double margin = 0;  ///< In the units of the mesh.
  Point lower = {0, 0, 0}, upper = {0, 0, 0};
  double longest_side = 0;             ///< Of that box: the unit of the fractions among the options.
  std::uint64_t inside_points = 0;     ///< Of those that are written: they come first.
  std::size_t inside_sheets = 0;       ///< As `inside_points`.
  std::vector<SideRecord> sides = {};  ///< Those that were searched, if the outside is among them.
};

struct RunRecord {
  std::string input;
  std::string part;  ///< The mesh of `input`, by its name in file names; empty: all of it.
  std::string output;
  ExtractionOptions options;
  Backend backend = Backend::kVulkan;
  std::uint64_t seed = 0;
  double perturb = 0;  ///< Amplitude as a fraction of the longest side; 0: off.
  bool simplify = false;
  bool keep_inner_faces = false;

  MeshReport mesh;
  double longest_side = 0;  ///< Of the mesh.
  SearchRecord search;
  VoxelGrid grid;
  ExtractionCounters counters;
  std::vector<UndecidedVoxel> undecided;
  CertificateReport certify;
  std::uint64_t points = 0;      ///< Written.
  std::uint64_t simplified = 0;  ///< Removed by --simplify.
  std::optional<Range> radii;
  std::optional<Range> object_angles;

  SheetOptions sheet_options;
  Sheets sheets;
  /// Of the balls inside, or of those outside if no others were sought; none if no output depends on volumes.
  std::optional<UnionRecord> ball_union;
  std::optional<UnionRecord> outside_union;      ///< Of --side both.
  std::optional<FatnessRecord> fatness;          ///< None without a report; of the inside alone.
  std::optional<SheetRemoval> by_significance;   ///< Of --keep-volume and --sheet-curve.
  std::optional<SheetRemoval> keeping_topology;  ///< Of --keep-topology and --sheet-curve.
  double orders_end_at = 0;                      ///< Share of the volume at which both orders end.
  std::optional<SheetRemoval> removal;           ///< Of --keep-volume: the first part of one of them.
  double keep_volume = 0;
  bool keep_topology = false;
  std::optional<MedialTopology> medial_mesh;         ///< Of --medial-mesh.
  std::optional<std::int64_t> euler_characteristic;  ///< Of the solid, if its mesh is closed.

  BoundaryRecord boundary;  ///< What was measured on the boundary.

  std::vector<StageTime> host_times;    ///< In the order of the run, by wall-clock time.
  std::vector<StageTime> device_times;  ///< By timestamps of the device; part of the host's "extract".
  std::optional<DeviceDescription> device;
  std::string picture_drawn_by;      ///< Empty: no picture was drawn.
  std::optional<CheckReport> check;  ///< Of --check.
};

/// Takes the results of an analysis into the record of its run. Options, volumes, times and the medial mesh, which the
/// tool records in steps of their own, are left to the caller.
void record_analysis(const Analysis& analysis, RunRecord& record);

/// Measures fatness by the points inside that are written, `spheres`, and records it. The record has options, mesh and
/// the results of the analysis already. Errors: kOutOfMemory.
Status record_fatness(std::span<const MedialSphere> spheres, unsigned threads, RunRecord& record);

/// Of the union of the balls of one side.
UnionRecord record_union(const Significance& significance);

}  // namespace medial_vk
