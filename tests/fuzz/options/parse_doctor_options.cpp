// The command line of `medial-vk doctor`, one argument per line: options that keep their ranges, or a clear message.
#include "cli/options/doctor_options.h"
#include "fuzz/arguments.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::DoctorOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::DoctorOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    const unsigned limit = options.value().time_limit;
    fuzz::require(limit >= 1 && limit <= 86400, "--time-limit keeps its range");
    fuzz::require(!(options.value().quiet && options.value().verbose), "-q and -v exclude each other");
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_doctor_options(words));
  return 0;
}
