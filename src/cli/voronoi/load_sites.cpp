#include "cli/voronoi/load_sites.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/stopwatch.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/prepare.h"
#include "platform/paths.h"
#include "scene_files/read_mesh_file.h"

namespace medial_vk::cli {
namespace {

std::string stem_of(const std::string& file) { return file == "-" ? std::string("stdin") : platform::stem_of(file); }

/// The connected parts of a mesh, by vertices at equal positions, in the order of their first triangles.
std::vector<Mesh> connected_parts(const Mesh& mesh) {
  std::map<Point, std::uint32_t> number_of;  // by position
  std::vector<Triangle> triangles = mesh.triangles;
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& corner : triangle) {
      const auto next = static_cast<std::uint32_t>(number_of.size());
      corner = number_of.try_emplace(mesh.vertices[corner], next).first->second;
    }
  }
  ConnectedVertices connected;
  for (const auto& [a, b, c] : triangles) {
    connected.connect(a, b);
    connected.connect(b, c);
  }
  std::map<std::uint32_t, std::size_t> part_of_set;
  std::vector<Mesh> parts;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [at, is_new] = part_of_set.try_emplace(connected.root(triangles[t][0]), parts.size());
    if (is_new) parts.emplace_back();
    Mesh& part = parts[at->second];
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    for (const std::uint32_t corner : mesh.triangles[t]) part.vertices.push_back(mesh.vertices[corner]);
    part.triangles.push_back({first, first + 1, first + 2});
  }
  return parts;
}

/// With --split the parts of a scene, or of any other file its connected parts.
Result<std::vector<ScenePart>> read_site_parts(const std::string& file, bool split) {
  if (!split) {
    Result<Mesh> mesh = read_mesh_file(file);
    if (!mesh) return mesh.error();
    std::vector<ScenePart> one;
    one.push_back({stem_of(file), std::move(mesh).value()});
    return one;
  }
  Result<std::vector<ScenePart>> parts = read_mesh_parts(file);
  if (!parts) return parts.error();
  std::vector<ScenePart> named;
  if (parts.value().size() == 1) {
    for (Mesh& mesh : connected_parts(parts.value()[0].mesh)) {
      named.push_back({fmt::format("{} {}", stem_of(file), named.size() + 1), std::move(mesh)});
    }
    return named;
  }
  for (ScenePart& part : parts.value()) {
    const std::string name = part.name.empty() ? fmt::format("{}", named.size() + 1) : part.name;
    named.push_back({fmt::format("{} {}", stem_of(file), name), std::move(part.mesh)});
  }
  return named;
}

class SiteLoader {
 public:
  SiteLoader(const VoronoiCommandOptions& options, SiteRecord& record) : options_(options), record_(record) {}

  Status add_file(const std::string& file, std::vector<StageTime>& times) {
    Stopwatch stopwatch;
    Result<std::vector<ScenePart>> parts = read_site_parts(file, options_.split);
    if (!parts) return parts.error();
    times.push_back({"read", stopwatch.lap()});
    for (ScenePart& part : parts.value()) {
      if (Status status = add_mesh(std::move(part), file); !status) return status;
    }
    times.push_back({"prepare", stopwatch.lap()});
    return {};
  }

  void add_elements() {
    for (std::size_t i = 0; i < options_.points.size(); ++i) add("point", i).points = {options_.points[i]};
    for (std::size_t i = 0; i < options_.segments.size(); ++i) add("segment", i).segments = {options_.segments[i]};
    for (std::size_t i = 0; i < options_.triangles.size(); ++i) add("triangle", i).triangles = {options_.triangles[i]};
  }

  std::vector<VoronoiSite> take() { return std::move(sites_); }

 private:
  /// A closed mesh as a solid, prepared; any other as it is, since all of its triangles belong to it.
  Status add_mesh(ScenePart part, const std::string& file) {
    PrepareOptions how;
    how.threads = options_.threads;
    Result<PreparedMesh> prepared = prepare_mesh(part.mesh, how);
    if (!prepared && prepared.error().code != ErrorCode::kInvalidMesh) return prepared.error();
    if (!prepared || !prepared.value().report.closed) return add_surface(part, file);
    for (const std::string& assumption : prepared.value().report.assumptions) {
      record_.assumptions.push_back(fmt::format("{}: {}", part.name, assumption));
    }
    record_.sites.push_back({part.name, "solid", prepared.value().mesh.triangles.size()});
    IndexOptions indexing;
    indexing.threads = options_.threads;
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), indexing);
    if (!indexed) return indexed.error();
    sites_.emplace_back().mesh = std::move(indexed).value();
    return {};
  }

  Status add_surface(const ScenePart& part, const std::string& file) {
    const Mesh& mesh = part.mesh;
    if (mesh.triangles.empty()) return Error{ErrorCode::kInvalidMesh, file + ": the mesh has no triangle"};
    VoronoiSite& site = sites_.emplace_back();
    site.triangles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      if (std::max({a, b, c}) >= mesh.vertices.size()) {
        return Error{ErrorCode::kInvalidMesh, file + ": a face uses a vertex that does not exist"};
      }
      site.triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    }
    record_.sites.push_back({part.name, "surface", mesh.triangles.size()});
    record_.assumptions.push_back(part.name + ": not closed: a surface, without an inside.");
    return {};
  }

  VoronoiSite& add(const char* kind, std::size_t number) {
    record_.sites.push_back({fmt::format("{} {}", kind, number + 1), kind, 1});
    return sites_.emplace_back();
  }

  const VoronoiCommandOptions& options_;
  SiteRecord& record_;
  std::vector<VoronoiSite> sites_;
};

}  // namespace

Result<std::vector<VoronoiSite>> load_sites(const VoronoiCommandOptions& options, SiteRecord& record,
                                            std::vector<StageTime>& times) {
  SiteLoader loader(options, record);
  for (const std::string& file : options.files) {
    if (Status status = loader.add_file(file, times); !status) return status.error();
  }
  loader.add_elements();
  return loader.take();
}

}  // namespace medial_vk::cli
