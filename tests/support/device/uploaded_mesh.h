// Meshes of tests on a device, for tests that look inside the library.
#pragma once

#include "device/context_impl.h"
#include "device_mesh/device_mesh.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk::test {

/// DeviceMesh::create() of a mesh that is indexed for it, with all uploads done.
inline Result<DeviceMesh> upload_mesh(ContextImpl& context, const MeshView& mesh, bool with_links = false) {
  Result<IndexedMesh> made = IndexedMesh::build(mesh);
  if (!made.ok()) return made.error();
  Result<DeviceMesh> device = DeviceMesh::create(context, made.value(), with_links);
  if (!device.ok()) return device.error();
  if (Status there = device.value().finish_uploads(); !there.ok()) return there.error();
  return device;
}

}  // namespace medial_vk::test
