// Balls that follow a mesh on a device, frame by frame, and what tests compare.
#pragma once

#include <volk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/follower_job.h"
#include "support/device/recorded_frames.h"
#include "unit/following/followed_example.h"

namespace medial_vk {

/// As the device reads it.
inline Frame in_float(Frame frame) {
  for (Point& p : frame) {
    for (double& x : p) x = static_cast<float>(x);
  }
  return frame;
}

inline std::vector<RecordedVertex> recorded_vertices(const Frame& frame) {
  std::vector<RecordedVertex> out;
  for (const Point& p : frame) {
    out.push_back({{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}});
  }
  return out;
}

class FollowedOnDevice {
 public:
  FollowedOnDevice(Context& context, const IndexedMesh& mesh, std::span<const Ball> balls,
                   const FollowerJobOptions& options = {})
      : mesh_(mesh),
        count_(balls.size()),
        frames_(context),
        job_(FollowerJob::create(context, mesh, balls, options).value()) {}

  void update(const Frame& frame) {
    ASSERT_TRUE(job_.set_vertices(frame).ok());
    run();
  }
  /// Without a test of the host.
  void write_and_update(const Frame& frame) {
    frames_.write(job_.buffers().vertices, recorded_vertices(frame));
    run();
  }

  FollowerJob& job() { return job_; }
  const std::vector<Ball>& balls() const { return balls_; }
  const std::vector<std::uint32_t>& states() const { return states_; }
  std::size_t lost() const { return count(FollowState::kLost); }
  std::size_t count(FollowState state) const {
    return static_cast<std::size_t>(std::ranges::count(states_, static_cast<std::uint32_t>(state)));
  }

  /// By the reference: every ball lies inside the frame as the device has read it, or is lost.
  void expect_inside(const Frame& frame, const std::string& where) const {
    std::vector<Ball> kept;
    for (std::size_t i = 0; i < count_; ++i) {
      const bool is_lost = states_[i] == static_cast<std::uint32_t>(FollowState::kLost);
      EXPECT_EQ(is_lost, balls_[i].radius == 0) << where << ", ball " << i;
      if (!is_lost) kept.push_back(balls_[i]);
    }
    const reference::Certificate certificate =
        reference::check_inside(reference_of(mesh_, in_float(frame)), test::to_reference(kept));
    for (const auto& line : certificate.lines) EXPECT_EQ(line.failed, 0u) << where << ": " << line.first_failure;
  }

 private:
  void run() {
    frames_.run([&](VkCommandBuffer commands) { EXPECT_TRUE(job_.record(commands).ok()); });
    balls_.clear();
    for (const RecordedBall& ball : frames_.read<RecordedBall>(job_.buffers().balls, count_)) {
      balls_.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
    }
    states_ = frames_.read<std::uint32_t>(job_.buffers().states, count_);
  }

  IndexedMesh mesh_;
  std::size_t count_;
  test::RecordedFrames frames_;
  FollowerJob job_;
  std::vector<Ball> balls_;
  std::vector<std::uint32_t> states_;
};

/// The longest side and the greatest coordinate, by which the errors of the device are measured.
inline double lengths_of(const Frame& frame) {
  Point lower = frame.front(), upper = lower;
  for (const Point& p : frame) {
    lower = least(lower, p);
    upper = greatest(upper, p);
  }
  const Point sides = upper - lower;
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max({most, std::fabs(lower[k]), std::fabs(upper[k])});
  return most + std::max({sides[0], sides[1], sides[2]});
}

/// By which a radius on the device is less than its distance at most, in units of lengths_of(): 16, 32 and 27 of 2^-23
/// (docs/theory.md, "Balls on the device").
inline constexpr double kLessOnDevice = 75 * 0x1p-23;

}  // namespace medial_vk
