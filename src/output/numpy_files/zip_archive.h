// A zip archive in memory, by libzip.
#pragma once

#include <span>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk {

struct ZipMember {
  std::string name;
  std::string bytes;
};

/// Members are stored without compression, dated 1 January 1980: the same members give the same bytes. Error:
/// kOutOfMemory.
Result<std::string> make_zip(std::span<const ZipMember> members);

}  // namespace medial_vk
