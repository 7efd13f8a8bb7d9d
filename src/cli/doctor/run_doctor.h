// The command `medial-vk doctor`.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// `arguments` without the program's name and without "doctor". Ok if the default device works. Errors: kUsage;
/// kNoDevice (none is usable, or the default one fails); kCheckFailed (it gives other results than the reference);
/// kOutOfMemory, kInterrupted, kCannotWrite.
Status run_doctor(const std::vector<std::string>& arguments);

}  // namespace medial_vk::cli
