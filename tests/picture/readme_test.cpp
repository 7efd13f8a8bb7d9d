// The first picture of README.md is the one that its command draws. Without the examples there is no model.
#ifdef MEDIAL_VK_MAKE_MODEL
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "picture/perceptual.h"
#include "picture/tolerance.h"
#include "support/source_folder.h"

namespace medial_vk {
namespace {

/// "medial-vk turtle.obj ..." as README.md shows it below the picture.
std::string shown_command() {
  std::ifstream file(test::source_folder() / "README.md");
  std::stringstream text;
  text << file.rdbuf();
  std::string readme = text.str();
  const std::size_t begin = readme.find("`medial-vk turtle.obj ");
  if (begin == std::string::npos) return {};
  std::string command = readme.substr(begin + 1, readme.find('`', begin + 1) - begin - 1);
  for (char& c : command) c = c == '\n' ? ' ' : c;
  return command;
}

int exit_status(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Readme, PictureIsCurrent) {
  std::string command = shown_command();
  ASSERT_NE(command.find("--picture turtle.png"), std::string::npos) << command;
  const std::string folder = testing::TempDir() + "/medial_vk_readme_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  command.replace(0, std::string("medial-vk").size(), MEDIAL_VK_BINARY);
  const int status = exit_status("cd " + folder + " && " MEDIAL_VK_MAKE_MODEL " turtle.obj && " + command + " -q");
  Result<Picture> drawn = test::read_png(folder + "/turtle.png");
  std::filesystem::remove_all(folder);
  if (status == 4) GTEST_SKIP() << "no Vulkan device";
  ASSERT_EQ(status, 0) << command;
  ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  const Result<Picture> shown = test::read_png(test::source_folder() / "docs" / "images" / "turtle.png");
  ASSERT_TRUE(shown.ok()) << shown.error().message;
  test::expect_same_look(drawn.value(), shown.value(), test::kOtherSamples);  // else: scripts/make-images
}

}  // namespace
}  // namespace medial_vk
#endif
