// Runs the command line under test as its users do: a process with arguments, streams and an exit code.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace medial_vk::test {

/// A folder of its own for one test, removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Names of the files in it, in order.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path folder_;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);

struct ToolResult {
  int exit_code = -1;  ///< 128 + signal if a signal killed it.
  std::string out;
  std::string err;
};

struct ToolCall {
  std::vector<std::string> arguments;
  std::string folder;                                   ///< Working folder.
  std::string standard_input = {};                      ///< Its bytes.
  std::map<std::string, std::string> environment = {};  ///< Added to the test's own.
  std::uint64_t address_space = 0;                      ///< Limit in bytes, 0: none.
  std::string program = {};                             ///< Empty: the tool as it was built.
  bool endless_input = false;  ///< After these bytes standard input neither delivers more nor ends.
};

/// A running process. The destructor kills a process that has not been waited for.
class Tool {
 public:
  explicit Tool(const ToolCall& call);
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;
  ~Tool();

  void send(int signal) const;
  bool running();
  /// Of the processor, in all threads so far.
  double seconds_of_processor();
  ToolResult wait();

 private:
  pid_t process_ = -1;
  int input_ = -1;  // the end of a pipe that keeps it open
  int status_ = 0;
  rusage usage_ = {};  // once it has ended
  bool ended_ = false;
  ScratchFolder streams_;
};

/// Runs to the end.
ToolResult run_tool(const ToolCall& call);

}  // namespace medial_vk::test
