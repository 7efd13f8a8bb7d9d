// Names of files for the meshes of a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_files/part_names.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;

std::vector<std::string> names_of(const std::vector<std::string>& names) {
  std::vector<ScenePart> parts;
  for (const std::string& name : names) parts.push_back({name, {}});
  return safe_part_names(parts);
}

TEST(PartNames, SafeCharactersOnly) {
  EXPECT_THAT(names_of({"Wheel.001", "../../etc/passwd", "a b\tc", "-rf", "été", "__x__"}),
              ElementsAre("Wheel_001", "etc_passwd", "a_b_c", "rf", "t", "x"));
  EXPECT_THAT(names_of({std::string("a\0b\x7f\n", 5), "C:\\x", "a\"b'$(c)"}), ElementsAre("a_b", "C_x", "a_b_c"));
}

TEST(PartNames, WithoutANameItIsTheNumber) {
  EXPECT_THAT(names_of({"", "..", "形状", "x"}), ElementsAre("1", "2", "3", "x"));
}

TEST(PartNames, EqualNamesGetNumbersWhateverTheirCase) {
  EXPECT_THAT(names_of({"a", "A", "a", "b", "a-2", "a"}), ElementsAre("a", "A-2", "a-3", "b", "a-2-2", "a-4"));
  EXPECT_THAT(names_of({"2", "", "x y", "x.y"}), ElementsAre("2", "2-2", "x_y", "x_y-2"));
}

TEST(PartNames, LongNamesAreCutAndStayDifferent) {
  const std::string long_name(1000, 'n');
  EXPECT_THAT(names_of({long_name, long_name + "x"}), ElementsAre(std::string(48, 'n'), std::string(48, 'n') + "-2"));
}

TEST(PartNames, AHundredThousandOfOneNameTakeNoQuadraticTime) {
  const std::vector<std::string> names = names_of(std::vector<std::string>(100'000, "same"));
  EXPECT_EQ(names.back(), "same-100000");
}

}  // namespace
}  // namespace medial_vk
