// What a run of the main command measures on the boundary, and the files that hold it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "boundary_fields/summaries.h"
#include "cli/options/options.h"
#include "cli/terminal/progress.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/measurements.h"
#include "medial_vk/medial_spheres.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {

struct MeasuredBoundary {
  std::optional<Mesh> refined;  ///< Of --boundary-edge.
  BoundaryFields fields;        ///< At the vertices of surface().
  std::vector<Point> samples;   ///< Of --thickness-points: they stand for equal parts of the area.
  BoundaryFields of_samples;    ///< Thickness there.
  BoundaryRecord record;

  const Mesh& surface(const IndexedMesh& mesh) const { return refined ? *refined : mesh.prepared().mesh; }
};

/// Measures what the outputs need, and nothing else; appends the seconds of each measure to `times`. `voxel_size` is
/// the distance of neighbouring spheres. Errors: those of the library.
Result<MeasuredBoundary> measure_boundary(const IndexedMesh& mesh, std::span<const MedialSphere> spheres,
                                          double voxel_size, const Options& options, Progress& progress,
                                          std::vector<StageTime>& times);

/// Appends --boundary, --thickness-points and --thickness-histogram. Errors: kCannotWrite (too large for its format).
Status encode_boundary_files(const IndexedMesh& mesh, const MeasuredBoundary& measured, const Options& options,
                             std::vector<OutputFile>& files);

}  // namespace medial_vk::cli
