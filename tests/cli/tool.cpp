#include "tool.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "paths.h"

namespace medial_vk::test {
namespace {

namespace fs = std::filesystem;

void redirect(const std::string& path, int flags, int descriptor) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
}

[[noreturn]] void become_tool(const ToolCall& call, const ScratchFolder& streams) {
  redirect(streams.path("in"), O_RDONLY, STDIN_FILENO);
  redirect(streams.path("out"), O_WRONLY | O_CREAT, STDOUT_FILENO);
  redirect(streams.path("err"), O_WRONLY | O_CREAT, STDERR_FILENO);
  for (const int ended_by : {SIGINT, SIGTERM}) ::signal(ended_by, SIG_DFL);  // Tests may run where they are ignored.
  if (::chdir(call.folder.c_str()) != 0) ::_exit(126);
  for (const auto& [name, value] : call.environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (call.address_space > 0) {
    const rlimit limit = {call.address_space, call.address_space};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) ::_exit(126);
  }
  std::vector<std::string> arguments = call.arguments;
  std::vector<char*> pointers;
  std::string program = call.program.empty() ? tool_path() : call.program;
  pointers.push_back(program.data());
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  ::_exit(127);
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = testing::TempDir() + "medial_vk_cli_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) std::abort();
  folder_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<std::string> ScratchFolder::names() const {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder_)) out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

Tool::Tool(const ToolCall& call) {
  const std::string in = streams_.path("in");
  if (call.endless_input) {
    if (::mkfifo(in.c_str(), 0600) != 0) std::abort();
    input_ = ::open(in.c_str(), O_RDWR | O_CLOEXEC);
  }
  write_file(in, call.standard_input);
  process_ = ::fork();
  if (process_ == 0) become_tool(call, streams_);
}

Tool::~Tool() {
  if (process_ > 0 && running()) {
    send(SIGKILL);
    wait();
  }
  if (input_ >= 0) ::close(input_);
}

void Tool::send(int signal) const { ::kill(process_, signal); }

bool Tool::running() {
  if (!ended_) ended_ = ::wait4(process_, &status_, WNOHANG, &usage_) == process_;
  return !ended_;
}

double Tool::seconds_of_processor() {
  if (running()) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) std::abort();
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage_.ru_utime) + seconds(usage_.ru_stime);
}

ToolResult Tool::wait() {
  if (!ended_) ended_ = ::wait4(process_, &status_, 0, &usage_) == process_;
  ToolResult result;
  result.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  result.out = read_file(streams_.path("out"));
  result.err = read_file(streams_.path("err"));
  return result;
}

ToolResult run_tool(const ToolCall& call) { return Tool(call).wait(); }

}  // namespace medial_vk::test
