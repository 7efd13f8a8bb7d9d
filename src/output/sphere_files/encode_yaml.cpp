// YAML, written by hand: cuRobo and XRDF.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "output/sphere_files/encoders.h"
#include "output/sphere_files/float_text.h"

namespace medial_vk {
namespace {

/// Links with the spheres of all their parts, in the frame of the link.
std::string links_yaml(const SphereFile& file, int indent) {
  std::string out;
  const std::string* last = nullptr;
  for (const PartSpheres& part : file.parts) {
    if (last == nullptr || *last != part.link) out += fmt::format("{:{}}{}:\n", "", indent, yaml_word(part.link));
    last = &part.link;
    for (const Ball& ball : part.levels.back()) {
      out += fmt::format("{0:{1}}- center: [{2}, {3}, {4}]\n{0:{1}}  radius: {5}\n", "", indent + 2,
                         float_text(ball.centre[0]), float_text(ball.centre[1]), float_text(ball.centre[2]),
                         float_text(ball.radius));
    }
  }
  return out;
}

std::string link_names(const SphereFile& file) {
  std::vector<std::string> names;
  for (const PartSpheres& part : file.parts) {
    if (names.empty() || names.back() != yaml_word(part.link)) names.push_back(yaml_word(part.link));
  }
  return fmt::format("[{}]", fmt::join(names, ", "));
}

std::string title(const SphereFile& file) {
  return fmt::format("# Spheres by medial-vk {}: contract {}, method {}; link frames, units of the input.\n",
                     file.version, file.contract, file.method);
}

}  // namespace

// The file works in both forms that cuRobo supports: as the file named by `collision_spheres: FILE` of a robot's
// configuration, which has the list under the key of that name, and as the part of such a configuration, by an alias.
std::string encode_spheres_curobo(const SphereFile& file) {
  return title(file) + "collision_spheres: &collision_spheres\n" + links_yaml(file, 2) +
         "robot_cfg:\n  kinematics:\n    format_version: 2.0\n    collision_link_names: " + link_names(file) +
         "\n    collision_sphere_buffer: 0.0\n    collision_spheres: *collision_spheres\n";
}

std::string encode_spheres_xrdf(const SphereFile& file) {
  constexpr std::string_view kName = "medial_vk_spheres";
  return title(file) + fmt::format(
                           "format: xrdf\nformat_version: 1.0\ngeometry:\n  {0}:\n    spheres:\n{1}"
                           "collision:\n  geometry: {0}\nself_collision:\n  geometry: {0}\n",
                           kName, links_yaml(file, 6));
}

}  // namespace medial_vk
