// bench_recall: the share of the salient medial surface that an extraction finds (docs/accuracy.md).
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/tool_errors.h"
#include "input/read_mesh.h"
#include "medial_vk/context.h"
#include "medial_vk/prepare.h"
#include "recall_count.h"
#include "recall_table.h"
#include "reference_bridge/reference_bridge.h"
#include "reference_bridge/reference_extractor.h"
#include "support/solids/arrangements.h"
#include "support/solids/solid_catalogue.h"

namespace {

using namespace medial_vk;
using bench::RecallRow;
using test::MedialSample;

struct Options {
  std::vector<std::string> meshes, solids, arrangements;
  bool outside = false;
  double margin = 0.5;
  std::vector<std::string> modes = {"certified"};
  std::vector<std::uint32_t> resolutions = {40, 80, 160}, thesis_resolutions;
  std::vector<double> angles = {0.3, 0.6, 0.9};
  std::size_t samples = 100'000;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  std::string backend = "vulkan", csv, markdown;
};

void declare(CLI::App& app, Options& o) {
  app.add_option("mesh", o.meshes, "OBJ, PLY, STL or OFF");
  app.add_option("--solid", o.solids, "analytic solids by name, or all");
  app.add_option("--arrangement", o.arrangements, "arrangements of several parts by name, or all");
  app.add_flag("--outside", o.outside, "the outside of every mesh, in mode certified");
  app.add_option("--margin", o.margin, "of the outside, as a share of the longest side")->check(CLI::Range(0.01, 10.0));
  app.add_option("--mode", o.modes, "certified, thesis")->check(CLI::IsMember({"certified", "thesis"}));
  app.add_option("--resolutions", o.resolutions, "voxels along the longest side")->check(CLI::Range(1, 4096));
  app.add_option("--thesis-resolutions", o.thesis_resolutions, "the same for mode thesis")->check(CLI::Range(1, 4096));
  app.add_option("--angles", o.angles, "thresholds of the object angle, radians")->check(CLI::Range(0.01, 1.5));
  app.add_option("--samples", o.samples, "requested samples for each threshold")->check(CLI::Range(1, 100'000'000));
  app.add_option("--seed", o.seed, "of the samples");
  app.add_option("--threads", o.threads, "of the sampler, 0: all; the samples stay the same");
  app.add_option("--backend", o.backend, "vulkan, cpu")->check(CLI::IsMember({"vulkan", "cpu"}));
  app.add_option("--csv", o.csv, "write all counts to this file");
  app.add_option("--markdown", o.markdown, "write the tables to this file; without it, to standard output");
}

struct Subject {
  std::string name;
  PreparedMesh mesh;
  bool salient_at_a_point = false;
};

Result<Subject> prepare_subject(const std::string& name, Result<Mesh> mesh, bool salient_at_a_point = false) {
  if (!mesh.ok()) return mesh.error();
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh).value());
  if (!prepared.ok()) return prepared.error();
  return Subject{name, std::move(prepared).value(), salient_at_a_point};
}

Result<std::vector<Subject>> load(const Options& options) {
  std::vector<Result<Subject>> loaded;
  for (const std::string& wanted : options.solids) {
    const std::size_t before = loaded.size();
    for (const test::NamedSolid& solid : test::analytic_solids()) {
      if (wanted != "all" && wanted != solid.name) continue;
      loaded.push_back(prepare_subject(solid.name, solid.make(), solid.salient_at_a_point));
    }
    if (loaded.size() == before) return Error{ErrorCode::kUsage, "there is no solid called " + wanted};
  }
  for (const std::string& wanted : options.arrangements) {
    const std::size_t before = loaded.size();
    for (const test::Arrangement& arrangement : test::arrangements()) {
      if (wanted == "all" || wanted == arrangement.name) {
        loaded.push_back(prepare_subject(arrangement.name, arrangement.make()));
      }
    }
    if (loaded.size() == before) return Error{ErrorCode::kUsage, "there is no arrangement called " + wanted};
  }
  for (const std::string& file : options.meshes) {
    loaded.push_back(prepare_subject(std::filesystem::path(file).stem().string(), read_mesh(file)));
  }
  std::vector<Subject> subjects;
  for (Result<Subject>& subject : loaded) {
    if (!subject.ok()) return subject.error();
    subjects.push_back(std::move(subject).value());
  }
  return subjects;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Samples that climb may end at the same corner of the medial surface. Those in different cubes of this side count as
/// distinct.
std::size_t count_apart(const std::vector<MedialSample>& samples, double side) {
  std::set<std::array<long long, 3>> cubes;
  for (const MedialSample& s : samples) {
    cubes.insert(
        {std::llround(s.centre.x() / side), std::llround(s.centre.y() / side), std::llround(s.centre.z() / side)});
  }
  return cubes.size();
}

/// Draws the requested number of samples that are also clear of their voxel's faces: a share of 0.9 along each axis.
std::vector<MedialSample> draw_samples(const Subject& subject, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const double axis = 1 - 2 * bench::kClearOfFaces;
  test::SampleRequest request;
  request.angles = {options.angles.front() + bench::kAngleSlack};
  for (const double angle : options.angles) request.angles.push_back(angle + bench::kClearAngle);
  request.wanted = static_cast<std::size_t>(1.03 * static_cast<double>(options.samples) / (axis * axis * axis)) + 50;
  request.past_corners = subject.salient_at_a_point;
  if (options.outside) request.most_tries = 1000;  // most points lie on no way to a medial sphere in the box
  request.seed = options.seed;
  request.threads = options.threads;
  const double margin = options.margin * subject.mesh.report.longest_side();
  const reference::Mesh mesh = to_reference(subject.mesh);
  const reference::Tree tree(options.outside ? reference::turned_over(mesh, margin) : mesh);
  std::vector<MedialSample> samples = draw_medial_samples(tree, request);
  const double seconds = seconds_since(start);
  fmt::print(stderr, "{}: {} samples, {} of them apart, in {:.1f} s, {:.0f} a second\n", subject.name, samples.size(),
             count_apart(samples, 1e-9 * tree.longest_side()), seconds, static_cast<double>(samples.size()) / seconds);
  return samples;
}

void log(const RecallRow& row, double seconds) {
  bench::Tally all = row.of(bench::kWide);
  all += row.of(bench::kNarrow);
  fmt::print(stderr, "{} {} {} {}: {:.1f} s, {} points, {} undecided, {} samples, {} missed; {} salient, {} lost{}\n",
             row.mesh, bench::name_of(row.mode), row.resolution, row.angle, seconds, row.points, row.undecided,
             all.samples, all.missed(), row.dismissal.samples, row.dismissal.lost(),
             row.undecided_listed ? "" : " or undecided");
  const auto name_all = [](const char* what, const std::vector<MedialSample>& samples) {
    for (const MedialSample& s : samples) {
      fmt::print(stderr, "  {} ({:.9f}, {:.9f}, {:.9f}) radius {:.6f} object angle {:.6f}\n", what, s.centre.x(),
                 s.centre.y(), s.centre.z(), s.radius, s.object_angle);
    }
  };
  name_all("missed", row.first_missed);
  if (row.mode == Mode::kCertified && row.undecided_listed) name_all("lost", row.first_lost);
}

/// If everything salient lies next to the centre of the box, that is a corner of voxels if their number is even.
std::vector<std::uint32_t> resolutions_for(const Subject& subject, const std::vector<std::uint32_t>& wanted) {
  std::vector<std::uint32_t> resolutions;
  for (const std::uint32_t resolution : wanted) {
    resolutions.push_back(resolution);
    if (subject.salient_at_a_point && resolution % 2 == 0) resolutions.push_back(resolution + 1);
  }
  return resolutions;
}

Status measure(const Subject& subject, const Options& options, Context* context, std::vector<RecallRow>& rows) {
  const std::vector<MedialSample> samples = draw_samples(subject, options);
  const Result<IndexedMesh> made = IndexedMesh::build(PreparedMesh(subject.mesh), {.threads = options.threads});
  if (!made.ok()) return made.error();
  const double margin = options.margin * subject.mesh.report.longest_side();
  const Result<IndexedMesh> searched =
      options.outside ? made.value().on_side({MeshSide::kOutside, margin, options.threads}) : made;
  if (!searched.ok()) return searched.error();
  const IndexedMesh& indexed = searched.value();
  for (const std::string& mode : options.modes) {
    const bool thesis = mode == "thesis";
    for (const std::uint32_t resolution :
         resolutions_for(subject, thesis ? options.thesis_resolutions : options.resolutions)) {
      for (const double angle : options.angles) {
        const auto start = std::chrono::steady_clock::now();
        ExtractionOptions extraction;
        extraction.mode = thesis ? Mode::kThesis : Mode::kCertified;
        extraction.resolution = resolution;
        extraction.object_angle = angle;
        extraction.threads = options.threads;
        const Extractor extractor = context != nullptr ? device_extractor(*context) : reference_extractor();
        const auto result = extract_and_certify(indexed, extraction, extractor);
        if (!result.ok()) return result.error();
        rows.push_back(bench::count_recall(subject.name, samples, extraction, result.value().extraction));
        log(rows.back(), seconds_since(start));
      }
    }
  }
  return {};
}

Status write(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) return Error{kCannotWrite, "cannot write " + file};
  return {};
}

Status run(const Options& options) {
  Result<std::vector<Subject>> subjects = load(options);
  if (!subjects.ok()) return subjects.error();
  if (subjects.value().empty()) {
    return Error{ErrorCode::kUsage, "name a mesh, a solid with --solid or parts with --arrangement"};
  }
  std::optional<Context> context;
  if (options.backend == "vulkan") {
    Result<Context> made = Context::create();
    if (!made.ok()) return made.error();
    context = std::move(made).value();
  }
  std::vector<RecallRow> rows;
  for (const Subject& subject : subjects.value()) {
    if (Status done = measure(subject, options, context ? &*context : nullptr, rows); !done) return done;
    // Written after every mesh, so that a run that is stopped keeps its results.
    if (options.csv.empty()) continue;
    if (Status done = write(options.csv, bench::to_csv(rows)); !done) return done;
  }
  const std::string tables =
      fmt::format("{} samples wanted for each mesh and threshold, seed {}; {}.\n\n{}", options.samples, options.seed,
                  context ? context->device().name : "CPU reference", bench::to_markdown(rows, options.angles));
  if (!options.markdown.empty()) return write(options.markdown, tables);
  fmt::print("{}", tables);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Recall of medial-vk against independent samples of the medial surface");
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  std::sort(options.angles.begin(), options.angles.end());
  if (options.thesis_resolutions.empty()) options.thesis_resolutions = options.resolutions;
  const Status done = run(options);
  if (!done) fmt::print(stderr, "bench_recall: {}\n", done.error().message);
  return done ? 0 : 1;
}
