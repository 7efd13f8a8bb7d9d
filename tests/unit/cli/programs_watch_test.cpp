// The message about a driver that compiles for long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <time.h>

#include <string>

#include "cli/shared/programs_watch.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

/// Compiles for the given time, as a patience of one second sees it; returns the messages.
std::string messages_of(bool requested, long milliseconds) {
  testing::internal::CaptureStderr();
  Progress progress(requested);
  ProgramsWatch watch(1);
  watch.set_device("Slow Device");
  watch.update(0, 29, progress);
  timespec left = {milliseconds / 1000, milliseconds % 1000 * 1'000'000};
  while (::nanosleep(&left, &left) != 0) continue;  // the signal interrupts it
  watch.update(29, 29, progress);
  return testing::internal::GetCapturedStderr();
}

TEST(ProgramsWatch, NamesADeviceThatCompilesForLong) {
  const std::string message = messages_of(true, 1200);
  EXPECT_THAT(message, HasSubstr("the driver of Slow Device has been compiling for 1 s"));
  EXPECT_THAT(message, HasSubstr("--backend cpu"));
}

TEST(ProgramsWatch, IsSilentWhereNothingIsSlowOrNoMessagesAreWanted) {
  EXPECT_EQ(messages_of(true, 10), "");
  EXPECT_EQ(messages_of(false, 1200), "");
}

}  // namespace
}  // namespace medial_vk::cli
