// Files appear whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "common/tool_errors.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OutputAtomicFile : public testing::Test {
 protected:
  OutputAtomicFile() {
    std::string name = testing::TempDir() + "medial_vk_atomic_XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~OutputAtomicFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder_)) out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }

  static std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
};

Status write_one(const std::string& path, const std::string& bytes) {
  const OutputFile file = {path, bytes};
  return write_files({&file, 1});
}

TEST_F(OutputAtomicFile, WritesAndReplaces) {
  ASSERT_TRUE(write_one(path("a"), "first").ok());
  ASSERT_TRUE(write_one(path("a"), "2nd").ok());
  EXPECT_EQ(content(path("a")), "2nd");
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(OutputAtomicFile, NothingIsSeenBeforePublishAndNothingStaysWithoutIt) {
  for (const bool may_be_unnamed : {false, true}) {
    Result<AtomicFile> file = AtomicFile::create(path("a"), may_be_unnamed);
    ASSERT_TRUE(file.ok());
    ASSERT_TRUE(file.value().write("half").ok());
    EXPECT_FALSE(fs::exists(path("a")));
    ASSERT_TRUE(file.value().finish().ok());
    EXPECT_FALSE(fs::exists(path("a")));
    AtomicFile moved = std::move(file).value();  // Moving must not remove the file twice, or too early.
    EXPECT_LE(names().size(), 1u);               // Where there is O_TMPFILE it has no name at all.
    EXPECT_TRUE(may_be_unnamed || names().size() == 1u);
  }
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(OutputAtomicFile, PublishesWithAndWithoutATemporaryName) {
  for (const bool may_be_unnamed : {false, true, false}) {
    for (const char* bytes : {"first", "2nd"}) {  // the second replaces a file
      AtomicFile file = AtomicFile::create(path("a"), may_be_unnamed).value();
      ASSERT_TRUE(file.write(bytes).ok());
      ASSERT_TRUE(file.finish().ok());
      ASSERT_TRUE(file.publish().ok());
      EXPECT_EQ(content(path("a")), bytes);
      EXPECT_THAT(names(), ElementsAre("a"));
    }
    fs::remove(path("a"));
  }
}

TEST_F(OutputAtomicFile, AMissingFolderIsAnErrorThatNamesTheFile) {
  const Status status = write_one(path("no/such/folder/a.ply"), "x");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, kCannotWrite);
  EXPECT_THAT(status.error().message, HasSubstr("no/such/folder/a.ply"));
  EXPECT_FALSE(check_writable(path("no/such/folder/a.ply")).ok());
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(OutputAtomicFile, AFolderOfThatNameIsAnError) {
  fs::create_directory(path("folder"));
  EXPECT_FALSE(write_one(path("folder"), "x").ok());
  EXPECT_FALSE(check_writable(path("folder")).ok());
  EXPECT_THAT(names(), ElementsAre("folder"));
}

TEST_F(OutputAtomicFile, AFileForAFolderIsAnError) {
  ASSERT_TRUE(write_one(path("a"), "x").ok());
  EXPECT_FALSE(write_one(path("a/b"), "x").ok());
  EXPECT_FALSE(check_writable(path("a/b")).ok());
}

TEST_F(OutputAtomicFile, AnUnwritableFolderIsAnError) {
  const bool root = ::geteuid() == 0;  // Root may write everywhere; other users may not.
  if (root && ::seteuid(65534) != 0) GTEST_SKIP() << "there is no other user in this namespace";
  ASSERT_EQ(root ? ::seteuid(0) : 0, 0);
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  ASSERT_EQ(root ? ::seteuid(65534) : 0, 0);
  const Status checked = check_writable(path("a"));
  const Status written = write_one(path("a"), "x");
  ASSERT_EQ(root ? ::seteuid(0) : 0, 0);
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_FALSE(checked.ok());
  EXPECT_FALSE(written.ok());
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(OutputAtomicFile, OneFailureLeavesNoneOfTheFiles) {
  ASSERT_TRUE(write_one(path("old"), "kept").ok());
  const OutputFile files[] = {{path("new"), "x"}, {path("old"), "y"}, {path("missing/z"), "z"}};
  EXPECT_FALSE(write_files(files).ok());
  EXPECT_THAT(names(), ElementsAre("old"));
  EXPECT_EQ(content(path("old")), "kept");
}

TEST_F(OutputAtomicFile, AFullDiskLeavesNothing) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const OutputFile files[] = {{path("new"), "x"}, {"/dev/full", "y"}};
  const Status status = write_files(files);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, kDiskFails);
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(OutputAtomicFile, DevicesAreWrittenInPlace) {
  ASSERT_TRUE(write_one("/dev/null", "x").ok());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputAtomicFile, LinksAreFollowed) {
  ASSERT_TRUE(write_one(path("real"), "old").ok());
  fs::create_symlink("real", path("link"));
  ASSERT_TRUE(write_one(path("link"), "new").ok());
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("real")), "new");
}

TEST_F(OutputAtomicFile, PermissionsAreTheUsualOnesOrThoseOfTheFileReplaced) {
  const mode_t mask = ::umask(022);
  ASSERT_TRUE(write_one(path("a"), "x").ok());
  struct stat status = {};
  ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0644u);
  ASSERT_EQ(::chmod(path("a").c_str(), 0600), 0);
  ASSERT_TRUE(write_one(path("a"), "y").ok());
  ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0600u);
  ::umask(mask);
}

TEST_F(OutputAtomicFile, TheLongestNamesWork) {
  const std::string name(255, 'n');
  ASSERT_TRUE(write_one(path(name), "x").ok());
  EXPECT_THAT(names(), ElementsAre(name));
}

TEST_F(OutputAtomicFile, CheckWritableCreatesNothing) {
  EXPECT_TRUE(check_writable(path("a")).ok());
  EXPECT_TRUE(check_writable("-").ok());
  EXPECT_TRUE(check_writable("/dev/null").ok());
  EXPECT_THAT(names(), IsEmpty());
}

}  // namespace
}  // namespace medial_vk
