#include "cli/distance/run_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "cli/distance/distance_summary.h"
#include "cli/options/distance_options.h"
#include "cli/shared/load.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "output/atomic_files/atomic_file.h"
#include "output/distance_files/distances_csv.h"
#include "pose_files/read_poses.h"
#include "reference_bridge/check_distances.h"

namespace medial_vk::cli {
namespace {

/// The sequence of steps from two meshes to their distances, and their shared data.
class DistanceRun {
 public:
  explicit DistanceRun(const DistanceCommandOptions& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    if (Status status = check_writable(options_.output); !status) return status;
    if (Status status = load_poses(); !status) return status;
    if (Status status = load(options_.a, mesh_a_); !status) return status;
    if (options_.b == options_.a) {
      mesh_b_ = mesh_a_;
    } else if (Status status = load(options_.b, mesh_b_); !status) {
      return status;
    }
    if (Status status = build_bodies(); !status) return status;
    if (Status status = compute(); !status) return status;
    if (Status status = check(); !status) return status;
    if (interrupted()) return stopped();
    const OutputFile file = {options_.output, encode_distances_csv(distances_)};
    if (Status status = write_files({&file, 1}); !status) return status;
    if (!options_.quiet) print_message(distance_summary(options_, distances_, times_, file.bytes.size()));
    return report_check();
  }

 private:
  Status load_poses() {
    if (options_.poses.empty()) return {};
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Result<std::vector<Pose>> poses = read_poses(options_.poses);
    if (!poses) return poses.error();
    poses_ = std::move(poses).value();
    return {};
  }

  Status load(const std::string& path, std::optional<IndexedMesh>& mesh) {
    progress_.update("read", 0);
    Result<std::vector<ScenePart>> read = read_meshes(path, false, times_);
    progress_.clear();
    if (!read) return read.error();
    const PrepareOptions prepare = {
        .keep_inner_faces = options_.keep_inner_faces, .threads = options_.threads, .keep_outer_faces = true};
    const DeviceOpening no_device;
    Result<PreparedMesh> prepared =
        prepare_loaded(std::move(read.value().front().mesh), path, no_device, prepare, times_);
    if (!prepared) return prepared.error();
    if (!options_.quiet) print_message(distance_opening(path, prepared.value().report, options_.verbose));
    Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = options_.threads});
    if (!indexed) return indexed.error();
    mesh = std::move(indexed).value();
    return {};
  }

  Status build_bodies() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    progress_.update("bodies", 0);
    Stopwatch stopwatch;
    Result<Body> a = Body::create(*mesh_a_, {}, {}, {options_.threads});
    if (!a) return a.error();
    body_a_ = body_b_ = std::move(a).value();
    if (!mesh_b_->is_same(*mesh_a_)) {
      Result<Body> b = Body::create(*mesh_b_, {}, {}, {options_.threads});
      if (!b) return b.error();
      body_b_ = std::move(b).value();
    }
    progress_.clear();
    times_.push_back({"bodies", stopwatch.lap()});
    return {};
  }

  /// Block by block, so that progress is shown and a signal is seen.
  Status compute() {
    constexpr std::size_t kBlock = 4096;
    Stopwatch stopwatch;
    distances_.resize(poses_.size());
    for (std::size_t begin = 0; begin < poses_.size(); begin += kBlock) {
      if (interrupted()) return stopped();
      progress_.update("distances", static_cast<double>(begin) / static_cast<double>(poses_.size()));
      const std::size_t count = std::min(kBlock, poses_.size() - begin);
      Status status =
          distances(*body_a_, *body_b_, std::span(poses_).subspan(begin, count),
                    std::span(distances_).subspan(begin, count), distance_options(options_), {options_.threads});
      if (!status) return status;
    }
    progress_.clear();
    times_.push_back({"distances", stopwatch.lap()});
    return {};
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    check_ = check_distances(
        mesh_a_->prepared(), mesh_b_->prepared(), poses_, distances_, distance_options(options_),
        [&](std::size_t i) { progress_.update("check", static_cast<double>(i) / static_cast<double>(poses_.size())); });
    progress_.clear();
    return {};
  }

  Status report_check() const {
    if (!options_.check) return {};
    const std::string table = check_table(check_);
    if (options_.output == "-") {
      print_message(table);
    } else if (Status status = print_result(table); !status) {
      return status;
    }
    return verdict(check_);
  }

  const DistanceCommandOptions& options_;
  Progress progress_;
  std::vector<Pose> poses_ = {Pose()};
  std::optional<IndexedMesh> mesh_a_, mesh_b_;
  std::optional<Body> body_a_, body_b_;
  std::vector<Distance> distances_;
  std::vector<StageTime> times_;
  CheckReport check_;
};

}  // namespace

Status run_distance(const std::vector<std::string>& arguments) {
  const Result<DistanceCommandOptions> options = parse_distance_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(distance_help_text());
  return DistanceRun(options.value()).run();
}

}  // namespace medial_vk::cli
