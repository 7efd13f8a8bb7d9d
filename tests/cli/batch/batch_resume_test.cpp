// `medial-vk batch` goes on where an earlier run ended: what is done is not done again, and what has changed is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "cli/batch/batch_command.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

class BatchResume : public test::BatchCommand {
 protected:
  BatchResume() {
    write_box("in/a.obj", 0.5);
    write_box("in/b.obj", 0.6);
    write("in/c.obj", "f 1 2 3\n");
  }

  ToolResult go(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"in", "-o", "out"});
    return batch(std::move(more));
  }

  /// Of the meshes, those whose points another run has written since.
  std::vector<std::string> written_since(const std::map<std::string, std::filesystem::file_time_type>& before) const {
    std::vector<std::string> written;
    for (const auto& [name, time] : before) {
      if (!exists("out/" + name + ".medial.ply") || time_of("out/" + name + ".medial.ply") != time) {
        written.push_back(name);
      }
    }
    return written;
  }
  std::map<std::string, std::filesystem::file_time_type> times() const {
    return {{"a.obj", time_of("out/a.obj.medial.ply")}, {"b.obj", time_of("out/b.obj.medial.ply")}};
  }
};

TEST_F(BatchResume, WhatIsDoneIsNotDoneAgain) {
  EXPECT_EQ(go().exit_code, 9);
  const auto before = times();
  const ToolResult again = go({"--threads", "2", "-v"});
  EXPECT_EQ(again.exit_code, 9);
  EXPECT_THAT(again.err, HasSubstr("0 done, 2 done before, 1 failed"));
  EXPECT_THAT(written_since(before), ElementsAre());
  // The same triangles in another file of the same name are the same mesh.
  write("in/a.obj", "# a comment\n" + bytes_of("in/a.obj"));
  EXPECT_EQ(go().exit_code, 9);
  EXPECT_THAT(written_since(before), ElementsAre());
  // A failure is tried again.
  write_box("in/c.obj", 0.7);
  const ToolResult mended = go();
  EXPECT_EQ(mended.exit_code, 0);
  EXPECT_THAT(mended.err, HasSubstr("1 done, 2 done before\n"));
  EXPECT_THAT(written_since(before), ElementsAre());
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("b.obj", "done"), Pair("c.obj", "done")));
}

TEST_F(BatchResume, WhatHasChangedIsDoneAgain) {
  EXPECT_EQ(go().exit_code, 9);
  auto before = times();
  write_box("in/a.obj", 0.55);
  EXPECT_EQ(go().exit_code, 9);
  EXPECT_THAT(written_since(before), ElementsAre("a.obj"));
  before = times();
  std::filesystem::remove(path("out/b.obj.medial.ply"));
  EXPECT_EQ(go().exit_code, 9);
  EXPECT_TRUE(exists("out/b.obj.medial.ply"));
  before = times();
  EXPECT_EQ(go({"--object-angle", "0.7"}).exit_code, 9);
  EXPECT_THAT(written_since(before), ElementsAre("a.obj", "b.obj"));
  // Another version of the program.
  before = times();
  std::string table = bytes_of("out/batch.csv");
  const std::size_t line = table.find("\nb.obj");
  const std::size_t end = table.find('\n', line + 1);
  table.insert(end, "-old");
  write("out/batch.csv", table);
  EXPECT_EQ(go({"--object-angle", "0.7"}).exit_code, 9);
  EXPECT_THAT(written_since(before), ElementsAre("b.obj"));
}

TEST_F(BatchResume, AMeshThatFailsNowKeepsNoResultsOfThePast) {
  EXPECT_EQ(go().exit_code, 9);
  write("in/a.obj", "f 1 2 3\n");
  EXPECT_EQ(go().exit_code, 9);
  EXPECT_FALSE(exists("out/a.obj.medial.ply"));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "failed"), Pair("b.obj", "done"), Pair("c.obj", "failed")));
}

TEST_F(BatchResume, MeshesOfEarlierRunsStayInTheTable) {
  EXPECT_EQ(go().exit_code, 9);
  write_box("more/d.obj", 0.5);
  EXPECT_EQ(batch({"more", "-o", "out"}).exit_code, 0);
  ASSERT_EQ(rows().size(), 4u);
  EXPECT_EQ(rows().at(0)[BatchColumn::kName], "d.obj");
  EXPECT_THAT(go().err, HasSubstr("2 done before"));
}

TEST_F(BatchResume, ATableThatWasCutOffIsReadAsFarAsItGoes) {
  EXPECT_EQ(go().exit_code, 9);
  const std::string table = bytes_of("out/batch.csv");
  const std::size_t line = table.find("\nb.obj");
  for (const std::size_t length : {line + 4, line + 60}) {
    const auto before = times();
    write("out/batch.csv", table.substr(0, length));
    EXPECT_THAT(go().err, HasSubstr("1 done, 1 done before, 1 failed"));
    EXPECT_THAT(written_since(before), ElementsAre("b.obj"));
    EXPECT_EQ(rows().size(), 3u);
  }
}

class BatchSignals : public test::BatchCommand, public testing::WithParamInterface<int> {};

TEST_P(BatchSignals, KeepWhatIsDone) {
  for (int i = 0; i < 400; ++i) write_box("in/" + std::to_string(1000 + i) + ".obj", 0.4 + 0.001 * i);
  test::Tool tool(batch_call({"in", "-o", "out"}));
  const auto lines = [&] {
    const std::string table = bytes_of("out/batch.csv");
    return std::count(table.begin(), table.end(), '\n');
  };
  // A line at the beginning of each mesh, and one at its end.
  while (tool.running() && lines() < 8) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(tool.running());
  tool.send(GetParam());
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted; the meshes that are done are kept"));
  EXPECT_THAT(result.err, Not(HasSubstr("nothing was written")));
  std::size_t done = 0;
  for (const BatchRow& row : rows()) done += row.is_done() ? 1 : 0;
  EXPECT_GE(done, 3u);
  ASSERT_LT(done, 400u);
  const ToolResult rest = batch({"in", "-o", "out"});
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr(std::to_string(400 - done) + " done, " + std::to_string(done) + " done before"));
}

INSTANTIATE_TEST_SUITE_P(, BatchSignals, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace medial_vk
