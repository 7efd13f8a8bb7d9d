// What the files that answer the queries of a Scene share.
#pragma once

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "context_impl.h"
#include "device_tree.h"
#include "host_memory.h"
#include "medial_vk/queries.h"
#include "packet_queries.h"
#include "tree_queries.h"

namespace medial_vk {

// Queries of one submission: short enough for any device, long enough to keep it busy.
constexpr std::uint32_t kBatch = 1u << 18;
// Squares of distances beyond this many box sizes overflow in float.
constexpr double kFarthest = 1e15;
constexpr float kAnyDistance = 3.4e38f;
constexpr char kAnswering[] = "answering queries";
constexpr std::uint32_t kNoHit = 0xffffffffu;

/// The buffers of one call: filled from the host, read back to the host.
class Transfer {
 public:
  explicit Transfer(Context::Impl& context) : context_(context), arena_(context) {}

  Result<Buffer> create(VkDeviceSize bytes, const char* purpose) {
    return arena_.create_buffer(bytes, MemoryKind::kDevice, purpose);
  }
  template <class T>
  Result<Buffer> create_filled(std::span<const T> values, const char* purpose) {
    Result<Buffer> buffer = create(values.size_bytes(), purpose);
    if (!buffer.ok()) return buffer;
    if (Status status = upload(context_, buffer.value(), std::as_bytes(values)); !status.ok()) return status.error();
    return buffer;
  }
  /// Runs `record` and then copies the start of `from` to `to`.
  template <class T, class Record>
  Status run_and_read(const Record& record, const Buffer& from, std::span<T> to) {
    Result<Buffer> readback = arena_.create_buffer(to.size_bytes(), MemoryKind::kReadback, "results");
    if (!readback.ok()) return readback.error();
    auto done = run_commands(context_, [&](Recorder& r) {
      record(r);
      r.copy(from, 0, readback.value(), 0, to.size_bytes());
      r.barrier_to_host();
      return r.status();
    });
    if (!done.ok()) return done.error();
    std::memcpy(to.data(), readback.value().mapped, to.size_bytes());
    return {};
  }

 private:
  Context::Impl& context_;
  Arena arena_;
};

inline Status check_point(const Point& unit, std::size_t index) {
  for (const double x : unit) {
    if (std::abs(x) <= kFarthest) continue;  // false for NaN
    return Error{ErrorCode::kUsage, "query " + std::to_string(index) + " is not finite or too far from the mesh"};
  }
  return {};
}

class Scene::Impl {
 public:
  Impl(Context::Impl& context_in, DeviceMesh mesh_in) : context(&context_in), mesh(std::move(mesh_in)) {}

  /// Texels for queries [first, first + count): positions in the unit box, `w` of each from `w_of(index)`.
  template <class PointOf, class WOf>
  Result<std::vector<Texel>> texels(std::size_t first, std::size_t count, PointOf point_of, WOf w_of) const {
    std::vector<Texel> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Point unit = mesh.to_unit(point_of(first + i));
      if (Status status = check_point(unit, first + i); !status.ok()) return status.error();
      out[i] = {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]), w_of(first + i)};
    }
    return out;
  }

  /// Queries [first, first + count) of `asked`, that is points[asked[i]], or points[i] if `asked` is empty, are
  /// answered one by one, or by packets that `slots` describes for groups of `group_size`.
  struct ClosestBatch {
    std::span<const Point> points;
    std::span<const std::uint32_t> asked;
    std::size_t first = 0;
    std::size_t count = 0;
    std::uint32_t group_size = 0;  // 0: one by one
    std::span<const std::uint32_t> slots;

    std::size_t index(std::size_t i) const { return asked.empty() ? first + i : std::size_t{asked[first + i]}; }
  };
  /// What closest() keeps between batches.
  struct ClosestRoom {
    explicit ClosestRoom(Context::Impl& context) : arena(context) {}
    Arena arena;
    Buffer asked, nearest, hits;
    Buffer upload, readback;  // none where the host uses the others
    bool is_shared = false;
  };
  Status make_packets(const MeshView& view);
  /// Error: the last update failed half-way.
  Status usable() const {
    if (packets && mesh.intact) return {};
    return Error{ErrorCode::kOutOfMemory, "the scene could not be updated and must be created anew"};
  }
  Status make_room();
  Status closest_points(std::span<const Point> points, std::span<ClosestPoint> out);
  Status closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size, std::span<ClosestPoint> out);
  Result<std::vector<std::uint8_t>> empty_balls(std::span<const Ball> balls) const;
  Result<std::vector<double>> winding_numbers(std::span<const Point> points, double tolerance) const;
  Result<std::vector<FluxSample>> fluxes(std::span<const Ball> spheres, std::uint32_t samples);
  Status write_queries(const ClosestBatch& batch, std::size_t padded) const;
  void record_closest(Recorder& r, const ClosestBatch& batch, std::uint32_t groups, const Buffer& table) const;
  Status read_closest(const ClosestBatch& batch, std::size_t padded, std::span<ClosestPoint> out) const;
  Status closest(const ClosestBatch& batch, std::span<ClosestPoint> out);
  Status fluxes(std::span<const Ball> spheres, std::size_t first, std::span<const Texel> directions,
                std::span<FluxSample> out);

  Context::Impl* context;
  /// Host and device have the same memory, at the same speed: nothing is copied. Tests of the copies turn it off before
  /// the first query.
  bool shares_memory = context->description.type == "cpu";
  DeviceMesh mesh;
  std::unique_ptr<TreeQueries> queries;
  std::unique_ptr<PacketQueries> packets;
  std::unique_ptr<ClosestRoom> room;
};

}  // namespace medial_vk
