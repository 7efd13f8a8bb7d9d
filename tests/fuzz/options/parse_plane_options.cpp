// The command line of `medial-vk plane`, one argument per line: options that keep their ranges and are consistent, or a
// clear message.
#include <numbers>

#include "cli/options/plane/plane_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_usable(const cli::PlaneCommandOptions& options) {
  require(!options.shape.empty(), "there is a shape");
  require(!options.output.empty(), "there is an output");
  require(options.object_angle > 0 && options.object_angle < std::numbers::pi / 2, "--object-angle keeps its range");
  require(options.threads <= 1024, "--threads keeps its range");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  for (const cli::PlaneLength& length : {options.radius, options.margin, options.flatness, options.prune_length,
                                         options.prune_significance, options.smooth, options.step}) {
    require(length.value >= 0 && length.value <= (length.is_share ? 10 : 1e150), "lengths keep their range");
  }
  require(options.step.value > 0, "--step is positive");
  require(!options.flatness.is_share, "--flatness is a length");
  require(options.slice.empty() || options.flatness.value == 0, "slices have no curves");
  require(options.side != PlaneSide::kInside || options.margin.value == 0, "--margin is about the outside");
  require(options.output == "-" ? options.format() == cli::PlaneFormat::kJson : true, "standard output is JSON");
  for (const cli::NamedOutput& output : cli::outputs_of(options)) {
    require(output.file->empty() || *output.file == "-" || *output.file != options.shape, "no input is overwritten");
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::PlaneOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::PlaneCommandOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_plane_options(words));
  return 0;
}
