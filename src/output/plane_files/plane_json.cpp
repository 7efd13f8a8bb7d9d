#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/plane_files/plane_files.h"

namespace medial_vk {
namespace {

/// Written piece by piece: a document in memory would be many times the file.
class JsonText {
 public:
  /// "[" item "," item ... "]" of count items, one a line.
  template <class Write>
  void rows(const char* name, std::size_t count, const Write& write) {
    add("  \"{}\": [", name);
    for (std::size_t i = 0; i < count; ++i) {
      add("{}\n    ", i > 0 ? "," : "");
      write(i);
    }
    add("{}]", count > 0 ? "\n  " : "");
  }

  /// "[" item ", " item ... "]" in one line.
  template <class Items, class Write>
  void row(const Items& items, const Write& write) {
    out += '[';
    bool is_first = true;
    for (const auto& item : items) {
      if (!is_first) out += ", ";
      is_first = false;
      write(item);
    }
    out += ']';
  }

  template <class... Arguments>
  void add(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out), text, std::forward<Arguments>(arguments)...);
  }

  std::string out;
};

const char* name_of(PlaneCurve::Kind kind) {
  if (kind == PlaneCurve::Kind::kOfPoints) return "points";
  return kind == PlaneCurve::Kind::kOfSegments ? "segments" : "point_and_segment";
}

void add_contact(JsonText& json, const PlaneContact& contact) {
  json.add("{{\"{}\": {}}}", contact.is_point ? "point" : "segment", contact.index);
}

void add_arc(JsonText& json, const AxisArc& arc) {
  const PlaneCurve& curve = arc.curve;
  json.add("{{\"nodes\": [{}, {}], \"contacts\": [", arc.nodes[0], arc.nodes[1]);
  add_contact(json, arc.contacts[0]);
  json.out += ", ";
  add_contact(json, arc.contacts[1]);
  json.add("], \"kind\": \"{}\", \"t\": [{}, {}], \"origin\": [{}, {}], \"along\": [{}, {}]", name_of(curve.kind),
           arc.t[0], arc.t[1], curve.origin[0], curve.origin[1], curve.along[0], curve.along[1]);
  if (curve.kind == PlaneCurve::Kind::kOfPointAndSegment) json.add(", \"up\": [{}, {}]", curve.up[0], curve.up[1]);
  if (curve.kind == PlaneCurve::Kind::kOfSegments) {
    json.add(", \"radius\": {}, \"slope\": {}, \"object_angle\": {}}}", curve.radius, curve.slope, curve.angle);
  } else {
    json.add(", \"focus\": {}}}", curve.focus);
  }
}

void add_branch(JsonText& json, const PlaneRecord& record, std::size_t b) {
  const AxisBranch& branch = record.axis.branches[b];
  json.add("{{\"ends\": [{}, {}], \"length\": {}, \"significance\": ", branch.ends[0], branch.ends[1], branch.length);
  if (is_end_branch(record.axis, branch)) {
    json.add("{}", significance_of(record.axis, branch));
  } else {
    json.out += "null";
  }
  json.out += ", \"arcs\": ";
  json.row(branch.arcs, [&](std::uint32_t arc) { json.add("{}", arc); });
  json.out += ", \"reversed\": ";
  json.row(branch.reversed, [&](bool reversed) { json.add("{}", reversed); });
  json.out += ", \"line\": ";
  json.row(record.lines[b], [&](const AxisSample& s) {
    json.add("[{}, {}, {}, {}]", s.point[0], s.point[1], s.radius, s.object_angle);
  });
  json.out += '}';
}

/// The site of each point and segment of the shape.
void add_sites(JsonText& json, const PlaneRecord& record) {
  const nlohmann::ordered_json names = record.sites;
  json.out += "  \"sites\": " + names.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + ",\n";
  json.out += "  \"site_of_point\": ";
  json.row(record.site_of_point, [&](std::uint32_t site) { json.add("{}", site); });
  json.out += ",\n  \"site_of_segment\": ";
  json.row(record.site_of_segment, [&](std::uint32_t site) { json.add("{}", site); });
  json.out += ",\n";
}

/// The sites on both sides of a branch: those of its first arc.
std::array<std::uint32_t, 2> sites_of(const PlaneRecord& record, const AxisBranch& branch) {
  std::array<std::uint32_t, 2> sites = {};
  const AxisArc& arc = record.axis.arcs[branch.arcs.front()];
  for (std::size_t i = 0; i < 2; ++i) {
    const PlaneContact& contact = arc.contacts[i];
    sites[i] = (contact.is_point ? record.site_of_point : record.site_of_segment)[contact.index];
  }
  if (sites[0] > sites[1]) std::swap(sites[0], sites[1]);
  return sites;
}

/// With null for what is not finite, as JSON has no such number.
nlohmann::ordered_json head_of(const PlaneRecord& record) {
  const ShapeReport& shape = record.shape.report;
  const PlaneAxisOptions& options = record.options;
  return {{"version", version()},
          {"input", record.input},
          {"format", record.format},
          {"mode", "certified"},
          {"fill", name_of(record.fill_rule)},
          {"y_is_down", record.y_is_down},
          {"shape",
           {{"segments", shape.segments},
            {"area", shape.area},
            {"perimeter", shape.perimeter},
            {"lower", shape.lower},
            {"upper", shape.upper},
            {"tolerance", shape.tolerance}}},
          {"assumptions", record.assumptions},
          {"options",
           {{"side", name_of(options.side)},
            {"object_angle", options.object_angle},
            {"radius", options.radius},
            {"margin", options.margin},
            {"prune_length", record.pruning.length},
            {"prune_significance", record.pruning.significance},
            {"longest_path", record.longest_path},
            {"smooth", record.smooth},
            {"step", record.step}}},
          {"longest_excess", record.longest_excess},
          {"epsilon", record.axis.epsilon}};
}

}  // namespace

std::string encode_plane_json(const PlaneRecord& record) {
  JsonText json;
  json.out = head_of(record).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  json.out.resize(json.out.size() - 2);  // without the end of the object
  json.out += ",\n";
  const PlaneAxis& axis = record.axis;
  json.rows("points", record.shape.points.size(),
            [&](std::size_t i) { json.add("[{}, {}]", record.shape.points[i][0], record.shape.points[i][1]); });
  json.out += ",\n";
  json.rows("segments", record.shape.segments.size(),
            [&](std::size_t i) { json.add("[{}, {}]", record.shape.segments[i][0], record.shape.segments[i][1]); });
  json.out += ",\n";
  if (!record.sites.empty()) add_sites(json, record);
  json.rows("nodes", axis.nodes.size(), [&](std::size_t i) {
    const AxisNode& node = axis.nodes[i];
    json.add(R"({{"point": [{}, {}], "radius": {}, "object_angle": {}, "kind": "{}", "degree": {}}})", node.point[0],
             node.point[1], node.radius, node.object_angle, medial_vk::name_of(node.kind), node.degree);
  });
  json.out += ",\n";
  json.rows("arcs", axis.arcs.size(), [&](std::size_t i) { add_arc(json, axis.arcs[i]); });
  json.out += ",\n";
  json.rows("branches", axis.branches.size(), [&](std::size_t i) { add_branch(json, record, i); });
  json.out += "\n}\n";
  return std::move(json.out);
}

std::string encode_plane_geojson(const PlaneRecord& record) {
  JsonText json;
  json.out = "{\"type\": \"FeatureCollection\",\n";
  const PlaneAxis& axis = record.axis;
  std::vector<std::size_t> points;  // junctions, ends and single points
  for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
    if (axis.nodes[n].degree != 2) points.push_back(n);
  }
  json.rows("features", axis.branches.size() + points.size(), [&](std::size_t i) {
    json.out += R"({"type": "Feature", "geometry": {"type": )";
    if (i >= axis.branches.size()) {
      const AxisNode& node = axis.nodes[points[i - axis.branches.size()]];
      const char* kind = node.degree >= 3 ? "junction" : node.degree == 1 ? "end" : "point";
      json.add(R"("Point", "coordinates": [{}, {}]}}, "properties": {{"kind": "{}", "radius": {}, )", node.point[0],
               node.point[1], kind, node.radius);
      json.add(R"("object_angle": {}, "degree": {}, "node": {}, "reason": "{}"}}}})", node.object_angle, node.degree,
               points[i - axis.branches.size()], medial_vk::name_of(node.kind));
      return;
    }
    const std::vector<AxisSample>& line = record.lines[i];
    json.out += R"("LineString", "coordinates": )";
    json.row(line, [&](const AxisSample& s) { json.add("[{}, {}]", s.point[0], s.point[1]); });
    const AxisBranch& branch = axis.branches[i];
    json.add(R"(}}, "properties": {{"kind": "branch", "branch": {}, "length": {}, "ends": [{}, {}], "radius": )", i,
             branch.length, branch.ends[0], branch.ends[1]);
    json.row(line, [&](const AxisSample& s) { json.add("{}", s.radius); });
    if (!record.sites.empty()) {
      const std::array<std::uint32_t, 2> sites = sites_of(record, branch);
      json.add(", \"sites\": [{}, {}]", sites[0], sites[1]);
    }
    json.out += ", \"object_angle\": ";
    json.row(line, [&](const AxisSample& s) { json.add("{}", s.object_angle); });
    json.out += "}}";
  });
  json.out += "\n}\n";
  return std::move(json.out);
}

std::string encode_plane_csv(const PlaneRecord& record) {
  std::string csv = "x,y,radius,object_angle,branch\n";
  for (std::size_t b = 0; b < record.lines.size(); ++b) {
    for (const AxisSample& s : record.lines[b]) {
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}\n", s.point[0], s.point[1], s.radius, s.object_angle, b);
    }
  }
  for (const AxisNode& node : record.axis.nodes) {  // as the centre of a disc is
    if (node.degree > 0) continue;
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},-1\n", node.point[0], node.point[1], node.radius,
                   node.object_angle);
  }
  return csv;
}

}  // namespace medial_vk
