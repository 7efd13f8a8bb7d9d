// What `medial-vk batch` records holds: a failure to write is that of its mesh, files are those of the last run,
// another mesh takes no name that is in use, and what is measured has columns.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/batch/batch_command.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

namespace fs = std::filesystem;

using BatchRecords = test::BatchCommand;

TEST_F(BatchRecords, AFileThatCannotBeWrittenIsTheFailureOfItsMesh) {
  const std::string long_name = std::string(248, 'x') + ".obj";  // a file may have that name, its results may not
  for (const std::string& name : {std::string("a.obj"), std::string("b.obj"), long_name, std::string("z.obj")}) {
    write_box("in/" + name, 0.5);
  }
  fs::create_directories(path("out/a.obj.medial.ply/kept"));
  fs::create_directories(path("out/b.obj.medial.ply"));  // empty
  const ToolResult result = batch({"in", "-o", "out"});
  EXPECT_EQ(result.exit_code, 9) << result.err;
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "failed"), Pair("b.obj", "failed"), Pair(long_name, "failed"),
                                    Pair("z.obj", "done")));
  EXPECT_THAT(rows().at(0)[BatchColumn::kError], HasSubstr("cannot write out/a.obj.medial.ply: Is a directory"));
  EXPECT_THAT(rows().at(2)[BatchColumn::kError], HasSubstr("File name too long"));
  EXPECT_TRUE(exists("out/a.obj.medial.ply/kept"));
  EXPECT_TRUE(exists("out/b.obj.medial.ply"));
}

TEST_F(BatchRecords, AFullDiskEndsTheRun) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const char* const name : {"in/a.obj", "in/b.obj", "in/c.obj"}) write_box(name, 0.5);
  fs::create_directories(path("out"));
  fs::create_symlink("/dev/full", path("out/b.obj.medial.ply"));
  const ToolResult result = batch({"in", "-o", "out"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_THAT(result.err, HasSubstr("cannot write out/b.obj.medial.ply: No space left on device"));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("b.obj", "started")));
}

TEST_F(BatchRecords, AnotherMeshTakesNoNameInUse) {
  write_box("one/a.obj", 0.5);
  write_box("two/a.obj", 0.6);
  ASSERT_EQ(batch({"one", "-o", "out"}).exit_code, 0);
  const std::string table = bytes_of("out/batch.csv"), points = bytes_of("out/a.obj.medial.ply");
  const ToolResult refused = batch({"two", "-o", "out"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("out has results of " + fs::canonical(path("one/a.obj")).string() +
                                     " with the name a.obj, and two/a.obj is another file"));
  EXPECT_EQ(bytes_of("out/batch.csv"), table);
  EXPECT_EQ(bytes_of("out/a.obj.medial.ply"), points);
  fs::rename(path("one"), path("away"));  // moved, or removed
  EXPECT_EQ(batch({"two", "-o", "out"}).exit_code, 0);
  EXPECT_NE(bytes_of("out/a.obj.medial.ply"), points);
}

TEST_F(BatchRecords, OtherOptionsAndFailuresLeaveNoFilesOfThePast) {
  write_box("in/a.obj", 0.5);
  write("out/a.obj.notes.txt", "of the user");
  ASSERT_EQ(batch({"in", "-o", "out", "--report", ".json", "--medial-mesh", ".ma"}).exit_code, 0);
  EXPECT_TRUE(exists("out/a.obj.report.json"));
  EXPECT_TRUE(exists("out/a.obj.surface.ma"));
  ASSERT_EQ(batch({"in", "-o", "out", "--format", ".csv", "--html"}).exit_code, 0);
  for (const char* const old : {"out/a.obj.medial.ply", "out/a.obj.report.json", "out/a.obj.surface.ma"}) {
    EXPECT_FALSE(exists(old)) << old;
  }
  EXPECT_EQ(rows().at(0)[BatchColumn::kFiles], ".medial.csv .picture.png");
  EXPECT_THAT(bytes_of("out/batch.html"), HasSubstr("a.obj.picture.png"));
  write("in/a.obj", "f 1 2 3\n");
  ASSERT_EQ(batch({"in", "-o", "out", "--report", ".json", "--html", "--format", ".json"}).exit_code, 9);
  for (const char* const old : {"out/a.obj.medial.csv", "out/a.obj.picture.png"}) EXPECT_FALSE(exists(old)) << old;
  EXPECT_THAT(bytes_of("out/batch.html"), Not(HasSubstr("picture.png")));
  EXPECT_EQ(rows().at(0)[BatchColumn::kFiles], "");
  EXPECT_EQ(bytes_of("out/a.obj.notes.txt"), "of the user");
}

// A picture that no run has made is none of the mesh's.
TEST_F(BatchRecords, ThePageShowsWhatTheRunsHaveWritten) {
  write("in/a.obj", "f 1 2 3\n");
  write("out/a.obj.picture.png", "of the user");
  EXPECT_EQ(batch({"in", "-o", "out", "--html"}).exit_code, 9);
  EXPECT_THAT(bytes_of("out/batch.html"), Not(HasSubstr("a.obj.picture.png")));
  EXPECT_EQ(bytes_of("out/a.obj.picture.png"), "of the user");
}

// The column `files` of a table that was edited.
TEST_F(BatchRecords, NothingBesideTheResultsIsRemoved) {
  write_box("in/a.obj", 0.5);
  write("out/a.obj", "kept");
  write("a.b.c", "kept");
  write("out/a.obj.x/y.z", "kept");
  ASSERT_EQ(batch({"in", "-o", "out"}).exit_code, 0);
  std::string table = bytes_of("out/batch.csv");
  const std::size_t at = table.find(",.medial.ply,");
  ASSERT_NE(at, std::string::npos);
  table.replace(at, 13, ",.medial.ply /../../a.b.c .x/y.z ./../a.obj,");
  write("out/batch.csv", table);
  ASSERT_EQ(batch({"in", "-o", "out", "--format", ".csv"}).exit_code, 0);
  EXPECT_FALSE(exists("out/a.obj.medial.ply"));
  for (const char* const file : {"out/a.obj", "a.b.c", "out/a.obj.x/y.z"}) EXPECT_EQ(bytes_of(file), "kept") << file;
}

// A result that has become a mesh is not removed.
TEST_F(BatchRecords, AResultThatIsAMeshNowIsKept) {
  write_box("a.obj", 0.5);
  ASSERT_EQ(batch({"a.obj", "-o", ".", "--mesh-spheres"}).exit_code, 0);
  const std::string before = bytes_of("a.obj.spheres.ply");
  const ToolResult refused = batch({"a.obj", "a.obj.spheres.ply", "-o", "."});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("would overwrite the mesh a.obj.spheres.ply"));
  EXPECT_EQ(bytes_of("a.obj.spheres.ply"), before);
}

TEST_F(BatchRecords, WhatIsMeasuredHasColumns) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(batch({"in", "-o", "out", "--least-wall", "--thickness"}).exit_code, 0);
  const BatchRow row = rows().at(0);
  EXPECT_LE(std::stod(row[BatchColumn::kLeastWallLower]), 0.5);
  EXPECT_GE(std::stod(row[BatchColumn::kLeastWallUpper]), 0.5);
  EXPECT_NEAR(std::stod(row[BatchColumn::kLeastWallLower]), 0.5, 0.01);
  EXPECT_EQ(row[BatchColumn::kLeastGapLower], "");
  // Most of the area of a box of 1, 0.8 and 0.5 is that of both large faces, whose balls have a diameter of 0.5.
  EXPECT_LE(std::stod(row[BatchColumn::kThicknessLower]), 0.5);
  EXPECT_GT(std::stod(row[BatchColumn::kThicknessUpper]), 0);
  EXPECT_LE(std::stod(row[BatchColumn::kThicknessLower]), std::stod(row[BatchColumn::kThicknessUpper]));
}

TEST_F(BatchRecords, ADamagedLineIsNoneAndItsMeshIsDoneAgain) {
  for (const char* const name : {"in/a.obj", "in/b.obj", "in/c.obj"}) write_box(name, 0.5);
  ASSERT_EQ(batch({"in", "-o", "out"}).exit_code, 0);
  std::string table = bytes_of("out/batch.csv");
  table.replace(table.find("\na.obj,done") + 7, 4, "????");
  table.replace(table.find("\nc.obj,done") + 7, 4, "????");
  write("out/batch.csv", table);
  const ToolResult result = batch({"in", "-o", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("out/batch.csv:2: this line, like 1 others, is damaged"));
  EXPECT_THAT(result.err, HasSubstr("2 done, 1 done before"));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("b.obj", "done"), Pair("c.obj", "done")));
}

}  // namespace
}  // namespace medial_vk
