// The command line as a struct. Names and exit codes are a contract with scripts (docs/command-line.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial/extract.h"
#include "medial_vk/extraction.h"
#include "medial_vk/result.h"
#include "output/medial_file.h"

namespace medial_vk::cli {

enum class Action { kExtract, kListDevices, kHelp, kVersion };

struct Options {
  Action action = Action::kExtract;
  std::string mesh;    ///< "-": standard input.
  std::string output;  ///< Never empty after parsing; "-": standard output.
  MedialFormat format = MedialFormat::kPly;
  bool ascii = false;

  ExtractionParameters parameters;
  double perturb = 0;  ///< Fraction of the longest side; 0: off.
  std::uint64_t seed = 1;
  bool simplify = false;

  Backend backend = Backend::kVulkan;
  std::string device;
  unsigned threads = 0;  ///< 0: all.

  std::string report;   ///< Empty: none; "-": standard output.
  std::string picture;  ///< The same.
  bool check = false;

  bool quiet = false;
  bool verbose = false;
};

/// `arguments` without the program's name. Errors: kUsage with a message that names the option.
Result<Options> parse_options(const std::vector<std::string>& arguments);

/// What --help prints.
std::string help_text();

}  // namespace medial_vk::cli
