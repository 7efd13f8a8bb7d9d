// Frames of an animation in a glTF file, computed when they are asked for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "base/quoted.h"
#include "input/read_mesh.h"
#include "input/text_scanner.h"
#include "motion_files/gltf_animation.h"
#include "motion_files/mesh_motion.h"
#include "scene_files/scene_formats.h"
#include "scene_files/scene_parts.h"

namespace medial_vk {
namespace {

/// Frames at equal distances in time.
struct FrameTimes {
  double start = 0, end = 0, step = 0;
  std::uint64_t count = 0;

  double operator[](std::uint64_t index) const {
    return count > 1 && index + 1 == count ? std::min(end, start + static_cast<double>(index) * step)
                                           : start + static_cast<double>(index) * step;
  }
};

Result<FrameTimes> frame_times(const AnimationOptions& options, double first_key, double last_key) {
  FrameTimes times = {options.start.value_or(first_key), options.end.value_or(last_key), 0, options.frames};
  const double duration = times.end - times.start;
  if (!std::isfinite(duration) || duration < 0) {
    return Error{ErrorCode::kUsage,
                 fmt::format("the frames would end at {:g} s, before their start at {:g} s", times.end, times.start)};
  }
  if (options.frames > 0) {
    times.step = options.frames > 1 ? duration / static_cast<double>(options.frames - 1) : 0;
  } else {
    const double rate = options.frames_per_second;
    if (!(rate > 0) || !std::isfinite(rate)) {
      return Error{ErrorCode::kUsage, "the number of frames in a second must be positive"};
    }
    // The times of keys are floats: a frame that falls on the last key may come out later by a unit in the last place.
    const double steps =
        std::floor(std::max(std::fabs(times.start), std::fabs(times.end)) * rate * 0x1p-23 + duration * rate);
    if (!(steps < static_cast<double>(kMostFrames))) {
      return Error{ErrorCode::kUsage, fmt::format("the animation would have more than {} frames", kMostFrames)};
    }
    times.step = 1 / rate;
    times.count = static_cast<std::uint64_t>(steps) + 1;
  }
  if (times.count > kMostFrames) {
    return Error{ErrorCode::kUsage, fmt::format("{} frames are more than {}", times.count, kMostFrames)};
  }
  return times;
}

class AnimationMotion : public MeshMotion {
 public:
  AnimationMotion(std::string name, GltfNodes nodes, MovingMesh mesh, GltfAnimation animation, const FrameTimes& times,
                  std::optional<GltfSource> source)
      : name_(std::move(name)),
        nodes_(std::move(nodes)),
        mesh_(std::move(mesh)),
        animation_(std::move(animation)),
        times_(times),
        source_(std::move(source)) {}

  const Mesh& rest() const override { return mesh_.rest(); }
  std::uint64_t frame_count() const override { return times_.count; }
  const MotionRig* rig() const override { return &mesh_.rig(); }
  const GltfSource* source() const override { return source_ ? &*source_ : nullptr; }
  std::uint64_t separable_vertices() const override { return mesh_.separable_vertices(); }

  Status read_frame(std::uint64_t index, MotionFrame& frame) const override {
    try {
      const double time = times_[index];
      std::vector<NodePose> poses = nodes_.rest_poses();
      animation_.apply(time, poses);
      std::vector<AffineMap> places;
      nodes_.find_places(poses, places);
      std::vector<std::vector<double>> weights(mesh_.parts().size());
      for (std::size_t i = 0; i < weights.size(); ++i) animation_.apply(time, mesh_.parts()[i], weights[i]);
      mesh_.place_vertices(places, weights, frame.joints, frame.positions);
      frame.name = fmt::format("{} {:.4f} s", animation_.label, time);
      frame.time = time;
      for (const Point& p : frame.positions) {
        if (std::ranges::all_of(p, [](double x) { return std::isfinite(x); })) continue;
        return file_error(name_, fmt::format("a coordinate is not finite at {:.4f} s of {}", time,
                                             medial_vk::quoted(animation_.label)));
      }
      return {};
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory for a frame", name_)};
    }
  }

 private:
  std::string name_;
  GltfNodes nodes_;
  MovingMesh mesh_;
  GltfAnimation animation_;
  FrameTimes times_;
  std::optional<GltfSource> source_;
};

/// Why no animation was found.
Error no_animation(const GltfDocument& document, const std::string& name, const std::string& choice) {
  if (document.count("animations") == 0) {
    return file_error(name, fmt::format("it has no animation ({} nodes, {} meshes, {} skins)", document.count("nodes"),
                                        document.count("meshes"), document.count("skins")));
  }
  const std::string list = list_of_animations(document);
  if (choice.empty()) {
    return {ErrorCode::kUsage,
            fmt::format("{}: it has several animations, of which one must be chosen: {}", name, list)};
  }
  return {ErrorCode::kUsage,
          fmt::format("{}: it has no animation {}; it has {}", name, medial_vk::quoted(choice), list)};
}

/// How many arrays and objects of a valid JSON text contain each other at most.
std::uint64_t levels_of_json(std::string_view text) {
  std::uint64_t level = 0, deepest = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted && c == '\\') ++i;  // the next character is no end of the string
    if (is_quoted) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++level);
    if (c == ']' || c == '}') --level;
  }
  return deepest;
}

/// For a copy, which is written by recursion.
GltfSource source_to_copy(const GltfDocument& document) {
  if (const std::uint64_t levels = levels_of_json(document.text()); levels > kMostSourceLevels) {
    throw GltfFault{
        fmt::format("its JSON is nested {} levels deep; scenes are copied up to {}", levels, kMostSourceLevels)};
  }
  return {std::string(document.text()), std::string(document.binary())};
}

Result<std::unique_ptr<MeshMotion>> read_animation(std::string bytes, const std::string& name, const std::string& path,
                                                   const AnimationOptions& options) {
  GltfDocument document(std::move(bytes), path);
  const std::optional<std::uint64_t> index = find_animation(document, options.animation);
  if (!index) return no_animation(document, name, options.animation);
  GltfAccessors accessors(document);
  GltfNodes nodes(document);
  MovingMesh mesh(document, accessors, nodes, options.most_values);
  GltfAnimation animation = gltf_animation_of(document, accessors, nodes, mesh, *index);
  const Result<FrameTimes> times = frame_times(options, animation.start, animation.end);
  if (!times) return Error{times.error().code, fmt::format("{}: {}", name, times.error().message)};
  std::optional<GltfSource> source;
  if (options.keep_source) source = source_to_copy(document);
  return std::unique_ptr<MeshMotion>(std::make_unique<AnimationMotion>(
      name, std::move(nodes), std::move(mesh), std::move(animation), times.value(), std::move(source)));
}

}  // namespace

Result<std::unique_ptr<MeshMotion>> parse_animation(std::string bytes, const std::string& name, const std::string& path,
                                                    const AnimationOptions& options) {
  try {
    const std::string format = scene_format_of(bytes, name);
    if (format == "glb" || format == "gltf") return read_animation(std::move(bytes), name, path, options);
    if (format.empty()) {
      return file_error(name,
                        "it has no animation: animations are read from glTF and GLB, other motions from a file "
                        "for each frame");
    }
    return file_error(name, fmt::format("animations are read from glTF and GLB, not from .{}: convert it, for example "
                                        "with Blender, or export a mesh for each frame",
                                        format));
  } catch (const GltfFault& fault) {
    return file_error(name, fault.what);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", name)};
  }
}

Result<std::unique_ptr<MeshMotion>> open_animation(const std::string& path, const AnimationOptions& options) {
  const std::string name = name_of_input(path);
  try {
    Result<std::string> bytes = read_mesh_bytes(path);
    if (!bytes) return bytes.error();
    return parse_animation(std::move(bytes).value(), name, path == "-" ? std::string() : path, options);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", name)};
  }
}

}  // namespace medial_vk
