// The command line of `medial-vk curvature`, one argument per line: options that keep their ranges and are consistent,
// or a clear message.
#include "cli/options/curvature_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_usable(const cli::CurvatureCommandOptions& options) {
  require(!options.balls.empty(), "there is a file of balls");
  require(!options.output.empty(), "there is an output");
  require(options.curvature.spacing >= 0 && options.curvature.spacing < 1e18, "--spacing keeps its range");
  require(options.curvature.step >= 3.46 && options.curvature.step <= 1000, "--step keeps its range");
  require(options.curvature.threads <= 1024, "--threads keeps its range");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  const CurvatureOptions usual;
  require(options.curvature.method == CurvatureMethod::kDifferences ||
              (!options.curvature.smooth && options.curvature.step == usual.step),
          "fits have no options of differences");
  require(options.output == "-" ? options.format() == cli::CurvatureFormat::kCsv : true, "standard output is a table");
  for (const cli::NamedOutput& output : cli::outputs_of(options)) {
    require(output.file->empty() || *output.file == "-" || *output.file != options.balls, "no input is overwritten");
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::CurvatureOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::CurvatureCommandOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_curvature_options(words));
  return 0;
}
