// The tool is killed a hundred times, at moments spread over a run: files are the previous ones, or whole new ones, or
// absent, and there are no others. This holds for every kind of file that the program writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::read_file;

struct Job {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string>
      files;  // of the run; reports, which hold times, end in .json, pages, which hold a report, in .html
};

void PrintTo(const Job& job, std::ostream* out) { *out << job.name; }

class Kills : public test::ToolTest, public testing::WithParamInterface<Job> {
 protected:
  static constexpr int kKills = 100;
  static constexpr const char* kOld = "the earlier content";

  Kills() {
    Mesh part = test::make_l_shape(2.0, 0.6, 0.8);
    test::rotate(part, {1, 2, 3}, 0.4);
    test::write_file(path("part.obj"), test::to_obj(part));
  }

  /// Seconds of a run that is not killed. Records the files that it writes.
  std::chrono::duration<double> run_whole() {
    const auto begin = std::chrono::steady_clock::now();
    const test::ToolResult result = run(GetParam().arguments);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const std::string& file : GetParam().files) whole_[file] = read_file(path(file));
    EXPECT_EQ(folder_.names().size(), whole_.size() + 1) << testing::PrintToString(folder_.names());
    return seconds;
  }

  /// True if these are the bytes that a whole run writes, up to the times in them.
  bool is_whole(const std::string& file, const std::string& bytes) const {
    if (file.ends_with(".json")) return nlohmann::json::accept(bytes);
    if (file.ends_with(".html")) return bytes.ends_with(whole_.at(file).substr(whole_.at(file).size() - 64));
    return bytes == whole_.at(file);
  }

  void reset(bool with_files) {
    for (const auto& [file, bytes] : whole_) {
      std::filesystem::remove(path(file));
      if (with_files) test::write_file(path(file), kOld);
    }
  }

  /// The tool was killed between the two calls that replace a file: the file that remains under another name is whole.
  void expect_whole_leftover(bool had_files) {
    std::size_t left_over = 0;
    for (const std::string& name : folder_.names()) {
      if (!name.starts_with(".medial-vk.")) continue;
      const std::string bytes = read_file(path(name));
      bool whole = false;
      for (const auto& [file, expected] : whole_) whole = whole || is_whole(file, bytes);
      EXPECT_TRUE(had_files && whole) << name << ", " << bytes.size() << " bytes";
      std::filesystem::remove(path(name));
      ++left_over;
    }
    EXPECT_LE(left_over, 1u);
  }

  /// Returns the number of new files.
  int expect_whole_files(bool had_files) {
    std::size_t there = 0;
    int replaced = 0;
    for (const auto& [file, expected] : whole_) {
      if (!std::filesystem::exists(path(file))) {
        EXPECT_FALSE(had_files) << file << " is gone";
        continue;
      }
      ++there;
      const std::string now = read_file(path(file));
      const bool is_old = had_files && now == kOld;
      EXPECT_TRUE(is_old || is_whole(file, now)) << file << ", " << now.size() << " bytes";
      replaced += is_old ? 0 : 1;
    }
    EXPECT_EQ(folder_.names().size(), there + 1) << testing::PrintToString(folder_.names());
    return replaced;
  }

 private:
  std::map<std::string, std::string> whole_;  // by file: the result of a whole run
};

TEST_P(Kills, LeaveWholeFilesOrNone) {
  const std::chrono::duration<double> whole_run = run_whole();
  int replaced = 0;
  for (int i = 0; i < kKills && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "kill " << i);
    const bool had_files = i % 2 == 0;
    reset(had_files);
    test::Tool tool({GetParam().arguments, path("")});
    std::this_thread::sleep_for(whole_run * 1.1 * i / kKills);
    tool.send(SIGKILL);
    tool.wait();
    expect_whole_leftover(had_files);
    replaced += expect_whole_files(had_files);
  }
  RecordProperty("files_written_before_the_kill", replaced);
}

std::vector<Job> jobs() {
  return {
      {"Points",
       {"part.obj", "--backend", "cpu", "-o", "p.ply", "--report", "r.json", "--resolution", "16"},
       {"p.ply", "r.json"}},
      {"AllFiles",
       {"part.obj", "--backend",      "cpu",   "--resolution",  "10",   "-o",     "p.ply",  "--report",
        "r.json",   "--picture",      "p.png", "--size",        "120",  "--html", "p.html", "--medial-mesh",
        "m.ma",     "--ball-volumes", "v.csv", "--sheet-curve", "c.svg"},
       {"p.ply", "r.json", "p.png", "p.html", "m.ma", "v.csv", "c.svg"}},
      {"Spheres",
       {"spheres", "part.obj", "--method", "source", "--count", "8", "--backend", "cpu", "-o", "s.csv", "--report",
        "r.json", "--picture", "p.png"},
       {"s.csv", "r.json", "p.png"}},
  };
}

INSTANTIATE_TEST_SUITE_P(, Kills, testing::ValuesIn(jobs()), [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace medial_vk
