// A fixture for tests that need a device.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "support/device/device.h"

namespace medial_vk::test {

/// What the tests of a program share: one context, with validation where the layer is installed. It ends with the last
/// test, before the driver is unloaded.
class SharedContext : public testing::Environment {
 public:
  /// Null without a device.
  Context* get() {
    for (const bool validation : {true, false}) {
      if (context_ != nullptr) break;
      Result<Context> made = Context::create({.device = "", .validation = validation, .cache_folder = "/dev/null"});
      if (made.ok()) context_ = std::make_unique<Context>(std::move(made).value());
    }
    return context_.get();
  }
  void TearDown() override { context_.reset(); }

 private:
  std::unique_ptr<Context> context_;
};

/// GoogleTest owns it.
inline SharedContext* const shared_context = [] {
  auto* const shared = new SharedContext;
  testing::AddGlobalTestEnvironment(shared);
  return shared;
}();

/// Uses the context that all tests of the program share; no message of the validation layer may come. Skipped without a
/// device.
class DeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    context_ = shared_context->get();
    if (context_ == nullptr) GTEST_SKIP() << no_device_reason();
    messages_before_ = context_->validation_messages();
  }
  void TearDown() override {
    if (context_ != nullptr) {
      EXPECT_EQ(context_->validation_messages(), messages_before_);
    }
  }
  Context* context_ = nullptr;

 private:
  std::uint64_t messages_before_ = 0;
};

}  // namespace medial_vk::test
