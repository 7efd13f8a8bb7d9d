// The command line of `medial-vk fit`, one argument per line: options that keep their ranges and are consistent, or a
// clear message.
#include <algorithm>
#include <cmath>

#include "cli/options/fit/fit_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_usable(const cli::FitCommandOptions& options) {
  const HullFitOptions& fit = options.hulls;
  require(fit.count <= kMostHulls, "--count keeps its range");
  require(fit.parameters == 0 || (fit.parameters >= 4 && fit.parameters <= 12 * kMostHulls),
          "--parameters keeps its range");
  require(fit.error >= 0 && fit.error < 1, "--error keeps its range");
  require(fit.max_gap >= 0 && std::isfinite(fit.max_gap), "--max-gap keeps its range");
  require(fit.width >= 0 && fit.width < 1, "--width keeps its range");
  require(fit.resolution <= 4096, "--resolution keeps its range");
  require(fit.threads <= 1024, "--threads keeps its range");
  require(fit.count > 0 || fit.parameters > 0 || fit.error > 0 || fit.max_gap > 0, "there is a goal");
  require(!options.input.empty(), "there is an input");
  require(!options.output.empty(), "there is an output");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  require(options.backend != Backend::kCpu || options.device.empty(), "the CPU reference uses no device");
  require(!options.picture.empty() || options.picture_options == PictureOptions(), "a view is of a picture");
  const auto& towards = options.picture_options.view.towards;
  require(std::ranges::any_of(towards, [](double x) { return x != 0; }), "--view is a direction");
  for (const cli::NamedOutput& output : cli::outputs_of(options)) {
    require(*output.file == "-" || *output.file != options.input, "the input is not overwritten");
    for (const cli::NamedOutput& other : cli::outputs_of(options)) {
      require(output.file == other.file || output.file->empty() || *output.file != *other.file,
              "results do not replace each other");
    }
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::FitOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::FitCommandOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_fit_options(words));
  return 0;
}
