// Queries of distances from many threads on the same bodies: nothing in a body is written, and answers are those of one
// thread. The ThreadSanitizer runs these tests (scripts/test --tsan).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "medial_vk/body_group.h"
#include "medial_vk/collisions.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/nearest_bodies.h"
#include "medial_vk/penetration.h"
#include "medial_vk/pose.h"
#include "medial_vk/proximity.h"

namespace medial_vk::test {
namespace {

constexpr std::size_t kQueryingThreads = 4;

template <class T>
T value_or_throw(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

/// A sphere of 16 rings of 24 vertices, stretched, with a ball in each half and one around it all.
Body stretched_sphere(const Point& size) {
  constexpr std::uint32_t kRings = 16, kAround = 24;
  std::vector<Point> vertices = {{0, 0, size[2]}};
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    const double polar = std::numbers::pi * ring / (kRings + 1);
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      vertices.push_back({size[0] * std::sin(polar) * std::cos(angle), size[1] * std::sin(polar) * std::sin(angle),
                          size[2] * std::cos(polar)});
    }
  }
  const auto last = static_cast<std::uint32_t>(vertices.size());
  vertices.push_back({0, 0, -size[2]});
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t next = (i + 1) % kAround;
    triangles.push_back({0, 1 + i, 1 + next});
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      const std::uint32_t above = 1 + ring * kAround, below = above + kAround;
      triangles.push_back({above + i, below + i, below + next});
      triangles.push_back({above + i, below + next, above + next});
    }
    const std::uint32_t lowest = 1 + (kRings - 1) * kAround;
    triangles.push_back({lowest + i, last, lowest + next});
  }
  const std::vector<std::uint8_t> flags(triangles.size(), kTrustedNormal);
  const IndexedMesh mesh = value_or_throw(IndexedMesh::build(MeshView{vertices, triangles, flags, true}));
  const double least = std::min({size[0], size[1], size[2]}), most = std::max({size[0], size[1], size[2]});
  const std::vector<Ball> inside = {{{0.1 * least, 0, 0}, 0.8 * least}, {{-0.1 * least, 0, 0}, 0.8 * least}};
  const std::vector<Ball> cover = {{{0, 0, 0}, 1.01 * most}};
  return value_or_throw(Body::create(mesh, inside, cover));
}

/// From apart to deep in each other, turned.
std::vector<Pose> poses_towards_each_other() {
  std::vector<Pose> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(make_pose({3 - 0.07 * i, 0.01 * i, 0.2}, {0.1 * i, 0.3, 0.02 * i}));
  return poses;
}

void append_interval(double lower, double upper, std::vector<double>& out) {
  out.push_back(lower);
  out.push_back(upper);
}

/// Those of one body among many, by balls and by triangles.
void append_nearest(const PlacedBodies& among, const Body& body, const Pose& pose, std::vector<double>& out) {
  for (const bool by_triangles : {false, true}) {
    NearestBodiesOptions options;
    options.count = 2;
    options.by_triangles = by_triangles;
    const NearBodies near = value_or_throw(nearest_bodies(among, body, pose, options));
    for (const NearBody& found : near.bodies) {
      out.push_back(static_cast<double>(found.index));
      append_interval(found.lower, found.upper, out);
    }
    out.push_back(near.others);
  }
}

/// Of few directions and columns, since the sanitizer makes it slow.
void append_penetration(const Body& a, const Body& b, const Pose& pose, std::vector<double>& out) {
  PenetrationOptions options;
  options.directions = 16;
  options.most_queries = 64;
  options.most_columns = 64;
  const Penetration found = value_or_throw(penetration(a, b, pose, options));
  append_interval(found.depth_lower, found.depth_upper, out);
  out.insert(out.end(), found.translation.begin(), found.translation.end());
  append_interval(found.common_volume_lower, found.common_volume_of_balls, out);
}

/// Every query once for each pose, also as batches that take threads of their own.
std::vector<double> all_queries(const Body& a, const Body& b, const BodyGroup& group, const PlacedBodies& among) {
  std::vector<double> out;
  const std::vector<Pose> poses = poses_towards_each_other();
  Distance last;
  DistanceBounds last_bounds;
  for (const Pose& pose : poses) {
    last = value_or_throw(distance(a, b, pose, {}, last));
    append_interval(last.lower, last.upper, out);
    last_bounds = distance_bounds(a, b, pose, last_bounds);
    append_interval(last_bounds.lower, last_bounds.upper, out);
    out.push_back(estimated_distance(a, b, last_bounds));
    out.push_back(static_cast<double>(collide(a, b, pose)));
  }
  std::vector<Distance> found(poses.size());
  if (Status status = distances(a, b, poses, found, {}, {2}); !status) throw std::runtime_error(status.error().message);
  for (const Distance& of_pose : found) append_interval(of_pose.lower, of_pose.upper, out);
  std::vector<DistanceBounds> bounds(poses.size());
  distance_bounds(a, b, poses, bounds, {2});
  for (const DistanceBounds& of_pose : bounds) append_interval(of_pose.lower, of_pose.upper, out);
  std::vector<Collision> verdicts(poses.size());
  collide_by_balls(a, b, poses, verdicts, {2});
  for (const Collision verdict : verdicts) out.push_back(static_cast<double>(verdict));
  const FirstContact contact = value_or_throw(first_contact(a, b, {poses.front(), poses.back(), {}}));
  append_interval(contact.free_until, contact.contact_at, out);
  std::vector<Pose> of_links;
  for (const Pose& pose : poses) of_links.insert(of_links.end(), {Pose(), pose});
  std::vector<LeastDistance> least(poses.size());
  Status status = least_distances(group, of_links, least, {.exact = true}, {2});
  if (!status) throw std::runtime_error(status.error().message);
  for (const LeastDistance& of_pose : least) append_interval(of_pose.lower, of_pose.upper, out);
  for (std::size_t i = 0; i < poses.size(); i += 3) {
    append_nearest(among, b, poses[i], out);
    append_penetration(a, b, poses[i], out);
  }
  return out;
}

TEST(SharedBodies, AreQueriedByManyThreadsAtOnce) {
  const Body a = stretched_sphere({1, 0.6, 0.5}), b = stretched_sphere({0.4, 0.7, 0.9});
  const std::vector<GroupPart> parts = {{a, 0}, {b, 1}};
  const std::vector<LinkPair> pairs = {{0, 1}};
  const BodyGroup group = value_or_throw(BodyGroup::create(parts, 2, pairs));
  const std::vector<PlacedBody> placed = {
      {a, {}}, {b, make_pose({1, 1, 0}, {0, 0, 0})}, {a, make_pose({0, -2, 1}, {1, 0, 0})}};
  const PlacedBodies among = value_or_throw(PlacedBodies::create(placed));
  const std::vector<double> expected = all_queries(a, b, group, among);
  // Of six numbers for each pose alone: free ones come first, and hits last.
  ASSERT_GT(expected.size(), 240u);
  EXPECT_GT(expected[0], 1);
  EXPECT_EQ(expected[39 * 6 + 1], 0);
  std::vector<std::vector<double>> found(kQueryingThreads);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < kQueryingThreads; ++i) {
      threads.emplace_back([&, i] {
        const Body mine = i % 2 == 0 ? a : Body(a);  // copies share their trees
        found[i] = all_queries(mine, b, group, among);
      });
    }
  }
  for (std::size_t i = 0; i < kQueryingThreads; ++i) EXPECT_EQ(found[i], expected) << "thread " << i;
}

/// Threads whose bodies end at different times: the last owner of a tree frees it.
TEST(SharedBodies, OutliveTheThreadThatMadeThem) {
  const std::vector<Pose> poses = poses_towards_each_other();
  std::vector<double> first;
  for (int round = 0; round < 3; ++round) {
    std::vector<std::vector<double>> found(kQueryingThreads);
    std::vector<std::jthread> threads;
    {
      const Body a = stretched_sphere({1, 0.6, 0.5}), b = stretched_sphere({0.4, 0.7, 0.9});
      for (std::size_t i = 0; i < kQueryingThreads; ++i) {
        threads.emplace_back([a, b, i, &poses, &found] {
          for (std::size_t k = 0; k < poses.size(); k += i + 1) {
            found[i].push_back(value_or_throw(distance(a, b, poses[k])).upper);
          }
        });
      }
    }
    threads.clear();
    if (round == 0) first = found[0];
    for (std::size_t i = 0; i < kQueryingThreads; ++i) {
      for (std::size_t k = 0; k < found[i].size(); ++k) EXPECT_EQ(found[i][k], first[k * (i + 1)]);
    }
  }
}

}  // namespace
}  // namespace medial_vk::test
