#include "medial_vk/ball_union.h"

#include <algorithm>
#include <optional>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/cells/cell_simplices.h"
#include "ball_unions/triangulation/regular_triangulation.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "base/point_order.h"

namespace medial_vk {
namespace {

/// Number of consecutive balls that one thread measures. It depends only on their total number, so that results are the
/// same to the byte for any number of threads. Every block has a PowerCell, which holds a table of all balls: at most
/// 65 of these.
std::size_t block_of(std::size_t balls) { return std::max<std::size_t>(balls / 64, 64); }

std::vector<std::uint32_t> order_of(std::span<const Ball> balls) {
  std::vector<Point> centres;
  centres.reserve(balls.size());
  for (const Ball& ball : balls) centres.push_back(ball.centre);
  return order_by_halving(centres);
}

/// The contribution of one block of balls to the lists.
struct Chunk {
  DualComplex complex;
  std::vector<EnvelopeVertex> vertices;
};

class Measuring {
 public:
  Measuring(std::span<const Ball> balls, const BallUnionOptions& options)
      : balls_(balls),
        options_(options),
        threads_(thread_count(options.threads)),
        block_(block_of(balls.size())),
        order_(order_of(balls)),
        triangulation_(RegularTriangulation::build(balls, order_, threads_)) {
    if (!triangulation_) tree_.emplace(balls, threads_);
  }

  BallUnion run() {
    result_.volumes.resize(balls_.size());
    result_.areas.resize(balls_.size());
    result_.vectors.resize(balls_.size(), Point{0, 0, 0});
    if (options_.complex) chunks_.resize((balls_.size() + block_ - 1) / block_);
    parallel_blocks(balls_.size(), block_, threads_, [&](std::size_t begin, std::size_t end) { measure(begin, end); });
    result_.volume = careful_sum(result_.volumes);
    result_.area = careful_sum(result_.areas);
    for (const Chunk& chunk : chunks_) {
      append(result_.complex, chunk.complex);
      append(result_.vertices, chunk.vertices);
    }
    if (options_.complex) make_complete(result_.complex, result_.vertices);
    return std::move(result_);
  }

 private:
  void measure(std::size_t begin, std::size_t end) {
    if (triangulation_) {
      PowerCell cell(triangulation_->balls());
      measure(begin, end, [&](std::uint32_t i) -> const PowerCell& {
        cell.start(i, *triangulation_);
        cell.sharpen();
        return cell;
      });
    } else {
      CellBuilder builder(balls_, *tree_);
      measure(begin, end, [&](std::uint32_t i) -> const PowerCell& { return builder.build(i); });
    }
  }

  template <class CellOf>
  void measure(std::size_t begin, std::size_t end, const CellOf& cell_of) {
    SimplexCollector collector;
    for (std::size_t n = begin; n < end; ++n) {
      const std::uint32_t i = order_[n];
      const Ball& ball = balls_[i];
      if (ball.radius == 0) continue;
      const PowerCell& cell = cell_of(i);
      const BallInCell part = measure_ball_in_cell(cell, ball.radius);
      result_.volumes[i] = part.volume;
      result_.areas[i] = part.area;
      result_.vectors[i] = part.area_vector;
      if (options_.complex) {
        Chunk& chunk = chunks_[begin / block_];
        collector.collect(cell, ball, chunk.complex, chunk.vertices);
      }
    }
  }

  std::span<const Ball> balls_;
  BallUnionOptions options_;
  unsigned threads_;
  std::size_t block_;
  std::vector<std::uint32_t> order_;
  std::optional<RegularTriangulation> triangulation_;
  std::optional<BallTree> tree_;  // used without a triangulation: each cell is cut by itself
  std::vector<Chunk> chunks_;
  BallUnion result_;
};

void scale_back(BallUnion& result, double unit) {
  const double square = unit * unit, cube = square * unit;
  for (double& volume : result.volumes) volume *= cube;
  for (double& area : result.areas) area *= square;
  for (Point& vector : result.vectors) vector = square * vector;
  for (EnvelopeVertex& vertex : result.vertices) vertex.at = unit * vertex.at;
  result.volume *= cube;
  result.area *= square;
}

}  // namespace

Result<BallUnion> measure_ball_union(std::span<const Ball> balls, const BallUnionOptions& options) {
  if (const Status status = check_balls(balls); !status.ok()) return status.error();
  return catch_out_of_memory("measuring a union of balls", [&]() -> Result<BallUnion> {
    const double scale = scale_of(balls);
    const std::vector<Ball> unit_balls = scaled_balls(balls, scale);
    BallUnion result = Measuring(unit_balls, options).run();
    scale_back(result, 1 / scale);
    return result;
  });
}

}  // namespace medial_vk
