#include "cli/options/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <numbers>
#include <optional>
#include <utility>

#include "cli/options/declarations.h"
#include "cli/options/measures.h"
#include "cli/options/options_of_meshes.h"
#include "cli/options/output_names.h"
#include "cli/options/parse_number.h"
#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

/// What is measured on the boundary.
void declare_boundary(Declarations& add, Options& options) {
  add.text("--boundary", "file", options.boundary);
  add.real("--boundary-edge", {0.001, 1}, " of the longest side", options.boundary_edge);
  add.text("--thickness-histogram", "file", options.thickness_histogram);
  add.text("--thickness-points", "file", options.thickness_points);
  add.flag("--thickness", options.thickness);
  add.real("--thickness-delta", {0, 0.1, false}, " of the longest side", options.thickness_delta);
  add.real("--thickness-width", {1e-6, 1}, " of the lower end", options.thickness_width);
  add.flag("--curvature", options.curvature);
  add.flag("--least-wall", options.least_wall);
  add.flag("--least-gap", options.least_gap);
  add.real("--min-wall", {0, 1e18, false}, " in the units of the mesh", options.min_wall);
  add.real("--min-gap", {0, 1e18, false}, " in the units of the mesh", options.min_gap);
  add.real("--wall-angle", {std::numbers::pi / 4, std::numbers::pi / 2, false}, " radians", options.wall_angle);
}

/// Where medial points are sought.
void declare_side(Declarations& add, Options& options) {
  add.choice<SearchSide>(
      "--side", {{"inside", SearchSide::kInside}, {"outside", SearchSide::kOutside}, {"both", SearchSide::kBoth}},
      options.side);
  add.length("--margin", 1e150, " (units of the mesh)", options.margin);
}

/// What one mesh needs, and several meshes of one run cannot share.
void declare_mesh(Declarations& add, Options& options) {
  add.text("MESH", "file", options.mesh);
  add.flag("--each", options.each);
  add.text("-o,--output", "file", options.output);
  add.text("--html", "file", options.html);
  add.action("--list-devices", Action::kListDevices, options.action);
  add.action("--version", Action::kVersion, options.action);
  add.action("-h,--help", Action::kHelp, options.action);
}

/// Files, and what is drawn in them.
void declare_files(Declarations& add, Options& options) {
  add.flag("--ascii", options.ascii);
  add.flag("--mesh-spheres", options.mesh_spheres);
  add.flag("--gpu-instancing", options.gpu_instancing);
  add.whole("--sphere-detail", 0, kGreatestSphereDetail, "", options.sphere_detail);
  add.text("--report", "file", options.report);
  add.text("--picture", "file", options.picture);
  add.view("--view", options.view);
  add.up("--up", options.look.view.up);
  add.size("--size", options.look.size);
  add.choice<PictureShow>("--show",
                          {{"points", PictureShow::kPoints},
                           {"balls", PictureShow::kBalls},
                           {"both", PictureShow::kBoth},
                           {"boundary", PictureShow::kBoundary}},
                          options.look.show);
  add.choice<ColourBy>("--colour",
                       {{"angle", ColourBy::kAngle},
                        {"radius", ColourBy::kRadius},
                        {"sheet", ColourBy::kSheet},
                        {"thickness", ColourBy::kThickness},
                        {"kappa1", ColourBy::kKappa1},
                        {"kappa2", ColourBy::kKappa2},
                        {"shape", ColourBy::kShape}},
                       options.colour);
  add.flag("--strokes", options.strokes);
  add.text("--medial-mesh", "file", options.medial_mesh);
  add.text("--sheet-curve", "file", options.sheet_curve);
  add.text("--ball-volumes", "file", options.ball_volumes);
}

}  // namespace

void declare_shared(Declarations& add, Options& options) {
  ExtractionOptions& extraction = options.extraction;
  declare_files(add, options);
  declare_boundary(add, options);
  declare_side(add, options);

  add.whole("--resolution", 1, 4096, " voxels", extraction.resolution);
  add.real("--object-angle", {0, std::numbers::pi / 2, false}, " radians", extraction.object_angle);
  add.real("--radius", {0, 1}, " of the longest side", extraction.radius);
  add.real("--epsilon", {1e-3, 0.5}, " of the voxel side", extraction.epsilon);
  add.choice<Mode>("--mode", {{"certified", Mode::kCertified}, {"thesis", Mode::kThesis}}, extraction.mode);
  add.whole("--extra-levels", 0, 10, " levels", extraction.extra_levels);
  add.flag("--simplify", options.simplify);
  add.flag("--keep-inner-faces", options.keep_inner_faces);
  add.real("--perturb", {0, 0.1}, " of the longest side", options.perturb);
  add.whole("--seed", 0, UINT64_MAX, "", options.seed);

  add.real("--sheet-angle", {0, 90}, " degrees", options.sheets.angle);
  add.real("--sheet-crease", {0, 180}, " degrees", options.sheets.crease);
  add.real("--sheet-border", {0, 180}, " degrees", options.sheets.border);
  add.real("--sheet-width", {0, 1}, " of the balls' diameter", options.sheets.width);
  add.whole("--absorb-fragments", 0, UINT32_MAX, " points", options.sheets.absorb_fragments);
  add.real("--keep-volume", {0, 1, false}, " of the volume", options.keep_volume);
  add.flag("--keep-topology", options.keep_topology);

  add.choice<Backend>("--backend", {{"vulkan", Backend::kVulkan}, {"cpu", Backend::kCpu}}, options.backend);
  add.text("--device", "index or name", options.device);
  add.memory("--memory", extraction.memory_budget);
  add.whole("--threads", 0, 1024, " threads", options.threads);

  add.flag("--check", options.check);
  add.flag("--kernel-times", extraction.measurements.kernel_times);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
}

namespace {

/// MESH-stem.medial.ply in the current folder; balls as a mesh are no medial PLY.
std::string default_output(const Options& options) {
  const std::string stem = options.mesh == "-" ? "stdin" : platform::stem_of(options.mesh);
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

/// --colour is about medial points or about the boundary, each in the pictures and files that show it.
Status take_colour(Options& options) {
  if (options.strokes && options.look.show != PictureShow::kBoundary) {
    return usage_error("--strokes are on the boundary: use it with --show boundary");
  }
  if (!options.colour) return {};
  const bool draws_boundary = !options.picture.empty() && options.look.show == PictureShow::kBoundary;
  const bool draws_points = !options.picture.empty() && !draws_boundary;
  const ColourBy by = *options.colour;
  if (by < ColourBy::kThickness) {
    if (!draws_points) {
      return usage_error(
          "--colour angle, radius and sheet are about medial points: use them with --picture FILE.png, and not with "
          "--show boundary");
    }
    options.look.colour = static_cast<PictureColour>(by);
    return {};
  }
  if (!draws_boundary && file_extension(options.boundary) != ".glb") {
    return usage_error(
        "--colour thickness, kappa1, kappa2 and shape are about the boundary: use them with --picture FILE.png --show "
        "boundary, or with --boundary FILE.glb");
  }
  options.boundary_colour = static_cast<BoundaryColour>(static_cast<int>(by) - static_cast<int>(ColourBy::kThickness));
  return {};
}

/// Options about what is measured on the boundary.
Status check_boundary_options(const Options& options) {
  const auto ends_in_one_of = [](const std::string& file, std::initializer_list<const char*> extensions) {
    return std::ranges::any_of(extensions, [&](const char* extension) { return may_end_in(file, extension); });
  };
  if (!ends_in_one_of(options.boundary, {".ply", ".glb", ".vtp", ".npz", ".json"})) {
    return usage_error(
        fmt::format("--boundary: '{}' ends in none of .ply, .glb, .vtp, .npz and .json", options.boundary));
  }
  if (!ends_in_one_of(options.thickness_points, {".npz", ".json", ".csv"})) {
    return usage_error(
        fmt::format("--thickness-points: '{}' ends in none of .npz, .json and .csv", options.thickness_points));
  }
  if (!may_end_in(options.thickness_histogram, ".svg") && !may_end_in(options.thickness_histogram, ".csv")) {
    return usage_error(
        fmt::format("--thickness-histogram: '{}' ends in neither .svg nor .csv", options.thickness_histogram));
  }
  if (options.boundary_edge > 0 && !measures_of(options).at_vertices()) {
    return usage_error(
        "--boundary-edge is about vertices of the boundary: use it with --boundary, --show boundary or --curvature");
  }
  const Options usual;
  if (options.wall_angle != usual.wall_angle && !options.needs_walls() && !measures_of(options).thickness) {
    return usage_error(
        "--wall-angle is about walls and gaps: use it with --thickness, --least-wall, --least-gap, --min-wall or "
        "--min-gap");
  }
  const std::pair<const char*, bool> given[] = {
      {"--thickness-delta", options.thickness_delta != usual.thickness_delta},
      {"--thickness-width", options.thickness_width != usual.thickness_width}};
  for (const auto& [name, is_given] : given) {
    if (is_given && !measures_of(options).thickness) {
      return usage_error(fmt::format(
          "{} is about thickness: use it with --thickness, --thickness-points, --thickness-histogram, --boundary or "
          "--show boundary",
          name));
    }
  }
  return {};
}

/// What --side outside and --side both do not have.
Status check_side_options(const Options& options) {
  if (!options.searches_outside()) {
    if (!options.margin) return {};
    return usage_error("--margin is about the outside: use it with --side outside or --side both");
  }
  if (options.margin && !(options.margin->value > 0)) return usage_error("--margin must be more than 0");
  if (options.extraction.mode == Mode::kThesis) return usage_error("--mode thesis searches the inside only");
  if (!options.searches_inside() && measures_of(options).curvature) {
    return usage_error(
        "curvature is measured by balls inside: use --curvature, --strokes, --colour kappa1, kappa2 and shape, and "
        "--boundary without --thickness, with --side inside or --side both");
  }
  if (options.side != SearchSide::kBoth) return {};
  const std::pair<const char*, bool> of_one_side[] = {{"--medial-mesh", !options.medial_mesh.empty()},
                                                      {"--sheet-curve", !options.sheet_curve.empty()},
                                                      {"--ball-volumes", !options.ball_volumes.empty()},
                                                      {"--keep-volume", options.keep_volume > 0}};
  for (const auto& [name, is_given] : of_one_side) {
    if (is_given) {
      return usage_error(fmt::format("{} is about one union of balls: use it with --side inside or outside", name));
    }
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
                                                {"--strokes", options.strokes}};
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

}  // namespace

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
  if (Status status = take_colour(options); !status) return status;
  if (Status status = check_boundary_options(options); !status) return status;
  if (Status status = check_side_options(options); !status) return status;
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
  if (options.each) {
    if (Status status = check_no_stream(outputs_of(options)); !status) return status;
  }
  return check_outputs_differ(outputs_of(options), options.mesh);
}

Status check_combinations(const Options& options) {
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  if (options.backend == Backend::kCpu && !options.device.empty()) {
    return usage_error("--device chooses a Vulkan device; it cannot be used with --backend cpu");
  }
  return {};
}

/// The application writes to `options`, so both stay together and do not move.
struct OptionParser::Declared {
  ReusableApp app;
  Options options;
};

namespace {

/// "; thickness is an option: medial-vk plate.obj --thickness" for an option where a command would be.
std::string hint_at_option(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments[0].starts_with('-') || arguments[1].starts_with('-')) return {};
  const CLI::Option* option = app.get_option_no_throw("--" + arguments[0]);
  if (!option || option->get_expected_max() > 0) return {};
  return fmt::format("; {0} is an option: medial-vk {1} --{0}", arguments[0], arguments[1]);
}

}  // namespace

OptionParser::OptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported here, with a suggestion.
  Declarations add(declared_->app);
  declare_mesh(add, declared_->options);
  declare_shared(add, declared_->options);
}

OptionParser::~OptionParser() = default;

Result<Options> OptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  Options& options = declared_->options = Options();
  if (Status status = parse_arguments(declared_->app, arguments, "one mesh at a time"); !status) {
    return usage_error(status.error().message + hint_at_option(declared_->app, arguments));
  }
  if (Status status = check_combinations(options); !status) return status.error();
  if (options.action != Action::kExtract) return options;
  if (Status status = complete_files(options); !status) return status.error();
  return options;
}

std::vector<NamedOutput> outputs_of(const Options& options) {
  return {{"--output", &options.output},
          {"--report", &options.report},
          {"--picture", &options.picture},
          {"--html", &options.html},
          {"--medial-mesh", &options.medial_mesh},
          {"--sheet-curve", &options.sheet_curve},
          {"--ball-volumes", &options.ball_volumes},
          {"--boundary", &options.boundary},
          {"--thickness-histogram", &options.thickness_histogram},
          {"--thickness-points", &options.thickness_points}};
}

Options options_of_part(const Options& options, const std::string& name) {
  Options of_part = options;
  for (std::string* file :
       {&of_part.output, &of_part.report, &of_part.picture, &of_part.html, &of_part.medial_mesh, &of_part.sheet_curve,
        &of_part.ball_volumes, &of_part.boundary, &of_part.thickness_histogram, &of_part.thickness_points}) {
    if (!file->empty()) *file = with_part(*file, name);
  }
  return of_part;
}

Result<Options> parse_options(const std::vector<std::string>& arguments) { return OptionParser().parse(arguments); }

}  // namespace medial_vk::cli
