// Files, names and variables, on every system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "platform/files.h"
#include "platform/paths.h"
#include "platform/processes.h"
#include "support/device/device.h"

namespace medial_vk::platform {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// "Lösung – 物体 🐢": two, three and four bytes of UTF-8, the last a pair in UTF-16.
constexpr const char* kName = "L\xc3\xb6sung \xe2\x80\x93 \xe7\x89\xa9\xe4\xbd\x93 \xf0\x9f\x90\xa2";

class PlatformFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return text_of(folder_.path() / path_of(name)); }

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder_.path())) out.push_back(text_of(entry.path().filename()));
    std::sort(out.begin(), out.end());
    return out;
  }

  static std::string content(const std::string& file) {
    std::ifstream in(path_of(file), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void make(const std::string& name, std::string_view bytes) {
    NewFile file;
    ASSERT_EQ(file.create(path(name), true).code, 0);
    ASSERT_EQ(file.write(bytes).code, 0);
    ASSERT_EQ(file.finish().code, 0);
    ASSERT_EQ(file.publish().code, 0);
  }

  test::TemporaryFolder folder_;
};

TEST(PlatformPaths, AreUtf8) {
  const std::string inner = std::string("a/") + kName + ".tar.ply";
  EXPECT_EQ(text_of(path_of(inner)), inner);
  EXPECT_EQ(file_name_of(inner), std::string(kName) + ".tar.ply");
  EXPECT_EQ(stem_of(inner), std::string(kName) + ".tar");
}

TEST(PlatformPaths, KeysAreThoseOfTheSystem) {
#if defined(_WIN32)
  constexpr bool kCaseMatters = false;
#else
  constexpr bool kCaseMatters = true;
#endif
  EXPECT_EQ(file_key("a/L\xc3\xb6sung.OBJ"), file_key("a/L\xc3\xb6sung.OBJ"));
  EXPECT_EQ(file_key("a/L\xc3\xb6sung.OBJ") != file_key("A/l\xc3\x96sung.obj"), kCaseMatters);
  EXPECT_NE(file_key("a/b.obj"), file_key("a/c.obj"));
  EXPECT_EQ(file_key(""), "");
}

TEST_F(PlatformFiles, BytesAreWrittenAsTheyAre) {
  const std::string bytes("line\r\nline\n\x1a\0end", 16);
  make(kName, bytes);
  EXPECT_THAT(names(), ElementsAre(kName));
  EXPECT_EQ(content(path(kName)), bytes);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_to_read(path(kName)), std::fclose);
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(length_of_regular(file.get()), bytes.size());
  std::string read(bytes.size() + 1, ' ');
  read.resize(std::fread(read.data(), 1, read.size(), file.get()));
  EXPECT_EQ(read, bytes);
}

TEST_F(PlatformFiles, AFileHasItsNameAtTheEndOnly) {
  make("a", "before");
  for (const bool may_be_unnamed : {true, false}) {
    NewFile file;
    ASSERT_EQ(file.create(path("a"), may_be_unnamed).code, 0);
    ASSERT_EQ(file.write("half").code, 0);
    ASSERT_EQ(file.finish().code, 0);
    EXPECT_EQ(content(path("a")), "before");
    NewFile moved = std::move(file);
  }
  EXPECT_THAT(names(), ElementsAre("a"));
  make("a", "after");
  EXPECT_EQ(content(path("a")), "after");
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(PlatformFiles, PathsMayBeLong) {
  std::string below;
  for (int i = 0; i < 6; ++i) below += std::string(60, static_cast<char>('a' + i)) + "/";
  std::error_code error;
  fs::create_directories(path_of(path(below)), error);
  ASSERT_FALSE(error) << error.message();
  make(below + "x", "long");
  ASSERT_GT(path(below + "x").size(), 360u);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_to_read(path(below + "x")), std::fclose);
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(length_of_regular(file.get()), 4u);
  EXPECT_EQ(check_target(path(below + "x")).code, 0);
}

TEST_F(PlatformFiles, ReasonsAreThoseOfErrno) {
  EXPECT_EQ(open_to_read(path("none")), nullptr);
  EXPECT_EQ(errno, ENOENT);
  EXPECT_EQ(check_target(path("none/a")).code, ENOENT);
  EXPECT_EQ(check_target(text_of(folder_.path())).code, EISDIR);
  EXPECT_EQ(check_target(path("a")).code, 0);
  make("a", "x");
  EXPECT_NE(check_target(path("a/b")).code, 0);  // EACCES or ENOTDIR
  EXPECT_EQ(NewFile().create(path("none/a"), true).code, ENOENT);
  EXPECT_EQ(NewFile().create(text_of(folder_.path()), true).code, EISDIR);
  EXPECT_EQ(try_to_write(text_of(folder_.path())), 0);
  EXPECT_EQ(try_to_write(path("none")), ENOENT);
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(PlatformFiles, RemovesFilesAndNoFolders) {
  make("a", "x");
  fs::create_directory(folder_.path() / "folder");
  for (const char* name : {"a", "folder", "none"}) remove_file(path(name));
  EXPECT_THAT(names(), ElementsAre("folder"));
}

TEST_F(PlatformFiles, AFileIsLockedOnce) {
  {
    LockedFile first, second;
    EXPECT_EQ(first.lock(path("lock")), 0);
    EXPECT_EQ(second.lock(path("lock")), EWOULDBLOCK);
    LockedFile moved = std::move(first);
    EXPECT_EQ(LockedFile().lock(path("lock")), EWOULDBLOCK);
  }
  EXPECT_EQ(LockedFile().lock(path("lock")), 0);
}

TEST_F(PlatformFiles, LinesAreAppended) {
  AppendedFile table;
  EXPECT_EQ(table.open(path("table")), ENOENT);
  make("table", "first\n");
  ASSERT_EQ(table.open(path("table")), 0);
  EXPECT_EQ(table.append("second\n"), 0);
  EXPECT_EQ(table.append("third\n"), 0);
  EXPECT_EQ(content(path("table")), "first\nsecond\nthird\n");
}

TEST(PlatformPatterns, MatchAsInTheShell) {
  for (const auto& [pattern, name] :
       std::initializer_list<std::pair<const char*, const char*>>{{"*", "a.obj"},
                                                                  {"walk_*.obj", "walk_1.obj"},
                                                                  {"*.obj", "a.obj"},
                                                                  {"a?c", "abc"},
                                                                  {"[a-c]x", "bx"},
                                                                  {"[!a-c]x", "dx"},
                                                                  {"[]]", "]"},
                                                                  {"a*b*c", "aXbYbZc"},
                                                                  {"[abc", "[abc"},
                                                                  {".*", ".hidden"},
                                                                  {"*a*", "a"},
                                                                  {"[a-]", "-"},
                                                                  {"frame[0-9][0-9]", "frame42"}}) {
    EXPECT_TRUE(matches_pattern(name, pattern)) << pattern << ' ' << name;
  }
  for (const auto& [pattern, name] : std::initializer_list<std::pair<const char*, const char*>>{{"*", ".hidden"},
                                                                                                {"?hidden", ".hidden"},
                                                                                                {"a?c", "ac"},
                                                                                                {"[a-c]x", "dx"},
                                                                                                {"[!a-c]x", "bx"},
                                                                                                {"*.obj", "a.ob"},
                                                                                                {"a*b", "abc"},
                                                                                                {"abc", "abd"},
                                                                                                {"", "a"},
                                                                                                {"a", ""}}) {
    EXPECT_FALSE(matches_pattern(name, pattern)) << pattern << ' ' << name;
  }
}

TEST(PlatformVariables, AreUtf8) {
  constexpr const char* kVariable = "MEDIAL_VK_TEST_OF_VARIABLES";
  EXPECT_EQ(variable_of(kVariable), std::nullopt);
  set_variable(kVariable, kName, false);
  EXPECT_EQ(variable_of(kVariable), kName);
  set_variable(kVariable, "other", false);
  EXPECT_EQ(variable_of(kVariable), kName);
  set_variable(kVariable, "other", true);
  EXPECT_EQ(variable_of(kVariable), "other");
  unset_variable(kVariable);
  EXPECT_EQ(variable_of(kVariable), std::nullopt);
}

TEST(PlatformProcesses, KnowTheirFolder) {
  const std::string folder = folder_of_program();
  ASSERT_FALSE(folder.empty());
  EXPECT_TRUE(is_program(folder + "/test_unit"));
  EXPECT_FALSE(is_program(folder + "/no_such_program"));
}

}  // namespace
}  // namespace medial_vk::platform
