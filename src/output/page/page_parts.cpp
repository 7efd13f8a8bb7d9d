#include "output/page/page_parts.h"

#include <nlohmann/json.hpp>

#include "output/page/base64.h"

namespace medial_vk::page {
namespace {

constexpr std::string_view kTitleMark = "<!--medial-vk: title-->";
constexpr std::string_view kDataMark = "<!--medial-vk: data-->";

}  // namespace

void Block::write(std::string& page) const {
  page.append("<script type=\"text/plain\" id=\"data-").append(name_).append("\">");
  append_base64(page, bytes_);
  page.append("</script>\n");
}

void write_json(std::string& page, std::string_view name, std::string_view json) {
  page.append("<script type=\"application/json\" id=\"").append(name).append("\">");
  for (const char c : json) {
    if (c == '<') {
      page.append("\\u003c");
    } else {
      page += c;
    }
  }
  page.append("</script>\n");
}

std::string text_in_html(std::string_view text) {
  using Json = nlohmann::ordered_json;
  // Printed as JSON and parsed: text that is not UTF-8 is replaced, as everywhere in the report.
  const Json valid = Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
  std::string out;
  for (const char c : valid.get_ref<const std::string&>()) {
    switch (c) {
      case '<':
        out.append("&lt;");
        break;
      case '&':
        out.append("&amp;");
        break;
      default:
        out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return out;
}

Template split(std::string_view page) {
  const std::size_t title = page.find(kTitleMark), data = page.find(kDataMark);
  const std::size_t after_title = title + kTitleMark.size();
  return {page.substr(0, title), page.substr(after_title, data - after_title), page.substr(data + kDataMark.size())};
}

}  // namespace medial_vk::page
