// What `medial-vk batch` takes for a mesh, and what it refuses by name before it makes anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/batch/batch_command.h"
#include "cli/paths.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

namespace fs = std::filesystem;

using BatchInputs = test::BatchCommand;

TEST_F(BatchInputs, LinksInCirclesEndNoSearch) {
  write_box("in/a.obj", 0.5);
  fs::create_symlink("loop.obj", path("in/loop.obj"));
  fs::create_symlink("loop", path("in/loop"));
  fs::create_symlink(".", path("in/here"));
  const ToolResult result = batch({"in", "-o", "out"});
  EXPECT_EQ(result.exit_code, 9) << result.err;
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("loop.obj", "failed")));
}

TEST_F(BatchInputs, AnUnreadableFolderIsNamed) {
  write_box("in/a.obj", 0.5);
  write_box("in/deep/closed/b.obj", 0.5);
  fs::permissions(path("in/deep/closed"), fs::perms::none);
  test::ToolCall call = batch_call({"in", "-o", "out"});
  if (::geteuid() == 0) {  // whom no permission stops
    fs::permissions(path(""), fs::perms::all);
    call.arguments.insert(call.arguments.begin(), {"--reuid=65534", "--clear-groups", test::tool_path()});
    call.program = "/usr/bin/setpriv";
  }
  const ToolResult result = run_tool(call);
  fs::permissions(path("in/deep/closed"), fs::perms::owner_all);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("in/deep/closed: Permission denied"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(BatchInputs, WhatIsNotThereIsRefusedBeforeAnythingIsMade) {
  write_box("in/a.obj", 0.5);
  fs::create_symlink("nowhere", path("link.obj"));
  for (const char* const input : {"none.obj", "none", "none.txt", "link.obj"}) {
    const ToolResult result = batch({"in", input, "-o", "out"});
    EXPECT_EQ(result.exit_code, 3) << input;
    EXPECT_THAT(result.err, HasSubstr(std::string(input) + ": No such file or directory"));
    EXPECT_FALSE(exists("out"));
  }
}

TEST_F(BatchInputs, ListsHoldMeshesAlone) {
  write_box("in/a.obj", 0.5);
  const std::pair<const char*, const char*> refused[] = {{"in/a.obj\nin\n", "list.txt:2: in is a folder"},
                                                         {"-\n", "list.txt:1: - is no path"}};
  for (const auto& [list, message] : refused) {
    write("list.txt", list);
    const ToolResult result = batch({"list.txt", "-o", "out"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(exists("out"));
  }
}

TEST_F(BatchInputs, ResultsOfEarlierRunsAndHiddenNamesAreNoMeshes) {
  write_box("in/a.obj", 0.5);
  write_box("in/.hidden.obj", 0.5);
  write_box("in/.git/b.obj", 0.5);
  write_box("in/tables/c.obj", 0.5);
  write("in/tables/batch.csv", "name,price\n");  // of no batch
  ASSERT_EQ(batch({"in", "-o", "in/r1", "--mesh-spheres"}).exit_code, 0);
  ASSERT_TRUE(exists("in/r1/a.obj.spheres.ply"));
  ASSERT_EQ(run({"in/a.obj", "-o", "in/a.medial.ply", "--backend", "cpu", "--resolution", "6"}).exit_code, 0);
  ASSERT_EQ(batch({"in", "-o", "out"}).exit_code, 0);
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("tables/c.obj", "done")));
}

TEST_F(BatchInputs, OneFileByTwoPathsIsOneMesh) {
  write_box("in/a.obj", 0.5);
  fs::create_symlink("a.obj", path("in/b.obj"));
  fs::create_symlink("in", path("link"));
  ASSERT_EQ(batch({"in", "link/a.obj", path("in/a.obj"), "in/../in/a.obj", "-o", "out"}).exit_code, 0);
  EXPECT_THAT(states(), ElementsAre(Pair("in/a.obj", "done")));
}

TEST_F(BatchInputs, ALineBreakInANameIsOneFailure) {
  write_box("in/a\nb.obj", 0.5);
  write_box("in/c.obj", 0.5);
  const ToolResult result = batch({"in", "-o", "out"});
  EXPECT_EQ(result.exit_code, 9);
  EXPECT_THAT(states(), ElementsAre(Pair("a\\nb.obj", "failed"), Pair("c.obj", "done")));
  EXPECT_THAT(rows().at(0)[BatchColumn::kError], HasSubstr("several lines"));
}

TEST_F(BatchInputs, ASignalEndsTheWaitForAList) {
  test::ToolCall call = batch_call({"-", "-o", "out"}, "in/a.obj\n");
  call.endless_input = true;
  test::Tool tool(call);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ASSERT_TRUE(tool.running());
  tool.send(SIGINT);
  for (int i = 0; i < 1000 && tool.running(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_FALSE(tool.running());
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted; nothing was written"));
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace medial_vk
