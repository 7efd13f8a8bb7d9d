#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "xml_files/xml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "input/text_scanner.h"

namespace medial_vk {
namespace {

/// The parser compares each attribute with those before it. Elements of a URDF have six at most, those of an SVG some
/// thirty.
constexpr std::size_t kMostAttributes = 1000;

/// The end of the construct that begins at `from`, or the end of the bytes.
std::size_t after(std::string_view bytes, std::string_view end, std::size_t from) {
  const std::size_t found = bytes.find(end, from);
  return found == std::string_view::npos ? bytes.size() : found + end.size();
}

/// True if a tag has more than kMostAttributes values in quotes; comments and the like are skipped as by the parser.
bool has_too_many_attributes(std::string_view bytes) {
  for (std::size_t i = bytes.find('<'); i < bytes.size(); i = bytes.find('<', i)) {
    const std::string_view rest = bytes.substr(i);
    if (rest.starts_with("<!--")) {
      i = after(bytes, "-->", i + 4);
    } else if (rest.starts_with("<![CDATA[")) {
      i = after(bytes, "]]>", i);
    } else if (rest.starts_with("<?")) {
      i = after(bytes, "?>", i);
    } else if (rest.starts_with("<!")) {
      i = after(bytes, ">", i);
    } else {
      std::size_t attributes = 0;
      for (++i; i < bytes.size() && bytes[i] != '>'; ++i) {
        if (bytes[i] != '"' && bytes[i] != '\'') continue;
        if (++attributes > kMostAttributes) return true;
        i = after(bytes, bytes.substr(i, 1), i + 1) - 1;
      }
    }
  }
  return false;
}

std::uint64_t line_of(int line) { return static_cast<std::uint64_t>(std::max(line, 0)); }

Error no_xml(const tinyxml2::XMLDocument& document, const std::string& name, const char* format) {
  // "XML_ERROR_MISMATCHED_ELEMENT": words of the library, never of the file.
  std::string words = document.ErrorName();
  if (words.starts_with("XML_")) words.erase(0, 4);
  if (words.starts_with("ERROR_")) words.erase(0, 6);
  const std::uint64_t line = line_of(document.ErrorLineNum());
  if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
    return line_error(name, line, fmt::format("this is no {}: its elements are nested too deeply", format));
  }
  for (char& c : words) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return line_error(name, line, fmt::format("this is no well-formed XML: {}", words));
}

}  // namespace

Status parse_xml(std::string_view bytes, const std::string& name, const char* format, const char* root,
                 tinyxml2::XMLDocument& document) {
  if (has_too_many_attributes(bytes)) {
    return file_error(name,
                      fmt::format("this is no {}: an element has more than {} attributes", format, kMostAttributes));
  }
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) return no_xml(document, name, format);
  const tinyxml2::XMLElement* outermost = document.RootElement();
  if (outermost != nullptr && local_name(*outermost) == root) return {};
  return file_error(name, fmt::format("this is no {}: its outermost element is not <{}>", format, root));
}

std::string_view local_name(const tinyxml2::XMLElement& element) {
  const std::string_view name = element.Name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

Error element_error(const std::string& name, const tinyxml2::XMLElement& element, std::string_view what) {
  return line_error(name, line_of(element.GetLineNum()), what);
}

}  // namespace medial_vk
#endif
