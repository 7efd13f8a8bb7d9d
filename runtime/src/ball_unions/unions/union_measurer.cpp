#include "ball_unions/unions/union_measurer.h"

#include <algorithm>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/ball_tree.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/cells/cell_simplices.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/point_ops.h"
#include "base/point_order.h"

namespace medial_vk {
namespace {

/// Number of consecutive balls that one thread measures. It depends only on their total number, so that results are the
/// same to the byte for any number of threads.
std::size_t block_of(std::size_t balls) { return std::max<std::size_t>(balls / 64, 64); }

std::size_t blocks_of(std::size_t balls) { return (balls + block_of(balls) - 1) / block_of(balls); }

void make_room_for(DualComplex& complex, std::vector<EnvelopeVertex>& vertices, std::size_t balls) {
  complex.vertices.reserve(UnionMeasurer::kRoomOfBall *
                           balls);  // with the ends of all edges, before those are sorted out
  complex.edges.reserve(UnionMeasurer::kRoomOfBall * balls);
  complex.triangles.reserve(UnionMeasurer::kRoomOfBall * balls);
  complex.tetrahedra.reserve(UnionMeasurer::kRoomOfBall * balls);
  vertices.reserve(UnionMeasurer::kRoomOfBall * balls);
}

}  // namespace

/// The contribution of one block of balls to the lists.
struct UnionMeasurer::Chunk {
  DualComplex complex;
  std::vector<EnvelopeVertex> vertices;

  void clear() {
    medial_vk::clear(complex);
    vertices.clear();
  }
};

UnionMeasurer::UnionMeasurer() = default;
UnionMeasurer::~UnionMeasurer() = default;

std::size_t UnionMeasurer::useful_threads(std::size_t balls) { return std::max<std::size_t>(blocks_of(balls), 1); }

Status UnionMeasurer::measure(std::span<const Ball> balls, bool complex, WorkerPool& pool) {
  if (Status status = check_balls(balls); !status.ok()) return status;
  return catch_out_of_memory("measuring a union of balls", [&]() -> Status {
    const double scale = scale_of(balls);
    balls_.resize(balls.size());
    std::ranges::transform(balls, balls_.begin(), [scale](const Ball& ball) { return scaled_ball(ball, scale); });
    measure_scaled(complex, pool);
    scale_back(1 / scale);
    return {};
  });
}

void UnionMeasurer::add_workers(WorkerPool& pool) {
  while (cells_.size() < pool.threads()) cells_.push_back(std::make_unique<PowerCell>(triangulation_.balls()));
  while (collectors_.size() < pool.threads()) collectors_.push_back(std::make_unique<SimplexCollector>());
}

void UnionMeasurer::make_room(std::size_t balls, bool complex, WorkerPool& pool) {
  const std::size_t all = balls + RegularTriangulation::kFarPoints;
  balls_.reserve(balls);
  centres_.reserve(balls);
  order_.reserve(balls);
  result_.volumes.reserve(balls);
  result_.areas.reserve(balls);
  result_.vectors.reserve(balls);
  insertion_.make_room(balls);
  triangulation_.make_room(balls, pool.threads());
  add_workers(pool);
  for (const auto& cell : cells_) cell->make_room(all, all);
  if (!complex) return;
  for (const auto& collector : collectors_) collector->make_room(all + PowerCell::kWalls);
  while (chunks_.size() < blocks_of(balls)) chunks_.emplace_back();
  for (Chunk& chunk : chunks_) make_room_for(chunk.complex, chunk.vertices, block_of(balls));
  make_room_for(result_.complex, result_.vertices, balls);
}

void UnionMeasurer::measure_scaled(bool complex, WorkerPool& pool) {
  result_.volumes.assign(balls_.size(), 0);
  result_.areas.assign(balls_.size(), 0);
  result_.vectors.assign(balls_.size(), Point{0, 0, 0});
  has_complex_ = complex;
  while (complex && chunks_.size() < blocks_of(balls_.size())) chunks_.emplace_back();
  for (Chunk& chunk : chunks_) chunk.clear();
  centres_.resize(balls_.size());
  std::ranges::transform(balls_, centres_.begin(), &Ball::centre);
  order_by_halving(centres_, order_);
  if (triangulation_.rebuild(balls_, order_, insertion_, pool)) {
    measure_by_triangulation(pool);
  } else {
    measure_one_by_one(pool);
  }
  result_.volume = careful_sum(result_.volumes);
  result_.area = careful_sum(result_.areas);
  join_chunks();
}

void UnionMeasurer::measure_by_triangulation(WorkerPool& pool) {
  add_workers(pool);
  for (const auto& cell : cells_) cell->use(triangulation_.balls());
  pool.run(blocks_of(balls_.size()), 1, [&](std::size_t block, unsigned worker) {
    PowerCell& cell = *cells_[worker];
    measure_block(block, *collectors_[worker], [&](std::uint32_t i) -> const PowerCell& {
      cell.start(i, triangulation_);
      cell.sharpen();
      return cell;
    });
  });
  share_room(cells_, [](PowerCell& cell, const PowerCell& of) { cell.make_room_of(of); });
  const auto grow = [](SimplexCollector& collector, const SimplexCollector& of) { collector.make_room_of(of); };
  if (has_complex_) share_room(collectors_, grow);
}

/// Each cell is cut by itself, from the balls around it.
void UnionMeasurer::measure_one_by_one(WorkerPool& pool) {
  const BallTree tree(balls_, pool.threads());
  pool.run(blocks_of(balls_.size()), 1, [&](std::size_t block) {
    CellBuilder builder(balls_, tree);
    SimplexCollector collector;
    measure_block(block, collector, [&](std::uint32_t i) -> const PowerCell& { return builder.build(i); });
  });
}

template <class CellOf>
void UnionMeasurer::measure_block(std::size_t block, SimplexCollector& collector, const CellOf& cell_of) {
  const std::size_t begin = block * block_of(balls_.size());
  const std::size_t end = std::min(begin + block_of(balls_.size()), balls_.size());
  for (std::size_t n = begin; n < end; ++n) {
    const std::uint32_t i = order_[n];
    const Ball& ball = balls_[i];
    if (ball.radius == 0) continue;
    const PowerCell& cell = cell_of(i);
    const BallInCell part = measure_ball_in_cell(cell, ball.radius);
    result_.volumes[i] = part.volume;
    result_.areas[i] = part.area;
    result_.vectors[i] = part.area_vector;
    if (has_complex_) collector.collect(cell, ball, chunks_[block].complex, chunks_[block].vertices);
  }
}

void UnionMeasurer::join_chunks() {
  clear(result_.complex);
  result_.vertices.clear();
  if (!has_complex_) return;
  for (const Chunk& chunk : chunks_) {
    append(result_.complex, chunk.complex);
    append(result_.vertices, chunk.vertices);
  }
  make_complete(result_.complex, result_.vertices);
}

void UnionMeasurer::scale_back(double unit) {
  const double square = unit * unit, cube = square * unit;
  for (double& volume : result_.volumes) volume *= cube;
  for (double& area : result_.areas) area *= square;
  for (Point& vector : result_.vectors) vector = square * vector;
  for (EnvelopeVertex& vertex : result_.vertices) vertex.at = unit * vertex.at;
  result_.volume *= cube;
  result_.area *= square;
}

}  // namespace medial_vk
