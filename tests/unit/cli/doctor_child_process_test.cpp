// Work in a process of its own: its result, and every way in which it can fail.
#include "cli/doctor/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <new>

namespace medial_vk::cli {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

ChildOutcome outcome_of(const std::function<std::string()>& work, std::chrono::milliseconds limit = 60s) {
  Result<ChildOutcome> outcome = run_in_child(work, limit);
  EXPECT_TRUE(outcome.ok());
  return outcome.ok() ? std::move(outcome).value() : ChildOutcome{};
}

TEST(ChildProcess, ReturnsItsResultAndWhatItWrote) {
  const ChildOutcome outcome = outcome_of([] {
    std::cout << "to standard output\n" << std::flush;
    std::cerr << "to standard error\n";
    return std::string("the result");
  });
  EXPECT_EQ(outcome.end, ChildEnd::kDone);
  EXPECT_EQ(outcome.how, "");
  EXPECT_EQ(outcome.result, "the result");
  EXPECT_THAT(outcome.messages, HasSubstr("to standard output"));
  EXPECT_THAT(outcome.messages, HasSubstr("to standard error"));
}

TEST(ChildProcess, ChangesNothingHere) {
  int value = 1;
  ::setenv("MEDIAL_VK_TEST_OF_CHILD", "before", 1);
  outcome_of([&value] {
    value = 2;
    ::setenv("MEDIAL_VK_TEST_OF_CHILD", "after", 1);
    return std::string("x");
  });
  EXPECT_EQ(value, 1);
  EXPECT_STREQ(std::getenv("MEDIAL_VK_TEST_OF_CHILD"), "before");
  ::unsetenv("MEDIAL_VK_TEST_OF_CHILD");
}

TEST(ChildProcess, ResultsMayBeLongerThanAPipe) {
  const std::string long_text(3'000'000, 'r');
  EXPECT_EQ(outcome_of([&] { return long_text; }).result, long_text);
}

TEST(ChildProcess, MessagesWithoutEndFillNoMemory) {
  const ChildOutcome outcome = outcome_of([] {
    for (int i = 0; i < 1000; ++i) std::cerr << std::string(1000, 'm');
    return std::string("x");
  });
  EXPECT_EQ(outcome.end, ChildEnd::kDone);
  EXPECT_EQ(outcome.messages, std::string(64 << 10, 'm'));
}

TEST(ChildProcess, CrashesAreNamed) {
  const ChildOutcome outcome = outcome_of([]() -> std::string {
    std::signal(SIGSEGV, SIG_DFL);  // also under a sanitizer
    std::raise(SIGSEGV);
    return "never";
  });
  EXPECT_EQ(outcome.end, ChildEnd::kCrashed);
  EXPECT_THAT(outcome.how, testing::StartsWith("crashed: "));
  EXPECT_THAT(outcome.how, HasSubstr("(signal 11)"));
  EXPECT_EQ(outcome.result, "");
}

TEST(ChildProcess, AnEarlyEndIsACrash) {
  const ChildOutcome left = outcome_of([]() -> std::string { ::_exit(3); });
  EXPECT_EQ(left.end, ChildEnd::kCrashed);
  EXPECT_EQ(left.how, "ended early, with exit status 3");
  EXPECT_EQ(outcome_of([]() -> std::string { ::_exit(0); }).end, ChildEnd::kCrashed);
  const ChildOutcome threw = outcome_of([]() -> std::string { throw std::bad_alloc(); });
  EXPECT_EQ(threw.end, ChildEnd::kCrashed);
  EXPECT_THAT(threw.messages, HasSubstr("bad_alloc"));
}

TEST(ChildProcess, AHangEndsAtTheLimit) {
  const auto begin = std::chrono::steady_clock::now();
  const ChildOutcome outcome = outcome_of(
      []() -> std::string {
        std::signal(SIGTERM, SIG_IGN);  // as a driver might
        while (true) ::pause();
      },
      200ms);
  EXPECT_EQ(outcome.end, ChildEnd::kTooLong);
  EXPECT_EQ(outcome.how, "did not end within 0.2 s");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

// A process that the child has started keeps the pipes open.
TEST(ChildProcess, DoesNotWaitForGrandchildren) {
  const auto begin = std::chrono::steady_clock::now();
  const ChildOutcome outcome = outcome_of([] {
    if (::fork() == 0) {
      ::sleep(20);
      ::_exit(0);
    }
    return std::string("done");
  });
  EXPECT_EQ(outcome.result, "done");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(ChildProcess, ReadsNothingFromStandardInput) {
  EXPECT_EQ(outcome_of([] {
              char c = 0;
              return std::to_string(::read(STDIN_FILENO, &c, 1));
            }).result,
            "0");
}

}  // namespace
}  // namespace medial_vk::cli
