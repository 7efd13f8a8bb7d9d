// Sphere sets as files for planners of robots, simulators and other programs (docs/formats.md, "Spheres").
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

enum class SphereFormat {
  kCsv,     ///< A line per sphere.
  kJson,    ///< The project's own format, with all data.
  kFoam,    ///< The input of CoMMALab's foam: a list of levels, or its database for a robot.
  kCurobo,  ///< YAML for NVIDIA's cuRobo.
  kXrdf,    ///< YAML for Isaac and cuMotion.
  kUrdf,    ///< The robot with spheres as collision geometry.
};

/// Spheres of one geometry, in the frame of its link.
struct PartSpheres {
  std::string link;
  std::string name;                       ///< File of the mesh, or primitiveI.
  std::vector<std::vector<Ball>> levels;  ///< The smallest first; the same number in all parts, at least one.
  std::vector<ReachOut> reach;            ///< Per level.
};

struct SphereFile {
  std::string version;   ///< Of the program.
  std::string contract;  ///< "inside", "cover" or "balanced".
  std::string method;
  bool is_robot = false;           ///< Otherwise there is one part, and its link is the name of the mesh.
  std::string name;                ///< Of the mesh or robot.
  std::vector<PartSpheres> parts;  ///< Parts of a link are consecutive.
  bool with_levels = false;        ///< All levels are written where the format supports them; else the last.
  std::size_t branch = 1;          ///< Balls requested per part or link, which is foam's name of the set.
  std::string urdf;                ///< kUrdf of a robot: the bytes that were read.
};

/// csv, json, urdf and xrdf by their own extensions, cuRobo by .yml and .yaml; foam has none. Error: kUsage, naming
/// these.
Result<SphereFormat> sphere_format_of(const std::string& path);
/// "csv", "foam" and so on, as in --format.
const char* name_of(SphereFormat format);
/// csv, json and foam.
bool has_levels(SphereFormat format);

/// Numbers have the fewest digits that read back as the same double, so that certified spheres remain certified.
/// Errors: kInternal if the URDF, which was parsed before, cannot be parsed.
Result<std::string> encode_spheres(SphereFormat format, const SphereFile& file);

}  // namespace medial_vk
