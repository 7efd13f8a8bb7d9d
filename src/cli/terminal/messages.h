// What every command says, and how.
#pragma once

#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// What an interrupted run says: kInterrupted.
Error stopped();

/// Messages of the library name its parameters, in backticks; this names the options of the tool instead.
std::string in_words_of_options(std::string message);

/// The exit code that stands for an error.
int exit_code(ErrorCode code);

/// An error kNoDevice with what to do about it; others as they are. `wanted` is what --device named, or empty.
Error with_hint(Error error, const std::string& wanted = {});

/// To standard output. Error: kCannotWrite.
Status print_result(const std::string& text);
/// To standard error.
void print_message(const std::string& text);

/// "medial-vk: what is wrong", with a hint at the help of `command` if its usage is wrong. Returns the exit code.
int report_error(const Error& error, const char* command);

}  // namespace medial_vk::cli
