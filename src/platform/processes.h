// Processes: this one, and others that it starts.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace medial_vk::platform {

/// The command line of main() without the name of the program, in UTF-8. Standard streams carry bytes afterwards, and a
/// console shows UTF-8.
std::vector<std::string> prepare_process(int count, char** arguments);

/// Runs at once, without destructors, and from handlers of signals, too.
[[noreturn]] void end_process(int code);

/// The folder of the running program; empty: unknown.
std::string folder_of_program();
bool is_program(const std::string& path);

/// The value of an environment variable in UTF-8; none: it is not set.
std::optional<std::string> variable_of(const std::string& name);
void set_variable(const std::string& name, const std::string& value, bool replace);
void unset_variable(const std::string& name);

enum class ChildEnd {
  kDone,     ///< `work` returned.
  kCrashed,  ///< The system ended the process, or it ended by itself before `work` returned.
  kTooLong,  ///< It was ended after the time limit.
};

struct ChildOutcome {
  ChildEnd end = ChildEnd::kCrashed;
  std::string how = {};       ///< If not done: "crashed: Segmentation fault (signal 11)", "did not end within 60 s".
  std::string result = {};    ///< What `work` returned.
  std::string messages = {};  ///< What was written to standard output and standard error meanwhile, shortened if long.
};

/// More than any result, and more messages than anyone reads: a driver that writes without end fills no memory.
inline constexpr std::size_t kMostResult = std::size_t{16} << 20, kMostMessages = std::size_t{64} << 10;

/// Runs `work` in another process, which begins like a copy of this one, and waits for it, at most for `limit`.
/// Standard input is empty there; nothing that it writes appears, and no core file. It ends with this process. On
/// Windows, which copies no process, the program runs again with the same command line, and calls before this one
/// return there what they returned here: what the program does between must follow from these results. Precondition: no
/// other thread runs; the result is not empty. `problem`: empty, or why the system refuses a process.
ChildOutcome run_in_child(const std::function<std::string()>& work, std::chrono::milliseconds limit,
                          std::string& problem);

struct ProgramOutcome {
  int code = 0;             ///< Not 0: the errno for which it was not started.
  bool has_input = true;    ///< Then: false if already its input could not be put aside for it.
  std::string reason = {};  ///< Empty: it ended with exit code 0. Else "it crashed (Segmentation fault)" or the like.
  std::string output = {};
};

/// Starts a program with `input` as its standard input, which is freed, and waits for its end. It gets no standard
/// error.
ProgramOutcome run_program(const std::string& program, const std::vector<std::string>& arguments, std::string input);

/// Standard input as it lies in memory; empty if it is no file.
std::string_view standard_input_bytes();

/// Bounds the memory and the processor time of this process, and lets it write no file. It ends with the one that
/// started it. A memory of 0: no bound.
void limit_this_process();
void limit_use(std::uint64_t memory, std::uint64_t seconds);

}  // namespace medial_vk::platform
