// The reader of animations in glTF, on any bytes: frames of as many finite positions as there are vertices, and a rig
// whose indices exist; or a clear message. Input that is no JSON object and no GLB becomes the buffer of a file that is
// right but for it.
#include <algorithm>
#include <cmath>

#include "fuzz/require.h"
#include "motion_files/mesh_motion.h"

namespace {

/// A skinned triangle whose arrays are in the bytes, which are the only chunk behind the text.
std::string glb_around(std::string buffer) {
  buffer.resize(std::max<std::size_t>(buffer.size(), 256));
  const std::string text =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0},{}],"skins":[{"joints":[0,1],)"
      R"("inverseBindMatrices":4}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},)"
      R"("targets":[{"POSITION":0}]}]}],"animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},)"
      R"({"sampler":1,"target":{"node":0,"path":"weights"}}],"samplers":[{"input":3,"output":2},{"input":3,"output":5,)"
      R"("interpolation":"CUBICSPLINE"}]}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":0,"byteOffset":36,"componentType":5121,"count":3,"type":"VEC4"},)"
      R"({"bufferView":0,"byteOffset":48,"componentType":5126,"count":3,"type":"VEC4"},)"
      R"({"bufferView":0,"byteOffset":96,"componentType":5126,"count":3,"type":"SCALAR"},)"
      R"({"bufferView":0,"byteOffset":108,"componentType":5126,"count":2,"type":"MAT4"},)"
      R"({"bufferView":0,"byteOffset":96,"componentType":5126,"count":9,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":256}],"buffers":[{"byteLength":256}]})";
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
    return bytes;
  };
  const std::string chunks = word(text.size()) + "JSON" + text + word(buffer.size()) + std::string("BIN\0", 4) + buffer;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

void require_frames(const medial_vk::MeshMotion& motion) {
  using namespace medial_vk;
  using fuzz::require;
  const Mesh& rest = motion.rest();
  for (const Triangle& t : rest.triangles) {
    for (const std::uint32_t v : t) require(v < rest.vertices.size(), "faces use existing vertices");
  }
  const MotionRig& rig = *motion.rig();
  require(rig.first_influence.size() == rest.vertices.size() + 1, "every vertex has influences");
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    require(!rig.influences_of(v).empty(), "a vertex follows a joint");
    for (const RigInfluence& influence : rig.influences_of(v)) {
      require(influence.joint < rig.joints.size() && influence.weight > 0, "the joint exists");
    }
  }
  for (const RigJoint& joint : rig.joints) {
    require(joint.parent == RigJoint::kNone || joint.parent < rig.joints.size(), "the joint above exists");
  }
  MotionFrame frame;
  for (std::uint64_t i = 0; i < motion.frame_count(); ++i) {
    if (const Status status = motion.read_frame(i, frame); !status.ok()) {
      fuzz::require_clear(status.error(), ErrorCode::kInvalidMesh);
      continue;
    }
    require(frame.positions.size() == rest.vertices.size(), "a frame has all vertices");
    for (const Point& p : frame.positions) {
      for (const double x : p) require(std::isfinite(x), "positions are finite");
    }
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  std::string bytes(fuzz::as_text(data, size));
  if (!bytes.starts_with("glTF") && !bytes.starts_with("{")) bytes = glb_around(std::move(bytes));
  // The limits are smaller than those of the tool, since the fuzzer counts memory.
  const auto motion = parse_animation(bytes, "input.gltf", "", {.frames = 3, .most_values = 100'000});
  if (motion.ok()) {
    require_frames(*motion.value());
  } else if (motion.error().code != ErrorCode::kUsage) {
    fuzz::require_clear(motion.error(), ErrorCode::kInvalidMesh);
  }
  return 0;
}
