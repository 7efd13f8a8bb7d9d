// A fixture for tests of the command line: a folder of its own, and runs in it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tool.h"

namespace medial_vk::test {

class ToolTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }

  ToolCall call(std::vector<std::string> arguments) const { return {std::move(arguments), path("")}; }

  /// A short run on the CPU, with further arguments.
  ToolCall cpu_call(std::vector<std::string> arguments) const {
    for (const char* argument : {"--backend", "cpu", "--resolution", "6"}) arguments.push_back(argument);
    return call(std::move(arguments));
  }

  ToolResult run(std::vector<std::string> arguments) const { return run_tool(call(std::move(arguments))); }
  ToolResult run_cpu(std::vector<std::string> arguments) const { return run_tool(cpu_call(std::move(arguments))); }

  ScratchFolder folder_;
};

}  // namespace medial_vk::test
