#include <string>
#include <vector>

#include "cli/run.h"

int main(int count, char** arguments) {
  return medial_vk::cli::run(std::vector<std::string>(arguments + (count > 0 ? 1 : 0), arguments + count));
}
