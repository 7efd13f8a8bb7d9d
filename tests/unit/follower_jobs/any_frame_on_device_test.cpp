// Frames of any kind on the device: in any unit, flat, crossing, mirrored, faulty; and devices with other arithmetic.
#include <volk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "device/context_impl.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/device/other_kernels.h"
#include "support/extraction.h"
#include "support/other_rounding.h"
#include "support/other_specials.h"
#include "support/solids/motions.h"
#include "unit/follower_jobs/followed_on_device.h"

namespace medial_vk {
namespace {

TEST(FollowerJobOfAnyFrame, InAnyUnitAndPlace) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = torus();
  for (const double unit : {1e-24, 1.0, 1e24}) {
    for (const double away : {0.0, 20.0}) {
      const PlacedExample placed(example, unit, away);
      FollowedOnDevice device(test::quick_device(), placed.mesh, placed.balls);
      const Frame frame = placed.place(test::moved_vertices(example.rest(), test::Motion::kBend, 1));
      device.update(frame);
      EXPECT_LE(device.lost(), 2u) << unit << " " << away;
      device.expect_inside(frame, "placed");
    }
  }
}

TEST(FollowerJobOfAnyFrame, TrianglesWithoutAreaArePermitted) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = torus();
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
  Frame frame = example.rest();
  for (Point& p : frame) p[2] = std::max(p[2], -0.1);  // a part becomes flat, and its edges collapse
  for (int repeat = 0; repeat < 3; ++repeat) {
    device.update(frame);
    device.expect_inside(frame, "flat");
  }
  EXPECT_LT(device.lost(), example.balls.size() / 4);
  device.update(example.rest());
  device.expect_inside(example.rest(), "rest again");
}

TEST(FollowerJobOfAnyFrame, WithoutVolumeOrMirroredLosesAllBallsForItsTime) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = torus();
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
  Frame flat = example.rest(), mirrored = flat;
  for (Point& p : flat) p[2] = 0;
  for (Point& p : mirrored) p[0] = -p[0];
  for (const Frame& frame : {flat, mirrored}) {
    device.update(frame);
    EXPECT_EQ(device.lost(), example.balls.size());
    const Frame next = test::moved_vertices(example.rest(), test::Motion::kSquash, 0.5);
    device.update(next);
    device.expect_inside(next, "after it");
    EXPECT_LE(device.lost(), example.balls.size() / 20);
    device.update(example.rest());
    device.expect_inside(example.rest(), "at rest after it");
    EXPECT_EQ(device.lost(), 0u);
  }
}

TEST(FollowerJobOfAnyFrame, PartsThatCrossKeepBallsInside) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  // One arm of the L is moved through the other one.
  const Example example = l_shape();
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
  Frame frame = example.rest();
  for (Point& p : frame) {
    if (p[1] > 1) p = {p[0] + 0.3, 0.8 - 0.5 * p[1], p[2] + 0.1};
  }
  device.update(frame);
  device.expect_inside(frame, "crossing");
}

// Vertices at random: triangles cross everywhere, and most of space has winding numbers of both signs.
TEST(FollowerJobOfAnyFrame, VerticesAtRandomKeepBallsInside) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example(test::make_turned_torus(10, 8), 60);
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::size_t kept = 0;
  for (int repeat = 0; repeat < 8; ++repeat) {
    Frame frame = example.rest();
    for (Point& p : frame) p = {unit(random), unit(random), unit(random)};
    device.update(frame);
    device.expect_inside(frame, "random");
    kept += example.balls.size() - device.lost();
  }
  EXPECT_GT(kept, 0u);
}

TEST(FollowerJobOfAnyFrame, AFaultyFrameLosesAllBallsAndIsPassedOver) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = l_shape();
  FollowedOnDevice device(test::quick_device(), example.mesh, example.balls),
      untouched(test::quick_device(), example.mesh, example.balls);
  const Frame before = test::moved_vertices(example.rest(), test::Motion::kBend, 0.5),
              after = test::moved_vertices(example.rest(), test::Motion::kBend, 1);
  device.update(before);
  untouched.update(before);
  Frame not_a_number = before, infinite = before, one_point = before, far = before, large = before;
  not_a_number[3][1] = std::numeric_limits<double>::quiet_NaN();
  infinite[0][2] = -std::numeric_limits<double>::infinity();
  std::ranges::fill(one_point, Point{1, 2, 3});
  for (Point& p : far) p[0] += 4e6;
  for (Point& p : large) p = 1e4 * p;
  for (const Frame& faulty : {not_a_number, infinite, one_point, far, large}) {
    device.write_and_update(faulty);
    EXPECT_EQ(device.lost(), example.balls.size());
  }
  device.update(after);
  untouched.update(after);
  EXPECT_EQ(greatest_difference(device.balls(), untouched.balls()), 0);
  // Also where it is the first frame.
  device.job().reset();
  device.write_and_update(not_a_number);
  EXPECT_EQ(device.lost(), example.balls.size());
  device.update(before);
  device.update(after);
  EXPECT_EQ(greatest_difference(device.balls(), untouched.balls()), 0);
}

TEST(FollowerJobOfAnyFrame, RefusesWhatItCannotFollow) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Example example = l_shape();
  Context& context = test::quick_device();
  const auto code = [&](const IndexedMesh& mesh, std::span<const Ball> balls, const FollowerJobOptions& options) {
    return FollowerJob::create(context, mesh, balls, options).error().code;
  };
  FollowerJobOptions no_frames, wrong;
  no_frames.frames = 0;
  wrong.shrunk = 2;
  EXPECT_EQ(code(example.mesh, example.balls, no_frames), ErrorCode::kUsage);
  EXPECT_EQ(code(example.mesh, example.balls, wrong), ErrorCode::kUsage);
  EXPECT_EQ(code(example.mesh, {}, {}), ErrorCode::kUsage);
  const Ball outside = {{5, 5, 5}, 0.1};
  EXPECT_EQ(code(example.mesh, {{outside}}, {}), ErrorCode::kUsage);
  Mesh open = example.mesh.prepared().mesh, turned = open, large = open;
  open.triangles.pop_back();
  EXPECT_EQ(code(test::indexed(test::view_of(open, false)), example.balls, {}), ErrorCode::kInvalidMesh);
  test::turn_over(turned);
  EXPECT_EQ(code(test::indexed(test::view_of(turned)), example.balls, {}), ErrorCode::kInvalidMesh);
  for (Point& p : large.vertices) p = 1e30 * p;
  EXPECT_EQ(code(test::indexed(test::view_of(large)), example.balls, {}), ErrorCode::kInvalidMesh);

  FollowedOnDevice device(context, example.mesh, example.balls);
  Frame short_frame = example.rest(), not_finite = short_frame, too_large = short_frame;
  short_frame.pop_back();
  not_finite[3][1] = std::numeric_limits<double>::quiet_NaN();
  too_large[2][0] = 1e39;
  for (const Frame& frame : {short_frame, not_finite, too_large}) {
    EXPECT_EQ(device.job().set_vertices(frame).error().code, ErrorCode::kInvalidMesh);
  }
  EXPECT_EQ(device.job().set_vertices(not_finite).error().message, "vertex 3 has a coordinate that is not finite");
}

/// Frames of several kinds, with the kernels rewritten.
void expect_inside_with(const test::Rewrite& rewrite) {
  const test::OtherKernels kernels(rewrite);
  Context other = test::make_context();
  Internals::of(other).extra_shaders = kernels.shaders();
  for (const Example& example : {torus(), l_shape()}) {
    FollowedOnDevice device(other, example.mesh, example.balls);
    Frame flat = example.rest();
    for (Point& p : flat) p[2] = std::max(p[2], -0.1);
    for (const test::Motion motion : {test::Motion::kBend, test::Motion::kRipple}) {
      const Frame frame = test::moved_vertices(example.rest(), motion, 1);
      device.update(frame);
      device.expect_inside(frame, test::name_of(motion));
      EXPECT_LE(device.lost(), example.balls.size() / 10);
    }
    device.update(flat);
    device.expect_inside(flat, "flat");
  }
}

class OtherRoundingOfFollowed : public testing::TestWithParam<float> {};

// Division: 2.5 units in the last place. Roots: those of 1 / inversesqrt, 2 more.
TEST_P(OtherRoundingOfFollowed, KeepsBallsInside) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const test::OtherRounding rounding = {GetParam() * 2.4e-7f, GetParam() * 4e-7f, 0};
  expect_inside_with([&](auto words) { return test::round_otherwise(words, rounding); });
}

INSTANTIATE_TEST_SUITE_P(BothWays, OtherRoundingOfFollowed, testing::Values(1.0f, -1.0f),
                         [](const auto& sign) { return sign.param > 0 ? "larger" : "smaller"; });

class OtherSpecialsOfFollowed : public testing::TestWithParam<test::OtherSpecials> {};

TEST_P(OtherSpecialsOfFollowed, KeepsBallsInside) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_inside_with([&](auto words) { return test::replace_specials(words, GetParam()); });
}

INSTANTIATE_TEST_SUITE_P(, OtherSpecialsOfFollowed, testing::ValuesIn(test::kOtherSpecials),
                         [](const auto& specials) { return test::name_of(specials.param); });

}  // namespace
}  // namespace medial_vk
