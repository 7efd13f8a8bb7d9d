#include "cli/terminal/messages.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "output/whole_files/atomic_file.h"

namespace medial_vk::cli {

Error stopped() { return {ErrorCode::kInterrupted, "interrupted; nothing was written"}; }

std::string in_words_of_options(std::string message) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOptions = {{
      {"`memory_budget`", "--memory"},
      {"`resolution`", "--resolution"},
      {"`perturb`", "--perturb"},
  }};
  for (const auto& [parameter, option] : kOptions) {
    for (std::size_t at = message.find(parameter); at != std::string::npos; at = message.find(parameter, at)) {
      message.replace(at, parameter.size(), option);
    }
  }
  return message;
}

Error with_hint(Error error, const std::string& wanted) {
  error.message = in_words_of_options(std::move(error.message));
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

int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return 2;
    case ErrorCode::kInvalidMesh:
      return 3;
    case ErrorCode::kNoDevice:
      return 4;
    case ErrorCode::kOutOfMemory:
      return 5;
    case ErrorCode::kCannotWrite:
      return 6;
    case ErrorCode::kCheckFailed:
      return 7;
    case ErrorCode::kInterrupted:
      return 130;
    case ErrorCode::kInternal:
      break;
  }
  return 1;
}

int report_error(const Error& error, const char* command) {
  print_message(fmt::format("medial-vk: {}\n", in_words_of_options(error.message)));
  if (error.code == ErrorCode::kUsage) print_message(fmt::format("Try {} --help.\n", command));
  return exit_code(error.code);
}

}  // namespace medial_vk::cli
