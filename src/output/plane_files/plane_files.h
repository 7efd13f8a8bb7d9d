// The medial axis of a shape in the plane as bytes of files (docs/formats.md, "Axes in the plane").
#pragma once

#include <string>

#include "output/plane_files/plane_record.h"

namespace medial_vk {

/// The whole graph: boundary, nodes, arcs as exact curves, branches with their polylines.
std::string encode_plane_json(const PlaneRecord& record);
/// Branches as LineStrings, junctions and ends as Points.
std::string encode_plane_geojson(const PlaneRecord& record);
/// A line for each point of the polylines.
std::string encode_plane_csv(const PlaneRecord& record);
/// The shape, the axis in colours, and its nodes, in the coordinates of the input.
std::string encode_plane_svg(const PlaneRecord& record);
/// The graph of the roadmap between sites, with the path. Precondition: there is a roadmap.
std::string encode_plane_roadmap_json(const PlaneRecord& record);

}  // namespace medial_vk
