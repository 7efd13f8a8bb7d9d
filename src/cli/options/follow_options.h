// The command line of `medial-vk follow` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/output_names.h"
#include "cli/options/parse_picture.h"
#include "common/backend.h"
#include "medial_vk/follower.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_fits.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

/// Balls to fit, unless the command line has another number. A cover of many takes minutes.
constexpr std::size_t kUsualFollowers = 500, kUsualCoverCount = 100;
/// Balls of a frame that may be chosen anew, where that is possible.
constexpr std::uint32_t kUsualRenewed = 25;

struct FollowOptions {
  bool help = false;
  /// The mesh in the rest pose, a scene with an animation, or, without `frames`, a pattern of names: of the rest pose
  /// and the frames.
  std::string rest;
  std::vector<std::string> frames;  ///< Meshes, or patterns of names; empty: those of `rest`.
  std::string animation;            ///< Its name, or its number from 1; empty: the only one.
  double frames_per_second = 30;

  std::string balls;                                  ///< A file with the balls; empty: they are fitted.
  SphereContract contract = SphereContract::kInside;  ///< Or kCover.
  std::size_t count = kUsualFollowers;                ///< Of balls to fit.
  bool points = false;                                ///< All medial points instead.
  std::uint32_t resolution = 0;                       ///< Voxels along the longest side; 0: by the number of balls.
  Backend backend = Backend::kVulkan;
  std::string device;

  FollowerOptions follower;  ///< `threads` is the number for the whole run, and `steps` that of covers, too.
  /// Nothing was said of balls chosen anew: none is if the mesh at rest has no known volume.
  bool has_usual_renewal = false;
  bool from_rest = false;  ///< Each frame is computed from the rest pose alone.
  bool tighten = false;    ///< A cover is divided anew in each frame.
  double grown = 1.25;     ///< A ball of a cover beyond so many times its radius at rest counts as grown.

  /// REST.follow.npz is the only output, because none was named.
  bool has_usual_output = false;
  std::vector<std::string> outputs;  ///< .npz, .glb or .csv; never empty after parsing; "-": standard output, CSV.
  std::string picture, html, rig;    ///< Empty: none; "-": standard output.
  PictureView view;

  bool check = false;
  bool quiet = false;
  bool verbose = false;

  bool covers() const { return contract == SphereContract::kCover; }

  bool operator==(const FollowOptions&) const = default;
};

/// `arguments` without the program's name and without "follow". Errors: kUsage with a message that names the option.
Result<FollowOptions> parse_follow_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class FollowOptionParser {
 public:
  FollowOptionParser();
  ~FollowOptionParser();
  FollowOptionParser(const FollowOptionParser&) = delete;
  FollowOptionParser& operator=(const FollowOptionParser&) = delete;

  Result<FollowOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// The options with the files of `rest`, if that is a pattern, in its place: the first as the rest pose, the others as
/// frames. Error: kUsage (options that are about a scene, results that would replace a file).
Result<FollowOptions> with_files_of_pattern(FollowOptions options, const std::vector<std::string>& files);

/// Every file to be written, with its option.
std::vector<NamedOutput> outputs_of(const FollowOptions& options);

/// Every file to be read that the command line names.
std::vector<std::string> inputs_of(const FollowOptions& options);

/// Whether `--rig` writes a scene with balls as nodes, and not a table.
bool rig_has_nodes(const FollowOptions& options);

/// Whether a file with a line per frame is written, for which the distances between surface and balls are measured.
bool writes_table(const FollowOptions& options);

}  // namespace medial_vk::cli
