// Choice of the reader for a file, and input of its bytes.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>

#include "input/read_mesh.h"
#include "input/readers.h"
#include "input/text_scanner.h"
#include "platform/files.h"

namespace medial_vk {
namespace {

std::string lower_case_extension(const std::string& name) {
  const std::size_t dot = name.find_last_of("./\\");
  if (dot == std::string::npos || name[dot] != '.') return {};
  std::string extension = name.substr(dot + 1);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// OFF, COFF, NOFF, STOFF, ...: prefixes name extra columns. The reader rejects 4OFF and nOFF.
bool is_off_keyword(std::string_view word) {
  return word.size() >= 3 && word.size() <= 8 && word.ends_with("OFF") &&
         word.find_first_not_of("STCN4n") == word.size() - 3;
}

bool is_word(std::string_view word, std::string_view lower_case) {
  return std::ranges::equal(word, lower_case, [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
  });
}

/// True for "solid" and then, within the first lines, a facet or the end of the solid. A binary file has bytes that are
/// zero, if only in the attributes of its facets.
bool looks_like_ascii_stl(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);
  TextScanner scanner(bytes, 0, false);
  if (!is_word(scanner.word_across_lines(), "solid") || bytes.find('\0') != std::string_view::npos) return false;
  while (scanner.next_line()) {
    const std::string_view word = scanner.word();
    if (is_word(word, "facet") || is_word(word, "endsolid")) return true;
  }
  return false;
}

/// For a file whose extension says that it is STL: text, although no facet is near its beginning.
bool is_text_stl(std::string_view bytes, std::string_view first_word) {
  return is_word(first_word, "solid") && bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

/// True if the first line that is no comment begins as usual in OBJ.
bool looks_like_obj(std::string_view bytes) {
  TextScanner scanner(bytes.substr(0, 65536), '#', true);
  const std::string_view word = scanner.word_across_lines();
  constexpr std::string_view kKeywords[] = {"v", "vn", "vt", "vp", "o",   "g",      "s",      "mg",
                                            "f", "fo", "l",  "p",  "lod", "mtllib", "usemtl", "cstype"};
  return std::ranges::find(kKeywords, word) != std::end(kKeywords);
}

Result<Mesh> read_by_content(std::string_view bytes, const std::string& name) {
  const std::string extension = lower_case_extension(name);
  const std::string_view first_word = TextScanner(bytes.substr(0, 4096), '#', false).word_across_lines();
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return read_ply(bytes, name);
  if (is_off_keyword(first_word)) return read_off(bytes, name);
  if (bytes.size() > 84 && has_size_of_binary_stl(bytes)) return read_binary_stl(bytes, name);
  if (looks_like_ascii_stl(bytes)) return read_ascii_stl(bytes, name);
  if (extension == "obj") return read_obj(bytes, name);
  if (extension == "ply") return read_ply(bytes, name);
  if (extension == "off") return read_off(bytes, name);
  if (extension == "stl")
    return is_text_stl(bytes, first_word) ? read_ascii_stl(bytes, name) : read_binary_stl(bytes, name);
  if (looks_like_obj(bytes)) return read_obj(bytes, name);
  return file_error(name,
                    "neither content nor extension is that of a mesh file, such as OBJ, PLY, STL, OFF, glTF or 3MF");
}

Error too_long(const std::string& name, std::uint64_t most_bytes) {
  const std::uint64_t mebibytes = most_bytes >> 20;
  return file_error(name, fmt::format("longer than {} MiB, the most that is read", mebibytes));
}

}  // namespace

std::string name_of_input(const std::string& path) { return path == "-" ? "standard input" : path; }

Result<std::string> read_mesh_bytes(const std::string& path, std::uint64_t most_bytes) {
  const std::string name = name_of_input(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      path == "-" ? stdin : platform::open_to_read(path), [](std::FILE* f) { return f == stdin ? 0 : std::fclose(f); });
  if (!file) return file_error(name, fmt::format("cannot open: {}", std::strerror(errno)));
  const std::uint64_t known = platform::length_of_regular(file.get());
  if (known > most_bytes) return too_long(name, most_bytes);
  std::string bytes;
  // One byte more shows whether the file has ended.
  const auto grow = [&](std::uint64_t size) { bytes.resize(std::min(std::max(size, known), most_bytes) + 1); };
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) grow(std::max<std::size_t>(1u << 20, bytes.size() * 2));
    const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
    used += got;
    if (used > most_bytes) return too_long(name, most_bytes);
    if (got == 0) break;
  }
  if (std::ferror(file.get())) return file_error(name, fmt::format("cannot read: {}", std::strerror(errno)));
  bytes.resize(used);
  return bytes;
}

Result<Mesh> parse_mesh(std::string_view bytes, const std::string& name) {
  try {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // the byte order mark that some editors write
    if (bytes.empty()) return file_error(name, "file is empty");
    Result<Mesh> mesh = read_by_content(bytes, name);
    if (!mesh.ok() || !mesh.value().triangles.empty()) return mesh;
    const std::uint64_t short_polygons = mesh.value().short_polygons;
    if (short_polygons > 0) {
      return file_error(name, fmt::format("no triangles: all {} faces have fewer than three corners", short_polygons));
    }
    return file_error(name, fmt::format("no faces ({} vertices)", mesh.value().vertices.size()));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", name)};
  }
}

Result<Mesh> read_mesh(const std::string& path, std::uint64_t most_bytes) {
  const std::string name = name_of_input(path);
  try {
    const Result<std::string> bytes = read_mesh_bytes(path, most_bytes);
    if (!bytes.ok()) return bytes.error();
    return parse_mesh(bytes.value(), name);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", name)};
  }
}

}  // namespace medial_vk
