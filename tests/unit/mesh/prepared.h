// Shared definitions of the tests of prepare_mesh(): meshes combined, prepared, or refused.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk::test {

inline PreparedMesh prepare(const Mesh& mesh) {
  const Result<PreparedMesh> prepared = prepare_mesh(mesh);
  EXPECT_TRUE(prepared.ok()) << prepared.error().message;
  return prepared.ok() ? prepared.value() : PreparedMesh();
}

inline std::string refusal(const Mesh& mesh) {
  const Result<PreparedMesh> prepared = prepare_mesh(mesh);
  EXPECT_FALSE(prepared.ok());
  if (prepared.ok()) return {};
  EXPECT_EQ(prepared.error().code, ErrorCode::kInvalidMesh);
  return prepared.error().message;
}

inline Mesh together(Mesh a, const Mesh& b) {
  append(a, b);
  return a;
}

inline Mesh over(Mesh mesh) {
  turn_over(mesh);
  return mesh;
}

}  // namespace medial_vk::test
