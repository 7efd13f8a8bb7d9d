// The command line, its arguments one to a line: options that keep their ranges, or a clear message.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "cli/options.h"
#include "fuzz/require.h"

namespace medial_vk::fuzz {
namespace {

/// As main() gets them: any bytes but 0, which ends an argument, too.
std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find_first_of(std::string_view("\n\0", 2)));
    words.emplace_back(word);
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  return words;
}

void require_in_range(const cli::Options& options) {
  const ExtractionParameters& p = options.parameters;
  require(p.resolution >= 1 && p.resolution <= 4096, "--resolution keeps its range");
  require(p.object_angle > 0 && p.object_angle < std::numbers::pi / 2, "--object-angle keeps its range");
  require(p.radius >= 0 && p.radius <= 1, "--radius keeps its range");
  require(p.epsilon >= 1e-3 && p.epsilon <= 0.5, "--epsilon keeps its range");
  require(p.extra_levels <= 8, "--extra-levels keeps its range");
  require(options.perturb >= 0 && options.perturb <= 0.1, "--perturb keeps its range");
  require(options.threads <= 1024, "--threads keeps its range");
  require(p.memory_budget == 0 || p.memory_budget >= 64u << 20, "--memory keeps its range");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  require(options.sphere_detail.value_or(0) <= kGreatestSphereDetail, "--sphere-detail keeps its range");
  const PictureOptions& look = options.look;
  require(std::ranges::any_of(look.view.towards, [](double x) { return x != 0; }), "--view is a direction");
  require(std::ranges::all_of(look.size, [](std::uint32_t n) { return n <= kGreatestPictureSide; }),
          "--size keeps its range");
  if (options.action != cli::Action::kExtract) return;
  require(!options.mesh.empty(), "there is a mesh");
  require(!options.output.empty(), "there is an output");
  require(options.output == "-" || options.output != options.mesh, "the mesh is not overwritten");
  require(options.output != options.report && options.output != options.picture, "results do not replace each other");
}

/// What one line leaves behind may change the next: now and then (for the same input always, so that findings come
/// again) the answer is compared with that of a parser that has seen no other line.
void require_no_trace(const std::vector<std::string>& words, const Result<cli::Options>& options) {
  if (std::hash<std::string>()(fmt::format("{}", fmt::join(words, " "))) % 64 != 0) return;
  const Result<cli::Options> fresh = cli::parse_options(words);
  require(fresh.ok() == options.ok(), "earlier lines do not decide about this one");
  if (fresh.ok()) {
    require(fresh.value() == options.value(), "earlier lines do not change the options of this one");
  } else {
    require(fresh.error().message == options.error().message, "earlier lines do not change the message for this one");
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::OptionParser parser;
  const std::vector<std::string> words = fuzz::split(fuzz::as_text(data, size));
  const Result<cli::Options> options = parser.parse(words);
  if (options.ok()) {
    fuzz::require_in_range(options.value());
  } else {
    fuzz::require(options.error().code == ErrorCode::kUsage, "what is wrong with a command line is its usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  }
  fuzz::require_no_trace(words, options);
  return 0;
}
