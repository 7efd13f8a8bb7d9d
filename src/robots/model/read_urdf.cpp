#include "robots/model/read_urdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <utility>

#include "input/text_scanner.h"
#include "platform/paths.h"
#if defined(MEDIAL_VK_HAS_XML)
#include "robots/model/joint_motions.h"
#include "robots/model/robot_xml.h"
#else
#include "common/absent_parts.h"
#endif

namespace medial_vk {
#if defined(MEDIAL_VK_HAS_XML)
namespace {

using tinyxml2::XMLElement;

/// Reads one URDF; the first fault ends it.
class UrdfReader {
 public:
  UrdfReader(const std::string& name, UrdfDetail detail) : name_(name), detail_(detail) {}

  Result<Robot> read(std::string_view bytes) {
    tinyxml2::XMLDocument document;
    if (Status status = parse_robot_xml(bytes, name_, "URDF", document); !status) return status.error();
    const XMLElement* root = document.RootElement();
    if (const char* name = root->Attribute("name")) robot_.name = name;
    if (Status status = read_links(*root); !status) return status.error();
    if (Status status = read_joints(*root); !status) return status.error();
    if (Status status = check_forest(); !status) return status.error();
    return std::move(robot_);
  }

 private:
  Error at(const XMLElement& element, std::string_view what) const { return element_error(name_, element, what); }

  Status read_links(const XMLElement& root) {
    for (const XMLElement* e = root.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
      const char* name = e->Attribute("name");
      if (name == nullptr || *name == 0) return at(*e, "a <link> has no name");
      Link link;
      link.name = name;
      if (!numbers_.emplace(link.name, static_cast<std::uint32_t>(robot_.links.size())).second) {
        return at(*e, fmt::format("there is another link {}", medial_vk::quoted(link.name)));
      }
      if (Status status = read_geometries(*e, "collision", link.collision); !status) return status;
      if (Status status = read_geometries(*e, "visual", link.visual); !status) return status;
      robot_.links.push_back(std::move(link));
    }
    if (robot_.links.empty()) return file_error(name_, "the robot has no <link>");
    return {};
  }

  Status read_geometries(const XMLElement& link, const char* kind, std::vector<Geometry>& geometries) {
    for (const XMLElement* e = link.FirstChildElement(kind); e != nullptr; e = e->NextSiblingElement(kind)) {
      Geometry geometry;
      geometry.line = e->GetLineNum();
      if (Status status = read_origin(*e, geometry.origin); !status) return status;
      const XMLElement* shapes = e->FirstChildElement("geometry");
      if (shapes == nullptr) return at(*e, fmt::format("a <{}> has no <geometry>", kind));
      const XMLElement* shape = shapes->FirstChildElement();
      if (shape == nullptr) return at(*shapes, "a <geometry> is empty");
      if (Status status = read_shape(*shape, geometry); !status) return status;
      geometries.push_back(std::move(geometry));
    }
    return {};
  }

  Status read_shape(const XMLElement& shape, Geometry& geometry) {
    const std::string_view kind = shape.Name();
    if (kind == "mesh") return read_mesh_shape(shape, geometry);
    if (kind == "box") {
      geometry.kind = GeometryKind::kBox;
      if (shape.Attribute("size") == nullptr) return at(shape, "a <box> has no size");
      if (Status status = read_triple(shape, "size", geometry.size); !status) return status;
      return check_positive(shape, "size", geometry.size, 3);
    }
    geometry.kind = kind == "cylinder"  ? GeometryKind::kCylinder
                    : kind == "sphere"  ? GeometryKind::kSphere
                    : kind == "capsule" ? GeometryKind::kCapsule
                                        : GeometryKind::kMesh;
    if (geometry.kind == GeometryKind::kMesh) {
      return at(shape, fmt::format("the geometry {} is unknown; there are mesh, box, cylinder, sphere and capsule",
                                   medial_vk::quoted(kind)));
    }
    if (Status status = read_length(shape, "radius", geometry.size[0]); !status) return status;
    if (geometry.kind == GeometryKind::kSphere) return {};
    return read_length(shape, "length", geometry.size[1]);
  }

  Status read_mesh_shape(const XMLElement& shape, Geometry& geometry) {
    const char* file = shape.Attribute("filename");
    if (file == nullptr || *file == 0) return at(shape, "a <mesh> has no filename");
    geometry.mesh = file;
    if (Status status = read_triple(shape, "scale", geometry.scale); !status) return status;
    if (std::ranges::count(geometry.scale, 0.0) > 0) return at(shape, "a scale of 0 leaves no solid of a mesh");
    return {};
  }

  Status read_length(const XMLElement& element, const char* attribute, double& length) {
    const char* text = element.Attribute(attribute);
    if (text == nullptr) return at(element, fmt::format("a <{}> has no {}", element.Name(), attribute));
    Point numbers = {0, 0, 0};
    if (Status status = read_numbers(name_, element, attribute, text, std::span(numbers).first(1)); !status)
      return status;
    length = numbers[0];
    return check_positive(element, attribute, numbers, 1);
  }

  Status check_positive(const XMLElement& element, const char* attribute, const Point& numbers, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      // Outside this range, squares and cubes leave the range of a double.
      if (numbers[i] >= 1e-50 && numbers[i] <= 1e50) continue;
      const char* why = numbers[i] > 0 ? "not between 1e-50 and 1e50" : "not above zero";
      return at(element, fmt::format("the {} of a <{}> is {}: {}", attribute, element.Name(), why, numbers[i]));
    }
    return {};
  }

  Status read_origin(const XMLElement& parent, Pose& pose) {
    const XMLElement* origin = parent.FirstChildElement("origin");
    if (origin == nullptr) return {};
    Point xyz = {0, 0, 0}, rpy = {0, 0, 0};
    if (Status status = read_triple(*origin, "xyz", xyz); !status) return status;
    if (Status status = read_triple(*origin, "rpy", rpy); !status) return status;
    pose = make_pose(xyz, rpy);
    return {};
  }

  /// Leaves `numbers` unchanged if the attribute is missing.
  Status read_triple(const XMLElement& element, const char* attribute, Point& numbers) {
    const char* text = element.Attribute(attribute);
    return text == nullptr ? Status() : read_numbers(name_, element, attribute, text, numbers);
  }

  Status read_joints(const XMLElement& root) {
    for (const XMLElement* e = root.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint")) {
      Joint joint;
      if (const char* name = e->Attribute("name")) joint.name = name;
      if (Status status = read_end(*e, "parent", joint.parent); !status) return status;
      if (Status status = read_end(*e, "child", joint.child); !status) return status;
      if (Status status = read_origin(*e, joint.origin); !status) return status;
      robot_.joints.push_back(std::move(joint));
    }
    return detail_ == UrdfDetail::kMotion ? read_motions(root, name_, robot_.joints) : Status();
  }

  Status read_end(const XMLElement& joint, const char* end, std::uint32_t& link) {
    const XMLElement* element = joint.FirstChildElement(end);
    const char* name = element == nullptr ? nullptr : element->Attribute("link");
    if (name == nullptr) return at(joint, fmt::format("a <joint> has no <{} link=...>", end));
    const auto known = numbers_.find(name);
    if (known == numbers_.end()) {
      return at(*element,
                fmt::format("the {} of a joint is the link {}, which is not there", end, medial_vk::quoted(name)));
    }
    link = known->second;
    return {};
  }

  Status check_forest() const {
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> parent(robot_.links.size(), kNone);
    for (const Joint& joint : robot_.joints) {
      if (parent[joint.child] != kNone) {
        return file_error(name_, fmt::format("the link {} is the child of two joints",
                                             medial_vk::quoted(robot_.links[joint.child].name)));
      }
      parent[joint.child] = joint.parent;
    }
    // Visits every link once: marks distinguish the walks.
    std::vector<std::uint32_t> seen(robot_.links.size(), kNone);
    for (std::uint32_t link = 0; link < robot_.links.size(); ++link) {
      std::uint32_t at = link;
      for (; at != kNone && seen[at] == kNone; at = parent[at]) seen[at] = link;
      if (at != kNone && seen[at] == link) {
        return file_error(name_, fmt::format("joints lead from the link {} back to itself",
                                             medial_vk::quoted(robot_.links[at].name)));
      }
    }
    return {};
  }

  const std::string& name_;
  UrdfDetail detail_;
  Robot robot_;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;  // of links, by name
};

}  // namespace

Result<Robot> read_urdf(std::string_view bytes, const std::string& name, UrdfDetail detail) {
  if (bytes.empty()) return file_error(name, "the file is empty");
  return UrdfReader(name, detail).read(bytes);
}

#else
Result<Robot> read_urdf(std::string_view, const std::string& name, UrdfDetail) {
  return file_error(name, not_read("URDF", "tinyxml2"));
}
#endif

Result<std::string> read_urdf_bytes(const std::string& path) {
  errno = 0;
  std::ifstream file(platform::path_of(path), std::ios::binary);
  const auto cannot_read = [&] {
    return file_error(path, fmt::format("cannot be read: {}", std::strerror(errno == 0 ? EIO : errno)));
  };
  if (!file) return cannot_read();
  std::string bytes;
  char part[1 << 16];
  while (file.read(part, sizeof part) || file.gcount() > 0) {
    bytes.append(part, static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > kMostUrdfBytes) return file_error(path, "this is no URDF: it is larger than 64 MiB");
  }
  if (file.bad()) return cannot_read();
  return bytes;
}

Result<Robot> read_urdf_file(const std::string& path, UrdfDetail detail) {
  const Result<std::string> bytes = read_urdf_bytes(path);
  if (!bytes) return bytes.error();
  return read_urdf(bytes.value(), path, detail);
}

}  // namespace medial_vk
