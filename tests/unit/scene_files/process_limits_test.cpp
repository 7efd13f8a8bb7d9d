// The limits of the process that reads scenes, in a child of the test.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "assimp_scenes/limits.h"

namespace medial_vk {
namespace {

constexpr std::uint64_t kMebibyte = 1u << 20;

/// The exit code of a child that runs `act`; -1 if a signal ended it.
int exit_code_of(const std::function<int()>& act) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(act());
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::uint64_t limit(decltype(RLIMIT_AS) resource) {
  rlimit found = {};
  return ::getrlimit(resource, &found) == 0 ? found.rlim_cur : 0;
}

#ifndef MEDIAL_VK_SANITIZED  // the shadow memory of sanitizers takes all of the address space
TEST(ProcessLimits, MemoryGrowsWithTheFiles) {
  EXPECT_EQ(exit_code_of([] {
              limit_this_process(kMebibyte);
              if (limit(RLIMIT_AS) != (2ull << 30) + 128 * kMebibyte) return 1;
              allow_for(3 * kMebibyte);
              return limit(RLIMIT_AS) == (2ull << 30) + 512 * kMebibyte ? 0 : 2;
            }),
            0);
}

TEST(ProcessLimits, MoreMemoryIsRefused) {
  EXPECT_EQ(exit_code_of([] {
              limit_this_process(1);
              void* const large = ::mmap(nullptr, 3ull << 30, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
              return large == MAP_FAILED ? 0 : 1;
            }),
            0);
}
#endif

TEST(ProcessLimits, TimeGrowsWithTheFiles) {
  EXPECT_EQ(exit_code_of([] {
              limit_this_process(5 * kMebibyte);
              return limit(RLIMIT_CPU) == 65 ? 0 : 1;
            }),
            0);
}

TEST(ProcessLimits, NoFileIsWritten) {
  const std::string file = testing::TempDir() + "/process_limits_" + std::to_string(::getpid());
  EXPECT_EQ(exit_code_of([&] {
              limit_this_process(1);
              std::signal(SIGXFSZ, SIG_IGN);
              const int out = ::open(file.c_str(), O_CREAT | O_WRONLY, 0600);
              const ssize_t written = ::write(out, "x", 1);
              return written == -1 && errno == EFBIG ? 0 : 1;
            }),
            0);
  std::filesystem::remove(file);
}

TEST(ProcessLimits, AProcessWithoutLimitsGetsNone) {
  EXPECT_EQ(exit_code_of([] {
              const std::uint64_t before = limit(RLIMIT_CPU);
              allow_for(kMebibyte);
              return limit(RLIMIT_CPU) == before ? 0 : 1;
            }),
            0);
}

}  // namespace
}  // namespace medial_vk
