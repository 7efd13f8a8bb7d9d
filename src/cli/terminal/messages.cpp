#include "cli/terminal/messages.h"

#include <fmt/format.h>

#include <cstdio>

#include "output/files/atomic_file.h"

namespace medial_vk::cli {

Error stopped() { return {ErrorCode::kInterrupted, "interrupted; nothing was written"}; }

Error with_hint(Error error, const std::string& wanted) {
  if (error.code != ErrorCode::kNoDevice) return error;
  error.message += wanted.empty()
                       ? "\nInstall the Vulkan driver of your graphics card, or Mesa's CPU device (Debian: apt install "
                         "libvulkan1 mesa-vulkan-drivers), or use --backend cpu, which needs no Vulkan."
                       : "\nmedial-vk --list-devices shows what is here.";
  return error;
}

Status print_result(const std::string& text) {
  const OutputFile file = {"-", text};
  return write_files({&file, 1});
}

void print_message(const std::string& text) { std::fputs(text.c_str(), stderr); }

int report_error(const Error& error, const char* command) {
  print_message(fmt::format("medial-vk: {}\n", error.message));
  if (error.code == ErrorCode::kUsage) print_message(fmt::format("Try {} --help.\n", command));
  return static_cast<int>(error.code);
}

}  // namespace medial_vk::cli
