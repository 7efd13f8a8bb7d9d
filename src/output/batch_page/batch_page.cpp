#include "output/batch_page/batch_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>
#include <system_error>

#include "output/page/page_parts.h"

namespace medial_vk {
namespace {

constexpr const char* kPageStyle =
    "body{font:14px/1.45 system-ui,sans-serif;color:#222;margin:28px auto;padding:0 20px;max-width:1500px}"
    "h1{font-size:22px;margin:0 0 4px}p{margin:0 0 18px;color:#555}"
    "main{display:grid;gap:16px;grid-template-columns:repeat(auto-fill,minmax(240px,1fr))}"
    "article{border:1px solid #e2e5ea;border-radius:8px;overflow:hidden;content-visibility:auto;"
    "contain-intrinsic-size:auto 330px}"
    "img{width:100%;aspect-ratio:4/3;object-fit:contain;background:#fff;display:block}"
    "h2{font-size:14px;margin:8px 12px 4px;overflow-wrap:anywhere}a{color:inherit}"
    "dl{display:grid;grid-template-columns:auto 1fr;gap:0 12px;margin:0 12px 10px;color:#444}"
    "dd{margin:0;text-align:right;font-variant-numeric:tabular-nums}"
    ".failed{border-color:#d55e00}.failed p{margin:0 12px 10px;color:#b34700;overflow-wrap:anywhere}";

constexpr struct {
  BatchColumn column;
  const char* label;
} kShownNumbers[] = {
    {BatchColumn::kTriangles, "triangles"}, {BatchColumn::kPoints, "medial points"},
    {BatchColumn::kSheets, "sheets"},       {BatchColumn::kGreatestRadius, "greatest radius"},
    {BatchColumn::kVolume, "volume"},       {BatchColumn::kBallsVolume, "volume of the balls"},
};

/// In an attribute with double quotes.
std::string in_attribute(std::string_view text) {
  std::string out;
  for (const char c : page::text_in_html(text)) out += c == '"' ? std::string("&quot;") : std::string(1, c);
  return out;
}

/// A relative path as a URL: every byte but the plain ones by its code.
std::string url_of(std::string_view path) {
  std::string out = "./";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain =
        byte < 128 && (std::isalnum(byte) != 0 || std::string_view("/._-").find(c) != std::string_view::npos);
    out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return out;
}

/// A number of the table with six digits; any other text as it is.
std::string short_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = text.find_first_not_of("0123456789") == std::string::npos;
  if (is_whole || error != std::errc() || end != text.data() + text.size()) return page::text_in_html(text);
  return fmt::format("{:.6g}", number);
}

std::string card_html(const BatchCard& card) {
  const BatchRow& row = *card.row;
  const std::string name = page::text_in_html(row[BatchColumn::kName]);
  std::string html = row.is_done() ? "<article>" : "<article class=\"failed\">";
  if (!card.picture.empty()) {
    html += fmt::format("<img loading=\"lazy\" alt=\"{}\" src=\"{}\">", in_attribute(row[BatchColumn::kName]),
                        url_of(card.picture));
  }
  html += card.points.empty() ? fmt::format("<h2>{}</h2>", name)
                              : fmt::format("<h2><a href=\"{}\">{}</a></h2>", url_of(card.points), name);
  if (!row.is_done()) html += fmt::format("<p>{}</p>", page::text_in_html(row[BatchColumn::kError]));
  std::string numbers;
  for (const auto& [column, label] : kShownNumbers) {
    if (!row[column].empty()) numbers += fmt::format("<dt>{}</dt><dd>{}</dd>", label, short_number(row[column]));
  }
  if (!numbers.empty()) html += "<dl>" + numbers + "</dl>";
  return html + "</article>\n";
}

}  // namespace

std::string encode_batch_page(std::span<const BatchCard> cards) {
  const auto failed = std::ranges::count_if(cards, [](const BatchCard& card) { return !card.row->is_done(); });
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; "
      "style-src 'unsafe-inline'\">\n<title>medial-vk batch</title>\n<style>{}</style>\n"
      "<h1>medial-vk batch</h1>\n<p>{} meshes, {} failed</p>\n<main>\n",
      kPageStyle, cards.size(), failed);
  for (const bool is_done : {false, true}) {
    for (const BatchCard& card : cards) {
      if (card.row->is_done() == is_done) html += card_html(card);
    }
  }
  return html + "</main>\n</html>\n";
}

}  // namespace medial_vk
