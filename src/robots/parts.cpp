#include "robots/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/first_error.h"
#include "base/parallel.h"
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
Mesh scaled(Mesh mesh, const Point& scale) {
  for (Point& p : mesh.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] *= scale[axis];
  }
  if (scale[0] * scale[1] * scale[2] > 0) return mesh;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

bool is_finite(const Mesh& mesh) {
  return std::ranges::all_of(
      mesh.vertices, [](const Point& p) { return std::ranges::all_of(p, [](double x) { return std::isfinite(x); }); });
}

/// A part that has the mesh of a geometry.
struct Use {
  std::size_t part;
  const Link* link;
  const Geometry* geometry;
};

/// A mesh, and its uses by scale: it is read once, and prepared and indexed once for each scale.
struct MeshOfParts {
  std::string file;  // empty: a primitive
  std::vector<std::pair<Point, std::vector<Use>>> uses;
};

class PartLoader {
 public:
  PartLoader(FacetSide side, const MeshPlaces& places, const std::string& name, const PrepareOptions& options)
      : side_(side), places_(places), name_(name), options_(options) {}

  /// After an error no further geometry is added.
  void add(const Link& link, const std::vector<Geometry>& geometries) {
    for (std::size_t i = 0; i < geometries.size() && first_.status(); ++i) {
      const Geometry& geometry = geometries[i];
      Part& part = loaded_.parts.emplace_back();
      PartOrigin& origin = loaded_.origins.emplace_back();
      part.link = link.name;
      part.pose = geometry.origin;
      part.name = geometry.kind == GeometryKind::kMesh ? short_name(geometry.mesh) : fmt::format("primitive{}", i);
      const Use use = {loaded_.parts.size() - 1, &link, &geometry};
      if (Status status = add(use, part, origin); !status) first_.add(use.part, named(use, status.error()));
    }
  }

  /// Reads, prepares and indexes the meshes, several at a time.
  Result<RobotParts> load() {
    const unsigned threads = thread_count(options_.threads);
    PrepareOptions options = options_;
    options.threads =
        std::max(1u, threads / static_cast<unsigned>(std::clamp<std::size_t>(meshes_.size(), 1, threads)));
    parallel_for(meshes_.size(), 1, threads, [&](std::size_t i) {
      if (first_.concerns(first_part(meshes_[i]))) load(meshes_[i], options);
    });
    if (!first_.status()) return first_.status().error();
    return std::move(loaded_);
  }

 private:
  static std::size_t first_part(const MeshOfParts& mesh) { return mesh.uses.front().second.front().part; }

  /// The message names the line of the geometry and the link.
  Error named(const Use& use, const Error& error) const {
    const auto line = static_cast<std::uint64_t>(std::max(use.geometry->line, 0));
    Error named = line_error(name_, line, fmt::format("link {}: {}", quoted(use.link->name), error.message));
    named.code = error.code;
    return named;
  }

  Status add(const Use& use, Part& part, PartOrigin& origin) {
    const Geometry& geometry = *use.geometry;
    if (geometry.kind == GeometryKind::kMesh) return add_file(use, origin);
    part.volume = primitive_volume(geometry);
    if (geometry.kind == GeometryKind::kSphere) {
      part.ball = Ball{{0, 0, 0}, geometry.size[0]};
      return {};
    }
    origin.facet_share = facet_share(geometry.kind);
    meshes_.push_back({{}, {{{1, 1, 1}, {use}}}});
    return {};
  }

  Status add_file(const Use& use, PartOrigin& origin) {
    const Result<std::string> path = find_mesh(use.geometry->mesh, places_);
    if (!path) return path.error();
    origin.file = path.value();
    const auto [known, is_new] = of_file_.emplace(path.value(), meshes_.size());
    if (is_new) meshes_.push_back({path.value(), {}});
    auto& uses = meshes_[known->second].uses;
    const Point& scale = use.geometry->scale;
    const auto same = std::ranges::find_if(uses, [&](const auto& of_scale) { return of_scale.first == scale; });
    if (same == uses.end()) {
      uses.push_back({scale, {use}});
    } else {
      same->second.push_back(use);
    }
    return {};
  }

  void load(const MeshOfParts& mesh, const PrepareOptions& options) {
    const Use& first = mesh.uses.front().second.front();
    Mesh primitive;
    if (mesh.file.empty()) primitive = make_primitive(*first.geometry, side_);
    const Result<Mesh> read = mesh.file.empty() ? std::move(primitive) : read_mesh_file(mesh.file);
    if (!read) return first_.add(first.part, named(first, read.error()));
    for (const auto& [scale, uses] : mesh.uses) {
      Mesh of_scale = scaled(read.value(), scale);
      const Use& use_of_scale = uses.front();
      if (!mesh.file.empty() && !is_finite(of_scale)) {
        const Error error = {ErrorCode::kInvalidMesh, "the scale leads out of the range of numbers"};
        return first_.add(use_of_scale.part, named(use_of_scale, error));
      }
      const Result<IndexedMesh> indexed = index(std::move(of_scale), loaded_.parts[use_of_scale.part].name, options);
      if (!indexed) return first_.add(use_of_scale.part, named(use_of_scale, indexed.error()));
      for (const Use& use : uses) loaded_.parts[use.part].mesh = indexed.value();
    }
  }

  static Result<IndexedMesh> index(Mesh mesh, const std::string& name, const PrepareOptions& options) {
    Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh), options);
    if (!prepared) return Error{prepared.error().code, fmt::format("{}: {}", quoted(name), prepared.error().message)};
    return IndexedMesh::build(std::move(prepared).value(), {.threads = options.threads});
  }

  FacetSide side_;
  const MeshPlaces& places_;
  const std::string& name_;
  const PrepareOptions& options_;
  RobotParts loaded_;
  FirstError first_;
  std::vector<MeshOfParts> meshes_;             // by their first uses
  std::map<std::string, std::size_t> of_file_;  // indices of meshes_
};

}  // namespace

Result<RobotParts> load_parts(const Robot& robot, bool visual, FacetSide side, const MeshPlaces& places,
                              const std::string& name, const PrepareOptions& options) {
  PartLoader loader(side, places, name, options);
  for (const Link& link : robot.links) loader.add(link, visual ? link.visual : link.collision);
  Result<RobotParts> loaded = loader.load();
  if (loaded.ok() && loaded.value().parts.empty()) {
    return file_error(name, fmt::format("no link has a <{}>; try {}", visual ? "visual" : "collision",
                                        visual ? "--collision" : "--visual"));
  }
  return loaded;
}

}  // namespace medial_vk
