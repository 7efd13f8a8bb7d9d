// Stopping an extraction, from another thread or by the callback: it ends with kInterrupted, and the context remains
// usable.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <stop_token>
#include <thread>
#include <vector>

#include "medial_vk/extraction.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class Stop : public test::DeviceTest, public testing::WithParamInterface<Mode> {
 protected:
  static ExtractionOptions options(std::uint32_t resolution) {
    ExtractionOptions p;
    p.mode = GetParam();
    p.resolution = resolution;
    return p;
  }
  Result<Extraction> extract(const ProgressCallback& progress, const std::stop_token& stop) {
    // Seconds on any CPU.
    const std::uint32_t resolution = GetParam() == Mode::kCertified ? 2000 : 400;
    return test::extract_spheres(*context_, mesh_.view(), options(resolution), progress, stop);
  }
  /// A GPU may end before the request, or with it: then the result is whole.
  bool may_be_whole(const Result<Extraction>& result) const {
    return context_->device().type != "cpu" && result.ok() && !result.value().spheres.empty();
  }
  void expect_interrupted(const Result<Extraction>& result) {
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::kInterrupted) << result.error().message;
  }
  /// The context still gives the results of a fresh one.
  void expect_usable() {
    const auto spheres_of = [&](Context& context) {
      const Result<Extraction> e = test::extract_spheres(context, mesh_.view(), options(12));
      EXPECT_TRUE(e.ok()) << (e.ok() ? "" : e.error().message);
      std::vector<Point> centres;
      if (e.ok()) {
        for (const MedialSphere& s : e.value().spheres) centres.push_back(s.centre);
      }
      return centres;
    };
    Context fresh = test::make_context();
    const std::vector<Point> expected = spheres_of(fresh);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(spheres_of(*context_), expected);
  }

  PreparedMesh mesh_ = test::prepare(test::make_torus(1.0, 0.4, 24, 48));
};

TEST_P(Stop, RequestedBeforeTheStart) {
  std::stop_source source;
  source.request_stop();
  expect_interrupted(extract({}, source.get_token()));
  expect_usable();
}

TEST_P(Stop, RequestedByAnotherThreadWhileTheDeviceComputes) {
  for (const int milliseconds : {5, 100, 300}) {
    std::stop_source source;
    std::jthread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      source.request_stop();
    });
    const Result<Extraction> result = extract({}, source.get_token());
    if (!may_be_whole(result)) expect_interrupted(result);
  }
  expect_usable();
}

// Within 200 ms once the driver has compiled the kernels, on an otherwise idle machine: docs/reliability.md has
// figures. Here it may be busy. A stop that waited for the end of the run, or of a level, would take longer.
TEST_P(Stop, TakesEffectSoon) {
  using Clock = std::chrono::steady_clock;
  expect_usable();  // compiles
  std::vector<Clock::duration> waits;
  for (int i = 0; i < 9; ++i) {
    std::stop_source source;
    Clock::time_point requested;
    std::jthread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(100 + 60 * i));
      requested = Clock::now();
      source.request_stop();
    });
    const Result<Extraction> result = extract({}, source.get_token());
    const Clock::time_point ended = Clock::now();
    other.join();
    if (may_be_whole(result)) continue;
    expect_interrupted(result);
    waits.push_back(ended - requested);
  }
  if (waits.empty()) GTEST_SKIP() << "this device computes all in 100 ms";
  std::ranges::sort(waits);
  const std::chrono::duration<double, std::milli> median = waits[waits.size() / 2], worst = waits.back();
  std::cout << "stopped after " << median.count() << " ms, at worst " << worst.count() << " ms\n";
  EXPECT_LT(median, std::chrono::seconds(1));
}

// The callback is also called while the device computes: this one never requests a stop between two chunks.
TEST_P(Stop, ByTheCallback) {
  int calls = 0;
  std::stop_source source;
  const auto on_progress = [&](double) {
    if (++calls >= 12) source.request_stop();
  };
  expect_interrupted(extract(on_progress, source.get_token()));
  EXPECT_GE(calls, 12);
  expect_usable();
}

INSTANTIATE_TEST_SUITE_P(, Stop, testing::Values(Mode::kCertified, Mode::kThesis),
                         [](const auto& tested) { return tested.param == Mode::kThesis ? "Thesis" : "Certified"; });

}  // namespace
}  // namespace medial_vk
