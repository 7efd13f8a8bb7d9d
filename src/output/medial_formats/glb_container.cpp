#include "output/medial_formats/glb_container.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/tool_errors.h"
#include "output/atomic_files/little_endian.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/icosphere.h"

namespace medial_vk {
namespace {

/// Chunks and the data of accessors begin at multiples of this.
constexpr std::size_t kAlignment = 4;

void pad(std::string& bytes, char filler) {
  bytes.append((kAlignment - bytes.size() % kAlignment) % kAlignment, filler);
}

void append_chunk(std::string& out, std::string_view type, std::string_view bytes) {
  append_little_endian(out, static_cast<std::uint32_t>(bytes.size()));
  out += type;
  out += bytes;
}

std::array<GltfJson, 2> bounds_of(std::span<const std::array<float, 3>> vectors) {
  std::array<float, 3> least = vectors[0], greatest = vectors[0];
  for (const std::array<float, 3>& v : vectors) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], v[axis]);
      greatest[axis] = std::max(greatest[axis], v[axis]);
    }
  }
  return {GltfJson(least), GltfJson(greatest)};
}

}  // namespace

std::size_t GlbContainer::add_accessor(std::size_t begin, GltfTarget target, GltfJson accessor) {
  GltfJson view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", buffer_.size() - begin}};
  if (target != GltfTarget::kNone) view["target"] = target;
  accessor["bufferView"] = views_.size();
  views_.push_back(std::move(view));
  accessors_.push_back(std::move(accessor));
  pad(buffer_, '\0');
  return accessors_.size() - 1;
}

std::size_t GlbContainer::add_vectors(std::span<const std::array<float, 3>> vectors, GltfTarget target, bool bounds) {
  const std::size_t begin = buffer_.size();
  for (const std::array<float, 3>& v : vectors) {
    for (const float x : v) append_little_endian(buffer_, x);
  }
  GltfJson accessor = {{"componentType", GltfComponent::kFloat}, {"count", vectors.size()}, {"type", "VEC3"}};
  if (bounds) {
    const auto [least, greatest] = bounds_of(vectors);
    accessor["min"] = least;
    accessor["max"] = greatest;
  }
  return add_accessor(begin, target, std::move(accessor));
}

std::size_t GlbContainer::add_indices(std::span<const std::uint32_t> indices, GltfComponent component) {
  const std::size_t begin = buffer_.size();
  for (const std::uint32_t index : indices) {
    if (component == GltfComponent::kUnsignedShort) {
      append_little_endian(buffer_, static_cast<std::uint16_t>(index));
    } else {
      append_little_endian(buffer_, index);
    }
  }
  return add_accessor(begin, GltfTarget::kIndices,
                      {{"componentType", component}, {"count", indices.size()}, {"type", "SCALAR"}});
}

std::size_t GlbContainer::add_numbers(std::span<const float> numbers) {
  const std::size_t begin = buffer_.size();
  for (const float number : numbers) append_little_endian(buffer_, number);
  return add_accessor(begin, GltfTarget::kVertices,
                      {{"componentType", GltfComponent::kFloat}, {"count", numbers.size()}, {"type", "SCALAR"}});
}

std::size_t GlbContainer::add_times(std::span<const float> times) {
  const std::size_t begin = buffer_.size();
  for (const float time : times) append_little_endian(buffer_, time);
  return add_accessor(begin, GltfTarget::kNone,
                      {{"componentType", GltfComponent::kFloat},
                       {"count", times.size()},
                       {"type", "SCALAR"},
                       {"min", {times.front()}},
                       {"max", {times.back()}}});
}

std::size_t GlbContainer::add_colours(std::span<const std::array<std::uint16_t, 4>> colours) {
  const std::size_t begin = buffer_.size();
  for (const std::array<std::uint16_t, 4>& colour : colours) {
    for (const std::uint16_t part : colour) append_little_endian(buffer_, part);
  }
  return add_accessor(begin, GltfTarget::kVertices,
                      {{"componentType", GltfComponent::kUnsignedShort},
                       {"normalized", true},
                       {"count", colours.size()},
                       {"type", "VEC4"}});
}

std::string GlbContainer::text_of_document(const std::string& nodes, const std::string& uri) {
  if (!buffer_.empty()) {  // glTF has no empty arrays
    document["accessors"] = accessors_;
    document["bufferViews"] = views_;
    document["buffers"] = {{{"byteLength", buffer_.size()}}};
    if (!uri.empty()) document["buffers"][0]["uri"] = uri;
  }
  // Names may come from files, in any bytes.
  std::string json = document.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
  json.pop_back();
  return json + fmt::format(",\"nodes\":{}}}", nodes);
}

std::string GlbContainer::finish_as_text(const std::string& nodes,
                                         const std::function<std::string(std::string_view)>& base64) {
  return text_of_document(nodes, "data:application/octet-stream;base64," + base64(buffer_)) + "\n";
}

Result<std::string> GlbContainer::finish(const std::string& nodes) {
  std::string json = text_of_document(nodes, {});
  pad(json, ' ');
  const std::uint64_t length =
      12 + 8 + json.size() + (buffer_.empty() ? 0 : 8 + static_cast<std::uint64_t>(buffer_.size()));
  if (length > UINT32_MAX) {
    return Error{kCannotWrite,
                 fmt::format("a .glb of {} MiB is larger than the format allows; use a lower --resolution, or .npz",
                             length >> 20)};
  }
  std::string out = "glTF";
  out.reserve(length);
  append_little_endian(out, std::uint32_t{2});
  append_little_endian(out, static_cast<std::uint32_t>(length));
  append_chunk(out, "JSON", json);
  if (!buffer_.empty()) append_chunk(out, std::string_view("BIN\0", 4), buffer_);
  return out;
}

// The normal at a point of the unit sphere is the point itself.
GltfJson add_unit_ball(GlbContainer& glb, std::uint32_t detail) {
  const Icosphere unit = make_icosphere(detail);
  std::vector<std::array<float, 3>> vertices;
  for (const Point& v : unit.vertices) vertices.push_back({shortened(v[0]), shortened(v[1]), shortened(v[2])});
  const std::size_t points = glb.add_vectors(vertices, GltfTarget::kVertices, true);
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : unit.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return {{"attributes", {{"POSITION", points}, {"NORMAL", points}}},
          {"indices", glb.add_indices(corners, GltfComponent::kUnsignedShort)}};
}

}  // namespace medial_vk
