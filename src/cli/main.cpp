#include "cli/run.h"
#include "platform/processes.h"

int main(int count, char** arguments) {
  return medial_vk::cli::run(medial_vk::platform::prepare_process(count, arguments));
}
