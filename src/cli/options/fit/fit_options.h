// The command line of `medial-vk fit` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "common/backend.h"
#include "common/hull_format.h"
#include "medial_vk/hull_fits.h"
#include "medial_vk/result.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

struct FitCommandOptions {
  bool help = false;
  std::string input;   ///< "-": a mesh on standard input.
  std::string output;  ///< Never empty after parsing; "-": standard output.
  HullFormat format = HullFormat::kJson;
  HullFitOptions hulls;  ///< `threads` is the number for the whole run.

  std::string report;   ///< Empty: none; "-": standard output.
  std::string picture;  ///< As `report`.
  PictureOptions picture_options;

  Backend backend = Backend::kVulkan;
  std::string device;
  bool check = false;
  bool quiet = false;
  bool verbose = false;

  bool operator==(const FitCommandOptions&) const = default;
};

/// `arguments` without the program's name and without "fit" or "spheres". Errors: kUsage with a message that names the
/// option.
Result<FitCommandOptions> parse_fit_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class FitOptionParser {
 public:
  FitOptionParser();
  ~FitOptionParser();
  FitOptionParser(const FitOptionParser&) = delete;
  FitOptionParser& operator=(const FitOptionParser&) = delete;

  Result<FitCommandOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Whether `medial-vk spheres` with these arguments fits hulls: they have --primitives.
bool has_primitives(const std::vector<std::string>& arguments);

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const FitCommandOptions& options);

}  // namespace medial_vk::cli
