// The solid of the example.
#pragma once

#include <medial_vk/medial_vk.h>

#include <string>

namespace tumbling {

/// Vertices and faces of a Wavefront OBJ. Error: kInvalidMesh.
medial_vk::Result<medial_vk::Mesh> read_obj(const std::string& file);

/// With balls inside the solid and balls that cover it, `count` each.
medial_vk::Result<medial_vk::Body> body_of(const medial_vk::Mesh& mesh, std::size_t count);

double longest_side(const medial_vk::Mesh& mesh);

}  // namespace tumbling
