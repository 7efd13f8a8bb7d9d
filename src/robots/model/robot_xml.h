// What the readers of URDF and SRDF share: XML whose outermost element is <robot>.
#pragma once

#include <tinyxml2.h>

#include <span>
#include <string>
#include <string_view>

#include "medial_vk/result.h"
#include "xml_files/xml_document.h"

namespace medial_vk {

/// `format` is "URDF" or "SRDF", for messages. Afterwards, `document` has a root. Errors: kInvalidMesh, with the line.
Status parse_robot_xml(std::string_view bytes, const std::string& name, const char* format,
                       tinyxml2::XMLDocument& document);

/// Reads `text`, the value of an attribute, as so many finite numbers. Error: kInvalidMesh.
Status read_numbers(const std::string& name, const tinyxml2::XMLElement& element, const char* attribute,
                    std::string_view text, std::span<double> numbers);

}  // namespace medial_vk
