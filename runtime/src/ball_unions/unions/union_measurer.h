// One union of balls after the other, measured in the same memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ball_unions/cells/cell_simplices.h"
#include "ball_unions/cells/power_cell.h"
#include "ball_unions/triangulation/ball_insertion.h"
#include "ball_unions/triangulation/regular_triangulation.h"
#include "medial_vk/ball_union.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// Used by one thread at a time.
class UnionMeasurer {
 public:
  /// Simplices and vertices of the envelope, of each kind, that make_room() provides for each ball: two to four times
  /// what medial balls and fits have.
  static constexpr std::size_t kRoomOfBall = 24;

  UnionMeasurer();
  ~UnionMeasurer();
  UnionMeasurer(const UnionMeasurer&) = delete;
  UnionMeasurer& operator=(const UnionMeasurer&) = delete;

  /// measure_ball_union() on the threads of a pool. It allocates nothing where the memory of
  /// the two calls before suffices, or that of make_room(), unless the balls have no triangulation of a linear size.
  /// The result is in result() until the next call. Errors: those of measure_ball_union(); result() is then undefined.
  Status measure(std::span<const Ball> balls, bool complex, WorkerPool& pool);
  /// Makes room for the most that unions of so many balls need, and for a complex with several times as many simplices
  /// as those of usual balls. Throws std::bad_alloc.
  void make_room(std::size_t balls, bool complex, WorkerPool& pool);
  /// May be taken.
  BallUnion& result() { return result_; }

  /// The number of threads that a union of so many balls gives work to.
  static std::size_t useful_threads(std::size_t balls);

 private:
  struct Chunk;

  void add_workers(WorkerPool& pool);
  void measure_scaled(bool complex, WorkerPool& pool);
  void measure_by_triangulation(WorkerPool& pool);
  void measure_one_by_one(WorkerPool& pool);
  template <class CellOf>
  void measure_block(std::size_t block, SimplexCollector& collector, const CellOf& cell_of);
  void join_chunks();
  void scale_back(double unit);

  std::vector<Ball> balls_;  // scaled
  std::vector<Point> centres_;
  std::vector<std::uint32_t> order_;
  BallInsertion insertion_;
  RegularTriangulation triangulation_;
  std::vector<std::unique_ptr<PowerCell>> cells_;              // by worker; each holds a table of all balls
  std::vector<std::unique_ptr<SimplexCollector>> collectors_;  // by worker
  std::vector<Chunk> chunks_;                                  // by block of balls, of a complex
  bool has_complex_ = false;
  BallUnion result_;
};

}  // namespace medial_vk
