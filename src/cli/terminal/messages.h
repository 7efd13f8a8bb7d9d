// Messages of all commands, and their output.
#pragma once

#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// The error of an interrupted run: kInterrupted.
Error stopped();

/// Messages of the library name its parameters in backticks; the result names the options of the tool instead.
std::string in_words_of_options(std::string message);

/// The exit code of an error.
int exit_code(ErrorCode code);

/// An error kNoDevice with a remedy appended; others unchanged. `wanted` is the argument of --device, or empty.
Error with_hint(Error error, const std::string& wanted = {});

/// Writes to standard output. Error: kCannotWrite.
Status print_result(const std::string& text);
/// Writes to standard error.
void print_message(const std::string& text);

/// Prints "medial-vk: message", with a hint at the help of `command` for a usage error. Returns the exit code.
int report_error(const Error& error, const char* command);

}  // namespace medial_vk::cli
