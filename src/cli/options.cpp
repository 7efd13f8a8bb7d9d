#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "cli/parse_number.h"
#include "output/file_extension.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

Error usage_error(std::string message) { return {ErrorCode::kUsage, std::move(message)}; }

/// Declares options on a CLI11 application. Values arrive as text and are parsed here: CLI11 would take "1e3" or
/// "12abc" for some numbers, and its messages do not name the range.
class Declarations {
 public:
  explicit Declarations(CLI::App& app) : app_(app) {}

  void text(const char* name, const char* value, std::string& target) {
    app_.add_option(name, target)->type_name(value);
  }

  void flag(const char* name, bool& target) { app_.add_flag(name, target); }

  void action(const char* name, Action value, Action& target) {
    app_.add_flag_callback(name, [value, &target] { target = value; });
  }

  void real(const char* name, const RealRange& range, const char* unit, double& target) {
    parsed(
        name, [=](const std::string& text) { return parse_real(text, range, unit); }, target);
  }

  template <class T>
  void whole(const char* name, std::uint64_t least, std::uint64_t greatest, const char* unit, T& target) {
    parsed(
        name, [=](const std::string& text) { return parse_whole(text, least, greatest, unit); }, target);
  }

  void memory(const char* name, std::uint64_t& target) { parsed(name, parse_memory, target); }
  void view(const char* name, ViewChoice& target) { parsed(name, parse_view, target); }
  void up(const char* name, UpAxis& target) { parsed(name, parse_up, target); }
  void size(const char* name, std::array<std::uint32_t, 2>& target) { parsed(name, parse_size, target); }

  template <class T>
  void choice(const char* name, std::vector<std::pair<std::string, T>> choices, T& target) {
    const auto parse = [choices](const std::string& text) -> Result<T> {
      std::string known;
      for (const auto& [word, value] : choices) {
        if (word == text) return value;
        known += (known.empty() ? "" : " or ") + word;
      }
      return usage_error(fmt::format("'{}' is unknown; use {}", text, known));
    };
    parsed(name, parse, target);
  }

 private:
  template <class Parse, class T>
  void parsed(const char* name, Parse parse, T& target) {
    const auto set = [name, parse, &target](const std::string& text) {
      const auto value = parse(text);
      if (!value) throw CLI::ValidationError(name, value.error().message);
      target = static_cast<T>(value.value());
    };
    app_.add_option_function<std::string>(name, set)->type_name("value");
  }

  CLI::App& app_;
};

void declare(CLI::App& app, Options& options) {
  ExtractionParameters& parameters = options.parameters;
  Declarations add(app);
  add.text("MESH", "file", options.mesh);
  add.text("-o,--output", "file", options.output);
  add.flag("--ascii", options.ascii);
  add.flag("--mesh-spheres", options.mesh_spheres);
  add.flag("--gpu-instancing", options.gpu_instancing);
  add.whole("--sphere-detail", 0, kGreatestSphereDetail, "", options.sphere_detail);
  add.text("--report", "file", options.report);
  add.text("--picture", "file", options.picture);
  add.view("--view", options.view);
  add.up("--up", options.look.view.up);
  add.size("--size", options.look.size);
  add.choice<PictureShow>(
      "--show", {{"points", PictureShow::kPoints}, {"balls", PictureShow::kBalls}, {"both", PictureShow::kBoth}},
      options.look.show);
  add.choice<PictureColour>(
      "--colour",
      {{"angle", PictureColour::kAngle}, {"radius", PictureColour::kRadius}, {"sheet", PictureColour::kSheet}},
      options.look.colour);
  add.text("--html", "file", options.html);
  add.text("--medial-mesh", "file", options.medial_mesh);
  add.text("--sheet-curve", "file", options.sheet_curve);
  add.text("--ball-volumes", "file", options.ball_volumes);

  add.whole("--resolution", 1, 4096, " voxels", parameters.resolution);
  add.real("--object-angle", {0, std::numbers::pi / 2, false}, " radians", parameters.object_angle);
  add.real("--radius", {0, 1}, " of the longest side", parameters.radius);
  add.real("--epsilon", {1e-3, 0.5}, " of the voxel side", parameters.epsilon);
  add.choice<Mode>("--mode", {{"certified", Mode::kCertified}, {"thesis", Mode::kThesis}}, parameters.mode);
  add.whole("--extra-levels", 0, 8, " levels", parameters.extra_levels);
  add.flag("--simplify", options.simplify);
  add.real("--perturb", {0, 0.1}, " of the longest side", options.perturb);
  add.whole("--seed", 0, UINT64_MAX, "", options.seed);

  add.real("--sheet-angle", {0, 90}, " degrees", options.sheets.angle);
  add.real("--sheet-crease", {0, 180}, " degrees", options.sheets.crease);
  add.real("--sheet-width", {0, 1}, " of the balls' diameter", options.sheets.width);
  add.whole("--absorb-fragments", 0, UINT32_MAX, " points", options.sheets.absorb_fragments);
  add.real("--keep-volume", {0, 1, false}, " of the volume", options.keep_volume);
  add.flag("--keep-topology", options.keep_topology);

  add.choice<Backend>("--backend", {{"vulkan", Backend::kVulkan}, {"cpu", Backend::kCpu}}, options.backend);
  add.text("--device", "index or name", options.device);
  add.memory("--memory", parameters.memory_budget);
  add.whole("--threads", 0, 1024, " threads", options.threads);

  add.flag("--check", options.check);
  add.flag("--kernel-times", parameters.kernel_times);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.action("--list-devices", Action::kListDevices, options.action);
  add.action("--version", Action::kVersion, options.action);
  add.action("-h,--help", Action::kHelp, options.action);
}

/// Insertions, deletions and replacements that turn one word into the other, or `limit` if they are not fewer.
std::size_t edit_distance(const std::string& a, const std::string& b, std::size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    std::size_t least = row[0];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
      least = std::min(least, row[j + 1]);
    }
    if (least >= limit) return limit;  // rows never get smaller
  }
  return std::min(row.back(), limit);
}

/// "; did you mean --resolution?" if there is an option close to the unknown one, else nothing.
std::string suggestion(const CLI::App& app, const std::string& unknown) {
  const std::string name = unknown.substr(0, unknown.find('='));
  std::string best;
  std::size_t best_distance = 4;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& known : option->get_lnames()) {
      const std::string full = "--" + known;
      const std::size_t distance = edit_distance(name, full, best_distance);
      if (distance < best_distance) {
        best_distance = distance;
        best = known;
      }
    }
  }
  return best.empty() ? "" : fmt::format("; did you mean --{}?", best);
}

Status check_extras(const CLI::App& app) {
  std::vector<std::string> extras = app.remaining();
  std::erase(extras, "--");  // CLI11 counts the mark itself.
  for (const std::string& extra : extras) {
    if (extra.size() > 1 && extra[0] == '-') {
      return usage_error(fmt::format("unknown option {}{}", extra, suggestion(app, extra)));
    }
  }
  if (!extras.empty()) return usage_error(fmt::format("unexpected '{}': one mesh at a time", extras[0]));
  return {};
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return fs::weakly_canonical(fs::absolute(a, error), error) == fs::weakly_canonical(fs::absolute(b, error), error);
}

/// Is `path` empty or standard output, or does it end in `wanted`, whatever its case?
bool may_end_in(const std::string& path, const char* wanted) {
  return path.empty() || path == "-" || file_extension(path) == wanted;
}

/// No file may be named twice, nor may standard output, nor may a result replace the mesh it was made from.
Status check_files_differ(const Options& options) {
  const std::pair<const char*, const std::string*> outputs[] = {{"--output", &options.output},
                                                                {"--report", &options.report},
                                                                {"--picture", &options.picture},
                                                                {"--html", &options.html},
                                                                {"--medial-mesh", &options.medial_mesh},
                                                                {"--sheet-curve", &options.sheet_curve},
                                                                {"--ball-volumes", &options.ball_volumes}};
  for (const auto& [name, file] : outputs) {
    if (file->empty()) continue;
    if (options.mesh != "-" && *file != "-" && same_file(*file, options.mesh)) {
      return usage_error(fmt::format("{} would overwrite the mesh {}", name, options.mesh));
    }
    for (const auto& [other_name, other] : outputs) {
      if (file == other || other->empty()) continue;
      const bool same = *file == "-" || *other == "-" ? *file == *other : same_file(*file, *other);
      if (same) return usage_error(fmt::format("{} and {} are the same file", name, other_name));
    }
  }
  return {};
}

/// MESH-stem.medial.ply in the current folder; balls as a mesh are no medial PLY.
std::string default_output(const Options& options) {
  const std::string stem = options.mesh == "-" ? "stdin" : fs::path(options.mesh).stem().string();
  return stem + (options.mesh_spheres ? ".spheres.ply" : ".medial.ply");
}

/// Options about balls need a format that has balls.
Status check_ball_options(const Options& options) {
  const bool is_glb = options.format == MedialFormat::kGlb;
  if (options.mesh_spheres && !is_glb && options.format != MedialFormat::kPly) {
    return usage_error("--mesh-spheres makes a mesh: use it with .ply or .glb");
  }
  if (options.gpu_instancing && (!is_glb || options.mesh_spheres)) {
    return usage_error("--gpu-instancing is for .glb without --mesh-spheres");
  }
  if (options.sphere_detail && !is_glb && !options.mesh_spheres) {
    return usage_error("--sphere-detail is for balls of triangles: use it with .glb or --mesh-spheres");
  }
  return {};
}

/// Options about the picture need a picture.
Status check_picture_options(const Options& options) {
  const PictureOptions usual;
  const PictureOptions& look = options.look;
  const std::pair<const char*, bool> given[] = {{"--view", options.view != ViewChoice()},
                                                {"--size", look.size != usual.size},
                                                {"--show", look.show != usual.show},
                                                {"--colour", look.colour != usual.colour}};
  for (const auto& [name, is_given] : given) {
    if (is_given && options.picture.empty()) {
      return usage_error(fmt::format("{} is about the picture: use it with --picture FILE.png", name));
    }
  }
  if (look.view.up != usual.view.up && options.picture.empty() && options.html.empty()) {
    return usage_error("--up is about picture and page: use it with --picture FILE.png or --html FILE.html");
  }
  return {};
}

Status complete_files(Options& options) {
  if (options.mesh.empty()) return usage_error("no MESH given");
  if (options.output.empty()) options.output = default_output(options);
  if (options.output != "-") {
    const Result<MedialFormat> format = medial_format_of(options.output);
    if (!format) return usage_error("--output: " + format.error().message);
    options.format = format.value();
  }
  if (Status status = check_ball_options(options); !status) return status;
  if (!may_end_in(options.picture, ".png")) {
    return usage_error(fmt::format("--picture: '{}' does not end in .png", options.picture));
  }
  if (Status status = check_picture_options(options); !status) return status;
  options.look.view = view_of(options.view, options.look.view.up);
  if (!may_end_in(options.html, ".html")) {
    return usage_error(fmt::format("--html: '{}' does not end in .html", options.html));
  }
  if (!may_end_in(options.sheet_curve, ".csv") && !may_end_in(options.sheet_curve, ".svg")) {
    return usage_error(fmt::format("--sheet-curve: '{}' ends in neither .csv nor .svg", options.sheet_curve));
  }
  if (!may_end_in(options.ball_volumes, ".csv")) {
    return usage_error(fmt::format("--ball-volumes: '{}' does not end in .csv", options.ball_volumes));
  }
  if (options.keep_topology && options.keep_volume == 0) {
    return usage_error(
        "--keep-topology is about the sheets that --keep-volume removes: use it with --keep-volume SHARE");
  }
  if (!may_end_in(options.medial_mesh, ".ply") && !may_end_in(options.medial_mesh, ".ma")) {
    return usage_error(fmt::format("--medial-mesh: '{}' ends in neither .ply nor .ma", options.medial_mesh));
  }
  return check_files_differ(options);
}

Status check_combinations(const Options& options) {
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (options.backend == Backend::kCpu && !options.device.empty()) {
    return usage_error("--device chooses a Vulkan device; it cannot be used with --backend cpu");
  }
  return {};
}

Status parse_into(CLI::App& app, std::vector<std::string> arguments, Options& options) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back.
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::Error& error) {
    // A misspelt option is the likelier cause of whatever else is wrong.
    if (Status extras = check_extras(app); !extras) return extras;
    return usage_error(error.what());
  }
  if (Status extras = check_extras(app); !extras) return extras;
  return check_combinations(options);
}

}  // namespace

/// The application writes to `options`, so the two stay together and in place.
struct OptionParser::Declared : CLI::App {
  Options options;

  /// CLI11 forgets the line before by itself, but not if that one ended with an error, and never the order of its
  /// options, a list that grows from line to line.
  void forget() {
    clear();
    parse_order_.clear();
    options = Options();
  }
};

OptionParser::OptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->set_help_flag();  // Help is text of our own.
  declared_->allow_extras();   // Reported here, with a suggestion.
  declare(*declared_, declared_->options);
}

OptionParser::~OptionParser() = default;

Result<Options> OptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->forget();
  Options& options = declared_->options;
  if (Status status = parse_into(*declared_, arguments, options); !status) return status.error();
  if (options.action != Action::kExtract) return options;
  if (Status status = complete_files(options); !status) return status.error();
  return options;
}

Result<Options> parse_options(const std::vector<std::string>& arguments) { return OptionParser().parse(arguments); }

}  // namespace medial_vk::cli
