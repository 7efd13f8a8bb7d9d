// Meshes of tests in the form that the library takes: they are indexed first, and errors are passed on.
#pragma once

#include <stdexcept>
#include <utility>

#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/scene.h"

namespace medial_vk::test {

/// The value; throws std::runtime_error, a test failure, if there is an error.
inline IndexedMesh indexed(const MeshView& mesh, unsigned threads = 0) {
  Result<IndexedMesh> made = IndexedMesh::build(mesh, {.threads = threads});
  if (!made.ok()) throw std::runtime_error(made.error().message);
  return std::move(made).value();
}

inline IndexedMesh indexed(const PreparedMesh& mesh, unsigned threads = 0) {
  Result<IndexedMesh> made = IndexedMesh::build(PreparedMesh(mesh), {.threads = threads});
  if (!made.ok()) throw std::runtime_error(made.error().message);
  return std::move(made).value();
}

/// extract_medial_spheres() of a mesh that is indexed for it.
inline Result<Extraction> extract_spheres(Context& context, const MeshView& mesh, const ExtractionOptions& options,
                                          const ProgressCallback& progress = {}, const std::stop_token& stop = {}) {
  Result<IndexedMesh> made = IndexedMesh::build(mesh, {.threads = options.threads});
  if (!made.ok()) return made.error();
  return extract_medial_spheres(made.value(), options, context, progress, stop);
}

/// Scene::create() of a mesh that is indexed for it.
inline Result<Scene> make_scene(Context& context, const MeshView& mesh) {
  Result<IndexedMesh> made = IndexedMesh::build(mesh);
  if (!made.ok()) return made.error();
  return Scene::create(context, made.value());
}

}  // namespace medial_vk::test
