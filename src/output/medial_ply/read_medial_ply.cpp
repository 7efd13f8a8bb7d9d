// The reader of the medial PLY: for --check, which tests the numbers as written, and for programs that read medial
// files.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "output/medial_ply/medial_file.h"

namespace medial_vk {
namespace {

constexpr std::string_view kProperties[] = {
    "double x",           "double y",        "double z",        "double radius",   "float spoke_a_x",
    "float spoke_a_y",    "float spoke_a_z", "float spoke_b_x", "float spoke_b_y", "float spoke_b_z",
    "float object_angle", "float flux",      "int sheet",       "uchar side"};
constexpr std::size_t kPropertiesWithoutSide = std::size(kProperties) - 1;

/// Takes lines, words and binary numbers from the front of the bytes.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  std::optional<std::string_view> line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }

  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n"), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \n"));
    rest_.remove_prefix(word.size());
    return word;
  }

  template <class T>
  bool text(T& out) {
    const std::string_view digits = word();
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out);
    return error == std::errc() && end == digits.data() + digits.size() && is_finite(out);
  }

  template <class T>
  bool binary(T& out) {
    if (rest_.size() < sizeof(T)) return false;
    char bytes[sizeof(T)];
    std::memcpy(bytes, rest_.data(), sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(std::begin(bytes), std::end(bytes));
    std::memcpy(&out, bytes, sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return is_finite(out);
  }

  bool only_space_left() const { return rest_.find_first_not_of(" \n") == std::string_view::npos; }
  bool at_line_end() const { return rest_.starts_with('\n'); }

 private:
  template <class T>
  static bool is_finite(T number) {
    if constexpr (std::is_floating_point_v<T>) return std::isfinite(number);
    return true;
  }

  std::string_view rest_;
};

struct Layout {
  bool ascii = false;
  std::uint64_t points = 0;
};

/// Every comment of the contract, as a set of bits.
constexpr unsigned kAllComments = 63;

/// Adds the bit of the comment to `seen`.
bool read_comment(Cursor words, MedialHeader& header, unsigned& seen) {
  const std::string_view key = words.word();
  if (key == "medial-vk") {
    seen |= 1;
    header.version = words.word();
    return !header.version.empty();
  }
  if (key == "grid_origin") {
    seen |= 2;
    return std::all_of(header.grid_origin.begin(), header.grid_origin.end(), [&](double& x) { return words.text(x); });
  }
  const std::pair<std::string_view, double*> numbers[] = {{"voxel_size", &header.voxel_size},
                                                          {"epsilon", &header.epsilon},
                                                          {"object_angle", &header.object_angle},
                                                          {"radius_threshold", &header.radius_threshold}};
  unsigned bit = 4;
  for (const auto& [name, number] : numbers) {
    if (key == name) {
      seen |= bit;
      return words.text(*number);
    }
    bit *= 2;
  }
  return true;  // A comment of another program.
}

/// Reads up to and including end_header. False if anything differs from the output of encode_ply().
bool read_header(Cursor& cursor, MedialHeader& header, Layout& layout) {
  if (cursor.line() != "ply") return false;
  const std::optional<std::string_view> format = cursor.line();
  layout.ascii = format == "format ascii 1.0";
  if (!layout.ascii && format != "format binary_little_endian 1.0") return false;
  std::size_t properties = 0;
  unsigned comments = 0;
  while (const std::optional<std::string_view> line = cursor.line()) {
    Cursor words(*line);
    const std::string_view key = words.word();
    if (key == "end_header") {
      if (properties == std::size(kProperties)) header.inside_count = 0;
      return properties >= kPropertiesWithoutSide && comments == kAllComments && header.voxel_size > 0;
    }
    if (key == "comment") {
      if (!read_comment(words, header, comments)) return false;
    } else if (key == "element") {
      if (words.word() != "vertex" || !words.text(layout.points)) return false;
    } else if (key == "property") {
      if (properties == std::size(kProperties) ||
          line->substr(std::min<std::size_t>(9, line->size())) != kProperties[properties])
        return false;
      ++properties;
    } else {
      return false;
    }
  }
  return false;
}

bool read_sphere(Cursor& cursor, bool ascii, MedialSphere& sphere) {
  const auto number = [&](auto& out) { return ascii ? cursor.text(out) : cursor.binary(out); };
  const auto numbers = [&](auto& out) { return number(out[0]) && number(out[1]) && number(out[2]); };
  return numbers(sphere.centre) && number(sphere.radius) && numbers(sphere.spoke_a) && numbers(sphere.spoke_b) &&
         number(sphere.object_angle) && number(sphere.flux) && number(sphere.sheet);
}

/// 0 is inside, 1 outside, and points inside come first. True for points without a side.
bool read_side(Cursor& cursor, bool ascii, std::size_t point, std::optional<std::size_t>& inside_count) {
  if (!inside_count) return true;
  int side = 0;
  std::uint8_t byte = 0;
  if (!(ascii ? cursor.text(side) : cursor.binary(byte))) return false;
  if (!ascii) side = byte;
  if (side == 0 && *inside_count == point) ++*inside_count;
  return side == (point < *inside_count ? 0 : 1);
}

/// Contract: floor((p - grid_origin) / voxel_size). False outside any grid.
bool place_in_voxel(const MedialHeader& header, MedialSphere& sphere) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double voxel = std::floor((sphere.centre[axis] - header.grid_origin[axis]) / header.voxel_size);
    if (!(voxel >= 0 && voxel < 4294967296.0)) return false;
    sphere.voxel[axis] = static_cast<std::uint32_t>(voxel);
  }
  return true;
}

Error invalid(const std::string& name, const std::string& what) {
  return {ErrorCode::kInvalidMesh, fmt::format("{}: {}", name, what)};
}

}  // namespace

Result<MedialFile> decode_ply(std::string_view bytes, const std::string& name) {
  Cursor cursor(bytes);
  MedialFile file;
  Layout layout;
  if (!read_header(cursor, file.header, layout)) return invalid(name, "the header is not that of a medial PLY");
  // The count is not trusted with memory: a point takes at least 26 bytes of text ("0 " thirteen times).
  if (layout.points > bytes.size() / 26) return invalid(name, "fewer points than in the header");
  file.spheres.resize(static_cast<std::size_t>(layout.points));
  for (std::size_t i = 0; i < file.spheres.size(); ++i) {
    const bool is_whole = read_sphere(cursor, layout.ascii, file.spheres[i]) &&
                          read_side(cursor, layout.ascii, i, file.header.inside_count);
    if (!is_whole) return invalid(name, fmt::format("point {} is broken", i));
    if (!place_in_voxel(file.header, file.spheres[i]))
      return invalid(name, fmt::format("point {} is outside the grid", i));
  }
  // Without its line end the last number may have lost digits.
  if (layout.ascii && !file.spheres.empty() && !cursor.at_line_end()) return invalid(name, "the last line is cut");
  if (!cursor.only_space_left()) return invalid(name, "bytes follow the last point");
  return file;
}

}  // namespace medial_vk
