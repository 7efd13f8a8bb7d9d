// Mesh files as users have them, from outside: names, standard input, locales, false headers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::read_file;
using test::run_tool;
using test::ToolCall;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

struct Sample {
  const char* extension;
  std::string bytes;
};

/// One mesh in every format. Its coordinates are floats, so that a binary STL holds it too.
std::vector<Sample> all_formats() {
  const Mesh mesh = test::make_l_shape(2.0, 0.5, 0.75);
  return {{"obj", test::to_obj(mesh)},
          {"off", test::to_off(mesh)},
          {"ply", test::to_ascii_ply(mesh)},
          {"ply", test::to_binary_ply(mesh, false)},
          {"ply", test::to_binary_ply(mesh, true)},
          {"stl", test::to_ascii_stl(mesh)},
          {"stl", test::to_binary_stl(mesh)}};
}

using InputFiles = test::ToolTest;

TEST_F(InputFiles, NamesInAnyScriptWithSpacesAndSigns) {
  for (const std::string stem : {"zwei Wörter", "形状 – 1", "a'b\"c$d;e*f?", "-dash", "dots.in.name", "%s %d {}"}) {
    test::write_file(path(stem + ".OBJ"), all_formats()[0].bytes);
    const ToolResult result = run_cpu({"./" + stem + ".OBJ", "--report=" + stem + ".json", "--check"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(read_file(path(stem + ".medial.ply")), StartsWith("ply\n"));
    EXPECT_THAT(read_file(path(stem + ".json")), StartsWith("{"));
  }
}

TEST_F(InputFiles, StandardInputIsReadInEveryFormat) {
  for (const Sample& sample : all_formats()) {
    const std::string name = std::string("mesh.") + sample.extension;
    test::write_file(path(name), sample.bytes);
    const ToolResult from_file = run_cpu({name, "-o", "-"});
    ASSERT_EQ(from_file.exit_code, 0) << from_file.err;
    ToolCall streamed = cpu_call({"-", "-o", "-"});
    streamed.standard_input = sample.bytes;
    const ToolResult from_stream = run_tool(streamed);
    ASSERT_EQ(from_stream.exit_code, 0) << from_stream.err;
    EXPECT_TRUE(from_stream.out == from_file.out) << name;
  }
}

TEST_F(InputFiles, NothingOnStandardInputIs3) {
  const ToolResult result = run_cpu({"-"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("standard input: file is empty"));
  EXPECT_THAT(folder_.names(), ElementsAre());
}

// Independent of whether these locales are installed: the tool must never query one.
TEST_F(InputFiles, ADecimalCommaInTheEnvironmentChangesNothing) {
  test::write_file(path("part.obj"), all_formats()[0].bytes);
  const std::vector<std::string> arguments = {"part.obj",  "-o",   "-",        "--ascii",
                                              "--epsilon", "0.02", "--report", "r.json"};
  const ToolResult plain = run_cpu(arguments);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "ar_EG.UTF-8"}) {
    ToolCall foreign = cpu_call(arguments);
    for (const char* variable : {"LC_ALL", "LC_NUMERIC", "LANG"}) foreign.environment[variable] = locale;
    const ToolResult result = run_tool(foreign);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.out == plain.out) << locale;
  }
}

// In 64 MiB of address space: an allocation of the size in a header would end with exit code 5.
TEST_F(InputFiles, HeadersThatLieTakeNoMemory) {
#if defined(MEDIAL_VK_SANITIZED)
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  const std::string xyz = "property char x\nproperty char y\nproperty char z\n";
  const std::string list = "property list uint int vertex_indices\nend_header\n";
  for (const std::string count : {"1099511627776", "9223372036854775807", "9223372036854775808"}) {
    for (const std::string& bytes :
         {"OFF\n" + count + " 1 0\n0 0 0\n", "OFF\n1 " + count + " 0\n0 0 0\n",
          "ply\nformat ascii 1.0\nelement vertex " + count + "\n" + xyz + "element face 1\n" + list,
          "ply\nformat binary_little_endian 1.0\nelement vertex " + count + "\n" + xyz + "element face 1\n" + list,
          "ply\nformat ascii 1.0\nelement vertex 0\n" + xyz + "element face " + count + "\n" + list}) {
      ToolCall limited = cpu_call({"-"});
      limited.standard_input = bytes;
      limited.address_space = 64ull << 20;
      const ToolResult result = run_tool(limited);
      EXPECT_EQ(result.exit_code, 3) << result.err;
      EXPECT_THAT(result.err, HasSubstr(count)) << result.err;
    }
  }
}

}  // namespace
}  // namespace medial_vk
