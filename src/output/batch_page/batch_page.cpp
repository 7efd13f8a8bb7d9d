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
    "section{display:grid;gap:16px;margin-bottom:16px;grid-template-columns:repeat(auto-fill,minmax(240px,1fr));"
    "align-items:start}"
    "article{border:1px solid #e2e5ea;border-radius:8px;overflow:hidden;content-visibility:auto;"
    "contain-intrinsic-size:auto 330px}"
    "img{width:100%;aspect-ratio:4/3;object-fit:contain;background:#fff;display:block}"
    "h2{font-size:14px;margin:8px 12px 4px;overflow-wrap:anywhere}a{color:inherit}"
    "dl{margin:0 12px 10px;color:#444}dl div{display:flex;justify-content:space-between;gap:0 12px}"
    "dd{margin:0;text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}"
    "nav{display:flex;flex-wrap:wrap;gap:0 12px;margin:0 12px 10px;font-size:13px}"
    ".failed{border-color:#d55e00}.failed p{margin:0 12px 10px;color:#b34700;overflow-wrap:anywhere}";

constexpr struct {
  BatchColumn column;
  const char* label;
} kShownNumbers[] = {
    {BatchColumn::kTriangles, "triangles"}, {BatchColumn::kPoints, "medial points"},
    {BatchColumn::kSheets, "sheets"},       {BatchColumn::kGreatestRadius, "greatest radius"},
    {BatchColumn::kVolume, "volume"},       {BatchColumn::kBallsVolume, "volume of the balls"},
};

/// With the option `demand`, intervals are those of the demanded diameter where that is less.
constexpr struct {
  BatchColumn lower, upper;
  const char* label;
  const char* demand;
} kShownIntervals[] = {
    {BatchColumn::kLeastWallLower, BatchColumn::kLeastWallUpper, "least wall", "--min-wall"},
    {BatchColumn::kLeastGapLower, BatchColumn::kLeastGapUpper, "least gap", "--min-gap"},
    {BatchColumn::kThicknessLower, BatchColumn::kThicknessUpper, "median thickness", nullptr},
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

void add_number(std::string_view label, const std::string& number, std::string& html) {
  html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", label, number);
}

std::string numbers_html(const BatchRow& row) {
  std::string html;
  for (const auto& [column, label] : kShownNumbers) {
    if (!row[column].empty()) add_number(label, short_number(row[column]), html);
  }
  for (const auto& [lower, upper, label, demand] : kShownIntervals) {
    if (row[lower].empty()) continue;
    const std::string least = short_number(row[lower]), most = short_number(row[upper]);
    const bool has_demand = demand != nullptr && row[BatchColumn::kOptions].find(demand) != std::string::npos;
    add_number(has_demand ? fmt::format("{}, or demand", label) : label,
               least == most ? least : fmt::format("{} to {}", least, most), html);
  }
  const std::string& undecided = row[BatchColumn::kUndecided];
  if (!undecided.empty() && undecided != "0") add_number("undecided voxels", short_number(undecided), html);
  return html.empty() ? html : "<dl>" + html + "</dl>";
}

/// Each with what its name has behind that of the mesh.
std::string files_html(const BatchCard& card) {
  std::string html;
  for (const std::string& file : card.files) {
    const std::string_view ending = std::string_view(file).substr((*card.row)[BatchColumn::kName].size() + 1);
    html += fmt::format("<a href=\"{}\">{}</a> ", url_of(file), page::text_in_html(ending));
  }
  return html.empty() ? html : "<nav>" + html + "</nav>";
}

std::string card_html(const BatchCard& card) {
  const BatchRow& row = *card.row;
  std::string html = row.is_done() ? "<article>" : "<article class=\"failed\">";
  if (!card.picture.empty()) {
    html += fmt::format("<a href=\"{0}\"><img loading=\"lazy\" alt=\"{1}\" src=\"{0}\"></a>", url_of(card.picture),
                        in_attribute(row[BatchColumn::kName]));
  }
  html += fmt::format("<h2>{}</h2>", page::text_in_html(row[BatchColumn::kName]));
  if (!row.is_done()) html += fmt::format("<p>{}</p>", page::text_in_html(row[BatchColumn::kError]));
  return html + numbers_html(row) + files_html(card) + "</article>\n";
}

}  // namespace

std::string encode_batch_page(std::span<const BatchCard> cards, const std::string& table) {
  const auto failed = std::ranges::count_if(cards, [](const BatchCard& card) { return !card.row->is_done(); });
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; "
      "style-src 'unsafe-inline'\">\n<title>medial-vk batch</title>\n<style>{}</style>\n"
      "<h1>medial-vk batch</h1>\n<p>{} {}, {} failed. All numbers, with lengths in the units of each mesh: "
      "<a href=\"{}\">{}</a></p>\n",
      kPageStyle, cards.size(), cards.size() == 1 ? "mesh" : "meshes", failed, url_of(table),
      page::text_in_html(table));
  for (const bool is_done : {false, true}) {
    html += "<section>\n";
    for (const BatchCard& card : cards) {
      if (card.row->is_done() == is_done) html += card_html(card);
    }
    html += "</section>\n";
  }
  return html + "</html>\n";
}

}  // namespace medial_vk
