#include "robots/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "input/text_scanner.h"
#include "medial_vk/prepare.h"
#include "scene_files/read_mesh_file.h"

namespace medial_vk {
namespace {

/// The name of a mesh in foam: its file without the scheme.
std::string short_name(const std::string& uri) {
  if (!uri.starts_with("package://")) return uri;
  const std::size_t start = uri.find_first_not_of('/', 10);
  return start == std::string::npos ? std::string() : uri.substr(start);
}

/// A mirror inverts the orientation of triangles; prepare_mesh() would restore it, but only if all agree.
void scale_mesh(const Point& scale, Mesh& mesh) {
  for (Point& p : mesh.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] *= scale[axis];
  }
  if (scale[0] * scale[1] * scale[2] > 0) return;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

bool is_finite(const Mesh& mesh) {
  return std::ranges::all_of(
      mesh.vertices, [](const Point& p) { return std::ranges::all_of(p, [](double x) { return std::isfinite(x); }); });
}

class PartLoader {
 public:
  PartLoader(FacetSide side, const MeshPlaces& places, const std::string& name, const PrepareOptions& options)
      : side_(side), places_(places), name_(name), options_(options) {}

  Status add(const Link& link, const std::vector<Geometry>& geometries) {
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      const Geometry& geometry = geometries[i];
      Part part;
      PartOrigin origin;
      part.link = link.name;
      part.pose = geometry.origin;
      part.name = geometry.kind == GeometryKind::kMesh ? short_name(geometry.mesh) : fmt::format("primitive{}", i);
      if (Status status = fill(geometry, part, origin); !status) {
        const Error& error = status.error();
        const auto line = static_cast<std::uint64_t>(std::max(geometry.line, 0));
        Error named = line_error(name_, line, fmt::format("link {}: {}", quoted(link.name), error.message));
        named.code = error.code;
        return named;
      }
      loaded.parts.push_back(std::move(part));
      loaded.origins.push_back(std::move(origin));
    }
    return {};
  }

  RobotParts loaded;

 private:
  Status fill(const Geometry& geometry, Part& part, PartOrigin& origin) {
    if (geometry.kind == GeometryKind::kSphere) {
      part.ball = Ball{{0, 0, 0}, geometry.size[0]};
      part.volume = primitive_volume(geometry);
      return {};
    }
    if (geometry.kind == GeometryKind::kMesh) return fill_from_file(geometry, part, origin);
    origin.facet_share = facet_share(geometry.kind);
    part.volume = primitive_volume(geometry);
    return index(make_primitive(geometry, side_), part);
  }

  Status fill_from_file(const Geometry& geometry, Part& part, PartOrigin& origin) {
    Result<const Mesh*> file = mesh_file(geometry.mesh, origin.file);
    if (!file) return file.error();
    const auto key = std::make_pair(origin.file, geometry.scale);
    const auto known = indexed_.find(key);
    if (known != indexed_.end()) {
      part.mesh = known->second;
      return {};
    }
    Mesh mesh = *file.value();
    scale_mesh(geometry.scale, mesh);
    if (!is_finite(mesh)) return Error{ErrorCode::kInvalidMesh, "the scale leads out of the range of numbers"};
    if (Status status = index(std::move(mesh), part); !status) return status;
    indexed_.emplace(key, *part.mesh);
    return {};
  }

  Status index(Mesh mesh, Part& part) const {
    Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh), options_);
    if (!prepared) {
      return Error{prepared.error().code, fmt::format("{}: {}", quoted(part.name), prepared.error().message)};
    }
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = options_.threads});
    if (!indexed) return indexed.error();
    part.mesh = std::move(indexed).value();
    return {};
  }

  /// Sets `found` to its path.
  Result<const Mesh*> mesh_file(const std::string& uri, std::string& found) {
    const Result<std::string> path = find_mesh(uri, places_);
    if (!path) return path.error();
    found = path.value();
    const auto known = files_.find(path.value());
    if (known != files_.end()) return &known->second;
    Result<Mesh> mesh = read_mesh_file(path.value());
    if (!mesh) return mesh.error();
    return &files_.emplace(path.value(), std::move(mesh).value()).first->second;
  }

  FacetSide side_;
  const MeshPlaces& places_;
  const std::string& name_;
  const PrepareOptions& options_;
  std::map<std::string, Mesh> files_;
  std::map<std::pair<std::string, Point>, IndexedMesh> indexed_;  // by file and scale
};

}  // namespace

Result<RobotParts> load_parts(const Robot& robot, bool visual, FacetSide side, const MeshPlaces& places,
                              const std::string& name, const PrepareOptions& options) {
  PartLoader loader(side, places, name, options);
  for (const Link& link : robot.links) {
    if (Status status = loader.add(link, visual ? link.visual : link.collision); !status) return status.error();
  }
  if (loader.loaded.parts.empty()) {
    return file_error(name, fmt::format("no link has a <{}>; try {}", visual ? "visual" : "collision",
                                        visual ? "--collision" : "--visual"));
  }
  return std::move(loader.loaded);
}

}  // namespace medial_vk
