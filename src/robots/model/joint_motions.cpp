#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "robots/model/joint_motions.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "input/text_scanner.h"
#include "robots/model/robot_xml.h"

namespace medial_vk {
namespace {

using tinyxml2::XMLElement;

constexpr std::pair<std::string_view, JointKind> kKinds[] = {{"fixed", JointKind::kFixed},
                                                             {"revolute", JointKind::kRevolute},
                                                             {"continuous", JointKind::kContinuous},
                                                             {"prismatic", JointKind::kPrismatic}};

class MotionReader {
 public:
  MotionReader(const std::string& name, std::vector<Joint>& joints) : name_(name), joints_(joints) {}

  Status read(const XMLElement& root) {
    std::uint32_t index = 0;
    for (const XMLElement* e = root.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint")) {
      if (Status status = read_joint(*e, index++); !status) return status;
    }
    index = 0;
    for (const XMLElement* e = root.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint")) {
      Joint& joint = joints_[index++];
      const XMLElement* mimic = e->FirstChildElement("mimic");
      if (mimic == nullptr || joint.kind == JointKind::kFixed) continue;
      if (Status status = read_mimic(*mimic, joint); !status) return status;
    }
    return check_mimics();
  }

 private:
  Error at(const XMLElement& element, std::string_view what) const { return element_error(name_, element, what); }

  Status read_joint(const XMLElement& element, std::uint32_t index) {
    Joint& joint = joints_[index];
    const char* type = element.Attribute("type");
    if (type == nullptr) return at(element, "a <joint> has no type");
    const auto* kind = std::begin(kKinds);
    while (kind != std::end(kKinds) && kind->first != type) ++kind;
    if (kind == std::end(kKinds)) {
      return at(element, fmt::format("the type {} of a joint is unknown; fixed, revolute, continuous and prismatic "
                                     "joints can be moved",
                                     medial_vk::quoted(type)));
    }
    joint.kind = kind->second;
    if (joint.kind == JointKind::kFixed) return {};
    if (joint.name.empty()) return at(element, "a <joint> that moves has no name");
    if (!numbers_.emplace(joint.name, index).second) {
      return at(element, fmt::format("there is another joint {}", medial_vk::quoted(joint.name)));
    }
    if (Status status = read_axis(element, joint); !status) return status;
    return joint.kind == JointKind::kContinuous ? Status() : read_limits(element, joint);
  }

  Status read_axis(const XMLElement& element, Joint& joint) {
    const XMLElement* axis = element.FirstChildElement("axis");
    if (axis == nullptr) return {};
    const char* text = axis->Attribute("xyz");
    if (text == nullptr) return at(*axis, "an <axis> has no xyz");
    if (Status status = read_numbers(name_, *axis, "xyz", text, joint.axis); !status) return status;
    const double length = std::hypot(joint.axis[0], joint.axis[1], joint.axis[2]);
    // Outside this range, squares and quotients leave the range of a double.
    if (!(length >= 1e-50 && length <= 1e50)) {
      return at(*axis, fmt::format("the length of an <axis> is not between 1e-50 and 1e50: {}", length));
    }
    for (double& coordinate : joint.axis) coordinate /= length;
    return {};
  }

  /// Leaves `number` unchanged if the attribute is missing.
  Status read_number(const XMLElement& element, const char* attribute, double& number) {
    const char* text = element.Attribute(attribute);
    return text == nullptr ? Status() : read_numbers(name_, element, attribute, text, {&number, 1});
  }

  Status read_limits(const XMLElement& element, Joint& joint) {
    const XMLElement* limit = element.FirstChildElement("limit");
    const char* kind = joint.kind == JointKind::kRevolute ? "revolute" : "prismatic";
    if (limit == nullptr) return at(element, fmt::format("a {} joint has no <limit>", kind));
    joint.lower = joint.upper = 0;  // the defaults of URDF
    if (Status status = read_number(*limit, "lower", joint.lower); !status) return status;
    if (Status status = read_number(*limit, "upper", joint.upper); !status) return status;
    if (joint.lower <= joint.upper) return {};
    return at(*limit,
              fmt::format("the lower limit {} of a joint is above the upper one, {}", joint.lower, joint.upper));
  }

  Status read_mimic(const XMLElement& element, Joint& joint) {
    const char* other = element.Attribute("joint");
    if (other == nullptr) return at(element, "a <mimic> names no joint");
    const auto known = numbers_.find(other);
    if (known == numbers_.end()) {
      return at(element,
                fmt::format("a joint mimics {}, which is not there or does not move", medial_vk::quoted(other)));
    }
    Mimic mimic;
    mimic.joint = known->second;
    if (Status status = read_number(element, "multiplier", mimic.multiplier); !status) return status;
    if (Status status = read_number(element, "offset", mimic.offset); !status) return status;
    joint.mimic = mimic;
    return {};
  }

  /// Visits every joint once: marks distinguish the walks.
  Status check_mimics() const {
    std::vector<std::size_t> seen(joints_.size(), joints_.size());
    for (std::size_t first = 0; first < joints_.size(); ++first) {
      std::size_t at = first;
      while (joints_[at].mimic && seen[at] == joints_.size()) {
        seen[at] = first;
        at = joints_[at].mimic->joint;
      }
      if (joints_[at].mimic && seen[at] == first) {
        return file_error(name_, fmt::format("the joint {} mimics itself, by way of others or directly",
                                             medial_vk::quoted(joints_[at].name)));
      }
    }
    return {};
  }

  const std::string& name_;
  std::vector<Joint>& joints_;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;  // of joints that move, by name
};

}  // namespace

Status read_motions(const XMLElement& root, const std::string& name, std::vector<Joint>& joints) {
  return MotionReader(name, joints).read(root);
}

}  // namespace medial_vk
#endif
