#include "output/rig_files/rig_gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "common/tool_errors.h"
#include "output/atomic_files/little_endian.h"
#include "output/page/base64.h"

namespace medial_vk {
namespace {

using SceneJson = nlohmann::ordered_json;

constexpr int kNodeFormat = 1;
constexpr const char* kOurKey = "medial_vk";

/// The unit ball of the node in the frame of its joint: the centre, and a scale. In the scene it is an ellipsoid around
/// the centre of the ball, whose longest semi-axis is the scale times the stretch of the joint in that frame; `stretch`
/// is the greatest of all frames, so that the ellipsoid lies within the ball in each of them.
SceneJson node_of(const RigBall& ball, std::size_t number, const RigJoint& joint, double stretch) {
  const BallJoint& bound = ball.joints.front();
  const double scale = ball.radius / stretch;
  const SceneJson ours = {{"ball", number},
                          {"radius", ball.radius},
                          {"rest_radius", ball.rest_radius},
                          {"reach_out", ball.reach_out},
                          {"joints", {joint.node}},
                          {"weights", {bound.weight}}};
  return {{"name", fmt::format("medial_ball_{}", number)},
          {"translation", bound.place},
          {"scale", {scale, scale, scale}},
          {"extras", {{kOurKey, ours}}}};
}

void add_child(SceneJson& node, std::size_t child) {
  SceneJson children = SceneJson::array();
  if (const auto before = node.find("children"); before != node.end()) {
    for (const SceneJson& other : *before) children.push_back(other);
  }
  children.push_back(child);
  node["children"] = std::move(children);
}

/// What holds for all nodes, unless the scene has remarks of a kind that leaves no room.
void add_remarks(const RigFile& file, std::size_t written, double greatest_reach_out, SceneJson& scene) {
  SceneJson& remarks = scene["extras"];
  if (!remarks.is_null() && !remarks.is_object()) return;
  remarks[kOurKey] = {{"format", kNodeFormat},
                      {"program", "medial-vk"},
                      {"version", file.version},
                      {"mesh", file.name},
                      {"frames", file.balls.frames},
                      {"balls", written},
                      {"greatest_reach_out", greatest_reach_out}};
}

/// The first buffer of a GLB, which has no name, within a text.
void embed_binary(const std::string& binary, SceneJson& scene) {
  const auto buffers = scene.find("buffers");
  if (binary.empty() || buffers == scene.end() || buffers->empty()) return;
  SceneJson& first = buffers->front();
  if (!first.is_object() || first.contains("uri")) return;
  std::string uri = "data:application/octet-stream;base64,";
  page::append_base64(uri, {reinterpret_cast<const std::uint8_t*>(binary.data()), binary.size()});
  first["uri"] = std::move(uri);
}

void append_glb_chunk(std::string& out, std::string_view type, std::string_view bytes, char filler) {
  const std::size_t more = (4 - bytes.size() % 4) % 4;
  append_little_endian(out, static_cast<std::uint32_t>(bytes.size() + more));
  out += type;
  out += bytes;
  out.append(more, filler);
}

Result<std::string> glb_of(const std::string& json, const std::string& binary) {
  std::string chunks;
  constexpr std::uint64_t kHeaders = 12 + 8 + 3 + 8 + 3;  // with the most filler
  if (std::uint64_t{json.size()} + binary.size() + kHeaders > UINT32_MAX) {
    return Error{kCannotWrite, fmt::format("--rig: a .glb of {} MiB is larger than the format allows; use .gltf",
                                           (json.size() + binary.size()) >> 20)};
  }
  append_glb_chunk(chunks, "JSON", json, ' ');
  if (!binary.empty()) append_glb_chunk(chunks, std::string_view("BIN\0", 4), binary, '\0');
  std::string out = "glTF";
  append_little_endian(out, std::uint32_t{2});
  append_little_endian(out, static_cast<std::uint32_t>(12 + chunks.size()));
  return out + chunks;
}

}  // namespace

bool names_other_files(const GltfSource& source) {
  const SceneJson scene = SceneJson::parse(source.json);
  for (const char* const list : {"buffers", "images"}) {
    const auto parts = scene.find(list);
    if (parts == scene.end()) continue;
    for (const SceneJson& part : *parts) {
      const auto uri = part.find("uri");
      if (uri != part.end() && uri->is_string() && !uri->get_ref<const std::string&>().starts_with("data:"))
        return true;
    }
  }
  return false;
}

Result<std::string> encode_rig_gltf(const RigFile& file, const GltfSource& source, bool is_glb) {
  SceneJson scene = SceneJson::parse(source.json);
  SceneJson& nodes = scene["nodes"];
  std::size_t written = 0;
  double greatest_reach_out = 0;
  for (std::size_t i = 0; i < file.balls.balls.size(); ++i) {
    const RigBall& ball = file.balls.balls[i];
    if (!(ball.radius > 0)) continue;
    const std::uint32_t number = ball.joints.front().joint;
    const RigJoint& joint = file.rig.joints[number];
    add_child(nodes[joint.node], nodes.size());
    nodes.push_back(node_of(ball, i, joint, file.balls.joint_stretches[number]));
    greatest_reach_out = std::max(greatest_reach_out, ball.reach_out);
    ++written;
  }
  add_remarks(file, written, greatest_reach_out, scene);
  // The name of the mesh, that of a file, may hold any bytes.
  constexpr auto kReplace = SceneJson::error_handler_t::replace;
  if (is_glb) return glb_of(scene.dump(-1, ' ', false, kReplace), source.binary);
  embed_binary(source.binary, scene);
  return scene.dump(1, ' ', false, kReplace) + "\n";
}

}  // namespace medial_vk
