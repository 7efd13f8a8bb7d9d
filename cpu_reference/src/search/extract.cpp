#include "cpu_reference/extract.h"

#include <cmath>

#include "search/modes.h"

namespace medial_vk::reference {

using Eigen::Vector3i;

Result extract(const Mesh& mesh, const Options& options, const std::function<bool(double)>& progress) {
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
  const CellLoop loop = [&](const std::function<void(const Vector3i&)>& visit) {
    const Vector3i n = grid.top_cells();
    const double total = n.cast<double>().prod();
    double done = 0;
    for (int z = 0; z < n.z(); ++z) {
      for (int y = 0; y < n.y(); ++y) {
        for (int x = 0; x < n.x(); ++x) {
          visit({x, y, z});
          if (progress && !progress(++done / total)) {
            result.interrupted = true;
            return;
          }
        }
      }
    }
  };
  (options.certified ? extract_certified : extract_thesis)(mesh, tree, grid, options, loop, result);
  sort_by_voxel(result.spheres);
  sort_by_voxel(result.undecided_voxels);
  return result;
}

}  // namespace medial_vk::reference
