// XML of files that nobody vouches for, within limits, and errors with the lines of elements.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <string_view>

#include "medial_vk/result.h"

namespace medial_vk {

/// `format`, such as "URDF", is used in messages; `root` is the name of the outermost element, with any prefix of a
/// namespace. Afterwards, `document` has a root. Errors: kInvalidMesh, with the line.
Status parse_xml(std::string_view bytes, const std::string& name, const char* format, const char* root,
                 tinyxml2::XMLDocument& document);

/// The name of an element without the prefix of its namespace.
std::string_view local_name(const tinyxml2::XMLElement& element);

/// kInvalidMesh, with the line of the element.
Error element_error(const std::string& name, const tinyxml2::XMLElement& element, std::string_view what);

}  // namespace medial_vk
