#include "cli/options/declarations.h"

#include <algorithm>
#include <numeric>

#include "cli/options/output_names.h"

namespace medial_vk::cli {
namespace {

/// The number of insertions, deletions and replacements that turn one word into the other, at most `limit`.
std::size_t edit_distance(const std::string& a, const std::string& b, std::size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    std::size_t least = row[0];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
      least = std::min(least, row[j + 1]);
    }
    if (least >= limit) return limit;  // the least value never decreases from row to row
  }
  return std::min(row.back(), limit);
}

/// "; did you mean --resolution?" if there is an option close to the unknown one, else nothing.
std::string suggestion(const CLI::App& app, const std::string& unknown) {
  const std::string name = unknown.substr(0, unknown.find('='));
  std::string best;
  std::size_t best_distance = 4;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& known : option->get_lnames()) {
      const std::string full = "--" + known;
      const std::size_t distance = edit_distance(name, full, best_distance);
      if (distance < best_distance) {
        best_distance = distance;
        best = known;
      }
    }
  }
  return best.empty() ? "" : fmt::format("; did you mean --{}?", best);
}

Status check_extras(const CLI::App& app, const char* one_only) {
  std::vector<std::string> extras = app.remaining();
  std::erase(extras, "--");  // CLI11 counts the mark as an extra.
  for (const std::string& extra : extras) {
    if (extra.size() > 1 && extra[0] == '-') {
      return usage_error(fmt::format("unknown option {}{}", extra, suggestion(app, extra)));
    }
  }
  if (!extras.empty()) return usage_error(fmt::format("unexpected '{}': {}", extras[0], one_only));
  return {};
}

}  // namespace

Status parse_arguments(CLI::App& app, std::vector<std::string> arguments, const char* one_only) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 expects them in reverse order.
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::Error& error) {
    // A misspelt option is the likelier cause of any other error.
    if (Status extras = check_extras(app, one_only); !extras) return extras;
    return usage_error(error.what());
  }
  return check_extras(app, one_only);
}

Status check_view_files(const std::string& picture, const std::string& html) {
  if (!may_end_in(picture, ".png")) return usage_error(fmt::format("--picture: '{}' does not end in .png", picture));
  if (!may_end_in(html, ".html")) return usage_error(fmt::format("--html: '{}' does not end in .html", html));
  return {};
}

Status take_view(const ViewChoice& choice, bool is_drawn, PictureView& view) {
  if (!is_drawn && (choice != ViewChoice() || view.up != PictureView().up)) {
    return usage_error("--view and --up are about the picture: use them with --picture FILE.png or --html FILE.html");
  }
  view = view_of(choice, view.up);
  return {};
}

Status check_row(std::size_t row, const std::string& picture, const std::string& html) {
  if (row == 0 || !picture.empty() || !html.empty()) return {};
  return usage_error("--row chooses what the picture shows: use it with --picture FILE.png or --html FILE.html");
}

}  // namespace medial_vk::cli
