#include "output/plane_files/plane_record.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace medial_vk {

std::vector<std::vector<std::uint32_t>> rings_of(const PreparedShape& shape) {
  std::vector<std::size_t> first(shape.points.size() + 1);
  for (const auto& [begin, end] : shape.segments) ++first[begin + 1];
  for (std::size_t i = 0; i < shape.points.size(); ++i) first[i + 1] += first[i];
  std::vector<std::uint32_t> ends(shape.segments.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (const auto& [begin, end] : shape.segments) ends[next[begin]++] = end;
  next.assign(first.begin(), first.end() - 1);
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::uint32_t start = 0; start < shape.points.size(); ++start) {
    while (next[start] < first[start + 1]) {
      std::vector<std::uint32_t> ring;
      // As many segments end in a point as begin there, so the walk returns to its start.
      for (std::uint32_t at = start; next[at] < first[at + 1];) {
        ring.push_back(at);
        at = ends[next[at]++];
        if (at == start) break;
      }
      rings.push_back(std::move(ring));
    }
  }
  return rings;
}

std::array<PlanePoint, 2> bounds_of(const PlaneRecord& record) {
  std::array<PlanePoint, 2> box = {record.shape.report.lower, record.shape.report.upper};
  const auto include = [&](const PlanePoint& p) {
    for (std::size_t k = 0; k < 2; ++k) {
      box[0][k] = std::min(box[0][k], p[k]);
      box[1][k] = std::max(box[1][k], p[k]);
    }
  };
  for (const auto& line : record.lines) {
    for (const AxisSample& sample : line) include(sample.point);
  }
  return box;
}

std::pair<double, double> colour_range(const PlaneRecord& record) {
  if (record.colour == PlaneColour::kAngle) return {record.options.object_angle, std::numbers::pi / 2};
  const PlaneCounts counts = counts_of(record);
  return {0, counts.greatest_radius};
}

const char* name_of(AxisNodeKind kind) {
  switch (kind) {
    case AxisNodeKind::kMeeting:
      return "meeting";
    case AxisNodeKind::kCorner:
      return "corner";
    case AxisNodeKind::kThreshold:
      return "threshold";
    case AxisNodeKind::kBorder:
      break;
  }
  return "border";
}

const char* name_of(PlaneSide side) {
  if (side == PlaneSide::kInside) return "inside";
  return side == PlaneSide::kOutside ? "outside" : "both";
}

const char* name_of(FillRule rule) { return rule == FillRule::kNonZero ? "nonzero" : "evenodd"; }

PlaneCounts counts_of(const PlaneRecord& record) {
  PlaneCounts counts;
  counts.branches = record.axis.branches.size();
  counts.junctions = record.axis.junctions();
  counts.ends = static_cast<std::uint64_t>(
      std::ranges::count_if(record.axis.nodes, [](const AxisNode& node) { return node.degree == 1; }));
  counts.points = static_cast<std::uint64_t>(
      std::ranges::count_if(record.axis.nodes, [](const AxisNode& node) { return node.degree == 0; }));
  counts.least_radius = std::numeric_limits<double>::infinity();
  const auto include = [&](double radius) {
    counts.least_radius = std::min(counts.least_radius, radius);
    counts.greatest_radius = std::max(counts.greatest_radius, radius);
  };
  for (const AxisBranch& branch : record.axis.branches) counts.length += branch.length;
  for (const auto& line : record.lines) {
    for (const AxisSample& sample : line) include(sample.radius);
  }
  for (const AxisNode& node : record.axis.nodes) include(node.radius);
  if (record.axis.nodes.empty()) counts.least_radius = 0;
  return counts;
}

}  // namespace medial_vk
