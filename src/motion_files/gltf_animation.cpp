#include "motion_files/gltf_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/quoted.h"

namespace medial_vk {
namespace {

using Json = nlohmann::json;

std::string label_of(const GltfDocument& document, std::uint64_t index) {
  const std::string name = text_in(document.item("animations", index), "name");
  return name.empty() ? fmt::format("animation {}", index + 1) : name;
}

class AnimationReader {
 public:
  AnimationReader(const GltfDocument& document, GltfAccessors& accessors, const GltfNodes& nodes,
                  const MovingMesh& mesh, std::uint64_t index)
      : json_(document.item("animations", index)), accessors_(accessors), nodes_(nodes) {
    animation_.label = label_of(document, index);
    for (const MovingMesh::Part& part : mesh.parts()) shapes_of_[part.node] = part.mesh->shapes;
    carry_ = mesh.nodes_that_carry(nodes);
  }

  GltfAnimation read() {
    for (const Json& channel : list_in(json_, "channels")) read_channel(channel);
    if (!moves_) throw GltfFault{fmt::format("the animation {} moves no vertex", medial_vk::quoted(animation_.label))};
    return std::move(animation_);
  }

 private:
  void read_channel(const Json& channel) {
    if (!channel.is_object()) throw GltfFault{"a channel is no object"};
    const Json& target = list_in(channel, "target");
    const std::string path = text_in(target, "path");
    if (path == "pointer") return refuse_pointer(target);
    const std::optional<std::uint64_t> index = whole_number_in(target, "node");
    if (!index) return;  // glTF 2.0, 5.6.1: such a channel is ignored
    const bool has_matrix = nodes_[*index].matrix.has_value();
    const auto node = static_cast<std::uint32_t>(*index);
    if (path == "weights") return read_weights(channel, node);
    if (has_matrix) throw GltfFault{fmt::format("an animation moves node {}, which has a matrix", node)};
    GltfAnimation::Channels& channels = animation_.channels[node];
    std::optional<KeyFrames>* const keys = path == "translation" ? &channels.translation
                                           : path == "rotation"  ? &channels.rotation
                                           : path == "scale"     ? &channels.scale
                                                                 : nullptr;
    if (keys == nullptr)
      throw GltfFault{fmt::format("an animation moves {}, which is not supported", medial_vk::quoted(path))};
    set(*keys, read_keys(channel, path == "rotation" ? 4 : 3, path == "rotation"), carry_[node] != 0);
  }

  void read_weights(const Json& channel, std::uint32_t node) {
    const auto shapes = shapes_of_.find(node);
    if (shapes == shapes_of_.end() || shapes->second == 0) return;  // nothing of it is shown
    set(animation_.channels[node].weights, read_keys(channel, shapes->second, false, true), true);
  }

  /// An extension by which animations reach any property: of materials, which are not read, but of nodes, too.
  static void refuse_pointer(const Json& target) {
    const Json& pointer = list_in(list_in(target, "extensions"), "KHR_animation_pointer");
    const std::string path = text_in(pointer, "pointer");
    if (path.starts_with("/nodes/") || path.starts_with("/meshes/") || path.starts_with("/skins/")) {
      throw GltfFault{
          fmt::format("an animation moves {} by an extension, which is not supported", medial_vk::quoted(path))};
    }
  }

  void set(std::optional<KeyFrames>& property, KeyFrames keys, bool carries) {
    if (property) throw GltfFault{"two channels of an animation move the same"};
    const bool is_first = !has_keys_;
    animation_.start = is_first ? keys.first_time() : std::min(animation_.start, keys.first_time());
    animation_.end = is_first ? keys.last_time() : std::max(animation_.end, keys.last_time());
    has_keys_ = true;
    moves_ = moves_ || (carries && changes(keys));
    property = std::move(keys);
  }

  KeyFrames read_keys(const Json& channel, std::uint64_t width, bool is_rotation, bool are_scalars = false) {
    const Json& samplers = list_in(json_, "samplers");
    const std::uint64_t index = required_number_in(channel, "sampler");
    if (!samplers.is_array() || index >= samplers.size() || !samplers[index].is_object()) {
      throw GltfFault{"a channel has a sampler that is not there"};
    }
    const Json& sampler = samplers[index];
    KeyFrames keys;
    keys.width = width;
    keys.is_rotation = is_rotation;
    keys.interpolation = interpolation_of(text_in(sampler, "interpolation"));
    keys.times = accessors_.read(required_number_in(sampler, "input"), 1);
    // Weights are scalars, as many for each key as there are shapes.
    keys.values = accessors_.read(required_number_in(sampler, "output"), are_scalars ? 1 : width);
    check(keys);
    return keys;
  }

  static Interpolation interpolation_of(const std::string& name) {
    if (name.empty() || name == "LINEAR") return Interpolation::kLinear;
    if (name == "STEP") return Interpolation::kStep;
    if (name == "CUBICSPLINE") return Interpolation::kCubic;
    throw GltfFault{
        fmt::format("an animation has the interpolation {}, which glTF does not have", medial_vk::quoted(name))};
  }

  static void check(const KeyFrames& keys) {
    const std::uint64_t vectors = keys.interpolation == Interpolation::kCubic ? 3 : 1;
    const std::uint64_t values = keys.values.count * keys.values.width;
    if (keys.times.count == 0) throw GltfFault{"a sampler has no keys"};
    if (values / vectors / keys.width != keys.times.count || values % (vectors * keys.width) != 0) {
      throw GltfFault{
          fmt::format("a sampler has {} values for {} keys of {}", values, keys.times.count, vectors * keys.width)};
    }
    const std::vector<double>& times = *keys.times.values;
    if (!std::ranges::is_sorted(times)) throw GltfFault{"the times of a sampler decrease"};
    if (!keys.is_rotation) return;
    for (std::uint64_t key = 0; key < keys.times.count; ++key) {
      const double* q = keys.values[vectors == 3 ? 3 * key + 1 : key];
      if (std::all_of(q, q + 4, [](double x) { return x == 0; })) throw GltfFault{"a key is a rotation of length 0"};
    }
  }

  const Json& json_;
  GltfAccessors& accessors_;
  const GltfNodes& nodes_;
  std::map<std::uint32_t, std::uint64_t> shapes_of_;  // by node that shows faces
  std::vector<std::uint8_t> carry_;                   // by node
  GltfAnimation animation_;
  bool has_keys_ = false, moves_ = false;
};

}  // namespace

void GltfAnimation::apply(double time, std::vector<NodePose>& poses) const {
  for (const auto& [node, moved] : channels) {
    if (moved.translation) evaluate(*moved.translation, time, poses[node].translation.data());
    if (moved.rotation) evaluate(*moved.rotation, time, poses[node].rotation.data());
    if (moved.scale) evaluate(*moved.scale, time, poses[node].scale.data());
  }
}

void GltfAnimation::apply(double time, const MovingMesh::Part& part, std::vector<double>& weights) const {
  weights = part.weights;
  const auto moved = channels.find(part.node);
  if (moved != channels.end() && moved->second.weights) evaluate(*moved->second.weights, time, weights.data());
}

std::string list_of_animations(const GltfDocument& document) {
  constexpr std::uint64_t kMostListed = 20;
  const std::uint64_t count = document.count("animations");
  std::string list;
  for (std::uint64_t i = 0; i < std::min(count, kMostListed); ++i) {
    const std::string name = text_in(document.item("animations", i), "name");
    list += fmt::format("{}{}{}", i == 0 ? "" : ", ", i + 1, name.empty() ? "" : " " + medial_vk::quoted(name));
  }
  return count > kMostListed ? list + fmt::format(" and {} more", count - kMostListed) : list;
}

std::optional<std::uint64_t> find_animation(const GltfDocument& document, const std::string& name_or_number) {
  const std::uint64_t count = document.count("animations");
  if (name_or_number.empty()) return count == 1 ? std::optional<std::uint64_t>(0) : std::nullopt;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (text_in(document.item("animations", i), "name") == name_or_number) return i;
  }
  std::uint64_t number = 0;
  const char* const end = name_or_number.data() + name_or_number.size();
  const auto [read_to, error] = std::from_chars(name_or_number.data(), end, number);
  if (error != std::errc() || read_to != end || number == 0 || number > count) return {};
  return number - 1;
}

GltfAnimation gltf_animation_of(const GltfDocument& document, GltfAccessors& accessors, const GltfNodes& nodes,
                                const MovingMesh& mesh, std::uint64_t index) {
  return AnimationReader(document, accessors, nodes, mesh, index).read();
}

}  // namespace medial_vk
