#include "native/medial_dicts.h"

#include <limits>

#include "native/arrays.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

const char* kind_name(UndecidedKind kind) {
  switch (kind) {
    case UndecidedKind::kNearFace:
      return "near face";
    case UndecidedKind::kNearAngle:
      return "near angle";
    case UndecidedKind::kBoundary:
      return "boundary";
    case UndecidedKind::kOther:
      break;
  }
  return "other";
}

std::uint8_t marked(std::uint8_t marks, PointMark mark) { return (marks & mark) != 0 ? 1 : 0; }

}  // namespace

py::dict spheres_dict(const std::vector<MedialSphere>& spheres) {
  py::dict out;
  out["centres"] = column(spheres, [](const MedialSphere& sphere) { return sphere.centre; });
  out["radii"] = column(spheres, [](const MedialSphere& sphere) { return sphere.radius; });
  out["spokes_a"] = column(spheres, [](const MedialSphere& sphere) { return sphere.spoke_a; });
  out["spokes_b"] = column(spheres, [](const MedialSphere& sphere) { return sphere.spoke_b; });
  out["object_angles"] = column(spheres, [](const MedialSphere& sphere) { return sphere.object_angle; });
  out["flux"] = column(spheres, [](const MedialSphere& sphere) { return sphere.flux; });
  out["sheets"] = column(spheres, [](const MedialSphere& sphere) { return sphere.sheet; });
  out["voxels"] = column(spheres, [](const MedialSphere& sphere) { return sphere.voxel; });
  return out;
}

py::dict undecided_dict(const std::vector<UndecidedVoxel>& undecided) {
  py::list kinds;
  for (const UndecidedVoxel& voxel : undecided) kinds.append(kind_name(voxel.kind));
  py::dict out;
  out["voxels"] = column(undecided, [](const UndecidedVoxel& voxel) { return voxel.voxel; });
  out["kinds"] = std::move(kinds);
  out["widths"] = column(undecided, [](const UndecidedVoxel& voxel) { return voxel.width; });
  return out;
}

py::dict grid_dict(const VoxelGrid& grid) {
  py::dict out;
  out["origin"] = array_of(grid.origin);
  out["voxel_size"] = grid.voxel_size;
  out["size"] = py::make_tuple(grid.size[0], grid.size[1], grid.size[2]);
  return out;
}

py::object sheets_dict(const std::optional<Sheets>& sheets) {
  if (!sheets) return py::none();
  const double none = std::numeric_limits<double>::quiet_NaN();
  py::dict out;
  out["points"] = column(sheets->sheets, [](const Sheet& sheet) { return sheet.points; });
  out["areas"] = column(sheets->sheets, [](const Sheet& sheet) { return sheet.area; });
  out["mean_radii"] = column(sheets->sheets, [](const Sheet& sheet) { return sheet.mean_radius; });
  out["mean_object_angles"] = column(sheets->sheets, [](const Sheet& sheet) { return sheet.mean_object_angle; });
  out["significance"] =
      column(sheets->sheets, [none](const Sheet& sheet) { return sheet.significance.value_or(none); });
  out["is_seam"] = column(sheets->marks, [](std::uint8_t marks) { return marked(marks, kSeam); });
  out["is_small"] = column(sheets->marks, [](std::uint8_t marks) { return marked(marks, kSmall); });
  out["point_areas"] = array_of(std::vector<double>(sheets->areas));
  out["absorbed_points"] = sheets->absorbed_points;
  out["fragments"] = sheets->fragments;
  out["is_rim"] = column(sheets->marks, [](std::uint8_t marks) { return marked(marks, kRim); });
  return out;
}

}  // namespace medial_vk::python
