// The messages of a run, and the effect of signals, while the driver compiles the programs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress.h"

namespace medial_vk::cli {

/// A driver that compiles cannot be stopped, and no file is written yet, so the first signal ends the program. After
/// `patience` seconds of compilation a message names the device, and the remedies.
class ProgramsWatch {
 public:
  explicit ProgramsWatch(unsigned patience = 60) : patience_(patience) {}

  /// For the message; before the first update().
  void set_device(const std::string& name);
  /// ContextOptions::programs_progress.
  void update(std::size_t made, std::size_t total, Progress& progress);

 private:
  unsigned patience_;
  std::string too_slow_;  // the message
  std::optional<EndAtOnce> guard_;
};

}  // namespace medial_vk::cli
