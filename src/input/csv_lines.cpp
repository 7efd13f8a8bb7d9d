#include "input/csv_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "input/text_scanner.h"
#include "platform/files.h"

namespace medial_vk {
namespace {

std::string_view without_blanks(std::string_view word) {
  const std::size_t first = word.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return word.substr(first, word.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

CsvLines::CsvLines(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool CsvLines::next() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = without_blanks(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (!line_.empty()) return true;
  }
  return false;
}

std::vector<std::string_view> csv_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    words.push_back(without_blanks(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return words;
    begin = comma + 1;
  }
}

Result<std::string> read_table(const std::string& path) {
  const bool is_stream = path == "-";
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(is_stream ? nullptr : platform::open_to_read(path),
                                                               [](std::FILE* file) { return std::fclose(file); });
  std::FILE* file = is_stream ? stdin : opened.get();
  std::string bytes;
  if (file) {
    std::array<char, 1 << 16> part;
    for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), file)) > 0;) {
      bytes.append(part.data(), count);
    }
  }
  if (!file || std::ferror(file)) {
    return file_error(is_stream ? "stdin" : path,
                      fmt::format("cannot be read: {}", std::strerror(errno == 0 ? EIO : errno)));
  }
  return bytes;
}

}  // namespace medial_vk
