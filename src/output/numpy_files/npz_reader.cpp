#if defined(MEDIAL_VK_HAS_ZIP)  // else nothing of libzip may be needed to build
#include "output/numpy_files/npz_reader.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <utility>

#include "base/quoted.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostAxes = 4;

struct DiscardZip {
  void operator()(zip_t* zip) const { ::zip_discard(zip); }
};
struct CloseMember {
  void operator()(zip_file_t* file) const { ::zip_fclose(file); }
};

/// Reads the dictionary at the beginning of a .npy in the form in which NumPy writes it.
class HeaderText {
 public:
  explicit HeaderText(std::string_view text) : rest_(text) {}

  bool skip(std::string_view expected) {
    if (!rest_.starts_with(expected)) return false;
    rest_.remove_prefix(expected.size());
    return true;
  }

  bool read_until(char end, std::string& word) {
    const std::size_t at = rest_.find(end);
    if (at == std::string_view::npos) return false;
    word = rest_.substr(0, at);
    rest_.remove_prefix(at);
    return true;
  }

  bool read_number(std::uint64_t& number) {
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc()) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  bool is_blank() const { return rest_.find_first_not_of(" \n") == std::string_view::npos; }

 private:
  std::string_view rest_;
};

bool read_header(std::string_view text, NpyArray& array) {
  HeaderText header(text);
  if (!header.skip("{'descr': '") || !header.read_until('\'', array.type)) return false;
  if (!header.skip("', 'fortran_order': False, 'shape': (")) return false;
  for (std::uint64_t length; array.shape.size() < kMostAxes && header.read_number(length);) {
    array.shape.push_back(length);
    if (!header.skip(", ") && !header.skip(",")) break;
  }
  return header.skip("), }") && header.is_blank();
}

/// The bytes of one element; 0: not a type that is read.
std::uint64_t size_of(const std::string& type) {
  if (type == "|b1" || type == "|u1") return 1;
  if (type == "<f8" || type == "<u8" || type == "<i8") return 8;
  if (type == "<f4" || type == "<u4" || type == "<i4") return 4;
  if (!type.starts_with("<U")) return 0;
  std::uint64_t letters = 0;
  const char* const last = type.data() + type.size();
  const auto [end, error] = std::from_chars(type.data() + 2, last, letters);
  constexpr std::uint64_t kMostLetters = 1 << 16;
  return error == std::errc() && end == last && letters <= kMostLetters ? 4 * letters : 0;
}

/// True if the shape has exactly so many elements.
bool has_elements(const std::vector<std::uint64_t>& shape, std::uint64_t elements) {
  if (std::ranges::find(shape, 0u) != shape.end()) return elements == 0;
  for (const std::uint64_t length : shape) {
    if (elements % length != 0) return false;
    elements /= length;
  }
  return elements == 1;
}

/// Empty, or what is wrong.
std::string parse_npy(std::string_view npy, NpyArray& array) {
  constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);
  constexpr std::size_t kPrefix = 10;
  if (npy.size() < kPrefix || !npy.starts_with(kMagic)) return "is not an array in version 1.0 of NumPy's format";
  const std::size_t length = static_cast<unsigned char>(npy[8]) + 256u * static_cast<unsigned char>(npy[9]);
  if (npy.size() - kPrefix < length) return "ends within its header";
  if (!read_header(npy.substr(kPrefix, length), array)) return "has a header that NumPy does not write for C order";
  const std::uint64_t size = size_of(array.type);
  if (size == 0) return fmt::format("holds elements of the type {}, which is not read here", quoted(array.type));
  array.bytes = npy.substr(kPrefix + length);
  if (array.bytes.size() % size != 0 || !has_elements(array.shape, array.bytes.size() / size)) {
    return fmt::format("has {} bytes, not as many as its shape requires", array.bytes.size());
  }
  return {};
}

class Archive {
 public:
  Archive(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Status open() {
    zip_error_t error = {};
    zip_source_t* source = ::zip_source_buffer_create(bytes_.data(), bytes_.size(), 0, &error);
    if (source == nullptr) return Error{ErrorCode::kOutOfMemory, name_ + ": out of memory"};
    zip_.reset(::zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error));
    if (!zip_) {
      ::zip_source_free(source);  // which an open archive owns
      const Error no_zip = wrong(fmt::format("it is no .npz: {}", ::zip_error_strerror(&error)));
      ::zip_error_fini(&error);
      return no_zip;
    }
    return {};
  }

  Result<std::map<std::string, NpyArray>> read() {
    const auto count = static_cast<std::uint64_t>(::zip_get_num_entries(zip_.get(), 0));
    if (count > kMostNpzMembers) return wrong(fmt::format("it has {} members, more than {}", count, kMostNpzMembers));
    std::map<std::string, NpyArray> arrays;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (Status status = add(i, arrays); !status) return status.error();
    }
    return arrays;
  }

 private:
  Error wrong(const std::string& what) const { return {ErrorCode::kInvalidMesh, fmt::format("{}: {}", name_, what)}; }

  Status add(std::uint64_t index, std::map<std::string, NpyArray>& arrays) {
    zip_stat_t stat = {};
    constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    if (::zip_stat_index(zip_.get(), index, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded) {
      return wrong(fmt::format("member {} has no entry", index));
    }
    const std::string_view file = stat.name;
    constexpr std::string_view kExtension = ".npy";
    constexpr std::size_t kLongestName = 64;
    const bool is_plain = std::ranges::all_of(file, [](char c) { return c > ' ' && c < 0x7f; });
    if (!file.ends_with(kExtension) || file.size() > kLongestName || !is_plain) {
      return wrong(fmt::format("member {} is no .npy with a short name", index));
    }
    const std::string array(file.substr(0, file.size() - kExtension.size()));
    if (stat.comp_method != ZIP_CM_STORE || stat.encryption_method != ZIP_EM_NONE) {
      return wrong(fmt::format("{} is compressed or encrypted: only what numpy.savez stores is read", array));
    }
    std::string npy;
    // Members that share bytes would expand, too.
    if (stat.size > bytes_.size() - read_ || !read_member(index, stat.size, npy)) {
      return wrong(fmt::format("{} is damaged: its bytes are not those that its CRC-32 is of", array));
    }
    read_ += stat.size;
    NpyArray parsed;
    if (const std::string why = parse_npy(npy, parsed); !why.empty()) return wrong(fmt::format("{} {}", array, why));
    if (!arrays.emplace(array, std::move(parsed)).second) return wrong(fmt::format("{} is there twice", array));
    return {};
  }

  /// The CRC-32 is compared when the end of the member is read.
  bool read_member(std::uint64_t index, std::uint64_t size, std::string& bytes) {
    const std::unique_ptr<zip_file_t, CloseMember> file(::zip_fopen_index(zip_.get(), index, 0));
    if (!file) return false;
    bytes.resize(size + 1);  // one more, so that the end is met
    const zip_int64_t got = ::zip_fread(file.get(), bytes.data(), bytes.size());
    if (got < 0 || static_cast<std::uint64_t>(got) != size) return false;
    char beyond = 0;
    if (::zip_fread(file.get(), &beyond, 1) != 0) return false;
    bytes.resize(size);
    return true;
  }

  std::string_view bytes_;
  const std::string& name_;
  std::unique_ptr<zip_t, DiscardZip> zip_;
  std::uint64_t read_ = 0;  // bytes of all members so far
};

}  // namespace

Result<std::map<std::string, NpyArray>> read_npz(std::string_view bytes, const std::string& name) {
  Archive archive(bytes, name);
  if (Status status = archive.open(); !status) return status.error();
  return archive.read();
}

}  // namespace medial_vk
#else
#include "common/absent_parts.h"
#include "output/numpy_files/npz_reader.h"

namespace medial_vk {

Result<std::map<std::string, NpyArray>> read_npz(std::string_view, const std::string& name) {
  return Error{ErrorCode::kInvalidMesh, name + ": " + not_read(".npz", "libzip")};
}

}  // namespace medial_vk
#endif
