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
  static Context* get() {
    std::unique_ptr<Context>& context = instance().context_;
    if (context != nullptr) return context.get();
    for (const bool validation : {true, false}) {
      Result<Context> made = Context::create({.device = "", .validation = validation, .cache_folder = "/dev/null"});
      if (!made.ok()) continue;
      context = std::make_unique<Context>(std::move(made).value());
      break;
    }
    return context.get();
  }
  void TearDown() override { context_.reset(); }

 private:
  static SharedContext& instance() { return *registered_; }
  static inline SharedContext* const registered_ = [] {
    auto* const shared = new SharedContext;
    testing::AddGlobalTestEnvironment(shared);  // which owns it from now on
    return shared;
  }();
  std::unique_ptr<Context> context_;
};

/// Uses the context that all tests of the program share; no message of the validation layer may come. Skipped without a
/// device.
class DeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    context_ = SharedContext::get();
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
