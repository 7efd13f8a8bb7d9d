// Rules for the names of output files, the same for every command.
#pragma once

#include <span>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// Is `path` empty or standard output, or does it end in `wanted`, whatever its case?
bool may_end_in(const std::string& path, const char* wanted);

/// An option that names a file to write; empty: not given; "-": standard output.
struct NamedOutput {
  const char* option;
  const std::string* file;
};

/// No file may be named twice, nor may standard output, nor may a result replace the `input` it was made from. Error:
/// kUsage, naming the options.
Status check_outputs_differ(std::span<const NamedOutput> outputs, const std::string& input);

}  // namespace medial_vk::cli
