// The list of programs that the last run needed.
#include "program_list.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "embedded_shaders.h"
#include "medial_vk/context.h"
#include "medial_vk/queries.h"
#include "support/device.h"
#include "support/solids.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;

class ProgramList : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("program_list_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    file_ = (folder_ / "list").string();
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  static void replace(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

  fs::path folder_;
  std::string file_;
};

std::vector<ProgramKey> some_keys() {
  const std::string name(embedded_shaders().front().name);
  return {{name, 3, 2, 16, 64, {1, 0, 7}}, {name, 3, 2, 16, 128, {}}};
}

TEST_F(ProgramList, ReadsWhatItWrote) {
  write_program_list(file_, some_keys());
  EXPECT_EQ(read_program_list(file_), some_keys());
  write_program_list(file_, {some_keys()[1]});
  EXPECT_EQ(read_program_list(file_).size(), 1u);
  EXPECT_EQ(program_list_file(""), "");
  EXPECT_TRUE(read_program_list("").empty());
  EXPECT_TRUE(read_program_list((folder_ / "none").string()).empty());
}

TEST_F(ProgramList, IgnoresWhatIsDamagedOrOfOtherShaders) {
  write_program_list(file_, some_keys());
  const std::string good = contents(file_);
  for (std::size_t i = 0; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = bad[i] == '1' ? '2' : '1';
    replace(file_, bad);
    EXPECT_TRUE(read_program_list(file_).empty()) << "byte " << i;
    replace(file_, good.substr(0, i));
    EXPECT_TRUE(read_program_list(file_).empty()) << "cut at " << i;
  }
}

// The second context makes the programs before they are asked for; the third one's list is damaged.
TEST_F(ProgramList, ChangesNoAnswer) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Mesh mesh = test::make_torus(1.0, 0.4, 20, 30);
  const std::vector<Point> points = {{0.1, 0.2, 0.3}, {1, 0, 0}, {2, 2, 2}};
  std::vector<ClosestPoint> first;
  for (int run = 0; run < 3; ++run) {
    const bool validation = test::no_validation_reason().empty();
    Result<Context> context =
        Context::create({.device = "", .validation = validation, .cache_folder = folder_.string()});
    ASSERT_TRUE(context.ok()) << context.error().message;
    {
      Scene scene = Scene::create(context.value(), {mesh.vertices, mesh.triangles, {}, true}).value();
      const std::vector<ClosestPoint> found = scene.closest_points(points).value();
      if (run == 0) first = found;
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(found[i].triangle, first[i].triangle);
        EXPECT_EQ(found[i].point, first[i].point);
      }
    }
    EXPECT_EQ(context.value().validation_messages(), 0u);
    context = Error{};  // ends the context, which writes its list
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() != ".programs") continue;
      EXPECT_FALSE(read_program_list(entry.path().string()).empty());
      if (run == 1) replace(entry.path(), "damaged");
    }
  }
}

}  // namespace
}  // namespace medial_vk
