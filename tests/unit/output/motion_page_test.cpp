// The page of a motion as bytes: the coding of its meshes, balls inside those of the record, harmless names, the same
// bytes twice. Its display in a browser: tests/page.
#include "output/motion_page/motion_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "output/motion_page/motion_geometry.h"
#include "output/page/base64.h"
#include "output/page/page.h"
#include "support/exact_number.h"

namespace medial_vk {
namespace {

using page::FrameCoder;
using page::MotionBox;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using MotionNumbers = std::vector<std::uint16_t>;

/// What docs/viewer.md says about the bytes, read backwards.
class FrameDecoder {
 public:
  MotionNumbers next(std::span<const std::uint8_t> bytes, std::size_t count) {
    std::size_t at = 0;
    const int from = bytes[at++];
    MotionNumbers numbers;
    for (std::size_t i = 0; i < count; ++i) {
      if (from == 0) {
        numbers.push_back(static_cast<std::uint16_t>(bytes[at] + 256 * bytes[at + 1]));
        at += 2;
        continue;
      }
      int rest = 0, factor = 1;
      do {
        rest += bytes[at] % 128 * factor;
        factor *= 128;
      } while (bytes[at++] >= 128);
      const int difference = rest % 2 == 0 ? rest / 2 : -(rest + 1) / 2;
      const int prediction = from == 1 ? before_[i] : 2 * before_[i] - before_that_[i];
      numbers.push_back(static_cast<std::uint16_t>(prediction + difference));
    }
    EXPECT_EQ(at, bytes.size());
    before_that_ = before_;
    before_ = numbers;
    return numbers;
  }

 private:
  MotionNumbers before_, before_that_;
};

TEST(MotionFrames, AreBytesAsDescribed) {
  FrameCoder coder;
  EXPECT_THAT(coder.next({1, 2, 300}), ElementsAre(0, 1, 0, 2, 0, 44, 1));
  EXPECT_THAT(coder.next({2, 1, 300}), ElementsAre(1, 2, 1, 0));             // by 1, -1, 0
  EXPECT_THAT(coder.next({102, 65535, 300}), ElementsAre(1, 200, 1, 3, 0));  // by 100 and, modulo 2^16, -2
  EXPECT_THAT(coder.next({202, 65533, 300}), ElementsAre(2, 0, 0, 0));       // as before
}

TEST(MotionFrames, AreDecodedForAnyNumbers) {
  std::mt19937 random(3);
  FrameCoder coder;
  FrameDecoder decoder;
  constexpr std::size_t kCount = 500;
  MotionNumbers numbers(kCount, 0);
  for (int frame = 0; frame < 40; ++frame) {
    // Small steps, then steps of any size, with both ends of the range among them.
    const unsigned range = frame < 20 ? 40 : 65536;
    for (std::uint16_t& number : numbers) number = static_cast<std::uint16_t>(number + random() % range);
    numbers[0] = frame % 2 == 0 ? 0 : 65535;
    numbers[1] = frame % 2 == 0 ? 32768 : 0;
    const std::vector<std::uint8_t> bytes = coder.next(numbers);
    EXPECT_EQ(decoder.next(bytes, kCount), numbers) << frame;
    EXPECT_LE(bytes.size(), 1 + 2 * kCount);
    if (frame > 0 && frame < 20) {
      EXPECT_LT(bytes.size(), 1 + kCount + 5);
    }
  }
}

/// A motion that is a parabola in time has second differences of a constant, which takes a byte.
TEST(MotionFrames, OfASmoothMotionTakeAByteForANumber) {
  FrameCoder coder;
  MotionNumbers numbers(300);
  for (int frame = 0; frame < 60; ++frame) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = static_cast<std::uint16_t>(100 * i + 5 * frame * frame);
    }
    const std::vector<std::uint8_t> bytes = coder.next(numbers);
    if (frame > 1) {
      EXPECT_EQ(bytes.size(), 1 + numbers.size()) << frame;
    }
  }
}

/// Exactly: with d = origin + scale c' - c, |d| <= r - scale r', or with `around` |d| <= scale r' - r.
void expect_one_in_the_other(const Ball& ball, const MotionBox& box, const std::array<float, 4>& placed, bool around) {
  using test::ExactNumber;
  const ExactNumber scale = box.scale;
  ExactNumber square;
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactNumber d = ExactNumber(box.origin[k]) + scale * ExactNumber(double{placed[k]}) - ball.centre[k];
    square = square + d * d;
  }
  const ExactNumber given = ball.radius, drawn = scale * ExactNumber(double{placed[3]});
  const ExactNumber left = around ? drawn - given : given - drawn;
  EXPECT_GE(left.sign(), 0);
  EXPECT_GE((left * left - square).sign(), 0);
}

TEST(MotionBalls, LieInsideThoseOfTheRecordOrHoldThem) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int drawn = 0;
  for (int i = 0; i < 2000; ++i) {
    MotionBox box;
    box.scale = std::exp(20 * unit(random));
    const double size = std::exp(3 * unit(random)) * box.scale;
    for (double& x : box.origin) x = 1000 * size * unit(random);
    Ball ball;
    for (std::size_t k = 0; k < 3; ++k) ball.centre[k] = box.origin[k] + size * unit(random);
    ball.radius = size * std::exp(-9 + 9 * unit(random));
    const std::array<float, 4> inside = page::ball_inside(ball, box), around = page::ball_around(ball, box);
    if (inside[3] > 0) {
      ++drawn;
      expect_one_in_the_other(ball, box, inside, false);
    }
    expect_one_in_the_other(ball, box, around, true);
    // Not far off: each coordinate moves by at most half a unit in the last place of a float, 2^-25 of it, and the
    // radius by another 2^-23 of it.
    double most = 0x1p-22 * ball.radius / box.scale;
    for (std::size_t k = 0; k < 3; ++k) most += 0x1p-24 * std::fabs(ball.centre[k] - box.origin[k]) / box.scale;
    EXPECT_GE(inside[3], ball.radius / box.scale - most);
    EXPECT_LE(around[3], ball.radius / box.scale + most);
  }
  EXPECT_GT(drawn, 1800);  // the others are smaller than the steps of floats at their place
}

TEST(MotionBalls, UnusedOnesOfACoverAreNothing) {
  EXPECT_EQ(page::ball_around({{0.1, 0.2, 0.3}, 0}, MotionBox())[3], 0);
  EXPECT_EQ(page::ball_around({{0.5, 0.25, 0}, 0.5}, MotionBox())[3], std::nextafter(0.5f, 1.0f));
}

TEST(MotionBalls, TooSmallForTheirPlaceAreNothing) {
  const MotionBox box;
  EXPECT_EQ(page::ball_inside({{0.1, 0.2, 0.3}, 1e-12}, box)[3], 0);  // floats near 0.3 are 3e-8 apart
  EXPECT_EQ(page::ball_inside({{0.1, 0.2, 0.3}, 0}, box)[3], 0);
  EXPECT_EQ(page::ball_inside({{0.5, 0.25, 0}, 0.5}, box)[3], std::nextafter(0.5f, 0.0f));
}

TEST(MotionBoxes, HoldAllFramesAndPlacesReachTheirEnds) {
  std::vector<FollowedFrame> frames(3);
  frames[0].vertices = {{1, 2, 5}, {3, 2, 5}};
  frames[2].vertices = {{2, -2, 5}, {-1, 0, 5}};
  const MotionBox box = page::box_of(frames);
  EXPECT_THAT(box.lower, ElementsAre(-1, -2, 5));
  EXPECT_THAT(box.upper, ElementsAre(3, 2, 5));
  EXPECT_THAT(box.origin, ElementsAre(1, 0, 5));
  EXPECT_EQ(box.scale, 4);
  EXPECT_THAT(page::places_in(box, frames[0].vertices), ElementsAre(32768, 65535, 0, 65535, 65535, 0));
  EXPECT_THAT(page::places_in(box, frames[2].vertices), ElementsAre(49151, 0, 0, 0, 32768, 0));
  EXPECT_EQ(page::box_of({}).scale, 1);
}

/// A triangle that moves, with two balls, of which one is lost in the second frame.
class MotionPageBytes : public testing::Test {
 protected:
  MotionPageBytes() {
    record_.version = "1.2.3";
    record_.name = "part.obj";
    record_.rule = "tangent";
    record_.frames_per_second = 25;
    record_.has_volume = true;
    record_.triangles = {{0, 1, 2}};
    for (int i = 0; i < 3; ++i) {
      FollowedFrame frame;
      frame.name = "folder/frame.obj";
      frame.short_name = "frame " + std::to_string(i);
      frame.time = 0.04 * i;
      frame.balls = {{{0.5, 0.25, 0}, 0.125}, {{0.25, 0.5, 0}, i == 1 ? 0 : 0.0625}};
      frame.states = {FollowState::kFlat, i == 1 ? FollowState::kLost : FollowState::kShrunk};
      frame.measures = {8, 6, 0};
      const auto shift = static_cast<float>(i);
      frame.vertices = {{shift, 0, 0}, {shift + 1, 0, 0}, {shift, 1, 0}};
      record_.frames.push_back(frame);
    }
    record_.frames[2].gap = Bounds{0.5, 0.75};
  }

  void SetUp() override {
    if (!check_page_available()) GTEST_SKIP() << check_page_available().error().message;
  }

  static std::string element(const char* id, std::span<const std::uint8_t> bytes) {
    std::string out = std::string("id=\"data-") + id + "\">";
    page::append_base64(out, bytes);
    return out + "</script>";
  }

  MotionRecord record_;
};

TEST_F(MotionPageBytes, HoldNumbersAndGeometry) {
  const std::string text = encode_motion_page(record_, UpAxis::kMinusZ);
  EXPECT_THAT(text, HasSubstr("<title>part.obj - "));
  EXPECT_THAT(text, HasSubstr("\"frames_per_second\":25.0,\"closed\":true,\"up\":\"-z\",\"scale\":3.0"));
  EXPECT_THAT(text, HasSubstr("\"vertices\":3,\"triangles\":1,\"balls\":2,\"shown\":[0,1,2]"));
  EXPECT_THAT(text, HasSubstr("{\"name\":\"frame 1\",\"time\":0.04,\"uncovered\":25.0,\"outside\":0.0,\"gap\":null,"
                              "\"medial\":0,\"flat\":1,\"shrunk\":0,\"lost\":1}"));
  EXPECT_THAT(text, HasSubstr("\"gap\":[0.5,0.75]"));
  EXPECT_THAT(text, HasSubstr(element("states", std::array<std::uint8_t, 6>{1, 2, 1, 3, 1, 2})));
  EXPECT_THAT(text, HasSubstr(element("triangles", std::array<std::uint8_t, 12>{0, 0, 0, 0, 1, 0, 0, 0, 2})));
  FrameCoder coder;
  std::vector<std::uint8_t> vertices;
  for (const MotionNumbers& numbers :
       {MotionNumbers{0, 0, 0, 21845, 0, 0, 0, 65535, 0}, MotionNumbers{21845, 0, 0, 43690, 0, 0, 21845, 65535, 0},
        MotionNumbers{43690, 0, 0, 65535, 0, 0, 43690, 65535, 0}}) {
    std::ranges::copy(coder.next(numbers), std::back_inserter(vertices));
  }
  EXPECT_THAT(text, HasSubstr(element("vertices", vertices)));
  EXPECT_THAT(text, Not(HasSubstr("<!--medial-vk")));
}

TEST_F(MotionPageBytes, CountBallsChosenAnewIfThereMayBeAny) {
  EXPECT_THAT(encode_motion_page(record_), Not(HasSubstr("\"renewed\"")));
  record_.renews = true;
  for (FollowedFrame& frame : record_.frames) frame.origins.assign(2, FollowOrigin::kFollowed);
  record_.frames[1].origins[0] = FollowOrigin::kRenewed;
  EXPECT_THAT(encode_motion_page(record_), HasSubstr("\"lost\":1,\"renewed\":1}"));
}

TEST_F(MotionPageBytes, OfACoverSayWhatIsProved) {
  record_.rule = "cover";
  record_.covers = true;
  for (FollowedFrame& frame : record_.frames) {
    const bool all = frame.balls[1].radius > 0;
    frame.states.clear();
    frame.cover = CoveredFrame{all ? CoverState::kSolid : CoverState::kSurface,
                               {CoverBallState::kGrown, all ? CoverBallState::kSteady : CoverBallState::kUnused},
                               {8, 10},
                               {}};
  }
  record_.frames[0].cover->reach_out_bound = 0.125;
  const std::string text = encode_motion_page(record_);
  EXPECT_THAT(text, HasSubstr("\"rule\":\"cover\""));
  EXPECT_THAT(text,
              HasSubstr("\"added\":25.0,\"reach_out\":0.125,\"solid\":true,\"steady\":1,\"grown\":1,\"unused\":0}"));
  EXPECT_THAT(text, HasSubstr("\"reach_out\":null,\"solid\":false,\"steady\":0,\"grown\":1,\"unused\":1}"));
  EXPECT_THAT(text, Not(HasSubstr("\"uncovered\":")));
  EXPECT_THAT(text, HasSubstr(element("states", std::array<std::uint8_t, 6>{1, 0, 1, 2, 1, 0})));
}

TEST_F(MotionPageBytes, AreTheSameTwice) { EXPECT_EQ(encode_motion_page(record_), encode_motion_page(record_)); }

TEST_F(MotionPageBytes, HoldNoNumberThatIsNotKnown) {
  record_.has_volume = false;
  const std::string open = encode_motion_page(record_);
  EXPECT_THAT(open, HasSubstr("\"uncovered\":null,\"outside\":null"));
  record_.has_volume = true;
  record_.frames[0].measures.solid_volume = 0;
  EXPECT_THAT(encode_motion_page(record_), HasSubstr("\"uncovered\":null,\"outside\":null"));
}

TEST_F(MotionPageBytes, HoldFramesWithoutAMeshAsNumbers) {
  record_.frames[1].vertices.clear();
  const std::string text = encode_motion_page(record_);
  EXPECT_THAT(text, HasSubstr("\"shown\":[0,2]"));
  EXPECT_THAT(text, HasSubstr("\"name\":\"frame 1\""));
  EXPECT_THAT(text, HasSubstr(element("states", std::array<std::uint8_t, 4>{1, 2, 1, 2})));
}

TEST_F(MotionPageBytes, WithoutAnyMeshAreNumbersAlone) {
  for (FollowedFrame& frame : record_.frames) frame.vertices.clear();
  const std::string text = encode_motion_page(record_);
  EXPECT_THAT(text, HasSubstr("\"shown\":[]"));
  EXPECT_THAT(text, HasSubstr("\"name\":\"frame 2\""));
  EXPECT_THAT(text, Not(HasSubstr("id=\"data-")));
}

TEST_F(MotionPageBytes, NoNameCanBreakOut) {
  record_.name = "a</title><script>alert(1)</script><!--\xff.obj";
  record_.frames[1].short_name = "b</script><script>alert(2)</script>\xfe";
  const std::string text = encode_motion_page(record_);
  EXPECT_THAT(text, HasSubstr("<title>a&lt;/title>&lt;script>alert(1)"));
  for (const char* bad : {"<script>alert", "alert(2)</script>", "a</title>", "<!--\xff", "\xff", "\xfe"}) {
    EXPECT_THAT(text, Not(HasSubstr(bad)));
  }
}

TEST_F(MotionPageBytes, NeedNoNetworkAndCarryTheLicence) {
  const std::string text = encode_motion_page(record_);
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
  EXPECT_THAT(text, HasSubstr("Permission is hereby granted"));
  for (const char* request : {" src=", "<link", "@import", "url("}) EXPECT_THAT(text, Not(HasSubstr(request)));
}

}  // namespace
}  // namespace medial_vk
