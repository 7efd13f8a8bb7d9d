#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "output/medial_formats/ball_colours.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/glb_container.h"
#include "output/motion_files/motion_files.h"

namespace medial_vk {
namespace {

using Vector = std::array<float, 3>;
using Vectors = std::vector<Vector>;

constexpr std::uint32_t kDetail = 2;  // subdivisions of the icosahedron

Point middle_of(const MotionRecord& record) {
  CentreBox box;
  for (const FollowedFrame& frame : record.frames) {
    for (const Ball& ball : frame.balls) {
      if (ball.radius > 0) box.add(ball.centre);
    }
  }
  return box.middle();
}

/// Seconds in float, ascending as glTF requires: frames that coincide in float are a unit in the last place apart.
std::vector<float> times_of(const MotionRecord& record) {
  std::vector<float> times;
  for (const FollowedFrame& frame : record.frames) {
    auto time = static_cast<float>(frame.time);
    if (!times.empty() && !(time > times.back())) {
      time = std::nextafter(times.back(), std::numeric_limits<float>::infinity());
    }
    times.push_back(time);
  }
  return times;
}

/// Centres and sizes of one ball, frame by frame.
struct Track {
  Vectors centres, sizes;
};

Track track_of(const MotionRecord& record, std::size_t ball, const Point& middle) {
  Track track;
  for (const FollowedFrame& frame : record.frames) {
    const GlbBall b = record.covers ? glb_ball_around(frame.balls[ball], middle) : glb_ball(frame.balls[ball], middle);
    track.centres.push_back(b.centre);
    track.sizes.push_back({b.radius, b.radius, b.radius});
  }
  return track;
}

class MotionEncoder {
 public:
  explicit MotionEncoder(const MotionRecord& record)
      : record_(record), middle_(middle_of(record)), times_(glb_.add_times(times_of(record))) {
    glb_.document = {{"asset", {{"version", "2.0"}, {"generator", "medial-vk " + record.version}}},
                     {"scene", 0},
                     {"scenes", {{{"nodes", {0}}}}}};
  }

  Result<std::string> encode() {
    add_ball_mesh();
    const std::size_t balls = record_.frames.front().balls.size();
    std::string nodes = root_node(balls);
    for (std::size_t i = 0; i < balls; ++i) nodes += add_ball(i);
    glb_.document["animations"] = {
        {{"name", record_.name}, {"samplers", std::move(samplers_)}, {"channels", std::move(channels_)}}};
    return glb_.finish(nodes + "]");
  }

 private:
  void add_ball_mesh() {
    GltfJson primitive = add_unit_ball(glb_, kDetail);
    primitive["material"] = 0;
    const Vector colour = linear_colour_of(0.6f);
    glb_.document["materials"] = {{{"name", "ball"},
                                   {"pbrMetallicRoughness",
                                    {{"baseColorFactor", {colour[0], colour[1], colour[2], 1}},
                                     {"metallicFactor", 0},
                                     {"roughnessFactor", 0.6}}}}};
    glb_.document["meshes"] = {{{"name", "ball"}, {"primitives", {primitive}}}};
  }

  /// The parent of all balls.
  std::string root_node(std::size_t balls) const {
    std::string out =
        fmt::format("[{{\"name\":\"balls\",\"translation\":[{},{},{}]", middle_[0], middle_[1], middle_[2]);
    for (std::size_t i = 1; i <= balls; ++i) out += fmt::format("{}{}", i == 1 ? ",\"children\":[" : ",", i);
    return out + "]}";
  }

  /// The animation of a ball, and the text of its node in the rest pose.
  std::string add_ball(std::size_t i) {
    const Track track = track_of(record_, i, middle_);
    add_channel(i + 1, "translation", track.centres);
    add_channel(i + 1, "scale", track.sizes);
    // In the digits of doubles, so that programs that read nodes as doubles and as floats get the same numbers.
    const double radius = track.sizes[0][0];
    return fmt::format(",{{\"mesh\":0,\"name\":\"{}\",\"translation\":[{},{},{}],\"scale\":[{},{},{}]}}", i,
                       double{track.centres[0][0]}, double{track.centres[0][1]}, double{track.centres[0][2]}, radius,
                       radius, radius);
  }

  void add_channel(std::size_t node, const char* path, std::span<const Vector> values) {
    const std::size_t output = glb_.add_vectors(values, GltfTarget::kNone, false);
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_}, {"interpolation", "STEP"}, {"output", output}});
  }

  const MotionRecord& record_;
  Point middle_;
  GlbContainer glb_;
  std::size_t times_;
  GltfJson samplers_ = GltfJson::array(), channels_ = GltfJson::array();
};

}  // namespace

Result<std::string> encode_motion_glb(const MotionRecord& record) { return MotionEncoder(record).encode(); }

}  // namespace medial_vk
