// The command line of `medial-vk plane` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "cli/options/parse_number.h"
#include "medial_vk/plane_axis.h"
#include "medial_vk/result.h"
#include "output/plane_files/plane_record.h"

namespace medial_vk::cli {

enum class PlaneFormat { kJson, kGeoJson, kSvg, kCsv };

enum class PlaneMode { kCertified, kThesis };

/// In units of the shape, or a share of its longest side.
using PlaneLength = Length;

struct PlaneCommandOptions {
  bool help = false;
  std::string shape;   ///< "-": standard input.
  std::string slice;   ///< "z=0.3": the shape is a mesh; empty: none.
  std::string output;  ///< "-": JSON on standard output.
  std::string picture, html, report;
  PlaneMode mode = PlaneMode::kCertified;
  double object_angle = PlaneAxisOptions().object_angle;
  PlaneLength radius, margin;
  PlaneSide side = PlaneSide::kInside;
  std::optional<FillRule> fill;
  PlaneLength flatness;  ///< 0: the usual one.
  PlaneLength prune_length, prune_significance, smooth;
  PlaneLength step = {1e-4, true};
  bool longest_path = false;
  PlaneColour colour = PlaneColour::kRadius;
  bool check = false;
  unsigned threads = 0;
  bool quiet = false;
  bool verbose = false;

  PlaneFormat format() const;
  bool operator==(const PlaneCommandOptions&) const = default;
};

/// `arguments` without the program's name and without "plane". Errors: kUsage with a message that names the option.
Result<PlaneCommandOptions> parse_plane_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class PlaneOptionParser {
 public:
  PlaneOptionParser();
  ~PlaneOptionParser();
  PlaneOptionParser(const PlaneOptionParser&) = delete;
  PlaneOptionParser& operator=(const PlaneOptionParser&) = delete;

  Result<PlaneCommandOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const PlaneCommandOptions& options);

}  // namespace medial_vk::cli
