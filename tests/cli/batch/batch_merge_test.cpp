// `medial-vk batch --list` and `--merge`: parts of a folder are done by several runs, and their results become those of
// one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/batch/batch_command.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

namespace fs = std::filesystem;

class BatchMerge : public test::BatchCommand {
 protected:
  /// Runs the program in the folder of the meshes, on a list from standard input.
  ToolResult run_part(const std::string& lines, const std::string& output, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"-", "-o", path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    test::ToolCall call = batch_call(std::move(arguments), lines);
    call.folder = path("in");
    return run_tool(call);
  }

  ToolResult merge(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"batch", "--merge"});
    return run(std::move(arguments));
  }

  static std::string texts(const BatchRow& row) {
    std::string all;
    for (std::size_t i = 0; i < kBatchColumns; ++i) {
      const auto column = static_cast<BatchColumn>(i);
      const bool is_time = column >= BatchColumn::kSecondsRead && column <= BatchColumn::kSeconds;
      if (!is_time) all += row.texts[i] + "|";
    }
    return all;
  }
};

TEST_F(BatchMerge, AListNamesTheMeshesAsTheirLinesDo) {
  write_box("in/b.obj", 0.5);
  write_box("in/deep er/a.obj", 0.5);
  write_box("other/c.obj", 0.5);
  const ToolResult of_folder = batch({"in", "-o", "out", "--list"});
  EXPECT_EQ(of_folder.exit_code, 0) << of_folder.err;
  EXPECT_EQ(of_folder.out, "b.obj\ndeep er/a.obj\n");
  write("lists/some.txt", "../in/b.obj\n" + path("other/c.obj") + "\n");
  const ToolResult of_list = batch({"lists/some.txt", "-o", "out", "--list"});
  EXPECT_EQ(of_list.exit_code, 0) << of_list.err;
  EXPECT_EQ(of_list.out,
            fs::absolute(path("in/b.obj")).string() + "\n" + fs::absolute(path("other/c.obj")).string() + "\n");
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(batch({"none", "-o", "out", "--list"}).exit_code, 3);
  EXPECT_EQ(batch({"in", "-o", "out", "--list", "--epsilon", "x"}).exit_code, 2);
}

TEST_F(BatchMerge, PartsBecomeTheResultsOfOneRun) {
  const std::vector<std::string> more = {"--html", "--report", ".json"};
  for (const char* const name : {"in/a.obj", "in/b, c.obj", "in/deep/a.obj"}) write_box(name, 0.5);
  write("in/broken.obj", "f 1 2 3\n");
  ASSERT_EQ(batch({"in", "-o", "alone", "--html", "--report", ".json"}).exit_code, 9);
  ASSERT_EQ(run_part("a.obj\nbroken.obj\n", "parts/0", more).exit_code, 9);
  ASSERT_EQ(run_part("b, c.obj\ndeep/a.obj\n", "parts/1", more).exit_code, 0);
  write("parts/all.txt", "0\n1\n");
  const ToolResult merged = merge({"parts/all.txt", "-o", "out", "--html"});
  EXPECT_EQ(merged.exit_code, 9) << merged.err;
  EXPECT_THAT(merged.err, HasSubstr("1 of 4 meshes failed"));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("b, c.obj", "done"), Pair("broken.obj", "failed"),
                                    Pair("deep/a.obj", "done")));
  for (const BatchRow& row : rows()) {
    for (const BatchRow& other : rows("alone")) {
      // A failure names the file as its run was given it.
      if (row[BatchColumn::kName] != other[BatchColumn::kName] || !row.is_done()) continue;
      EXPECT_EQ(texts(row), texts(other));
    }
  }
  for (const char* const file : {"a.obj.medial.ply", "b, c.obj.picture.png", "deep/a.obj.medial.ply"}) {
    EXPECT_EQ(bytes_of(std::string("out/") + file), bytes_of(std::string("alone/") + file)) << file;
  }
  EXPECT_THAT(bytes_of("out/batch.html"), HasSubstr("./b%2C%20c.obj.picture.png"));
  EXPECT_THAT(bytes_of("out/batch.html"), HasSubstr("4 meshes, 1 failed"));
  // The results are those of a run: it goes on from them, and does none of them again.
  const ToolResult again = batch({"in", "-o", "out", "--html", "--report", ".json"});
  EXPECT_THAT(again.err, HasSubstr("0 done, 3 done before, 1 failed"));
}

TEST_F(BatchMerge, WhatNoPartHasAnyLongerIsRemoved) {
  for (const char* const name : {"in/a.obj", "in/b.obj", "in/c.obj"}) write_box(name, 0.5);
  ASSERT_EQ(run_part("a.obj\nb.obj\n", "parts/0", {"--report", ".json"}).exit_code, 0);
  ASSERT_EQ(run_part("c.obj\n", "parts/1").exit_code, 0);
  write("out/b.obj.notes.txt", "of the user");
  write("out/.medial-vk.link.00000001", "of a merge that was killed");
  ASSERT_EQ(merge({"parts/0", "parts/1", "-o", "out"}).exit_code, 0);
  const fs::file_time_type before = time_of("out/c.obj.medial.ply");
  ASSERT_TRUE(exists("out/b.obj.report.json"));
  ASSERT_EQ(run_part("a.obj\n", "parts/2").exit_code, 0);
  ASSERT_EQ(merge({"parts/2", "parts/1", "-o", "out"}).exit_code, 0);
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("c.obj", "done")));
  for (const char* const old : {"out/b.obj.medial.ply", "out/b.obj.report.json", "out/a.obj.report.json"}) {
    EXPECT_FALSE(exists(old)) << old;
  }
  EXPECT_TRUE(exists("out/a.obj.medial.ply"));
  EXPECT_TRUE(exists("out/b.obj.notes.txt"));
  EXPECT_EQ(time_of("out/c.obj.medial.ply"), before);
  for (const fs::directory_entry& entry : fs::directory_iterator(path("out"))) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".medial-vk.link")) << entry;
  }
}

TEST_F(BatchMerge, LinesWithoutResultsAreFailures) {
  for (const char* const name : {"in/a.obj", "in/b.obj"}) write_box(name, 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  ASSERT_EQ(run_part("b.obj\n", "parts/1").exit_code, 0);
  std::string table = bytes_of("parts/0/batch.csv");
  table.replace(table.find("\na.obj,done") + 7, 4, "started");
  write("parts/0/batch.csv", table);
  fs::remove(path("parts/1/b.obj.medial.ply"));
  const ToolResult merged = merge({"parts/0", "parts/1", "-o", "out"});
  EXPECT_EQ(merged.exit_code, 9) << merged.err;
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "failed"), Pair("b.obj", "failed")));
  EXPECT_THAT(rows().at(0)[BatchColumn::kError], HasSubstr("a run ended while it was at work on this mesh"));
  EXPECT_THAT(rows().at(1)[BatchColumn::kError], HasSubstr("parts/1/b.obj.medial.ply is missing"));
  EXPECT_FALSE(exists("out/a.obj.medial.ply"));
}

// What a part has lost is kept where an earlier merge has it, but only if it is of the same mesh and options.
TEST_F(BatchMerge, AResultThatOnlyTheFolderHasIsKept) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  ASSERT_EQ(merge({"parts/0", "-o", "out"}).exit_code, 0);
  const std::string points = bytes_of("out/a.obj.medial.ply");
  fs::remove(path("parts/0/a.obj.medial.ply"));
  const ToolResult kept = merge({"parts/0", "-o", "out"});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done")));
  EXPECT_EQ(bytes_of("out/a.obj.medial.ply"), points);
  ASSERT_EQ(run_part("a.obj\n", "parts/1", {"--object-angle", "0.3"}).exit_code, 0);
  fs::remove(path("parts/1/a.obj.medial.ply"));
  const ToolResult other = merge({"parts/1", "-o", "out"});
  EXPECT_EQ(other.exit_code, 9) << other.err;
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "failed")));
  EXPECT_FALSE(exists("out/a.obj.medial.ply"));
}

TEST_F(BatchMerge, TheSameMeshTwiceCountsOnceAndAnotherOneIsRefused) {
  write_box("in/a.obj", 0.5);
  write_box("other/a.obj", 0.6);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  ASSERT_EQ(run_part("a.obj\n", "parts/1").exit_code, 0);
  ASSERT_EQ(batch({"other", "-o", "parts/2"}).exit_code, 0);
  EXPECT_EQ(merge({"parts/0", "parts/1", "-o", "out"}).exit_code, 0);
  EXPECT_EQ(rows().size(), 1U);
  const std::string before = bytes_of("out/batch.csv");
  const ToolResult refused = merge({"parts/0", "parts/2", "-o", "out"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("would have one name, a.obj"));
  EXPECT_EQ(bytes_of("out/batch.csv"), before);
}

TEST_F(BatchMerge, NothingLeadsOutOfTheFolder) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  const std::string table = bytes_of("parts/0/batch.csv");
  for (const char* const name : {"../a.obj", "/a.obj", "x/../../a.obj", "..", "./a.obj"}) {
    std::string edited = table;
    edited.replace(edited.find("\na.obj,") + 1, 5, name);
    write("parts/0/batch.csv", edited);
    const ToolResult refused = merge({"parts/0", "-o", "out"});
    EXPECT_EQ(refused.exit_code, 3) << name;
    EXPECT_THAT(refused.err, HasSubstr("a name leads out of the folder")) << name;
    EXPECT_FALSE(exists("out/batch.csv"));
  }
}

// Neither in the table that is there: what has no part any longer is removed.
TEST_F(BatchMerge, NothingOutsideTheFolderIsRemoved) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  const std::string table = bytes_of("parts/0/batch.csv");
  write("victim.medial.ply", "of another folder");
  for (const std::string& name : {std::string("../victim"), path("victim")}) {
    std::string edited = table;
    edited.replace(edited.find("\na.obj,") + 1, 5, name);
    write("out/batch.csv", edited);
    const ToolResult refused = merge({"parts/0", "-o", "out"});
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_THAT(refused.err, HasSubstr("out/batch.csv: a name leads out of the folder")) << name;
    EXPECT_TRUE(exists("victim.medial.ply")) << name;
    EXPECT_EQ(bytes_of("out/batch.csv"), edited);
  }
}

TEST_F(BatchMerge, WhatCannotBeMergedIsNamed) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  const ToolResult missing = merge({"parts/0", "none", "-o", "out"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("none/batch.csv"));
  const ToolResult itself = merge({"parts/0", "-o", "parts/0"});
  EXPECT_EQ(itself.exit_code, 2);
  EXPECT_THAT(itself.err, HasSubstr("parts/0 is among the folders to merge"));
  const ToolResult options = merge({"parts/0", "-o", "out", "--resolution", "20"});
  EXPECT_EQ(options.exit_code, 2);
  EXPECT_THAT(options.err, HasSubstr("--merge takes results as they are, without --resolution 20"));
  EXPECT_EQ(merge({"parts/0", "-o", "out", "--list"}).exit_code, 2);
  write("other/batch.csv", "name,value\na,1\n");
  EXPECT_EQ(merge({"other", "-o", "out"}).exit_code, 3);
  std::string table = bytes_of("parts/0/batch.csv");
  table.replace(table.find(",done,") + 1, 4, "????");
  write("parts/0/batch.csv", table);
  const ToolResult damaged = merge({"parts/0", "-o", "out"});
  EXPECT_EQ(damaged.exit_code, 3);
  EXPECT_THAT(damaged.err, HasSubstr("parts/0/batch.csv:2: this line is damaged"));
  EXPECT_FALSE(exists("out/batch.csv"));
}

// A merge must not replace a mesh, as a run must not.
TEST_F(BatchMerge, AResultThatWouldReplaceAMeshIsRefused) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  fs::copy_file(path("parts/0/a.obj.medial.ply"), path("in/a.obj.medial.ply"));
  write_box("in/b.obj", 0.5);
  ASSERT_EQ(run_part("a.obj.medial.ply\nb.obj\n", "parts/1").exit_code, 9);
  const std::string before = bytes_of("in/a.obj.medial.ply");
  const ToolResult refused = merge({"parts/0", "parts/1", "-o", "in"});
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("would overwrite the mesh"));
  EXPECT_EQ(bytes_of("in/a.obj.medial.ply"), before);
}

TEST_F(BatchMerge, OnAnotherFileSystemResultsAreCopied) {
  struct stat here = {}, there = {};
  const bool has_other = ::stat("/dev/shm", &there) == 0 && ::access("/dev/shm", W_OK) == 0;
  if (::stat(path("").c_str(), &here) != 0 || !has_other || here.st_dev == there.st_dev) {
    GTEST_SKIP() << "/dev/shm is no other file system";
  }
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(run_part("a.obj\n", "parts/0").exit_code, 0);
  const std::string points = bytes_of("parts/0/a.obj.medial.ply");
  const std::string other = "/dev/shm/medial_vk_merge_" + std::to_string(::getpid());
  const ToolResult merged = merge({"parts/0", "-o", other});
  const std::string copied =
      fs::exists(other + "/a.obj.medial.ply") ? test::read_file(other + "/a.obj.medial.ply") : "";
  fs::remove_all(other);
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(copied, points);
}

// Two sets of results with the same names become those of the folder in turns.
TEST_F(BatchMerge, KillsLeaveLinesThatAreTrue) {
  constexpr int kMeshes = 30, kKills = 100;
  std::string lines;
  for (int i = 0; i < kMeshes; ++i) {
    const std::string name = "folder" + std::to_string(i % 3) + "/" + std::to_string(i) + ".obj";
    write_box("in/" + name, 0.4 + 0.01 * i);
    lines += name + "\n";
  }
  const std::vector<std::string> sets = {"parts/0", "parts/1"};
  ASSERT_EQ(run_part(lines, sets[0]).exit_code, 0);
  ASSERT_EQ(run_part(lines, sets[1], {"--object-angle", "0.3"}).exit_code, 0);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(merge({sets[0], "-o", "out", "--html"}).exit_code, 0);
  const std::chrono::duration<double> whole_merge = std::chrono::steady_clock::now() - begin;
  for (int i = 0; i < kKills && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "kill " << i);
    test::Tool tool(call({"batch", "--merge", sets[static_cast<std::size_t>(i % 2)], "-o", "out", "--html"}));
    std::this_thread::sleep_for(whole_merge * 1.1 * i / kKills);
    tool.send(SIGKILL);
    tool.wait();
    for (const BatchRow& row : rows()) {
      const bool is_second = row[BatchColumn::kOptions].find("--object-angle") != std::string::npos;
      const std::string file = "/" + row[BatchColumn::kName] + ".medial.ply";
      EXPECT_TRUE(!row.is_done() || bytes_of("out" + file) == bytes_of(sets[is_second ? 1 : 0] + file)) << file;
    }
  }
  ASSERT_EQ(merge({sets[1], "-o", "out", "--html"}).exit_code, 0);
  EXPECT_EQ(rows().size(), static_cast<std::size_t>(kMeshes));
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path("out"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_FALSE(name.starts_with(".medial-vk.link")) << entry;
  }
}

}  // namespace
}  // namespace medial_vk
