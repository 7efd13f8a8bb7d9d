#include "cli/options/follow_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>

#include "cli/options/declarations.h"
#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

constexpr std::uint64_t kMostFollowers = 100'000;
constexpr std::uint64_t kMostRenewed = 10'000;

/// Arguments whose value does not tell whether they were given.
struct GivenToFollow {
  std::size_t count = 0;
  double protrusion = 0, frames_per_second = 0, renewal_factor = 0, grown = 0;
  bool renewed = false;
  ViewChoice view;
};

void declare_follow(CLI::App& app, FollowOptions& options, GivenToFollow& given) {
  Declarations add(app);
  add.text("REST", "file", options.rest);
  add.texts("FRAMES", "files", options.frames);
  add.text("--animation", "name or number", options.animation);
  add.real("--fps", {0.001, 1000, true}, " frames a second", given.frames_per_second);
  add.text("--balls", "file", options.balls);
  add.choice<SphereContract>("--contract", {{"inside", SphereContract::kInside}, {"cover", SphereContract::kCover}},
                             options.contract);
  add.whole("--count", 1, kMostFollowers, " balls", given.count);
  add.flag("--points", options.points);
  add.whole("--resolution", 1, 4096, " voxels", options.resolution);
  add.choice<FollowRule>("--rule", {{"tangent", FollowRule::kTangent}, {"published", FollowRule::kPublished}},
                         options.follower.rule);
  add.whole("--steps", 0, 100, " steps", options.follower.steps);
  add.flag("--from-rest", options.from_rest);
  add.whole("--renew", 0, kMostRenewed, " balls", options.follower.renewed);
  add.real("--renew-factor", {1, 1000, true}, "", given.renewal_factor);
  add.real("--protrusion", {0, 1, false}, " of the longest side", given.protrusion);
  add.real("--shrunk", {0, 1, true}, " of the radius", options.follower.shrunk);
  add.real("--object-angle", {0, std::numbers::pi / 2, true}, " radians", options.follower.object_angle);
  add.flag("--tighten", options.tighten);
  add.real("--grown", {1, 1000, true}, " times the radius", given.grown);
  app.add_option("-o,--output", options.outputs)->type_name("file")->allow_extra_args(false);
  add.text("--picture", "file", options.picture);
  add.text("--html", "file", options.html);
  add.text("--rig", "file", options.rig);
  add.view("--view", given.view);
  add.up("--up", options.view.up);
  add.choice<Backend>("--backend", {{"vulkan", Backend::kVulkan}, {"cpu", Backend::kCpu}}, options.backend);
  add.text("--device", "index or name", options.device);
  add.flag("--check", options.check);
  add.whole("--threads", 0, 1024, " threads", options.follower.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_scene_alone(const FollowOptions& options) {
  if (options.animation.empty() || options.frames.empty()) return {};
  return usage_error("--animation is of a scene alone; give no further meshes with it");
}

Status check_follow_inputs(const FollowOptions& options, const GivenToFollow& given) {
  if (options.rest.empty()) return usage_error("give the mesh in the rest pose, and the meshes of the frames");
  const auto streams = std::ranges::count(inputs_of(options), "-");
  if (streams > 1) return usage_error("only one of the meshes and --balls can be standard input");
  if (Status status = check_scene_alone(options); !status) return status;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  const bool fits = options.balls.empty() && !options.points;
  if (!options.balls.empty() && options.points) return usage_error("--balls and --points cannot be used together");
  if (given.count > 0 && !fits) {
    return usage_error("--count is the number of balls to fit; it cannot be used with --balls or --points");
  }
  if (options.resolution > 0 && !options.balls.empty()) {
    return usage_error("--resolution is about balls to find; it cannot be used with --balls");
  }
  if (options.points && options.resolution == 0) return usage_error("--points: give --resolution N, too");
  if (options.backend == Backend::kCpu && !options.device.empty()) {
    return usage_error("--device chooses a Vulkan device; it cannot be used with --backend cpu");
  }
  return {};
}

/// Options that are about balls of one contract alone.
Status check_contract(const CLI::App& app, const FollowOptions& options) {
  constexpr std::array kOfBallsInside = {"--points",       "--rule",       "--from-rest",    "--renew", "--shrunk",
                                         "--renew-factor", "--protrusion", "--object-angle", "--rig"};
  constexpr std::array kOfCovers = {"--tighten", "--grown"};
  if (options.covers()) {
    for (const char* const name : kOfBallsInside) {
      if (app.count(name) == 0) continue;
      return usage_error(fmt::format("{} is about balls inside; it cannot be used with --contract cover", name));
    }
    return {};
  }
  for (const char* const name : kOfCovers) {
    if (app.count(name) == 0) continue;
    return usage_error(fmt::format("{} is about balls that cover; use it with --contract cover", name));
  }
  return {};
}

/// True if balls may be chosen anew, as far as the command line tells.
bool may_renew(const FollowOptions& options, const GivenToFollow& given) {
  const bool is_possible = !options.covers() && options.follower.rule == FollowRule::kTangent && options.rig.empty();
  return is_possible && (options.follower.renewed > 0 || !given.renewed);
}

/// The published rule has one contact and no steps, but may reach out.
Status check_rule(const FollowOptions& options, const GivenToFollow& given, bool has_steps) {
  const bool is_published = options.follower.rule == FollowRule::kPublished;
  if (is_published && has_steps) return usage_error("--steps are those of --rule tangent");
  if (!is_published && given.protrusion > 0) {
    return usage_error("--protrusion: the balls of --rule tangent never reach out; use it with --rule published");
  }
  if (is_published && options.follower.renewed > 0) {
    return usage_error("--renew exchanges balls of --rule tangent; those of --rule published are only those at rest");
  }
  if (given.renewal_factor > 0 && !may_renew(options, given)) {
    return usage_error(
        "--renew-factor says when balls are chosen anew; with --renew 0, --rig or --rule published none is");
  }
  if (is_published && options.check) {
    return usage_error("--check tests that balls are inside, which --rule published does not promise");
  }
  return {};
}

Status check_follow_outputs(const FollowOptions& options) {
  for (const std::string& file : options.outputs) {
    const std::string extension = file_extension(file);
    if (file == "-" || extension == ".npz" || extension == ".glb" || extension == ".csv") continue;
    return usage_error(fmt::format("--output: '{}' ends in none of .npz, .glb and .csv", file));
  }
  if (Status status = check_view_files(options.picture, options.html); !status) return status;
  if (!may_end_in(options.rig, ".json") && !rig_has_nodes(options)) {
    return usage_error(fmt::format("--rig: '{}' ends in none of .json, .glb and .gltf", options.rig));
  }
  if (!options.rig.empty() && !options.frames.empty()) {
    return usage_error("--rig is about the joints of an animation; meshes have none");
  }
  if (!options.rig.empty() && options.follower.renewed > 0) {
    return usage_error("--rig binds each ball to its joints in all frames; it cannot be used with --renew");
  }
  for (const std::string& input : inputs_of(options)) {
    if (Status status = check_outputs_differ(outputs_of(options), input); !status) return status;
  }
  return {};
}

std::string usual_output(const std::string& rest) {
  return (rest == "-" ? "stdin" : platform::stem_of(rest)) + ".follow.npz";
}

}  // namespace

Result<FollowOptions> with_files_of_pattern(FollowOptions options, const std::vector<std::string>& files) {
  if (files.size() < 2) {
    return usage_error(
        fmt::format("'{}' stands for {} alone: a motion needs the rest pose and a frame", options.rest, files.front()));
  }
  options.rest = files.front();
  options.frames.assign(files.begin() + 1, files.end());
  if (options.has_usual_output) options.outputs = {usual_output(options.rest)};
  if (Status status = check_scene_alone(options); !status) return status.error();
  if (Status status = check_follow_outputs(options); !status) return status.error();
  return options;
}

std::vector<NamedOutput> outputs_of(const FollowOptions& options) {
  std::vector<NamedOutput> outputs;
  for (const std::string& file : options.outputs) outputs.push_back({"--output", &file});
  outputs.push_back({"--picture", &options.picture});
  outputs.push_back({"--html", &options.html});
  outputs.push_back({"--rig", &options.rig});
  return outputs;
}

std::vector<std::string> inputs_of(const FollowOptions& options) {
  std::vector<std::string> inputs = options.frames;
  inputs.push_back(options.rest);
  if (!options.balls.empty()) inputs.push_back(options.balls);
  return inputs;
}

bool rig_has_nodes(const FollowOptions& options) {
  const std::string extension = file_extension(options.rig);
  return extension == ".glb" || extension == ".gltf";
}

bool writes_table(const FollowOptions& options) {
  return std::ranges::any_of(options.outputs,
                             [](const std::string& file) { return file == "-" || file_extension(file) == ".csv"; });
}

/// The application writes to the options, so both stay together and do not move.
struct FollowOptionParser::Declared {
  ReusableApp app;
  FollowOptions options;
  GivenToFollow given;
};

FollowOptionParser::FollowOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_follow(declared_->app, declared_->options, declared_->given);
}

FollowOptionParser::~FollowOptionParser() = default;

Result<FollowOptions> FollowOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  FollowOptions& options = declared_->options = FollowOptions();
  const GivenToFollow& given = declared_->given = GivenToFollow();
  if (Status status = parse_arguments(declared_->app, arguments, "one rest pose at a time"); !status) {
    return status.error();
  }
  if (options.help) return options;
  const bool has_steps = declared_->app.count("--steps") > 0;
  declared_->given.renewed = declared_->app.count("--renew") > 0;
  if (Status status = check_contract(declared_->app, options); !status) return status.error();
  if (Status status = check_follow_inputs(options, given); !status) return status.error();
  if (Status status = check_rule(options, given, has_steps); !status) return status.error();
  if (options.follower.rule == FollowRule::kPublished) options.follower.steps = 0;
  options.count = given.count > 0 ? given.count : options.covers() ? kUsualCoverCount : kUsualFollowers;
  if (given.grown > 0) options.grown = given.grown;
  if (given.protrusion > 0) options.follower.protrusion = given.protrusion;
  if (given.renewal_factor > 0) options.follower.renewal_factor = given.renewal_factor;
  if (given.frames_per_second > 0) options.frames_per_second = given.frames_per_second;
  if (Status status = take_view(given.view, !options.picture.empty() || !options.html.empty(), options.view); !status) {
    return status.error();
  }
  if (!given.renewed && may_renew(options, given)) {
    options.follower.renewed = kUsualRenewed;
    options.has_usual_renewal = !(given.renewal_factor > 0);
  }
  options.has_usual_output = options.outputs.empty();
  if (options.has_usual_output) options.outputs = {usual_output(options.rest)};
  if (Status status = check_follow_outputs(options); !status) return status.error();
  return options;
}

Result<FollowOptions> parse_follow_options(const std::vector<std::string>& arguments) {
  return FollowOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
