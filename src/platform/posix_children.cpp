#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <utility>

#include "platform/files.h"
#include "platform/processes.h"

namespace medial_vk::platform {
namespace {

using Clock = std::chrono::steady_clock;

/// A process that waits in the kernel, for instance for a GPU that hangs, does not even end when it is killed.
constexpr std::chrono::seconds kPatienceAfterKill(5);

/// Closes both ends.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) ends_ = {-1, -1};
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_reader();
    close_writer();
  }
  bool is_open() const { return reader() >= 0; }
  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close_reader() { close_end(ends_[0]); }
  void close_writer() { close_end(ends_[1]); }

 private:
  static void close_end(int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }
  std::array<int, 2> ends_ = {-1, -1};
};

/// Without the destructors of this copy's objects, and of drivers, whose end is not the subject. A failed write: the
/// parent is gone.
[[noreturn]] void run_and_exit(const std::function<std::string()>& work, const Pipe& result, const Pipe& messages,
                               pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);  // it ended before the call
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(messages.writer(), STDOUT_FILENO);
  ::dup2(messages.writer(), STDERR_FILENO);
  try {
    write_all(result.writer(), work());
    ::_exit(EXIT_SUCCESS);
  } catch (const std::exception& error) {
    write_all(STDERR_FILENO, fmt::format("{}\n", error.what()));
  }
  ::_exit(EXIT_FAILURE);
}

/// Appends what can be read now, as far as it is no more than `most` in all. False at the end of the stream.
bool drain(int file, std::string& bytes, std::size_t most) {
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = ::read(file, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN;
    if (count == 0) return false;
    bytes.append(buffer.data(), std::min(static_cast<std::size_t>(count), most - bytes.size()));
  }
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("crashed: {} (signal {})", ::strsignal(WTERMSIG(status)), WTERMSIG(status));
  }
  return fmt::format("ended early, with exit status {}", WEXITSTATUS(status));
}

std::string seconds_text(std::chrono::milliseconds time) {
  return fmt::format("{:.3g} s", std::chrono::duration<double>(time).count());
}

/// Reads from a child until it has ended.
class Watch {
 public:
  Watch(pid_t child, int result, int messages) : child_(child), files_{{{result, POLLIN, 0}, {messages, POLLIN, 0}}} {
    for (const pollfd& file : files_) ::fcntl(file.fd, F_SETFL, O_NONBLOCK);
  }

  ChildOutcome wait(std::chrono::milliseconds limit) {
    const Clock::time_point end = Clock::now() + limit;
    while (!has_ended() && Clock::now() < end) read_for_a_moment();
    if (ended_) return done();
    ::kill(child_, SIGKILL);
    while (!has_ended() && Clock::now() < end + kPatienceAfterKill) read_for_a_moment();
    read_for_a_moment();
    outcome_.end = ChildEnd::kTooLong;
    outcome_.how = fmt::format("did not end within {}{}", seconds_text(limit),
                               ended_ ? "" : ", nor when it was killed: it waits in the kernel");
    return std::move(outcome_);
  }

 private:
  bool has_ended() {
    if (!ended_) ended_ = ::waitpid(child_, &status_, WNOHANG) == child_;
    return ended_;
  }

  void read_for_a_moment() {
    constexpr int kMilliseconds = 5;
    ::poll(files_.data(), files_.size(), kMilliseconds);
    // A file at its end is left out, since poll() would return at once.
    if (files_[0].fd >= 0 && !drain(files_[0].fd, outcome_.result, kMostResult)) files_[0].fd = -1;
    if (files_[1].fd >= 0 && !drain(files_[1].fd, outcome_.messages, kMostMessages)) files_[1].fd = -1;
  }

  ChildOutcome done() {
    read_for_a_moment();  // what it wrote last
    const bool returned = WIFEXITED(status_) && WEXITSTATUS(status_) == EXIT_SUCCESS && !outcome_.result.empty();
    outcome_.end = returned ? ChildEnd::kDone : ChildEnd::kCrashed;
    if (!returned) outcome_.how = how_it_ended(status_);
    return std::move(outcome_);
  }

  pid_t child_;
  std::array<pollfd, 2> files_;
  ChildOutcome outcome_;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace

ChildOutcome run_in_child(const std::function<std::string()>& work, std::chrono::milliseconds limit,
                          std::string& problem) {
  Pipe result, messages;
  if (!result.is_open() || !messages.is_open()) {
    problem = fmt::format("no pipe to another process: {}", std::strerror(errno));
    return {};
  }
  for (std::FILE* stream : {stdout, stderr}) std::fflush(stream);  // or the copy would write it, too
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) {
    problem = fmt::format("no other process: {}", std::strerror(errno));
    return {};
  }
  if (child == 0) run_and_exit(work, result, messages, parent);
  result.close_writer();
  messages.close_writer();
  return Watch(child, result.reader(), messages.reader()).wait(limit);
}

}  // namespace medial_vk::platform
