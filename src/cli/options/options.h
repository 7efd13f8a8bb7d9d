// The command line as a struct. Names and exit codes are a contract with scripts (docs/command-line.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/parse_picture.h"
#include "common/backend.h"
#include "medial_vk/extraction.h"
#include "medial_vk/result.h"
#include "medial_vk/sheets.h"
#include "output/medial_file/medial_file.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

enum class Action { kExtract, kListDevices, kHelp, kVersion };

struct Options {
  Action action = Action::kExtract;
  std::string mesh;    ///< "-": standard input.
  std::string output;  ///< Never empty after parsing; "-": standard output.
  MedialFormat format = MedialFormat::kPly;
  bool ascii = false;
  bool mesh_spheres = false;
  bool gpu_instancing = false;
  std::optional<std::uint32_t> sphere_detail;  ///< None: the usual one, or less for large files.

  ExtractionOptions parameters;
  double perturb = 0;  ///< Fraction of the longest side; 0: off.
  std::uint64_t seed = 1;
  bool simplify = false;
  SheetOptions sheets;
  double keep_volume = 0;  ///< Share of the volume that the sheets that are kept must have; 0: all are kept.
  bool keep_topology = false;

  Backend backend = Backend::kVulkan;
  std::string device;
  unsigned threads = 0;  ///< 0: all.

  std::string report;        ///< Empty: none; "-": standard output.
  std::string picture;       ///< The same.
  std::string html;          ///< The same.
  std::string medial_mesh;   ///< The same.
  std::string sheet_curve;   ///< The same.
  std::string ball_volumes;  ///< The same.
  PictureOptions look;       ///< Of the picture; `up` of its view is that of the page, too.
  ViewChoice view;           ///< As given; `look` has what follows from it.
  bool check = false;

  bool quiet = false;
  bool verbose = false;

  bool operator==(const Options&) const = default;
};

/// `arguments` without the program's name. Errors: kUsage with a message that names the option.
Result<Options> parse_options(const std::vector<std::string>& arguments);

/// The same for many command lines: declaring the options takes most of the time of one. No line leaves a trace in the
/// next.
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

/// What --help prints.
std::string help_text();

}  // namespace medial_vk::cli
