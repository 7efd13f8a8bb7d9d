// A fixture for tests that need a device.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "support/device/device.h"

namespace medial_vk::test {

/// A context for each test, with validation where the layer is installed; no message may come. Skipped without a
/// device.
class DeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    const bool validation = no_validation_reason().empty();
    Result<Context> created = Context::create({.device = "", .validation = validation, .cache_folder = "/dev/null"});
    ASSERT_TRUE(created.ok()) << created.error().message;
    context_.emplace(std::move(created).value());
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(context_->validation_messages(), 0u);
    }
  }
  std::optional<Context> context_;
};

}  // namespace medial_vk::test
