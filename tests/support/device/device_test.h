// A fixture for tests that need a device.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "support/device/device.h"

namespace medial_vk::test {

/// A context that all tests of a program share, since drivers take up to seconds to compile the programs of a test. It
/// is destroyed after the last test, before the driver is unloaded.
class SharedContext : public testing::Environment {
 public:
  explicit SharedContext(bool validation) : validation_(validation) {}
  /// Opens a context, with validation if it is requested and the layer is installed.
  static Result<Context> open(bool validation = true) {
    ContextOptions options = {.device = "", .validation = validation, .cache_folder = "/dev/null"};
    Result<Context> made = Context::create(options);
    if (made.ok()) return made;
    options.validation = false;
    return Context::create(options);
  }
  /// The context; null without a device.
  Context* get() {
    if (context_ == nullptr) {
      Result<Context> made = open(validation_);
      if (made.ok()) context_ = std::make_unique<Context>(std::move(made).value());
    }
    return context_.get();
  }
  void TearDown() override { context_.reset(); }

 private:
  bool validation_;
  std::unique_ptr<Context> context_;
};

/// Owned by GoogleTest.
inline SharedContext* add_shared_context(bool validation) {
  auto* const shared = new SharedContext(validation);
  testing::AddGlobalTestEnvironment(shared);
  return shared;
}
inline SharedContext* const shared_context = add_shared_context(true);
inline SharedContext* const quick_context = add_shared_context(false);

/// Without validation, for tests that have tested for a device and that leave the context as it is.
inline Context& quick_device() {
  if (quick_context->get() == nullptr) throw std::runtime_error("the device cannot be opened without validation");
  return *quick_context->get();
}

/// Uses the context that all tests of the program share; messages of the validation layer are failures. Skipped without
/// a device.
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
  /// Called before a test alters its context, a change that others must not see: the test then has a context of its
  /// own.
  void use_own_context() {
    Result<Context> made = SharedContext::open();
    ASSERT_TRUE(made.ok()) << made.error().message;
    own_ = std::make_unique<Context>(std::move(made).value());
    context_ = own_.get();
    messages_before_ = 0;
  }
  Context* context_ = nullptr;

 private:
  std::unique_ptr<Context> own_;
  std::uint64_t messages_before_ = 0;
};

}  // namespace medial_vk::test
