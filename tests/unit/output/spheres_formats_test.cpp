// Sphere files: numbers that read back exactly and are floats for every reader, and layouts, small enough to be read
// here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "common/absent_parts.h"
#include "output/sphere_files/float_text.h"
#include "output/sphere_files/sphere_file.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FloatText, AlwaysHasADotAndReadsBack) {
  EXPECT_EQ(float_text(1), "1.0");
  EXPECT_EQ(float_text(-0.25), "-0.25");
  EXPECT_EQ(float_text(0), "0.0");
  EXPECT_EQ(float_text(1e-5), "1.0e-05");
  EXPECT_EQ(float_text(1.5e-7), "1.5e-07");
  EXPECT_EQ(float_text(1e22), "1.0e+22");
  for (const double x : {0.1, 1.0 / 3, 2e-308, std::nextafter(0.3, 1), 12345.678901234567,
                         std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()}) {
    EXPECT_EQ(std::strtod(float_text(x).c_str(), nullptr), x);
    EXPECT_THAT(float_text(x), HasSubstr("."));
  }
}

TEST(YamlWord, QuotesWhatCouldBeSomethingElse) {
  EXPECT_EQ(yaml_word("link_1"), "link_1");
  for (const char* word : {"1", "", "no", "Yes", "NULL", "a b", "a: b", "#x", "-", "1e5", "~", "a/b"}) {
    EXPECT_EQ(yaml_word(word), "\"" + std::string(word) + "\"");
  }
  EXPECT_EQ(yaml_word("a\"\\\n"), "\"a\\\"\\\\\\x0a\"");
}

SphereFile robot() {
  SphereFile file;
  file.version = "1.2.3";
  file.contract = "inside";
  file.method = "source";
  file.is_robot = true;
  file.name = "r";
  file.branch = 2;
  file.parts = {{"a", "m.stl", {{{{0, 0, 1}, 2}}, {{{0, 0, 1}, 2}, {{1e-5, 0, 0}, 0.5}}}, {{}, {}}},
                {"a", "primitive1", {{{{4, 4, 4}, 1}}, {{{4, 4, 4}, 1}}}, {{}, {}}},
                {"b,\"", "m.stl", {{{{9, 9, 9}, 3}}, {{{9, 9, 9}, 3}}}, {{}, {}}}};
  file.urdf =
      "<robot name='r'><link name='a'><visual/><collision><geometry/></collision></link><link name='b,&quot;'>"
      "<collision/><collision/></link><link name='c'><collision/></link></robot>";
  return file;
}

std::string encoded(SphereFormat format, const SphereFile& file) {
  const Result<std::string> bytes = encode_spheres(format, file);
  EXPECT_TRUE(bytes.ok());
  return bytes.ok() ? bytes.value() : "";
}

TEST(SphereFormats, Csv) {
  SphereFile file = robot();
  EXPECT_EQ(encoded(SphereFormat::kCsv, file),
            "link,x,y,z,radius\na,0,0,1,2\na,1e-05,0,0,0.5\na,4,4,4,1\n\"b,\"\"\",9,9,9,3\n");
  file.with_levels = true;
  EXPECT_EQ(encoded(SphereFormat::kCsv, file),
            "link,x,y,z,radius,level\na,0,0,1,2,0\na,4,4,4,1,0\n\"b,\"\"\",9,9,9,3,0\n"
            "a,0,0,1,2,1\na,1e-05,0,0,0.5,1\na,4,4,4,1,1\n\"b,\"\"\",9,9,9,3,1\n");
  file.with_levels = file.is_robot = false;
  file.parts.resize(1);
  EXPECT_EQ(encoded(SphereFormat::kCsv, file), "x,y,z,radius\n0,0,1,2\n1e-05,0,0,0.5\n");
}

TEST(SphereFormats, Curobo) {
  EXPECT_EQ(encoded(SphereFormat::kCurobo, robot()),
            R"(# Spheres by medial-vk 1.2.3: contract inside, method source; link frames, units of the input.
collision_spheres: &collision_spheres
  a:
    - center: [0.0, 0.0, 1.0]
      radius: 2.0
    - center: [1.0e-05, 0.0, 0.0]
      radius: 0.5
    - center: [4.0, 4.0, 4.0]
      radius: 1.0
  "b,\"":
    - center: [9.0, 9.0, 9.0]
      radius: 3.0
robot_cfg:
  kinematics:
    format_version: 2.0
    collision_link_names: [a, "b,\""]
    collision_sphere_buffer: 0.0
    collision_spheres: *collision_spheres
)");
}

TEST(SphereFormats, Xrdf) {
  SphereFile file = robot();
  file.parts.resize(1);
  EXPECT_EQ(encoded(SphereFormat::kXrdf, file),
            R"(# Spheres by medial-vk 1.2.3: contract inside, method source; link frames, units of the input.
format: xrdf
format_version: 1.0
geometry:
  medial_vk_spheres:
    spheres:
      a:
        - center: [0.0, 0.0, 1.0]
          radius: 2.0
        - center: [1.0e-05, 0.0, 0.0]
          radius: 0.5
collision:
  geometry: medial_vk_spheres
self_collision:
  geometry: medial_vk_spheres
)");
}

TEST(SphereFormats, UrdfKeepsAllButCollisions) {
  if (!check_format_is_built("a.urdf").ok()) GTEST_SKIP() << "a build without tinyxml2";
  const std::string text = encoded(SphereFormat::kUrdf, robot());
  EXPECT_THAT(text, HasSubstr("<visual/>"));
  EXPECT_THAT(text, HasSubstr("<sphere radius=\"0.5\"/>"));
  EXPECT_THAT(text, HasSubstr("<origin xyz=\"1e-05 0 0\" rpy=\"0 0 0\"/>"));
  EXPECT_THAT(text, HasSubstr("<link name=\"c\"/>"));
  EXPECT_THAT(text, HasSubstr("<link name=\"b,&quot;\">"));
  SphereFile lost = robot();
  lost.urdf = "<robot";
  EXPECT_FALSE(encode_spheres(SphereFormat::kUrdf, lost).ok());
}

TEST(SphereFormats, FoamOfAMeshIsAListOfLevels) {
  SphereFile file = robot();
  file.parts.resize(1);
  file.is_robot = false;
  EXPECT_EQ(encoded(SphereFormat::kFoam, file), R"([
    {
        "mean": 0.0,
        "best": 0.0,
        "worst": 0.0,
        "spheres": [
          {"origin": [0.0, 0.0, 1.0], "radius": 2.0},
          {"origin": [1.0e-05, 0.0, 0.0], "radius": 0.5}
        ]
    }
]
)");
}

TEST(SphereFormats, FoamsDatabaseIsByPartBranchAndDepth) {
  SphereFile file = robot();
  const std::string one = encoded(SphereFormat::kFoam, file);
  EXPECT_THAT(one, HasSubstr("\"a::m.stl\": {\n        \"2\": {\n            \"1\": {"));
  EXPECT_THAT(one, HasSubstr("\"a::primitive1\""));
  EXPECT_THAT(one, Not(HasSubstr("\n        \"1\": {")));
  file.with_levels = true;
  EXPECT_THAT(encoded(SphereFormat::kFoam, file), HasSubstr("\n        \"1\": {"));
}

}  // namespace
}  // namespace medial_vk
