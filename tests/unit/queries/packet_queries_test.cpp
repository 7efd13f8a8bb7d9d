// Packets of points: every shape of team gives the same nearest triangles, and those of the walk for single points.
#include "queries/packet_queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>

#include "base/point_ops.h"
#include "base/point_order.h"
#include "base/spiral.h"
#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "device_mesh/device_tree.h"
#include "support/device/device_test.h"
#include "support/device/uploaded_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

struct Answers {
  std::vector<Texel> nearest;
  std::vector<std::uint32_t> hits;
};

class PacketQueriesTest : public test::DeviceTest {
 protected:
  /// Runs `record(recorder, slots, queries, nearest, hits)` over the queries; results that it does not write are zero.
  template <class Record>
  Answers run(std::span<const Texel> queries, std::span<const std::uint32_t> slots, const Record& record) {
    ContextImpl& context = Internals::of(*context_);
    Arena arena(context);
    const std::size_t count = queries.size();
    const auto make = [&](VkDeviceSize bytes, MemoryKind kind) {
      return arena.create_buffer(bytes, kind, "a test").value();
    };
    const Buffer positions = make(count * 16, MemoryKind::kDevice),
                 table = make(slots.size_bytes(), MemoryKind::kDevice);
    const Buffer nearest = make(count * 16, MemoryKind::kDevice), hits = make(count * 4, MemoryKind::kDevice);
    const Buffer read_nearest = make(count * 16, MemoryKind::kReadback);
    const Buffer read_hits = make(count * 4, MemoryKind::kReadback);
    EXPECT_TRUE(upload(context, positions, std::as_bytes(queries)).ok());
    EXPECT_TRUE(upload(context, table, std::as_bytes(slots)).ok());
    const auto done = run_commands(context, [&](Recorder& r) {
      r.fill(nearest, 0, count * 16, 0);
      r.fill(hits, 0, count * 4, 0);
      r.barrier();
      record(r, table.range(0, slots.size_bytes()), positions.range(), nearest.range(), hits.range());
      r.copy(nearest, 0, read_nearest, 0, count * 16);
      r.copy(hits, 0, read_hits, 0, count * 4);
      r.barrier_to_host();
      return r.status();
    });
    EXPECT_TRUE(done.ok()) << done.error().message;
    Answers answers{std::vector<Texel>(count), std::vector<std::uint32_t>(count)};
    std::memcpy(answers.nearest.data(), read_nearest.mapped, count * 16);
    std::memcpy(answers.hits.data(), read_hits.mapped, count * 4);
    return answers;
  }

  Answers query_packets(const DeviceMesh& device, const PacketShape& shape, std::span<const Texel> queries,
                        std::span<const Point> group, std::uint32_t* unresolved) {
    const auto count = static_cast<std::uint32_t>(queries.size());
    PacketQueries packets = PacketQueries::create(Internals::of(*context_), device, count, shape).value();
    const std::vector<std::uint32_t> slots = make_slots(shape, group);
    const auto size = static_cast<std::uint32_t>(group.size());
    const Answers answers = run(queries, slots, [&](Recorder& r, auto table, auto positions, auto nearest, auto hits) {
      packets.closest(r, {.groups = count / size, .group_size = size}, table, positions, nearest, hits,
                      TreeQueries::Ties::kIndex);
    });
    *unresolved = packets.read_unresolved_total().value();
    return answers;
  }

  Answers query_one_by_one(const DeviceMesh& device, std::span<const Texel> queries) {
    TreeQueries single =
        TreeQueries::create(Internals::of(*context_), device, static_cast<std::uint32_t>(queries.size())).value();
    const std::vector<std::uint32_t> unused(4);
    return run(queries, unused, [&](Recorder& r, auto, auto positions, auto nearest, auto hits) {
      single.closest(r, QueryCount::of(static_cast<std::uint32_t>(queries.size())), positions, nearest, hits,
                     TreeQueries::Ties::kIndex);
    });
  }
};

/// Samples on spheres of radius 0.02 in the unit box.
std::vector<Texel> samples_of_spheres(std::span<const Point> directions, int spheres) {
  std::vector<Texel> queries;
  for (int s = 0; s < spheres; ++s) {
    for (const Point& d : directions) {
      const Point p = Point{0.013 * s, 0.5 + 0.004 * s, 0.3} + 0.02 * d;
      queries.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 3.4e38f});
    }
  }
  return queries;
}

std::vector<PacketShape> all_shapes(const ContextImpl& context) {
  std::vector<PacketShape> shapes = {PacketShape::best_for(context)};
  for (const std::uint32_t width : {4u, 8u, 16u, 32u, 64u}) shapes.push_back(PacketShape::of(width, true));
  return shapes;
}

TEST_F(PacketQueriesTest, EveryShapeOfTeamFindsTheSame) {
  const Mesh mesh = test::make_turned_torus();
  const DeviceMesh device = test::upload_mesh(Internals::of(*context_), test::view_of(mesh)).value();
  for (const std::uint32_t samples : {1u, 9u, 51u, 130u}) {
    const std::vector<Point> directions = spiral_points(samples);
    std::vector<Texel> queries = samples_of_spheres(directions, 60);
    for (std::size_t i = 0; i < queries.size(); i += 7) queries[i][3] = -1;       // passed over
    for (std::size_t i = 3; i < queries.size(); i += 7) queries[i][3] = 0.0004f;  // no triangle is so near, or few are
    const Answers single = query_one_by_one(device, queries);
    for (const PacketShape& shape : all_shapes(Internals::of(*context_))) {
      SCOPED_TRACE(testing::Message() << samples << " samples, width " << shape.width << ", shared memory "
                                      << shape.through_shared_memory);
      std::uint32_t unresolved = 1;
      const Answers packets = query_packets(device, shape, queries, directions, &unresolved);
      EXPECT_EQ(unresolved, 0u);
      int other_hits = 0;
      for (std::size_t i = 0; i < queries.size(); ++i) {
        // The triangle is chosen by another arithmetic (triangle_frame.glsl): 3e-6 each way.
        ASSERT_NEAR(std::sqrt(packets.nearest[i][3]), std::sqrt(single.nearest[i][3]), 6e-6) << "query " << i;
        other_hits += packets.hits[i] != single.hits[i];
      }
      // If two triangles are equally near up to rounding: at an edge that they share.
      EXPECT_LE(other_hits, static_cast<int>(queries.size()) / 10);
    }
  }
}

// At the centre of a sphere every triangle is equally near: the walk gives up, and all triangles are examined.
TEST_F(PacketQueriesTest, CentreOfASphere) {
  const Mesh mesh = test::make_sphere(1.0, 100000);
  const DeviceMesh device = test::upload_mesh(Internals::of(*context_), test::view_of(mesh)).value();
  const std::vector<Point> around = spiral_points(51);
  std::vector<Texel> queries;
  for (const Point& d : around) {
    const Point p = Point{0.5, 0.5, 0.5} + 1e-8 * d;
    queries.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 3.4e38f});
  }
  std::uint32_t unresolved = 0;
  const Answers answers =
      query_packets(device, PacketShape::best_for(Internals::of(*context_)), queries, around, &unresolved);
  EXPECT_EQ(unresolved, 51u);
  for (const Texel& nearest : answers.nearest) EXPECT_NEAR(std::sqrt(nearest[3]), 0.5, 1e-4);
}

TEST(PacketSlots, HoldEveryPointOnce) {
  for (const std::uint32_t width : {4u, 8u, 16u, 32u, 64u}) {
    const PacketShape shape = PacketShape::of(width, true);
    EXPECT_GE(shape.slots(), 51u);
    for (const std::uint32_t size : {1u, 50u, 51u, 57u, 100u, 400u}) {
      for (const bool geometry : {true, false}) {
        const auto slots = geometry ? make_slots(shape, spiral_points(size)) : make_slots(shape, size);
        EXPECT_EQ(slots.size(), shape.packets(size) * shape.slots());
        std::multiset<std::uint32_t> held;
        for (const std::uint32_t point : slots) {
          if (point != kNoPoint) held.insert(point);
        }
        EXPECT_EQ(held.size(), size);
        for (std::uint32_t point = 0; point < size; ++point) EXPECT_EQ(held.count(point), 1u);
      }
    }
  }
}

TEST(PacketTreeTexels, WideNodesHoldEveryTriangleOnce) {
  for (const std::size_t triangles : {1, 8, 9, 12, 3600}) {
    Mesh mesh = triangles <= 12 ? test::make_box({1, 2, 3}) : test::make_turned_torus();
    mesh.triangles.resize(triangles);
    const Bvh bvh = Bvh::build(test::view_of(mesh), {.leaf_size = 8}).value();
    for (const std::uint32_t arity : {4u, 8u}) {
      const std::vector<Texel> texels = make_wide_tree_texels(bvh.nodes(), {{0, 0, 0}, 3}, arity);
      std::vector<int> seen(triangles);
      std::vector<std::uint32_t> pending = {0};
      while (!pending.empty()) {
        const std::uint32_t node = pending.back();
        pending.pop_back();
        for (std::uint32_t child = arity * node; child < arity * (node + 1); ++child) {
          const auto first = static_cast<std::uint32_t>(std::max(0.0f, texels[2 * child][3]));
          const float count = texels[2 * child + 1][3];
          if (count == 0) pending.push_back(first);
          for (std::uint32_t t = first; static_cast<float>(t) < static_cast<float>(first) + count; ++t) ++seen[t];
        }
      }
      EXPECT_EQ(seen, std::vector<int>(triangles, 1));
    }
  }
}

TEST(PointOrder, IsAPermutationThatKeepsNeighboursTogether) {
  std::vector<Point> points;
  for (int i = 0; i < 4096; ++i) points.push_back({1.0 * (i * 7 % 16), 1.0 * (i * 11 / 16 % 16), 1.0 * (i * 5 % 17)});
  const std::vector<std::uint32_t> order = order_along_curve(points);
  EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), points.size());
  double before = 0, after = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    before += length(points[i] - points[i - 1]);
    after += length(points[order[i]] - points[order[i - 1]]);
  }
  EXPECT_LT(after, 0.3 * before);
  EXPECT_TRUE(order_along_curve({}).empty());
  EXPECT_EQ(order_along_curve(std::vector<Point>(3, Point{1, 1, 1})), (std::vector<std::uint32_t>{0, 1, 2}));
}

// A number of queries that only the device knows, cut into dispatches: every one is processed, none twice, and each
// dispatch is followed by the next test whether to continue.
TEST_F(PacketQueriesTest, SlicesAnswerWhatOneDispatchDoes) {
  const Mesh mesh = test::make_turned_torus();
  ContextImpl& context = Internals::of(*context_);
  const DeviceMesh device = test::upload_mesh(context, test::view_of(mesh)).value();
  const std::vector<Texel> queries = samples_of_spheres(spiral_points(50), 20);
  const Answers expected = query_one_by_one(device, queries);
  constexpr std::uint32_t kGroup = TreeQueries::kWorkgroupSize, kPerSlice = 2 * kGroup;
  const auto total = static_cast<std::uint32_t>(queries.size());
  Arena arena(context);
  const Buffer words = arena.create_buffer(64, MemoryKind::kUpload, "a test").value();
  auto* word = static_cast<std::uint32_t*>(words.mapped);
  for (const std::uint32_t given : {total, total - 1, kPerSlice + 1, kPerSlice, 1u, 0u}) {
    SCOPED_TRACE(given);
    TreeQueries single = TreeQueries::create(context, device, total).value();
    std::vector<std::uint32_t> prepared;  // by slice: recorded in this order, each before its dispatch
    const std::vector<std::uint32_t> unused(4);
    const Answers found = run(queries, unused, [&](Recorder& r, auto, auto positions, auto nearest, auto hits) {
      word[0] = given;
      const auto prepare = [&](Recorder& recorder, std::uint32_t k) -> VkDeviceSize {
        prepared.push_back(k);
        const std::uint32_t left = given - std::min(given, k * kPerSlice);
        const std::uint32_t groups = (std::min(left, kPerSlice) + kGroup - 1) / kGroup;
        recorder.fill(words, 16, 4, groups);
        recorder.fill(words, 20, 8, 1);
        recorder.barrier();
        return 16;
      };
      const Slices slices = {(total + kPerSlice - 1) / kPerSlice, kPerSlice / kGroup, prepare};
      single.closest(r, {0, &words, 0, 1, &words, slices}, positions, nearest, hits, TreeQueries::Ties::kIndex);
    });
    for (std::uint32_t k = 0; k < prepared.size(); ++k) EXPECT_EQ(prepared[k], k);
    EXPECT_EQ(prepared.size(), (total + kPerSlice - 1) / kPerSlice);
    for (std::uint32_t i = 0; i < total; ++i) {
      EXPECT_EQ(found.nearest[i], i < given ? expected.nearest[i] : Texel{}) << i;
    }
  }
}

}  // namespace
}  // namespace medial_vk
