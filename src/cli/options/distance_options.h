// The command line of `medial-vk distance` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "cli/options/parse_picture.h"
#include "medial_vk/proximity.h"
#include "medial_vk/result.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

struct DistanceCommandOptions {
  bool help = false;
  std::string a, b;           ///< Meshes or body files.
  std::string poses;          ///< A table of poses; "-": standard input; empty: b stays where it is.
  std::string output;         ///< "-": standard output.
  std::string picture, html;  ///< Empty: none; "-": standard output.
  std::size_t row = 0;        ///< The pose that they show, from 1; 0: that of the least distance.
  PictureView view;

  double tolerance = 0;
  double limit = std::numeric_limits<double>::infinity();  ///< Infinite: none; 0: only collisions are decided.
  bool surfaces = false;
  bool balls = false;  ///< Bounds by balls alone.
  bool keep_inner_faces = false;
  unsigned threads = 0;
  bool check = false;
  bool quiet = false;
  bool verbose = false;

  bool operator==(const DistanceCommandOptions&) const = default;
};

/// In the form that the library takes.
DistanceOptions distance_options(const DistanceCommandOptions& options);

/// `arguments` without the program's name and without "distance". Errors: kUsage with a message that names the option.
Result<DistanceCommandOptions> parse_distance_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class DistanceOptionParser {
 public:
  DistanceOptionParser();
  ~DistanceOptionParser();
  DistanceOptionParser(const DistanceOptionParser&) = delete;
  DistanceOptionParser& operator=(const DistanceOptionParser&) = delete;

  Result<DistanceCommandOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const DistanceCommandOptions& options);

}  // namespace medial_vk::cli
