// The folder of compiled pipelines, by the rules of the system.
#include <gtest/gtest.h>

#include "device/pipeline_cache.h"
#include "medial_vk/context.h"
#include "support/device/device.h"

namespace medial_vk {
namespace {

#if defined(_WIN32)

TEST(PipelineCacheFolder, IsThatOfLocalData) {
  EXPECT_EQ(pipeline_cache_folder("C:/given"), "C:/given");
  {
    const test::ScopedEnvironment local("LOCALAPPDATA", "C:\\elsewhere");
    EXPECT_EQ(pipeline_cache_folder(""), "C:/elsewhere/medial-vk");
    EXPECT_EQ(Context::default_cache_folder(), "C:/elsewhere/medial-vk");
  }
  const test::ScopedEnvironment none("LOCALAPPDATA", nullptr);
  EXPECT_EQ(pipeline_cache_folder(""), "");
  EXPECT_EQ(pipeline_cache_file("", {}), "");
}

#else

TEST(PipelineCacheFolder, FollowsTheXdgRules) {
  EXPECT_EQ(pipeline_cache_folder("/given"), "/given");
  const test::ScopedEnvironment home("HOME", "/home/someone");
  {
    const test::ScopedEnvironment xdg("XDG_CACHE_HOME", "/elsewhere");
    EXPECT_EQ(pipeline_cache_folder(""), "/elsewhere/medial-vk");
    EXPECT_EQ(Context::default_cache_folder(), "/elsewhere/medial-vk");
  }
  {
    const test::ScopedEnvironment xdg("XDG_CACHE_HOME", "relative/is/ignored");
    EXPECT_EQ(pipeline_cache_folder(""), "/home/someone/.cache/medial-vk");
  }
  const test::ScopedEnvironment xdg("XDG_CACHE_HOME", nullptr);
  const test::ScopedEnvironment no_home("HOME", nullptr);
  EXPECT_EQ(pipeline_cache_folder(""), "");
  EXPECT_EQ(pipeline_cache_file("", {}), "");
}

#endif

}  // namespace
}  // namespace medial_vk
