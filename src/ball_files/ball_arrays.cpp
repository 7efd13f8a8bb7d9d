#include "ball_files/ball_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "ball_files/ball_faults.h"
#include "base/host_memory.h"
#include "input/text_scanner.h"
#include "output/numpy_files/npz_reader.h"

namespace medial_vk {
namespace {

using Json = nlohmann::json;

/// The numbers of an array, if it has this type, and `columns` of them for each of any number of balls.
template <class T>
Result<std::vector<double>> numbers_of(const NpyArray& array, const char* type, std::size_t columns,
                                       const std::string& what) {
  const bool has_columns =
      columns == 1 ? array.shape.size() == 1 : array.shape.size() == 2 && array.shape[1] == columns;
  if (array.type != type || !has_columns) {
    return Error{ErrorCode::kInvalidMesh, fmt::format("{} has another type than {} or another shape", what, type)};
  }
  std::vector<double> out;
  out.reserve(array.bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < array.bytes.size() / sizeof(T); ++i) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), array.bytes.data() + i * sizeof(T), sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    out.push_back(static_cast<double>(std::bit_cast<T>(bytes)));
  }
  return out;
}

Point triple_at(const std::vector<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

bool read_numbers(const Json& object, const char* key, std::span<double> out) {
  const auto found = object.find(key);
  if (found == object.end()) return false;
  if (out.size() == 1 && found->is_number()) {
    out[0] = found->get<double>();
    return true;
  }
  if (!found->is_array() || found->size() != out.size()) return false;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!(*found)[i].is_number()) return false;
    out[i] = (*found)[i].get<double>();
  }
  return true;
}

struct BallOfFile {
  Ball ball;
  SpokePair spokes;
  bool has_spokes = false;
};

Result<BallOfFile> ball_of_object(const Json& object, const std::string& place) {
  BallOfFile out;
  if (!object.is_object() || !read_numbers(object, "centre", out.ball.centre) ||
      !read_numbers(object, "radius", {&out.ball.radius, 1})) {
    return file_error(place, "there must be a centre of three numbers and a radius");
  }
  if (const auto side = object.find("side"); side != object.end() && *side == "outside") return outside_error(place);
  if (!object.contains("spoke_a") && !object.contains("spoke_b")) return out;
  if (!read_numbers(object, "spoke_a", out.spokes.a) || !read_numbers(object, "spoke_b", out.spokes.b)) {
    return file_error(place, "there must be both spoke_a and spoke_b, of three numbers each, or neither");
  }
  out.spokes = {as_written(out.spokes.a), as_written(out.spokes.b)};
  out.has_spokes = true;
  return out;
}

Result<BallsWithSpokes> balls_of_list(const Json& list, const std::string& name) {
  BallsWithSpokes out;
  out.balls.reserve(list.size());
  out.spokes.reserve(list.size());
  for (const Json& object : list) {
    const std::string place = fmt::format("{}: ball {}", name, out.balls.size());
    const Result<BallOfFile> read = ball_of_object(object, place);
    if (!read) return read.error();
    const BallOfFile& ball = read.value();
    if (!out.balls.empty() && ball.has_spokes == out.spokes.empty()) {
      return file_error(place, ball.has_spokes ? "it has spokes, but the balls before have none"
                                               : "it has no spokes, but the balls before have them");
    }
    out.balls.push_back(ball.ball);
    if (ball.has_spokes) out.spokes.push_back(ball.spokes);
  }
  if (Status status = check_all(out, name); !status) return status.error();
  return out;
}

}  // namespace

Result<BallsWithSpokes> balls_of_arrays(std::string_view bytes, const std::string& name) {
  return catch_out_of_memory("reading balls", [&]() -> Result<BallsWithSpokes> {
    const Result<std::map<std::string, NpyArray>> read = read_npz(bytes, name);
    if (!read) return read.error();
    const std::map<std::string, NpyArray>& arrays = read.value();
    if (!arrays.contains("centre") || !arrays.contains("radius")) {
      return file_error(name, "there are no arrays centre and radius");
    }
    const auto centres = numbers_of<double>(arrays.at("centre"), "<f8", 3, "centre");
    if (!centres) return file_error(name, centres.error().message);
    const auto radii = numbers_of<double>(arrays.at("radius"), "<f8", 1, "radius");
    if (!radii) return file_error(name, radii.error().message);
    const std::size_t count = radii.value().size();
    if (centres.value().size() != 3 * count) {
      return file_error(name, fmt::format("radius has {} numbers for {} centres", count, centres.value().size() / 3));
    }
    if (arrays.contains("side")) {
      const auto sides = numbers_of<std::uint8_t>(arrays.at("side"), "|u1", 1, "side");
      if (!sides) return file_error(name, sides.error().message);
      if (std::ranges::any_of(sides.value(), [](double side) { return side != 0; })) return outside_error(name);
    }
    BallsWithSpokes out;
    out.balls.reserve(count);
    for (std::size_t i = 0; i < count; ++i) out.balls.push_back({triple_at(centres.value(), i), radii.value()[i]});
    if (arrays.contains("spoke_a") != arrays.contains("spoke_b")) {
      return file_error(name, "there must be both arrays spoke_a and spoke_b, or neither");
    }
    if (arrays.contains("spoke_a")) {
      const auto a = numbers_of<float>(arrays.at("spoke_a"), "<f4", 3, "spoke_a");
      if (!a) return file_error(name, a.error().message);
      const auto b = numbers_of<float>(arrays.at("spoke_b"), "<f4", 3, "spoke_b");
      if (!b) return file_error(name, b.error().message);
      if (a.value().size() != 3 * count || b.value().size() != 3 * count) {
        return file_error(name, "there must be as many pairs of spokes as balls");
      }
      out.spokes.reserve(count);
      for (std::size_t i = 0; i < count; ++i) out.spokes.push_back({triple_at(a.value(), i), triple_at(b.value(), i)});
    }
    if (Status status = check_all(out, name); !status) return status.error();
    return out;
  });
}

Result<BallsWithSpokes> balls_of_json(std::string_view text, const std::string& name) {
  return catch_out_of_memory("reading balls", [&]() -> Result<BallsWithSpokes> {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return file_error(name, "this is no JSON");
    if (json.is_object() && json.contains("links")) {
      return file_error(name, "the balls are those of the links of a robot, which are several solids");
    }
    for (const char* list : {"points", "spheres", "balls"}) {
      if (json.is_object() && json.contains(list) && json[list].is_array()) return balls_of_list(json[list], name);
    }
    return file_error(name, "there is no list points, spheres or balls");
  });
}

}  // namespace medial_vk
