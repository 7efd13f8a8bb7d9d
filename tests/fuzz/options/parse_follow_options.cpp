// The command line of `medial-vk follow`, one argument per line: options that keep their ranges and are consistent, or
// a clear message.
#include "cli/options/follow_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_usable(const cli::FollowOptions& options) {
  require(!options.rest.empty(), "there is a rest pose");
  require(options.frames.empty() || options.animation.empty(), "frames and an animation exclude each other");
  require(!options.outputs.empty(), "there is an output");
  require(options.count >= 1 && options.count <= 100'000, "--count keeps its range");
  require(options.resolution <= 4096, "--resolution keeps its range");
  require(!options.points || options.resolution > 0, "points have a resolution");
  require(!options.points || options.balls.empty(), "balls come from one source");
  require(options.frames_per_second >= 0.001 && options.frames_per_second <= 1000, "--fps keeps its range");
  const FollowerOptions& follower = options.follower;
  require(follower.steps <= 100, "--steps keeps its range");
  require(follower.rule == FollowRule::kTangent || follower.steps == 0, "the published rule has no steps");
  require(follower.rule == FollowRule::kTangent || !options.check, "the published rule promises nothing");
  require(follower.protrusion > 0 && follower.protrusion < 1, "--protrusion keeps its range");
  require(follower.shrunk >= 0 && follower.shrunk <= 1, "--shrunk keeps its range");
  require(follower.object_angle >= 0 && follower.object_angle < 1.6, "--object-angle keeps its range");
  require(follower.renewed <= 10'000, "--renew keeps its range");
  require(follower.renewal_factor >= 1 && follower.renewal_factor <= 1000, "--renew-factor keeps its range");
  require(follower.renewed == 0 || follower.rule == FollowRule::kTangent, "the published rule renews no ball");
  require(follower.renewed == 0 || options.rig.empty(), "balls of a rig are not exchanged");
  require(follower.threads <= 1024, "--threads keeps its range");
  require(options.contract == SphereContract::kInside || options.contract == SphereContract::kCover, "--contract");
  require(options.grown >= 1 && options.grown <= 1000, "--grown keeps its range");
  require(options.covers() || !options.tighten, "balls inside are not tightened");
  if (options.covers()) {
    require(!options.points && !options.from_rest && options.rig.empty(), "covers have no points, no reset, no rig");
    require(follower.renewed == 0 && follower.rule == FollowRule::kTangent, "covers have no rule");
  }
  require(!(options.quiet && options.verbose), "-q and -v exclude each other");
  for (const cli::NamedOutput& output : cli::outputs_of(options)) {
    if (output.file->empty()) continue;
    for (const std::string& input : cli::inputs_of(options)) {
      require(*output.file == "-" || *output.file != input, "no input is overwritten");
    }
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::FollowOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::FollowOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_follow_options(words));
  return 0;
}
