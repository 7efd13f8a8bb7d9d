// The command line as a struct. Names and exit codes are a contract with scripts (docs/command-line.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boundary_fields/boundary_fields.h"
#include "cli/options/output_names.h"
#include "cli/options/parse_number.h"
#include "cli/options/parse_picture.h"
#include "common/backend.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/result.h"
#include "medial_vk/sheets.h"
#include "output/medial_ply/medial_file.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

/// The words of --colour: of medial points, then of the boundary.
enum class ColourBy { kAngle, kRadius, kSheet, kThickness, kKappa1, kKappa2, kShape };

/// The words of --side.
enum class SearchSide { kInside, kOutside, kBoth };

enum class Action { kExtract, kListDevices, kHelp, kVersion };

struct Options {
  Action action = Action::kExtract;
  std::string mesh;    ///< "-": standard input.
  bool each = false;   ///< Results for each mesh of the input.
  std::string output;  ///< Never empty after parsing; "-": standard output.
  MedialFormat format = MedialFormat::kPly;
  bool ascii = false;
  bool mesh_spheres = false;
  bool gpu_instancing = false;
  std::optional<std::uint32_t> sphere_detail;  ///< None: the default, or less for large files.

  bool keep_inner_faces = false;
  SearchSide side = SearchSide::kInside;
  std::optional<Length> margin;  ///< None: the usual one.
  ExtractionOptions extraction;
  double perturb = 0;  ///< Fraction of the longest side; 0: off.
  std::uint64_t seed = 1;
  bool simplify = false;
  SheetOptions sheets;
  double keep_volume = 0;  ///< Share of the volume that the kept sheets must have; 0: all are kept.
  bool keep_topology = false;
  bool volumes = false;  ///< Of the union of the balls: measured even if no file needs it.

  Backend backend = Backend::kVulkan;
  std::string device;
  unsigned threads = 0;  ///< 0: all.

  std::string report;               ///< Empty: none; "-": standard output.
  std::string picture;              ///< As `report`.
  std::string html;                 ///< As `report`.
  std::string medial_mesh;          ///< As `report`.
  std::string sheet_curve;          ///< As `report`.
  std::string ball_volumes;         ///< As `report`.
  std::string boundary;             ///< As `report`.
  std::string thickness_histogram;  ///< As `report`.
  std::string thickness_points;     ///< As `report`.

  bool least_wall = false;
  bool least_gap = false;
  double min_wall = 0;              ///< In mesh units; 0: any.
  double min_gap = 0;               ///< As `min_wall`.
  double wall_angle = 1.2;          ///< Radians.
  bool thickness = false;           ///< Measured even if no other output needs it.
  bool curvature = false;           ///< As `thickness`.
  double boundary_edge = 0;         ///< Fraction of the longest side that edges of the boundary may have; 0: any.
  double thickness_delta = 0.0005;  ///< Fraction of the longest side.
  double thickness_width = 0.02;    ///< Of an interval, relative to its lower end.

  std::optional<ColourBy> colour;  ///< As given; `look` and `boundary_colour` hold the resulting colours.
  std::optional<BoundaryColour> boundary_colour;  ///< None: thickness if it is measured, else the shape.
  bool strokes = false;                           ///< Principal directions in the picture of the boundary.
  PictureOptions look;                            ///< Of the picture; the page shares `up` of its view.
  ViewChoice view;                                ///< As given; `look` holds the resulting view.
  bool draws_on_host = false;                     ///< The picture, whatever device computes.
  bool check = false;

  bool quiet = false;
  bool verbose = false;

  /// Whether a least wall or gap is to be proved, which needs a closed mesh.
  bool needs_walls() const { return least_wall || least_gap || min_wall > 0 || min_gap > 0; }
  bool searches_inside() const { return side != SearchSide::kOutside; }
  bool searches_outside() const { return side != SearchSide::kInside; }
  bool operator==(const Options&) const = default;
};

/// `arguments` without the program's name. Errors: kUsage with a message that names the option.
Result<Options> parse_options(const std::vector<std::string>& arguments);

/// Parses many command lines: the declaration of the options takes most of the time of one. No line affects the next.
class OptionParser {
 public:
  OptionParser();
  ~OptionParser();
  OptionParser(const OptionParser&) = delete;
  OptionParser& operator=(const OptionParser&) = delete;

  Result<Options> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// The files that a run writes, with the names of their options.
std::vector<NamedOutput> outputs_of(const Options& options);

/// The options for one mesh of several: the same, with `name` in the name of every file.
Options options_of_part(const Options& options, const std::string& name);

}  // namespace medial_vk::cli
