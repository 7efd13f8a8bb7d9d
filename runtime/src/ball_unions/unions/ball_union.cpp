#include "medial_vk/ball_union.h"

#include <algorithm>
#include <utility>

#include "ball_unions/unions/union_measurer.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "threads/worker_pool.h"

namespace medial_vk {

Result<BallUnion> measure_ball_union(std::span<const Ball> balls, const BallUnionOptions& options) {
  return catch_out_of_memory("measuring a union of balls", [&]() -> Result<BallUnion> {
    const std::size_t threads =
        std::min<std::size_t>(thread_count(options.threads), UnionMeasurer::useful_threads(balls.size()));
    WorkerPool pool(static_cast<unsigned>(threads));
    UnionMeasurer measurer;
    if (Status status = measurer.measure(balls, options.complex, pool); !status) return status.error();
    return std::move(measurer.result());
  });
}

}  // namespace medial_vk
