// The command line of `medial-vk clearance`, one argument per line: options that keep their ranges and are consistent,
// or a clear message.
#include <algorithm>
#include <cmath>

#include "cli/options/clearance_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_usable(const cli::ClearanceOptions& options) {
  require(!options.robot.empty() && !options.joints.empty(), "there are a robot and its joints");
  const std::vector<std::string> inputs = cli::inputs_of(options);
  require(std::ranges::count(inputs, "-") <= 1, "standard input is one file");
  require(!options.output.empty(), "there is an output");
  require(options.tolerance >= 0 && options.tolerance <= 1e30, "--tolerance keeps its range");
  require(options.limit >= 0 && (options.limit <= 1e30 || std::isinf(options.limit)), "--limit keeps its range");
  require(options.threads <= 1024, "--threads keeps its range");
  require(options.row == 0 || !options.picture.empty() || !options.html.empty(), "a row is shown");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  const GroupOptions of_library = cli::group_options(options);
  require(of_library.exact == (options.balls == 0), "triangles decide, unless balls are to");
  require(cli::triangle_options(options).exact, "triangles decide with --decide");
  require(options.balls > 0 || (options.bodies.empty() && !options.decide), "bodies and decisions are those of balls");
  require(options.bodies != "-", "a stream is no folder");
  require(of_library.tolerance == options.tolerance, "the library has the same tolerance");
  require(of_library.limit == options.limit, "there is no limit, or that one");
  for (const cli::NamedOutput& output : cli::outputs_of(options)) {
    if (output.file->empty()) continue;
    for (const std::string& input : inputs) {
      require(*output.file == "-" || *output.file != input, "no input is overwritten");
    }
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::ClearanceOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::ClearanceOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_clearance_options(words));
  return 0;
}
