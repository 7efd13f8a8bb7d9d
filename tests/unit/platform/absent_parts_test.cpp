// What a build says of the libraries that it lacks. This build has none of them missing, or all, as that for Windows.
#include "common/absent_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "output/atomic_files/atomic_file.h"

namespace medial_vk {
namespace {

TEST(AbsentParts, AreNamedAndRefusedBeforeWork) {
  const std::vector<std::string> absent = absent_parts();
  const auto lacks = [&](const char* library) {
    return std::ranges::any_of(absent, [=](const std::string& part) { return part.starts_with(library); });
  };
  for (const auto& [file, library] : {std::pair("a.NPZ", "libzip"), std::pair("a.urdf", "tinyxml2")}) {
    const Status status = check_writable(file);
    EXPECT_EQ(status.ok(), !lacks(library)) << file;
    if (status.ok()) continue;
    EXPECT_EQ(status.error().code, ErrorCode::kUsage);
    EXPECT_THAT(status.error().message, testing::HasSubstr("this build writes no "));
    EXPECT_THAT(status.error().message, testing::HasSubstr(library));
  }
  EXPECT_TRUE(check_format_is_built("a.ply").ok());
  EXPECT_EQ(not_read("SVG", "tinyxml2"), "this build reads no SVG files, for which it needs tinyxml2");
  EXPECT_EQ(not_written(".npz", "libzip"), "this build writes no .npz files, for which it needs libzip");
}

}  // namespace
}  // namespace medial_vk
