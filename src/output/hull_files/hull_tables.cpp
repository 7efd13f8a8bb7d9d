// Hulls as text with all digits: JSON, CSV, .ma, and OBJ with the meshes of the hulls.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/hull_files/encoders.h"
#include "output/hull_files/hull_files.h"
#include "output/hull_files/inner_shapes.h"

namespace medial_vk {
namespace {

/// The number of the layout, raised when a key changes its meaning.
constexpr int kHullsFormat = 1;

std::string quoted_json(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string number_or_null(const std::optional<double>& number) { return number ? fmt::format("{}", *number) : "null"; }

std::string interval_text(const std::optional<Bounds>& bounds) {
  return bounds ? fmt::format("[{}, {}]", bounds->lower, bounds->upper) : "null";
}

std::string hull_json(const BallHull& hull, const std::optional<double>& solid_volume) {
  const double volume = volume_of(hull);
  std::optional<double> share;
  if (solid_volume && *solid_volume > 0) share = volume / *solid_volume;
  std::string out = fmt::format(R"({{"kind": "{}", "volume": {}, "volume_share": {}, "balls": [)",
                                name_of(kind_of(hull)), volume, number_or_null(share));
  for (std::uint32_t i = 0; i < hull.count; ++i) {
    const auto& [centre, radius] = hull.corners[i];
    out += fmt::format(R"({}{{"centre": [{}, {}, {}], "radius": {}}})", i > 0 ? ", " : "", centre[0], centre[1],
                       centre[2], radius);
  }
  return out + "]}";
}

/// A line end would end a comment or a name of OBJ.
std::string as_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) <= 0x20; }, '_');
  return text;
}

}  // namespace

std::string encode_hulls_json(const HullRecord& record) {
  const HullFit& fit = record.fit;
  std::string out = fmt::format(
      "{{\n  \"format\": {},\n  \"program\": \"medial-vk\",\n  \"version\": {},\n  \"mesh\": {},\n"
      "  \"primitives\": \"{}\",\n  \"num_hulls\": {},\n  \"num_parameters\": {},\n  \"solid_volume\": {},\n"
      "  \"hulls_volume\": {},\n  \"uncovered_share\": {},\n  \"gap\": {},\n",
      kHullsFormat, quoted_json(version()), quoted_json(record.name), name_of(record.options.choice), fit.hulls.size(),
      parameters_in(fit.hulls), number_or_null(fit.solid_volume), interval_text(fit.covered),
      interval_text(uncovered_share(record)), interval_text(fit.gap));
  out += fmt::format(
      "  \"proof\": {{\"tested\": {}, \"failed\": {}, \"planes\": {}, \"greatest_shrink\": {}}},\n  \"hulls\": [",
      fit.proof.tested, fit.proof.failed, fit.proof.planes, fit.greatest_shrink);
  for (std::size_t i = 0; i < fit.hulls.size(); ++i) {
    out += fmt::format("{}\n    {}", i > 0 ? "," : "", hull_json(fit.hulls[i], fit.solid_volume));
  }
  return out + (fit.hulls.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::string encode_hulls_csv(const HullRecord& record) {
  const std::vector<BallHull>& hulls = record.fit.hulls;
  std::uint32_t most = 0;
  for (const BallHull& hull : hulls) most = std::max(most, hull.count);
  std::string out = "balls";
  for (std::uint32_t i = 1; i <= most; ++i) out += fmt::format(",x{0},y{0},z{0},radius{0}", i);
  out += '\n';
  const auto write = std::back_inserter(out);
  for (const BallHull& hull : hulls) {
    fmt::format_to(write, "{}", hull.count);
    for (const auto& [centre, radius] : hull.balls()) {
      fmt::format_to(write, ",{},{},{},{}", centre[0], centre[1], centre[2], radius);
    }
    out.append(std::size_t{4} * (most - hull.count), ',');
    out += '\n';
  }
  return out;
}

std::string encode_hulls_ma(const HullRecord& record) {
  std::size_t balls = 0, edges = 0, faces = 0;
  for (const BallHull& hull : record.fit.hulls) {
    balls += hull.count;
    edges += hull.count == 3 ? 3u : hull.count - 1u;
    faces += hull.count == 3 ? 1u : 0u;
  }
  std::string out = fmt::format("{} {} {}\n", balls, edges, faces), edge_lines, face_lines;
  std::size_t first = 0;
  for (const BallHull& hull : record.fit.hulls) {
    for (const auto& [centre, radius] : hull.balls()) {
      out += fmt::format("v {} {} {} {}\n", centre[0], centre[1], centre[2], radius);
    }
    for (std::uint32_t i = 1; i < hull.count; ++i) edge_lines += fmt::format("e {} {}\n", first + i - 1, first + i);
    if (hull.count == 3) {
      edge_lines += fmt::format("e {} {}\n", first, first + 2);
      face_lines += fmt::format("f {} {} {}\n", first, first + 1, first + 2);
    }
    first += hull.count;
  }
  return out + edge_lines + face_lines;
}

Result<std::string> encode_hulls_obj(const HullRecord& record) {
  const std::vector<BallHull>& hulls = record.fit.hulls;
  std::string out =
      fmt::format("# medial-vk {}: {} hulls of balls inside {}\n", version(), hulls.size(), as_one_line(record.name));
  const auto write = std::back_inserter(out);
  std::size_t first = 1;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    const Result<Mesh> mesh = inner_mesh(hulls[i], {0, 0, 0}, Digits::kDouble, kHullMeshShare);
    if (!mesh) return with_hull(mesh.error(), i);
    fmt::format_to(write, "o {}_{}\n", name_of(kind_of(hulls[i])), number_text(i, hulls.size()));
    for (const Point& p : mesh.value().vertices) fmt::format_to(write, "v {} {} {}\n", p[0], p[1], p[2]);
    for (const auto& [a, b, c] : mesh.value().triangles) {
      fmt::format_to(write, "f {} {} {}\n", first + a, first + b, first + c);
    }
    first += mesh.value().vertices.size();
  }
  return out;
}

}  // namespace medial_vk
