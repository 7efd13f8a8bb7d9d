// The command line of `medial-vk spheres`, one argument per line: options that keep their ranges and are consistent, or
// a clear message.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/options/spheres_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_in_range(const SphereFitOptions& fit) {
  require(fit.count <= 1'000'000, "--count keeps its range");
  require(fit.error >= 0 && fit.error < 1, "--error keeps its range");
  require(fit.max_gap >= 0 && std::isfinite(fit.max_gap), "--max-gap keeps its range");
  require(fit.max_distance >= 0 && std::isfinite(fit.max_distance), "--max-distance keeps its range");
  require(fit.max_reach >= 0 && std::isfinite(fit.max_reach), "--max-reach keeps its range");
  require(fit.resolution <= 4096, "--resolution keeps its range");
  require(fit.object_angle > 0 && fit.object_angle < std::numbers::pi / 2, "--object-angle keeps its range");
  require(fit.threads <= 1024, "--threads keeps its range");
}

void require_goal(const cli::SpheresOptions& options) {
  const SphereFitOptions& fit = options.spheres;
  const bool by_resolution = fit.method == SphereMethod::kSource && fit.resolution > 0;
  require(fit.count > 0 || options.count_per_link > 0 || options.total > 0 || fit.error > 0 || fit.max_gap > 0 ||
              fit.max_reach > 0 || fit.max_distance > 0 || by_resolution,
          "there is a goal");
  require(options.count_per_link <= 1'000'000 && options.total <= 1'000'000, "counts keep their range");
  require(options.count_per_link == 0 || options.total == 0, "--count-per-link and --total exclude each other");
  require(options.is_robot ? fit.count == 0 : options.count_per_link == 0 && options.total == 0,
          "a mesh and a robot have counts of their own");
  require(!options.both || (fit.method == SphereMethod::kBest && fit.max_gap == 0 && !options.is_robot &&
                            !options.each && !options.spheres.levels),
          "a body is of one mesh, by method best");
  const bool by_source = fit.method == SphereMethod::kSource && fit.contract != SphereContract::kInside;
  require(!by_source || (fit.error == 0 && fit.max_gap == 0), "the source has goals of balls inside only");
  require(fit.contract != SphereContract::kCover || fit.max_gap == 0, "covers leave no gap");
  require(fit.max_distance == 0 || (fit.contract == SphereContract::kBalanced && fit.method == SphereMethod::kBest),
          "the distance is one of balanced spheres");
  const bool is_best = fit.method == SphereMethod::kBest && !options.both;
  require(fit.max_reach == 0 || (is_best && fit.contract == SphereContract::kCover && fit.error == 0 && !fit.levels),
          "a reach is that of a cover");
  require(fit.aim == SphereAim::kVolume || (is_best && fit.contract == SphereContract::kInside && fit.error == 0),
          "balls inside are chosen by distance");
}

void require_usable(const cli::SpheresOptions& options) {
  require_in_range(options.spheres);
  require_goal(options);
  require(!options.input.empty(), "there is an input");
  require(!options.output.empty(), "there is an output");
  require(!options.spheres.levels || has_levels(options.format), "the format has levels, if they are requested");
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  require(!options.check || options.spheres.contract != SphereContract::kBalanced,
          "only a contract that can be proved is checked");
  require(options.frames.empty() || (options.spheres.contract == SphereContract::kInside && !options.both &&
                                     !options.is_robot && options.spheres.count > 0),
          "only balls inside one mesh follow a motion");
  require(options.animation.empty() || !options.frames.empty(), "an animation has frames");
  require(options.is_robot || (options.packages.empty() && !options.visual), "a mesh has no links");
  require(!options.is_robot || options.histogram.empty(), "a histogram is of one mesh");
  require(std::ranges::any_of(options.view.towards, [](double x) { return x != 0; }), "--view is a direction");
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
  static cli::SpheresOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::SpheresOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_spheres_options(words));
  return 0;
}
