// The search for one cover: its steps, its reduction, its proof.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solid/solid.h"
#include "sphere_fits/cover/cover_search.h"
#include "sphere_fits/quality/envelope.h"

namespace medial_vk {

/// Deterministic. Throws std::bad_alloc, and the exceptions of `report`.
class Cover {
 public:
  /// Called with the finished share, from any thread at any time; a share that is smaller than before is ignored. May
  /// throw Stopped.
  using Report = std::function<void(double)>;

  /// Balls grow from these. With probes, what counts is how near balls come to their points outside, and the volume
  /// less. Keeps a reference to the solid.
  Cover(const Solid& solid, std::vector<Ball> balls, unsigned threads, const Report& report,
        std::span<const Probe> probes = {});

  /// Repeats steps until they gain little, between two shares of the work; then also with finer elements.
  void search(double from, double until);
  void polish();
  /// Removes one ball, and improves its neighbours; improves all balls each time an eighth has been removed.
  void shrink();

  /// The balls; some may have radius 0.
  std::size_t count() const { return search_.balls().size(); }
  /// The exact volume of the union; that of certified() is not smaller. With probes, the sum of all columns.
  double volume() const { return volume_; }
  /// Fills the gaps that the proof finds, and finally lets all balls grow until it finds none.
  std::vector<Ball> certified() const;

 private:
  bool is_many() const;
  double measure() const;
  void keep();
  void improve(int rounds, double from, double until);
  std::vector<Ball> enlarged(double by) const;
  bool fill(const Envelope& envelope);

  const Solid& solid_;
  Threads threads_;
  Report report_;
  CoverSearch search_;
  std::vector<Ball> best_;
  bool has_probes_;
  double volume_ = 0;
  std::size_t improved_ = 0;  // number of balls when all were last improved
};

/// The full search from these balls, or, where balls are few, from others if the result is smaller. With probes: as for
/// Cover.
Cover search_cover(const Solid& solid, std::vector<Ball> inside, unsigned threads, const Cover::Report& report,
                   std::span<const Probe> probes = {});

/// The smallest ball that holds all vertices, with a margin.
Ball ball_around(const Solid& solid);

}  // namespace medial_vk
