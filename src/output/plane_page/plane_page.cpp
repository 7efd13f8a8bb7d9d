#include "output/plane_page/plane_page.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "medial_vk/version.h"
#include "output/page/page_parts.h"
#include "output/plane_page/embedded_plane.h"
#include "platform/paths.h"

namespace medial_vk {
namespace {

using PlaneNumbers = nlohmann::ordered_json;

PlaneNumbers numbers_of(const PlaneRecord& record, const PlaneCounts& counts) {
  const ShapeReport& shape = record.shape.report;
  PlaneNumbers numbers = PlaneNumbers::array();
  const auto add = [&](const char* name, const PlaneNumbers& value) {
    numbers.push_back(PlaneNumbers::array({name, value}));
  };
  add("segments of the boundary", shape.segments);
  add("area", shape.area);
  add("perimeter", shape.perimeter);
  add("branches", counts.branches);
  add("junctions", counts.junctions);
  add("ends", counts.ends);
  add("length of the axis", counts.length);
  add("least radius", counts.least_radius);
  add("greatest radius", counts.greatest_radius);
  add("object angle at least", record.options.object_angle);
  add("side", name_of(record.options.side));
  add("epsilon", record.axis.epsilon);
  if (record.path) {
    add("width of the path", record.path->width);
    add("length of the path", record.path->length);
  }
  return numbers;
}

std::string plane_json(const PlaneRecord& record, const std::string& name) {
  const auto [lower, upper] = bounds_of(record);
  const PlaneCounts counts = counts_of(record);
  const std::string facts = std::to_string(record.shape.report.segments) + " segments, " + record.format;
  const PlaneNumbers json = {
      {"version", version()},
      {"name", name},
      {"facts", facts},
      {"y_is_down", record.y_is_down},
      {"lower", lower},
      {"upper", upper},
      {"colour", record.colour == PlaneColour::kRadius ? "radius" : "angle"},
      {"ranges",
       {{"radius", PlaneNumbers::array({0, counts.greatest_radius})},
        {"angle", PlaneNumbers::array({record.options.object_angle, std::numbers::pi / 2})}}},
      {"numbers", numbers_of(record, counts)},
  };
  return json.dump(-1, ' ', false, PlaneNumbers::error_handler_t::replace);
}

void write_boundary(std::string& out, const PreparedShape& shape) {
  page::Block points("boundary", shape.segments.size() * 16), counts("rings", 0);
  for (const auto& ring : rings_of(shape)) {
    counts.add(static_cast<std::uint32_t>(ring.size()));
    for (const std::uint32_t i : ring) {
      for (const double x : shape.points[i]) points.add(x);
    }
  }
  points.write(out);
  counts.write(out);
}

void write_axis(std::string& out, const PlaneRecord& record) {
  page::Block samples("samples", 0), counts("lines", 0), nodes("nodes", 0);
  for (const std::vector<AxisSample>& line : record.lines) {
    counts.add(static_cast<std::uint32_t>(line.size()));
    for (const AxisSample& s : line) {
      for (const double x : {s.point[0], s.point[1], s.radius, s.object_angle}) samples.add(x);
    }
  }
  for (const AxisNode& node : record.axis.nodes) {
    if (node.degree == 2) continue;
    for (const double x : {node.point[0], node.point[1], static_cast<double>(node.degree)}) nodes.add(x);
  }
  page::Block path("path", 0);
  if (record.path) {
    for (const PlanePoint& p : record.path->line) {
      for (const double x : p) path.add(x);
    }
  }
  for (const page::Block* block : {&samples, &counts, &nodes, &path}) block->write(out);
}

}  // namespace

std::string encode_plane_page(const PlaneRecord& record) {
  const page::Template page = page::split(page::embedded_plane());
  const std::string name = record.input == "-" ? "stdin" : platform::file_name_of(record.input);
  std::string out;
  out.append(page.before_title).append(page::text_in_html(name)).append(page.before_data);
  page::write_json(out, "plane", plane_json(record, name));
  write_boundary(out, record.shape);
  write_axis(out, record);
  out.append(page.after_data);
  return out;
}

}  // namespace medial_vk
