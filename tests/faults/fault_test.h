// Shared definitions of the tests of faults: small jobs with known results, behind an interposer that can inject
// faults.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/host_memory.h"
#include "device/context_impl.h"
#include "failing_new.h"
#include "medial_vk/device_bodies.h"
#include "medial_vk/extraction.h"
#include "medial_vk/scene.h"
#include "proximity_jobs/device_bodies_impl.h"
#include "proximity_jobs/pose_batches.h"
#include "support/device/device.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"
#include "vulkan_interposer.h"

namespace medial_vk::test {

/// Equal results have equal bytes: runs on one device are deterministic.
template <class T>
void append_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

inline PreparedMesh small_box() {
  Mesh mesh = make_box({1.0, 0.7, 0.45});
  rotate(mesh, {1, 2, 3}, 0.7);
  return prepare(std::move(mesh));
}

inline ExtractionOptions small_job(Mode mode) {
  ExtractionOptions options;
  options.mode = mode;
  options.resolution = mode == Mode::kThesis ? 16 : 8;
  options.extra_levels = 1;
  options.thesis.samples = {60, 50, 40, 10};  // one round of retractions
  options.memory_budget = 48u << 20;
  return options;
}

/// The box is searched in chunks: points of one are downloaded while the next is computed.
inline ExtractionOptions job_of_many_chunks() {
  ExtractionOptions options = small_job(Mode::kCertified);
  options.resolution = 64;
  options.extra_levels = 0;
  options.memory_budget = 16u << 20;
  return options;
}

/// All results for the solid, as bytes.
inline std::string answer_of(const Extraction& extraction) {
  std::string out;
  for (const MedialSphere& s : extraction.spheres) {
    append_bytes(out, s.centre);
    append_bytes(out, s.radius);
    append_bytes(out, s.spoke_a);
    append_bytes(out, s.spoke_b);
    append_bytes(out, s.flux);
    append_bytes(out, s.voxel);
  }
  for (const UndecidedVoxel& v : extraction.undecided) append_bytes(out, v.voxel);
  return out;
}

inline std::vector<Point> points_around(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 0.37 * static_cast<double>(i);
    points.push_back({0.9 * std::sin(t), 0.8 * std::cos(1.7 * t), 0.7 * std::sin(2.3 * t)});
  }
  return points;
}

/// The result as bytes, or the error.
using Answer = Result<std::string>;
using Job = std::function<Answer(Context&)>;

inline Answer extract(Context& context, const PreparedMesh& mesh, Mode mode) {
  const auto extraction = in_runtime([&] { return test::extract_spheres(context, mesh.view(), small_job(mode)); });
  if (!extraction.ok()) return extraction.error();
  return answer_of(extraction.value());
}

/// Closest points by both ways, empty balls, winding numbers, flux.
inline Answer query_everything(Scene& scene) {
  std::string out;
  for (const std::size_t count : {50u, 4096u}) {
    const std::vector<Point> points = points_around(count);
    const auto closest = in_runtime([&] { return scene.closest_points(points); });
    if (!closest.ok()) return closest.error();
    for (const ClosestPoint& c : closest.value()) append_bytes(out, c.distance);
  }
  std::vector<Ball> balls;
  for (const Point& p : points_around(20)) balls.push_back({p, 0.1});
  const auto empty = in_runtime([&] { return scene.empty_balls(balls); });
  if (!empty.ok()) return empty.error();
  for (const std::uint8_t e : empty.value()) append_bytes(out, e);
  const std::vector<Point> points = points_around(20);
  const auto numbers = in_runtime([&] { return scene.winding_numbers(points); });
  if (!numbers.ok()) return numbers.error();
  for (const double n : numbers.value()) append_bytes(out, n);
  const auto fluxes = in_runtime([&] { return scene.fluxes(balls, 20); });
  if (!fluxes.ok()) return fluxes.error();
  for (const FluxSample& f : fluxes.value()) append_bytes(out, f.flux);
  return out;
}

inline Answer make_scene_and_query(Context& context, const PreparedMesh& mesh) {
  Result<Scene> scene = in_runtime([&] { return test::make_scene(context, mesh.view()); });
  if (!scene.ok()) return scene.error();
  return query_everything(scene.value());
}

inline std::vector<Body> two_bodies() {
  const std::vector<Ball> few = {{{0, 0, 0}, 1}}, more(9, {{0.5, 0, 0}, 0.5});
  return {Body::create(few, few).value(), Body::create(more, more).value()};
}

/// Some poses of two_bodies(), from `first` half units apart to 7 more.
inline std::vector<PosedPair> poses_of_two(std::uint32_t first = 0) {
  std::vector<PosedPair> pairs;
  for (std::uint32_t i = 0; i < 8; ++i) pairs.push_back({make_pose({0.5 * (first + i), 0, 0}, {0, 0, 0}), i % 2, 1});
  return pairs;
}

/// Verdicts and bounds for some pairs of two bodies, on the device. `copies`: in small batches, as on a device with
/// memory of its own.
inline Answer query_bodies(Context& context, bool copies = false) {
  const std::vector<Body> bodies = two_bodies();
  const std::vector<PosedPair> pairs = poses_of_two();
  std::vector<Collision> verdicts(pairs.size());
  std::vector<DistanceBounds> bounds(pairs.size());
  const Status done = in_runtime([&]() -> Status {
    Result<DeviceBodies> on_device = DeviceBodies::create(context, bodies);
    if (!on_device.ok()) return on_device.error();
    DeviceBodiesImpl& impl = Internals::of(on_device.value());
    if (copies) {
      const Status made = catch_out_of_memory("a test", [&]() -> Status {
        impl.batches = std::make_unique<PoseBatches>(impl, 2, false);  // two are in progress
        return {};
      });
      if (!made.ok()) return made;
    }
    if (Status status = on_device.value().collide_by_balls(pairs, verdicts, {1}); !status.ok()) return status;
    return on_device.value().distance_bounds(pairs, bounds, {1});
  });
  if (!done.ok()) return done.error();
  std::string out;
  for (const Collision verdict : verdicts) append_bytes(out, verdict);
  for (const DistanceBounds& of_pair : bounds) append_bytes(out, of_pair);
  return out;
}

/// Calls and allocations fail one by one: all of them, or the first and every n-th after it, where the environment
/// variable MEDIAL_VK_FAULT_STRIDE gives n. With a sanitizer, scripts/test lets one of seven fail.
inline std::uint64_t fault_stride() {
  static const std::uint64_t stride = [] {
    const char* text = std::getenv("MEDIAL_VK_FAULT_STRIDE");
    const std::uint64_t number = text != nullptr ? std::strtoull(text, nullptr, 10) : 1;
    if (number == 0) throw std::invalid_argument("MEDIAL_VK_FAULT_STRIDE is no positive number");
    if (number > 1) std::cout << "MEDIAL_VK_FAULT_STRIDE: one of " << number << " fails\n";
    return number;
  }();
  return stride;
}

/// A test with the interposer installed. It is skipped without a device.
class FaultTest : public testing::Test {
 protected:
  void SetUp() override {
    vulkan();
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    vulkan().set_profile({});
  }
  void TearDown() override {
    vulkan().stop_failing();
    EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
    vulkan().set_profile({});
    EXPECT_EQ(vulkan().leaks(), "");
  }
  static VulkanInterposer& vulkan() { return VulkanInterposer::get(); }
  static Result<Context> open() {
    const ContextOptions options = {.device = "", .validation = false, .cache_folder = "/dev/null"};
    return in_runtime([&] { return Context::create(options); });
  }
};

inline constexpr Fault kMemoryFaults[] = {Fault::kOutOfHostMemory, Fault::kOutOfDeviceMemory, Fault::kDeviceFull};

inline ErrorCode expected_code(Fault fault) {
  return fault == Fault::kDeviceLost ? ErrorCode::kInternal : ErrorCode::kOutOfMemory;
}

/// Every call of Vulkan that can fail does so once.
class VulkanFaults : public FaultTest {
 protected:
  /// Fails the first call, then the next one (fault_stride()), until the job needs fewer calls. `fresh`: the initial
  /// state of a job; it may leave programs behind, but the first run has created them.
  void fail_every_call(Fault fault, const std::string& name, const std::function<Answer()>& job,
                       const std::function<void(std::uint64_t)>& afterwards) {
    const Answer expected = job();
    ASSERT_TRUE(expected.ok()) << expected.error().message;
    const auto handles = vulkan().handles();
    std::uint64_t failures = 0, survived = 0, k = 1;
    std::set<std::string> calls;
    for (bool failed = true; failed && !HasFailure(); k += fault_stride()) {
      vulkan().fail_call(k, fault);
      const Answer answer = job();
      const std::string call = vulkan().stop_failing();
      SCOPED_TRACE(::testing::Message() << name << ", " << fault_name(fault) << ", call " << k << " (" << call << ")");
      failed = !call.empty();
      calls.insert(call);
      if (answer.ok()) {
        EXPECT_TRUE(answer.value() == expected.value());
        survived += failed ? 1 : 0;
      } else {
        EXPECT_TRUE(failed);
        EXPECT_EQ(answer.error().code, expected_code(fault)) << answer.error().message;
        EXPECT_NE(answer.error().message, "");
        ++failures;
      }
      EXPECT_EQ(vulkan().handles(), handles);
      EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
      if (failed) afterwards(k);
    }
    EXPECT_GT(failures, 0u);
    calls.erase("");
    std::cout << name << ", " << fault_name(fault) << ": " << failures << " errors, " << survived << " survived, of "
              << calls.size() << " functions\n";
  }

  /// Fails the calls of a job on a persistent context, by all faults. After faults of memory, another scene must still
  /// give the same results.
  void fail_every_call_of(const std::string& name, const Job& job) {
    Result<Context> context = open();
    ASSERT_TRUE(context.ok()) << context.error().message;
    const PreparedMesh mesh = small_box();
    Scene beside = test::make_scene(context.value(), mesh.view()).value();
    const std::vector<Point> points = points_around(5);
    const auto query = [&] {
      std::string out;
      const auto closest = beside.closest_points(points);
      EXPECT_TRUE(closest.ok()) << closest.error().message;
      if (closest.ok())
        for (const ClosestPoint& c : closest.value()) append_bytes(out, c.distance);
      return out;
    };
    const std::string expected = query();
    const auto afterwards = [&](std::uint64_t) { EXPECT_TRUE(query() == expected); };
    for (const Fault fault : kMemoryFaults)
      fail_every_call(
          fault, name, [&] { return job(context.value()); }, afterwards);
    fail_every_call(
        Fault::kDeviceLost, name, [&] { return job(context.value()); }, [](std::uint64_t) {});
  }
};

}  // namespace medial_vk::test
