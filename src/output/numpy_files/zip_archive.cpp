#if defined(MEDIAL_VK_HAS_ZIP)  // else nothing of libzip may be needed to build
#include "output/numpy_files/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <memory>

namespace medial_vk {
namespace {

/// The first date that a zip can represent, in its encoding (the year since 1980, the month and the day).
constexpr zip_uint16_t kFirstDay = 1 << 5 | 1;

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct DiscardArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

// Memory is the only cause of failure.
Error failed(const char* message) {
  return {ErrorCode::kOutOfMemory, fmt::format("cannot make the zip archive: {}", message)};
}

Status add(zip_t* archive, const ZipMember& member) {
  zip_source_t* source = zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0);
  if (source == nullptr) return failed(zip_strerror(archive));
  const zip_int64_t index = zip_file_add(archive, member.name.c_str(), source, 0);
  if (index < 0) {
    zip_source_free(source);
    return failed(zip_strerror(archive));
  }
  const auto at = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, at, ZIP_CM_STORE, 0) != 0 ||
      zip_file_set_dostime(archive, at, 0, kFirstDay, 0) != 0) {
    return failed(zip_strerror(archive));
  }
  return {};
}

Result<std::string> read_all(zip_source_t* source) {
  zip_stat_t stat = {};
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) {
    return failed(zip_error_strerror(zip_source_error(source)));
  }
  std::string bytes(stat.size, '\0');
  const zip_int64_t read = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(bytes.size())) return failed("it cannot be read back");
  return bytes;
}

}  // namespace

Result<std::string> make_zip(std::span<const ZipMember> members) {
  zip_error_t error = {};
  const std::unique_ptr<zip_source_t, FreeSource> destination(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!destination) return failed(zip_error_strerror(&error));
  std::unique_ptr<zip_t, DiscardArchive> archive(zip_open_from_source(destination.get(), ZIP_TRUNCATE, &error));
  if (!archive) return failed(zip_error_strerror(&error));
  zip_source_keep(destination.get());  // the archive takes over one reference
  for (const ZipMember& member : members) {
    if (Status status = add(archive.get(), member); !status) return status.error();
  }
  if (zip_close(archive.get()) != 0) return failed(zip_strerror(archive.get()));
  [[maybe_unused]] zip_t* closed = archive.release();
  return read_all(destination.get());
}

}  // namespace medial_vk
#else
#include "common/absent_parts.h"
#include "output/numpy_files/zip_archive.h"

namespace medial_vk {

Result<std::string> make_zip(std::span<const ZipMember>) {
  return Error{ErrorCode::kUsage, not_written(".npz", "libzip")};
}

}  // namespace medial_vk
#endif
