// A fixture for tests of `medial-vk batch`: small meshes in a folder, runs without a device, and the table.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/tool_test.h"
#include "output/batch_files/batch_table.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk::test {

class BatchCommand : public ToolTest {
 protected:
  /// A file in the scratch folder, with the folders above it.
  void write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    write_file(path(name), bytes);
  }

  void write_box(const std::string& name, double height) const { write(name, to_obj(make_box({1, 0.8, height}))); }

  ToolCall batch_call(std::vector<std::string> arguments, std::string standard_input = {}) const {
    arguments.insert(arguments.begin(), "batch");
    ToolCall made = cpu_call(std::move(arguments));
    made.standard_input = std::move(standard_input);
    return made;
  }
  ToolResult batch(std::vector<std::string> arguments, std::string standard_input = {}) const {
    return run_tool(batch_call(std::move(arguments), std::move(standard_input)));
  }

  std::string bytes_of(const std::string& name) const { return read_file(path(name)); }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

  std::vector<BatchRow> rows(const std::string& folder = "out") const {
    Result<BatchTable> table = decode_batch_table(bytes_of(folder + "/batch.csv"));
    EXPECT_TRUE(table.ok()) << table.error().message;
    return table.ok() ? std::move(table).value().rows : std::vector<BatchRow>();
  }

  /// State by name.
  std::map<std::string, std::string> states(const std::string& folder = "out") const {
    std::map<std::string, std::string> states;
    for (const BatchRow& row : rows(folder)) states[row[BatchColumn::kName]] = row[BatchColumn::kState];
    return states;
  }

  /// A file that is written anew has another time.
  std::filesystem::file_time_type time_of(const std::string& name) const {
    return std::filesystem::last_write_time(path(name));
  }
};

}  // namespace medial_vk::test
