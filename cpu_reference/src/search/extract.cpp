#include "cpu_reference/extract.h"

#include <cmath>

#include "search/modes.h"

namespace medial_vk::reference {

using Eigen::Vector3i;

Result extract(const Mesh& mesh, const Options& options, const std::function<bool(double)>& progress,
               const std::function<void(const TimeEstimate&)>& on_estimate) {
  const Tree tree(mesh);
  const Grid grid(tree, options.resolution);
  Result result;
  result.grid_origin = grid.origin;
  result.voxel_size = grid.voxel_size;
  result.grid_size = grid.size;
  const int levels = grid.levels + (options.certified ? options.extra_levels : 0);
  for (int level = 0; level < levels; ++level) {
    result.levels.push_back({std::ldexp(grid.cell_size(0), -level), 0, 0, 0, 0});
  }
  const Vector3i n = grid.top_cells();
  const double voxels_of_cell = std::ldexp(1.0, 3 * (grid.levels - 1));
  Watch watch(progress, n.cast<double>().prod() * voxels_of_cell);
  const CellLoop loop = [&](const std::function<void(const Vector3i&)>& visit) {
    double done = 0;
    for (int z = 0; z < n.z(); ++z) {
      for (int y = 0; y < n.y(); ++y) {
        for (int x = 0; x < n.x(); ++x) {
          visit({x, y, z});
          watch.set(++done * voxels_of_cell);  // the cell may reach beyond the grid
          result.interrupted = watch.stops();
          if (result.interrupted) return;
        }
      }
    }
  };
  if (options.certified)
    extract_certified(mesh, tree, grid, options, loop, watch, on_estimate, result);
  else
    extract_thesis(mesh, tree, grid, options, loop, result);
  sort_by_voxel(result.spheres);
  sort_by_voxel(result.undecided_voxels);
  return result;
}

}  // namespace medial_vk::reference
