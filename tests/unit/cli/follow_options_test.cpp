// The command line of `medial-vk follow`: defaults, ranges, options that exclude each other, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/options/follow_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

FollowOptions parsed_follow(const std::vector<std::string>& arguments) {
  return value_of(parse_follow_options(arguments), arguments);
}

std::string follow_message(const std::vector<std::string>& arguments) {
  return message_of(parse_follow_options(arguments), arguments);
}

TEST(FollowOptions, Defaults) {
  FollowOptions expected;
  expected.rest = "models/rest.obj";
  expected.frames = {"a.obj", "b.obj"};
  expected.outputs = {"rest.follow.npz"};
  expected.has_usual_output = true;
  expected.follower.steps = 1;
  expected.follower.renewed = kUsualRenewed;
  expected.has_usual_renewal = true;
  EXPECT_EQ(parsed_follow({"models/rest.obj", "a.obj", "b.obj"}), expected);
  EXPECT_EQ(parsed_follow({"dancer.glb"}).outputs, std::vector<std::string>{"dancer.follow.npz"});
  EXPECT_EQ(parsed_follow({"-", "a.obj"}).outputs, std::vector<std::string>{"stdin.follow.npz"});
}

TEST(FollowOptions, AllAtOnce) {
  const FollowOptions options = parsed_follow(
      {"-o",        "a.npz",       "rest.obj", "--rule", "tangent",        "f1.obj",  "-o",       "a.GLB",
       "--steps",   "0",           "f2.obj",   "-o",     "a.csv",          "--count", "64",       "--resolution",
       "50",        "--from-rest", "--shrunk", "0.25",   "--object-angle", "0.75",    "--fps",    "24",
       "--picture", "a.png",       "--html",   "a.html", "--up",           "z",       "--device", "llvmpipe",
       "--check",   "--threads",   "3",        "-v"});
  FollowOptions expected;
  expected.rest = "rest.obj";
  expected.frames = {"f1.obj", "f2.obj"};
  expected.outputs = {"a.npz", "a.GLB", "a.csv"};
  expected.count = 64;
  expected.resolution = 50;
  expected.from_rest = expected.check = expected.verbose = true;
  expected.follower.steps = 0;
  expected.follower.renewed = kUsualRenewed;
  expected.has_usual_renewal = true;
  expected.follower.shrunk = 0.25;
  expected.follower.object_angle = 0.75;
  expected.follower.threads = 3;
  expected.frames_per_second = 24;
  expected.picture = "a.png";
  expected.html = "a.html";
  expected.view = options.view;
  EXPECT_EQ(options.view.up, UpAxis::kZ);
  expected.device = "llvmpipe";
  EXPECT_EQ(options, expected);
  EXPECT_TRUE(writes_table(options));
  EXPECT_FALSE(writes_table(parsed_follow({"rest.obj", "a.obj"})));
  EXPECT_EQ(outputs_of(options).size(), 6u);
  EXPECT_THAT(inputs_of(options), testing::UnorderedElementsAre("rest.obj", "f1.obj", "f2.obj"));
}

TEST(FollowOptions, ThePublishedRule) {
  const FollowOptions options = parsed_follow({"r.obj", "a.obj", "--rule", "published", "--protrusion", "0.01"});
  EXPECT_EQ(options.follower.rule, FollowRule::kPublished);
  EXPECT_EQ(options.follower.steps, 0u);
  EXPECT_EQ(options.follower.protrusion, 0.01);
  EXPECT_EQ(parsed_follow({"r.obj", "a.obj", "--rule", "published"}).follower.protrusion, 0.0025);
}

TEST(FollowOptions, BallsChosenAnew) {
  const FollowOptions options = parsed_follow({"r.obj", "a.obj", "--renew", "25", "--renew-factor", "1.25"});
  EXPECT_EQ(options.follower.renewed, 25u);
  EXPECT_EQ(options.follower.renewal_factor, 1.25);
  EXPECT_EQ(parsed_follow({"r.obj", "a.obj", "--renew", "25"}).follower.renewal_factor, 1.5);
  EXPECT_EQ(parsed_follow({"r.glb", "--rig", "a.json", "--renew", "0"}).follower.renewed, 0u);
  EXPECT_FALSE(options.has_usual_renewal);
  const FollowOptions usual = parsed_follow({"r.obj", "a.obj"});
  EXPECT_TRUE(usual.has_usual_renewal);
  EXPECT_EQ(usual.follower.renewed, kUsualRenewed);
  const FollowOptions with_factor = parsed_follow({"r.obj", "a.obj", "--renew-factor", "2"});
  EXPECT_FALSE(with_factor.has_usual_renewal);
  EXPECT_EQ(with_factor.follower.renewed, kUsualRenewed);
  for (const std::vector<std::string>& none :
       std::vector<std::vector<std::string>>{{"r.glb", "--rig", "a.json"},
                                             {"r.obj", "a.obj", "--rule", "published"},
                                             {"r.obj", "a.obj", "--contract", "cover"},
                                             {"r.obj", "a.obj", "--renew", "0"}}) {
    EXPECT_EQ(parsed_follow(none).follower.renewed, 0u) << none.back();
    EXPECT_FALSE(parsed_follow(none).has_usual_renewal) << none.back();
  }
}

TEST(FollowOptions, Covers) {
  const FollowOptions usual = parsed_follow({"r.obj", "a.obj", "--contract", "cover"});
  EXPECT_TRUE(usual.covers());
  EXPECT_EQ(usual.count, 100u);
  EXPECT_EQ(usual.follower.steps, 1u);
  EXPECT_EQ(usual.grown, 1.25);
  EXPECT_FALSE(usual.tighten);
  const FollowOptions options =
      parsed_follow({"r.obj", "a.obj", "--contract", "cover", "--count", "30", "--steps", "0", "--tighten", "--grown",
                     "2", "--check", "--resolution", "60", "--html", "a.html"});
  EXPECT_EQ(options.follower.steps, 0u);
  EXPECT_EQ(options.grown, 2);
  EXPECT_TRUE(options.tighten);
  EXPECT_TRUE(options.check);
  EXPECT_FALSE(parsed_follow({"r.obj", "a.obj", "--contract", "inside"}).covers());
  EXPECT_EQ(parsed_follow({"r.obj", "a.obj", "--contract", "inside"}).count, 500u);
}

TEST(FollowOptions, EachContractHasItsOptions) {
  using Words = std::vector<std::string>;
  for (const Words& option : {Words{"--points", "--resolution", "40"}, Words{"--rule", "tangent"}, Words{"--from-rest"},
                              Words{"--renew", "0"}, Words{"--renew-factor", "2"}, Words{"--protrusion", "0.1"},
                              Words{"--shrunk", "0.5"}, Words{"--object-angle", "0.5"}, Words{"--rig", "a.json"}}) {
    Words arguments = {"r.glb", "--contract", "cover"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    EXPECT_THAT(follow_message(arguments),
                HasSubstr(option[0] + " is about balls inside; it cannot be used with --contract cover"));
  }
  for (const Words& option : {Words{"--tighten"}, Words{"--grown", "2"}}) {
    for (const Words& contract : {Words{}, Words{"--contract", "inside"}}) {
      Words arguments = {"r.obj", "a.obj"};
      arguments.insert(arguments.end(), contract.begin(), contract.end());
      arguments.insert(arguments.end(), option.begin(), option.end());
      EXPECT_THAT(follow_message(arguments),
                  HasSubstr(option[0] + " is about balls that cover; use it with --contract cover"));
    }
  }
}

TEST(FollowOptions, ScenesAndBalls) {
  const FollowOptions scene = parsed_follow({"d.glb", "--animation", "walk", "--balls", "b.csv"});
  EXPECT_EQ(scene.animation, "walk");
  EXPECT_EQ(scene.balls, "b.csv");
  EXPECT_TRUE(scene.frames.empty());
  EXPECT_TRUE(parsed_follow({"d.glb", "--points", "--resolution", "40"}).points);
}

TEST(FollowOptions, WhatExcludesEachOther) {
  EXPECT_THAT(follow_message({}), HasSubstr("give the mesh in the rest pose"));
  EXPECT_THAT(follow_message({"-", "a.obj", "--balls", "-"}), HasSubstr("only one of the meshes and --balls"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--animation", "x"}), HasSubstr("--animation is of a scene alone"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--balls", "b.csv", "--points"}), HasSubstr("cannot be used together"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--balls", "b.csv", "--count", "3"}), HasSubstr("--count"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--points", "--count", "3"}), HasSubstr("--count"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--balls", "b.csv", "--resolution", "3"}), HasSubstr("--resolution"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--points"}), HasSubstr("--points: give --resolution N"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--rule", "published", "--steps", "0"}), HasSubstr("--steps"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--rule", "published", "--check"}), HasSubstr("--check"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--protrusion", "0.1"}), HasSubstr("--rule published"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--rule", "published", "--renew", "1"}), HasSubstr("--renew"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--renew", "0", "--renew-factor", "2"}), HasSubstr("--renew 0"));
  EXPECT_THAT(follow_message({"r.glb", "--rig", "a.json", "--renew", "1"}), HasSubstr("--rig"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "-q", "-v"}), HasSubstr("-q and -v"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--backend", "cpu", "--device", "0"}), HasSubstr("--device"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--view", "top"}), HasSubstr("--picture"));
}

TEST(FollowOptions, Files) {
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "-o", "x.ply"}), HasSubstr("none of .npz, .glb and .csv"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "-o", "x.npz", "-o", "./x.npz"}), HasSubstr("the same file"));
  EXPECT_THAT(follow_message({"r.glb", "-o", "r.glb"}), HasSubstr("would overwrite the input r.glb"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--balls", "b.csv", "-o", "b.csv"}), HasSubstr("would overwrite"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--picture", "a.jpg"}), HasSubstr("does not end in .png"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--rig", "a.json"}), HasSubstr("--rig is about the joints"));
  EXPECT_THAT(follow_message({"r.glb", "--rig", "a.txt"}), HasSubstr("ends in none of .json, .glb and .gltf"));
  EXPECT_EQ(parsed_follow({"r.glb", "--rig", "a.json"}).rig, "a.json");
  EXPECT_FALSE(rig_has_nodes(parsed_follow({"r.glb", "--rig", "a.json"})));
  for (const char* file : {"a.glb", "b.gltf"}) EXPECT_TRUE(rig_has_nodes(parsed_follow({"r.glb", "--rig", file})));
  EXPECT_THAT(follow_message({"r.glb", "--rig", "r.glb"}), HasSubstr("would overwrite the input"));
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "-o", "-", "--picture", "-"}), HasSubstr("the same file"));
}

TEST(FollowOptions, APatternAloneIsTheRestPoseAndTheFrames) {
  const std::vector<std::string> files = {"a/w_1.obj", "a/w_2.obj", "a/w_3.obj"};
  const auto named = [&](std::vector<std::string> more) {
    more.insert(more.begin(), "a/w_*.obj");
    return with_files_of_pattern(parsed_follow(more), files);
  };
  const FollowOptions usual = named({}).value();
  EXPECT_EQ(usual.rest, "a/w_1.obj");
  EXPECT_EQ(usual.frames, (std::vector<std::string>{"a/w_2.obj", "a/w_3.obj"}));
  EXPECT_EQ(usual.outputs, std::vector<std::string>{"w_1.follow.npz"});
  EXPECT_EQ(named({"-o", "b.npz"}).value().outputs, std::vector<std::string>{"b.npz"});
  const auto message = [&](const std::vector<std::string>& more) { return message_of(named(more), more); };
  EXPECT_THAT(message({"--animation", "x"}), HasSubstr("--animation is of a scene alone"));
  EXPECT_THAT(message({"--rig", "a.json"}), HasSubstr("--rig is about the joints of an animation"));
  EXPECT_EQ(message_of(with_files_of_pattern(parsed_follow({"w_*.obj"}), {"w_1.obj"}), {}),
            "'w_*.obj' stands for w_1.obj alone: a motion needs the rest pose and a frame");
}

TEST(FollowOptions, Ranges) {
  for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{{"--count", "0"},
                                                                                      {"--count", "100001"},
                                                                                      {"--steps", "101"},
                                                                                      {"--steps", "-1"},
                                                                                      {"--renew", "10001"},
                                                                                      {"--renew-factor", "0.99"},
                                                                                      {"--protrusion", "1"},
                                                                                      {"--shrunk", "1.5"},
                                                                                      {"--object-angle", "2"},
                                                                                      {"--fps", "0"},
                                                                                      {"--resolution", "4097"},
                                                                                      {"--threads", "1025"},
                                                                                      {"--grown", "0.5"},
                                                                                      {"--contract", "both"},
                                                                                      {"--rule", "other"}}) {
    std::vector<std::string> arguments = {"r.obj", "a.obj"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    EXPECT_THAT(follow_message(arguments), HasSubstr(option[0])) << option[1];
  }
  EXPECT_THAT(follow_message({"r.obj", "a.obj", "--step", "2"}), HasSubstr("did you mean --steps?"));
}

}  // namespace
}  // namespace medial_vk::cli
