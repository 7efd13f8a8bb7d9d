// The lock of the folder of `medial-vk batch` where the file system has none to give, or a signal comes first. flock()
// is replaced in this program: its next calls fail for the reasons that a test names, and all others are the system's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <deque>
#include <string>

#include "cli/batch/batch_folder.h"
#include "common/tool_errors.h"
#include "support/device/device.h"

namespace medial_vk::test {
namespace {

std::deque<int> reasons;  // of the next calls

}  // namespace

int replaced_flock(int descriptor, int operation) {
  if (reasons.empty()) return static_cast<int>(::syscall(SYS_flock, descriptor, operation));
  errno = reasons.front();
  reasons.pop_front();
  return -1;
}

namespace {

using cli::BatchFolder;

class FolderLock : public testing::Test {
 protected:
  ~FolderLock() override { reasons.clear(); }

  Result<BatchFolder> open() const { return BatchFolder::open(folder_.path().string()); }

  TemporaryFolder folder_;
};

TEST_F(FolderLock, IsTriedAgainAfterSignals) {
  reasons = {EINTR, EINTR};
  const Result<BatchFolder> first = open();
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_TRUE(reasons.empty());
  const Result<BatchFolder> second = open();  // the lock is held
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().code, kDiskFails);
  EXPECT_THAT(second.error().message, testing::HasSubstr("another medial-vk batch is writing"));
}

TEST_F(FolderLock, IsNotNeededWhereTheFileSystemHasNone) {
  for (const int reason : {ENOLCK, ENOTSUP, ENOSYS}) {
    reasons = {EINTR, reason};
    const Result<BatchFolder> folder = open();
    EXPECT_TRUE(folder.ok()) << folder.error().message;
    EXPECT_TRUE(reasons.empty());
  }
}

TEST_F(FolderLock, AnyOtherReasonEndsTheRun) {
  reasons = {EIO};
  const Result<BatchFolder> folder = open();
  ASSERT_FALSE(folder.ok());
  EXPECT_EQ(folder.error().code, kDiskFails);
  EXPECT_THAT(folder.error().message, testing::HasSubstr(".medial-vk.lock: Input/output error"));
  EXPECT_TRUE(open().ok());  // nothing was left locked
}

}  // namespace
}  // namespace medial_vk::test

extern "C" int flock(int descriptor, int operation) noexcept {
  return medial_vk::test::replaced_flock(descriptor, operation);
}
