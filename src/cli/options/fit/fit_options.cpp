#include "cli/options/fit/fit_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <utility>

#include "cli/options/declarations.h"
#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

constexpr const char* kPrimitives = "--primitives";
constexpr std::uint64_t kMostNumbers = 12 * kMostHulls;

/// Arguments that do not correspond to a single field.
struct GivenToFit {
  std::optional<HullFormat> format;
  ViewChoice view;
};

std::vector<std::pair<std::string, std::optional<HullFormat>>> words_of_formats() {
  std::vector<std::pair<std::string, std::optional<HullFormat>>> words;
  words.reserve(kHullFormats.size());
  for (const HullFormat format : kHullFormats) words.emplace_back(name_of(format), format);
  return words;
}

void declare_fit(CLI::App& app, FitCommandOptions& options, GivenToFit& given) {
  HullFitOptions& fit = options.hulls;
  Declarations add(app);
  add.text("MESH", "file", options.input);
  add.choice<HullChoice>(kPrimitives,
                         {{"balls", HullChoice::kBalls},
                          {"capsules", HullChoice::kCapsules},
                          {"cones", HullChoice::kCones},
                          {"slabs", HullChoice::kSlabs},
                          {"mix", HullChoice::kMix}},
                         fit.choice);
  add.whole("--count", 1, kMostHulls, " hulls", fit.count);
  add.whole("--parameters", 4, kMostNumbers, " numbers", fit.parameters);
  add.real("--error", {0, 1, false}, " of the volume", fit.error);
  add.real("--max-gap", {0, 1e30, false}, " (units of the mesh)", fit.max_gap);
  add.real("--width", {0, 1, false}, " of the volume", fit.width);
  add.whole("--resolution", 1, 4096, " voxels", fit.resolution);
  add.text("-o,--output", "file", options.output);
  add.choice<std::optional<HullFormat>>("--format", words_of_formats(), given.format);
  add.text("--picture", "file", options.picture);
  add.view("--view", given.view);
  add.up("--up", options.picture_options.view.up);
  add.size("--size", options.picture_options.size);
  add.text("--report", "file", options.report);
  add.flag("--check", options.check);
  add.choice<Backend>("--backend", {{"vulkan", Backend::kVulkan}, {"cpu", Backend::kCpu}}, options.backend);
  add.text("--device", "index or name", options.device);
  add.whole("--threads", 0, 1024, " threads", fit.threads);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

Status check_fit_input(const FitCommandOptions& options) {
  if (options.input.empty()) return usage_error("no MESH given");
  const std::string extension = file_extension(options.input);
  if (extension == ".urdf" || extension == ".xacro") {
    return usage_error(fmt::format(
        "'{}' is a robot: hulls are fitted to meshes, one at a time; for spheres of its links use medial-vk spheres "
        "without {}",
        options.input, kPrimitives));
  }
  return {};
}

Status check_fit_goals(const FitCommandOptions& options) {
  const HullFitOptions& fit = options.hulls;
  if (fit.count == 0 && fit.parameters == 0 && fit.error == 0 && fit.max_gap == 0) {
    return usage_error("no goal is given: use --count N, --parameters N, --error E or --max-gap G");
  }
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (options.backend == Backend::kCpu && !options.device.empty()) {
    return usage_error("--device chooses a Vulkan device; it cannot be used with --backend cpu");
  }
  return {};
}

Status complete_fit_files(FitCommandOptions& options, const GivenToFit& given) {
  options.format = given.format.value_or(HullFormat::kJson);
  if (options.output.empty()) {
    const std::string stem = options.input == "-" ? "stdin" : platform::stem_of(options.input);
    options.output = fmt::format("{}.hulls.{}", stem, name_of(options.format));
  } else if (options.output != "-" && !given.format) {
    const Result<HullFormat> format = hull_format_of(options.output);
    if (!format) return usage_error("--output: " + format.error().message);
    options.format = format.value();
  }
  if (Status status = check_view_files(options.picture, {}); !status) return status;
  if (options.picture.empty() && options.picture_options.size != PictureOptions().size) {
    return usage_error("--size is about the picture: use it with --picture FILE.png");
  }
  if (options.picture.empty() && (given.view != ViewChoice() || options.picture_options.view.up != PictureView().up)) {
    return usage_error("--view and --up are about the picture: use them with --picture FILE.png");
  }
  options.picture_options.view = view_of(given.view, options.picture_options.view.up);
  return check_outputs_differ(outputs_of(options), options.input);
}

}  // namespace

bool has_primitives(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return false;
    if (argument == kPrimitives || argument.starts_with(std::string(kPrimitives) + "=")) return true;
  }
  return false;
}

std::vector<NamedOutput> outputs_of(const FitCommandOptions& options) {
  return {{"--output", &options.output}, {"--report", &options.report}, {"--picture", &options.picture}};
}

/// The application writes to the other members, so all stay together and do not move.
struct FitOptionParser::Declared {
  ReusableApp app;
  FitCommandOptions options;
  GivenToFit given;
};

FitOptionParser::FitOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_fit(declared_->app, declared_->options, declared_->given);
}

FitOptionParser::~FitOptionParser() = default;

Result<FitCommandOptions> FitOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  FitCommandOptions& options = declared_->options = FitCommandOptions();
  const GivenToFit& given = declared_->given = GivenToFit();
  if (Status status = parse_arguments(declared_->app, arguments, "one mesh at a time"); !status) return status.error();
  if (options.help) return options;
  if (Status status = check_fit_input(options); !status) return status.error();
  if (Status status = check_fit_goals(options); !status) return status.error();
  if (Status status = complete_fit_files(options, given); !status) return status.error();
  return options;
}

Result<FitCommandOptions> parse_fit_options(const std::vector<std::string>& arguments) {
  return FitOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
