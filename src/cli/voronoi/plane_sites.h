#pragma once

#include <stop_token>
#include <vector>

#include "cli/options/voronoi/voronoi_options.h"
#include "medial_vk/measurements.h"
#include "medial_vk/result.h"
#include "output/plane_files/plane_record.h"

namespace medial_vk::cli {

/// Shapes in the plane, each file a site, as what `medial-vk plane` writes: their boundaries together as the shape of
/// the record. Errors: kInvalidMesh (a file that cannot be read, shapes that cross, touch or overlap), kOutOfMemory.
Result<PlaneSites> load_plane_sites(const VoronoiCommandOptions& options, PlaneRecord& record,
                                    std::vector<StageTime>& times);

/// Error: kUsage, if --from or --to is inside of a shape.
Status check_plane_ends(const VoronoiCommandOptions& options, const PreparedShape& shapes);

/// The graph of the curves, and the path between --from and --to. Errors: those of PlaneRoadmap.
Status make_plane_roadmap(const PlaneSites& sites, const VoronoiCommandOptions& options, PlaneRecord& record);

/// Finds the curves between the sites, and makes polylines of them. Errors: those of find_plane_voronoi().
Status find_plane_curves(const PlaneSites& sites, const VoronoiCommandOptions& options,
                         const ProgressCallback& progress, const std::stop_token& stop, PlaneRecord& record);

/// Numbers of the curves, for readers, and as JSON.
std::string plane_sites_summary(const PlaneRecord& record, const std::vector<StageTime>& times, bool verbose);
std::string plane_sites_report(const PlaneRecord& record, const std::vector<StageTime>& times);

}  // namespace medial_vk::cli
