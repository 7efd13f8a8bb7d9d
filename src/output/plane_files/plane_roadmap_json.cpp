// The roadmap between sites in the plane.
#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/plane_files/plane_files.h"

namespace medial_vk {

std::string encode_plane_roadmap_json(const PlaneRecord& record) {
  using RoadmapJson = nlohmann::ordered_json;
  const PlaneRoadmap& roadmap = *record.roadmap;
  RoadmapJson json = {{"version", version()},
                      {"sites", record.sites},
                      {"assumptions", record.assumptions},
                      {"epsilon", record.axis.epsilon},
                      {"components", roadmap.components()}};
  if (record.path_was_sought) {
    json["path"] = nullptr;
    if (record.path) {
      json["path"] = {{"width", record.path->width}, {"length", record.path->length}, {"line", record.path->line}};
    }
  }
  json["nodes"] = RoadmapJson::array();
  for (std::size_t i = 0; i < record.axis.nodes.size(); ++i) {
    const AxisNode& node = record.axis.nodes[i];
    json["nodes"].push_back(
        {{"point", node.point}, {"radius", node.radius}, {"component", roadmap.component_of_node()[i]}});
  }
  json["links"] = RoadmapJson::array();
  for (const PlaneRoadmapLink& link : roadmap.links()) {
    json["links"].push_back({{"nodes", record.axis.arcs[link.arc].nodes},
                             {"arc", link.arc},
                             {"length", link.length},
                             {"width", link.width}});
  }
  return json.dump(2, ' ', false, RoadmapJson::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk
