// The command line of `medial-vk curvature` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "medial_vk/curvature.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

enum class CurvatureFormat { kCsv, kPly, kNpz, kJson, kGlb };

struct CurvatureCommandOptions {
  bool help = false;
  std::string balls;   ///< "-": a table on standard input.
  std::string output;  ///< "-": a table on standard output.
  std::string report;  ///< Empty: none; "-": standard output.
  CurvatureOptions curvature;
  bool quiet = false;
  bool verbose = false;

  CurvatureFormat format() const;
  bool operator==(const CurvatureCommandOptions&) const = default;
};

/// `arguments` without the program's name and without "curvature". Errors: kUsage with a message that names the option.
Result<CurvatureCommandOptions> parse_curvature_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class CurvatureOptionParser {
 public:
  CurvatureOptionParser();
  ~CurvatureOptionParser();
  CurvatureOptionParser(const CurvatureOptionParser&) = delete;
  CurvatureOptionParser& operator=(const CurvatureOptionParser&) = delete;

  Result<CurvatureCommandOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const CurvatureCommandOptions& options);

}  // namespace medial_vk::cli
