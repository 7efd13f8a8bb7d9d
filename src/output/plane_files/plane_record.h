// What the files of `medial-vk plane` are made from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/plane_centre_line.h"
#include "medial_vk/plane_roadmap.h"
#include "medial_vk/plane_shape.h"

namespace medial_vk {

enum class PlaneColour : std::uint8_t { kRadius, kAngle };

/// Of `--mode thesis`: the cover of discs, and what it can miss.
struct PublishedCover {
  unsigned samples = 0;  ///< Of each circle.
  std::uint64_t discs = 0, undetermined = 0;
  double missed_angle = 0, missed_radius = 0;  ///< As in PublishedAxis.
};

struct PlaneRecord {
  std::string input;
  std::string format;  ///< "SVG", "slice at z = 0.3".
  FillRule fill_rule = FillRule::kNonZero;
  PreparedShape shape;
  std::vector<std::string> assumptions;  ///< Of the reader, then of the shape.
  PlaneAxisOptions options;
  PlanePruning pruning;
  bool longest_path = false;
  double longest_excess = 0;
  double smooth = 0;
  double step = 0;
  PlaneColour colour = PlaneColour::kRadius;
  std::uint64_t branches_found = 0;            ///< Before any are left out.
  PlaneAxis axis;                              ///< As published: nodes alone.
  std::optional<PublishedCover> published;     ///< If the axis was found as published.
  std::vector<std::vector<AxisSample>> lines;  ///< By branch.
  bool y_is_down = false;
  /// Of curves between sites: their names, and the site of each point and segment of the shape. Empty: of an axis.
  std::vector<std::string> sites;
  std::vector<std::uint32_t> site_of_point, site_of_segment;
  std::optional<PlaneRoadmap> roadmap;
  bool path_was_sought = false;
  std::array<PlanePoint, 2> path_ends = {};
  std::optional<PlanePath> path;
  std::optional<std::array<double, 4>> view_box;  ///< Of an SVG: x, y, width, height.
};

/// The boundary as closed rings of indices of its points, the inside on the left. Where several rings have a common
/// point, which one goes on there is arbitrary.
std::vector<std::vector<std::uint32_t>> rings_of(const PreparedShape& shape);

/// The lower and the upper corner of the shape and the axis.
std::array<PlanePoint, 2> bounds_of(const PlaneRecord& record);

/// The value that the colours of a picture show.
inline double coloured_value(const PlaneRecord& record, const AxisSample& sample) {
  return record.colour == PlaneColour::kRadius ? sample.radius : sample.object_angle;
}
/// The values at the ends of the colours.
std::pair<double, double> colour_range(const PlaneRecord& record);

const char* name_of(AxisNodeKind kind);  ///< "meeting", "corner", "threshold" or "border".
const char* name_of(PlaneSide side);
const char* name_of(FillRule rule);  ///< "nonzero" or "evenodd", as options say.

struct PlaneCounts {
  std::uint64_t branches = 0, junctions = 0, ends = 0;
  std::uint64_t points = 0;  ///< On no branch.
  double length = 0;         ///< Of all branches.
  double least_radius = 0, greatest_radius = 0;
};
PlaneCounts counts_of(const PlaneRecord& record);

}  // namespace medial_vk
