// The command line of `medial-vk spheres` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "cli/options/parse_picture.h"
#include "common/backend.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_fits.h"
#include "output/picture/panels/options.h"
#include "output/sphere_files/sphere_file.h"

namespace medial_vk::cli {

struct SpheresOptions {
  bool help = false;
  std::string input;      ///< "-": a mesh on standard input.
  bool is_robot = false;  ///< The input is a URDF.
  bool each = false;      ///< Results for each mesh of the input.
  std::string output;     ///< Never empty after parsing; "-": standard output.
  SphereFormat format = SphereFormat::kCsv;
  /// A body file: balls inside and a cover, of `spheres.count` each. `format` and `spheres.contract` are not read.
  bool both = false;

  /// Meshes of a motion, or patterns, none of them `input` or standard input; or `input` alone, by any path: its
  /// animation. Empty: the solid does not move.
  std::vector<std::string> frames;
  std::string animation;  ///< Its name, or its number from 1; empty: the only one.

  bool keep_inner_faces = false;
  SphereFitOptions spheres;        ///< `threads` is the number for the whole run.
  std::size_t count_per_link = 0;  ///< 0: not given.
  std::size_t total = 0;           ///< 0: not given.

  bool visual = false;                ///< For a robot: its visual geometry instead of its collision geometry.
  std::vector<std::string> packages;  ///< "name=folder".

  std::string report;     ///< Empty: none; "-": standard output.
  std::string picture;    ///< As `report`.
  std::string histogram;  ///< As `report`.
  PictureView view;

  Backend backend = Backend::kVulkan;
  std::string device;
  bool check = false;
  bool quiet = false;
  bool verbose = false;

  bool operator==(const SpheresOptions&) const = default;
};

/// `arguments` without the program's name and without "spheres". Errors: kUsage with a message that names the option.
Result<SpheresOptions> parse_spheres_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class SpheresOptionParser {
 public:
  SpheresOptionParser();
  ~SpheresOptionParser();
  SpheresOptionParser(const SpheresOptionParser&) = delete;
  SpheresOptionParser& operator=(const SpheresOptionParser&) = delete;

  Result<SpheresOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Whether the frames are those of the animation of the input.
bool frames_are_animation(const SpheresOptions& options);

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const SpheresOptions& options);

/// The options for one mesh of several: the same, with `name` in the name of every file.
SpheresOptions options_of_part(const SpheresOptions& options, const std::string& name);

}  // namespace medial_vk::cli
