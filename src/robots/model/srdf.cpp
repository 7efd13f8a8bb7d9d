#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "input/text_scanner.h"
#include "robots/model/link_pairs.h"
#include "robots/model/robot_xml.h"

namespace medial_vk {
namespace {

using tinyxml2::XMLElement;

bool is_before(const LinkPair& p, const LinkPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }

}  // namespace

Result<std::vector<LinkPair>> read_srdf(std::string_view bytes, const std::string& name, const Robot& robot) {
  if (bytes.empty()) return file_error(name, "the file is empty");
  tinyxml2::XMLDocument document;
  if (Status status = parse_robot_xml(bytes, name, "SRDF", document); !status) return status.error();
  std::map<std::string_view, std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < robot.links.size(); ++i) numbers.emplace(robot.links[i].name, i);
  std::vector<LinkPair> pairs;
  constexpr const char* kElement = "disable_collisions";
  const XMLElement* e = document.RootElement()->FirstChildElement(kElement);
  for (; e != nullptr; e = e->NextSiblingElement(kElement)) {
    std::uint32_t ends[2] = {};
    const char* const attributes[2] = {"link1", "link2"};
    for (std::size_t i = 0; i < 2; ++i) {
      const char* link = e->Attribute(attributes[i]);
      if (link == nullptr) return element_error(name, *e, fmt::format("a <{}> has no {}", kElement, attributes[i]));
      const auto known = numbers.find(link);
      if (known == numbers.end()) {
        return element_error(name, *e, fmt::format("the robot has no link {}", medial_vk::quoted(link)));
      }
      ends[i] = known->second;
    }
    if (ends[0] == ends[1]) return element_error(name, *e, fmt::format("a <{}> names one link twice", kElement));
    pairs.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
  }
  std::ranges::sort(pairs, is_before);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::string encode_srdf(const Robot& robot, std::span<const ReasonedPairs> left_out) {
  tinyxml2::XMLPrinter printer;
  printer.PushHeader(false, true);
  printer.OpenElement("robot");
  printer.PushAttribute("name", robot.name.c_str());
  for (const ReasonedPairs& of_reason : left_out) {
    for (const LinkPair& pair : of_reason.pairs) {
      printer.OpenElement("disable_collisions");
      printer.PushAttribute("link1", robot.links[pair.a].name.c_str());
      printer.PushAttribute("link2", robot.links[pair.b].name.c_str());
      printer.PushAttribute("reason", of_reason.reason);
      printer.CloseElement();
    }
  }
  printer.CloseElement();
  return printer.CStr();
}

}  // namespace medial_vk
#else
#include "common/absent_parts.h"
#include "input/text_scanner.h"
#include "robots/model/link_pairs.h"

namespace medial_vk {

Result<std::vector<LinkPair>> read_srdf(std::string_view, const std::string& name, const Robot&) {
  return file_error(name, not_read("SRDF", "tinyxml2"));
}

// No build without the library has read a robot.
std::string encode_srdf(const Robot&, std::span<const ReasonedPairs>) { return {}; }

}  // namespace medial_vk
#endif
