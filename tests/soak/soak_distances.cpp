// Distances without end: soak_distances FIRST COUNT [SECONDS] [MODEL ...]. Compares all that the library says about
// pairs of solids with the reference, for the seeds from FIRST on, and prints a table by kinds of poses, with a line
// for every fault. Without a MODEL: of generated solids; else of these meshes, and few of the others; of a folder, all
// its meshes. Balls are fitted by the library, where it fits any. The exit code is 1 if there is a fault.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "input/read_mesh.h"
#include "medial_vk/sphere_fits.h"
#include "support/distances/distance_cases.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::test;

constexpr int kCells = 5;

/// Balls as users have them; those of a grid where the mesh is open or no ball fits.
BallSets fitted_balls(const IndexedMesh& mesh, Context& context) {
  BallSets sets = grid_balls(mesh, kCells);
  if (!mesh.prepared().report.closed) return sets;
  SphereFitOptions options;
  options.count = 64;
  for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover}) {
    options.contract = contract;
    Result<SphereFit> fit = fit_spheres(mesh, options, context);
    if (!fit.ok()) {
      fmt::print(stderr, "balls of a grid: {}\n", fit.error().message);
      continue;
    }
    (contract == SphereContract::kInside ? sets.inside : sets.cover) = fit.value().levels.back();
  }
  return sets;
}

/// The files, and in the place of each folder the meshes in it, in the order of their names.
std::vector<std::string> files_of(const std::vector<std::string>& models) {
  std::vector<std::string> files;
  for (const std::string& model : models) {
    if (!std::filesystem::is_directory(model)) {
      files.push_back(model);
      continue;
    }
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(model)) {
      const std::string ending = entry.path().extension().string();
      const bool is_mesh = ending == ".obj" || ending == ".ply" || ending == ".stl" || ending == ".off";
      if (is_mesh && entry.is_regular_file()) found.push_back(entry.path().string());
    }
    std::ranges::sort(found);
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::vector<DistanceSolid> solids_of(const std::vector<std::string>& models) {
  std::vector<DistanceSolid> generated =
      generated_distance_solids([&](const IndexedMesh& mesh) { return grid_balls(mesh, kCells); });
  if (models.empty()) return generated;
  Context context = make_context();
  std::vector<DistanceSolid> solids;
  for (const std::string& file : files_of(models)) {
    Result<Mesh> mesh = read_mesh(file);
    if (!mesh.ok()) {
      fmt::print(stderr, "{}\n", mesh.error().message);
      std::exit(2);
    }
    const std::string name = file.substr(file.rfind('/') + 1);
    bool is_closed = true;
    const auto balls = [&](const IndexedMesh& indexed) {
      is_closed = indexed.prepared().report.closed;
      return fitted_balls(indexed, context);
    };
    Mesh small = mesh.value();
    scale(small, 0.05);
    const std::pair<std::string, const Mesh*> sizes[] = {{name, &mesh.value()}, {"small " + name, &small}};
    for (const auto& [full_name, of_size] : sizes) {
      solids.push_back(make_distance_solid(full_name, *of_size, false, balls));
      solids.back().is_degenerate = !is_closed;
      fmt::print(stderr, "{}: {} triangles, {}\n", full_name, of_size->triangles.size(), is_closed ? "closed" : "open");
    }
  }
  for (DistanceSolid& solid : generated) {
    if (solid.is_degenerate) solids.push_back(std::move(solid));
  }
  return solids;
}

struct Row {
  std::uint64_t count = 0, hits = 0, free = 0, undecided = 0, faulty = 0;
  double excess = 0, width = 0;
};

class Table {
 public:
  void add(PoseKind kind, const CaseOutcome& outcome) {
    for (Row* row : {&rows_[static_cast<std::size_t>(kind)], &rows_.back()}) {
      ++row->count;
      row->hits += outcome.collision == Collision::kHit ? 1 : 0;
      row->free += outcome.collision == Collision::kFree ? 1 : 0;
      row->undecided += outcome.found == Collision::kUndecided ? 1 : 0;
      row->faulty += outcome.faults.empty() ? 0 : 1;
      row->excess = std::max(row->excess, outcome.excess);
      row->width = std::max(row->width, outcome.width);
    }
    for (const std::string& fault : outcome.faults) fmt::print("{}\n", fault);
  }

  void print() const {
    fmt::print(
        "| poses | number | apart | meet | undecided by distance() | greatest width | greatest excess | wrong |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      fmt::print("| {} | {} | {} | {} | {} | {:.3g} | {:.3g} | {} |\n", i < kPoseKinds ? kPoseKindNames[i] : "all",
                 row.count, row.free, row.hits, row.undecided, row.width, row.excess, row.faulty);
    }
    fmt::print(
        "\nWidths, of distance() without a tolerance, and excesses, by which the reference's distance lies out of "
        "an interval of distance(), are in units of 2^-53 of the sum of both reaches and the shift.\n");
  }

  std::uint64_t faulty() const { return rows_.back().faulty; }

 private:
  std::array<Row, kPoseKinds + 1> rows_;  // the last one is of all kinds
};

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: soak_distances FIRST COUNT [SECONDS] [MODEL ...]\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  const double seconds = argc > 3 ? std::strtod(argv[3], nullptr) : 1e30;
  const std::vector<DistanceSolid> solids = solids_of({argv + std::min(argc, 4), argv + argc});
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  Table table;
  std::uint64_t done = 0;
  for (double told = 0; done < count && elapsed() < seconds; ++done) {
    const DistanceCase distance_case = make_distance_case(solids, first + done);
    table.add(distance_case.kind, check_distance_case(distance_case, first + done));
    if (elapsed() < told + 10) continue;
    told = elapsed();
    fmt::print(stderr, "{} of {} poses, {} wrong, {:.0f} s\n", done + 1, count, table.faulty(), told);
    std::fflush(stdout);
  }
  table.print();
  fmt::print("{} poses of {} solids from seed {}, {} wrong, {:.0f} s\n", done, solids.size(), first, table.faulty(),
             elapsed());
  return table.faulty() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
