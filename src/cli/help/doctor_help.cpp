// The text of `medial-vk doctor --help`.
#include "cli/help/help_texts.h"

namespace medial_vk::cli {

std::string doctor_help_text() {
  return R"(medial-vk doctor shows what this machine has for medial-vk and what is missing:
the Vulkan loader, drivers, devices, the folder of the cache. It runs a small
extraction on each device, compares it with the CPU reference, and gives advice.

Usage:
  medial-vk doctor [options]

Examples:
  medial-vk doctor                         what is here, and what to do
  medial-vk doctor --device 0              whether device 0 works
  medial-vk doctor --quiet --report doctor.json    for continuous integration

Options:
      --device D        take this Vulkan device, by index or part of its name,
                        for the default one (default: the environment variable
                        MEDIAL_VK_DEVICE, else the best)
      --time-limit S    seconds that a driver or a device may take, 1 to 86400
                        (default 60)
      --report FILE     all findings as JSON; "-": standard output
  -q, --quiet           print nothing but errors
  -v, --verbose         also the folders that are searched, each comparison with
                        the reference, and what loader and drivers report
  -h, --help            print this and exit

Drivers run in processes of their own: one that crashes or hangs is reported,
and the examination goes on. Nothing is changed, except that compiled programs
are kept in the cache, as in every run.

Exit codes: 0 the default device works, 1 internal error, 2 wrong usage, 4 there
is no usable device or the default one fails, 5 out of memory, 6 cannot write,
7 the default device gives other results than the reference, 130 interrupted.
)";
}

}  // namespace medial_vk::cli
