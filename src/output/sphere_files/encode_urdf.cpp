// A robot whose collision geometry is spheres: the URDF of the input, with the <collision> of each link replaced.
#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include <fmt/format.h>
#include <tinyxml2.h>

#include "output/sphere_files/encoders.h"

namespace medial_vk {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

void remove_collisions(XMLElement& link) {
  while (XMLElement* collision = link.FirstChildElement("collision")) link.DeleteChild(collision);
}

/// One element per sphere, geometry first, in the order of foam.
void add_sphere(XMLElement& link, const Ball& ball) {
  XMLElement* collision = link.InsertNewChildElement("collision");
  XMLElement* sphere = collision->InsertNewChildElement("geometry")->InsertNewChildElement("sphere");
  sphere->SetAttribute("radius", fmt::format("{}", ball.radius).c_str());
  XMLElement* origin = collision->InsertNewChildElement("origin");
  origin->SetAttribute("xyz", fmt::format("{} {} {}", ball.centre[0], ball.centre[1], ball.centre[2]).c_str());
  origin->SetAttribute("rpy", "0 0 0");
}

XMLElement* find_link(XMLElement& robot, const std::string& name) {
  for (XMLElement* e = robot.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
    const char* known = e->Attribute("name");
    if (known != nullptr && name == known) return e;
  }
  return nullptr;
}

/// A single mesh becomes a robot of one link.
void make_robot(const SphereFile& file, XMLDocument& document) {
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* robot = document.NewElement("robot");
  robot->SetAttribute("name", file.name.c_str());
  document.InsertEndChild(robot);
  for (const PartSpheres& part : file.parts)
    robot->InsertNewChildElement("link")->SetAttribute("name", part.link.c_str());
}

}  // namespace

Result<std::string> encode_spheres_urdf(const SphereFile& file) {
  const Error lost = {ErrorCode::kInternal, "the URDF that was read cannot be read again"};
  XMLDocument document;
  if (!file.is_robot) {
    make_robot(file, document);
  } else if (document.Parse(file.urdf.data(), file.urdf.size()) != tinyxml2::XML_SUCCESS) {
    return lost;
  }
  XMLElement* robot = document.RootElement();
  if (robot == nullptr) return lost;
  for (XMLElement* e = robot->FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
    remove_collisions(*e);
  }
  for (const PartSpheres& part : file.parts) {
    XMLElement* link = find_link(*robot, part.link);
    if (link == nullptr) return lost;
    for (const Ball& ball : part.levels.back()) add_sphere(*link, ball);
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return std::string(printer.CStr());
}

}  // namespace medial_vk
#else
#include "common/absent_parts.h"
#include "output/sphere_files/encoders.h"

namespace medial_vk {

Result<std::string> encode_spheres_urdf(const SphereFile&) {
  return Error{ErrorCode::kUsage, not_written(".urdf", "tinyxml2")};
}

}  // namespace medial_vk
#endif
