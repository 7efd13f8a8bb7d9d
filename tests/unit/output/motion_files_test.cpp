// Balls in motion as files: every number of the arrays and of the table, and an animation whose balls are inside the
// given ones or, of covers, around them.
#include "output/motion_files/motion_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "common/absent_parts.h"
#include "output/numpy_files/npz_reader.h"
#include "unit/output/motion_example.h"
#include "unit/output/parsed_glb.h"

namespace medial_vk {
namespace {

using test::motion_example;

class MotionNpz : public testing::Test {
 protected:
  void SetUp() override {
    if (!check_format_is_built("a.npz").ok()) GTEST_SKIP() << "a build without libzip";
  }
};

std::vector<double> doubles_of(const NpyArray& array) {
  EXPECT_EQ(array.type, "<f8");
  std::vector<double> values(array.bytes.size() / sizeof(double));
  std::memcpy(values.data(), array.bytes.data(), array.bytes.size());  // the tests run on little-endian machines only
  return values;
}

TEST_F(MotionNpz, HoldsEveryBallOfEveryFrame) {
  const MotionRecord record = motion_example();
  const auto arrays = read_npz(encode_motion_npz(record).value(), "motion").value();
  const NpyArray& balls = arrays.at("balls");
  EXPECT_EQ(balls.shape, (std::vector<std::uint64_t>{3, 2, 4}));
  const std::vector<double> numbers = doubles_of(balls);
  std::size_t at = 0;
  for (const FollowedFrame& frame : record.frames) {
    for (const Ball& ball : frame.balls) {
      for (const double x : ball.centre) EXPECT_EQ(numbers.at(at++), x);
      EXPECT_EQ(numbers.at(at++), ball.radius);
    }
  }
  EXPECT_EQ(arrays.at("states").type, "|u1");
  EXPECT_EQ(arrays.at("states").shape, (std::vector<std::uint64_t>{3, 2}));
  EXPECT_EQ(arrays.at("states").bytes, std::string("\0\0\0\1\2\3", 6));
  EXPECT_EQ(doubles_of(arrays.at("time")), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(doubles_of(arrays.at("solid_volume")), (std::vector<double>{8, 10, 16}));
  EXPECT_EQ(doubles_of(arrays.at("ball_volume")), (std::vector<double>{6, 5, 0}));
  EXPECT_EQ(doubles_of(arrays.at("outside_bound")), (std::vector<double>{0, 0.125, 0}));
  EXPECT_EQ(doubles_of(arrays.at("frames_per_second")), std::vector<double>{2});
  const std::vector<double> gaps = doubles_of(arrays.at("gap_upper"));
  EXPECT_EQ(gaps[0], 0.75);
  EXPECT_TRUE(std::isnan(gaps[2])) << "not measured";
}

TEST_F(MotionNpz, AnOpenMeshHasNoVolume) {
  MotionRecord record = motion_example();
  record.has_volume = false;
  const auto arrays = read_npz(encode_motion_npz(record).value(), "motion").value();
  for (const double volume : doubles_of(arrays.at("solid_volume"))) EXPECT_TRUE(std::isnan(volume));
}

const std::string kNames =
    "frame,name,time,solid_volume,ball_volume,uncovered_percent,outside_bound,gap_lower,gap_upper,medial,flat,shrunk,"
    "lost\n";

TEST(MotionCsv, ALinePerFrame) {
  EXPECT_EQ(encode_motion_csv(motion_example()), kNames +
                                                     "0,rest,0,8,6,25,0,0.5,0.75,2,0,0,0\n"
                                                     "1,a.obj,0.5,10,5,50,0.125,1,1.25,1,1,0,0\n"
                                                     "2,\"the \"\"last\"\", bent.obj\",1,16,0,100,0,,,0,0,1,1\n");
}

TEST(MotionCsv, WithoutAVolumeItsPlacesAreEmpty) {
  MotionRecord record = motion_example();
  record.has_volume = false;
  record.frames.resize(1);
  EXPECT_EQ(encode_motion_csv(record), kNames + "0,rest,0,,6,,0,0.5,0.75,2,0,0,0\n");
}

MotionRecord renewed_example() {
  MotionRecord record = motion_example();
  record.renews = true;
  for (FollowedFrame& frame : record.frames) frame.origins.assign(2, FollowOrigin::kFollowed);
  record.frames[1].origins = {FollowOrigin::kReturned, FollowOrigin::kRenewed};
  return record;
}

TEST(MotionCsv, BallsChosenAnewAreCountedIfThereMayBeAny) {
  EXPECT_EQ(encode_motion_csv(renewed_example()), kNames.substr(0, kNames.size() - 1) +
                                                      ",renewed\n"
                                                      "0,rest,0,8,6,25,0,0.5,0.75,2,0,0,0,0\n"
                                                      "1,a.obj,0.5,10,5,50,0.125,1,1.25,1,1,0,0,1\n"
                                                      "2,\"the \"\"last\"\", bent.obj\",1,16,0,100,0,,,0,0,1,1,0\n");
}

TEST_F(MotionNpz, BallsChosenAnewAreMarkedIfThereMayBeAny) {
  const auto arrays = read_npz(encode_motion_npz(renewed_example()).value(), "motion").value();
  EXPECT_EQ(arrays.at("origins").type, "|u1");
  EXPECT_EQ(arrays.at("origins").shape, (std::vector<std::uint64_t>{3, 2}));
  EXPECT_EQ(arrays.at("origins").bytes, std::string("\0\0\2\1\0\0", 6));
  EXPECT_FALSE(read_npz(encode_motion_npz(motion_example()).value(), "motion").value().contains("origins"));
}

MotionRecord estimated_example() {
  MotionRecord record = motion_example();
  record.rule = "published";
  record.estimates_outside = true;
  record.frames[0].outside = OutsideEstimate{0, 0.25};
  record.frames[1].outside = OutsideEstimate{0.0625, 0.5};
  return record;
}

TEST(MotionCsv, WhatReachesOutByThePublishedRuleIsEstimated) {
  std::string names = kNames;
  names.insert(names.find("gap_lower"), "outside_estimate,outside_error,");
  EXPECT_EQ(encode_motion_csv(estimated_example()), names +
                                                        "0,rest,0,8,6,25,0,0,0.25,0.5,0.75,2,0,0,0\n"
                                                        "1,a.obj,0.5,10,5,50,0.125,0.0625,0.5,1,1.25,1,1,0,0\n"
                                                        "2,\"the \"\"last\"\", bent.obj\",1,16,0,100,0,,,,,0,0,1,1\n");
}

TEST_F(MotionNpz, WhatReachesOutByThePublishedRuleIsEstimated) {
  const auto arrays = read_npz(encode_motion_npz(estimated_example()).value(), "motion").value();
  const std::vector<double> estimates = doubles_of(arrays.at("outside_estimate"));
  EXPECT_EQ(estimates[1], 0.0625);
  EXPECT_TRUE(std::isnan(estimates[2])) << "not estimated";
  EXPECT_EQ(doubles_of(arrays.at("outside_error"))[0], 0.25);
  const auto without = read_npz(encode_motion_npz(motion_example()).value(), "motion").value();
  EXPECT_FALSE(without.contains("outside_estimate"));
}

TEST_F(MotionNpz, OfACoverSaysWhatIsProved) {
  const auto arrays = read_npz(encode_motion_npz(test::cover_motion_example()).value(), "motion").value();
  EXPECT_EQ(arrays.at("balls").shape, (std::vector<std::uint64_t>{3, 2, 4}));
  EXPECT_EQ(arrays.at("states").bytes, std::string("\0\0\1\0\1\2", 6));
  EXPECT_EQ(arrays.at("proved").type, "|u1");
  EXPECT_EQ(arrays.at("proved").bytes, std::string("\0\0\1", 3));
  EXPECT_EQ(doubles_of(arrays.at("solid_volume")), (std::vector<double>{8, 10, 16}));
  EXPECT_EQ(doubles_of(arrays.at("ball_volume")), (std::vector<double>{10, 15, 24}));
  const std::vector<double> reach = doubles_of(arrays.at("reach_out_bound"));
  EXPECT_EQ(reach[1], 0.5);
  EXPECT_TRUE(std::isnan(reach[2])) << "not measured";
  for (const char* const of_inside : {"outside_bound", "gap_lower", "gap_upper", "origins"}) {
    EXPECT_FALSE(arrays.contains(of_inside)) << of_inside;
  }
}

const std::string kCoverNames =
    "frame,name,time,solid_volume,ball_volume,added_percent,reach_out_bound,proved,steady,grown,unused\n";

TEST(MotionCsv, OfACoverSaysWhatIsProved) {
  EXPECT_EQ(encode_motion_csv(test::cover_motion_example()), kCoverNames +
                                                                 "0,rest,0,8,10,25,0.25,solid,2,0,0\n"
                                                                 "1,a.obj,0.5,10,15,50,0.5,solid,1,1,0\n"
                                                                 "2,\"the \"\"last\"\", bent.obj\",1,16,24,50,,"
                                                                 "surface,0,1,1\n");
  MotionRecord open = test::cover_motion_example();
  open.has_volume = false;
  open.frames.resize(1);
  EXPECT_EQ(encode_motion_csv(open), kCoverNames + "0,rest,0,,10,,0.25,solid,2,0,0\n");
}

/// The centre's distance from that of the record, and the radius, of a ball in every frame.
using DistanceAndRadius = std::pair<long double, float>;

std::vector<std::vector<DistanceAndRadius>> glb_tracks(const MotionRecord& record) {
  const test::Glb glb = test::parse_glb(encode_motion_glb(record).value());
  const nlohmann::json& animation = glb.document["animations"][0];
  EXPECT_EQ(glb.document["nodes"].size(), 3u) << "a root and two balls";
  EXPECT_EQ(animation["channels"].size(), 4u);
  const auto values = [&](std::size_t node, const char* path) {
    for (const nlohmann::json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      const nlohmann::json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      EXPECT_EQ(sampler["interpolation"], "STEP") << "nothing is proved between frames";
      EXPECT_EQ(glb.document["accessors"][sampler["input"].get<std::size_t>()]["count"], record.frames.size());
      return test::vectors(glb, sampler["output"].get<std::size_t>());
    }
    ADD_FAILURE() << "no channel " << path << " of node " << node;
    return std::vector<std::array<float, 3>>(record.frames.size());
  };
  const nlohmann::json& root = glb.document["nodes"][0]["translation"];
  std::vector<std::vector<DistanceAndRadius>> tracks(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto centres = values(i + 1, "translation"), sizes = values(i + 1, "scale");
    for (std::size_t f = 0; f < record.frames.size(); ++f) {
      long double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const long double off = root[k].get<long double>() + centres[f][k] - record.frames[f].balls[i].centre[k];
        squared += off * off;
        EXPECT_EQ(sizes[f][k], sizes[f][0]);
      }
      tracks[i].emplace_back(std::sqrt(squared), sizes[f][0]);
    }
  }
  return tracks;
}

TEST(MotionGlb, BallsLieInsideThoseOfTheFrames) {
  const MotionRecord record = motion_example();
  const auto tracks = glb_tracks(record);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t f = 0; f < record.frames.size(); ++f) {
      const auto [distance, radius] = tracks[i][f];
      const double given = record.frames[f].balls[i].radius;
      if (given > 0) {
        EXPECT_LE(distance + radius, static_cast<long double>(given)) << f << " " << i;
      }
      EXPECT_GE(radius, 0);
      EXPECT_NEAR(radius, given, 1e-6) << "floats near 1 are 2^-24 apart";
    }
  }
}

TEST(MotionGlb, BallsOfACoverHoldThoseOfTheFrames) {
  const MotionRecord record = test::cover_motion_example();
  const auto tracks = glb_tracks(record);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t f = 0; f < record.frames.size(); ++f) {
      const auto [distance, radius] = tracks[i][f];
      const double given = record.frames[f].balls[i].radius;
      if (given > 0) {
        EXPECT_GE(radius, distance + static_cast<long double>(given)) << f << " " << i;
      } else {
        EXPECT_EQ(radius, 0) << f << " " << i;
      }
      EXPECT_NEAR(radius, given, 1e-6) << "floats near 1 are 2^-24 apart";
    }
  }
}

TEST(MotionGlb, TimesAscendAlsoWhereFloatsCoincide) {
  MotionRecord record = motion_example();
  record.frames[0].time = 1e8;
  record.frames[1].time = 1e8 + 1e-3;
  record.frames[2].time = 1e8 + 2e-3;
  const test::Glb glb = test::parse_glb(encode_motion_glb(record).value());
  const std::size_t input = glb.document["animations"][0]["samplers"][0]["input"];
  const nlohmann::json& times = glb.document["accessors"][input];
  EXPECT_EQ(times["min"][0], 1e8f);
  EXPECT_EQ(times["max"][0], std::nextafter(std::nextafter(1e8f, 2e8f), 2e8f));
}

}  // namespace
}  // namespace medial_vk
