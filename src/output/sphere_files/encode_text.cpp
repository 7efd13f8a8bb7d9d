// CSV and JSON: the project's own, and that of foam.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/csv_cell.h"
#include "output/sphere_files/encoders.h"
#include "output/sphere_files/float_text.h"

namespace medial_vk {
namespace {

/// The number of the layout, raised when a key changes its meaning.
constexpr int kSpheresFormat = 1;

std::size_t levels_of(const SphereFile& file) { return file.parts.empty() ? 0 : file.parts.front().levels.size(); }

void append_sphere(std::string& out, const char* centre, const Ball& ball) {
  out += fmt::format("{{\"{}\": [{}, {}, {}], \"radius\": {}}}", centre, float_text(ball.centre[0]),
                     float_text(ball.centre[1]), float_text(ball.centre[2]), float_text(ball.radius));
}

/// A list with one line per sphere.
std::string sphere_list(const std::vector<const Ball*>& balls, const char* centre, int indent) {
  std::string out = "[";
  for (const Ball* ball : balls) {
    out += fmt::format("{}\n{:{}}", ball == balls.front() ? "" : ",", "", indent + 2);
    append_sphere(out, centre, *ball);
  }
  return out + (balls.empty() ? "]" : fmt::format("\n{:{}}]", "", indent));
}

std::vector<const Ball*> balls_of(const PartSpheres& part, std::size_t level) {
  std::vector<const Ball*> balls;
  for (const Ball& ball : part.levels[level]) balls.push_back(&ball);
  return balls;
}

/// `"spheres": [...]` of a mesh, or `"links": {...}` of a robot, in which all parts of a link form one list.
std::string set_json(const SphereFile& file, std::size_t level, int indent) {
  if (!file.is_robot) return "\"spheres\": " + sphere_list(balls_of(file.parts.front(), level), "centre", indent);
  std::string out = "\"links\": {";
  for (std::size_t i = 0; i < file.parts.size();) {
    std::vector<const Ball*> balls;
    const std::size_t first = i;
    for (; i < file.parts.size() && file.parts[i].link == file.parts[first].link; ++i) {
      const std::vector<const Ball*> more = balls_of(file.parts[i], level);
      balls.insert(balls.end(), more.begin(), more.end());
    }
    out += fmt::format("{}\n{:{}}{}: {}", first == 0 ? "" : ",", "", indent + 2, json_text(file.parts[first].link),
                       sphere_list(balls, "centre", indent + 2));
  }
  return out + fmt::format("\n{:{}}}}", "", indent);
}

std::size_t spheres_in(const SphereFile& file, std::size_t level) {
  std::size_t count = 0;
  for (const PartSpheres& part : file.parts) count += part.levels[level].size();
  return count;
}

/// One entry of foam: the distances by which balls of the level reach out, and the balls.
std::string foam_level(const PartSpheres& part, std::size_t level, int indent) {
  const std::vector<const Ball*> balls = balls_of(part, level);
  const ReachOut& reach = part.reach[level];
  std::string text =
      fmt::format("{{\n{0:{1}}\"mean\": {2},\n{0:{1}}\"best\": {3},\n{0:{1}}\"worst\": {4},\n{0:{1}}\"spheres\": ", "",
                  indent + 4, float_text(reach.mean), float_text(reach.least), float_text(reach.greatest));
  text += sphere_list(balls, "origin", indent + 4);
  return text + fmt::format("\n{:{}}}}", "", indent);
}

std::vector<std::size_t> wanted_levels(const SphereFile& file) {
  std::vector<std::size_t> levels;
  for (std::size_t i = file.with_levels ? 0 : levels_of(file) - 1; i < levels_of(file); ++i) levels.push_back(i);
  return levels;
}

std::string foam_list(const SphereFile& file) {
  std::string out = "[";
  for (const std::size_t level : wanted_levels(file)) {
    out += fmt::format("{}\n    {}", out == "[" ? "" : ",", foam_level(file.parts.front(), level, 4));
  }
  return out + "\n]\n";
}

ReachOut joined(const ReachOut& a, std::size_t count_a, const ReachOut& b, std::size_t count_b) {
  const double x = static_cast<double>(count_a), y = static_cast<double>(count_b);
  return {(x * a.mean + y * b.mean) / std::max(x + y, 1.0), std::min(a.least, b.least),
          std::max(a.greatest, b.greatest)};
}

/// foam addresses a set by part, branching and depth. A set of N balls is the children of a root with N of them: "N",
/// "1".
std::string foam_database(const SphereFile& file) {
  std::string out = "{";
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < file.parts.size(); ++i) {
    const std::string key = file.parts[i].link + "::" + file.parts[i].name;
    if (std::ranges::find(seen, key) != seen.end()) continue;
    seen.push_back(key);
    // A mesh that occurs twice in a link has one name, and all spheres are in the frame of the link.
    PartSpheres all = file.parts[i];
    for (std::size_t j = i + 1; j < file.parts.size(); ++j) {
      if (file.parts[j].link + "::" + file.parts[j].name != key) continue;
      for (std::size_t level = 0; level < all.levels.size(); ++level) {
        const std::vector<Ball>& more = file.parts[j].levels[level];
        all.reach[level] = joined(all.reach[level], all.levels[level].size(), file.parts[j].reach[level], more.size());
        all.levels[level].insert(all.levels[level].end(), more.begin(), more.end());
      }
    }
    out += fmt::format("{}\n    {}: {{", out == "{" ? "" : ",", json_text(key));
    const std::vector<std::size_t> levels = wanted_levels(file);
    std::vector<std::string> entries;
    for (const std::size_t level : levels) {
      const std::size_t branch = file.branch >> (levels_of(file) - 1 - level);
      if (branch == 0 && level + 1 < levels_of(file)) continue;
      entries.push_back(fmt::format("\n        \"{}\": {{\n            \"1\": {}\n        }}",
                                    std::max<std::size_t>(branch, 1), foam_level(all, level, 12)));
    }
    out += fmt::format("{}\n    }}", fmt::join(entries, ","));
  }
  return out + "\n}\n";
}

}  // namespace

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string encode_spheres_csv(const SphereFile& file) {
  std::string out = fmt::format("{}x,y,z,radius{}\n", file.is_robot ? "link," : "", file.with_levels ? ",level" : "");
  for (const std::size_t level : wanted_levels(file)) {
    for (const PartSpheres& part : file.parts) {
      for (const Ball& ball : part.levels[level]) {
        if (file.is_robot) out += csv_cell(part.link) + ",";
        out += fmt::format("{},{},{},{}", ball.centre[0], ball.centre[1], ball.centre[2], ball.radius);
        out += file.with_levels ? fmt::format(",{}\n", level) : "\n";
      }
    }
  }
  return out;
}

std::string encode_spheres_json(const SphereFile& file) {
  const std::size_t last = levels_of(file) - 1;
  std::string out = fmt::format(
      "{{\n  \"format\": {},\n  \"program\": \"medial-vk\",\n  \"version\": {},\n  \"{}\": {},\n  \"contract\": {},\n"
      "  \"method\": {},\n  \"num_spheres\": {},\n  {}",
      kSpheresFormat, json_text(file.version), file.is_robot ? "robot" : "mesh", json_text(file.name),
      json_text(file.contract), json_text(file.method), spheres_in(file, last), set_json(file, last, 2));
  if (file.with_levels) {
    out += ",\n  \"levels\": [";
    for (std::size_t level = 0; level <= last; ++level) {
      out += fmt::format("{}\n    {{\"num_spheres\": {}, {}}}", level == 0 ? "" : ",", spheres_in(file, level),
                         set_json(file, level, 4));
    }
    out += "\n  ]";
  }
  return out + "\n}\n";
}

std::string encode_spheres_foam(const SphereFile& file) {
  return file.is_robot ? foam_database(file) : foam_list(file);
}

}  // namespace medial_vk
