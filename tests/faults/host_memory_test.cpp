// Host memory that runs out: every allocation of the library fails once.
// long: one fixture, and a test for each part of the library
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <numeric>

#include "ball_unions/unions/union_measurer.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "echo_queries.h"
#include "failing_new.h"
#include "fault_test.h"
#include "lent_device.h"
#include "medial_vk/ball_hull.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/dynamic_union.h"
#include "medial_vk/foam.h"
#include "medial_vk/follower.h"
#include "medial_vk/hull_union.h"
#include "medial_vk/shrinking_union.h"
#include "support/solids/ball_families.h"
#include "threads/worker_pool.h"

namespace medial_vk::test {
namespace {

class HostMemory : public FaultTest {
 protected:
  /// Fails every allocation of the job (fault_stride()), or every `stride`-th of them, one per run.
  void fail_every_allocation(const char* name, const std::function<Answer()>& job, std::uint64_t stride = 1) {
    const Answer expected = job();
    ASSERT_TRUE(expected.ok()) << expected.error().message;
    const auto handles = vulkan().handles();
    std::uint64_t errors = 0, survived = 0;
    for (std::uint64_t k = 1; !HasFailure(); k += stride * fault_stride()) {
      fail_new(k);
      const Answer answer = job();
      const bool failed = stop_failing_new();
      SCOPED_TRACE(std::string(name) + ", allocation " + std::to_string(k));
      if (answer.ok()) {
        EXPECT_TRUE(answer.value() == expected.value());
      } else {
        EXPECT_EQ(answer.error().code, ErrorCode::kOutOfMemory) << answer.error().message;
      }
      EXPECT_EQ(vulkan().handles(), handles);
      if (!failed) break;
      ++(answer.ok() ? survived : errors);
    }
    EXPECT_GT(errors, 0u);
    std::cout << name << ": " << errors << " errors, " << survived << " survived\n";
  }
};

TEST_F(HostMemory, RunsOutWhileOpeningADevice) {
  const ProgramKey key = {"prepare_resolve", 1, 0, 0, 1, {}};
  fail_every_allocation("opening a device", [&]() -> Answer {
    Result<Context> context = open();
    if (!context.ok()) return context.error();
    ContextImpl& impl = Internals::of(context.value());
    const auto program =
        in_runtime([&] { return catch_out_of_memory("making a program", [&] { return impl.program(key); }); });
    if (!program.ok()) return program.error();
    return std::string("open");
  });
}

TEST_F(HostMemory, RunsOutInQueries) {
  Result<Context> context = open();
  ASSERT_TRUE(context.ok());
  const PreparedMesh mesh = small_box();
  fail_every_allocation("queries", [&] { return make_scene_and_query(context.value(), mesh); });
}

TEST_F(HostMemory, RunsOutInManyPoses) {
  Result<Context> context = open();
  ASSERT_TRUE(context.ok());
  fail_every_allocation("many poses", [&] { return query_bodies(context.value()); });
  fail_every_allocation("poses in batches", [&] { return query_bodies(context.value(), true); });
}

TEST_F(HostMemory, RunsOutInCertifiedExtraction) {
  Result<Context> context = open();
  ASSERT_TRUE(context.ok());
  const PreparedMesh mesh = small_box();
  fail_every_allocation("certified extraction", [&] { return extract(context.value(), mesh, Mode::kCertified); });
}

TEST_F(HostMemory, RunsOutInThesisExtraction) {
  Result<Context> context = open();
  ASSERT_TRUE(context.ok());
  const PreparedMesh mesh = small_box();
  fail_every_allocation("thesis extraction", [&] { return extract(context.value(), mesh, Mode::kThesis); });
}

// Copies are in progress on a queue of their own when memory runs out: nothing that they use is destroyed before them.
TEST_F(HostMemory, RunsOutBesideCopies) {
  DeviceProfile discrete;
  discrete.split_memory = true;
  discrete.copying_queue = LateQueue::kCopies;
  vulkan().set_profile(discrete);
  {
    Context context = open().value();
    std::vector<float> values(290);
    std::iota(values.begin(), values.end(), 1.0f);
    fail_every_allocation("many batches", [&]() -> Answer {
      std::vector<float> answers(values.size());
      QueryBatches batches(Internals::of(context), 64, false);
      const QuerySet queries = echo(values, answers);
      const Status status =
          in_runtime([&] { return catch_out_of_memory("the queries", [&] { return batches.run(queries); }); });
      if (!status.ok()) return status.error();
      std::string out;
      for (const float a : answers) append_bytes(out, a);
      return out;
    });
    const PreparedMesh mesh = small_box();
    fail_every_allocation("queries, two queues", [&] { return make_scene_and_query(context, mesh); });
    fail_every_allocation("certified extraction, two queues", [&] { return extract(context, mesh, Mode::kCertified); });
  }
}

// The callback's allocations count as the foam's: their exceptions are caught with the rest.
TEST_F(HostMemory, RunsOutInAFoam) {
  const Ball sphere = {{0, 0, 0}, 1};
  const NearestPointsFunction nearest = [](std::span<const Point> queries) -> Result<std::vector<Point>> {
    std::vector<Point> out;
    for (const Point& q : queries) out.push_back(q[1] > 0 ? Point{0.05, 1.5, 0} : Point{0, -1.6, 0.1});
    return out;
  };
  fail_every_allocation("a foam", [&]() -> Answer {
    auto samples = in_runtime([&] { return sample_sphere(sphere, {.count = 2}, nearest); });
    if (!samples.ok()) return samples.error();
    const auto coarse = in_runtime([&] { return Foam::build(samples.value().samples, sphere); });
    if (!coarse.ok()) return coarse.error();
    const Status refined = in_runtime([&] { return refine_samples(coarse.value(), 0, nearest, samples.value()); });
    if (!refined.ok()) return refined.error();
    const auto foam = in_runtime([&] { return Foam::build(samples.value().samples, sphere); });
    if (!foam.ok()) return foam.error();
    std::string out;
    for (const Ball& ball : foam.value().empty_balls()) append_bytes(out, ball);
    return out;
  });
}

std::string bytes_of(const BallUnion& measured, const BettiNumbers& betti) {
  std::string out;
  for (const double volume : measured.volumes) append_bytes(out, volume);
  for (const double area : measured.areas) append_bytes(out, area);
  for (const auto& tetrahedron : measured.complex.tetrahedra) append_bytes(out, tetrahedron);
  append_bytes(out, betti);
  return out;
}

// The union is measured on one thread, whose allocations fail. Degenerate balls need exact arithmetic, which allocates.
TEST_F(HostMemory, RunsOutInAUnionOfBalls) {
  for (const std::vector<Ball>& balls :
       {random_balls(40, 1, 0.1, 0.3), lattice(3, 0.9), through_a_point(20, 2, true)}) {
    fail_every_allocation("a union of balls", [&]() -> Answer {
      const auto measured = in_runtime([&] { return measure_ball_union(balls, {.threads = 1, .complex = true}); });
      if (!measured.ok()) return measured.error();
      const auto betti = in_runtime([&] { return betti_numbers(measured.value().complex); });
      if (!betti.ok()) return betti.error();
      return bytes_of(measured.value(), betti.value());
    });
  }
}

// On one thread, as above.
TEST_F(HostMemory, RunsOutInAUnionOfHulls) {
  const std::vector<BallHull> hulls = {hull_of({{0, 0, 0}, 0.2}, {{1, 0, 0}, 0.1}, {{0, 1, 0}, 0.15}),
                                       hull_of({{0, 0, 0.2}, 0.2}, {{1, 1, 1}, 0.1}), hull_of({{1, 1, 1}, 0.3})};
  fail_every_allocation("a union of hulls", [&]() -> Answer {
    const auto bounds = in_runtime([&] { return measure_hull_union(hulls, {.width = 0.4, .threads = 1}); });
    if (!bounds.ok()) return bounds.error();
    std::string out;
    append_bytes(out, bounds.value());
    return out;
  });
}

TEST_F(HostMemory, RunsOutInTheMeshOfAHull) {
  const BallHull slab = hull_of({{0, 0, 0}, 0.2}, {{1, 0, 0}, 0.1}, {{0, 1, 0}, 0.15});
  for (const BallHull& hull : {slab, hull_of(slab.corners[0], slab.corners[1])}) {
    fail_every_allocation("the mesh of a hull", [&]() -> Answer {
      const auto mesh = in_runtime([&] { return mesh_of(hull, 0.02); });
      if (!mesh.ok()) return mesh.error();
      std::string out;
      for (const Point& vertex : mesh.value().vertices) append_bytes(out, vertex);
      for (const Triangle& triangle : mesh.value().triangles) append_bytes(out, triangle);
      return out;
    });
  }
}

// A union that fails half-way leaves nothing behind that a later one would take for its own.
TEST_F(HostMemory, RunsOutInAUnionBeforeAnotherOne) {
  const std::vector<Ball> next = through_a_point(20, 2, true);
  const BallUnion expected = measure_ball_union(next, {.threads = 1, .complex = true}).value();
  for (const std::vector<Ball>& balls : {random_balls(40, 1, 0.1, 0.3), lattice(3, 0.9)}) {
    WorkerPool pool(1);
    fail_every_allocation("a union before another one", [&]() -> Answer {
      UnionMeasurer measurer;
      const Status status = in_runtime([&] { return measurer.measure(balls, true, pool); });
      EXPECT_TRUE(measurer.measure(next, true, pool).ok());
      EXPECT_EQ(measurer.result().volumes, expected.volumes);
      EXPECT_EQ(measurer.result().complex.tetrahedra, expected.complex.tetrahedra);
      return status.ok() ? Answer(std::string("measured")) : status.error();
    });
  }
}

/// Removes balls. A removal that fails has changed nothing and can be repeated.
Status remove_or_leave(ShrinkingUnion& rest, std::span<const std::uint32_t> balls) {
  const std::vector<double> before(rest.volumes().begin(), rest.volumes().end());
  const std::vector<std::uint32_t> changed(rest.changed().begin(), rest.changed().end());
  const double volume = rest.volume();
  const std::vector<bool> held = {rest.holds(balls.front()), rest.holds(balls.back())};
  Status status = in_runtime([&] { return rest.remove(balls); });
  if (status.ok()) return status;
  EXPECT_EQ(rest.volume(), volume);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), rest.volumes().begin(), rest.volumes().end()));
  EXPECT_EQ((std::vector<bool>{rest.holds(balls.front()), rest.holds(balls.back())}), held);
  EXPECT_TRUE(std::equal(changed.begin(), changed.end(), rest.changed().begin(), rest.changed().end()));
  EXPECT_TRUE(rest.remove(balls).ok()) << "only one allocation fails";
  rest.undo();
  EXPECT_TRUE(std::equal(before.begin(), before.end(), rest.volumes().begin(), rest.volumes().end()));
  return status;
}

TEST_F(HostMemory, RunsOutInAShrinkingUnion) {
  const std::vector<Ball> balls = random_balls(40, 3, 0.1, 0.3);
  const std::uint32_t first[] = {1, 4, 9, 16, 25}, second[] = {2, 3, 5, 7, 11, 13};
  fail_every_allocation("a shrinking union", [&]() -> Answer {
    auto rest = in_runtime([&] { return ShrinkingUnion::build(balls, {.threads = 1}); });
    if (!rest.ok()) return rest.error();
    if (const Status status = remove_or_leave(rest.value(), first); !status.ok()) return status.error();
    if (const Status status = remove_or_leave(rest.value(), second); !status.ok()) return status.error();
    in_runtime([&] { rest.value().undo(); });
    const auto betti = in_runtime([&] { return rest.value().betti(); });
    if (!betti.ok()) return betti.error();
    std::string out;
    for (const double volume : rest.value().volumes()) append_bytes(out, volume);
    append_bytes(out, betti.value());
    return out;
  });
}

/// All queries of a union.
std::string bytes_of(const DynamicUnion& balls) {
  std::string out;
  append_bytes(out, balls.slots());
  append_bytes(out, balls.size());
  append_bytes(out, balls.volume());
  for (const std::uint32_t slot : balls.changed()) append_bytes(out, slot);
  for (std::uint32_t slot = 0; slot < balls.slots(); ++slot) {
    append_bytes(out, balls.holds(slot));
    if (!balls.holds(slot)) continue;
    append_bytes(out, balls.ball(slot));
    append_bytes(out, balls.exposure(slot));
    const std::vector<Point> vertices = balls.vertices(slot).value();
    for (const Point& vertex : vertices) append_bytes(out, vertex);
  }
  return out;
}

/// Performs a change or a query. If it fails, neither the balls nor the record of the last change may have changed.
Status change_or_leave(DynamicUnion& balls, const std::function<Status()>& change) {
  const std::string before = bytes_of(balls);
  Status status = in_runtime(change);
  if (status.ok()) return status;
  EXPECT_TRUE(bytes_of(balls) == before);
  return status;
}

/// After a failed change the previous one is undone, as if there had been no attempt since.
void expect_undone(DynamicUnion& balls, double volume) {
  balls.undo();
  EXPECT_EQ(balls.volume(), volume);
}

TEST_F(HostMemory, RunsOutInADynamicUnion) {
  const std::vector<Ball> list = random_balls(30, 4, 0.1, 0.3);
  const Ball other = {{0.4, 0.5, 0.5}, 0.25};
  fail_every_allocation("a dynamic union", [&]() -> Answer {
    auto built = in_runtime([&] { return DynamicUnion::build(40, 2); });
    if (!built.ok()) return built.error();
    DynamicUnion& balls = built.value();
    const auto status_of = [](const auto& result) { return result.ok() ? Status{} : Status{result.error()}; };
    std::vector<std::function<Status()>> changes;
    changes.reserve(list.size() + 6);
    for (const Ball& ball : list)
      changes.emplace_back([&balls, &status_of, ball] { return status_of(balls.add(ball)); });
    for (const std::uint32_t slot : {3u, 7u, 29u}) changes.emplace_back([&, slot] { return balls.remove(slot); });
    for (const std::uint32_t slot : {5u, 6u}) changes.emplace_back([&, slot] { return balls.move(slot, other); });
    changes.emplace_back([&] { return status_of(balls.add(other)); });
    const std::size_t count = changes.size();
    changes.emplace_back([&] { return status_of(balls.gain({{0.5, 0.5, 0.5}, 0.3})); });
    changes.emplace_back([&] { return status_of(balls.loss(11)); });
    double before_last = 0, now = 0;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      if (const Status status = change_or_leave(balls, changes[i]); !status.ok()) {
        expect_undone(balls, before_last);
        return status.error();
      }
      if (i < count) before_last = std::exchange(now, balls.volume());
    }
    const std::string changed = bytes_of(balls);
    in_runtime([&] { balls.undo(); });
    return changed + bytes_of(balls);
  });
}

/// shift() needs no memory, and settle() can be repeated.
TEST_F(HostMemory, RunsOutInShiftsOfADynamicUnion) {
  const std::vector<Ball> list = random_balls(30, 4, 0.1, 0.3), others = random_balls(6, 5, 0.1, 0.3);
  fail_every_allocation("shifts in a dynamic union", [&]() -> Answer {
    DynamicUnion balls = std::move(DynamicUnion::build(40, 2)).value();
    for (const Ball& ball : list) EXPECT_TRUE(balls.add(ball).ok());
    for (std::uint32_t slot = 0; slot < others.size(); ++slot) {
      const Result<Exposure> there = in_runtime([&] { return balls.exposure_at(slot, others[slot]); });
      EXPECT_TRUE(in_runtime([&] { return balls.shift(slot, others[slot]); }).ok());
      if (there.ok()) continue;
      EXPECT_TRUE(balls.settle().ok());
      return there.error();
    }
    if (const Status status = in_runtime([&] { return balls.settle(); }); !status.ok()) {
      EXPECT_TRUE(balls.settle().ok());
      DynamicUnion moved = std::move(DynamicUnion::build(40, 2)).value();
      for (std::uint32_t slot = 0; slot < list.size(); ++slot) EXPECT_TRUE(moved.add(balls.ball(slot)).ok());
      EXPECT_NEAR(balls.volume(), moved.volume(), 1e-12);
      return status.error();
    }
    return bytes_of(balls);
  });
}

TEST_F(HostMemory, RunsOutInARecordedJob) {
  LentDevice host(open().value());
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  Context context = Context::adopt(host.lend()).value();
  fail_every_allocation("a recorded job", [&] { return make_job_and_record(host, context, mesh, moved); });
}

TEST(CatchOutOfMemory, NeedsNoMemoryForItsMessage) {
  const auto exhausted = [] {
    return catch_out_of_memory("work whose name does not fit into a short string",
                               []() -> Status { throw std::bad_alloc(); });
  };
  EXPECT_EQ(exhausted().error().message, "out of memory while work whose name does not fit into a short string");
  fail_new(1);
  const Status without_message = in_runtime(exhausted);
  EXPECT_TRUE(stop_failing_new());
  EXPECT_EQ(without_message.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(without_message.error().message, "out of memory");
}

TEST(ParallelBlocks, PassOnWhatABodyThrowsOnceAllThreadsHaveEnded) {
  for (const unsigned threads : {1u, 2u, 8u}) {
    std::atomic<int> running = 0;
    EXPECT_THROW(parallel_blocks(1000, 1, threads,
                                 [&](std::size_t begin, std::size_t) {
                                   ++running;
                                   if (begin == 17) {
                                     --running;
                                     throw std::bad_alloc();
                                   }
                                   --running;
                                 }),
                 std::bad_alloc);
    EXPECT_EQ(running, 0);
  }
}

std::string bytes_of_balls(std::span<const Ball> balls) {
  std::string out;
  for (const Ball& ball : balls) append_bytes(out, ball);
  return out;
}

/// The small box with its vertices moved.
std::vector<Point> bent_box(const IndexedMesh& box, double height = 1) {
  std::vector<Point> bent(box.view().vertices.begin(), box.view().vertices.end());
  for (Point& p : bent) p[2] = height * p[2] + 0.4 * p[0] * p[0];
  return bent;
}

TEST_F(HostMemory, RunsOutInCoversThatFollow) {
  const IndexedMesh box = indexed(small_box());
  const std::vector<Point> bent = bent_box(box), sheet = bent_box(box, 0);
  std::vector<Ball> balls;
  for (const Point& p : box.view().vertices) balls.push_back({p, 0.45});
  constexpr std::uint64_t kStride = 101;  // there are some 20,000, and each run takes milliseconds
  const auto job = [&]() -> Answer {
    Result<CoverFollower> follower = in_runtime([&] { return CoverFollower::create(box, balls, {.threads = 1}); });
    if (!follower.ok()) return follower.error();
    EXPECT_TRUE(follower.value().update(sheet).ok() && follower.value().tighten().ok());
    const std::string before = bytes_of_balls(follower.value().balls());
    if (Status moved = in_runtime([&] { return follower.value().update(bent); }); !moved.ok()) {
      EXPECT_TRUE(bytes_of_balls(follower.value().balls()) == before);
      return moved.error();
    }
    const std::string loose = bytes_of_balls(follower.value().balls());
    if (Status tight = in_runtime([&] { return follower.value().tighten(); }); !tight.ok()) {
      EXPECT_TRUE(bytes_of_balls(follower.value().balls()) == loose);
      EXPECT_TRUE(follower.value().update(bent).ok());
      EXPECT_TRUE(bytes_of_balls(follower.value().balls()) == loose);
      return tight.error();
    }
    return bytes_of_balls(follower.value().balls());
  };
  fail_every_allocation("covers that follow", job, kStride);
}

// Frames seldom need any. After one without memory the next one follows the one before.
TEST_F(HostMemory, RunsOutWhereBallsAreChosenAnew) {
  const IndexedMesh mesh = indexed(prepare(make_torus(1.0, 0.4, 12, 6)));
  std::vector<Ball> balls;
  for (int i = 0; i < 9; ++i) balls.push_back({{std::cos(0.35 * i), std::sin(0.35 * i), 0}, 0.2});
  std::vector<Point> wide(mesh.view().vertices.begin(), mesh.view().vertices.end());
  for (Point& p : wide) p[2] *= 3;
  const FollowerOptions options = {.renewed = 2, .renewal_factor = 1, .threads = 1};
  std::size_t chosen = 0;
  Follower other = Follower::create(mesh, balls, options).value();
  ASSERT_TRUE(other.update(wide).ok());
  const std::string expected = bytes_of_balls(other.balls());
  fail_every_allocation("balls chosen anew", [&]() -> Answer {
    Result<Follower> made = in_runtime([&] { return Follower::create(mesh, balls, options); });
    if (!made.ok()) return made.error();
    Follower& follower = made.value();
    const std::string rest = bytes_of_balls(follower.balls());
    if (Status moved = in_runtime([&] { return follower.update(wide); }); !moved.ok()) {
      EXPECT_TRUE(bytes_of_balls(follower.balls()) == rest);
      EXPECT_TRUE(follower.reset().ok());
      EXPECT_TRUE(bytes_of_balls(follower.balls()) == rest);
      EXPECT_TRUE(follower.update(wide).ok());
      EXPECT_TRUE(bytes_of_balls(follower.balls()) == expected);
      return moved.error();
    }
    chosen = static_cast<std::size_t>(std::ranges::count(follower.origins(), FollowOrigin::kRenewed));
    return bytes_of_balls(follower.balls());
  });
  EXPECT_GT(chosen, 0u);
}

}  // namespace
}  // namespace medial_vk::test
