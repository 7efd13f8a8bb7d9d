// The command line of `medial-vk clearance` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "cli/options/parse_picture.h"
#include "common/backend.h"
#include "medial_vk/body_group.h"
#include "medial_vk/result.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

struct ClearanceOptions {
  bool help = false;
  std::string robot;                  ///< A URDF.
  std::vector<std::string> scenes;    ///< Meshes in the frame of the robot's root.
  std::vector<std::string> packages;  ///< "name=folder".
  std::string joints;                 ///< A table of positions; "-": standard input.
  std::string srdf;                   ///< Pairs of links that are not compared; empty: they are found.
  std::string write_srdf;             ///< For the pairs that were not compared; empty: none; "-": standard output.
  std::string output;                 ///< "-": standard output.
  std::string picture, html;          ///< Empty: none; "-": standard output.
  std::size_t row = 0;                ///< The configuration that they show, from 1; 0: that of the least distance.
  PictureView view;

  std::size_t balls = 0;         ///< Answers by balls alone, of so many for each link; 0: by triangles.
  std::string bodies;            ///< A folder where bodies with these balls are kept; empty: none.
  bool decide = false;           ///< Triangles answer where these balls leave a configuration undecided.
  std::uint32_t resolution = 0;  ///< Voxels along the longest side for these balls to choose from; 0: by their number.
  Backend backend = Backend::kVulkan;
  std::string device;
  double tolerance = 0;
  double limit = std::numeric_limits<double>::infinity();  ///< Infinite: none; 0: only collisions are decided.
  bool visual = false;                                     ///< Visual shapes of links instead of those for collisions.
  bool keep_inner_faces = false;
  unsigned threads = 0;
  bool check = false;
  bool quiet = false;
  bool verbose = false;

  bool operator==(const ClearanceOptions&) const = default;
};

/// In the form that the library takes: for balls with `--balls`, else for triangles.
GroupOptions group_options(const ClearanceOptions& options);
/// For triangles.
GroupOptions triangle_options(const ClearanceOptions& options);

/// `arguments` without the program's name and without "clearance". Errors: kUsage with a message that names the option.
Result<ClearanceOptions> parse_clearance_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class ClearanceOptionParser {
 public:
  ClearanceOptionParser();
  ~ClearanceOptionParser();
  ClearanceOptionParser(const ClearanceOptionParser&) = delete;
  ClearanceOptionParser& operator=(const ClearanceOptionParser&) = delete;

  Result<ClearanceOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const ClearanceOptions& options);

/// Every file to be read that the command line names.
std::vector<std::string> inputs_of(const ClearanceOptions& options);

}  // namespace medial_vk::cli
