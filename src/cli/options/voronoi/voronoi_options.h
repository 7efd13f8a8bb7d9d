// The command line of `medial-vk voronoi` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"
#include "medial_vk/site_voronoi.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

enum class SitesFormat { kPly, kObj, kGlb, kNpz, kCsv, kJson, kGeoJson, kSvg };

struct VoronoiCommandOptions {
  bool help = false;
  std::vector<std::string> files;  ///< Meshes, or shapes in the plane; "-": standard input, once.
  bool in_plane = false;           ///< The files are shapes in the plane.
  std::vector<Point> points;
  std::vector<std::array<Point, 2>> segments;
  std::vector<std::array<Point, 3>> triangles;
  bool split = false;
  std::string output;  ///< "-": PLY, or of the plane JSON, on standard output.
  std::string picture, html, report, roadmap;
  std::optional<Point> from, to;
  std::uint32_t resolution = SiteVoronoiOptions().resolution;
  double margin = 0;
  bool ascii = false;
  bool check = false;
  PictureOptions picture_options;
  unsigned threads = 0;
  bool quiet = false;
  bool verbose = false;

  SitesFormat format() const;
  bool operator==(const VoronoiCommandOptions&) const = default;
};

/// `arguments` without the program's name and without "voronoi". Errors: kUsage with a message that names the option.
Result<VoronoiCommandOptions> parse_voronoi_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class VoronoiOptionParser {
 public:
  VoronoiOptionParser();
  ~VoronoiOptionParser();
  VoronoiOptionParser(const VoronoiOptionParser&) = delete;
  VoronoiOptionParser& operator=(const VoronoiOptionParser&) = delete;

  Result<VoronoiCommandOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const VoronoiCommandOptions& options);

}  // namespace medial_vk::cli
