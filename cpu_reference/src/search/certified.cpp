// The certified mode: coarse to fine, every cell found, proved empty, or counted as undecided.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "dismissal/contacts.h"
#include "search/modes.h"
#include "search/search.h"
#include "search/side.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kFluxSamples = 50;

class Certified {
 public:
  /// The trusted triangles of the mesh must be those of `cones`.
  Certified(const Mesh& mesh, const Tree& tree, const SpokeCones& cones, const Grid& grid, const Thresholds& thresholds,
            const Options& options, Watch& watch, Result& result)
      : mesh_(mesh),
        tree_(tree),
        grid_(grid),
        thresholds_(thresholds),
        sides_(mesh, tree),
        search_(tree, cones, sides_, grid, thresholds, options.extra_levels, watch, result),
        spiral_(spiral_points(kFluxSamples)),
        watch_(watch),
        result_(result) {}

  void run_top(const Vector3i& cell) { visit(cell, 0, list_of_top(cell), Side::kMixed); }

  /// The time in seconds for one voxel. Of the time for a cell above it, the share of the voxel in that cell counts.
  double time_of(const Vector3i& voxel) {
    using Clock = std::chrono::steady_clock;
    const int finest = grid_.levels - 1;
    const auto cell_of = [&](int level) { return Vector3i(voxel / (1 << (finest - level))); };
    Clock::time_point start = Clock::now();
    double seconds = 0;
    const auto count = [&](int level) {
      const Clock::time_point now = Clock::now();
      seconds += std::ldexp(std::chrono::duration<double>(now - start).count(), -3 * (finest - level));
      start = now;
    };
    ContactList list = list_of_top(cell_of(0));
    Side where = Side::kMixed;
    for (int level = 0; level < finest; ++level) {
      if (level > 0) list = ContactList(list, grid_.centre(cell_of(level), level), list_reach(level));
      const bool is_kept = keeps(level, list, where);
      count(level);
      if (!is_kept) return seconds;
    }
    visit_voxel(voxel, list, where);
    count(finest);
    return seconds;
  }

 private:
  /// With one level only, the finest voxels are top-level cells and take their list from a cell of their own size.
  ContactList list_of_top(const Vector3i& cell) {
    ++result_.queries;
    return ContactList(tree_, mesh_, grid_.centre(cell, 0), list_reach(0));
  }

  /// Bounds all query points below a cell: its own, pushed ones (epsilon), and the flux samples of its voxels, at one
  /// voxel side l from voxel centres that are at most circumradius - l sqrt(3)/2 from the cell's.
  double list_reach(int level) const {
    const double voxel = grid_.voxel_size;
    const double extra = std::max(thresholds_.epsilon, voxel - circumradius(voxel));
    return circumradius(grid_.cell_size(level)) + extra * (1 + 1e-6);
  }

  /// `list` is the cell's own, except for finest voxels, which use that of the parent.
  void visit(const Vector3i& cell, int level, const ContactList& list, Side where) {
    if (level == grid_.levels - 1) {
      visit_voxel(cell, list, where);
      return;
    }
    if (watch_.stops()) return;
    if (!keeps(level, list, where)) {
      watch_.add(std::ldexp(1.0, 3 * (grid_.levels - 1 - level)));
      return;
    }
    for (int k = 0; k < 8; ++k) {
      const Vector3i child = child_of(cell, k);
      if (!grid_.reaches(child, level + 1)) continue;
      if (level + 1 == grid_.levels - 1) {
        visit(child, level + 1, list, where);
        continue;
      }
      ++result_.queries;
      visit(child, level + 1, ContactList(list, grid_.centre(child, level + 1), list_reach(level + 1)), where);
    }
  }

  /// False if the cell is outside, or proved to hold no salient point. Determines the side of the cell if it can.
  bool keeps(int level, const ContactList& list, Side& where) {
    LevelCount& count = result_.levels[level];
    ++count.visited;
    const Closest& nearest = list.nearest_to_centre();
    const double reach = circumradius(grid_.cell_size(level)) * (1 + 1e-9);
    if (where == Side::kMixed) where = sides_.of_ball(list.centre(), reach, nearest);
    if (where == Side::kOutside) return false;
    const double angle = thresholds_.angle_at(nearest.distance + reach);
    if (spokes_are_close(tree_, list.within(reach), reach, angle)) return false;
    ++count.kept;
    count.contacts += list.contacts().size();
    return true;
  }

  void visit_voxel(const Vector3i& voxel, const ContactList& parent, Side where) {
    watch_.add(1);
    Sphere sphere;
    switch (search_.run(voxel, where, parent, sphere)) {
      case Outcome::kFound:
        ++result_.found;
        sphere.flux = flux(voxel, parent);
        result_.spheres.push_back(sphere);
        break;
      case Outcome::kEmpty:
        ++result_.proved_empty;
        break;
      case Outcome::kUndecided:
        ++result_.undecided;
        result_.undecided_voxels.push_back(search_.undecided());
        break;
    }
  }

  /// As outward_flux(), with the list of the parent.
  double flux(const Vector3i& voxel, const ContactList& parent) {
    const Vector3d centre = grid_.centre(voxel, grid_.levels - 1);
    const auto closest = [&](const Vector3d& p) {
      ++result_.queries;
      return parent.closest(p);
    };
    return outward_flux(closest, centre, grid_.voxel_size, spiral_).average;
  }

  const Mesh& mesh_;
  const Tree& tree_;
  const Grid& grid_;
  const Thresholds& thresholds_;
  Sides sides_;
  VoxelSearch search_;
  std::vector<Vector3d> spiral_;
  Watch& watch_;
  Result& result_;
};

/// Measures voxels until their time is a fiftieth of that of all, but for no longer than a second and no shorter than
/// a twentieth of one.
class Sampling {
 public:
  explicit Sampling(const Grid& grid) : grid_(grid), watch_([this](double) { return elapsed() < kLongest; }, 1) {}
  Sampling(const Sampling&) = delete;
  Sampling& operator=(const Sampling&) = delete;

  Watch& watch() { return watch_; }

  TimeEstimate run(Certified& certified) {
    std::mt19937_64 random(1);
    start_ = Clock::now();
    do {
      Vector3i voxel;
      for (int a = 0; a < 3; ++a) {
        voxel[a] = std::uniform_int_distribution<int>(0, grid_.size[a] - 1)(random);
      }
      sum_ += certified.time_of(voxel);
      ++estimate_.voxels;
      estimate_.is_cut_off = watch_.has_stopped();
      estimate_.seconds = grid_.size.cast<double>().prod() * sum_ / estimate_.voxels;
    } while (!watch_.stops() && !is_enough());
    return estimate_;
  }

 private:
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  bool is_enough() const { return elapsed() > std::max(0.05, 0.02 * estimate_.seconds); }

  static constexpr double kLongest = 1;  // second
  using Clock = std::chrono::steady_clock;
  const Grid& grid_;
  Clock::time_point start_;
  double sum_ = 0;
  TimeEstimate estimate_;
  Watch watch_;
};

}  // namespace

void extract_certified(const Mesh& mesh, const Tree& tree, const Grid& grid, const Options& options,
                       const CellLoop& loop, Watch& watch, const std::function<void(const TimeEstimate&)>& on_estimate,
                       Result& result) {
  const Thresholds thresholds(options, grid, tree.longest_side());
  const SpokeCones cones(mesh, tree);
  Mesh careful = mesh;
  careful.trusted = cones.trusted();
  if (on_estimate) {
    // With sides and counts of its own: the search finds the same with and without an estimate.
    Result unused = result;
    Sampling sampling(grid);
    Certified sampled(careful, tree, cones, grid, thresholds, options, sampling.watch(), unused);
    on_estimate(sampling.run(sampled));
  }
  Certified certified(careful, tree, cones, grid, thresholds, options, watch, result);
  loop([&](const Vector3i& cell) { certified.run_top(cell); });
}

}  // namespace medial_vk::reference
