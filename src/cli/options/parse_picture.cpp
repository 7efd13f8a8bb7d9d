#include "cli/options/parse_picture.h"

#include <fmt/format.h>

#include <utility>

#include "cli/options/parse_number.h"

namespace medial_vk::cli {
namespace {

using Direction = std::array<double, 3>;

constexpr std::pair<const char*, Direction> kViews[] = {
    {"front", {0, 0, 1}}, {"back", {0, 0, -1}},   {"left", {-1, 0, 0}}, {"right", {1, 0, 0}},
    {"top", {0, 1, 0}},   {"bottom", {0, -1, 0}}, {"iso", {1, 1, 1}},
};

Error unknown_view(const std::string& text) {
  std::string known;
  for (const auto& [name, direction] : kViews) known += std::string(name) + ", ";
  return {ErrorCode::kUsage,
          fmt::format("'{}' is no direction; use {}or three numbers x,y,z that are not all 0", text, known)};
}

}  // namespace

Result<ViewChoice> parse_view(const std::string& text) {
  for (const auto& [name, direction] : kViews) {
    if (text == name) return ViewChoice{direction, true};
  }
  Direction direction = {0, 0, 0};
  std::size_t begin = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',', begin);
    if ((comma == std::string::npos) != (axis == 2)) return unknown_view(text);
    const Result<double> number = parse_real(text.substr(begin, comma - begin), {-1e6, 1e6}, "");
    if (!number) return unknown_view(text);
    direction[axis] = number.value();
    begin = comma + 1;
  }
  const double square = direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  // A shorter direction would be lost in rounding.
  if (square < 1e-12) return unknown_view(text);
  return ViewChoice{direction, false};
}

PictureView view_of(const ViewChoice& choice, UpAxis up) {
  return {choice.is_side ? in_mesh_axes(choice.direction, up) : choice.direction, up};
}

Result<UpAxis> parse_up(const std::string& text) {
  for (const UpAxis up : {UpAxis::kX, UpAxis::kY, UpAxis::kZ, UpAxis::kMinusX, UpAxis::kMinusY, UpAxis::kMinusZ}) {
    if (text == axis_name(up)) return up;
  }
  return Error{ErrorCode::kUsage, fmt::format("'{}' is no axis; use x, y, z, -x, -y or -z", text)};
}

Result<std::array<std::uint32_t, 2>> parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  const std::array<std::string, 2> sides = {text.substr(0, cross),
                                            cross == std::string::npos ? text : text.substr(cross + 1)};
  std::array<std::uint32_t, 2> size = {0, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    const Result<std::uint64_t> side = parse_whole(sides[i], kLeastPictureSide, kGreatestPictureSide, " pixels");
    if (!side) {
      return Error{ErrorCode::kUsage, fmt::format("'{}' is no size; use WIDTHxHEIGHT or one number for both, {} to {} "
                                                  "pixels each",
                                                  text, kLeastPictureSide, kGreatestPictureSide)};
    }
    size[i] = static_cast<std::uint32_t>(side.value());
  }
  return size;
}

}  // namespace medial_vk::cli
