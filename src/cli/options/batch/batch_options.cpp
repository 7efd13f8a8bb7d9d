#include "cli/options/batch/batch_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "cli/options/declarations.h"
#include "cli/options/options_of_meshes.h"
#include "cli/options/output_names.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk::cli {
namespace {

/// A kind of files: its option, which takes an ending, and the word before the ending, which tells apart two kinds with
/// the same ending.
struct FileKind {
  const char* option;
  std::string Options::*file;
  const char* word;
};

constexpr FileKind kFileKinds[] = {
    {"--report", &Options::report, ".report"},
    {"--picture", &Options::picture, ".picture"},
    {"--medial-mesh", &Options::medial_mesh, ".surface"},
    {"--sheet-curve", &Options::sheet_curve, ".curve"},
    {"--ball-volumes", &Options::ball_volumes, ".volumes"},
    {"--boundary", &Options::boundary, ".boundary"},
    {"--thickness-histogram", &Options::thickness_histogram, ".thickness"},
    {"--thickness-points", &Options::thickness_points, ".samples"},
};

/// Options that change no result, and those of this command alone, which `BatchOptions` compares by itself.
constexpr std::array<std::string_view, 8> kNotOfResults = {"--output",  "--html",  "--list",    "--merge",
                                                           "--threads", "--quiet", "--verbose", "--help"};

Status check_ending(const char* option, const std::string& ending) {
  const bool is_ending =
      ending.size() > 1 && ending[0] == '.' &&
      std::all_of(ending.begin() + 1, ending.end(), [](unsigned char c) { return std::isalnum(c) != 0; });
  if (is_ending) return {};
  return usage_error(fmt::format("{}: '{}' is no ending, such as .ply", option, ending));
}

/// Endings become names of the files of MESH.
Status take_endings(const std::string& format, Options& each) {
  if (Status status = check_ending("--format", format); !status) return status;
  each.output = fmt::format("{}{}{}", kMeshWord, each.mesh_spheres ? ".spheres" : ".medial", format);
  if (const auto known = medial_format_of(each.output); !known)
    return usage_error("--format: " + known.error().message);
  for (const FileKind& kind : kFileKinds) {
    std::string& file = each.*kind.file;
    if (file.empty()) continue;
    if (Status status = check_ending(kind.option, file); !status) return status;
    file = fmt::format("{}{}{}", kMeshWord, kind.word, file);
  }
  return {};
}

/// What is measured must be written somewhere.
Status check_measures(const Options& each) {
  const bool has_curvature = !each.report.empty() || !each.boundary.empty() || each.strokes ||
                             (!each.picture.empty() && each.look.show == PictureShow::kBoundary);
  if (each.curvature && !has_curvature) {
    return usage_error("--curvature has no column in the table: use it with --report .json or --boundary .EXT");
  }
  if (each.extraction.measurements.kernel_times && each.report.empty()) {
    return usage_error("--kernel-times has no column in the table: use it with --report .json");
  }
  return {};
}

/// In quotes where a reader could take it for several words.
std::string quoted(const std::string& value) {
  const bool is_plain =
      !value.empty() && std::ranges::all_of(value, [](unsigned char c) { return std::isgraph(c) != 0 && c != '\''; });
  if (is_plain) return value;
  std::string out = "'";
  for (const char c : value) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string given_options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (std::ranges::find(kNotOfResults, name) != kNotOfResults.end()) continue;
    text += (text.empty() ? "" : " ") + name;
    if (option->get_expected_max() == 0) continue;  // a flag
    for (const std::string& value : option->results()) text += " " + quoted(value);
  }
  return text;
}

/// Results are merged as they are.
Result<BatchOptions> options_of_merge(BatchOptions options) {
  if (options.list) return usage_error("--list names meshes, and --merge has results: use one of them");
  if (options.given.empty()) return options;
  return usage_error(fmt::format("--merge takes results as they are, without {}", options.given));
}

}  // namespace

/// The application writes to the options, so both stay together and do not move.
struct BatchOptionParser::Declared {
  ReusableApp app;
  BatchOptions options;
  std::string format;
};

BatchOptionParser::BatchOptionParser() : declared_(std::make_unique<Declared>()) {
  CLI::App& app = declared_->app;
  BatchOptions& options = declared_->options;
  app.set_help_flag();  // The text of --help is written by hand.
  app.allow_extras();   // Reported with a suggestion.
  Declarations add(app);
  add.texts("INPUT", "folders, lists and files", options.inputs);
  add.text("-o,--output", "folder", options.output);
  add.flag("--html", options.page);
  add.flag("--list", options.list);
  add.flag("--merge", options.merge);
  add.text("--format", "ending", declared_->format);
  add.flag("--volumes", options.each.volumes);
  declare_shared(add, options.each);
  add.flag("-h,--help", options.help);
}

BatchOptionParser::~BatchOptionParser() = default;

Result<BatchOptions> BatchOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  BatchOptions& options = declared_->options = BatchOptions();
  declared_->format = ".ply";
  if (Status status = parse_arguments(declared_->app, arguments, "it is no mesh"); !status) return status.error();
  if (options.help) return options;
  if (options.inputs.empty()) return usage_error("no FOLDER, LIST or mesh given");
  if (std::ranges::find(options.inputs, "") != options.inputs.end()) {
    return usage_error("an input is empty: FOLDER, LIST and mesh are paths");
  }
  if (options.output.empty()) return usage_error("-o OUT is needed: many meshes have many files");
  if (options.output == "-") return usage_error("-o is a folder: many files cannot go to standard output");
  if (std::ranges::count(options.inputs, "-") > 1) return usage_error("standard input is one list, not several");
  options.given = given_options(declared_->app);
  if (options.merge) return options_of_merge(std::move(options));
  Options& each = options.each;
  if (options.page && each.picture.empty()) {
    each.picture = ".png";
    each.draws_on_host = true;  // small pictures take less time than a device that is opened for each
    if (declared_->app.count("--size") == 0) each.look.size = {400, 300};  // of a picture among many
    options.given += options.given.empty() ? "--html" : " --html";
  }
  each.mesh = kMeshWord;
  if (Status status = check_combinations(each); !status) return status.error();
  if (Status status = take_endings(declared_->format, each); !status) return status.error();
  if (Status status = complete_files(each); !status) return status.error();
  if (Status status = check_measures(each); !status) return status.error();
  return options;
}

Result<BatchOptions> parse_batch_options(const std::vector<std::string>& arguments) {
  return BatchOptionParser().parse(arguments);
}

Options options_of_mesh(const Options& each, const std::string& mesh, const std::string& stem) {
  const std::size_t word = std::string_view(kMeshWord).size();
  Options of_mesh = each;
  of_mesh.mesh = mesh;
  of_mesh.output = stem + each.output.substr(word);
  for (const FileKind& kind : kFileKinds) {
    const std::string& file = each.*kind.file;
    if (!file.empty()) of_mesh.*kind.file = stem + file.substr(word);
  }
  return of_mesh;
}

}  // namespace medial_vk::cli
