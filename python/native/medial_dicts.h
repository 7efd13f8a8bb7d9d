// Results of searches for medial spheres as dictionaries of arrays, by the names of the fields of the package.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/sheets.h"

namespace medial_vk::python {

pybind11::dict spheres_dict(const std::vector<MedialSphere>& spheres);
pybind11::dict undecided_dict(const std::vector<UndecidedVoxel>& undecided);
pybind11::dict grid_dict(const VoxelGrid& grid);
/// None without sheets.
pybind11::object sheets_dict(const std::optional<Sheets>& sheets);

}  // namespace medial_vk::python
