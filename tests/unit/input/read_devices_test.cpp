// Devices of POSIX as meshes.
#include <gtest/gtest.h>

#include "input/read_mesh.h"

namespace medial_vk {
namespace {

TEST(ReadLimits, AStreamWithoutAnEnd) {
  const Result<Mesh> mesh = read_mesh("/dev/zero", 3u << 20);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(mesh.error().message, "/dev/zero: longer than 3 MiB, the most that is read");
}

}  // namespace
}  // namespace medial_vk
