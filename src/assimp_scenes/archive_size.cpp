#if defined(MEDIAL_VK_HAS_ZIP)  // else nothing of libzip may be needed to build
#include "assimp_scenes/archive_size.h"

#include <zip.h>

#include <memory>

namespace medial_vk {

std::uint64_t expanded_size(std::string_view bytes) {
  if (!bytes.starts_with("PK")) return 0;
  zip_source_t* source = ::zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
  if (source == nullptr) return 0;
  const std::unique_ptr<zip_t, void (*)(zip_t*)> zip(::zip_open_from_source(source, ZIP_RDONLY, nullptr),
                                                     ::zip_discard);
  if (!zip) {
    ::zip_source_free(source);  // which an open archive owns
    return 0;
  }
  std::uint64_t sum = 0;
  const zip_int64_t entries = ::zip_get_num_entries(zip.get(), 0);
  for (zip_int64_t i = 0; i < entries; ++i) {
    zip_stat_t status;
    if (::zip_stat_index(zip.get(), static_cast<zip_uint64_t>(i), 0, &status) != 0) continue;
    if ((status.valid & ZIP_STAT_SIZE) == 0) continue;
    if (status.size > ~std::uint64_t{0} - sum) return ~std::uint64_t{0};
    sum += status.size;
  }
  return sum;
}

}  // namespace medial_vk
#endif
