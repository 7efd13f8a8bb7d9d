// Exceptions of exhausted host memory become errors; tests/faults lets every allocation fail.
#include "base/host_memory.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace medial_vk {
namespace {

TEST(CatchOutOfMemory, PassesOnWhatTheWorkReturns) {
  const auto four = [] { return catch_out_of_memory("counting", []() -> Result<int> { return 4; }); };
  EXPECT_EQ(four().value(), 4);
  const Status failed = catch_out_of_memory("counting", []() -> Status { return Error{ErrorCode::kUsage, "no"}; });
  EXPECT_EQ(failed.error().message, "no");
}

TEST(CatchOutOfMemory, NamesTheWork) {
  const Result<int> exhausted = catch_out_of_memory("counting", []() -> Result<int> { throw std::bad_alloc(); });
  EXPECT_EQ(exhausted.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(exhausted.error().message, "out of memory while counting");
}

TEST(CatchOutOfMemory, CountsATooLongContainerAsExhaustedMemory) {
  const Status too_long = catch_out_of_memory("counting", []() -> Status { throw std::length_error("vector"); });
  EXPECT_EQ(too_long.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(too_long.error().message, "out of memory while counting");
}

TEST(CatchOutOfMemory, LetsOtherExceptionsPass) {
  EXPECT_THROW((void)catch_out_of_memory("counting", []() -> Status { throw std::runtime_error("defect"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace medial_vk
