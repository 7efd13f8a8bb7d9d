// Rules for the names of output files, shared by all commands.
#pragma once

#include <span>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// True if `path` is empty or standard output, or ends in `extension`, in upper or lower case.
bool may_end_in(const std::string& path, const char* extension);

/// Whether two paths lead to the same file, which need not exist. "-" is the same as "-" only.
bool same_file(const std::string& a, const std::string& b);

/// An option that names a file to write; empty: not given; "-": standard output.
struct NamedOutput {
  const char* option;
  const std::string* file;
};

/// No file may be named twice, nor may standard output, and no result may replace the `input` that it is made from.
/// Error: kUsage, naming the options.
Status check_outputs_differ(std::span<const NamedOutput> outputs, const std::string& input);

/// With --each there are several files of each kind, which standard output cannot hold. Error: kUsage.
Status check_no_stream(std::span<const NamedOutput> outputs);

/// The name of a file for one mesh of several: `part` comes before the extension, and before .medial, .spheres and
/// .foam in front of it: a.medial.ply becomes a.PART.medial.ply.
std::string with_part(const std::string& path, const std::string& part);

}  // namespace medial_vk::cli
