// One cover on its way: searched, made smaller, proved.
#pragma once

#include <functional>
#include <vector>

#include "mesh/solid.h"
#include "spheres/cover/cover_search.h"
#include "spheres/measures/envelope.h"

namespace medial_vk {

/// Deterministic. Throws std::bad_alloc, and what `report` throws.
class Cover {
 public:
  /// Called with the share done, from any thread at any time; a smaller one than before is no news. May throw Stopped.
  using Report = std::function<void(double)>;

  /// Balls grow from these. Keeps a reference to the solid.
  Cover(const Solid& solid, std::vector<Ball> balls, unsigned threads, const Report& report);

  /// Steps until they gain little, between two shares of the work; then also with finer pieces.
  void search(double from, double until);
  void polish();
  /// One ball less, and its neighbours after it; now and then all.
  void shrink();

  /// Balls, some of them perhaps with radius 0.
  std::size_t count() const { return search_.balls().size(); }
  /// Of the union, exactly; what certified() gives is not smaller.
  double volume() const { return volume_; }
  /// The proof decides. What it finds open is filled; at last all balls grow until it finds nothing.
  std::vector<Ball> certified() const;

 private:
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
  double volume_ = 0;
  std::size_t improved_ = 0;  // how many balls there were when all were improved
};

/// From these, or, where balls are few, from others if that comes out smaller; as far as it goes.
Cover search_cover(const Solid& solid, std::vector<Ball> inside, unsigned threads, const Cover::Report& report);

/// The smallest ball that holds all vertices, and a little more.
Ball ball_around(const Solid& solid);

}  // namespace medial_vk
