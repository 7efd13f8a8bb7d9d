#include "cli/doctor/trial.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <utility>

#include "base/stopwatch.h"
#include "check_reports/check_agreement.h"
#include "cli/doctor/child_process.h"
#include "cli/terminal/messages.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/prepare.h"
#include "output/doctor_report/findings_json.h"
#include "platform/machine.h"
#include "platform/paths.h"
#include "reference_bridge/check_balls.h"
#include "reference_bridge/reference_extractor.h"

namespace medial_vk::cli {
namespace {

constexpr std::uint32_t kAround = 16, kAlong = 32, kResolution = 24;

/// No file can be made below it, so that no programs are read or kept.
constexpr const char* kNoCache = platform::kIsWindows ? "//./NUL" : "/dev/null";

/// A flattened torus, whose medial surface is a band, turned so that nothing lies along the axes.
Mesh make_solid() {
  const double turn = 0.7, lean = 0.4;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    const double u = 2 * std::numbers::pi * i / kAlong;
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double v = 2 * std::numbers::pi * j / kAround;
      const double rho = 1 + 0.4 * std::cos(v);
      const double x = rho * std::cos(u), y = rho * std::sin(u), z = 0.2 * std::sin(v);
      const double leaning = y * std::cos(lean) - z * std::sin(lean);
      mesh.vertices.push_back({x * std::cos(turn) - leaning * std::sin(turn),
                               x * std::sin(turn) + leaning * std::cos(turn), y * std::sin(lean) + z * std::cos(lean)});
    }
  }
  const auto at = [](std::uint32_t i, std::uint32_t j) { return i % kAlong * kAround + j % kAround; };
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

CheckReport compare(const TrialTask& task, const CertifiedExtraction& found) {
  CheckReport report = check_agreement(found, task.reference, task.options);
  const VoxelGrid& grid = found.extraction.grid;
  CheckReport balls = check_medial_spheres(task.mesh, grid, found.extraction.spheres,
                                           task.options.epsilon * grid.voxel_size, task.options.object_angle, 0);
  for (CheckLine& line : balls.lines) report.lines.push_back(std::move(line));
  return report;
}

/// The first condition that fails, in words.
std::string first_fault(const CheckReport& comparison) {
  for (const CheckLine& line : comparison.lines) {
    if (line.failed == 0) continue;
    return fmt::format("its results are wrong: {} of {} fail \"{}\"{}{}", line.failed, line.tested, line.condition,
                       line.first_failure.empty() ? "" : ": ", line.first_failure);
  }
  return {};
}

/// Measures how long the driver compiles.
struct ProgramTimes {
  Stopwatch stopwatch;
  double seconds = 0;
  std::uint64_t programs = 0;

  void update(std::size_t made, std::size_t wanted) {
    const double lap = stopwatch.lap();
    if (made == 0) return;
    seconds += lap;
    if (made == wanted) programs += wanted;
  }
};

/// In the child process.
TrialRecord extract(const TrialTask& task, std::uint32_t device, const std::string& cache_folder) {
  TrialRecord trial;
  ProgramTimes times;
  ContextOptions options;
  options.device = std::to_string(device);
  options.cache_folder = cache_folder;
  options.programs_progress = [&times](std::size_t made, std::size_t wanted) { times.update(made, wanted); };
  Stopwatch stopwatch;
  Result<Context> context = Context::create(options);
  trial.open_seconds = stopwatch.lap();
  if (!context) {
    trial.problem = in_words_of_options(context.error().message, Command::kDoctor);
    return trial;
  }
  const Result<CertifiedExtraction> found = extract_and_certify(task.mesh, task.options, context.value());
  trial.program_seconds = times.seconds;
  trial.programs = times.programs;
  trial.search_seconds = stopwatch.lap() - times.seconds;
  if (!found) {
    trial.problem = in_words_of_options(found.error().message, Command::kDoctor);
    return trial;
  }
  trial.spheres = found.value().extraction.spheres.size();
  trial.undecided = found.value().extraction.measurements.counters.undecided;
  trial.comparison = compare(task, found.value());
  trial.problem = first_fault(trial.comparison);
  trial.end = trial.comparison.passed() ? TrialEnd::kAgrees : TrialEnd::kDiffers;
  return trial;
}

TrialRecord failed(TrialEnd end, std::string problem) {
  TrialRecord trial;
  trial.end = end;
  trial.problem = std::move(problem);
  return trial;
}

TrialRecord try_once(const TrialTask& task, std::uint32_t device, const std::string& cache_folder,
                     std::chrono::milliseconds limit) {
  Result<ChildOutcome> outcome = run_in_child([&] { return encode_trial(extract(task, device, cache_folder)); }, limit);
  if (!outcome) return failed(TrialEnd::kError, outcome.error().message);
  TrialRecord trial;
  if (outcome.value().end == ChildEnd::kDone) {
    Result<TrialRecord> decoded = decode_trial(outcome.value().result);
    trial = decoded ? std::move(decoded).value() : failed(TrialEnd::kError, decoded.error().message);
  } else {
    const bool is_late = outcome.value().end == ChildEnd::kTooLong;
    trial = failed(is_late ? TrialEnd::kTooLong : TrialEnd::kCrashed,
                   fmt::format("{} {}", is_late ? "it" : "its driver", outcome.value().how));
  }
  trial.messages = std::move(outcome.value().messages);
  return trial;
}

bool has_files(const std::string& folder) {
  std::error_code error;
  return !folder.empty() &&
         std::filesystem::directory_iterator(platform::path_of(folder), error) != std::filesystem::directory_iterator();
}

}  // namespace

Result<TrialTask> make_trial_task() {
  Result<PreparedMesh> prepared = prepare_mesh(make_solid(), {.threads = 1});
  if (!prepared) return prepared.error();
  Result<IndexedMesh> mesh = IndexedMesh::build(std::move(prepared).value(), {.threads = 1});
  if (!mesh) return mesh.error();
  TrialTask task = {std::move(mesh).value(), {}, {}, 0};
  task.options.resolution = kResolution;
  Stopwatch stopwatch;
  Result<Extraction> reference = reference_extractor()(task.mesh, task.options, {}, {});
  if (!reference) return reference.error();
  task.reference = std::move(reference).value();
  task.reference_seconds = stopwatch.lap();
  return task;
}

TrialRecord try_device(const TrialTask& task, std::uint32_t device, const std::string& cache_folder,
                       std::chrono::milliseconds limit) {
  const bool has_cache = has_files(cache_folder);
  TrialRecord trial = try_once(task, device, cache_folder, limit);
  if (trial.end != TrialEnd::kAgrees && has_cache)
    trial.works_without_cache = try_once(task, device, kNoCache, limit).end == TrialEnd::kAgrees;
  return trial;
}

}  // namespace medial_vk::cli
