// Tables of positions of joints: columns in any order, unusual files, and messages with the line of the mistake.
#include "joint_files/read_joint_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace medial_vk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Table = std::vector<std::vector<double>>;

const std::vector<std::string> kJoints = {"arm", "wrist 2"};

Table table_of(const std::string& text, const std::vector<std::string>& joints = kJoints) {
  const Result<Table> table = parse_joint_values(text, "q.csv", joints);
  EXPECT_TRUE(table.ok()) << (table.ok() ? "" : table.error().message);
  return table.ok() ? table.value() : Table();
}

std::string message_of_table(const std::string& text) {
  const Result<Table> table = parse_joint_values(text, "q.csv", kJoints);
  EXPECT_FALSE(table.ok()) << text;
  if (table.ok()) return {};
  EXPECT_EQ(table.error().code, ErrorCode::kInvalidMesh);
  return table.error().message;
}

TEST(ReadJointValues, ColumnsMayHaveAnyOrder) {
  EXPECT_THAT(table_of("time,wrist 2,arm\n0,1,2\n\n0.5, -3e-1 ,+4\r\n"),
              ElementsAre(ElementsAre(2, 1), ElementsAre(4, -0.3)));
  EXPECT_THAT(table_of("\xef\xbb\xbf"
                       "arm,wrist 2\n1,2"),
              ElementsAre(ElementsAre(1, 2)));
  EXPECT_THAT(table_of("time,time\nx,y\n", {}), ElementsAre(testing::IsEmpty()));
}

TEST(ReadJointValues, Messages) {
  EXPECT_EQ(message_of_table(""), "q.csv: there is no configuration");
  EXPECT_EQ(message_of_table("arm,wrist 2\n\n"), "q.csv: there is no configuration");
  EXPECT_THAT(message_of_table("\narm,wrist\n1,2\n"),
              testing::AllOf(HasSubstr("q.csv:2: there is no column"), HasSubstr("\"wrist 2\"")));
  EXPECT_THAT(message_of_table("arm,wrist 2,arm\n1,2,3\n"), HasSubstr("q.csv:1: two columns are named \"arm\""));
  EXPECT_EQ(message_of_table("arm,wrist 2\n1,2\n1\n"), "q.csv:3: 1 values, where the first line names 2");
  EXPECT_EQ(message_of_table("arm,wrist 2\n1,two\n"), "q.csv:2: \"wrist 2\": \"two\" is not a number");
  EXPECT_THAT(message_of_table("arm,wrist 2\n1,\n"), HasSubstr("q.csv:2: \"wrist 2\": \"\""));
  EXPECT_EQ(message_of_table("arm,wrist 2\n2e18,1\n"), "q.csv:2: \"arm\": \"2e18\" is beyond 1e+18");
  EXPECT_THAT(message_of_table("arm,wrist 2\ninf,1\n"), HasSubstr("q.csv:2: \"arm\""));
}

TEST(ReadJointValues, AFileThatIsNotThere) {
  const std::string path = testing::TempDir() + "medial_vk_no_such_joints.csv";
  const Result<Table> table = read_joint_values(path, kJoints);
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.error().message, path + ": cannot be read: No such file or directory");
}

}  // namespace
}  // namespace medial_vk
