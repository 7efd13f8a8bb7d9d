#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "platform/files.h"
#include "platform/paths.h"
#include "platform/processes.h"

namespace medial_vk::platform {
namespace {

/// A file descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

std::string read_all(int descriptor) {
  std::string bytes;
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(std::max<std::size_t>(1u << 16, 2 * used));
    const ssize_t got = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    used += static_cast<std::size_t>(got);
  }
  bytes.resize(used);
  return bytes;
}

/// Starts the program with these descriptors as its standard input and output. 0, or the error of the system.
int start(const std::string& program, const std::vector<std::string>& arguments, int input, int output,
          pid_t& process) {
  posix_spawn_file_actions_t actions;
  if (const int error = ::posix_spawn_file_actions_init(&actions); error != 0) return error;
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const std::string name = file_name_of(program);
  std::vector<const char*> words = {name.c_str()};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  words.push_back(nullptr);
  const int error =
      ::posix_spawn(&process, program.c_str(), &actions, nullptr, const_cast<char* const*>(words.data()), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// The reason for which a program ended that did not end well.
std::string reason_of(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return "it took too much time or memory";
  return fmt::format("it crashed ({})", ::strsignal(signal));
}

void set_limit(int resource, std::uint64_t soft) {
  rlimit limit = {};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) return;
  limit.rlim_cur = soft < limit.rlim_max ? soft : limit.rlim_max;
  ::setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

}  // namespace

std::vector<std::string> prepare_process(int count, char** arguments) {
  return {arguments + (count > 0 ? 1 : 0), arguments + count};
}

void end_process(int code) { ::_exit(code); }

std::string folder_of_program() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::string() : program.parent_path().string();
}

bool is_program(const std::string& path) { return ::access(path.c_str(), X_OK) == 0; }

std::optional<std::string> variable_of(const std::string& name) {
  const char* const value = std::getenv(name.c_str());
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

void set_variable(const std::string& name, const std::string& value, bool replace) {
  ::setenv(name.c_str(), value.c_str(), replace ? 1 : 0);
}

void unset_variable(const std::string& name) { ::unsetenv(name.c_str()); }

ProgramOutcome run_program(const std::string& program, const std::vector<std::string>& arguments, std::string input) {
  Descriptor file(::memfd_create("medial-vk-scene", MFD_CLOEXEC));
  if (file.number() < 0 || !write_all(file.number(), input) || ::lseek(file.number(), 0, SEEK_SET) != 0) {
    return {.code = errno, .has_input = false};
  }
  input = std::string();
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return {.code = errno, .has_input = false};
  const Descriptor from_program(ends[0]);
  Descriptor to_us(ends[1]);
  pid_t process = 0;
  if (const int error = start(program, arguments, file.number(), to_us.number(), process); error != 0) {
    return {.code = error};
  }
  to_us.close();
  file.close();
  ProgramOutcome outcome;
  outcome.output = read_all(from_program.number());
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) outcome.reason = reason_of(status);
  return outcome;
}

std::string_view standard_input_bytes() {
  struct stat status = {};
  if (::fstat(STDIN_FILENO, &status) != 0 || status.st_size <= 0) return {};
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, STDIN_FILENO, 0);
  if (at == MAP_FAILED) return {};
  return {static_cast<const char*>(at), size};
}

void limit_this_process() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  set_limit(RLIMIT_FSIZE, 0);
  set_limit(RLIMIT_CORE, 0);
}

void limit_use(std::uint64_t memory, std::uint64_t seconds) {
  if (memory > 0) set_limit(RLIMIT_AS, memory);
  set_limit(RLIMIT_CPU, seconds);
}

}  // namespace medial_vk::platform
