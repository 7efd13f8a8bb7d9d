// The value or the message of a parsed command line.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// The default options, and a failure of the test, if the parser refused the `arguments`.
template <typename Options>
Options value_of(const Result<Options>& options, const std::vector<std::string>& arguments) {
  EXPECT_TRUE(options.ok()) << testing::PrintToString(arguments) << (options.ok() ? "" : options.error().message);
  return options.ok() ? options.value() : Options{};
}

/// Nothing, and a failure of the test, if the parser accepted the `arguments`.
template <typename Options>
std::string message_of(const Result<Options>& options, const std::vector<std::string>& arguments) {
  EXPECT_FALSE(options.ok()) << testing::PrintToString(arguments);
  if (options.ok()) return "";
  EXPECT_EQ(options.error().code, ErrorCode::kUsage);
  return options.error().message;
}

}  // namespace medial_vk::cli
