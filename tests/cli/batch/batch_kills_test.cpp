// `medial-vk batch` that is killed: what the table says of a mesh holds for its files, and a mesh that ends every run
// keeps no other from its turn. Runs are killed at moments spread over a run, and at that between the files and their
// line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "cli/batch/batch_command.h"
#include "cli/paths.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class BatchKills : public test::BatchCommand {
 protected:
  static constexpr int kMeshes = 5;

  BatchKills() {
    for (int i = 0; i < kMeshes; ++i) write_box("in/" + std::to_string(i) + ".obj", 0.4 + 0.1 * i);
  }

  std::vector<std::string> arguments() const { return {"in", "-o", "out", "--report", ".json", "--html"}; }

  static bool is_result(const std::string& name) {
    return name.ends_with(".ply") || name.ends_with(".json") || name.ends_with(".png") || name == "batch.csv" ||
           name == "batch.html" || name == ".medial-vk.lock";
  }

  std::vector<std::string> names_of_results() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("out"))) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// Files of points are whole, and the table names no mesh without them.
  void expect_whole(const std::map<std::string, std::string>& points) const {
    if (!exists("out")) return;
    for (const std::string& name : names_of_results()) {
      EXPECT_TRUE(is_result(name) || name.starts_with(".medial-vk.")) << name;
      const auto whole = points.find(name);
      EXPECT_TRUE(whole == points.end() || bytes_of("out/" + name) == whole->second) << name;
    }
    if (!exists("out/batch.csv")) return;
    for (const BatchRow& row : rows()) {
      if (row[BatchColumn::kState] == kBatchStarted) continue;
      EXPECT_TRUE(row.has_results()) << row[BatchColumn::kError];
      EXPECT_TRUE(exists("out/" + row[BatchColumn::kName] + ".medial.ply")) << row[BatchColumn::kName];
    }
  }
};

TEST_F(BatchKills, LoseTheMeshAtWorkAtMost) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(batch(arguments()).exit_code, 0);
  const std::chrono::duration<double> whole_run = std::chrono::steady_clock::now() - begin;
  std::map<std::string, std::string> points;
  for (const std::string& name : names_of_results()) {
    if (name.ends_with(".ply")) points[name] = bytes_of("out/" + name);
  }
  ASSERT_EQ(points.size(), static_cast<std::size_t>(kMeshes));
  constexpr int kKills = 100;
  for (int i = 0; i < kKills && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "kill " << i);
    if (i % 4 == 0) std::filesystem::remove_all(path("out"));  // else a run goes on from a killed one
    test::Tool tool(batch_call(arguments()));
    std::this_thread::sleep_for(whole_run * 1.1 * i / kKills);
    tool.send(SIGKILL);
    tool.wait();
    expect_whole(points);
  }
  // What a killed run has recorded is kept by the next one.
  std::map<std::string, std::filesystem::file_time_type> recorded;
  if (exists("out/batch.csv")) {
    for (const BatchRow& row : rows()) {
      if (!row.has_results()) continue;
      const std::string file = "out/" + row[BatchColumn::kName] + ".medial.ply";
      recorded[file] = time_of(file);
    }
  }
  ASSERT_EQ(batch(arguments()).exit_code, 0);
  for (const auto& [file, time] : recorded) EXPECT_EQ(time_of(file), time) << file;
  EXPECT_EQ(rows().size(), static_cast<std::size_t>(kMeshes));
  expect_whole(points);
  EXPECT_THAT(bytes_of("out/batch.html"), HasSubstr("5 meshes, 0 failed"));
}

/// Two runs with different options write files of the same names.
class BatchOtherOptions : public test::BatchCommand {
 protected:
  static constexpr int kMeshes = 3;

  BatchOtherOptions() {
    for (int i = 0; i < kMeshes; ++i) write_box("in/" + std::to_string(i) + ".obj", 0.4 + 0.1 * i);
  }

  static std::vector<std::string> with_angle(const std::string& angle) {
    return {"in", "-o", "out", "--ball-volumes", ".csv", "--object-angle", angle};
  }

  std::map<std::string, std::string> results() const {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : std::filesystem::directory_iterator(path("out"))) {
      const std::string name = entry.path().filename().string();
      if (name.find(".obj.") != std::string::npos) bytes[name] = bytes_of("out/" + name);
    }
    return bytes;
  }

  /// The files of each mesh that is done are those of its options.
  void expect_files_of_rows(const std::map<std::string, std::map<std::string, std::string>>& of_angle) const {
    for (const BatchRow& row : rows()) {
      if (!row.has_results()) continue;
      const std::string options = row[BatchColumn::kOptions];
      const auto& expected = of_angle.at(options.find("0.7") == std::string::npos ? "0.5" : "0.7");
      for (const char* const ending : {".medial.ply", ".volumes.csv"}) {
        const std::string name = row[BatchColumn::kName] + ending;
        EXPECT_EQ(bytes_of("out/" + name), expected.at(name)) << name;
      }
    }
  }
};

TEST_F(BatchOtherOptions, NoKillMixesTwoRuns) {
  std::map<std::string, std::map<std::string, std::string>> of_angle;
  const auto begin = std::chrono::steady_clock::now();
  for (const char* const angle : {"0.5", "0.7"}) {
    ASSERT_EQ(batch(with_angle(angle)).exit_code, 0);
    of_angle[angle] = results();
    ASSERT_EQ(of_angle[angle].size(), 2u * kMeshes);
  }
  const std::chrono::duration<double> both = std::chrono::steady_clock::now() - begin;
  ASSERT_NE(of_angle["0.5"], of_angle["0.7"]);
  constexpr int kKills = 40;
  for (int i = 0; i < kKills && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "kill " << i);
    test::Tool tool(batch_call(with_angle(i % 2 == 0 ? "0.5" : "0.7")));
    std::this_thread::sleep_for(both * 0.6 * i / kKills);
    tool.send(SIGKILL);
    tool.wait();
    expect_files_of_rows(of_angle);
    if (i % 8 != 7) continue;
    ASSERT_EQ(batch(with_angle("0.5")).exit_code, 0);
    EXPECT_EQ(results(), of_angle["0.5"]);
  }
}

// The system ends a process that writes a file beyond a limit of size. The limit leaves room in the table for a line
// that the mesh is begun, and none for the one that it is done.
TEST_F(BatchOtherOptions, AKillBeforeTheLineLeavesNoOlderLine) {
  ASSERT_EQ(batch(with_angle("0.7")).exit_code, 0);
  BatchRow started = rows().at(0);
  ASSERT_EQ(started[BatchColumn::kName], "0.obj");
  for (std::size_t i = 0; i < kBatchColumns; ++i) {
    const auto column = static_cast<BatchColumn>(i);
    const bool is_known = column == BatchColumn::kName || column == BatchColumn::kFile ||
                          column == BatchColumn::kFiles || column == BatchColumn::kOptions ||
                          column == BatchColumn::kVersion;
    if (!is_known) started[column].clear();
  }
  started[BatchColumn::kState] = kBatchStarted;
  const std::string done = encode_batch_row(rows().at(0)), begun = encode_batch_row(started);
  ASSERT_GT(done.size(), begun.size());
  ASSERT_EQ(batch(with_angle("0.5")).exit_code, 0);
  const auto before = results();
  BatchRow filling = started;  // so that the table is larger than any other file
  filling[BatchColumn::kName] = "long";
  filling[BatchColumn::kFile].clear();
  filling[BatchColumn::kState] = kBatchFailed;
  filling[BatchColumn::kError] = std::string(1 << 20, 'x');
  const std::string table = bytes_of("out/batch.csv") + encode_batch_row(filling);
  write("out/batch.csv", table);
  test::ToolCall call = batch_call(with_angle("0.7"));
  const std::uint64_t limit = table.size() + begun.size();
  call.arguments.insert(call.arguments.begin(), {"--fsize=" + std::to_string(limit), test::tool_path()});
  call.program = "/usr/bin/prlimit";
  EXPECT_EQ(run_tool(call).exit_code, 128 + SIGXFSZ);
  EXPECT_NE(bytes_of("out/0.obj.medial.ply"), before.at("0.obj.medial.ply"));
  const ToolResult again = batch(with_angle("0.5"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("1 done, 2 done before"));
  EXPECT_EQ(results(), before);
}

// A pipe that no one writes to keeps a run waiting for ever.
class BatchAtWork : public test::BatchCommand {
 protected:
  void make_pipe(const std::string& name) const { ASSERT_EQ(::mkfifo(path(name).c_str(), 0600), 0); }

  /// Kills a run as soon as the last line of the table begins so, and another one, if given, like `earlier`.
  void kill_at(const std::string& begin, const std::string& earlier = "") const {
    test::Tool tool(batch_call({"list.txt", "-o", "out"}));
    for (int i = 0; i < 6000 && tool.running(); ++i) {
      const std::string table = exists("out/batch.csv") ? bytes_of("out/batch.csv") : "";
      const std::size_t line = table.rfind("\n" + begin);
      const bool is_last = line != std::string::npos && table.find('\n', line + 1) == table.size() - 1;
      if (is_last && table.find("\n" + earlier) != std::string::npos) return tool.send(SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    FAIL() << begin << " is not there: " << bytes_of("out/batch.csv");
  }
};

TEST_F(BatchAtWork, AMeshThatEndsEveryRunComesLast) {
  for (const char* const mesh : {"in/0.obj", "in/1.obj"}) write_box(mesh, 0.5);
  for (const char* const pipe : {"p.obj", "q.obj"}) make_pipe(pipe);
  write("list.txt", "p.obj\nin/0.obj\nq.obj\nin/1.obj\n");
  kill_at("p.obj,started,");
  kill_at("q.obj,started,");  // in/0.obj before it
  EXPECT_THAT(states(), ElementsAre(Pair("in/0.obj", "done"), Pair("p.obj", "started"), Pair("q.obj", "started")));
  std::filesystem::remove(path("q.obj"));
  write_box("q.obj", 0.5);
  kill_at("p.obj,started,");  // in/1.obj before it, and q.obj after it: its run was a later one
  EXPECT_THAT(states(), ElementsAre(Pair("in/0.obj", "done"), Pair("in/1.obj", "done"), Pair("p.obj", "started"),
                                    Pair("q.obj", "started")));
  std::filesystem::remove(path("p.obj"));
  write_box("p.obj", 0.5);
  const ToolResult last = batch({"list.txt", "-o", "out", "-v"});
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("2 done, 2 done before"));
  EXPECT_LT(last.err.find("q.obj: "), last.err.find("p.obj: "));  // p.obj was begun once more since
}

// A mesh was done, and its file ends the process now that it is read again.
TEST_F(BatchAtWork, ADoneMeshWhoseFileEndsTheRunIsDoneNoMore) {
  for (const char* const mesh : {"p.obj", "q.obj"}) write_box(mesh, 0.5);
  write("one.txt", "p.obj\n");
  ASSERT_EQ(batch({"one.txt", "-o", "out"}).exit_code, 0);
  const std::string before = bytes_of("out/p.obj.medial.ply");
  const auto time = time_of("out/p.obj.medial.ply");
  const BatchRow done = rows().at(0);
  std::filesystem::rename(path("p.obj"), path("kept"));
  make_pipe("p.obj");
  write("list.txt", "p.obj\nq.obj\n");
  kill_at("p.obj,reading,");
  BatchRow reading = done;  // the file may be what it was
  reading[BatchColumn::kState] = kBatchReading;
  EXPECT_EQ(rows().at(0), reading);
  kill_at("p.obj,reading,", "q.obj,done,");  // it comes last
  EXPECT_THAT(states(), ElementsAre(Pair("p.obj", "reading"), Pair("q.obj", "done")));
  EXPECT_EQ(bytes_of("out/p.obj.medial.ply"), before);
  // The old file is back: nothing is lost.
  std::filesystem::rename(path("kept"), path("p.obj"));
  const ToolResult back = batch({"list.txt", "-o", "out"});
  EXPECT_THAT(back.err, HasSubstr("0 done, 2 done before"));
  EXPECT_EQ(rows().at(0), done);
  EXPECT_EQ(time_of("out/p.obj.medial.ply"), time);
  // Another file.
  std::filesystem::remove(path("p.obj"));
  make_pipe("p.obj");
  kill_at("p.obj,reading,");
  std::filesystem::remove(path("p.obj"));
  write_box("p.obj", 0.6);
  const ToolResult other = batch({"list.txt", "-o", "out"});
  EXPECT_THAT(other.err, HasSubstr("1 done, 1 done before"));
  EXPECT_NE(bytes_of("out/p.obj.medial.ply"), before);
}

}  // namespace
}  // namespace medial_vk
