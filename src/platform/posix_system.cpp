#include <dlfcn.h>
#include <fcntl.h>
#include <grp.h>
#include <link.h>
#include <malloc.h>
#include <sys/auxv.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "platform/files.h"
#include "platform/libraries.h"
#include "platform/machine.h"
#include "platform/signals.h"
#include "platform/terminal.h"

namespace medial_vk::platform {
namespace {

std::atomic<void (*)()> stop_handler{nullptr};
static_assert(std::atomic<void (*)()>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void request_stop(int) {
  if (void (*const handler)() = stop_handler) handler();
  // From here on either signal ends the program. signal() is safe in a handler.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

std::string alarm_message;  // made before a signal can come

extern "C" void say_alarm(int) {
  const int before = errno;  // of the code that the signal interrupts
  write_all(STDERR_FILENO, alarm_message);
  errno = before;
}

/// The reason of the last dlopen() that failed.
std::string dl_problem() {
  const char* const problem = ::dlerror();
  return problem != nullptr ? problem : "unknown reason";
}

}  // namespace

void on_request_to_stop(void (*handler)()) {
  stop_handler = handler;
  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // Reads and writes in progress continue; the flag is tested between them.
  for (const int signal : {SIGINT, SIGTERM}) {
    // A shell that starts a job in the background, and nohup, make it ignore signals on purpose; they remain ignored.
    struct sigaction before = {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);  // A closed pipe is a failed write, with exit code 6.
}

int run_apart_from_signals(const std::function<int()>& work) { return work(); }

void set_alarm(unsigned seconds, const std::string& message) {
  alarm_message = message;
  std::signal(SIGALRM, say_alarm);
  ::alarm(seconds);
}

void cancel_alarm() { ::alarm(0); }

bool has_terminal() { return ::isatty(STDERR_FILENO) == 1; }

void* load_library(const std::string& name, std::string& problem) {
  void* const library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  problem = library == nullptr ? dl_problem() : std::string();
  return library;
}

void* load_vulkan(std::string& problem) {
  if (void* const library = load_library("libvulkan.so.1", problem)) return library;
  const std::string first = problem;
  void* const library = load_library("libvulkan.so", problem);
  if (library == nullptr) problem = first;
  return library;
}

void* function_of(void* library, const char* name) { return ::dlsym(library, name); }

std::string file_of(void* library) {
  link_map* map = nullptr;
  if (::dlinfo(library, RTLD_DI_LINKMAP, &map) != 0 || map == nullptr || map->l_name == nullptr) return {};
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(map->l_name, error);
  return error ? map->l_name : real.string();
}

std::string system_name() { return {}; }

std::string kernel_name() {
  utsname names = {};
  if (::uname(&names) != 0) return "unknown kernel";
  return std::string(names.sysname) + " " + names.release + ", " + names.machine;
}

void return_large_blocks() {
#if defined(__GLIBC__)
  constexpr int kLeastBytes = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kLeastBytes);  // a limit that is set stays, instead of growing with freed blocks
#endif
}

bool has_more_rights() { return ::getauxval(AT_SECURE) != 0; }

std::string group_of(const std::string& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0) return {};
  const group* found = ::getgrgid(status.st_gid);  // of the process, which has one thread
  return found != nullptr ? found->gr_name : std::to_string(status.st_gid);
}

std::string why_not_open(const std::string& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return std::strerror(errno);
  ::close(descriptor);
  return {};
}

std::vector<std::string> registered_drivers() { return {}; }
std::vector<std::string> registered_adapters() { return {}; }

}  // namespace medial_vk::platform
