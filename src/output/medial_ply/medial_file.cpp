#include "output/medial_ply/medial_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/file_extension.h"
#include "medial_vk/version.h"
#include "output/atomic_files/little_endian.h"

namespace medial_vk {
namespace {

std::string ply_header(const MedialHeader& header, std::size_t points, bool ascii) {
  return fmt::format(
      "ply\n"
      "format {} 1.0\n"
      "{}"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nproperty double radius\n"
      "property float spoke_a_x\nproperty float spoke_a_y\nproperty float spoke_a_z\n"
      "property float spoke_b_x\nproperty float spoke_b_y\nproperty float spoke_b_z\n"
      "property float object_angle\nproperty float flux\nproperty int sheet\n"
      "{}"
      "end_header\n",
      ascii ? "ascii" : "binary_little_endian", ply_comments(header), points,
      header.inside_count ? "property uchar side\n" : "");
}

void append_binary(std::string& out, const MedialSphere& sphere) {
  for (const double x : sphere.centre) append_little_endian(out, x);
  append_little_endian(out, sphere.radius);
  for (const float x : sphere.spoke_a) append_little_endian(out, x);
  for (const float x : sphere.spoke_b) append_little_endian(out, x);
  append_little_endian(out, sphere.object_angle);
  append_little_endian(out, sphere.flux);
  append_little_endian(out, sphere.sheet);
}

/// `side`: the text of its side; null: none.
void append_text(std::string& out, const MedialSphere& sphere, char separator, const char* side) {
  const auto number = [&](double x) { out += fmt::format("{:.17g}{}", x, separator); };
  const auto single = [&](float x) { out += fmt::format("{:.9g}{}", x, separator); };
  for (const double x : sphere.centre) number(x);
  number(sphere.radius);
  for (const float x : sphere.spoke_a) single(x);
  for (const float x : sphere.spoke_b) single(x);
  single(sphere.object_angle);
  single(sphere.flux);
  out += fmt::format("{}", sphere.sheet);
  if (side != nullptr) out += separator + std::string(side);
  out += '\n';
}

}  // namespace

MedialHeader make_header(const VoxelGrid& grid, const ExtractionOptions& options, double longest_side) {
  MedialHeader header;
  header.version = version();
  header.grid_origin = grid.origin;
  header.voxel_size = grid.voxel_size;
  header.epsilon = options.epsilon * grid.voxel_size;
  header.object_angle = options.object_angle;
  header.radius_threshold = options.radius * longest_side;
  return header;
}

Result<MedialFormat> medial_format_of(const std::string& path) {
  const std::string extension = file_extension(path);
  const std::pair<const char*, MedialFormat> known[] = {{".ply", MedialFormat::kPly},
                                                        {".csv", MedialFormat::kCsv},
                                                        {".npz", MedialFormat::kNpz},
                                                        {".json", MedialFormat::kJson},
                                                        {".glb", MedialFormat::kGlb}};
  for (const auto& [name, format] : known) {
    if (extension == name) return format;
  }
  return Error{ErrorCode::kUsage,
               fmt::format("the extension of '{}' is that of no format: use .ply, .csv, .npz, .json or .glb", path)};
}

std::string ply_comments(const MedialHeader& header) {
  // The shortest digits that read back exactly: 0.6 stays 0.6.
  return fmt::format(
      "comment medial-vk {}\n"
      "comment grid_origin {} {} {}\n"
      "comment voxel_size {}\n"
      "comment epsilon {}\n"
      "comment object_angle {}\n"
      "comment radius_threshold {}\n",
      header.version, header.grid_origin[0], header.grid_origin[1], header.grid_origin[2], header.voxel_size,
      header.epsilon, header.object_angle, header.radius_threshold);
}

std::string encode_ply(const MedialHeader& header, std::span<const MedialSphere> spheres, bool ascii) {
  constexpr std::size_t kBytesPerPoint = 4 * sizeof(double) + 8 * sizeof(float) + sizeof(std::int32_t) + 1;
  std::string out = ply_header(header, spheres.size(), ascii);
  if (!ascii) out.reserve(out.size() + spheres.size() * kBytesPerPoint);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const MeshSide side = header.side_of(i);
    if (ascii) {
      append_text(out, spheres[i], ' ', !header.inside_count ? nullptr : side == MeshSide::kInside ? "0" : "1");
    } else {
      append_binary(out, spheres[i]);
      if (header.inside_count) append_little_endian(out, static_cast<std::uint8_t>(side));
    }
  }
  return out;
}

std::string encode_csv(const MedialHeader& header, std::span<const MedialSphere> spheres) {
  std::string out = "x,y,z,radius,spoke_a_x,spoke_a_y,spoke_a_z,spoke_b_x,spoke_b_y,spoke_b_z,object_angle,flux,sheet";
  out += header.inside_count ? ",side\n" : "\n";
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    append_text(out, spheres[i], ',', header.inside_count ? side_name(header.side_of(i)) : nullptr);
  }
  return out;
}

const char* side_name(MeshSide side) { return side == MeshSide::kInside ? "inside" : "outside"; }

}  // namespace medial_vk
