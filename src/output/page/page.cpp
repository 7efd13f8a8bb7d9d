#include "output/page/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "output/extraction_report/report_json.h"
#include "output/page/embedded_page.h"
#include "output/page/page_boundary.h"
#include "output/page/page_parts.h"
#include "platform/paths.h"

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;
using page::Block;

/// The geometry of the page lies around 0 and has size 1, in single precision, for any position and size of the mesh: a
/// mesh far from 0 loses no digits. `origin` and `scale` give the inverse map.
struct Placement {
  Point origin = {0, 0, 0};
  double scale = 1;

  float length(double value) const { return static_cast<float>(value / scale); }
  void add(Block& block, const Point& point) const {
    for (std::size_t i = 0; i < 3; ++i) block.add(length(point[i] - origin[i]));
  }
};

Placement place(const RunRecord& record) {
  Placement placement;
  for (std::size_t i = 0; i < 3; ++i) {
    placement.origin[i] = record.mesh.lower[i] + (record.mesh.upper[i] - record.mesh.lower[i]) / 2;
  }
  if (record.longest_side > 0) placement.scale = record.longest_side;
  return placement;
}

void write_mesh(std::string& page, const Mesh& mesh, const Placement& placement) {
  Block vertices("vertices", mesh.vertices.size() * 12);
  for (const Point& vertex : mesh.vertices) placement.add(vertices, vertex);
  vertices.write(page);
  Block triangles("triangles", mesh.triangles.size() * 12);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) triangles.add(corner);
  }
  triangles.write(page);
}

/// A direction in sixteen bits per coordinate: off by less than a pixel on any screen, and half the size of floats.
void add_direction(Block& block, const std::array<float, 3>& direction) {
  for (const float x : direction) {
    block.add(static_cast<std::int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f)));
  }
}

void write_spheres(std::string& page, std::span<const MedialSphere> spheres, const Placement& placement) {
  Block centres("centres", spheres.size() * 12), radii("radii", spheres.size() * 4);
  Block spokes("spokes", spheres.size() * 12), angles("angles", spheres.size() * 4);
  Block fluxes("fluxes", spheres.size() * 4), sheets("sheets", spheres.size() * 4);
  Block voxels("voxels", spheres.size() * 6);
  for (const MedialSphere& sphere : spheres) {
    placement.add(centres, sphere.centre);
    radii.add(placement.length(sphere.radius));
    add_direction(spokes, sphere.spoke_a);
    add_direction(spokes, sphere.spoke_b);
    angles.add(sphere.object_angle);
    fluxes.add(sphere.flux);
    sheets.add(sphere.sheet);
    for (const std::uint32_t index : sphere.voxel) voxels.add(static_cast<std::uint16_t>(index));
  }
  for (const Block* block : {&centres, &radii, &spokes, &angles, &fluxes, &sheets, &voxels}) block->write(page);
}

std::string scene_json(const Mesh& mesh, std::span<const MedialSphere> spheres, const RunRecord& record,
                       const Placement& placement, UpAxis up, const BoundaryFields& boundary) {
  const bool of_both = record.search.inside && record.search.outside;
  const Json json = {{"origin", placement.origin},
                     {"scale", placement.scale},
                     {"lower", record.search.outside ? record.search.lower : record.mesh.lower},
                     {"upper", record.search.outside ? record.search.upper : record.mesh.upper},
                     {"voxel_size", record.grid.voxel_size},
                     {"vertices", mesh.vertices.size()},
                     {"triangles", mesh.triangles.size()},
                     {"points", spheres.size()},
                     {"outside", record.search.outside},
                     {"inside_points", of_both ? Json(record.search.inside_points) : Json(nullptr)},
                     {"up", axis_name(up)},
                     {"boundary", page::boundary_json(boundary, record.longest_side)}};
  return json.dump();
}

/// Times differ from run to run; the page does not.
std::string report_without_times(const RunRecord& record) {
  RunRecord timeless = record;
  timeless.host_times.clear();
  timeless.device_times.clear();
  return report_json(timeless);
}

std::string title_of(const RunRecord& record) {
  std::string name = record.input == "-" ? "stdin" : platform::file_name_of(record.input);
  if (!record.part.empty()) name += ": " + record.part;
  return page::text_in_html(name);
}

}  // namespace

Status check_page_available() {
  if (!page::embedded_page().empty()) return {};
  return Error{
      ErrorCode::kUsage,
      "--html: this medial-vk was built without its page, as npm or its packages were missing then. Install npm "
      "(Debian: apt install nodejs npm), configure and build again (docs/viewer.md)"};
}

std::string encode_page(const Mesh& mesh, std::span<const MedialSphere> spheres, const RunRecord& record, UpAxis up,
                        const BoundaryFields& boundary) {
  const page::Template page = page::split(page::embedded_page());
  const Placement placement = place(record);

  std::string out;
  // 46 bytes per point and 12 per vertex and triangle, four characters for three bytes.
  out.reserve(page.size() + 65536 + spheres.size() * 62 + (mesh.vertices.size() + mesh.triangles.size()) * 16);
  out.append(page.before_title).append(title_of(record)).append(page.before_data);
  page::write_json(out, "report", report_without_times(record));
  page::write_json(out, "scene", scene_json(mesh, spheres, record, placement, up, boundary));
  write_mesh(out, mesh, placement);
  write_spheres(out, spheres, placement);
  page::write_boundary(out, boundary, record.longest_side);
  out.append(page.after_data);
  return out;
}

}  // namespace medial_vk
