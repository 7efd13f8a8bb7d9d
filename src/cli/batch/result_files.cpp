#include "cli/batch/result_files.h"

#include <algorithm>
#include <cctype>

#include "cli/options/output_names.h"
#include "platform/files.h"

namespace medial_vk::cli {
namespace {

std::vector<std::string_view> words_between_blanks(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

/// A word for the kind of file, and the extension: ".medial.ply".
bool is_ending(std::string_view word) {
  const auto is_plain = [](unsigned char c) { return c == '.' || std::isalnum(c) != 0; };
  return word.starts_with('.') && std::ranges::count(word, '.') == 2 && std::ranges::all_of(word, is_plain);
}

}  // namespace

std::string endings_of(const Options& options, std::string_view stem) {
  std::string endings;
  for (const NamedOutput& output : outputs_of(options)) {
    if (output.file->empty()) continue;
    if (!endings.empty()) endings += ' ';
    endings += std::string_view(*output.file).substr(stem.size());
  }
  return endings;
}

std::string endings_of_both(const std::string& first, const std::string& second) {
  const std::vector<std::string_view> known = words_between_blanks(first);
  std::string both = first;
  for (const std::string_view word : words_between_blanks(second)) {
    if (std::ranges::find(known, word) != known.end()) continue;
    if (!both.empty()) both += ' ';
    both += word;
  }
  return both;
}

std::vector<std::string> paths_of_results(const std::string& stem, std::string_view endings) {
  std::vector<std::string> paths;
  for (const std::string_view word : words_between_blanks(endings)) {
    if (is_ending(word)) paths.push_back(stem + std::string(word));
  }
  return paths;
}

void remove_results(const std::string& stem, std::string_view endings) {
  for (const std::string& path : paths_of_results(stem, endings)) platform::remove_file(path);
}

}  // namespace medial_vk::cli
