#include "cli/options/distance_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/options/declarations.h"

namespace medial_vk::cli {
namespace {

constexpr double kGreatestLength = 1e30;

void declare_distance(CLI::App& app, DistanceCommandOptions& options) {
  Declarations add(app);
  add.text("A", "file", options.a);
  add.text("B", "file", options.b);
  add.text("--poses", "file", options.poses);
  add.text("-o,--output", "file", options.output);
  add.real("--tolerance", {0, kGreatestLength, true}, " (units of the mesh)", options.tolerance);
  add.real("--limit", {0, kGreatestLength, false}, " (units of the mesh)", options.limit);
  add.flag("--surfaces", options.surfaces);
  add.flag("--keep-inner-faces", options.keep_inner_faces);
  add.flag("--check", options.check);
  add.whole("--threads", 0, 1024, " threads", options.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_distance_inputs(const DistanceCommandOptions& options) {
  if (options.a.empty() || options.b.empty()) return usage_error("give two meshes, A and B");
  const int streams = (options.a == "-") + (options.b == "-") + (options.poses == "-");
  if (streams > 1) return usage_error("only one of A, B and --poses can be standard input");
  return {};
}

Status check_distance_outputs(const DistanceCommandOptions& options) {
  if (!may_end_in(options.output, ".csv")) {
    return usage_error(fmt::format("--output: '{}' does not end in .csv", options.output));
  }
  for (const std::string* input : {&options.a, &options.b, &options.poses}) {
    if (input->empty()) continue;
    if (Status status = check_outputs_differ(outputs_of(options), *input); !status) return status;
  }
  return {};
}

}  // namespace

DistanceOptions distance_options(const DistanceCommandOptions& options) {
  DistanceOptions of_library;
  of_library.tolerance = options.tolerance;
  if (options.limit > 0) of_library.limit = options.limit;
  of_library.surfaces_only = options.surfaces;
  return of_library;
}

std::vector<NamedOutput> outputs_of(const DistanceCommandOptions& options) { return {{"--output", &options.output}}; }

/// The application writes to the options, so both stay together and do not move.
struct DistanceOptionParser::Declared {
  ReusableApp app;
  DistanceCommandOptions options;
};

DistanceOptionParser::DistanceOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_distance(declared_->app, declared_->options);
}

DistanceOptionParser::~DistanceOptionParser() = default;

Result<DistanceCommandOptions> DistanceOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  DistanceCommandOptions& options = declared_->options = DistanceCommandOptions();
  if (Status status = parse_arguments(declared_->app, arguments, "two meshes, A and B, at a time"); !status) {
    return status.error();
  }
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (Status status = check_distance_inputs(options); !status) return status.error();
  if (options.output.empty()) options.output = "-";
  if (Status status = check_distance_outputs(options); !status) return status.error();
  return options;
}

Result<DistanceCommandOptions> parse_distance_options(const std::vector<std::string>& arguments) {
  return DistanceOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
