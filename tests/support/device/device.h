// Contexts for tests, which are skipped without a Vulkan device and never touch the user's pipeline cache.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <utility>

#include "medial_vk/context.h"

namespace medial_vk::test {

/// A folder that exists as long as the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::random_device random;
    do {  // until the name is new
      path_ = std::filesystem::temp_directory_path() / ("medial_vk_test_" + std::to_string(random()));
    } while (!std::filesystem::create_directory(path_));
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Sets an environment variable (nullptr: unsets it) until the end of the scope.
class ScopedEnvironment {
 public:
  ScopedEnvironment(const char* name, const char* value) : name_(name) {
    const char* old = getenv(name);
    had_ = old != nullptr;
    if (had_) old_ = old;
    set(value);
  }
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;
  ~ScopedEnvironment() { set(had_ ? old_.c_str() : nullptr); }

 private:
  void set(const char* value) {
#if defined(_WIN32)
    _putenv_s(name_.c_str(), value != nullptr ? value : "");
#else
    if (value != nullptr) {
      setenv(name_.c_str(), value, 1);
    } else {
      unsetenv(name_.c_str());
    }
#endif
  }
  std::string name_;
  std::string old_;
  bool had_ = false;
};

/// The reason why a context with or without validation cannot be opened here; empty: it can. The test opens a context,
/// so each program makes it once.
inline const std::string& no_device_reason() {
  static const std::string reason = [] {
    const Result<Context> context = Context::create({.device = "", .validation = false, .cache_folder = "/dev/null"});
    return context.ok() ? "" : context.error().message;
  }();
  return reason;
}

inline const std::string& no_validation_reason() {
  static const std::string reason = [] {
    const Result<Context> context = Context::create({.device = "", .validation = true, .cache_folder = "/dev/null"});
    return context.ok() ? "" : context.error().message;
  }();
  return reason;
}

}  // namespace medial_vk::test

#define MEDIAL_VK_SKIP_WITHOUT_DEVICE() \
  if (const std::string reason = medial_vk::test::no_device_reason(); !reason.empty()) GTEST_SKIP() << reason

#define MEDIAL_VK_SKIP_WITHOUT_VALIDATION() \
  if (const std::string reason = medial_vk::test::no_validation_reason(); !reason.empty()) GTEST_SKIP() << reason
