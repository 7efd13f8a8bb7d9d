// A mesh from the bytes of a file, or the error.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "input/read_mesh.h"

namespace medial_vk::test {

inline Mesh read_text(const std::string& bytes, const std::string& name) {
  const Result<Mesh> mesh = parse_mesh(bytes, name);
  EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  return mesh.ok() ? mesh.value() : Mesh();
}

inline std::string message_of(const std::string& bytes, const std::string& name) {
  const Result<Mesh> mesh = parse_mesh(bytes, name);
  EXPECT_FALSE(mesh.ok());
  if (mesh.ok()) return {};
  EXPECT_EQ(mesh.error().code, ErrorCode::kInvalidMesh);
  return mesh.error().message;
}

}  // namespace medial_vk::test
