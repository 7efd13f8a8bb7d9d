// The content of a mesh as a text: it depends on every number of the mesh, and on where one list ends.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/batch/mesh_digest.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

TEST(MeshDigest, ChangesWithEveryNumberOfTheMesh) {
  const Mesh box = test::make_box({1, 2, 3});
  std::set<std::string> digests = {cli::mesh_digest(box)};
  EXPECT_EQ(digests.begin()->size(), 32u);
  EXPECT_EQ(cli::mesh_digest(Mesh(box)), *digests.begin());
  const auto expect_new = [&](const Mesh& mesh) { EXPECT_TRUE(digests.insert(cli::mesh_digest(mesh)).second); };
  for (std::size_t i = 0; i < box.vertices.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Mesh moved = box;
      moved.vertices[i][axis] = std::nextafter(moved.vertices[i][axis], 9.0);
      expect_new(moved);
    }
  }
  for (std::size_t i = 0; i < box.triangles.size(); ++i) {
    Mesh turned = box;
    std::swap(turned.triangles[i][0], turned.triangles[i][1]);
    expect_new(turned);
  }
  Mesh counted = box;
  counted.short_polygons = 1;
  expect_new(counted);
  counted.short_polygons = 0;
  counted.fallback_polygons = 1;
  expect_new(counted);
}

/// Modulo 2^61 - 1, by additions alone.
std::uint64_t slow_product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;
  std::uint64_t sum = 0;
  for (; b > 0; b >>= 1, a = 2 * a % kPrime) {
    if ((b & 1) != 0) sum = (sum + a) % kPrime;
  }
  return sum;
}

TEST(MeshDigest, IsThePolynomialAtBothPlaces) {
  Mesh mesh;
  mesh.vertices = {{-0.1, 1e300, 3}, {0, -7.7e-300, 2.5}};
  mesh.triangles = {{0, 4'000'000'000u, 1}};
  mesh.short_polygons = 5;
  std::vector<std::uint32_t> words;
  const auto add = [&](std::uint64_t number) {
    words.push_back(static_cast<std::uint32_t>(number));
    words.push_back(static_cast<std::uint32_t>(number >> 32));
  };
  for (const std::uint64_t count : {2u, 1u}) add(count);
  for (const Point& vertex : mesh.vertices) {
    for (const double coordinate : vertex) add(std::bit_cast<std::uint64_t>(coordinate));
  }
  for (const std::uint32_t corner : mesh.triangles[0]) words.push_back(corner);
  for (const std::uint64_t count : {5u, 0u}) add(count);
  std::string expected;
  for (const std::uint64_t place : {0x1e3779b97f4a7c15ull, 0x043f6a8885a308d3ull}) {
    std::uint64_t value = 1;
    for (const std::uint32_t word : words) value = (slow_product(value, place) + word) % ((1ull << 61) - 1);
    expected += fmt::format("{:016x}", value);
  }
  EXPECT_EQ(cli::mesh_digest(mesh), expected);
}

// Six triangles take as many words as three vertices.
TEST(MeshDigest, KnowsWhereVerticesEnd) {
  Mesh vertices, triangles;
  vertices.vertices.resize(3, Point{0, 0, 0});
  triangles.triangles.resize(6, Triangle{0, 0, 0});
  EXPECT_NE(cli::mesh_digest(vertices), cli::mesh_digest(triangles));
  EXPECT_NE(cli::mesh_digest(vertices), cli::mesh_digest(Mesh()));
}

}  // namespace
}  // namespace medial_vk
