#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>

#include "common/file_extension.h"
#include "medial_vk/version.h"
#include "output/boundary_files/encode_boundary.h"
#include "output/numpy_files/npz_writer.h"

namespace medial_vk {
namespace {

/// The fields at vertices, then those of balls.
template <class Visitor>
void visit_fields(const BoundaryFields& fields, const Visitor& visit) {
  for (const BoundaryField& field : fields.of_vertices) visit(field);
  for (const BoundaryField& field : fields.of_balls) visit(field);
}

/// "wall" for 4, and so on: none for numbers that have no words.
std::optional<std::string_view> word_of(const BoundaryField& field, double value) {
  if (field.name == field_names::kThicknessKind) return kind_name(static_cast<ThicknessKind>(static_cast<int>(value)));
  if (field.name == field_names::kCurvatureState) {
    return state_name(static_cast<CurvatureState>(static_cast<int>(value)));
  }
  return std::nullopt;
}

/// JSON has no NaN.
void append_number(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "null";
  } else {
    fmt::format_to(std::back_inserter(out), "{}", value);
  }
}

void append_member(std::string& out, const BoundaryField& field, std::size_t point) {
  fmt::format_to(std::back_inserter(out), ",\"{}\":", field.name);
  const double* values = field.values.data() + point * field.components;
  if (field.components == 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      out += k == 0 ? '[' : ',';
      append_number(out, values[k]);
    }
    out += ']';
  } else if (const auto word = word_of(field, values[0])) {
    fmt::format_to(std::back_inserter(out), "\"{}\"", *word);
  } else {
    append_number(out, values[0]);
  }
}

std::string encode_json(const PointTable& table) {
  std::string out = fmt::format("{{\"version\":\"{}\",\"delta\":", version());
  append_number(out, table.delta);
  out += ",\"points\":[";
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const Point& p = table.points[i];
    fmt::format_to(std::back_inserter(out), "{}\n{{\"at\":[{},{},{}]", i > 0 ? "," : "", p[0], p[1], p[2]);
    visit_fields(table.fields, [&](const BoundaryField& field) { append_member(out, field, i); });
    out += '}';
  }
  out += ']';
  if (!table.triangles.empty()) {
    out += ",\"triangles\":";
    char before = '[';
    for (const Triangle& t : table.triangles) {
      fmt::format_to(std::back_inserter(out), "{}[{},{},{}]", before, t[0], t[1], t[2]);
      before = ',';
    }
    out += ']';
  }
  return out + "}\n";
}

std::string encode_csv(const PointTable& table) {
  std::string out = "x,y,z";
  visit_fields(table.fields, [&](const BoundaryField& field) {
    if (field.components == 1) {
      fmt::format_to(std::back_inserter(out), ",{}", field.name);
    } else {
      for (const char axis : {'x', 'y', 'z'}) fmt::format_to(std::back_inserter(out), ",{}_{}", field.name, axis);
    }
  });
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const Point& p = table.points[i];
    fmt::format_to(std::back_inserter(out), "\n{},{},{}", p[0], p[1], p[2]);
    visit_fields(table.fields, [&](const BoundaryField& field) {
      for (std::size_t k = 0; k < field.components; ++k) {
        const double value = field.values[i * field.components + k];
        if (const auto word = word_of(field, value)) {
          fmt::format_to(std::back_inserter(out), ",{}", *word);
        } else if (std::isnan(value)) {
          out += ",nan";
        } else {
          fmt::format_to(std::back_inserter(out), ",{}", value);
        }
      }
    });
  }
  return out + "\n";
}

Result<std::string> encode_npz(const PointTable& table) {
  NpzWriter out;
  out.text("version", version());
  out.number("delta", table.delta);
  std::vector<double> coordinates;
  coordinates.reserve(3 * table.points.size());
  for (const Point& p : table.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  out.numbers<double>("points", {table.points.size(), 3}, coordinates);
  if (!table.triangles.empty()) {
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * table.triangles.size());
    for (const Triangle& t : table.triangles) corners.insert(corners.end(), t.begin(), t.end());
    out.numbers<std::uint32_t>("triangles", {table.triangles.size(), 3}, corners);
  }
  visit_fields(table.fields, [&](const BoundaryField& field) {
    const std::string name(field.name);
    NpzWriter::Shape shape = {table.points.size()};
    if (field.components == 3) shape.push_back(3);
    if (field.is_whole) {
      std::vector<std::int32_t> numbers;
      numbers.reserve(field.values.size());
      for (const double value : field.values) numbers.push_back(static_cast<std::int32_t>(value));
      out.numbers<std::int32_t>(name.c_str(), shape, numbers);
    } else {
      out.numbers<double>(name.c_str(), shape, field.values);
    }
  });
  return out.finish();
}

}  // namespace

Result<std::string> encode_point_table(const std::string& path, const PointTable& table) {
  const std::string extension = file_extension(path);
  if (extension == ".npz") return encode_npz(table);
  if (extension == ".json") return encode_json(table);
  return encode_csv(table);
}

}  // namespace medial_vk
