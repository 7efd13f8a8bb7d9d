// What the command line makes of the library's errors.
#include "cli/terminal/messages.h"

#include <gtest/gtest.h>

namespace medial_vk::cli {
namespace {

// A contract with scripts (docs/command-line.md).
TEST(Messages, ExitCodes) {
  EXPECT_EQ(exit_code(ErrorCode::kInternal), 1);
  EXPECT_EQ(exit_code(ErrorCode::kUsage), 2);
  EXPECT_EQ(exit_code(ErrorCode::kInvalidMesh), 3);
  EXPECT_EQ(exit_code(ErrorCode::kNoDevice), 4);
  EXPECT_EQ(exit_code(ErrorCode::kOutOfMemory), 5);
  EXPECT_EQ(exit_code(ErrorCode::kCannotWrite), 6);
  EXPECT_EQ(exit_code(ErrorCode::kCheckFailed), 7);
  EXPECT_EQ(exit_code(ErrorCode::kInterrupted), 130);
}

TEST(Messages, ParametersBecomeOptions) {
  EXPECT_EQ(in_words_of_options("raise `memory_budget` or `resolution`; `memory_budget`"),
            "raise --memory or --resolution; --memory");
  EXPECT_EQ(in_words_of_options("link `arm`"), "link `arm`");
  EXPECT_EQ(with_hint({ErrorCode::kOutOfMemory, "lower `resolution`"}).message, "lower --resolution");
}

}  // namespace
}  // namespace medial_vk::cli
