#include "scene_files/scene_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "input/text_scanner.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;

#if !defined(MEDIAL_VK_HELPERS_FROM_BIN)
#define MEDIAL_VK_HELPERS_FROM_BIN "../libexec/medial-vk"
#endif
constexpr const char* kProgram = "medial-vk-read-scene";

/// Beside this program in a build, and in the folder of helpers after installation. Empty: in neither.
std::string find_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  for (const fs::path& path : {folder / kProgram, folder / MEDIAL_VK_HELPERS_FROM_BIN / kProgram}) {
    if (::access(path.c_str(), X_OK) == 0) return path.string();
  }
  return {};
}

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

Error system_error(const std::string& name, const char* what, int code) {
  const bool is_memory = code == ENOMEM || code == ENOSPC;
  const std::string message = fmt::format("{}: cannot {}: {}", name, what, std::strerror(code));
  return {is_memory ? ErrorCode::kOutOfMemory : ErrorCode::kInvalidMesh, message};
}

bool write_all(int descriptor, const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(descriptor, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return ::lseek(descriptor, 0, SEEK_SET) == 0;
}

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

/// Starts the program with these descriptors as its standard input and output. 0, or the error of the system. It gets
/// no standard error: what assimp and the C library print there is no message of this program.
int start(const std::string& program, const SceneFile& file, int input, int output, pid_t& process) {
  posix_spawn_file_actions_t actions;
  if (const int error = ::posix_spawn_file_actions_init(&actions); error != 0) return error;
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const char* const arguments[] = {kProgram, file.name.c_str(), file.format.c_str(), file.path.c_str(), nullptr};
  const int error =
      ::posix_spawn(&process, program.c_str(), &actions, nullptr, const_cast<char* const*>(arguments), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// The reason for which a program ended that wrote no scene.
std::string reason_of(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return "it took too much time or memory";
  return fmt::format("it crashed ({})", ::strsignal(signal));
}

}  // namespace

Result<std::vector<ScenePart>> read_scene_apart(SceneFile file) {
  const std::string program = find_program();
  if (program.empty()) {
    return file_error(file.name, fmt::format("the program {} is missing, in which assimp reads .{} files; it is "
                                             "installed with medial-vk",
                                             kProgram, file.format));
  }
  Descriptor input(::memfd_create("medial-vk-scene", MFD_CLOEXEC));
  if (input.number() < 0 || !write_all(input.number(), file.bytes)) {
    return system_error(file.name, "hand it to assimp", errno);
  }
  file.bytes = std::string();
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return system_error(file.name, "hand it to assimp", errno);
  const Descriptor from_program(ends[0]);
  Descriptor to_us(ends[1]);
  pid_t process = 0;
  if (const int error = start(program, file, input.number(), to_us.number(), process); error != 0) {
    return system_error(file.name, "start the program that reads it", error);
  }
  to_us.close();
  input.close();
  const std::string bytes = read_all(from_program.number());
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return file_error(file.name, fmt::format("assimp failed on this .{} file: {}", file.format, reason_of(status)));
  }
  Result<std::vector<ScenePart>> parts = decode_scene(bytes);
  if (!parts && parts.error().code == ErrorCode::kInternal) {
    return Error{ErrorCode::kInternal, fmt::format("{}: {}", file.name, parts.error().message)};
  }
  return parts;
}

}  // namespace medial_vk
