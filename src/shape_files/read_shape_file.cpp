#include "shape_files/read_shape_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/host_memory.h"
#include "input/read_mesh.h"
#include "input/text_scanner.h"
#include "shape_files/shape_readers.h"
#include "shape_files/svg/read_svg.h"

namespace medial_vk {
namespace {

std::string extension_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./\\");
  if (dot == std::string::npos || path[dot] != '.') return {};
  std::string extension = path.substr(dot + 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

std::optional<ShapeFormat> format_of_extension(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "svg") return ShapeFormat::kSvg;
  if (extension == "geojson" || extension == "json") return ShapeFormat::kGeoJson;
  if (extension == "wkt") return ShapeFormat::kWkt;
  if (extension == "csv") return ShapeFormat::kCsv;
  return {};
}

ShapeFormat format_of_content(std::string_view bytes) {
  const std::string_view text = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n\f\v"), bytes.size()));
  if (text.starts_with('<')) return ShapeFormat::kSvg;
  if (text.starts_with('{')) return ShapeFormat::kGeoJson;
  return looks_like_wkt(text) ? ShapeFormat::kWkt : ShapeFormat::kCsv;
}

Result<AreasOfFile> read_areas(std::string_view bytes, const std::string& name, const ShapeFileOptions& options,
                               ShapeFile& file) {
  if (file.format == ShapeFormat::kGeoJson) return read_geojson(bytes, name);
  if (file.format == ShapeFormat::kWkt) return read_wkt(bytes, name);
  if (file.format == ShapeFormat::kCsv) return read_ring_table(bytes, name);
  Result<SvgAreas> svg = read_svg(bytes, name, options.flatness, kDefaultFlatness);
  if (!svg) return svg.error();
  SvgAreas& read = svg.value();
  file.curves = read.curves;
  file.flatness = read.flatness;
  file.y_is_down = true;
  file.view_box = read.view_box;
  AreasOfFile areas = {std::move(read.areas), read.open_outlines, std::move(read.assumptions)};
  add_sentence(areas.assumptions, read.open_outlines, "open outline is closed by a straight segment, as SVG fills it.",
               "open outlines are closed by a straight segment, as SVG fills them.");
  if (read.curves > 0) {
    areas.assumptions.push_back(fmt::format("{} {} within {:.3g}, in units of the file.", read.curves,
                                            read.curves == 1 ? "curve is a polygon" : "curves are polygons",
                                            read.flatness));
  }
  return areas;
}

Result<ShapeFile> parse_shape(std::string_view bytes, const std::string& name, const ShapeFileOptions& options) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // the byte order mark that some editors write
  if (bytes.empty()) return file_error(name, "file is empty");
  if (bytes.starts_with("\x1f\x8b")) return file_error(name, "the file is compressed by gzip; expand it first");
  ShapeFile file;
  file.format = format_of_extension(name).value_or(format_of_content(bytes));
  Result<AreasOfFile> read = read_areas(bytes, name, options, file);
  if (!read) return read.error();
  AreasOfFile& areas = read.value();
  if (areas.areas.empty()) {
    return file_error(
        name, fmt::format("this {} has no polygon and no line that encloses anything", name_of_format(file.format)));
  }
  if (options.fill_rule) {
    for (ShapeArea& area : areas.areas) area.rule = *options.fill_rule;
  }
  Result<UnitedAreas> united = unite_areas(std::move(areas.areas), options.threads, options.stop);
  if (!united) {
    if (united.error().code != ErrorCode::kInvalidMesh) return united.error();
    return file_error(name, united.error().message);
  }
  UnitedAreas& result = united.value();
  file.rings = std::move(result.rings);
  file.fill_rule = result.rule;
  file.areas = result.areas;
  file.closed_lines = areas.closed_lines;
  file.assumptions = std::move(areas.assumptions);
  std::vector<std::string>& s = file.assumptions;
  add_sentence(s, result.empty, "area encloses nothing and is left out.", "areas enclose nothing and are left out.");
  add_sentence(s, result.crossings, "crossing of an area with itself is cut.",
               "crossings of areas with themselves are cut.");
  if (result.areas > 1) add_sentence(s, result.areas, "", "areas are united.");
  return file;
}

}  // namespace

std::string_view name_of_format(ShapeFormat format) {
  switch (format) {
    case ShapeFormat::kSvg:
      return "SVG";
    case ShapeFormat::kGeoJson:
      return "GeoJSON";
    case ShapeFormat::kWkt:
      return "WKT";
    case ShapeFormat::kCsv:
      return "CSV";
  }
  return "";
}

bool has_shape_extension(const std::string& path) { return format_of_extension(path).has_value(); }

Result<ShapeFile> parse_shape_file(std::string_view bytes, const std::string& name, const ShapeFileOptions& options) {
  if (options.flatness && !(*options.flatness > 0 && std::isfinite(*options.flatness))) {
    return Error{ErrorCode::kUsage, "`flatness` must be positive and finite"};
  }
  return catch_out_of_memory("reading a shape", [&] { return parse_shape(bytes, name, options); });
}

Result<ShapeFile> read_shape_file(const std::string& path, const ShapeFileOptions& options) {
  return catch_out_of_memory("reading a shape", [&]() -> Result<ShapeFile> {
    const Result<std::string> bytes = read_mesh_bytes(path);
    if (!bytes) return bytes.error();
    return parse_shape_file(bytes.value(), name_of_input(path), options);
  });
}

}  // namespace medial_vk
