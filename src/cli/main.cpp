#include "cli/run.h"
#include "platform/processes.h"
#include "platform/signals.h"

int main(int count, char** arguments) {
  namespace platform = medial_vk::platform;
  return platform::run_apart_from_signals(
      [&] { return medial_vk::cli::run(platform::prepare_process(count, arguments)); });
}
